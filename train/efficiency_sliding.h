// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/units.h"
#include "trueflank/geometry/gear_pair.h"

// Sliding loss integrated along the path of contact; derivation: docs/efficiency.md.
namespace trueflank {

/// How tooth pairs in contact at the same time share the load.
enum class LoadSharing {
  kEqual,      ///< equal parts: what the contact-ratio formula assumes
  kCompliant,  ///< by the compliance of the pairs: less near the ends of contact, more at mid contact
};

/// The path of contact of one mesh, in roll lengths of gear 1.
struct ContactPath {
  double base_radius1_mm = kNaN, base_radius2_mm = kNaN;
  bool internal = false;
  double pitch_point_mm = kNaN;  ///< of gear 1; gear 2's follows from the base radii
  double start_mm = kNaN, end_mm = kNaN;
  double base_pitch_mm = kNaN;   ///< transverse
  double overlap_ratio = 0.0;    ///< of a helical mesh: face width / axial pitch
  double base_helix_angle_rad = 0.0;
};

/// What undercut and root form leave of a pair's path.
[[nodiscard]] ContactPath contact_path(const GearPair& pair, double face_width_mm);

struct SlidingEfficiency {
  double gear1_driving = kNaN;  ///< work out over work in through a whole mesh cycle
  double gear2_driving = kNaN;
};

/// Efficiency of a mesh under Coulomb friction at constant torque on the driven gear: the balance of
/// normal and friction forces at every contact, not its first order in the friction coefficient.
/// NaN where the path is shorter than a base pitch (contact is interrupted); 0 where friction blocks
/// the mesh.
/// Accuracy: spur 1e-10 (Gauss rule between the places where tooth pairs enter, leave and cross the
/// pitch point); helical 1e-7 as tested (the integrals along the face are exact, the sum they are
/// compared with is not); tested against a brute-force sum.
[[nodiscard]] SlidingEfficiency sliding_efficiency(const ContactPath& path, double friction,
                                                   LoadSharing sharing);

}  // namespace trueflank
