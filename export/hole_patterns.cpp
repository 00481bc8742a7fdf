// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/hole_patterns.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/export/part_dimensions.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank::io {
namespace {

bool same(double a, double b) { return std::abs(a - b) < tolerance::kSameSize_mm; }

struct Stack {
  Point2 centre;
  std::vector<HoleStep> steps;
};

bool is_mark(const PartShape& part, const Slab& slab, const CircleOutline& circle) {
  return &slab == &part.slabs.back() &&
         std::any_of(part.marks.begin(), part.marks.end(), [&](const CircleOutline& mark) {
           return (mark.centre - circle.centre).norm() < tolerance::kSameSize_mm &&
                  same(mark.radius_mm, circle.radius_mm);
         });
}

/// Holes of one centre that follow each other without a floor between.
std::vector<Stack> stacks_of(const PartShape& part) {
  std::vector<Stack> stacks;
  for (const Slab& slab : part.slabs)
    for (const Outline& outline : slab.holes) {
      const auto* circle = std::get_if<CircleOutline>(&outline);
      if (!circle || circle->centre.norm() < tolerance::kSameSize_mm || is_mark(part, slab, *circle)) continue;
      const auto below = std::find_if(stacks.begin(), stacks.end(), [&](const Stack& s) {
        return (s.centre - circle->centre).norm() < tolerance::kSameSize_mm &&
               same(s.steps.back().z_upper_mm, slab.z_lower_mm);
      });
      const HoleStep step{.diameter_mm = 2.0 * circle->radius_mm,
                          .z_lower_mm = slab.z_lower_mm,
                          .z_upper_mm = slab.z_upper_mm};
      if (below == stacks.end())
        stacks.push_back({circle->centre, {step}});
      else if (same(below->steps.back().diameter_mm, step.diameter_mm))
        below->steps.back().z_upper_mm = step.z_upper_mm;
      else
        below->steps.push_back(step);
    }
  return stacks;
}

/// Whether the slab that ends (or begins) at a height has material at a place: a pocket about the
/// axis has none.
bool material_at(const PartShape& part, const Point2& p, double z_mm, bool below) {
  for (const Slab& slab : part.slabs) {
    if (!same(below ? slab.z_upper_mm : slab.z_lower_mm, z_mm)) continue;
    const OutlineExtent outer = extent(slab.outer);
    if ((p - outer.centre).norm() > outer.outer_radius_mm) return false;
    return std::none_of(slab.holes.begin(), slab.holes.end(), [&](const Outline& hole) {
      const OutlineExtent size = extent(hole);
      return (p - size.centre).norm() < size.outer_radius_mm;
    });
  }
  return false;
}

/// What makes two stacks the same tools on the same circle, in 1e-4 mm.
std::vector<long> key_of(const Stack& stack) {
  std::vector<long> key = {std::lround(2e4 * stack.centre.norm())};
  for (const HoleStep& step : stack.steps)
    for (double value : {step.diameter_mm, step.z_lower_mm, step.z_upper_mm})
      key.push_back(std::lround(1e4 * value));
  return key;
}

double angle_of(const Point2& p) {
  const double a = wrapped_rad(std::atan2(p.y(), p.x()));
  return a > kTwoPi - 1e-9 ? 0.0 : a;
}

bool equal_angles(const std::vector<Point2>& centres) {
  const double step = kTwoPi / static_cast<double>(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i)
    if (std::abs(angle_of(centres[i]) - angle_of(centres[0]) - step * static_cast<double>(i)) >
        1e-6)
      return false;
  return centres.size() > 1;
}

std::string degrees(const Point2& centre) {
  return drawing_number(deg_from_rad(angle_of(centre)), 3);
}

}  // namespace

std::vector<HolePattern> hole_patterns(const PartShape& part) {
  std::map<std::vector<long>, HolePattern> patterns;
  for (const Stack& stack : stacks_of(part)) {
    HolePattern& pattern = patterns[key_of(stack)];
    pattern.steps = stack.steps;
    pattern.open_below = !material_at(part, stack.centre, stack.steps.front().z_lower_mm, true);
    pattern.open_above = !material_at(part, stack.centre, stack.steps.back().z_upper_mm, false);
    pattern.circle_diameter_mm = 2.0 * stack.centre.norm();
    pattern.centres.push_back(stack.centre);
  }
  std::vector<HolePattern> all;
  for (auto& [key, pattern] : patterns) {
    std::sort(pattern.centres.begin(), pattern.centres.end(),
              [](const Point2& a, const Point2& b) { return angle_of(a) < angle_of(b); });
    pattern.equally_spaced = equal_angles(pattern.centres);
    all.push_back(std::move(pattern));
  }
  return all;
}

std::vector<std::string> hole_words(const HolePattern& pattern) {
  std::vector<std::string> words;
  const auto add = [&](const HoleStep& step, const std::string& rest) {
    words.push_back(
        "Ø" + drawing_number(std::isnan(step.drawn_mm) ? step.diameter_mm : step.drawn_mm, 3) +
        limits_text(step.limits) + rest);
  };
  const auto depth = [](double mm) { return " x " + drawing_number(mm, 3) + " deep"; };
  const auto& steps = pattern.steps;
  // the narrowest goes from face to face; what is wider is sunk from its side
  const auto least = std::min_element(
      steps.begin(), steps.end(),
      [](const HoleStep& a, const HoleStep& b) { return a.diameter_mm < b.diameter_mm; });
  if (pattern.open_below && pattern.open_above) add(*least, " through");
  for (auto step = steps.begin(); step != steps.end(); ++step) {
    if (pattern.open_below && pattern.open_above && step == least) continue;
    const bool from_left = pattern.open_below && (step < least || !pattern.open_above);
    if (from_left)
      add(*step, depth(step->z_upper_mm - steps.front().z_lower_mm) + " from the left");
    else if (pattern.open_above)
      add(*step, depth(steps.back().z_upper_mm - step->z_lower_mm) + " from the right");
    else
      add(*step, ", " + drawing_number(step->depth_mm(), 3) + " long, inside");
  }
  return words;
}

std::vector<std::string> place_words(const HolePattern& pattern) {
  const auto number = [](double value) {
    return drawing_number(std::abs(value) < 5e-4 ? 0.0 : value, 3);
  };
  if (pattern.centres.size() == 1)
    return {"x " + number(pattern.centres[0].x()) + ", y " + number(pattern.centres[0].y())};
  const std::string about = "on Ø" + drawing_number(pattern.circle_diameter_mm, 3);
  if (pattern.equally_spaced)
    return {"equally spaced " + about, "first at " + degrees(pattern.centres[0]) + " deg from x"};
  std::string angles = "at ";
  for (std::size_t i = 0; i < pattern.centres.size(); ++i)
    angles += (i == 0 ? "" : ", ") + degrees(pattern.centres[i]);
  return {about, angles + " deg from x"};
}

}  // namespace trueflank::io
