// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// Two gears in mesh on parallel axes. gear1 is external (sun, planet, pinion: the inner gear of an
/// internal pair); gear2 is external or a ring.
struct GearPair {
  const ToothProfile* profile1 = nullptr;  ///< not owned
  const ToothProfile* profile2 = nullptr;  ///< not owned
  double centre_distance_mm = kNaN;

  [[nodiscard]] const Gear& gear1() const { return profile1->gear(); }
  [[nodiscard]] const Gear& gear2() const { return profile2->gear(); }
  [[nodiscard]] bool internal() const { return gear2().kind == GearKind::kInternal; }
};

/// @name Zero-backlash relations of shifts and centre distance (transverse section, ISO 21771)
/// z2 counts as positive; `internal` says whether gear 2 is a ring.
/// @{
struct MeshTeeth {
  int teeth1 = 0, teeth2 = 0;
  bool internal = false;
  double normal_module_mm = 1.0;
  double helix_angle_rad = 0.0;
  double pressure_angle_rad = 0.0;  ///< normal
};
[[nodiscard]] double transverse_pressure_angle_rad(const MeshTeeth& mesh);
/// Centre distance of the unshifted pair.
[[nodiscard]] double reference_centre_distance_mm(const MeshTeeth& mesh);
/// Working transverse pressure angle at a centre distance. Errors: kInfeasible where the base
/// circles do not allow it.
[[nodiscard]] Result<double> working_pressure_angle_rad(const MeshTeeth& mesh,
                                                        double centre_distance_mm);
/// x1 + x2 (external) or x2 - x1 (internal) for zero backlash at the working pressure angle.
[[nodiscard]] double shift_sum(const MeshTeeth& mesh, double working_pressure_angle_rad);
/// Centre distance at which x1 + x2 (x2 - x1) has zero backlash. Errors: kInfeasible.
[[nodiscard]] Result<double> zero_backlash_centre_distance_mm(const MeshTeeth& mesh,
                                                              double shift_sum);
/// @}

[[nodiscard]] MeshTeeth mesh_teeth(const Gear& gear1, const Gear& gear2);
[[nodiscard]] MeshTeeth mesh_teeth(const GearPair& pair);
[[nodiscard]] double working_pressure_angle_rad(const GearPair& pair);
/// Working pitch radius of gear 1 and of gear 2.
[[nodiscard]] double pitch_radius1_mm(const GearPair& pair);
[[nodiscard]] double pitch_radius2_mm(const GearPair& pair);
/// Circumferential backlash at the working pitch circle: gap less tooth; negative: they overlap.
[[nodiscard]] double circumferential_backlash_mm(const GearPair& pair);

/// Contact along the line of action. Lengths are measured as roll lengths of gear 1, i.e. from the
/// point where the line of action touches gear 1's base circle.
struct LineOfAction {
  double pitch_point_mm = kNaN;
  double start_mm = kNaN;  ///< first contact (gear 1 driving): at the tip of gear 2
  double end_mm = kNaN;    ///< last contact: at the tip of gear 1
  /// What root form circles and undercut leave of it; start > end: nothing.
  double effective_start_mm = kNaN;
  double effective_end_mm = kNaN;
  double base_pitch_mm = kNaN;  ///< transverse
};
[[nodiscard]] LineOfAction line_of_action(const GearPair& pair);

/// Transverse contact ratios. approach (e1) is from the mate's tip to the pitch point, recess (e2)
/// from the pitch point to the inner gear's tip, gear 1 driving (paper's e1 and e2).
struct ContactRatios {
  double approach = kNaN, recess = kNaN;
  double total = kNaN;      ///< approach + recess, from the tip circles
  double effective = kNaN;  ///< what undercut and root form circles leave; 0 where nothing is left
};
[[nodiscard]] ContactRatios contact_ratios(const GearPair& pair);

/// Radius on gear 1 / gear 2 where contact with the mate starts, at the root side (start of active
/// profile): from the mate's tip circle; the mate's real tip where that is pointed or trimmed.
/// External gears: smallest, ring: largest radius in contact. Where the mate's tip would touch
/// beyond the base circle's tangent point (interference), the base radius.
[[nodiscard]] double start_of_active_profile1_mm(const GearPair& pair);
[[nodiscard]] double start_of_active_profile2_mm(const GearPair& pair);

/// Distance between tip circle of one and root circle of the other, both ways; smaller first cause
/// is the caller's. External: a - r_a1 - r_f2; ring: r_f2 - a - r_a1.
[[nodiscard]] double tip_clearance_of_gear1_mm(const GearPair& pair);  ///< tip 1 in root 2
[[nodiscard]] double tip_clearance_of_gear2_mm(const GearPair& pair);  ///< tip 2 in root 1

}  // namespace trueflank
