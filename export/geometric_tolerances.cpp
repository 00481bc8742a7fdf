// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/geometric_tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/geometry/flank_tolerance.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/fit_class.h"

namespace trueflank::io {
namespace {

constexpr double kLeastFace_mm = 0.01;  // faces smaller than that asks do not guide: the bore does
constexpr double kGearLean = 0.2;       // of the helix tolerance
constexpr double kFrameLean =
    0.5;  // of what carries gears: the share of ISO/TR 10064-3 for parallel axes
constexpr int kSeatForm = 5, kAxisGrade = 7;  // grades of ISO 286
constexpr double kOne_um = 1e-3, kTen_um = 1e-2;

double rounded_down(double value_mm, double step_mm) {
  return step_mm * std::floor(value_mm / step_mm + 1e-6);
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

class Tolerances {
 public:
  Tolerances(const GearTrain& train, const PartShape& part, const PartDimensions& dimensions,
             const Workmanship& made)
      : train_(train), part_(part), dimensions_(dimensions), made_(made) {}

  std::vector<GeometricTolerance> all() {
    if (!dimensions_.datum()) return {};
    const auto gears = gears_of(train_, part_);
    for (const TrainGear* gear : gears) add_tips(*gear);
    add_faces(gears);
    add_seats();
    add_holes();
    return std::move(all_);
  }

 private:
  [[nodiscard]] Result<FlankTolerances> flanks(const TrainGear& gear) const {
    return flank_tolerances(tolerance_size(gear.profile.gear(), gear.face_width_mm),
                            made_.flank_class);
  }

  void add_tips(const TrainGear& gear) {
    double value = made_.runout_mm;
    if (made_.flank_class > 0)
      if (const auto limits = flanks(gear)) value = limits->runout_um / 1000.0;
    if (std::isnan(value)) return;
    const auto [low, high] = reach_of(part_, gear);
    all_.push_back(
        {.value_mm = value, .datum = 'A', .gear = &gear, .z_lower_mm = low, .z_upper_mm = high});
  }

  /// A face that runs out by t leans by t / D and tilts teeth of width b by t b / D.
  [[nodiscard]] double face_runout_mm(const std::vector<const TrainGear*>& gears,
                                      double share) const {
    const double diameter = 2.0 * extent(part_.slabs.back().outer).outer_radius_mm;
    double least = kNaN;
    for (const TrainGear* gear : gears)
      if (const auto limits = flanks(*gear)) {
        const double value = rounded_down(
            share * limits->total_helix_um / 1000.0 * diameter / gear->face_width_mm, kOne_um);
        least = std::fmin(least, std::max(kLeastFace_mm, value));
      }
    return least;
  }

  void add_faces(const std::vector<const TrainGear*>& own) {
    const double lower = part_.slabs.front().z_lower_mm, upper = part_.slabs.back().z_upper_mm;
    const auto add = [&](ToleranceKind kind, ToleratedFeature feature, double z, double value,
                         char datum) {
      all_.push_back({.kind = kind,
                      .feature = feature,
                      .value_mm = value,
                      .datum = datum,
                      .z_lower_mm = z,
                      .z_upper_mm = z});
    };
    const double without_class = own.empty() ? kNaN : made_.runout_mm;
    const double by_class =
        made_.flank_class > 0
            ? face_runout_mm(own.empty() ? framed() : own, own.empty() ? kFrameLean : kGearLean)
            : kNaN;
    const double value = std::isnan(by_class) ? without_class : by_class;
    if (std::isnan(value)) return;
    add(ToleranceKind::kCircularRunout, ToleratedFeature::kUpperFace, upper, value, 'A');
    if (std::isnan(by_class)) return;
    add(ToleranceKind::kFlatness, ToleratedFeature::kUpperFace, upper, value, 0);
    add(ToleranceKind::kParallelism, ToleratedFeature::kLowerFace, lower, value, 'B');
  }

  /// All gears, for what carries them: carriers and casings with holes. Pins guide by their
  /// cylinders.
  [[nodiscard]] std::vector<const TrainGear*> framed() const {
    std::vector<const TrainGear*> gears;
    const bool frame = part_.role == PartRole::kCarrier || part_.role == PartRole::kCasing ||
                       part_.role == PartRole::kOutput;
    if (!frame || dimensions_.holes.empty()) return gears;
    for (const TrainGear& gear : train_.gears) gears.push_back(&gear);
    return gears;
  }

  void add_seats() {
    for (const PartDiameter& d : dimensions_.diameters) {
      if (d.limits.fit.empty() || d.diameter_mm > kLargestFit_mm) continue;
      const double form = 0.5 * standard_tolerance_mm(kSeatForm, d.diameter_mm);
      GeometricTolerance tolerance{.kind = ToleranceKind::kCylindricity,
                                   .feature = ToleratedFeature::kSeat,
                                   .value_mm = form,
                                   .z_lower_mm = d.z_mm,
                                   .z_upper_mm = d.z_mm,
                                   .diameter_mm = d.diameter_mm,
                                   .made_mm = d.made_mm,
                                   .hole = d.hole};
      all_.push_back(tolerance);
      if (d.datum) continue;
      tolerance.kind = ToleranceKind::kTotalRunout;
      tolerance.datum = 'A';
      all_.push_back(tolerance);
    }
  }

  void add_holes() {
    for (std::size_t i = 0; i < dimensions_.holes.size(); ++i) {
      const HolePattern& holes = dimensions_.holes[i];
      double value = rounded_down(0.5 * holes.use.play_mm, kTen_um);
      const double from_axis = 0.5 * holes.circle_diameter_mm;
      if (holes.use.carries_axis)
        value = !std::isnan(made_.axis_mm)    ? 2.0 * made_.axis_mm
                : from_axis <= kLargestFit_mm ? standard_tolerance_mm(kAxisGrade, from_axis)
                                              : kNaN;
      if (value > 0.0)
        all_.push_back({.kind = ToleranceKind::kPosition,
                        .feature = ToleratedFeature::kHoles,
                        .value_mm = value,
                        .datum = 'A',
                        .pattern = i});
    }
  }

  const GearTrain& train_;
  const PartShape& part_;
  const PartDimensions& dimensions_;
  const Workmanship& made_;
  std::vector<GeometricTolerance> all_;
};

}  // namespace

const char* to_text(ToleranceKind kind) {
  switch (kind) {
    case ToleranceKind::kCircularRunout:
      return "circular_runout";
    case ToleranceKind::kTotalRunout:
      return "total_runout";
    case ToleranceKind::kFlatness:
      return "flatness";
    case ToleranceKind::kParallelism:
      return "parallelism";
    case ToleranceKind::kCylindricity:
      return "cylindricity";
    case ToleranceKind::kPosition:
      return "position";
  }
  return "";
}

std::vector<GeometricTolerance> geometric_tolerances(const GearTrain& train, const PartShape& part,
                                                     const PartDimensions& dimensions,
                                                     const Workmanship& made) {
  return Tolerances(train, part, dimensions, made).all();
}

}  // namespace trueflank::io
