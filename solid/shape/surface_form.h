// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

// How a surface bends over a step across (along its section) and a step along (up its face), as
// second differences off its tangent plane: an edge over u steps across and v steps along departs
// from the surface by an eighth of `across u^2 + 2 mixed u v + along v^2`. Source:
// docs/theory/helical-facets.md.
namespace trueflank {

/// Saddles bent by less than this share of the room have facets from break to break as wide as
/// their chords, wherever these stand.
inline constexpr double kSlackOfSaddles = 1.25;

struct SurfaceForm {
  double across = 0.0, mixed = 0.0, along = 0.0;
  double level = 0.0;  ///< of the step across in its own plane, where rows end the surface

  /// What is left of a step across where the way along is the one that turns the normal least:
  /// columns are as far apart as this allows. A column that is straight within half the room
  /// counts as bent by that: the way along ends with the patch.
  [[nodiscard]] double conjugate(double room_mm) const {
    const double bent = std::max(std::abs(along), 0.5 * room_mm);
    return across - mixed * mixed / std::copysign(bent, along);
  }
  /// What is left of the way up along the straightest way, in rooms: below 0 on saddles.
  [[nodiscard]] double left_up(double room_mm) const {
    const double bent = std::max(std::abs(across), 1e-6 * room_mm);
    return (along * (across < 0.0 ? -1.0 : 1.0) - mixed * mixed / bent) / room_mm;
  }
  [[nodiscard]] bool is_dome(double room_mm) const { return conjugate(room_mm) * along > 0.0; }
  [[nodiscard]] bool is_saddle() const { return mixed * mixed > across * along; }
  /// Columns that one step across of a saddle needs with so many rows, each column's vertices where
  /// way_to_next() says.
  [[nodiscard]] double columns_of_rows(int rows, double room_mm) const {
    const double half = 0.5 * along / (static_cast<double>(rows) * rows);
    return std::sqrt(std::max(0.0, mixed * mixed - across * along)) /
           (rows * std::hypot(room_mm, half));
  }
  /// From a vertex of a column to the middle of the two of the next one it is joined with, which
  /// are one of so many rows apart: one edge is off to one side as much as the other to the other.
  [[nodiscard]] double way_to_next(int rows) const {
    const double bent = across + 0.25 * along / (static_cast<double>(rows) * rows);
    const double root = std::sqrt(std::max(0.0, mixed * mixed - along * bent));
    return -bent / (mixed + std::copysign(root, mixed));
  }

  /// Columns that one step across needs with so many rows along; `room_mm`: eight tolerances. On
  /// domes isosceles triangles touch the tolerance over their circumcentre.
  [[nodiscard]] double columns(int rows, double room_mm) const {
    const double left = std::abs(conjugate(room_mm));
    if (!is_dome(room_mm)) return std::sqrt(std::min(left, 2.0 * std::abs(across)) / room_mm);
    const double base = std::min(std::abs(along) / (static_cast<double>(rows) * rows), room_mm);
    const double root = 0.5 * (std::sqrt(room_mm) + std::sqrt(room_mm - base));
    return std::sqrt(left) / root;
  }
  /// Steps along that such a column needs, `columns` of them to a step across; no dome.
  [[nodiscard]] double steps(double room_mm) const {
    double needed = std::sqrt(std::abs(along) / room_mm);
    // columns stand closer than their own way up would have them: it is nearly straight
    if (std::abs(conjugate(room_mm)) > 1.01 * room_mm)
      needed = std::max(needed, std::sqrt(std::abs(across * along - mixed * mixed)) / room_mm);
    return needed;
  }
};

/// From seven points: (0, 0), (0, 1) of the first column (of a step across), (1, 0), (1, 1), (1, 2)
/// of the middle one, (2, 1), (2, 2) of the last; scaled by so many of their steps.
[[nodiscard]] inline SurfaceForm surface_form(const std::array<Eigen::Vector3d, 7>& p,
                                              double across, double along) {
  const Eigen::Vector3d normal = (p[5] - p[1]).cross(p[4] - p[2]).normalized();
  const auto bend = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return -(from + to - 2.0 * p[3]).dot(normal);
  };
  const double a = bend(p[1], p[5]), g = bend(p[2], p[4]), both = bend(p[0], p[6]);
  const Eigen::Vector3d chord = (p[5] - p[1]).normalized(), bent = p[1] + p[5] - 2.0 * p[3];
  const double level = (bent - chord * bent.dot(chord)).norm();
  return {a * across * across, 0.5 * (both - a - g) * across * along, g * along * along,
          level * across * across};
}

}  // namespace trueflank
