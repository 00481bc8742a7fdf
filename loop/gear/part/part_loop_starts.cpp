// SPDX-License-Identifier: GPL-3.0-or-later
// Effects are chosen one by one: two that overlap may begin with a third that follows both a
// little, and end in many pieces. Then the choice is made again from the forms that the data as
// they are show.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {
namespace {

constexpr double kClearlyLess = 9.0;  // chi-square

/// Effects that run over the profile or over the face, a form without a name among them.
bool is_in_pieces(const FlankGeometry& geometry, const std::vector<Effect>& effects) {
  constexpr int kMany = 3;
  for (const Runs runs : {Runs::kOverProfile, Runs::kOverFace}) {
    int count = 0, forms = 0;
    for (const Effect& effect : effects) {
      if (effect.family->local || runs_of(geometry, effect) != runs) continue;
      ++count;
      forms += effect.is_term() ? 1 : 0;
    }
    if (count >= kMany && forms > 0) return true;
  }
  return false;
}

}  // namespace

/// What effects leave, and how many values they are told by (chi-square).
double PartLoop::cost_of(const std::vector<Effect>& effects) const {
  constexpr double kValue = 8.0;
  return fit_of(effects)->residual_square() + kValue * values_of(effects, true);
}

/// The wave that is most of the pieces, then what stands out beside a slope, the largest first.
/// Each takes as long as the first choice: few.
std::vector<RemainderFinding> PartLoop::other_starts() const {
  constexpr std::size_t kMost = 2;
  std::vector<RemainderFinding> starts;
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
    for (const int face : {0, 1})
      if (std::optional<RemainderFinding> wave = wave_of_pieces(face, flank))
        starts.push_back(std::move(*wave));
  std::vector<RemainderFinding> beside = beside_slopes_;
  std::stable_sort(beside.begin(), beside.end(),
                   [](const auto& a, const auto& b) { return a.square > b.square; });
  for (const RemainderFinding& finding : beside)
    if (std::none_of(starts.begin(), starts.end(),
                     [&](const auto& start) { return *start.effect == *finding.effect; }))
      starts.push_back(finding);
  if (starts.size() > kMost) starts.resize(kMost);
  return starts;
}

/// Where the choice ends in pieces it is made again from other starts, and the best of these is
/// kept. True where that is in no pieces, leaves nothing and costs less: it is taken over, whole.
bool PartLoop::begins_better() {
  // Traces of real gears are in pieces whatever one begins with.
  if (table_->points_mm.empty() || !options_.start.empty() || asked_for_starts_ ||
      !is_in_pieces(geometry_, effects_))
    return false;
  asked_for_starts_ = true;
  const std::vector<RemainderFinding> starts = other_starts();
  const double own_cost = cost_of(effects_);
  double least = kNaN;
  problem_ = {};  // each choice has columns of its own, a fifth of the memory of a large scan
  for (const RemainderFinding& start : starts) {
    Options options = options_;
    options.given.resize(first_told_here());
    options.start = {start};
    SharedTable measured = table_;
    if (measured->is_displaced) undo_displacement(geometry_, measured.own());
    auto other = std::make_unique<PartLoop>(geometry_, std::move(measured), std::move(options));
    other->run();
    const double cost = other->cost_of(other->effects_);
    if (other->table_->is_displaced || cost >= least) continue;
    least = cost;
    other_start_ = std::move(other);
    if (cost >= own_cost || is_in_pieces(geometry_, other_start_->effects_)) continue;
    if (other_start_->structure_is_left()) {
      if (cost < own_cost - kClearlyLess) return false;
      continue;
    }
    remainder_ = std::move(other_start_->remainder_);
    alone_ = std::move(other_start_->alone_);
    take_over(*other_start_);
    other_start_.reset();
    return true;
  }
  return false;
}

/// The best of other starts where it costs clearly less than what the choice came to by itself.
void PartLoop::take_other_start() {
  if (begins_better() || !other_start_ || table_->is_displaced ||
      !(other_start_->cost_of(other_start_->effects_) < cost_of(effects_) - kClearlyLess))
    return;
  alone_ = std::move(other_start_->alone_);
  take_over(*other_start_);
  other_start_.reset();
}

}  // namespace trueflank::loop
