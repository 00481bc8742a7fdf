// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/far_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kNear = 6;       ///< nearest points of the flank that are neighbours
constexpr std::size_t kMostFar = 200;  ///< of a flank: more are no burr

/// A point of a flank, in mm on it.
struct FlankPoint {
  double profile_mm = 0.0, face_mm = 0.0, um = 0.0;
  bool far = false;
};

/// Far points of a flank that are neighbours and lie off to the same side.
struct Cluster {
  std::size_t flank = 0, points = 0;
  double low_profile = 1e300, high_profile = -1e300, low_face = 1e300, high_face = -1e300;
  double sum_um = 0.0, spacing_mm = 0.0;
};

struct OfFlank {
  double points = 0.0, far = 0.0, with_far_neighbour = 0.0;
  Cluster largest;
};

class FarPoints {
 public:
  FarPoints(const FlankGeometry& geometry, const Observations& table, const RowsByClass& rows,
            const std::vector<float>& row_um, const IsFar& is_far)
      : geometry_(geometry), table_(table), rows_(rows), row_um_(row_um), is_far_(is_far) {}

  [[nodiscard]] OfFlank look_at(std::size_t flank) const {
    OfFlank found;
    rows_.for_each(flank, [&](std::size_t i) {
      found.points += 1.0;
      if (is_far_(i, flank % 2)) found.far += 1.0;
    });
    if (found.far < 2.0 || found.far > kMostFar || found.points <= kNear) return found;
    const std::vector<FlankPoint> points = points_of(flank);
    std::vector<std::size_t> far;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].far) far.push_back(i);
    std::vector<std::size_t> group(points.size());  // the first of those joined
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto first_of = [&](std::size_t i) {
      while (group[i] != i) i = group[i];
      return i;
    };
    double spacing = 0.0;
    for (const std::size_t i : far) {
      const auto [near, reach] = neighbours(points, i);
      spacing += reach / std::sqrt(static_cast<double>(kNear)) / found.far;
      bool any = false;
      for (const std::size_t other : near) {
        if (!points[other].far || (points[other].um > 0.0) != (points[i].um > 0.0)) continue;
        any = true;
        group[std::max(first_of(i), first_of(other))] = std::min(first_of(i), first_of(other));
      }
      if (any) found.with_far_neighbour += 1.0;
    }
    for (const std::size_t i : far) {
      if (first_of(i) != i) continue;
      Cluster cluster{.flank = flank, .spacing_mm = spacing};
      for (const std::size_t j : far)
        if (first_of(j) == i) add(points[j], cluster);
      if (cluster.points > found.largest.points) found.largest = cluster;
    }
    return found;
  }

  /// The place is as wide as its points reach, and half the way to the next ones.
  [[nodiscard]] FlankSpot spot_of(const Cluster& c, double p_value) const {
    const double roll = 0.5 * (c.low_profile + c.high_profile);
    return {.p_value = p_value,
            .tooth = static_cast<int>(c.flank / 2) + 1,
            .side = c.flank % 2 == 1 ? 1 : -1,
            .roll_mm = roll,
            .height_mm = 0.5 * (c.low_face + c.high_face),
            .half_profile_mm = 0.5 * (c.high_profile - c.low_profile) +
                               0.5 * c.spacing_mm / gear_effects::along_profile(geometry_, roll),
            .half_face_mm = 0.5 * (c.high_face - c.low_face + c.spacing_mm),
            .amount_um = c.sum_um / static_cast<double>(c.points)};
  }

 private:
  [[nodiscard]] std::vector<FlankPoint> points_of(std::size_t flank) const {
    std::vector<FlankPoint> points;
    rows_.for_each(flank, table_, [&](std::size_t i) {
      const Place& place = table_.place(table_.rows[i]);
      points.push_back({place.roll_mm, place.z_mm, row_um_[i], is_far_(i, flank % 2)});
    });
    return points;
  }

  /// The nearest points, and how far away the last of them is.
  [[nodiscard]] std::pair<std::array<std::size_t, kNear>, double> neighbours(
      const std::vector<FlankPoint>& points, std::size_t of) const {
    const double along = gear_effects::along_profile(geometry_, points[of].profile_mm);
    std::vector<std::pair<double, std::size_t>> near;
    near.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      if (i != of)
        near.emplace_back(std::hypot(along * (points[i].profile_mm - points[of].profile_mm),
                                     points[i].face_mm - points[of].face_mm),
                          i);
    std::partial_sort(near.begin(), near.begin() + kNear, near.end());
    std::array<std::size_t, kNear> nearest{};
    for (std::size_t k = 0; k < kNear; ++k) nearest[k] = near[k].second;
    return {nearest, near[kNear - 1].first};
  }

  static void add(const FlankPoint& p, Cluster& to) {
    ++to.points;
    to.sum_um += p.um;
    to.low_profile = std::min(to.low_profile, p.profile_mm);
    to.high_profile = std::max(to.high_profile, p.profile_mm);
    to.low_face = std::min(to.low_face, p.face_mm);
    to.high_face = std::max(to.high_face, p.face_mm);
  }

  const FlankGeometry& geometry_;
  const Observations& table_;
  const RowsByClass& rows_;
  const std::vector<float>& row_um_;
  const IsFar& is_far_;
};

}  // namespace

std::vector<FlankSpot> far_points_together(const FlankGeometry& geometry, const Observations& table,
                                           const RowsByClass& rows, std::size_t flanks,
                                           const std::vector<float>& row_um, const IsFar& is_far) {
  const FarPoints search(geometry, table, rows, row_um, is_far);
  std::vector<OfFlank> found(flanks);
  for_each_piece(flanks, [&](std::size_t flank) { found[flank] = search.look_at(flank); });
  OfFlank all;
  for (const OfFlank& one : found) {
    all.points += one.points;
    all.far += one.far;
    all.with_far_neighbour += one.with_far_neighbour;
  }
  std::vector<FlankSpot> spots;
  for (const OfFlank& one : found) {
    if (one.largest.points < 2) continue;
    // That a neighbour lies off to the same side: by chance, or as often as elsewhere.
    const double elsewhere = all.far - one.far, half_of_near = 0.5 * kNear;
    const double by_chance = half_of_near * (elsewhere + 1.0) / all.points;
    const double as_elsewhere =
        (all.with_far_neighbour - one.with_far_neighbour + by_chance) / (elsewhere + 1.0);
    const double p = all.far * std::pow(std::min(1.0, std::max(by_chance, as_elsewhere)),
                                        static_cast<double>(one.largest.points) - 1.0);
    if (p < 1.0) spots.push_back(search.spot_of(one.largest, p));
  }
  return spots;
}

}  // namespace trueflank::loop
