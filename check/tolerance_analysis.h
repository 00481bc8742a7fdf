// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

// What errors of manufacture leave of backlash and clearance.
namespace trueflank {

/// What the parts are allowed to be; every figure is a half width (+-) but runout and pitch, which are
/// the standard's totals.
struct ToleranceOptions {
  double centre_distance_um = 0.0;    ///< +-, of each planet's axis (of the pair's)
  double tooth_thickness_um = 0.0;    ///< +-, on the reference circle, of each gear
  std::optional<double> runout_um;    ///< F_r of each gear; twice its eccentricity
  std::optional<double> pitch_um;     ///< f_p of each gear
  std::optional<int> tolerance_class; ///< ISO 1328-1:2013: runout and pitch where not given
  int sets = 20000;                   ///< sets of parts drawn for the share that jams
  std::uint64_t seed = 1;
};

/// A text as the command line takes it: a class ("7"), or any of centre_distance_um=, tooth_thickness_um=,
/// runout_um=, pitch_um=, class=, separated by commas. Errors: kUsage, with the part that is wrong.
[[nodiscard]] Result<ToleranceOptions> parse_tolerance(const std::string& text);

struct MeshTolerance {
  double nominal_backlash_mm = kNaN;
  double smallest_backlash_mm = kNaN;   ///< all at their limits at once, at the worst rotation
  double smallest_clearance_mm = kNaN;  ///< of the real profiles then, over a mesh cycle
  double jam_share = kNaN;              ///< share of sets in which this mesh jams in any planet
};

struct ToleranceResult {
  std::vector<MeshTolerance> meshes;  ///< in the order of the train's
  double jam_share = kNaN;            ///< share of sets in which any mesh jams
  int sets = 0;
};

/// Worst case by the real profiles at the corners of the tolerance field; share by drawing sets: every
/// error normal with its tolerance at three standard deviations, cut off there; eccentricities meet
/// in their worst phase, as they do when the gears turn. A set jams where profiles penetrate with
/// their play centred. Clearances are interpolated between places of the field
/// (clearance/clearance_field.h). Of modified flanks the sections
/// that decide are turned at every corner, and backlash is the smallest over the face.
/// Errors: kOutOfRange where a gear is outside the scope of ISO 1328-1 (tolerance_class), for negative
/// tolerances, or where the parts at their limits do not exist.
[[nodiscard]] Result<ToleranceResult> analyse_tolerances(const GearTrain& train,
                                                         const ToleranceOptions& options);

/// `tolerance`, one finding a mesh and one of the train. Passes where even the worst case clears, warns
/// where at most 0.27 % of the sets jam, else fails.
[[nodiscard]] Findings check_tolerance(const GearTrain& train, const ToleranceResult& result);

}  // namespace trueflank
