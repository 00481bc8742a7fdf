// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// The half tooth of a profile with all its walls moved into the material along their normals, by any
/// depth up to the deepest: tip, flanks, fillets, root. Places of the profile keep their pieces; where
/// moved walls meet in a corner, the places of a piece are drawn together so that it ends there.
/// Source: the moved wall at a depth is the parallel curve, cut off where parallel curves cross; a flank
/// that moves past its centres of curvature at the base circle is cut off by its fillet.
class InsetProfile {
 public:
  /// Goes as deep as asked, or as deep as every piece keeps a tenth of its length; corners that point
  /// into the material (a sharp ring root) would have to become round and allow nothing.
  /// Requires: the profile outlives this; depth > 0.
  /// Accuracy: 1e-6 mm, tested by the distance from the profile in
  /// tests/solid/bed_chamfer_test.cpp.
  InsetProfile(const ToothProfile& profile, double depth_mm);

  [[nodiscard]] double deepest_mm() const { return deepest_; }
  /// The point that a place of the profile goes to.
  /// Requires: 0 <= depth <= deepest_mm().
  [[nodiscard]] Point2 point(std::size_t piece, double parameter, double depth_mm) const;
  /// Which place of the design is straight over it.
  [[nodiscard]] double foot(std::size_t piece, double parameter, double depth_mm) const;

 private:
  /// Parameters between which a piece is left.
  using Range = std::pair<double, double>;
  bool cut_pieces(double depth_mm, std::vector<Range>& left) const;
  bool cut_joint(std::size_t first, double depth_mm, std::vector<Range>& left) const;
  bool cut_tooth_middle(double depth_mm, std::vector<Range>& left) const;
  [[nodiscard]] Point2 moved(std::size_t piece, double parameter, double depth_mm) const;
  [[nodiscard]] Range left_of(std::size_t piece, double depth_mm) const;

  const ToothProfile* profile_;
  double into_material_ = 1.0;  ///< of the normal to the left of the run
  double deepest_ = 0.0;
  std::vector<std::vector<Range>> nodes_;  ///< at equal steps of the depth; all pieces each
};

}  // namespace trueflank
