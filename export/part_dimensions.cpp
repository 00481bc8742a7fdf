// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/part_dimensions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "trueflank/export/number_text.h"
#include "trueflank/geometry/flank_tolerance.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank::io {
namespace {

using SizeTable = std::vector<std::pair<double, double>>;  // up to this size [mm], value

double at_size(const SizeTable& table, double size_mm) {
  for (const auto& [upto_mm, value] : table)
    if (size_mm <= upto_mm) return value;
  return kNaN;
}

/// Limits of a class of ISO 286-1; of a size beyond them the general ones.
SizeLimits class_limits(const std::string& fit, double diameter_mm) {
  const auto limits = fit_limits(fit, diameter_mm);
  if (!limits) return general_limits(diameter_mm);
  return {.lower_mm = limits->lower_mm, .upper_mm = limits->upper_mm, .fit = fit};
}

/// A size of which a gearbox has a fitted seat or journal.
struct FittedSize {
  double made_mm = 0.0, nominal_mm = 0.0;
  bool hole = true;
  std::string fit = {};  ///< its class
};

/// What fits: bores of parts that are not printed, and the seats and journals of a gearbox as far as they have classes.
struct FittedSizes {
  bool bores = false;
  std::vector<FittedSize> sizes = {};

  [[nodiscard]] const FittedSize* find(double diameter_mm, bool hole) const {
    const auto found = std::find_if(sizes.begin(), sizes.end(), [&](const FittedSize& size) {
      return size.hole == hole && std::abs(size.made_mm - diameter_mm) < 1e-6;
    });
    return found == sizes.end() ? nullptr : &*found;
  }
};

FittedSizes fitted_sizes(const GearTrain& train) {
  if (additive(train)) return {};
  FittedSizes fitted{.bores = true};
  const auto& machine = train.design.machine;
  if (!machine) return fitted;
  const auto add = [&](double nominal_mm, double made_mm, bool hole, const std::string& fit) {
    if (fit_limits(fit, nominal_mm)) fitted.sizes.push_back({made_mm, nominal_mm, hole, fit});
  };
  const auto seat = [&](const SeatFit& fit, double size_mm) { add(size_mm, fit.hole_mm(size_mm), true, fit.hole); };
  const auto journal = [&](const SeatFit& fit, double size_mm) { add(size_mm, fit.shaft_mm(size_mm), false, fit.shaft); };
  const SeatFits fits = seat_fits(*machine);
  const BearingsDesign& bearings = machine->bearings;
  seat(fits.shaft, machine->motor.shaft_diameter_mm);
  seat(fits.pilot, machine->motor.pilot_diameter_mm);
  seat(fits.output, bearings.output.outer_mm);
  journal(fits.output, bearings.output.bore_mm);
  if (bearings.planet) seat(fits.planet, bearings.planet->outer_mm);
  if (bearings.wheel) {
    seat(fits.wheel, bearings.wheel->outer_mm);
    journal(fits.wheel, bearings.wheel->bore_mm);
  }
  const auto layout = machine_layout(train);
  const bool pair = layout->wheel_gear >= 0;
  const SeatFit& ring = pair ? fits.rim : fits.ring;
  const double ring_mm = 2.0 * (pair ? layout->cavity_radius_mm : layout->ring_radius_mm);
  seat(ring, ring_mm);
  journal(ring, ring_mm);
  if (!pair) seat(fits.pin, layout->carrier.pin_diameter_mm);
  return fitted;
}

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
std::optional<PartDiameter> diameter_of(const Outline& outline, bool hole, const FittedSizes& fitted) {
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
  const bool of_class = d.bore && d.bore->kind != BoreKind::kHex && fitted.bores;
  d.limits = of_class ? class_limits(kSeatClass, d.diameter_mm) : general_limits(d.diameter_mm);
  if (const FittedSize* size = d.tip ? nullptr : fitted.find(d.diameter_mm, hole)) {
    d.diameter_mm = size->nominal_mm;  // drawings give the nominal size and its class
    d.limits = class_limits(size->fit, size->nominal_mm);
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
  std::stable_sort(diameters.begin(), diameters.end(), [](const auto& a, const auto& b) {
    return a.diameter_mm < b.diameter_mm;
  });
  return diameters;
}

void choose_datum(std::vector<PartDiameter>& diameters, Teeth teeth) {
  if (teeth == Teeth::kInner) {
    if (!diameters.empty() && !diameters.back().tip) diameters.back().datum = true;
    return;
  }
  const auto of_hole = std::find_if(diameters.begin(), diameters.end(),
                                    [](const PartDiameter& d) { return d.hole && !d.tip; });
  const auto chosen = of_hole == diameters.end() && teeth == Teeth::kNone ? diameters.begin() : of_hole;
  if (chosen != diameters.end()) chosen->datum = true;
}

std::vector<PartWidth> widths_of(const PartShape& part) {
  std::vector<PartWidth> widths;
  const auto add = [&](double from, double to) {
    widths.push_back({.z_lower_mm = from, .z_upper_mm = to, .limits = general_limits(to - from)});
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
std::vector<PartWidth> depths_of(const PartShape& part, const std::vector<PartWidth>& widths) {
  struct Bore {
    double diameter_mm = 0.0;
    PartWidth reach;
  };
  std::vector<Bore> bores;
  for (const Slab& slab : part.slabs)
    for (const Outline& hole : slab.holes) {
      const auto d = diameter_of(hole, true, {});
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
      return std::abs(w.z_lower_mm - bore.reach.z_lower_mm) < 1e-9 && std::abs(w.z_upper_mm - bore.reach.z_upper_mm) < 1e-9;
    };
    if (std::any_of(widths.begin(), widths.end(), is_it) || std::any_of(depths.begin(), depths.end(), is_it)) continue;
    bore.reach.limits = general_limits(bore.reach.width_mm());
    depths.push_back(bore.reach);
  }
  return depths;
}

std::vector<BoltCircle> bolt_circles_of(const std::vector<HolePattern>& patterns, const FittedSizes& fitted) {
  std::map<std::pair<long, long>, BoltCircle> groups;  // by both diameters in 1e-4 mm
  for (const HolePattern& pattern : patterns)
    for (const HoleStep& step : pattern.steps) {
      BoltCircle& group = groups[{std::lround(1e4 * step.diameter_mm), std::lround(1e4 * pattern.circle_diameter_mm)}];
      const FittedSize* size = fitted.find(step.diameter_mm, true);
      group = {size ? size->nominal_mm : step.diameter_mm, pattern.circle_diameter_mm,
               group.count + static_cast<int>(pattern.centres.size()),
               size ? class_limits(size->fit, size->nominal_mm) : general_limits(step.diameter_mm)};
    }
  std::vector<BoltCircle> circles;
  for (const auto& [key, circle] : groups) circles.push_back(circle);
  return circles;
}

/// Where a gear's teeth are in the part.
std::pair<double, double> reach_of(const PartShape& part, const TrainGear& gear) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto look = [&](const Slab& slab, const Outline& outline) {
    const auto* teeth = std::get_if<ToothedOutline>(&outline);
    if (!teeth || teeth->profile != &gear.profile) return;
    low = std::min(low, slab.z_lower_mm);
    high = std::max(high, slab.z_upper_mm);
  };
  for (const Slab& slab : part.slabs) {
    look(slab, slab.outer);
    for (const Outline& hole : slab.holes) look(slab, hole);
  }
  return {low, high};
}

/// A face that runs out by t leans by t / D and tilts teeth of width b by t b / D: a fifth of the
/// helix tolerance, to whole micrometres. Faces smaller than that asks 10 um of do not guide: the bore
/// does.
FaceRunout face_runout_of(const PartShape& part, const TrainGear& gear, double total_helix_um) {
  const double diameter = 2.0 * extent(part.slabs.back().outer).outer_radius_mm;
  const double um = 0.2 * total_helix_um * diameter / gear.face_width_mm;
  return {part.slabs.back().z_upper_mm, std::max(10.0, std::floor(um)) / 1000.0};
}

}  // namespace

const PartDiameter* PartDimensions::datum() const {
  const auto found = std::find_if(diameters.begin(), diameters.end(),
                                  [](const PartDiameter& d) { return d.datum; });
  return found == diameters.end() ? nullptr : &*found;
}

PartDimensions part_dimensions(const GearTrain& train, const PartShape& part, int tolerance_class) {
  const FittedSizes fitted = fitted_sizes(train);
  PartDimensions dimensions{.diameters = diameters_of(part, fitted), .widths = widths_of(part), .holes = hole_patterns(part)};
  dimensions.depths = depths_of(part, dimensions.widths);
  dimensions.bolt_circles = bolt_circles_of(dimensions.holes, fitted);
  choose_datum(dimensions.diameters, teeth_of(part));
  if (!dimensions.datum()) return dimensions;
  for (const TrainGear* gear : gears_of(train, part)) {
    const auto limits = flank_tolerances(tolerance_size(gear->profile.gear(), gear->face_width_mm),
                                         tolerance_class);
    if (!limits) continue;
    const auto [low, high] = reach_of(part, *gear);
    dimensions.tip_runouts.push_back({gear, low, high, limits->runout_um / 1000.0});
    const FaceRunout face = face_runout_of(part, *gear, limits->total_helix_um);
    if (!dimensions.face_runout || face.value_mm < dimensions.face_runout->value_mm)
      dimensions.face_runout = face;
  }
  return dimensions;
}

SizeLimits general_limits(double size_mm) {
  // ISO 2768-1:1989, table 1, class m
  static const SizeTable kMedium_mm = {{6, 0.1},    {30, 0.2},   {120, 0.3}, {400, 0.5},
                                       {1000, 0.8}, {2000, 1.2}, {4000, 2.0}};
  constexpr double kSmallest_mm = 0.5;
  const double either_mm = size_mm < kSmallest_mm ? kNaN : at_size(kMedium_mm, size_mm);
  return {.lower_mm = -either_mm, .upper_mm = either_mm};
}

std::string drawing_number(double value, int decimals) {
  if (std::isnan(value)) return "-";
  const double unit = std::pow(10.0, decimals);
  std::string text;
  append_decimal(text, std::round(value * unit) / unit);
  return text;
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

bool additive(const GearTrain& train) {
  return train.design.made.process && train.design.made.process->layer_mm > 0.0;
}

}  // namespace trueflank::io
