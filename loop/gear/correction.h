// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank::loop {

/// What to change on the model so that the same process makes the gear as designed: the effects of a
/// loop.json that geometry can cancel, the other way round.
class Correction {
 public:
  /// An effect that is cancelled, with its amounts.
  struct Part {
    Effect effect;
    std::vector<double> coefficients;
  };

  /// Errors: kSyntax (no JSON, with the place), kWrongType, kUnknownKey (an effect nobody knows),
  /// kInconsistent (a drive's loop.json).
  [[nodiscard]] static Result<Correction> make(std::string_view loop_json,
                                               const FlankGeometry& geometry);
  /// The gear a loop.json is of. Errors: as make().
  [[nodiscard]] static Result<std::string> gear_of(std::string_view loop_json);

  /// Displacement [mm] of a point of the toothing as designed, in the gear's frame. Body effects:
  /// the field turned round, at the place to which the point goes. Effects on flanks: along the
  /// circle, so that tip and root keep their radii; offsets of all walls also move tip and root.
  /// Continuous over tip, flank, fillet and gap. NaN where no place can be told, as for a scale
  /// that doubles the part; within_bounds() refuses those.
  [[nodiscard]] std::array<double, 3> displacement_mm(const std::array<double, 3>& point_mm) const;

  /// The mesh of the gear's part with its toothing corrected; z_lower_mm is the lower face of the gear
  /// in the part. Bore and rim stay where they are, but for a scale. Walls are cut at heights where the
  /// correction bends over the face. Guarantees: closed where the mesh was closed.
  [[nodiscard]] TriangleMesh apply(const TriangleMesh& mesh, double z_lower_mm) const;

  /// About how many arithmetic operations a displacement takes, in all its effects.
  [[nodiscard]] double operations() const;
  /// Whether bore and rim are corrected, too: a scale. Then only meshes can hold it: what without_scale()
  /// holds displaces the toothing first, so that facets follow it, and apply() of the scale comes last.
  [[nodiscard]] bool moves_whole_part() const;
  /// The scale alone, or all but the scale. Their succession differs from both at once by the product of
  /// the two, some hundredths of a micrometre.
  [[nodiscard]] Correction scale_alone() const;
  [[nodiscard]] Correction without_scale() const;
  /// What people call an effect: its id; of a form without a name "unnamed" and its form.
  [[nodiscard]] static std::string name_of(const EffectFamily& family);
  /// What it cancels of one name.
  [[nodiscard]] Correction of(const std::string& name) const;
  /// What it does by moving points of the body, not flanks.
  [[nodiscard]] Correction of_body() const;
  /// The names of what is cancelled, each once.
  [[nodiscard]] std::vector<std::string> effects() const;
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] const FlankGeometry& geometry() const { return geometry_; }
  /// Of a scale alone: the size it gives the part, as a share of what it was.
  [[nodiscard]] double magnification() const;
  /// How far all walls were found to stand outside the model [mm], normal to them: contour offset and
  /// tooth thickness, the two that a process's horizontal expansion shows as.
  [[nodiscard]] double walls_outside_mm() const;
  [[nodiscard]] bool empty() const { return parts_.empty(); }
  [[nodiscard]] const std::vector<std::string>& corrected() const { return corrected_; }
  /// What stays, and why: one sentence each.
  [[nodiscard]] const std::vector<std::string>& left() const { return left_; }

 private:
  explicit Correction(const FlankGeometry& geometry) : geometry_(geometry) {}
  [[nodiscard]] double flank_deviation_mm(int tooth, int side, double roll_mm, double z_mm) const;
  [[nodiscard]] double turn_rad(const std::array<double, 3>& point_mm) const;
  [[nodiscard]] bool bends_over_the_face() const;
  struct PlaceInTooth {
    int tooth = 1;            ///< the nearest
    double offset_rad = 0.0;  ///< from its middle, counter-clockwise
  };
  [[nodiscard]] PlaceInTooth place_in_tooth(const std::array<double, 3>& point_mm) const;
  [[nodiscard]] double half_angle_rad(double radius_mm) const;
  struct CircleMove {
    double radius_mm = 0.0, turn_rad = 0.0;  ///< where a point goes, and its turn on the way
  };
  [[nodiscard]] CircleMove circle_move(const std::array<double, 3>& point_mm,
                                       double offset_mm) const;

  FlankGeometry geometry_;
  std::vector<std::shared_ptr<const EffectFamily>> declared_;  ///< parts may point into these
  std::vector<Part> parts_;
  std::vector<std::string> corrected_, left_;
};

}  // namespace trueflank::loop
