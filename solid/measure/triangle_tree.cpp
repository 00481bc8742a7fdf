// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

constexpr std::uint32_t kLeaf = 4;
/// Facets and boxes that a question goes through before its effort counts: ordinary meshes need
/// fewer.
constexpr std::size_t kSurely = 96;

/// Among boxes that hold a point it says which is likelier to have the facet next to it.
template <class Node>
double from_middle2(const Node& node, const Point3& p) {
  return (0.5 * (node.lower + node.upper) - p).squaredNorm();
}

Point3 nearest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
  const Point3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return a + t * along;
}

}  // namespace

Point3 nearest_on_triangle(const Point3& p, const std::array<Point3, 3>& t) {
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0];
  const Point3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (area2 > 0.0) {
    const Point3 from_a = p - t[0];
    // barycentric coordinates of the foot on the plane
    const double v = from_a.cross(ac).dot(normal), w = ab.cross(from_a).dot(normal);
    if (v >= 0.0 && w >= 0.0 && v + w <= area2) return p - normal * (from_a.dot(normal) / area2);
  }
  Point3 best = nearest_on_segment(p, t[0], t[1]);
  for (const Point3& other : {nearest_on_segment(p, t[1], t[2]), nearest_on_segment(p, t[2], t[0])})
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  return best;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  std::vector<Point3> centres;
  corners_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    corners_.push_back({Point3(mesh.vertices[t[0]].data()), Point3(mesh.vertices[t[1]].data()),
                        Point3(mesh.vertices[t[2]].data())});
    const auto& c = corners_.back();
    centres.push_back(0.5 * (c[0].cwiseMin(c[1]).cwiseMin(c[2]) + c[0].cwiseMax(c[1]).cwiseMax(c[2])));
  }
  order_.resize(corners_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (!corners_.empty()) build(0, static_cast<std::uint32_t>(corners_.size()), centres);
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t last,
                                  std::vector<Point3>& centres) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Point3 lower = corners_[order_[first]][0], upper = lower;
  Point3 least = centres[order_[first]], most = least;
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Point3& c : corners_[order_[i]]) {
      lower = lower.cwiseMin(c);
      upper = upper.cwiseMax(c);
    }
    least = least.cwiseMin(centres[order_[i]]);
    most = most.cwiseMax(centres[order_[i]]);
  }
  nodes_[index].lower = lower;
  nodes_[index].upper = upper;
  if (last - first <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
    return index;
  }
  Eigen::Index axis = 0;
  (most - least).maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     if (centres[a][axis] != centres[b][axis]) return centres[a][axis] < centres[b][axis];
                     return a < b;  // the same tree everywhere
                   });
  build(first, middle, centres);
  const std::uint32_t right = build(middle, last, centres);
  nodes_[index].right = right;
  return index;
}

double TriangleTree::squared_distance(const Node& node, const Point3& p) {
  return (node.lower - p).cwiseMax(p - node.upper).cwiseMax(0.0).squaredNorm();
}

TriangleTree::Nearest TriangleTree::nearest(const Point3& point, std::uint32_t hint) const {
  return search(point, hint, [](std::size_t, double) { return false; });
}

TriangleTree::Nearest TriangleTree::nearest(const Point3& point, std::uint32_t hint,
                                            Effort& effort) const {
  std::size_t looked_at = 0;
  const double near2 = effort.near_enough_mm * effort.near_enough_mm;
  return search(point, hint, [&](std::size_t facets, double best2) {
    looked_at += facets;
    effort.facets_left -= std::min(effort.facets_left, facets);
    if (looked_at < kSurely) return false;
    if (best2 <= near2) return true;
    if (effort.facets_left > 0) return false;
    effort.exact = false;
    return true;
  });
}

/// `enough` is told how many facets were looked at since it was asked last.
template <class Enough>
TriangleTree::Nearest TriangleTree::search(const Point3& point, std::uint32_t hint,
                                           const Enough& enough) const {
  TRUEFLANK_EXPECTS(!empty());
  std::uint32_t best = hint < corners_.size() ? hint : 0;
  double best2 = (nearest_on_triangle(point, corners_[best]) - point).squaredNorm();
  struct Pending {
    std::uint32_t node;
    double distance2;
  };
  std::array<Pending, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, squared_distance(nodes_[0], point)};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (next.distance2 >= best2) continue;
    if (enough(1 + nodes_[next.node].count, best2)) break;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t t = order_[i];
      const double d2 = (nearest_on_triangle(point, corners_[t]) - point).squaredNorm();
      if (d2 < best2) best2 = d2, best = t;
    }
    if (node.count > 0) continue;
    Pending near{next.node + 1, squared_distance(nodes_[next.node + 1], point)};
    Pending far{node.right, squared_distance(nodes_[node.right], point)};
    const bool first_far =
        far.distance2 == near.distance2
            ? from_middle2(nodes_[far.node], point) < from_middle2(nodes_[near.node], point)
            : far.distance2 < near.distance2;
    if (first_far) std::swap(near, far);
    if (far.distance2 < best2) stack[depth++] = far;
    if (near.distance2 < best2) stack[depth++] = near;
  }
  return {best, std::sqrt(best2)};
}

}  // namespace trueflank
