// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/geometry/basic_rack.h"

namespace trueflank {

enum class GearKind { kExternal, kInternal };

/// Right flank: seen from +z with the tooth tip pointing up (for a ring: to the axis), the flank on
/// the right.
enum class Flank { kLeft, kRight };

/// +1 where the flank is on the counter-clockwise side of its tooth, -1 on the clockwise side.
[[nodiscard]] constexpr int flank_side(Flank flank, GearKind kind) {
  return (flank == Flank::kLeft) == (kind == GearKind::kExternal) ? 1 : -1;
}

/// How the root of a ring is made.
enum class RingRoot { kFillet, kShaper };

/// Pinion-type cutter that shapes a ring.
struct ShaperCutter {
  int teeth = 25;
  double shift = 0.0;
  double tip_radius = 0.0;  ///< rounding of the cutter's tip corner, coefficient of the module

  bool operator==(const ShaperCutter&) const = default;
};

/// A cylindrical involute gear, fully determined: what geometry needs and nothing else.
/// Normal quantities carry "normal" in the name; radii and thicknesses are those of the transverse
/// section. Ring: positive shift moves the teeth outwards.
struct Gear {
  GearKind kind = GearKind::kExternal;
  int teeth = 20;
  double normal_module_mm = 1.0;
  double helix_angle_rad = 0.0;  ///< at the reference circle, right hand positive
  BasicRack rack;
  double shift = 0.0;        ///< profile shift coefficient, of the normal module
  double thinning_mm = 0.0;  ///< transverse circular thinning of the teeth at the reference circle
  double tip_radius_mm = 0.0;    ///< 0: nominal_tip_radius_mm, in the profile's own gear
  double tip_rounding_mm = 0.0;  ///< radius between tip circle and flank, transverse; 0: sharp corner
  RingRoot ring_root = RingRoot::kFillet;  ///< rings only
  std::optional<ShaperCutter> cutter;      ///< rings with RingRoot::kShaper

  bool operator==(const Gear&) const = default;
};

/// @name Quantities of the transverse section (ISO 21771)
/// @{
[[nodiscard]] double transverse_module_mm(const Gear& gear);
[[nodiscard]] double transverse_pressure_angle_rad(const Gear& gear);
[[nodiscard]] double base_helix_angle_rad(const Gear& gear);
[[nodiscard]] double reference_radius_mm(const Gear& gear);
[[nodiscard]] double base_radius_mm(const Gear& gear);
/// r - m (hf - x) external, r + m (hf + x) ring: as the tool cuts it, without thinning.
[[nodiscard]] double nominal_root_radius_mm(const Gear& gear);
/// r + m (ha + x) external, r - m (ha - x) ring.
[[nodiscard]] double nominal_tip_radius_mm(const Gear& gear);
/// @}

/// Half the angle of the tooth at the base circle, psi_b: on the counter-clockwise side the
/// involute stands at psi_b - inv a(r) (external) or psi_b + inv a(r) (ring; psi_b may be negative).
/// Includes shift and thinning. Source: derivation docs/theory/tooth-profile.md.
[[nodiscard]] double base_half_angle_rad(const Gear& gear);

/// Half the angle of the tooth between its involute flanks at a radius >= base radius; negative
/// past the point where the flanks meet.
[[nodiscard]] double tooth_half_angle_rad(const Gear& gear, double radius_mm);

/// Arc of the tooth between its involute flanks at a radius >= base radius [mm].
[[nodiscard]] double tooth_thickness_mm(const Gear& gear, double radius_mm);

}  // namespace trueflank
