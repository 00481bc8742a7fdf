// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>

#include "trueflank/geometry/flank_deviation.h"
#include "trueflank/geometry/inset_profile.h"
#include "trueflank/geometry/tooth_profile.h"

// The tooth surface over the whole face. Everything that needs a point of a real tooth (meshes,
// solids, drawings, checks) asks here, so that all see the same gear.
// Frame: the gear's own; tooth 1 on +x at the lower face z = 0, the face upwards to face_width_mm.
namespace trueflank {

/// How the transverse section of a helical or herringbone gear turns along the face.
struct FaceTwist {
  double turn_rad_per_mm = 0.0;  ///< counter-clockwise with z: right hand
  double face_width_mm = 0.0;
  bool herringbone = false;      ///< turns back above mid face
  double relief_groove_mm = 0.0;  ///< herringbone: no teeth this far, half on either side of mid face

  bool operator==(const FaceTwist&) const = default;
};

/// tan(beta) / r; gears and rings alike.
[[nodiscard]] FaceTwist face_twist(const Gear& gear, double face_width_mm, bool herringbone,
                                   double relief_groove_mm = 0.0);
/// Turn of the section at a height against that at the lower face.
[[nodiscard]] double section_turn_rad(const FaceTwist& twist, double z_mm);

/// A displacement [mm] of the finished toothing, as a function of the point it moves.
using Displacement = std::function<std::array<double, 3>(const std::array<double, 3>& point_mm)>;

/// A toothing as it is to be made. A toothing without twist and deviations is prismatic.
struct Toothing {
  const ToothProfile* profile = nullptr;      ///< not owned
  FaceTwist twist = {};                       ///< face_width_mm is always set
  const FlankDeviation* deviation = nullptr;  ///< not owned; nullptr: none
  /// The edges of flanks and tips with the end faces are broken by this much at 45 degrees; the root
  /// is left.
  double edge_chamfer_mm = 0.0;
  const Displacement* displacement = nullptr;  ///< not owned; comes last; nullptr: none
  /// Bed chamfer: every section's walls lie inside the material by this profile's deepest at z = 0, by
  /// less and less up to bed_height_mm. Not together with edge_chamfer_mm.
  const InsetProfile* bed = nullptr;  ///< of `profile`; not owned; nullptr: none
  double bed_height_mm = 0.0;

  /// How far the walls lie inside the material at a height.
  [[nodiscard]] double bed_depth_mm(double z_mm) const {
    if (bed == nullptr || z_mm >= bed_height_mm) return 0.0;
    return bed->deepest_mm() * (1.0 - (z_mm > 0.0 ? z_mm / bed_height_mm : 0.0));
  }
  [[nodiscard]] bool has_deviation() const { return deviation != nullptr && !deviation->empty(); }
  [[nodiscard]] bool prismatic() const {
    return twist.turn_rad_per_mm == 0.0 && edge_chamfer_mm == 0.0 && displacement == nullptr &&
           bed == nullptr && !(has_deviation() && deviation->varies_along_face);
  }
};

/// A place on a tooth of the design, at any height.
struct ToothPlace {
  int tooth = 0;          ///< 0-based, counter-clockwise
  int side = 1;           ///< +1 counter-clockwise half of the tooth, -1 clockwise
  std::size_t piece = 0;  ///< of ToothProfile::pieces()
  double parameter = 0.0;
};

/// Of the pieces of a profile, the one that is its involute flank.
[[nodiscard]] std::size_t involute_piece(const ToothProfile& profile);

/// How far a place of the section is turned about the axis towards its own side, so that its flank
/// has the deviation [rad]. On the involute exact: a point moved along the normal by d lies on an
/// involute turned by d / r_b. Fades over the fillet to nothing at its end; the tip goes with the
/// flank's end, in proportion to the angle from the tooth's middle.
/// Source: involutes of one base circle are parallel curves, docs/theory/tooth-surface.md.
[[nodiscard]] double deviation_turn_rad(const Toothing& toothing, const ToothPlace& place,
                                        double z_mm);

/// Parameter of the flank at which the surface shows a break that the deviation has at a roll
/// length: the deviation itself moves the break along the flank, so that it wanders with the height
/// where the flank is crowned; chamfers draw the parameters together. Beyond the flank's ends where
/// the break is. Requires: a deviation.
[[nodiscard]] double break_parameter(const Toothing& toothing, int tooth, int side, double roll_mm,
                                     double z_mm);

/// The point of the section at a height, in the section's own frame (not turned by the twist, not
/// displaced; turned to its tooth).
[[nodiscard]] Point2 section_point(const Toothing& toothing, const ToothPlace& place, double z_mm);

/// The point of the tooth surface, twist and displacement included.
/// Continuous over pieces, halves of a tooth and neighbouring teeth.
/// Accuracy: 1e-12 mm of the formulas' own; tested against turned and offset involutes.
[[nodiscard]] std::array<double, 3> surface_point(const Toothing& toothing, const ToothPlace& place,
                                                  double z_mm);

}  // namespace trueflank
