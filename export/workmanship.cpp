// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/workmanship.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank::io {
namespace {

Making making_of(const Process& process) {
  if (process.layer_mm > 0.0) return Making::kPrinted;
  if (process.kerf_mm > 0.0) return Making::kCut;
  const bool formed = process.name == "moulding" || process.name == "sintering";
  return formed ? Making::kFormed : Making::kMachined;
}

double positive(double value) { return value > 0.0 ? value : kNaN; }

}  // namespace

Workmanship workmanship(const GearTrain& train) {
  const MadeDesign& made = train.design.made;
  Workmanship result;
  if (made.process) {
    const Process& process = *made.process;
    result = {.making = making_of(process),
              .process = process.name,
              .flank_class = process.tolerance_class,
              .thickness_mm = positive(process.thickness_tolerance_mm),
              .axis_mm = positive(process.axis_tolerance_mm),
              .runout_mm = positive(process.runout_mm),
              .layer_mm = process.layer_mm};
    if (result.flank_class == 0 && result.making == Making::kMachined)
      result.flank_class = kDrawingToleranceClass;
  }
  result.flank_class = made.tolerance_class.value_or(result.flank_class);
  result.axis_mm = made.axis_tolerance_mm.value_or(result.axis_mm);
  result.thickness_mm = made.thickness_tolerance_mm.value_or(result.thickness_mm);
  return result;
}

SizeLimits general_limits(double size_mm) {
  // ISO 2768-1:1989, table 1, class m
  static constexpr std::array<std::pair<double, double>, 7> kMedium_mm = {
      {{6, 0.1}, {30, 0.2}, {120, 0.3}, {400, 0.5}, {1000, 0.8}, {2000, 1.2}, {4000, 2.0}}};
  constexpr double kSmallest_mm = 0.5;
  const auto found = std::find_if(kMedium_mm.begin(), kMedium_mm.end(),
                                  [&](const auto& row) { return size_mm <= row.first; });
  const double either_mm =
      size_mm < kSmallest_mm || found == kMedium_mm.end() ? kNaN : found->second;
  return {.lower_mm = -either_mm, .upper_mm = either_mm};
}

SizeLimits general_limits(const Workmanship& made, double size_mm, SizeDirection direction) {
  if (made.making == Making::kFormed) return {};
  if (made.making != Making::kPrinted) return general_limits(size_mm);
  const double across_mm = std::round(1e3 * (made.thickness_mm + kPrintedShare * size_mm)) / 1e3;
  const double either_mm = direction == SizeDirection::kAlong ? made.layer_mm : across_mm;
  return {.lower_mm = -either_mm, .upper_mm = either_mm};
}

std::string general_tolerance_text(const Workmanship& made) {
  if (made.making == Making::kFormed) return "as agreed (" + made.process + ")";
  if (made.making != Making::kPrinted) return "ISO 2768-mK";
  const std::string layer = "height ±" + drawing_number(made.layer_mm, 3);
  if (std::isnan(made.thickness_mm)) return layer;
  return "±(" + drawing_number(made.thickness_mm, 3) + " + " +
         drawing_number(100.0 * kPrintedShare, 2) + " %), " + layer;
}

double roughness_um(double tolerance_um) {
  constexpr double kHeightOverMean = 6.0;  // Rz over Ra
  double ra = kGeneralRoughness_um;
  while (ra > 0.1 && kHeightOverMean * ra > tolerance_um) ra *= 0.5;
  return ra;
}

double seat_roughness_um(const std::string& fit) {
  constexpr double kCoarse_um = 1.6, kFine_um = 0.8;
  return !fit.empty() && fit.back() >= '4' && fit.back() <= '6' ? kFine_um : kCoarse_um;
}

double flank_roughness_um(const TrainGear& gear, const Workmanship& made) {
  if (made.flank_class == 0) return kNaN;
  const auto limits =
      flank_tolerances(tolerance_size(gear.profile.gear(), gear.face_width_mm), made.flank_class);
  return limits ? roughness_um(limits->profile_form_um) : kNaN;
}

std::string general_surface_text(const Workmanship& made) {
  if (made.making == Making::kFormed) return {};
  return made.making == Making::kPrinted ? "as printed"
                                         : "Ra " + drawing_number(kGeneralRoughness_um, 2);
}

std::string flank_surface_text(const TrainGear& gear, const Workmanship& made) {
  const double ra = flank_roughness_um(gear, made);
  if (!std::isnan(ra)) return drawing_number(ra, 2);
  switch (made.making) {
    case Making::kPrinted:
      return "as printed";
    case Making::kCut:
      return "as cut";
    case Making::kFormed:
      return {};
    case Making::kMachined:
      break;
  }
  return drawing_number(kGeneralRoughness_um, 2);
}

}  // namespace trueflank::io
