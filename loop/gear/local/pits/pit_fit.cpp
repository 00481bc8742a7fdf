// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/pits/pit_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/effects/places/pits_of_flanks.h"

namespace trueflank::loop {

using namespace gear_effects;

double part_of_depth(const FoundPit& pit, int hollow, const PointOfFlank& point) {
  const double up = point.up_mm - pit.up_mm, along = point.along_mm - pit.along_mm;
  return depth_of_pit(hollow, (up * up + along * along) / (pit.half_mm * pit.half_mm));
}

double end_of_pit(int hollow) { return hollow == kBell ? 1.3 : 1.0; }

double usual_half_mm(const std::vector<FoundPit>& pits) {
  std::vector<double> halves;
  for (const FoundPit& p : pits) halves.push_back(p.half_mm);
  return median(std::move(halves));
}

/// `take` for the points about a pit, so many of its half widths to every side.
template <class Take>
void PitFit::for_points_about(const FoundPit& p, double reach, const Take& take) const {
  const double far = reach * p.half_mm;
  for (const PointOfFlank& point :
       near_[p.flank].empty() ? flanks_.points[p.flank] : near_[p.flank])
    if (std::abs(point.up_mm - p.up_mm) <= far && std::abs(point.along_mm - p.along_mm) <= far)
      take(point);
}

/// Its depth where it is, and what is left of the points about the place it was found at.
PitFit::Fitted PitFit::fitted(const std::vector<PointOfFlank>& about, const FoundPit& p,
                              int hollow) {
  constexpr double kFewest = 0.5;  // points, each as its part of the depth counts
  double own = 0.0, with = 0.0, all = 0.0;
  for (const PointOfFlank& point : about) {
    const double s = part_of_depth(p, hollow, point);
    own += s * s;
    with += s * point.um;
    all += point.um * point.um;
  }
  if (!(own > kFewest)) return {0.0, all};
  return {with / own, all - with * with / own};
}

/// Seeks its place, width and depth.
void PitFit::one(FoundPit& p, int hollow, double usual_mm) const {
  constexpr double kReach = 3.0, kSpread = 0.35;
  std::vector<PointOfFlank> about;
  for_points_about(p, kReach, [&](const PointOfFlank& point) { about.push_back(point); });
  const auto cost_of = [&](const FoundPit& of) {
    const Fitted f = fitted(about, of, hollow);
    if (f.depth_um * p.depth_um <= 0.0) return 1e300;
    const double off = usual_mm > 0.0 ? std::log(of.half_mm / usual_mm) / kSpread : 0.0;
    return f.left + flanks_.sigma_um * flanks_.sigma_um * off * off;
  };
  FoundPit best = p;
  double least = cost_of(best);
  for (double step = 0.4; step > 0.02; step *= 0.6) {
    bool moved = true;
    for (int turn = 0; moved && turn < 6; ++turn) {
      moved = false;
      const FoundPit from = best;
      const auto try_one = [&](double along, double up, double times) {
        FoundPit other = from;
        other.along_mm += along * from.half_mm;
        other.up_mm += up * from.half_mm;
        other.half_mm = std::clamp(times * from.half_mm, least_half_mm_, kWidestPit_mm);
        const double cost = cost_of(other);
        if (cost >= least - 1e-9) return;
        least = cost;
        best = other;
        moved = true;
      };
      for (const double sign : {-1.0, 1.0}) {
        try_one(sign * step, 0.0, 1.0);
        try_one(0.0, sign * step, 1.0);
        try_one(0.0, 0.0, 1.0 + sign * 0.6 * step);
      }
    }
  }
  const Fitted f = fitted(about, best, hollow);
  if (f.depth_um * p.depth_um <= 0.0) return;
  best.depth_um = f.depth_um;
  p = best;
}

void PitFit::each(std::vector<FoundPit>& found, int hollow, double usual_mm) const {
  for_each_piece(found.size(), [&](std::size_t i) { one(found[i], hollow, usual_mm); });
}

int PitFit::all_alike(std::vector<FoundPit>& found) {
  gather_near(found);
  std::vector<FoundPit> best;
  int hollow = kBowl;
  double least = 1e300;
  for (int k = 0; k < kHollows; ++k) {
    std::vector<FoundPit> these = found;
    each(these, k, 0.0);
    const double usual = usual_half_mm(these);
    these = found;
    for (FoundPit& p : these) p.half_mm = usual;
    each(these, k, usual);
    const double left = left_of(these, found, k);
    if (left >= least) continue;
    least = left;
    best = std::move(these);
    hollow = k;
  }
  found = std::move(best);
  return hollow;
}

/// Squares left about the places at which pits were found.
double PitFit::left_of(const std::vector<FoundPit>& these, const std::vector<FoundPit>& found,
                       int hollow) const {
  constexpr double kReach = 3.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < these.size(); ++i)
    for_points_about(found[i], kReach, [&](const PointOfFlank& point) {
      const double off = point.um - these[i].depth_um * part_of_depth(these[i], hollow, point);
      sum += off * off;
    });
  return sum;
}

/// The points about pits, so that they are not sought among all of a flank.
void PitFit::gather_near(const std::vector<FoundPit>& found) {
  constexpr double kReach = 4.0;
  for (auto& near : near_) near.clear();
  std::vector<std::vector<const FoundPit*>> of_flank(near_.size());
  for (const FoundPit& p : found) of_flank[p.flank].push_back(&p);
  for_each_piece(near_.size(), [&](std::size_t flank) {
    if (of_flank[flank].empty()) return;
    for (const PointOfFlank& point : flanks_.points[flank])
      if (std::any_of(of_flank[flank].begin(), of_flank[flank].end(), [&](const FoundPit* p) {
            return std::abs(point.up_mm - p->up_mm) < kReach * p->half_mm &&
                   std::abs(point.along_mm - p->along_mm) < kReach * p->half_mm;
          }))
        near_[flank].push_back(point);
  });
}

bool PitFit::are_round(const std::vector<FoundPit>& found, int hollow) const {
  constexpr double kInner = 1.4, kOuter = 2.4, kRunsOn = 0.4, kShare = 0.25;
  constexpr double kEndOfBell = 1.25;
  const double end = hollow == kBell ? kEndOfBell : 1.0;
  std::size_t run_on = 0;
  for (const FoundPit& p : found) {
    std::array<double, 4> sum{}, count{};  // of half circles' quarters, opposite ones together
    for_points_about(p, kOuter * end, [&](const PointOfFlank& point) {
      const double up = point.up_mm - p.up_mm, along = point.along_mm - p.along_mm;
      const double off = std::sqrt((up * up + along * along) / (p.half_mm * p.half_mm)) / end;
      if (off < kInner || off > kOuter) return;
      const double turn = std::atan2(up, along) / kTwoPi * 8.0 + 8.5;
      const auto k = static_cast<std::size_t>(turn) % 4;
      sum[k] += point.um / p.depth_um;
      count[k] += 1.0;
    });
    const double error = std::abs(flanks_.sigma_um / p.depth_um);
    for (std::size_t k = 0; k < 4; ++k)
      if (count[k] >= 2.0 && sum[k] / count[k] > kRunsOn + error / std::sqrt(count[k])) {
        ++run_on;
        break;
      }
  }
  return static_cast<double>(run_on) <= kShare * static_cast<double>(found.size());
}

void PitFit::take_away(const std::vector<FoundPit>& found, int hollow) {
  for (const FoundPit& p : found)
    for (PointOfFlank& point : flanks_.points[p.flank])
      if (std::abs(point.up_mm - p.up_mm) < kEndOfPit * p.half_mm)
        point.um -= p.depth_um * part_of_depth(p, hollow, point);
  for (auto& near : near_) near.clear();
}

}  // namespace trueflank::loop
