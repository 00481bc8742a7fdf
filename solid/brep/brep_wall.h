// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/brep/outline_path.h"

// The walls of a B-rep solid: an outline from the slab it starts in to the one it ends with.
namespace trueflank {

struct Wall {
  const Outline* outline = nullptr;
  bool outer = true;  ///< bounds the material from outside
  std::size_t first_slab = 0, last_slab = 0;
  OutlinePath path = {};  ///< of a prismatic wall
  std::vector<OrientedEdge> lower = {}, upper = {};  ///< along the path; made with the wall
};

/// Whether a wall has the same section all the way up.
[[nodiscard]] bool is_prismatic(const Outline& outline);

/// Whether the outline's toothing bounds a solid. Errors: kUnsupported, see ToothColumns::check(); a
/// prismatic wall with a deviation that its path does not follow within the contract of 1e-5 mm.
[[nodiscard]] Status check_wall(const Wall& wall, const PathTolerance& tolerance);

/// Adds the faces of a wall between two heights, and sets its edges there.
/// Requires: the wall has its path. Straight walls: extruded splines, cylinders, planes.
void add_prismatic_wall(Brep& brep, Wall& wall, double z_lower_mm, double z_upper_mm);

/// As above, of a toothing that changes along the face: spline surfaces for flanks, fillets and
/// whatever is displaced, true cylinders for tip and root lands. One face a column of the toothing
/// and a band between heights where twist, deviation or chamfer bend.
/// Requires: check_wall().
/// Errors: kUnsupported where a displacement moves the ends out of their planes; where the splines do
/// not come within the contract.
[[nodiscard]] Status add_toothed_wall(Brep& brep, Wall& wall, double z_lower_mm, double z_upper_mm,
                                      const PathTolerance& tolerance);

/// What every surface of a toothing is promised to come within.
constexpr double kSurfaceContract_mm = 1e-5;
/// Why a surface or section is refused that splines come only this near to.
[[nodiscard]] Error too_rough(double error_mm);

template <class T>
int add_to(std::vector<T>& list, T item) {
  list.push_back(std::move(item));
  return static_cast<int>(list.size()) - 1;
}

[[nodiscard]] inline Point3 at_height(const Point2& p, double z_mm) { return {p.x(), p.y(), z_mm}; }
[[nodiscard]] inline OrientedEdge reversed(OrientedEdge e) { return {e.edge, !e.forward}; }

/// The loop round one face of a wall. Outside walls run counter-clockwise seen from outside, holes'
/// walls the other way.
[[nodiscard]] BrepLoop wall_face_loop(bool outer, OrientedEdge lower, OrientedEdge up_next,
                                      OrientedEdge upper, OrientedEdge up_here);

}  // namespace trueflank
