// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

/// Facets and boxes that a question goes through before its effort counts: ordinary meshes need
/// fewer.
constexpr std::size_t kSurely = 96;
/// Children up to this many facets have slabs of their own.
constexpr std::ptrdiff_t kFewFacets = 256;
/// Of the coordinates: more than float rounds a coordinate, a plane through it and a difference of
/// two by (some 12 roundings of 2^-24 each).
constexpr float kFloatMargin = 1.5e-6F;
/// The farthest coordinate of a mesh in floats: between 1 and this.
constexpr float kReach = 2.0F;
/// More than the squares of floats, and their sum, are rounded by.
constexpr double kSquareMargin = 1.0 + 2e-6;

Point3 nearest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
  const Point3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return a + t * along;
}

/// Squared distance from a point to a segment; `from` leads from its beginning to the point.
inline double squared_from_segment(const Point3& from, const Point3& along) {
  const double length2 = along.squaredNorm(), on = from.dot(along);
  const double t = on <= 0.0 || !(length2 > 0.0) ? 0.0 : on >= length2 ? 1.0 : on / length2;
  return (from - t * along).squaredNorm();
}

/// Squared distance of a point from a triangle, or anything not below `bound2` where it is not
/// below that. Beyond the triangle the nearest place is on an edge that has the point on its outer
/// side.
inline double squared_from_triangle(const Point3& p, const std::array<Point3, 3>& t,
                                    double bound2) {
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0], from = p - t[0];
  const Point3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0.0)) return (nearest_on_triangle(p, t) - p).squaredNorm();
  const double height = from.dot(normal), height2 = height * height / area2;
  if (height2 >= bound2) return height2;
  const double v = from.cross(ac).dot(normal), w = ab.cross(from).dot(normal);
  if (v >= 0.0 && w >= 0.0 && v + w <= area2) return height2;
  double best2 = std::numeric_limits<double>::infinity();
  if (w < 0.0) best2 = squared_from_segment(from, ab);
  if (v < 0.0) best2 = std::min(best2, squared_from_segment(from, ac));
  if (v + w > area2) best2 = std::min(best2, squared_from_segment(p - t[1], t[2] - t[1]));
  return best2;
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
  corners_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    corners_.push_back({Point3(mesh.vertices[t[0]].data()), Point3(mesh.vertices[t[1]].data()),
                        Point3(mesh.vertices[t[2]].data())});
  if (corners_.empty()) return;
  Point3 lower = corners_[0][0], upper = lower;
  for (const auto& corners : corners_)
    for (const Point3& c : corners) {
      lower = lower.cwiseMin(c);
      upper = upper.cwiseMax(c);
    }
  origin_ = 0.5 * lower + 0.5 * upper;
  const double reach_mm = (upper - origin_).cwiseMax(origin_ - lower).maxCoeff();
  if (reach_mm > std::numeric_limits<double>::min()) scale_ = std::exp2(-std::ilogb(reach_mm));
  std::vector<Item> items(corners_.size());
  for (std::uint32_t t = 0; t < items.size(); ++t) {
    const auto& c = corners_[t];
    const Point3 centre =
        0.5 * c[0].cwiseMin(c[1]).cwiseMin(c[2]) + 0.5 * c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    items[t].centre = in_floats(centre);
    items[t].triangle = t;
  }
  nodes_.reserve(items.size() / 6 + 1);
  leaves_.reserve(items.size() / 2 + 1);
  root_ = build(items.data(), items.data() + items.size()).child;
}

namespace {

/// Halves items by the middle one along the axis in which they reach farthest.
template <class Item>
Item* halved(Item* first, Item* last) {
  std::array<float, 3> least = first->centre, most = least;
  for (const Item* i = first; i != last; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], i->centre[k]);
      most[k] = std::max(most[k], i->centre[k]);
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (most[k] - least[k] > most[axis] - least[axis]) axis = k;
  Item* middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [axis](const Item& a, const Item& b) {
    if (a.centre[axis] != b.centre[axis]) return a.centre[axis] < b.centre[axis];
    return a.triangle < b.triangle;  // the same tree everywhere
  });
  return middle;
}

/// A vector or its opposite: that which does not lead against another one.
Point3 same_way(const Point3& v, const Point3& other) {
  if (v.dot(other) < 0.0) return -v;
  return v;
}

Point3 longest_edge(const std::array<Point3, 3>& t) {
  Point3 longest = t[1] - t[0];
  for (const Point3& edge : {Point3(t[2] - t[1]), Point3(t[0] - t[2])})
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  return longest;
}

}  // namespace

/// About the origin, of some size between 1 and 2: as large or small as they may be, squares are
/// numbers.
std::array<float, 3> TriangleTree::in_floats(const Point3& point) const {
  const Point3 p = (point - origin_) * scale_;
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// Of facets that are all the same one is enough; in heaps of them boxes would tell nothing.
bool TriangleTree::all_equal(const Item* first, const Item* last) const {
  return std::all_of(first + 1, last, [&](const Item& item) {
    return item.centre == first->centre && corners_[item.triangle] == corners_[first->triangle];
  });
}

TriangleTree::Subtree TriangleTree::build(Item* first, Item* last) {
  if (all_equal(first, last)) last = first + 1;
  if (last - first <= static_cast<std::ptrdiff_t>(kWide)) return leaf_of(first, last);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const auto index = nodes_.size();
  nodes_.emplace_back();
  Item* middle = halved(first, last);
  std::array<Item*, kWide + 1> bounds{first, nullptr, middle, nullptr, last};
  for (const std::size_t half : {0U, 2U}) {
    Item *from = bounds[half], *to = bounds[half + 2];
    bounds[half + 1] = to - from <= static_cast<std::ptrdiff_t>(kWide) ? to : halved(from, to);
  }
  Subtree tree{static_cast<std::int32_t>(index), {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}}};
  for (std::size_t c = 0; c < kWide; ++c) {
    Subtree child{kNone, {{kFar, kFar, kFar}, {kFar, kFar, kFar}}};
    if (bounds[c] != bounds[c + 1]) {
      child = build(bounds[c], bounds[c + 1]);
      for (std::size_t k = 0; k < 3; ++k) {
        tree.box.lower[k] = std::min(tree.box.lower[k], child.box.lower[k]);
        tree.box.upper[k] = std::max(tree.box.upper[k], child.box.upper[k]);
      }
    }
    Node& node = nodes_[index];
    node.child[c] = child.child;
    add_slabs(node, c, child, bounds[c], bounds[c + 1]);
    tree.normal += child.normal;
    tree.along += same_way(child.along, tree.along);
    for (std::size_t k = 0; k < 3; ++k) {
      node.lower[k][c] = child.box.lower[k];
      node.upper[k][c] = child.box.upper[k];
    }
  }
  return tree;
}

TriangleTree::Subtree TriangleTree::leaf_of(const Item* first, const Item* last) {
  Subtree tree{~static_cast<std::int32_t>(leaves_.size()), {}};
  Leaf leaf{};
  Point3 lower = corners_[first->triangle][0], upper = lower;
  for (const Item* i = first; i != last; ++i) {
    for (const Point3& c : corners_[i->triangle]) {
      lower = lower.cwiseMin(c);
      upper = upper.cwiseMax(c);
    }
    const auto& t = corners_[i->triangle];
    tree.normal += (t[1] - t[0]).cross(t[2] - t[0]);
    tree.along += same_way(longest_edge(t), tree.along);
    leaf.triangle[leaf.count] = i->triangle;
    add_planes(leaf, leaf.count++, corners_[i->triangle]);
  }
  tree.box = {in_floats(lower), in_floats(upper)};
  leaves_.push_back(leaf);
  return tree;
}

/// Slabs along the normal, and across the facets.
void TriangleTree::add_slabs(Node& node, std::size_t c, const Subtree& child, const Item* first,
                             const Item* last) const {
  const double normal2 = child.normal.squaredNorm();
  const Point3 across = child.normal.cross(child.along);
  const double across2 = across.squaredNorm();
  for (std::size_t slab = 0; slab < 2; ++slab) {
    node.least[slab][c] = -std::numeric_limits<float>::infinity();
    node.most[slab][c] = std::numeric_limits<float>::infinity();
  }
  if (last - first > kFewFacets || !(normal2 > 0.0) || !(across2 > 0.0) || !std::isfinite(across2))
    return;
  const std::array<Point3, 2> directions{child.normal / std::sqrt(normal2),
                                         across / std::sqrt(across2)};
  std::array<double, 2> least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (const Item* i = first; i != last; ++i)
    for (const Point3& corner : corners_[i->triangle])
      for (std::size_t slab = 0; slab < 2; ++slab) {
        const double at = directions[slab].dot(corner - origin_);
        least[slab] = std::min(least[slab], at);
        most[slab] = std::max(most[slab], at);
      }
  for (std::size_t slab = 0; slab < 2; ++slab) {
    for (std::size_t a = 0; a < 3; ++a)
      node.directions[slab][a][c] =
          static_cast<float>(directions[slab][static_cast<Eigen::Index>(a)]);
    node.least[slab][c] = static_cast<float>(least[slab] * scale_);
    node.most[slab][c] = static_cast<float>(most[slab] * scale_);
  }
}

/// A facet without area has no planes: every point may be near it.
void TriangleTree::add_planes(Leaf& leaf, std::size_t k, const std::array<Point3, 3>& t) const {
  const Point3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  for (std::size_t plane = 0; plane < 4; ++plane) {
    Point3 out = normal;
    if (plane > 0) out = (t[plane % 3] - t[plane - 1]).cross(normal);
    const double length = out.norm();
    if (!(length > 0.0) || !std::isfinite(length)) continue;
    out /= length;
    for (std::size_t a = 0; a < 3; ++a)
      leaf.normals[plane][a][k] = static_cast<float>(out[static_cast<Eigen::Index>(a)]);
    const Point3& on = t[plane == 0 ? 0 : plane - 1];
    leaf.offsets[plane][k] = static_cast<float>(out.dot(on - origin_) * scale_);
  }
}

namespace {

template <class Four>
Four above_zero(const Four& x) {
  return x > 0.0F ? x : Four{};  // also of what is not a number
}
template <class Four>
Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}
template <class FourAxes>
auto dot(const FourAxes& a, const FourAxes& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

inline TriangleTree::Query TriangleTree::query(const Point3& point) const {
  const std::array<float, 3> at = in_floats(point);
  Query query;
  float reach = kReach;
  for (std::size_t k = 0; k < 3; ++k) {
    query.at[k] = Four{} + at[k];
    reach = std::max(reach, kReach + std::abs(at[k]));
  }
  query.margin = Four{} + kFloatMargin * reach;
  return query;
}

/// Lower bounds of the squared distances.
inline TriangleTree::Four TriangleTree::squared_from_boxes(const Node& node, const Query& query) {
  FourAxes off;
  for (std::size_t k = 0; k < 3; ++k)
    off[k] =
        above_zero(larger(node.lower[k] - query.at[k], query.at[k] - node.upper[k]) - query.margin);
  return dot(off, off);
}

/// As those from the boxes.
inline TriangleTree::Four TriangleTree::squared_from_slabs(const Node& node, const Query& query) {
  Four sum{};
  for (std::size_t slab = 0; slab < 2; ++slab) {
    const Four at = dot(node.directions[slab], query.at);
    const Four off = above_zero(larger(node.least[slab] - at, at - node.most[slab]) - query.margin);
    sum += off * off;
  }
  return sum;
}

/// Among boxes that hold a point it says which is likelier to have the facet next to it.
inline TriangleTree::Four TriangleTree::squared_from_middles(const Node& node, const Query& query) {
  FourAxes off;
  for (std::size_t k = 0; k < 3; ++k) off[k] = 0.5F * (node.lower[k] + node.upper[k]) - query.at[k];
  return dot(off, off);
}

/// Lower bounds of the squared distances: the facet's plane stands across its walls.
inline TriangleTree::Four TriangleTree::squared_from_facets(const Leaf& leaf, const Query& query) {
  const Four above = dot(leaf.normals[0], query.at) - leaf.offsets[0];
  const Four height = above_zero(larger(above, -above) - query.margin);
  Four beyond = dot(leaf.normals[1], query.at) - leaf.offsets[1];
  for (std::size_t wall = 2; wall < 4; ++wall)
    beyond = larger(beyond, dot(leaf.normals[wall], query.at) - leaf.offsets[wall]);
  beyond = above_zero(beyond - query.margin);
  return height * height + beyond * beyond;
}

TriangleTree::Nearest TriangleTree::nearest(const Point3& point, std::uint32_t hint) const {
  return search(point, hint, [](std::size_t, double) { return false; });
}

TriangleTree::Nearest TriangleTree::nearest(const Point3& point, std::uint32_t hint, Effort& effort,
                                            double known_mm) const {
  std::size_t looked_at = 0;
  const double near2 = effort.near_enough_mm * effort.near_enough_mm;
  const double known2 = known_mm * known_mm;
  return search(point, hint, [&](std::size_t facets, double best2) {
    looked_at += facets;
    effort.facets_left -= std::min(effort.facets_left, facets);
    if (best2 <= known2) return true;
    if (looked_at < kSurely) return false;
    if (best2 <= near2) return true;
    if (effort.facets_left > 0) return false;
    effort.exact = false;
    return true;
  });
}

/// `enough` is given how many boxes and facets were looked at since it was asked last.
template <class Enough>
TriangleTree::Nearest TriangleTree::search(const Point3& point, std::uint32_t hint,
                                           const Enough& enough) const {
  TRUEFLANK_EXPECTS(!empty());
  std::uint32_t best = hint < corners_.size() ? hint : 0;
  double best2 =
      squared_from_triangle(point, corners_[best], std::numeric_limits<double>::infinity());
  const Query at = query(point);
  // what a lower bound in float is compared with: not below what it stands for
  const auto limit_of = [square = scale_ * scale_ * kSquareMargin](double d2) {
    return static_cast<float>(d2 * square) + 16.0F * std::numeric_limits<float>::min();
  };
  float limit2 = limit_of(best2);
  struct Pending {
    std::int32_t child;
    float distance2, middle2;
  };
  std::array<Pending, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {root_, 0.0F, 0.0F};
  while (depth > 0 && best2 > 0.0) {
    const Pending next = stack[--depth];
    if (next.distance2 > limit2) continue;
    if (enough(1, best2)) break;
    if (next.child < 0) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(~next.child)];
      const Four least2 = squared_from_facets(leaf, at);
      std::size_t tried = 0;
      for (std::uint32_t i = 0; i < leaf.count; ++i) {
        if (least2[i] > limit2) continue;
        ++tried;
        const double d2 = squared_from_triangle(point, corners_[leaf.triangle[i]], best2);
        if (d2 < best2) best2 = d2, best = leaf.triangle[i], limit2 = limit_of(best2);
      }
      if (tried > 0 && enough(tried, best2)) break;
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(next.child)];
    const Four box2 = larger(squared_from_boxes(node, at), squared_from_slabs(node, at)),
               middle2 = squared_from_middles(node, at);
    const std::size_t bottom = depth;
    for (std::size_t c = 0; c < kWide; ++c) {
      if (node.child[c] == kNone || !(box2[c] <= limit2)) continue;
      // the nearest comes on top
      std::size_t place = depth++;
      for (; place > bottom &&
             (stack[place - 1].distance2 < box2[c] ||
              (stack[place - 1].distance2 == box2[c] && stack[place - 1].middle2 < middle2[c]));
           --place)
        stack[place] = stack[place - 1];
      stack[place] = {node.child[c], box2[c], middle2[c]};
    }
  }
  return {best, std::sqrt(best2)};
}

}  // namespace trueflank
