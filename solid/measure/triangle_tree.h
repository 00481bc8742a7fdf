// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank {

using Point3 = Eigen::Vector3d;

/// Nearest point of a triangle (any, also without area).
[[nodiscard]] Point3 nearest_on_triangle(const Point3& point, const std::array<Point3, 3>& triangle);

/// Finds the triangle of a mesh nearest to a point: a tree of boxes.
/// Requires: indices in range, finite coordinates. Cost: n log n to build, about log n to ask.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Nearest {
    std::uint32_t triangle = 0;  ///< of the mesh
    double distance_mm = 0.0;
  };
  /// Requires: a mesh that is not empty. `hint`: a triangle likely to be near makes it faster.
  [[nodiscard]] Nearest nearest(const Point3& point, std::uint32_t hint = 0) const;

  /// What many questions together may cost. In a mesh of facets that all lie in one place, or of
  /// needles through one point, a box tells nothing and every question would go through all of
  /// them.
  struct Effort {
    std::size_t facets_left = 0;  ///< that may be looked at
    double near_enough_mm =
        0.0;            ///< a distance that is not worth to be told from 0, once it takes long
    bool exact = true;  ///< no question was cut short: else some distances are upper bounds
  };
  [[nodiscard]] Nearest nearest(const Point3& point, std::uint32_t hint, Effort& effort) const;

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] const std::array<Point3, 3>& corners(std::uint32_t triangle) const {
    return corners_[triangle];
  }

 private:
  struct Node {
    Point3 lower, upper;
    std::uint32_t first = 0, count = 0;  ///< leaf: range of order_; else count is 0
    std::uint32_t right = 0;             ///< the left child follows its parent
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last, std::vector<Point3>& centres);
  template <class Enough>
  [[nodiscard]] Nearest search(const Point3& point, std::uint32_t hint, const Enough& enough) const;
  [[nodiscard]] static double squared_distance(const Node& node, const Point3& p);

  std::vector<std::array<Point3, 3>> corners_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace trueflank
