// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_compare.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/measure/triangle_tree.h"

namespace trueflank {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Above the tolerance, or the largest distance known, a bound is not worth sharpening further.
constexpr double kSharpness = 1.01;
/// How far a piece may stick out over the triangle it lies over, as shares of the bound, tried in turn:
/// much for a rim that stands out, nothing where the piece is also off to one side.
constexpr double kSlacks[] = {1.0, 0.5, 0.0};
/// Narrower leftovers of a cut are rounding; a neighbour speaks for them.
constexpr double kNarrowest_mm = 1e-9;
/// Looks a facet may take on the average before the bound is left as it is.
constexpr std::size_t kLooksPerFacet = 400;
/// Facets of the other mesh that all looks may go through, for each facet: ten times what
/// tessellations that differ in everything take.
constexpr std::size_t kEffortPerFacet = 1500;
constexpr std::size_t kLeastEffort = 3'000'000;
/// Distances below this share of the tolerance, and not the largest, are not sharpened.
constexpr double kNearEnough = 1e-2;
/// Of the largest coordinate: a foot on a facet is rounded by less, in units of the last place.
constexpr double kRoundings = 16.0;

using Polygon = std::vector<Point3>;
using Corners = std::span<const Point3>;  ///< of a polygon

Point3 centroid(Corners polygon) {
  Point3 sum = Point3::Zero();
  for (const Point3& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

double radius_about(Corners polygon, const Point3& centre) {
  double radius2 = 0.0;
  for (const Point3& p : polygon) radius2 = std::max(radius2, (p - centre).squaredNorm());
  return std::sqrt(radius2);
}

double area_of(Corners polygon) {
  Point3 twice = Point3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return 0.5 * twice.norm();
}

/// Splits a convex polygon by a plane: what lies below it (normal . x <= offset), what above.
struct Split {
  Polygon below, above;
};
Split split(const Polygon& polygon, const Point3& normal, double offset) {
  Split parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double at_a = normal.dot(a) - offset, at_b = normal.dot(b) - offset;
    if (at_a <= 0.0) parts.below.push_back(a);
    if (at_a >= 0.0) parts.above.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) {
      const Point3 crossing = a + (b - a) * (at_a / (at_a - at_b));
      parts.below.push_back(crossing);
      parts.above.push_back(crossing);
    }
  }
  return parts;
}

std::array<Point3, 3> corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {Point3(mesh.vertices[t[0]].data()), Point3(mesh.vertices[t[1]].data()),
          Point3(mesh.vertices[t[2]].data())};
}

/// The largest coordinate of any vertex that a facet has.
double farthest_coordinate_mm(const TriangleMesh& mesh) {
  double farthest = 0.0;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (const double c : mesh.vertices[v]) farthest = std::max(farthest, std::abs(c));
  return farthest;
}

/// The mesh from which distances are told. Of another copy of a mesh the facet in the same place of
/// the list answers nearly every question: the tree is built when more than a few are left, and
/// these go through all facets.
class Facets {
 public:
  explicit Facets(const TriangleMesh& mesh) : mesh_(mesh) {}

  [[nodiscard]] std::size_t size() const { return mesh_.triangles.size(); }
  [[nodiscard]] std::array<Point3, 3> corners(std::uint32_t triangle) const {
    return corners_of(mesh_, triangle);
  }
  [[nodiscard]] double distance_mm(const Point3& p, std::uint32_t triangle) const {
    return (nearest_on_triangle(p, corners(triangle)) - p).norm();
  }
  [[nodiscard]] TriangleTree::Nearest nearest(const Point3& p, std::uint32_t hint,
                                              TriangleTree::Effort& effort, double known_mm) {
    if (!tree_ && asked_++ < kFew) return nearest_of_all(p, hint);
    if (!tree_) tree_.emplace(mesh_);
    return tree_->nearest(p, hint, effort, known_mm);
  }

 private:
  static constexpr std::size_t kFew = 32;  ///< a tree costs as much as some more of them

  [[nodiscard]] TriangleTree::Nearest nearest_of_all(const Point3& p, std::uint32_t hint) const {
    TriangleTree::Nearest best{hint, distance_mm(p, hint)};
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (least_mm(p, t) >= best.distance_mm) continue;
      const double distance = distance_mm(p, t);
      if (distance < best.distance_mm) best = {t, distance};
    }
    return best;
  }
  /// How far a facet is at least: from its box, along one axis.
  [[nodiscard]] double least_mm(const Point3& p, std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    const auto &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    double least = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = p[static_cast<Eigen::Index>(k)];
      least = std::max({least, std::min({a[k], b[k], c[k]}) - at, at - std::max({a[k], b[k], c[k]})});
    }
    return least;
  }

  const TriangleMesh& mesh_;
  std::optional<TriangleTree> tree_;
  std::size_t asked_ = 0;
};

/// Distances of one mesh's surface from another mesh.
class Directed {
 public:
  Directed(const TriangleMesh& mesh, const TriangleMesh& other, double tolerance_mm)
      : mesh_(mesh),
        other_(other),
        tolerance_mm_(tolerance_mm),
        rounding_mm_(kRoundings * std::numeric_limits<double>::epsilon() *
                     std::max(farthest_coordinate_mm(mesh), farthest_coordinate_mm(other))) {
    effort_.facets_left = kLeastEffort + kEffortPerFacet * mesh.triangles.size();
    effort_.near_enough_mm = std::max(kNearEnough * tolerance_mm, rounding_mm_);
  }

  SurfaceDistance run() {
    std::uint32_t hint = look_from_corners();
    looks_left_ = kLooksPerFacet * mesh_.triangles.size() + 100000;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto corners = corners_of(mesh_, t);
      if (t < other_.size() && is_copied(corners, t)) {
        hint = t;
        continue;
      }
      hint = settle(corners, hint);
      while (!pending_.empty()) {
        const Polygon polygon = std::move(pending_.back());
        pending_.pop_back();
        hint = settle(polygon, hint);
      }
    }
    result_.bound_mm = std::max(result_.bound_mm, result_.largest_mm);
    result_.exact = effort_.exact;
    result_.rms_mm = area_ > 0.0 ? std::sqrt(weighted_squares_ / area_) : 0.0;
    result_.share_beyond = area_ > 0.0 ? beyond_ / area_ : 0.0;
    return result_;
  }

 private:
  /// A corner matters where it is farther away than all before it. Where the other mesh is another
  /// copy of this one the facet in the same place of the list says how far it is at most; those
  /// that may be farthest are asked first, and soon none is left that may be farther.
  std::uint32_t look_from_corners() {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> facet_of(mesh_.vertices.size(), kNone);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::uint32_t v : mesh_.triangles[t]) facet_of[v] = std::min(facet_of[v], t);
    struct Corner {
      double at_most_mm;
      std::uint32_t vertex;
    };
    std::vector<Corner> copied;
    std::uint32_t hint = 0;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (facet_of[v] == kNone) continue;
      const double at_most_mm =
          facet_of[v] < other_.size()
              ? other_.distance_mm(Point3(mesh_.vertices[v].data()), facet_of[v])
              : kInfinity;
      if (at_most_mm <= std::max(result_.largest_mm, rounding_mm_)) continue;
      if (at_most_mm <= tolerance_mm_)
        copied.push_back({at_most_mm, v});
      else
        hint = look(Point3(mesh_.vertices[v].data()), hint, result_.largest_mm).triangle;
    }
    std::stable_sort(copied.begin(), copied.end(), [](const Corner& a, const Corner& b) {
      return a.at_most_mm > b.at_most_mm;
    });
    for (const Corner& corner : copied) {
      if (corner.at_most_mm <= result_.largest_mm) break;
      look(Point3(mesh_.vertices[corner.vertex].data()), facet_of[corner.vertex],
           result_.largest_mm);
    }
    return hint;
  }

  /// Settles a facet where the one in the same place of the other list lies as near as matters.
  bool is_copied(const std::array<Point3, 3>& corners, std::uint32_t triangle) {
    const double bound = reach_mm(corners, triangle);
    if (bound > good_enough_mm()) return false;
    const double distance = other_.distance_mm(centroid(corners), triangle);
    if (distance > not_sharpened_mm()) return false;
    done(corners, bound, distance);
    return true;
  }

  /// Distance of one point, exactly where it is above `known_mm`.
  TriangleTree::Nearest look(const Point3& p, std::uint32_t hint, double known_mm = 0.0) {
    const TriangleTree::Nearest nearest = other_.nearest(p, hint, effort_, known_mm);
    if (nearest.distance_mm > result_.largest_mm) {
      result_.largest_mm = nearest.distance_mm;
      result_.worst_place_mm = {p.x(), p.y(), p.z()};
    }
    return nearest;
  }

  /// Up to here a distance from above does for the mean, and is no new largest one.
  [[nodiscard]] double not_sharpened_mm() const {
    return std::min(effort_.near_enough_mm, std::max(result_.largest_mm, rounding_mm_));
  }
  [[nodiscard]] double good_enough_mm() const {
    return std::max({tolerance_mm_, kSharpness * result_.largest_mm, rounding_mm_});
  }
  /// Largest distance of a convex polygon from one triangle: that of a corner.
  [[nodiscard]] double reach_mm(Corners polygon, std::uint32_t triangle) const {
    double reach2 = 0.0;
    const auto corners = other_.corners(triangle);
    for (const Point3& p : polygon)
      reach2 = std::max(reach2, (nearest_on_triangle(p, corners) - p).squaredNorm());
    return std::sqrt(reach2);
  }

  void done(Corners polygon, double bound_mm, double distance_mm) {
    const double area = area_of(polygon);
    area_ += area;
    weighted_squares_ += area * distance_mm * distance_mm;
    if (distance_mm > tolerance_mm_) beyond_ += area;
    result_.bound_mm = std::max(result_.bound_mm, bound_mm);
  }

  /// Bounds a piece, or cuts it into pieces that will be; returns the triangle it lies over.
  std::uint32_t settle(Corners polygon, std::uint32_t hint) {
    const Point3 centre = centroid(polygon);
    const TriangleTree::Nearest nearest =
        look(centre, hint, not_sharpened_mm());
    const double radius = radius_about(polygon, centre);
    const double bound =
        std::min(reach_mm(polygon, nearest.triangle), nearest.distance_mm + radius);
    if (bound <= good_enough_mm() || radius <= kNarrowest_mm || looks_left_ == 0 ||
        effort_.facets_left == 0) {
      done(polygon, bound, nearest.distance_mm);
      return nearest.triangle;
    }
    --looks_left_;
    const Polygon pieces(polygon.begin(), polygon.end());
    if (!cut_along(pieces, nearest.triangle, nearest.distance_mm)) halve(pieces);
    return nearest.triangle;
  }

  /// Takes from a piece what lies over a triangle and is near enough to it; false where that is nothing.
  /// The piece may stick out beyond an edge by the slack, else it is cut off there.
  bool cut_along(const Polygon& polygon, std::uint32_t triangle, double distance_mm) {
    const auto c = other_.corners(triangle);
    const Point3 normal = (c[1] - c[0]).cross(c[2] - c[0]);
    if (!(normal.squaredNorm() > 0.0)) return false;
    for (double share : kSlacks) {
      const double slack = share * good_enough_mm();
      const std::size_t before = pending_.size();
      Polygon over = polygon;
      for (std::size_t e = 0; e < 3 && is_something(over); ++e) {
        const Point3 outward = (c[(e + 1) % 3] - c[e]).cross(normal).normalized();
        const double edge = outward.dot(c[e]);
        const bool sticks_out = std::any_of(over.begin(), over.end(), [&](const Point3& p) {
          return outward.dot(p) - edge > slack;
        });
        if (!sticks_out) continue;
        Split parts = split(over, outward, edge);
        if (is_something(parts.above)) pending_.push_back(std::move(parts.above));
        over = std::move(parts.below);
      }
      if (is_something(over)) {
        const double bound = reach_mm(over, triangle);
        if (bound <= good_enough_mm()) {
          done(over, bound, distance_mm);
          return true;
        }
      }
      pending_.resize(before);
    }
    return false;
  }

  [[nodiscard]] static bool is_something(const Polygon& polygon) {
    if (polygon.size() < 3) return false;
    const double length = 2.0 * radius_about(polygon, polygon.front());
    return area_of(polygon) > kNarrowest_mm * length;
  }

  void halve(const Polygon& polygon) {
    std::size_t longest = 0;
    double length2 = -1.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const double l = (polygon[(i + 1) % polygon.size()] - polygon[i]).squaredNorm();
      if (l > length2) length2 = l, longest = i;
    }
    const Point3 &a = polygon[longest], &b = polygon[(longest + 1) % polygon.size()];
    const Point3 along = (b - a).normalized();
    Split parts = split(polygon, along, along.dot(0.5 * (a + b)));
    if (parts.below.size() >= 3) pending_.push_back(std::move(parts.below));
    if (parts.above.size() >= 3) pending_.push_back(std::move(parts.above));
  }

  const TriangleMesh& mesh_;
  Facets other_;
  double tolerance_mm_;
  double rounding_mm_;  ///< shorter distances cannot be told from 0
  std::vector<Polygon> pending_;
  std::size_t looks_left_ = 0;
  TriangleTree::Effort effort_;
  double area_ = 0.0, weighted_squares_ = 0.0, beyond_ = 0.0;
  SurfaceDistance result_;
};

MeshSummary summary_of(const TriangleMesh& mesh, const MeshValidity& validity) {
  MeshSummary summary{.vertices = mesh.vertices.size(),
                      .triangles = mesh.triangles.size(),
                      .components = validity.components,
                      .volume_mm3 = validity.volume_mm3};
  summary.closed = !mesh.triangles.empty() && validity.open_edges == 0 &&
                   validity.misoriented_edges == 0 && validity.non_manifold_vertices == 0 &&
                   validity.coordinates_finite;
  bool first = true;
  for (const auto& t : mesh.triangles) {
    std::array<Point3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& p = mesh.vertices[t[c]];
      corners[c] = Point3(p.data());
      for (std::size_t i = 0; i < 3; ++i) {
        summary.lower_mm[i] = first ? p[i] : std::min(summary.lower_mm[i], p[i]);
        summary.upper_mm[i] = first ? p[i] : std::max(summary.upper_mm[i], p[i]);
      }
      first = false;
    }
    summary.area_mm2 += area_of(corners);
  }
  return summary;
}

}  // namespace

MeshComparison compare_meshes(const TriangleMesh& golden, const TriangleMesh& made,
                              const CompareOptions& options) {
  TRUEFLANK_EXPECTS(options.tolerance_mm > 0.0);
  const MeshValidity golden_validity = mesh_validity(golden), made_validity = mesh_validity(made);
  TRUEFLANK_EXPECTS(golden_validity.indices_in_range && made_validity.indices_in_range);
  MeshComparison comparison{.golden = summary_of(golden, golden_validity),
                            .made = summary_of(made, made_validity),
                            .from_golden = {},
                            .from_new = {}};
  if (golden.triangles.empty() || made.triangles.empty() || !golden_validity.coordinates_finite ||
      !made_validity.coordinates_finite) {
    const SurfaceDistance endless{kInfinity, kInfinity, kInfinity, 1.0, {}};
    comparison.from_golden = comparison.from_new = endless;
    return comparison;
  }
  const auto measure = [&](const TriangleMesh& mesh, const TriangleMesh& other) {
    return Directed(mesh, other, options.tolerance_mm).run();
  };
  auto other_way = begun_beside([&] { return measure(made, golden); });
  comparison.from_golden = measure(golden, made);
  comparison.from_new = other_way.get();
  const double bound_mm = std::max(comparison.from_golden.bound_mm, comparison.from_new.bound_mm);
  comparison.same = comparison.largest_mm() <= options.tolerance_mm &&
                    bound_mm <= kSharpness * kSharpness * options.tolerance_mm;
  return comparison;
}

}  // namespace trueflank
