// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_parts.h"

#include <algorithm>
#include <utility>

namespace trueflank {
namespace {

/// The margin of a limit that could not be computed.
constexpr double kNoTooth = -1e9;

}  // namespace

PlaceInParts::PlaceInParts(SetValues& values, int layer, double distance, double shift,
                           double stop_below, CornerPlaces& corners)
    : values_(values),
      layer_(layer),
      shift_(shift),
      corners_(corners),
      limits_(values.limits_of(layer)) {
  PartlyJudged parts = values.in_parts(layer, distance, shift, stop_below);
  first_of_profiles_ = parts.first_of_profiles;
  evaluation_ = parts.evaluation;
  profiles_ = std::move(parts.profiles);
  const std::size_t known = profiles_ ? first_of_profiles_ : limits_;
  std::fill_n(state_.begin(), known, State::kComputed);
}

PlaceInParts::PlaceInParts(SetValues& values, int layer, double shift,
                           const LayerEvaluation& evaluation, double margin, CornerPlaces& corners)
    : values_(values),
      layer_(layer),
      shift_(shift),
      corners_(corners),
      limits_(values.limits_of(layer)),
      first_of_profiles_(limits_),
      evaluation_(evaluation),
      margin_(margin) {
  state_.fill(State::kComputed);
}

double PlaceInParts::kept(std::size_t limit, double enough) {
  double& margin = evaluation_.margins[limit];
  State& state = state_[limit];
  const auto known = [&] { return values_.kept(layer_, limit, margin); };
  if (state == State::kComputed || (state == State::kBounded && known() < enough)) return known();
  const std::size_t of_profiles = limit - first_of_profiles_;
  const double below = values_.surely_below(layer_, limit, enough);
  if (state == State::kOpen && enough > kLeastOfAll_mm)
    if (const auto here = profiles_->at_sample(of_profiles, corners_[limit]);
        here && *here < below) {
      state = State::kBounded;
      margin = *here;
      return known();
    }
  state = State::kComputed;
  if (!profiles_->exists(of_profiles)) {
    margin = kNoTooth;
    return known();
  }
  const CornerLook look = profiles_->look(of_profiles, below, corners_[limit]);
  margin = look.clearance_mm;
  if (!look.least) state = State::kBounded;
  return known();
}

bool PlaceInParts::is_feasible(PlaceInParts& beside, double enough) {
  for (std::size_t i = 0; i < limits_; ++i)
    if (is_known(i) && kept(i, enough) < 0.0) return false;
  for (std::size_t i = 0; i < limits_; ++i)
    if (beside.is_known(i) && beside.breaks(i) && kept(i, enough) < 0.0) return false;
  for (std::size_t i = 0; i < limits_; ++i)
    if (kept(i, enough) < 0.0) return false;
  return true;
}

std::optional<double> PlaceInParts::margin_above(double least) {
  for (std::size_t i = 0; i < limits_; ++i)
    if (is_known(i) && values_.kept(layer_, i, evaluation_.margins[i]) <= least)
      return std::nullopt;
  double margin = 1e9;
  for (std::size_t i = 0; i < limits_; ++i) {
    const double here = kept(i, least);
    if (here <= least) return std::nullopt;
    margin = here < margin ? here : margin;
  }
  return margin;
}

double PlaceInParts::margin() {
  if (!margin_) margin_ = margin_above(kLeastOfAll_mm);
  return *margin_;
}

bool break_the_same(PlaceInParts& p, PlaceInParts& q) {
  for (const bool known : {true, false})
    for (std::size_t i = 0; i < p.limits(); ++i)
      if ((p.is_known(i) && q.is_known(i)) == known && p.breaks(i) && q.breaks(i)) return true;
  return false;
}

bool may_be_close(const PlaceInParts& p, const PlaceInParts& q, double least) {
  bool far_p = false, far_q = false;
  for (std::size_t i = 0; i < p.limits(); ++i) {
    if (!p.is_known_broken(i) || !q.is_known_broken(i)) continue;
    far_p = far_p || !(p.keeps_at_most(i) > least);
    far_q = far_q || !(q.keeps_at_most(i) > least);
  }
  return !(far_p && far_q);
}

}  // namespace trueflank
