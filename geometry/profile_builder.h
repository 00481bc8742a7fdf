// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/tooth_profile.h"

// How ToothProfile::make builds the half tooth from the tip inwards; for its sources alone. The
// involute's ends are found first: the root form point by the geometry of the tool's corner, the tip
// point by the tip circle or the flanks' meeting.
namespace trueflank {

class ProfileBuilder {
 public:
  explicit ProfileBuilder(const Gear& gear) {
    p_.gear_ = gear;
    if (gear.tip_radius_mm == 0.0) p_.gear_.tip_radius_mm = nominal_tip_radius_mm(gear);
  }

  [[nodiscard]] Result<ToothProfile> build();

 private:
  [[nodiscard]] const Gear& g() const { return p_.gear_; }
  double gap_angle() const { return kPi / g().teeth; }
  /// tooth_half_angle_rad() of the gear.
  [[nodiscard]] double half_angle_at(double radius_mm) const;
  double radius_at(double roll_mm) const { return std::hypot(base_radius_mm_, roll_mm); }

  void add(PieceKind kind, Curve curve, double least_mm = 0.0);
  void add_arc(PieceKind kind, double radius, double from, double to);
  /// The tip's land, and its rounding into the flank where there is one.
  void add_tip();
  void add_involute(double from_roll_mm, double to_roll_mm);
  [[nodiscard]] Status round_tip();

  [[nodiscard]] Status build_external();
  [[nodiscard]] Status external_circles();
  [[nodiscard]] double cutting_depth_mm() const;
  [[nodiscard]] RackTrochoid rack_corner() const;
  [[nodiscard]] Status find_root_form(const RackTrochoid& corner, Curve& fillet,
                                      std::optional<Curve>& protuberance_side);
  [[nodiscard]] static double waist_rad(const Curve& fillet);
  [[nodiscard]] Status find_pointed_tip();
  [[nodiscard]] Status find_undercut(const Curve& fillet, double& fillet_end);

  [[nodiscard]] Status build_ring();
  [[nodiscard]] Status ring_ends();
  [[nodiscard]] Status ring_fillet_root();
  [[nodiscard]] Status ring_shaper_root();
  /// How ring and cutter mesh while the cutter, at its final depth, rolls in the ring without backlash.
  struct ShaperMesh {
    double pressure_angle_rad = 0.0, centre_distance_mm = 0.0;  ///< transverse, working
    double cutter_base_radius_mm = 0.0, cutter_tip_radius_mm = 0.0;
    double cutter_half_angle_rad = 0.0;  ///< of the cutter's tooth on its base circle
  };
  [[nodiscard]] Result<ShaperMesh> shaper_mesh(const ShaperCutter& cutter) const;
  /// What the rounding of the cutter's tip cuts; a rounding wider than the tooth becomes the full round one.
  [[nodiscard]] Result<CutterTrochoid> shaper_corner(const ShaperCutter& cutter, const ShaperMesh& mesh);
  [[nodiscard]] Status trim_ring_tip(const CutterTrochoid& fillet, double eta_joint);

  ToothProfile p_;
  double base_radius_mm_ = kNaN, base_half_angle_rad_ = kNaN;  ///< of the gear
  Curve rounding_;  ///< of the tip corner, where there is one
};

/// kOutOfRange: a value that is possible for no gear.
[[nodiscard]] Error impossible_value(std::string key, double value, std::string remedy);
/// kInfeasible: values that are possible each, but make no tooth together.
[[nodiscard]] Error no_tooth(std::string key, double value, std::string message, std::string remedy);

}  // namespace trueflank
