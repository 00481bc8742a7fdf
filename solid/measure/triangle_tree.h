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

/// Finds the triangle of a mesh nearest to a point: a tree of boxes, four in a node.
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
        0.0;            ///< a distance that need not be distinguished from 0, once it takes long
    bool exact = true;  ///< no question was cut short: else some distances are upper bounds
  };
  /// A distance up to `known_mm` is not sharpened further: it is an upper bound then.
  [[nodiscard]] Nearest nearest(const Point3& point, std::uint32_t hint, Effort& effort,
                                double known_mm = 0.0) const;

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] const std::array<Point3, 3>& corners(std::uint32_t triangle) const {
    return corners_[triangle];
  }

 private:
  static constexpr std::size_t kWide = 4;   ///< children of a node, facets of a leaf
  static constexpr std::int32_t kNone = 0;  ///< no child: the root is nobody's
  /// Four numbers that the processor handles at once.
  using Four = float __attribute__((vector_size(4 * kWide)));
  using FourAxes = std::array<Four, 3>;

  /// Boxes of the children, in floats about origin_; those that are missing are infinitely far.
  struct Node {
    FourAxes lower, upper;
    /// Two directions square to each other and how far a child of few facets reaches along them:
    /// long facets that run aslant have thick boxes, and many of them hold the same place.
    std::array<FourAxes, 2> directions;
    std::array<Four, 2> least, most;
    std::array<std::int32_t, kWide> child;  ///< a node, or ~ of a leaf
  };
  /// Unit normals of the facets and of the walls that stand on their edges, outwards, about
  /// origin_: planes that a point lies beyond tell how far it is from the facet at least.
  struct Leaf {
    std::array<FourAxes, 4> normals;
    std::array<Four, 4> offsets;
    std::array<std::uint32_t, kWide> triangle;
    std::uint32_t count;
  };
  struct Box {
    std::array<float, 3> lower, upper;
  };
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t triangle;
  };
  /// A point as the boxes see it.
  struct Query {
    FourAxes at;
    Four margin;  ///< more than all rounding of coordinates and of planes
  };

  struct Subtree {
    std::int32_t child;
    Box box;
    Point3 normal = Point3::Zero(), along = Point3::Zero();  ///< of its facets, where they run
  };
  [[nodiscard]] std::array<float, 3> in_floats(const Point3& point) const;
  [[nodiscard]] bool all_equal(const Item* first, const Item* last) const;
  Subtree build(Item* first, Item* last);
  Subtree leaf_of(const Item* first, const Item* last);
  void add_slabs(Node& node, std::size_t c, const Subtree& child, const Item* first,
                 const Item* last) const;
  void add_planes(Leaf& leaf, std::size_t k, const std::array<Point3, 3>& corners) const;
  [[nodiscard]] Query query(const Point3& point) const;
  [[nodiscard]] static Four squared_from_boxes(const Node& node, const Query& query);
  [[nodiscard]] static Four squared_from_slabs(const Node& node, const Query& query);
  [[nodiscard]] static Four squared_from_middles(const Node& node, const Query& query);
  [[nodiscard]] static Four squared_from_facets(const Leaf& leaf, const Query& query);
  template <class Enough>
  [[nodiscard]] Nearest search(const Point3& point, std::uint32_t hint, const Enough& enough) const;

  std::vector<std::array<Point3, 3>> corners_;
  Point3 origin_ = Point3::Zero();
  double scale_ = 1.0;  ///< of coordinates in floats
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::int32_t root_ = 0;
};

}  // namespace trueflank
