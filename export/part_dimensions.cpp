// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/part_dimensions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "trueflank/export/fitted_sizes.h"
#include "trueflank/export/number_text.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank::io {
namespace {

bool is_toothed(const Outline& outline) { return std::holds_alternative<ToothedOutline>(outline); }

enum class Teeth { kNone, kOuter, kInner };
Teeth teeth_of(const PartShape& part) {
  Teeth teeth = Teeth::kNone;
  for (const Slab& slab : part.slabs) {
    if (is_toothed(slab.outer)) return Teeth::kOuter;
    if (std::any_of(slab.holes.begin(), slab.holes.end(), is_toothed)) teeth = Teeth::kInner;
  }
  return teeth;
}

bool same_outer(const Outline& a, const Outline& b) {
  return a.index() == b.index() &&
         std::abs(extent(a).outer_radius_mm - extent(b).outer_radius_mm) < 1e-9;
}

/// A circle about the axis, the tips of a toothing, or a bore.
std::optional<PartDiameter> diameter_of(const Outline& outline, bool hole,
                                        const FittedSizes& fitted) {
  PartDiameter d{.hole = hole};
  if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
    d.diameter_mm = 2.0 * teeth->profile->tip_radius_mm();
    d.tip = true;
  } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
    if (circle->centre.norm() > 1e-9) return std::nullopt;
    d.diameter_mm = 2.0 * circle->radius_mm;
  } else {
    if (!hole) return std::nullopt;
    d.bore = std::get<BoreOutline>(outline).bore;
    d.diameter_mm = d.bore->diameter_mm;
  }
  d.made_mm = d.diameter_mm;
  d.limits = general_limits(fitted.made(), d.diameter_mm, SizeDirection::kAcross);
  if (d.bore && d.bore->kind != BoreKind::kHex) d.limits = fitted.limits(kSeatClass, d.diameter_mm);
  if (const FittedSize* size = d.tip ? nullptr : fitted.find(d.diameter_mm, hole)) {
    d.diameter_mm = size->drawn_mm;
    d.limits = fitted.limits(*size);
    d.seat = true;
  }
  return d;
}

std::vector<PartDiameter> diameters_of(const PartShape& part, const FittedSizes& fitted) {
  std::vector<PartDiameter> diameters;
  std::set<long> seen;  // in 1e-4 mm
  const auto add = [&](const Outline& outline, const Slab& slab, bool hole) {
    auto diameter = diameter_of(outline, hole, fitted);
    if (!diameter || !seen.insert(std::lround(diameter->diameter_mm * 1e4)).second) return;
    diameter->z_mm = slab.z_lower_mm;
    diameters.push_back(std::move(*diameter));
  };
  for (const Slab& slab : part.slabs) {
    add(slab.outer, slab, false);
    for (const Outline& hole : slab.holes) add(hole, slab, true);
  }
  std::stable_sort(diameters.begin(), diameters.end(),
                   [](const auto& a, const auto& b) { return a.diameter_mm < b.diameter_mm; });
  return diameters;
}

void choose_datum(std::vector<PartDiameter>& diameters, Teeth teeth) {
  if (teeth == Teeth::kInner) {
    if (!diameters.empty() && !diameters.back().tip) diameters.back().datum = true;
    return;
  }
  const auto is_hole = [](const PartDiameter& d) { return d.hole && !d.tip; };
  auto of_hole = std::find_if(diameters.begin(), diameters.end(),
                              [&](const PartDiameter& d) { return is_hole(d) && d.seat; });
  if (of_hole == diameters.end())
    of_hole = std::find_if(diameters.begin(), diameters.end(), is_hole);
  if (teeth != Teeth::kNone) {
    if (of_hole != diameters.end()) of_hole->datum = true;
    return;
  }
  const auto largest_seat = std::find_if(diameters.rbegin(), diameters.rend(),
                                         [](const PartDiameter& d) { return d.seat; });
  if (largest_seat != diameters.rend())
    largest_seat->datum = true;
  else if (!diameters.empty())
    diameters.back().datum = true;
}

std::vector<PartWidth> widths_of(const PartShape& part, const Workmanship& made) {
  std::vector<PartWidth> widths;
  const auto add = [&](double from, double to) {
    widths.push_back({.z_lower_mm = from,
                      .z_upper_mm = to,
                      .limits = general_limits(made, to - from, SizeDirection::kAlong)});
  };
  double from = part.slabs.front().z_lower_mm;
  for (std::size_t i = 0; i < part.slabs.size(); ++i) {
    if (i + 1 < part.slabs.size() && same_outer(part.slabs[i].outer, part.slabs[i + 1].outer))
      continue;
    add(from, part.slabs[i].z_upper_mm);
    from = part.slabs[i].z_upper_mm;
  }
  if (widths.size() > 1) add(part.slabs.front().z_lower_mm, part.slabs.back().z_upper_mm);
  return widths;
}

/// Heights of bores about the axis, where they end inside the part.
std::vector<PartWidth> depths_of(const PartShape& part, const std::vector<PartWidth>& widths,
                                 const FittedSizes& fitted) {
  struct Bore {
    double diameter_mm = 0.0;
    PartWidth reach;
  };
  std::vector<Bore> bores;
  for (const Slab& slab : part.slabs)
    for (const Outline& hole : slab.holes) {
      const auto d = diameter_of(hole, true, fitted);
      if (!d) continue;
      if (!bores.empty() && std::abs(bores.back().diameter_mm - d->diameter_mm) < 1e-9 &&
          std::abs(bores.back().reach.z_upper_mm - slab.z_lower_mm) < 1e-9)
        bores.back().reach.z_upper_mm = slab.z_upper_mm;
      else
        bores.push_back({d->diameter_mm, {slab.z_lower_mm, slab.z_upper_mm, {}}});
    }
  std::vector<PartWidth> depths;
  for (Bore& bore : bores) {
    const auto is_it = [&](const PartWidth& w) {
      return std::abs(w.z_lower_mm - bore.reach.z_lower_mm) < 1e-9 &&
             std::abs(w.z_upper_mm - bore.reach.z_upper_mm) < 1e-9;
    };
    if (std::any_of(widths.begin(), widths.end(), is_it) ||
        std::any_of(depths.begin(), depths.end(), is_it))
      continue;
    bore.reach.limits = general_limits(fitted.made(), bore.reach.width_mm(), SizeDirection::kAlong);
    depths.push_back(bore.reach);
  }
  return depths;
}

std::vector<BoltCircle> bolt_circles_of(const std::vector<HolePattern>& patterns,
                                        const FittedSizes& fitted) {
  std::map<std::pair<long, long>, BoltCircle> groups;  // by both diameters in 1e-4 mm
  for (const HolePattern& pattern : patterns)
    for (const HoleStep& step : pattern.steps) {
      BoltCircle& group = groups[{std::lround(1e4 * step.diameter_mm),
                                  std::lround(1e4 * pattern.circle_diameter_mm)}];
      const FittedSize* size = fitted.find(step.diameter_mm, true);
      group = {size ? size->drawn_mm : step.diameter_mm, pattern.circle_diameter_mm,
               step.diameter_mm, group.count + static_cast<int>(pattern.centres.size()),
               size ? fitted.limits(*size)
                    : general_limits(fitted.made(), step.diameter_mm, SizeDirection::kAcross)};
    }
  std::vector<BoltCircle> circles;
  for (const auto& [key, circle] : groups) circles.push_back(circle);
  return circles;
}

}  // namespace

const PartDiameter* PartDimensions::datum() const {
  const auto found = std::find_if(diameters.begin(), diameters.end(),
                                  [](const PartDiameter& d) { return d.datum; });
  return found == diameters.end() ? nullptr : &*found;
}

std::vector<GeometricTolerance> PartDimensions::of(ToleratedFeature feature) const {
  std::vector<GeometricTolerance> found;
  for (const GeometricTolerance& t : tolerances)
    if (t.feature == feature) found.push_back(t);
  return found;
}

PartDimensions part_dimensions(const GearTrain& train, const PartShape& part) {
  const FittedSizes fitted(train);
  PartDimensions dimensions{.diameters = diameters_of(part, fitted),
                            .widths = widths_of(part, fitted.made()),
                            .holes = hole_patterns(part)};
  // a bore between the seats of bearings holds nothing itself
  const auto& all = dimensions.diameters;
  if (std::any_of(all.begin(), all.end(), [](const PartDiameter& d) { return d.seat && d.hole; }))
    for (PartDiameter& d : dimensions.diameters)
      if (d.bore && !d.seat)
        d.limits = general_limits(fitted.made(), d.diameter_mm, SizeDirection::kAcross);
  for (HolePattern& holes : dimensions.holes) {
    holes.use = hole_use(train, holes);
    for (HoleStep& step : holes.steps) {
      const FittedSize* size = fitted.find(step.diameter_mm, true);
      step.drawn_mm = size ? size->drawn_mm : step.diameter_mm;
      step.limits = size ? fitted.limits(*size)
                         : general_limits(fitted.made(), step.diameter_mm, SizeDirection::kAcross);
      holes.use.carries_axis = holes.use.carries_axis || size != nullptr;
    }
  }
  dimensions.depths = depths_of(part, dimensions.widths, fitted);
  dimensions.bolt_circles = bolt_circles_of(dimensions.holes, fitted);
  choose_datum(dimensions.diameters, teeth_of(part));
  dimensions.tolerances = geometric_tolerances(train, part, dimensions, fitted.made());
  return dimensions;
}

std::string drawing_number(double value, int decimals) {
  if (std::isnan(value)) return "-";
  const double unit = std::pow(10.0, decimals);
  std::string text;
  append_decimal(text, std::round(value * unit) / unit);
  return text;
}

std::string limits_text(const SizeLimits& limits) {
  const auto with_sign = [](double value_mm) {
    return (value_mm > 0.0 ? "+" : "") + drawing_number(value_mm, 3);
  };
  if (!limits.fit.empty())
    return " " + limits.fit + " (" + with_sign(limits.upper_mm) + " / " +
           with_sign(limits.lower_mm) + ")";
  return limits.stated ? " ±" + drawing_number(limits.upper_mm, 3) : std::string();
}

std::string bore_shape_text(const BoreDesign& bore) {
  if (bore.kind == BoreKind::kDFlat) return "flat " + drawing_number(bore.d_flat_mm, 3);
  if (bore.kind == BoreKind::kKeyway)
    return "keyway " + drawing_number(bore.keyway_width_mm, 3) + " x " +
           drawing_number(bore.keyway_depth_mm, 3);
  return {};
}

std::vector<const TrainGear*> gears_of(const GearTrain& train, const PartShape& part) {
  std::vector<const TrainGear*> gears;
  const auto add = [&](const Outline& outline) {
    const auto* teeth = std::get_if<ToothedOutline>(&outline);
    if (!teeth) return;
    for (const TrainGear& gear : train.gears)
      if (&gear.profile == teeth->profile &&
          std::find(gears.begin(), gears.end(), &gear) == gears.end())
        gears.push_back(&gear);
  };
  for (const Slab& slab : part.slabs) {
    add(slab.outer);
    for (const Outline& hole : slab.holes) add(hole);
  }
  return gears;
}

}  // namespace trueflank::io
