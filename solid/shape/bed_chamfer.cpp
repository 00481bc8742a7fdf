// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/bed_chamfer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// The chamfers of both sides may take this share of a wall.
constexpr double kShareOfWall = 0.5;
/// Shallower chamfers are none that a printer shows.
constexpr double kLeast_mm = 1e-3;
/// Less than this much off what was asked for is not reported.
constexpr double kAsAsked = 1.0 - 1e-9;

/// Thinnest wall between two outlines of a slab.
double thinnest_wall_mm(const Slab& slab) {
  std::vector<OutlineExtent> holes;
  for (const Outline& hole : slab.holes) holes.push_back(extent(hole));
  const OutlineExtent outer = extent(slab.outer);
  double thinnest = outer.outer_radius_mm;  // solid
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const double apart = (holes[i].centre - outer.centre).norm();
    thinnest = std::min(thinnest, outer.inner_radius_mm - apart - holes[i].outer_radius_mm);
    for (std::size_t j = 0; j < i; ++j) {
      const double between = (holes[i].centre - holes[j].centre).norm();
      thinnest = std::min(
          thinnest, std::max({between - holes[i].outer_radius_mm - holes[j].outer_radius_mm,
                              holes[i].inner_radius_mm - between - holes[j].outer_radius_mm,
                              holes[j].inner_radius_mm - between - holes[i].outer_radius_mm}));
    }
  }
  return thinnest;
}

std::vector<Outline*> outlines_of(Slab& slab) {
  std::vector<Outline*> outlines{&slab.outer};
  for (Outline& hole : slab.holes) outlines.push_back(&hole);
  return outlines;
}

bool takes_chamfer(const ToothedOutline& toothed) {
  return toothed.edge_chamfer_mm == 0.0 && toothed.displacement == nullptr;
}

Outline chamfered(const Outline& outline, bool outer, const BedChamfer& bed,
                  std::deque<InsetProfile>& profiles) {
  Outline result = outline;
  const BedChamfer moves{outer ? -bed.grow_mm : bed.grow_mm, bed.height_mm};
  if (auto* circle = std::get_if<CircleOutline>(&result)) circle->bed = moves;
  if (auto* bore = std::get_if<BoreOutline>(&result)) bore->bed = moves;
  if (auto* toothed = std::get_if<ToothedOutline>(&result);
      toothed != nullptr && takes_chamfer(*toothed)) {
    toothed->bed = &profiles.emplace_back(*toothed->profile, bed.grow_mm);
    toothed->bed_height_mm = bed.height_mm;
  }
  return result;
}

}  // namespace

std::optional<std::string> add_bed_chamfer(PartShape& part, double depth_mm, double height_mm,
                                           std::deque<InsetProfile>& profiles) {
  TRUEFLANK_EXPECTS(depth_mm > 0.0 && height_mm > 0.0 && !part.slabs.empty());
  const Slab lowest = part.slabs.front();
  const double layer = lowest.z_upper_mm - lowest.z_lower_mm;
  const std::string asked = printed_number(um_from_mm(depth_mm), "%.4g") + " um";
  if (!(height_mm < layer))
    return part.name + ": no chamfer at the bed, its lowest layer is only " +
           printed_number(layer, "%.4g") + " mm high";
  double depth = std::min(depth_mm, 0.5 * kShareOfWall * thinnest_wall_mm(lowest));
  std::string why = depth < depth_mm ? "its walls" : "", teeth;
  Slab slab = lowest;
  for (Outline* outline : outlines_of(slab))
    if (const auto* toothed = std::get_if<ToothedOutline>(outline)) {
      if (!takes_chamfer(*toothed)) {
        teeth = part.name + ": its teeth have an edge chamfer and no other at the bed";
        continue;
      }
      const double deepest =
          depth > 0.0 ? InsetProfile(*toothed->profile, depth).deepest_mm() : 0.0;
      if (deepest < kAsAsked * depth) depth = deepest, why = "its teeth";
    }
  if (!(depth >= kLeast_mm))
    return part.name + ": no chamfer at the bed, " + why + " do not stand it";
  for (Outline* outline : outlines_of(slab)) {
    const bool outer = outline == &slab.outer;
    const Outline before = *outline, after = chamfered(before, outer, {depth, height_mm}, profiles);
    for (Slab& other : part.slabs)  // walls that run through
      for (Outline* same : outlines_of(other))
        if (same_outline(*same, before)) *same = after;
  }
  if (!why.empty())
    return part.name + ": the chamfer at the bed is " + printed_number(um_from_mm(depth), "%.4g") +
           " um deep instead of " + asked + ", " + why + " do not stand more" +
           (teeth.empty() ? "" : "; " + teeth);
  if (!teeth.empty()) return teeth;
  return std::nullopt;
}

double bed_depth_mm(const PartShape& part) {
  double deepest = 0.0;
  for (Slab slab : part.slabs)
    for (const Outline* outline : outlines_of(slab)) {
      if (const auto* toothed = std::get_if<ToothedOutline>(outline);
          toothed != nullptr && toothed->bed)
        deepest = std::max(deepest, toothed->bed->deepest_mm());
      if (const auto* circle = std::get_if<CircleOutline>(outline))
        deepest = std::max(deepest, std::abs(circle->bed.grow_mm));
      if (const auto* bore = std::get_if<BoreOutline>(outline))
        deepest = std::max(deepest, std::abs(bore->bed.grow_mm));
    }
  return deepest;
}

}  // namespace trueflank
