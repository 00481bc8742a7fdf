// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/tooth_profile.h"
#include "trueflank/geometry/toothing.h"
#include "trueflank/train/gearbox_design.h"

// A design laid out: every shift, tip circle and thinning solved, every profile made, every body
// placed. Everything after this (checks, solids, files, report) reads only this.
namespace trueflank {

/// Circular thinning of the teeth on the reference circle, transverse, at both ends of a tolerance;
/// the gear itself has their mean.
struct ThinningLimits {
  double least_mm = 0.0;  ///< thickest tooth
  double most_mm = 0.0;   ///< thinnest tooth
  double upper_mm = 0.0, lower_mm = 0.0;  ///< the allowances they come from, normal section
};

/// A gear of the train.
struct TrainGear {
  std::string name;
  ToothProfile profile;
  double shift = 0.0;            ///< as solved
  double face_width_mm = 0.0;
  double z_lower_mm = 0.0;       ///< in the assembly: the lower face; layer 2 lies above layer 1
  int layer = 1;
  FaceTwist twist = {};             ///< in the gear's own frame
  FlankDeviation deviation = {};    ///< the design's modifications; empty: none
  double edge_chamfer_mm = 0.0;
  std::optional<ThinningLimits> thinning_limits = {};  ///< gears with a thickness allowance

  /// The tooth surface as designed; refers to this gear.
  [[nodiscard]] Toothing toothing() const {
    return {.profile = &profile, .twist = twist, .deviation = &deviation,
            .edge_chamfer_mm = edge_chamfer_mm};
  }
};

/// A mesh of the train: gear1 is the inner gear (sun, planet, pinion).
struct TrainMesh {
  std::string name;  ///< "sun-planet1", ...
  int gear1 = 0, gear2 = 0;             ///< indices into GearTrain::gears
  double backlash_mm = kNaN;            ///< circumferential, at the working pitch circle, as it comes out
  double implied_backlash_mm = 0.0;     ///< the part shifts and centre distance imply, thinning aside
  /// With all thickness allowances at their ends, at the exact centre distance; NaN where neither
  /// gear has one.
  double smallest_backlash_mm = kNaN, largest_backlash_mm = kNaN;
};

/// Where the planets stand and how they are turned, at one moment of the train (sun's phase chosen so
/// that planet 1 meshes; ring1 (ring) stands with tooth 1 on +x). Every mesh is centred: half the
/// backlash on either flank. Angles are of tooth 1, counter-clockwise from +x.
struct AssemblyPhases {
  std::vector<double> planet_position_rad;  ///< centres of the planets, from +x, planet 1 at 0
  std::vector<double> planet_rotation_rad;  ///< tooth 1 of planet1 (planet) of each body
  std::vector<double> planet_offset_rad;    ///< tooth 1 of planet2 ahead of planet1's, per body (3k)
  double sun_rotation_rad = 0.0;            ///< sun, pinion, gear
  /// ring1, ring; for a pair the wheel, whose axis stands at wheel_centre_mm, the pinion's at 0
  double ring1_rotation_rad = 0.0;
  double ring2_rotation_rad = 0.0;
};

/// Closed-form assembly condition of N planets at equal spacing.
struct AssemblyCondition {
  bool equal_spacing = true;       ///< sun and ring(s) accept N planets at equal spacing
  bool identical_planets = true;   ///< and all bodies are alike
  /// P2's tooth 1 ahead of P1's in body i, less that of body 1, at equal spacing; the smallest in
  /// magnitude of the equivalent angles. Zeros for kinds without compound planets.
  std::vector<double> planet_offsets_rad;
  /// Positions nearest to equal spacing at which N identical bodies assemble (equal spacing itself
  /// where that works); empty where there are none without collision.
  std::vector<double> nearest_angles_rad;
  /// Step of the angles between planets at which identical bodies assemble.
  double angle_step_rad = kNaN;
};

struct GearTrain {
  GearboxDesign design;
  double centre_distance_mm = kNaN;  ///< NaN for a single gear
  std::vector<TrainGear> gears;      ///< in the order of the design
  std::vector<TrainMesh> meshes;
  AssemblyCondition assembly;
  AssemblyPhases phases;  ///< at the design's spacing: equal, or the nearest angles where it must be

  [[nodiscard]] const TrainGear* find(const std::string& name) const;
  [[nodiscard]] GearPair pair(const TrainMesh& mesh) const;
};

/// Solves and places a design. Errors: all at once; every key is the design file's.
/// A design that does not fit or turn is not an error: the checks tell.
[[nodiscard]] ResultAll<GearTrain> lay_out(const GearboxDesign& design);

/// The gear at an end of its thickness allowance.
[[nodiscard]] Gear thinned(Gear gear, double thinning_mm);

/// Axis of the wheel of a pair: (a, 0), for a ring (-a, 0), so that the contact lies on +x.
[[nodiscard]] Point2 wheel_centre_mm(const GearTrain& train);

/// Planet body i (0-based): where planet1 (planet) and planet2 stand at another sun angle: the train
/// turned by the true kinematics so that the sun has advanced by `sun_turn_rad` from `phases`.
[[nodiscard]] AssemblyPhases turned(const GearTrain& train, double sun_turn_rad);

/// Angular speed of every member per unit of sun (pinion) speed.
struct MemberSpeeds {
  double sun = 1.0, carrier = 0.0, planet = 0.0, ring1 = 0.0, ring2 = 0.0;
  double output = kNaN;  ///< NaN where there is none
};
[[nodiscard]] MemberSpeeds member_speeds(const GearTrain& train);

}  // namespace trueflank
