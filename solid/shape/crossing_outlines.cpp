// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/crossing_outlines.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

std::vector<OutlineExtent> circles_of(const Slab& slab) {
  std::vector<OutlineExtent> circles;
  const auto take = [&](const Outline& outline) {
    const OutlineExtent one = extent(outline);
    if (one.outer_radius_mm - one.inner_radius_mm < tolerance::kTouch_mm) circles.push_back(one);
  };
  take(slab.outer);
  for (const Outline& hole : slab.holes) take(hole);
  return circles;
}

/// Positive where two circles cross.
double depth_mm(const OutlineExtent& a, const OutlineExtent& b) {
  const double distance = (a.centre - b.centre).norm();
  return std::min(a.outer_radius_mm + b.outer_radius_mm - distance,
                  distance - std::abs(a.outer_radius_mm - b.outer_radius_mm));
}

}  // namespace

std::vector<OutlineCrossing> outline_crossings(const PartShape& part) {
  std::vector<OutlineCrossing> crossings;
  std::vector<OutlineExtent> below;
  for (const Slab& slab : part.slabs) {
    std::vector<OutlineExtent> here = circles_of(slab);
    const auto compare = [&](const OutlineExtent& a, const OutlineExtent& b) {
      if (const double depth = depth_mm(a, b); depth > tolerance::kTouch_mm)
        crossings.push_back({2.0 * a.outer_radius_mm, 2.0 * b.outer_radius_mm, depth, slab.z_lower_mm});
    };
    for (std::size_t i = 0; i < here.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) compare(here[i], here[k]);
      for (const OutlineExtent& other : below) compare(here[i], other);
    }
    below = std::move(here);
  }
  return crossings;
}

Errors crossing_outlines(const PartShapes& shapes) {
  Errors errors;
  for (const PartShape& part : shapes.parts) {
    const auto crossings = outline_crossings(part);
    if (crossings.empty()) continue;
    const OutlineCrossing& first = crossings.front();
    errors.push_back({.code = ErrorCode::kInfeasible,
                      .message = "part " + part.name + ": its outlines of " + fixed_mm(first.diameter1_mm) +
                                 " and " + fixed_mm(first.diameter2_mm) + " mm diameter cross at height " +
                                 fixed_mm(first.height_mm) + " mm: they bound no solid",
                      .key = part.name,
                      .remedy = "another bolt circle, smaller fasteners, or gears that leave more room"});
  }
  return errors;
}

}  // namespace trueflank
