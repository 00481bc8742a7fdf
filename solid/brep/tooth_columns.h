// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/geometry/toothing.h"

// A toothing's surface cut into columns that run over the whole face: one a tip, a root, and a side
// of flank and fillet; flanks are cut where their deviation bends. Each is smooth across.
namespace trueflank {

struct ToothColumn {
  /// Across the middle of a tooth (tip) or of the gap after it (root): an arc about the axis in every
  /// section, before displacement. Else a piece of one half of a tooth.
  enum class Kind { kHalf, kTipLand, kRootLand };
  Kind kind = Kind::kHalf;
  int side = 1;  ///< of a half: +1 counter-clockwise
  std::size_t piece = 0;
  /// Ends of a half towards tip and root: indices of breaks, -1 for the piece's own end.
  int upper_break = -1, lower_break = -1;
};

/// Frame: the gear's own, as surface_point(); u runs counter-clockwise over a column, 0 to 1.
class ToothColumns {
 public:
  /// Pieces of a half tooth shorter than `shortest_mm` are left out, see PathTolerance.
  /// Requires: the toothing's profile, deviation and displacement outlive the columns.
  ToothColumns(const Toothing& toothing, double shortest_mm);

  /// Whether the columns bound a solid.
  /// Errors: kUnsupported where a tooth that is pointed (or a gap that is closed) gets flanks that no
  /// longer meet, or where a deviation leaves no tip land.
  [[nodiscard]] Status check() const;

  [[nodiscard]] const std::vector<ToothColumn>& columns() const { return columns_; }  ///< of a tooth
  [[nodiscard]] int teeth() const { return toothing_.profile->gear().teeth; }
  [[nodiscard]] const Toothing& toothing() const { return toothing_; }
  /// Whether every tooth is the first one turned.
  [[nodiscard]] bool teeth_alike() const;

  [[nodiscard]] std::array<double, 3> point(int tooth, std::size_t column, double u,
                                            double z_mm) const;
  /// Where the column begins and the one before it ends: an arc's own end, else between the two ends.
  /// Accuracy: off the column's own end by no more than a piece that was left out is long.
  [[nodiscard]] std::array<double, 3> joint(int tooth, std::size_t column, double z_mm) const;
  /// Radius of a land's arc, before displacement.
  [[nodiscard]] double land_radius_mm(std::size_t column, double z_mm) const;

 private:
  void add_columns();
  [[nodiscard]] std::vector<int> breaks_within(int side) const;
  [[nodiscard]] double break_at(int tooth, int side, int index, double z_mm) const;
  [[nodiscard]] ToothPlace place(int tooth, const ToothColumn& column, double u, double z_mm) const;
  [[nodiscard]] std::array<double, 2> land_corners_rad(int tooth, const ToothColumn& column,
                                                       double z_mm) const;
  [[nodiscard]] std::array<double, 3> undisplaced(int tooth, std::size_t index, double u,
                                                  double z_mm) const;

  Toothing toothing_;
  double shortest_mm_ = 0.0;
  std::size_t flank_ = 0;  ///< the involute, of ToothProfile::pieces()
  std::vector<ToothColumn> columns_;
};

}  // namespace trueflank
