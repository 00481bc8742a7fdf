// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/geometry/curve.h"
#include "trueflank/geometry/gear.h"

namespace trueflank {

/// What a piece of the profile is.
enum class PieceKind {
  kTip,      ///< arc of the tip circle, from the tooth's middle
  kTipRounding,  ///< arc from the tip circle into the flank, tangent to both
  kTrim,     ///< ring only: tip corner as trimmed by the shaper cutter
  kRadial,   ///< ring only: straight continuation of the flank inside the base circle
  kInvolute,
  /// Trochoid of the tool, or the fillet arc of a ring. Above the trochoid of a protuberance there
  /// may be one more: the involute that the protuberance's straight side cuts.
  kFillet,
  kRoot,     ///< arc of the root circle, to the gap's middle
};

struct ProfilePiece {
  PieceKind kind = PieceKind::kInvolute;
  Curve curve;
};

/// What the profile could not be as asked; each is named in the report.
struct ProfileNotes {
  /// The tool cut into the involute (external): generating undercut. What a protuberance takes away
  /// on purpose does not count.
  bool undercut = false;
  bool pointed = false;           ///< flanks met before the tip circle; the tooth ends there
  bool full_round = false;        ///< tip rounding of the tool did not fit and was reduced
  bool space_closed = false;      ///< ring: flanks met before the root circle; the space ends there
  bool tip_inside_base = false;   ///< ring: straight radial flank from the base circle to the tip
  bool tip_trimmed = false;       ///< ring: the cutter trimmed the tip corner
  /// External: depth, normal to the flank, to which the tool's protuberance undercuts it [mm].
  double protuberance_undercut_mm = 0.0;
};

/// The exact transverse section of tooth 1, counter-clockwise half: from the tooth's middle (angle 0
/// on the tip circle) along tip, flank and fillet to the gap's middle (angle pi/z on the root
/// circle). The clockwise half is its mirror image in the x axis, the other teeth are turned copies.
/// Pieces join end to start within 1e-12 mm.
class ToothProfile {
 public:
  /// Errors: kInfeasible where no gear of these values exists (fillet swallows the involute, tool
  /// severs the tooth, rack or cutter pointed before its depth, ...), kOutOfRange for values that
  /// cannot be.
  /// Accuracy: 1e-9 mm against numerical generation with the tool, tested in
  /// tests/geometry/tooth_profile_test.cpp, helical teeth in helical_generation_test.cpp.
  [[nodiscard]] static Result<ToothProfile> make(const Gear& gear);

  /// The same gear with other half teeth: the section of a modified toothing (section_profile.h).
  /// Circles and form circles stay those of the design. `clockwise`: see clockwise_pieces(); empty
  /// where the halves are mirror images.
  [[nodiscard]] ToothProfile with_pieces(std::vector<ProfilePiece> pieces,
                                         std::vector<ProfilePiece> clockwise = {}) const;
  /// Seen from the other side: the halves change places.
  [[nodiscard]] ToothProfile mirror_image() const;

  [[nodiscard]] const Gear& gear() const { return gear_; }
  [[nodiscard]] const std::vector<ProfilePiece>& pieces() const { return pieces_; }
  /// The clockwise half, mirrored into the counter-clockwise one: the same pieces on a gear as designed,
  /// others where a section's flanks deviate unlike.
  [[nodiscard]] const std::vector<ProfilePiece>& clockwise_pieces() const {
    return symmetric() ? pieces_ : clockwise_;
  }
  [[nodiscard]] bool symmetric() const { return clockwise_.empty(); }
  [[nodiscard]] const ProfileNotes& notes() const { return notes_; }

  /// Radius where the tooth really ends: the tip circle, or where a pointed tooth ends.
  [[nodiscard]] double tip_radius_mm() const { return tip_radius_mm_; }
  /// Radius where the gap really ends: the root circle, or where a closed ring space ends.
  [[nodiscard]] double root_radius_mm() const { return root_radius_mm_; }
  /// Radius at which involute and fillet meet (root form circle, undercut included).
  [[nodiscard]] double root_form_radius_mm() const { return root_form_radius_mm_; }
  /// Radius at which the involute ends towards the tip (tip form circle).
  [[nodiscard]] double tip_form_radius_mm() const { return tip_form_radius_mm_; }
  /// Tip rounding of the tool as used, coefficient of the normal module.
  [[nodiscard]] double root_radius_coefficient() const { return root_radius_coefficient_; }
  /// Roll lengths of the involute's ends [mm]; first the end at the root form circle.
  [[nodiscard]] double root_form_roll_length_mm() const;
  [[nodiscard]] double tip_form_roll_length_mm() const;
  /// Tooth thickness at the tip: the arc at the tip circle (0 for a pointed tooth).
  [[nodiscard]] double tip_thickness_mm() const;

 private:
  friend class ProfileBuilder;
  Gear gear_;
  std::vector<ProfilePiece> pieces_, clockwise_;
  ProfileNotes notes_;
  double tip_radius_mm_ = 0.0, root_radius_mm_ = 0.0;
  double root_form_radius_mm_ = 0.0, tip_form_radius_mm_ = 0.0;
  double root_radius_coefficient_ = 0.0;
};

}  // namespace trueflank
