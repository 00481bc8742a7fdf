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
#include "trueflank/train/kinematics.h"

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
  double tip_shortened_mm = 0.0;    ///< by `tips = "clear"`, of the tip circle's radius
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
  double centre_distance_mm = kNaN;     ///< of their axes
  double backlash_mm = kNaN;            ///< circumferential, at the working pitch circle, as it comes out
  double implied_backlash_mm = 0.0;     ///< the part shifts and centre distance imply, thinning aside
  /// With all thickness allowances at their ends, at the exact centre distance; NaN where neither
  /// gear has one.
  double smallest_backlash_mm = kNaN, largest_backlash_mm = kNaN;
};

/// Where the bodies stand and how they are turned, at one moment of the train. Every mesh is centred:
/// half the backlash on either flank. Angles are of tooth 1, counter-clockwise from +x. A body on a
/// standing axis is there once, a planet as often as there are positions.
struct AssemblyPhases {
  /// [member][place]: centres of planets, from +x, planet 1 at 0; empty for bodies on standing axes.
  std::vector<std::vector<double>> position_rad;
  /// [member][place]: of the member's first gear; of a carrier, what it has turned.
  std::vector<std::vector<double>> member_rotation_rad;
  /// [gear][place]: ahead of its member; 0 for first gears but those on a carrier.
  std::vector<std::vector<double>> gear_offset_rad;

  /// Where the planets of a body stand; empty for kNoMember and bodies on standing axes.
  [[nodiscard]] const std::vector<double>& positions_rad(int member) const {
    static const std::vector<double> none;
    return member == kNoMember ? none : position_rad[static_cast<std::size_t>(member)];
  }
  /// `place` counts planets and means nothing to bodies on standing axes.
  [[nodiscard]] double rotation_rad(int member, std::size_t place) const {
    const auto& turns = member_rotation_rad[static_cast<std::size_t>(member)];
    return turns[turns.size() > 1 ? place : 0];
  }
  [[nodiscard]] double offset_rad(int gear, std::size_t place) const {
    const auto& offsets = gear_offset_rad[static_cast<std::size_t>(gear)];
    return offsets[offsets.size() > 1 ? place : 0];
  }
};

/// Closed-form assembly condition of N planets at equal spacing.
struct AssemblyCondition {
  bool equal_spacing = true;       ///< sun and ring(s) accept N planets at equal spacing
  bool identical_planets = true;   ///< and all bodies are alike
  /// Tooth 1 of a compound planet's second gear ahead of its first gear's in body i, less that of body
  /// 1, at equal spacing; the smallest in magnitude of the equivalent angles. Zeros where planets have
  /// one gear each.
  std::vector<double> planet_offsets_rad;
  /// Positions nearest to equal spacing at which N identical bodies assemble (equal spacing itself
  /// where that works); empty where there are none without collision.
  std::vector<double> nearest_angles_rad;
  /// Step of the angles between planets at which identical bodies assemble; NaN where any angle does.
  double angle_step_rad = kNaN;
};

struct GearTrain {
  GearboxDesign design;
  double centre_distance_mm = kNaN;  ///< NaN for a single gear, and where each stage has its own
  std::vector<TrainGear> gears;      ///< in the order of the design
  std::vector<TrainMesh> meshes;
  AssemblyCondition assembly;
  MemberSpeeds speeds;
  AssemblyPhases phases;  ///< at the design's spacing: equal, or the nearest angles where it must be
  /// Of a train of several stages: each as a train of its own, at its height in the whole and with the names
  /// of the whole; what is said of one set of planets is said there. Empty where there is one stage.
  std::vector<GearTrain> stages = {};

  [[nodiscard]] const Topology& topology() const { return design.topology; }
  [[nodiscard]] const TrainGear* find(const std::string& name) const;
  [[nodiscard]] const TrainGear& gear(int index) const { return gears[static_cast<std::size_t>(index)]; }
  /// How often a body is there: a planet as often as there are planets.
  [[nodiscard]] int copies_of(int member) const { return planets_of(design, member); }
  /// Of a member's axis from the train's; 0 where it is the same.
  [[nodiscard]] double axis_distance_mm(int member) const;
  /// The stages; the train itself where it has one.
  [[nodiscard]] std::vector<const GearTrain*> each_stage() const;
  /// The external gear that the planets run round, of the first stage; nullptr where there is none.
  [[nodiscard]] const TrainGear* sun() const;
  [[nodiscard]] GearPair pair(const TrainMesh& mesh) const;
};

/// Solves and places a design. Errors: all at once; every key is the design file's.
/// A design that does not fit or turn is not an error: the checks tell.
[[nodiscard]] ResultAll<GearTrain> lay_out(const GearboxDesign& design);
/// The same without speeds, assembly and phases of a single stage, for solvers that ask for its teeth alone.
[[nodiscard]] ResultAll<GearTrain> lay_out_teeth(const GearboxDesign& design);

/// The gear at an end of its thickness allowance.
[[nodiscard]] Gear thinned(Gear gear, double thinning_mm);

/// Where a member's axis stands at `phases`: at the origin, at the planet's place, or (the wheel of a
/// pair) at (a, 0), for a ring (-a, 0), so that the contact lies on +x.
[[nodiscard]] Point2 axis_centre_mm(const GearTrain& train, const AssemblyPhases& phases, int member,
                                    std::size_t place = 0);

/// The train turned by its kinematics so that the input has advanced by `input_turn_rad` from `phases`.
[[nodiscard]] AssemblyPhases turned(const GearTrain& train, double input_turn_rad);

/// How a body moves for a turn of the input: about the origin with its carrier, and about its own axis.
struct BodyMotion {
  double turn = 0.0;   ///< of the body, seen from the housing
  double orbit = 0.0;  ///< of its axis round the origin; parts of a carrier stand on it and go round with it
};
[[nodiscard]] BodyMotion motion_of(const GearTrain& train, int member);

}  // namespace trueflank
