// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/geometry/gear.h"
#include "trueflank/train/machine/machine_design.h"
#include "trueflank/train/process.h"
#include "trueflank/train/topology.h"

// The design as its author writes it (docs/design-file.md), in mm and radians; nothing is solved yet.
namespace trueflank {

/// Where tip circles end: at the book's circles, or short of the mate's root fillet where those reach into
/// it (clear_tips.h).
enum class TipCircles { kClear, kStandard };

enum class BoreKind { kRound, kKeyway, kDFlat, kHex };
/// Bore through a gear (planet1's through the whole planet).
struct BoreDesign {
  double diameter_mm = 0.0;  ///< 0: none; hex: across flats
  BoreKind kind = BoreKind::kRound;
  double keyway_width_mm = 0.0;  ///< kKeyway
  double keyway_depth_mm = 0.0;  ///< kKeyway: from the bore circle to the keyway's floor
  double d_flat_mm = 0.0;        ///< kDFlat: distance of the flat from the opposite side of the bore

  bool operator==(const BoreDesign&) const = default;
};

/// Bolt circle in the rim of a ring.
struct BoltCircleDesign {
  int count = 0;  ///< 0: none
  double circle_diameter_mm = 0.0;
  double hole_diameter_mm = 0.0;

  bool operator==(const BoltCircleDesign&) const = default;
};

/// How a relief grows from its start.
enum class ReliefShape { kParabola, kLinear };

/// Flank modifications of one gear (design_deviation makes a FlankDeviation of them). What is removed
/// is positive here; slopes are signed.
struct ModificationsDesign {
  double tip_relief_um = 0.0;
  double tip_relief_start_diameter_mm = 0.0;
  ReliefShape tip_relief_shape = ReliefShape::kParabola;
  double root_relief_um = 0.0;
  double root_relief_start_diameter_mm = 0.0;
  ReliefShape root_relief_shape = ReliefShape::kParabola;
  double profile_crowning_um = 0.0;
  double profile_slope_um = 0.0;  ///< + material towards the tip
  double crowning_um = 0.0;
  double end_relief_um = 0.0;
  double end_relief_length_mm = 0.0;
  ReliefShape end_relief_shape = ReliefShape::kParabola;
  double helix_slope_um = 0.0;  ///< + the section turns counter-clockwise with z
  double edge_chamfer_mm = 0.0;
  double tip_rounding_mm = 0.0;  ///< radius in the transverse section; part of the profile

  bool operator==(const ModificationsDesign&) const = default;
};

/// Tooth thickness as its maker may deviate from the backlash-free one: of the circular thickness on
/// the reference circle, in the normal section, as DIN 3967 counts it.
struct ThicknessAllowance {
  std::string series = {};  ///< "cd25": DIN 3967, by the reference diameter; empty: the numbers below
  double upper_mm = 0.0, lower_mm = 0.0;

  bool operator==(const ThicknessAllowance&) const = default;
};

/// One gear of the design file.
struct GearDesign {
  std::string name;  ///< as in the topology
  GearKind kind = GearKind::kExternal;
  int teeth = 0;
  std::optional<double> shift = {};      ///< omitted: solved for zero backlash
  std::optional<double> module_mm = {};  ///< omitted: the gearbox's
  double face_width_mm = 10.0;
  std::optional<double> tip_diameter_mm = {};
  std::optional<double> thinning_mm = {};  ///< on the reference circle, instead of the shared backlash
  std::optional<ThicknessAllowance> thickness = {};  ///< instead of thinning and backlash
  BoreDesign bore = {};
  std::optional<double> outer_diameter_mm = {};  ///< rings
  BoltCircleDesign bolt_circle = {};             ///< rings
  std::optional<bool> halves = {};  ///< herringbone rings, split at the apex; omitted: with a housing
  RingRoot root = RingRoot::kFillet;
  std::optional<ShaperCutter> cutter = {};
  ModificationsDesign modifications = {};
  std::string material = {};  ///< name in the materials table; empty: the gearbox's

  bool operator==(const GearDesign&) const = default;
};

/// Two plates and the pins on which the planets turn.
struct CarrierDesign {
  double plate_thickness_mm = 4.0;
  std::optional<double> pin_diameter_mm = {};  ///< omitted: the planet's bore less pin_clearance_mm
  double pin_clearance_mm = 0.1;               ///< diametral, planet on pin
  double pin_hole_clearance_mm = 0.02;         ///< diametral, pin in plate
  double axial_clearance_mm = 0.3;             ///< planets to plates
  std::optional<double> outer_diameter_mm = {};
  std::optional<double> opening_diameter_mm = {};
  double bearing_diameter_mm = 0.0;  ///< seat in the outer face of either plate; 0: none
  double bearing_width_mm = 0.0;

  bool operator==(const CarrierDesign&) const = default;
};

/// What hangs on the shafts besides the gears.
struct ShaftsDesign {
  double rotor_inertia_kg_m2 = 0.0;  ///< of the motor's rotor, on the input
  double load_inertia_kg_m2 = 0.0;   ///< on the output

  bool operator==(const ShaftsDesign&) const = default;
};

/// How the parts are made.
struct MadeDesign {
  std::optional<Process> process = {};  ///< what it can make is checked against
  std::optional<double> kerf_mm = {};   ///< width of the cut of a wire or beam, for drawings
  // what the parts may be off by and what must be left then; omitted: the process's
  std::optional<int> tolerance_class = {};  ///< ISO 1328-1:2013, of runout and pitch
  std::optional<double> axis_tolerance_mm = {};       ///< +-, of the centre distance
  std::optional<double> thickness_tolerance_mm = {};  ///< +-, of the teeth on the reference circle
  std::optional<double> clearance_mm = {};  ///< least distance of mating teeth, the play centred
  std::string bed = {};                 ///< of the printer: its name or "WIDTHxDEPTH"; empty: no plates

  bool operator==(const MadeDesign&) const = default;
};

/// Losses beside the friction of the meshes as designed, as a bench found them (docs/drive-loop.md), and
/// the point at which efficiencies are reported. Torques are at the input shaft.
struct LossesDesign {
  double load_nm = 1.0;          ///< at the output
  double input_speed_rpm = 0.0;
  std::optional<double> temperature_c = {};
  double reference_c = 25.0;
  double drag_torque_nm = 0.0, drag_per_c = 0.0;
  double viscous_nm_per_rpm = 0.0, viscous_per_c = 0.0;
  double bearing_nm_at_1000_rpm = 0.0, bearing_load_share = 0.0;
  double stribeck_torque_nm = 0.0, stribeck_speed_rpm = 100.0;
  std::optional<double> backward_friction = {};
  double load_friction = 0.0, load_friction_exponent = 1.0, load_friction_reference_nm = 1.0;
  double mixed_friction = 0.0, mixed_friction_speed_rpm = 100.0;

  bool operator==(const LossesDesign&) const = default;
};

/// A part of the life at a part of the rated torque.
struct LoadStep {
  double torque = 1.0;  ///< of the rated torque
  double share = 1.0;   ///< of all revolutions

  bool operator==(const LoadStep&) const = default;
};

/// What the strength calculation assumes (docs/strength.md); StrengthOptions' meanings.
struct StrengthDesign {
  std::optional<bool> reversing = {};  ///< omitted: a pair runs one way, sets with planets both
  double overload_factor = 1.0, dynamic_factor = 1.0, face_load_factor = 1.0;
  double planet_load_factor = 1.0;
  double bending_life_factor = 1.0, contact_life_factor = 1.0, lubrication_factor = 1.0;
  double bending_safety = 1.2, contact_safety = 1.15;
  std::optional<double> input_speed_rpm = {};  ///< omitted: no temperature, no cycles
  std::optional<double> life_h = {};           ///< at that speed
  double ambient_c = 20.0;
  std::string lubrication = "grease";  ///< of plastics: dry, grease, oil
  std::vector<LoadStep> spectrum = {}; ///< empty: the rated torque all the time

  bool operator==(const StrengthDesign&) const = default;
};

/// What a stage behind the first says of itself; all else is the gearbox's.
struct StageDesign {
  int planets = 1;
  std::optional<double> module_mm = {};  ///< omitted: the gearbox's
  std::optional<double> centre_distance_mm = {};

  bool operator==(const StageDesign&) const = default;
};

/// A gearbox as designed.
struct GearboxDesign {
  std::string name;
  Topology topology = {};  ///< which bodies, gears and meshes there are, what drives and what is held
  int planets = 1;
  double module_mm = 1.0;
  std::optional<double> centre_distance_mm = {};
  double friction = 0.1;
  double backlash_mm = 0.0;
  TipCircles tips = TipCircles::kClear;
  std::optional<double> corner_contact_limit_mm = {};  ///< omitted: the check's own
  double layer_gap_mm = 1.0;
  double helix_angle_rad = 0.0;  ///< of the sun, pinion or gear, right hand positive
  bool herringbone = false;
  double relief_groove_mm = 0.0;  ///< herringbone: width of the groove between the halves
  BasicRack rack = {};
  std::vector<GearDesign> gears = {};  ///< in the order of the topology
  std::optional<CarrierDesign> carrier = {};  ///< kinds with planets
  std::optional<MachineDesign> machine = {};  ///< of a design with [housing]: motor, housing, output, ...
  std::string material = {};  ///< of every gear that does not set its own; empty: the default
  ShaftsDesign shafts = {};
  MadeDesign made = {};
  std::string tools_file = {};  ///< the user's racks, cutters and processes; empty: none
  std::optional<LossesDesign> losses = {};  ///< none: friction of the meshes alone
  StrengthDesign strength = {};
  std::vector<StageDesign> later_stages = {};  ///< stage 2, ...: one for each that the topology has

  bool operator==(const GearboxDesign&) const = default;
};

/// The gear of a name; nullptr where there is none.
[[nodiscard]] const GearDesign* find_gear(const GearboxDesign& design, const std::string& name);
/// The gear of a planet body whose bore goes through the whole body: its first; nullptr without planets.
[[nodiscard]] const GearDesign* planet_with_bore(const GearboxDesign& design);
/// The gear whose table gives bore and material of the body a gear belongs to: the body's first.
[[nodiscard]] const GearDesign& first_of_body(const GearboxDesign& design, std::size_t gear);
/// The bore that the motor's shaft goes into: a D where the shaft has a flat.
[[nodiscard]] BoreDesign shaft_bore(const MachineDesign& machine);
/// Its own, its stage's or the gearbox's.
[[nodiscard]] double module_of(const GearboxDesign& design, const GearDesign& gear);
/// Planets on the axis of a member; 1 where that stands.
[[nodiscard]] int planets_of(const GearboxDesign& design, int member);
/// Whether a herringbone ring is made as two parts that meet at the apex: asked for, or in a housing.
[[nodiscard]] bool is_made_in_halves(const GearboxDesign& design, const GearDesign& gear);

}  // namespace trueflank
