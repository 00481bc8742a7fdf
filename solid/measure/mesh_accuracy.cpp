// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_accuracy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "trueflank/base/always_inline.h"
#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/measure/outline_distance.h"
#include "trueflank/solid/measure/segment_fan.h"
#include "trueflank/solid/measure/wall_surface.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Sine of the angle up to which a facet counts as plane face or as wall.
constexpr double kSteep = 0.05;
/// Chords longer than this part of the outline's size are looked at in more places than the middle.
constexpr double kLongChord = 0.01;
/// Samples of a true curve for each chord that the error found would need.
constexpr double kSamplesPerChord = 2.0;
constexpr int kLeastSamples = 5, kMostSamples = 4000;
/// Heights, as shares of a slab, at which a mesh is cut whose sections differ: in no simple ratio.
constexpr std::array kCutShares = {0.013, 0.171, 0.337, 0.523, 0.689, 0.854, 0.987};
/// The same over the height of a bed chamfer.
constexpr std::array kBedShares = {0.07, 0.41, 0.83};
/// At each of these heights one sample in so many of the true curve is looked at, at the next the
/// next.
constexpr std::size_t kSampleStride = 3;
/// Edges on a twisted wall longer than this part of its radius are looked at in three places.
constexpr double kLongEdge = 0.05;
/// One facet in so many of a twisted wall is looked at in its middle, too.
constexpr std::size_t kFacetsPerMiddle = 4;
/// A chord over a bend is farthest off near one of its ends, but in its middle nearly half as far.
/// Where that is as much as this share of the largest distance yet, one edge in so many (teeth and
/// rows repeat each) is looked at beside its middle, and where it is off as much there, up to the
/// place that is farthest.
constexpr double kWorthALook = 0.3, kAsMuchBeside = 0.9;
constexpr std::uint32_t kEdgesPerLook = 3;

/// Points folded into half a tooth that lie this near to each other are copies; so much may their
/// distances differ.
constexpr double kSamePlace_mm = 1e-9;
/// A sum with this is rounded to 2^-14 mm, the size of the cells in which places are kept.
constexpr double kRoundsToCell_mm = 0x1.8p38;
constexpr std::size_t kPlaceBits = 12;  // of so many places

/// The distances of places on a wall, by where they are folded to: teeth are copies of each other,
/// and so are most places of a mesh.
class KnownPlaces {
 public:
  struct Place {
    std::size_t slab = 0, wall = 0;
    Point2 folded = Point2::Constant(std::numeric_limits<double>::infinity());
    double excess_mm = 0.0;
  };
  /// The last that was kept in the cell of a place.
  [[nodiscard]] Place& at(const Point2& folded) {
    if (places_.empty()) places_.resize(std::size_t{1} << kPlaceBits);
    const auto cell = [](double mm) { return std::bit_cast<std::uint64_t>(mm + kRoundsToCell_mm); };
    constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15U;
    const std::uint64_t hash = (cell(folded.x()) * kSpread ^ cell(folded.y())) * kSpread;
    return places_[hash >> (64U - kPlaceBits)];
  }

 private:
  std::vector<Place> places_;
};

/// An outline of a slab: its curves and the cut's segments that lie on it.
struct Wall {
  OutlineDistance curves;
  bool hole = false;
  std::optional<WallSurface> surface = {};      ///< of a wall that is no prism
  std::vector<std::vector<Segment>> cuts = {};  ///< one a height of the slab's
  double alone_mm = 0.0;                        ///< no other wall of the slab is nearer to it
  double error_mm = 0.0;                        ///< largest found from the facets' side
  Point2 error_foot = Point2::Zero();           ///< where on the curve
};

struct SlabWalls {
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  std::vector<Wall> walls;
  bool prismatic = true;
  std::vector<double> cut_heights_mm = {};
  std::size_t last_nearest = 0;  ///< the wall that the point measured last belongs to
};

double bed_height_mm(const Slab& slab) {
  double height = bed_height_mm(slab.outer) - slab.z_lower_mm;
  for (const Outline& hole : slab.holes)
    height = std::max(height, bed_height_mm(hole) - slab.z_lower_mm);
  return std::max(0.0, height);
}

SlabWalls walls_of(const Slab& slab) {
  SlabWalls result{slab.z_lower_mm, slab.z_upper_mm, {}};
  const auto add = [&](const Outline& outline, bool hole) {
    result.walls.push_back({.curves = OutlineDistance(outline),
                            .hole = hole,
                            .surface = wall_surface(outline, slab.z_lower_mm)});
    result.prismatic = result.prismatic && !result.walls.back().surface;
  };
  add(slab.outer, false);
  for (const Outline& hole : slab.holes) add(hole, true);
  if (result.prismatic)
    for (Wall& wall : result.walls) {
      wall.alone_mm = std::numeric_limits<double>::infinity();
      for (const Wall& other : result.walls)
        if (&other != &wall)
          wall.alone_mm = std::min(wall.alone_mm, wall.curves.lower_bound_mm(other.curves));
    }
  auto& heights = result.cut_heights_mm;
  if (result.prismatic)
    heights = {0.5 * (slab.z_lower_mm + slab.z_upper_mm)};
  else
    for (const double share : kCutShares)
      heights.push_back(std::lerp(slab.z_lower_mm, slab.z_upper_mm, share));
  if (const double bed = bed_height_mm(slab); bed > 0.0)
    for (const double share : kBedShares) heights.push_back(slab.z_lower_mm + share * bed);
  for (Wall& wall : result.walls) wall.cuts.resize(heights.size());
  return result;
}

struct NearestWall {
  std::size_t wall = 0;
  double excess_mm = 0.0;  ///< distance, positive with too much material
  Point2 foot = Point2::Zero();
};

class Measurement {
 public:
  Measurement(const TriangleMesh& mesh, const PartShape& shape) : mesh_(mesh) {
    TRUEFLANK_EXPECTS(!shape.slabs.empty());
    for (const Slab& slab : shape.slabs) {
      planes_mm_.push_back(slab.z_lower_mm);
      slabs_.push_back(walls_of(slab));
    }
    planes_mm_.push_back(shape.slabs.back().z_upper_mm);
    measured_.assign(mesh.vertices.size(), -1);
    if (std::any_of(slabs_.begin(), slabs_.end(), [](const SlabWalls& s) { return !s.prismatic; }))
      vertex_walls_.assign(mesh.vertices.size(), 0);
  }

  Accuracy run() {
    for (const auto& t : mesh_.triangles) measure_triangle(t);
    for (SlabWalls& slab : slabs_)
      for (Wall& wall : slab.walls) measure_curves(slab, wall);
    return result_;
  }

 private:
  [[nodiscard]] Point3 vertex(std::uint32_t v) const { return Point3(mesh_.vertices[v].data()); }

  void facet_is_off(double distance_mm, const Point3& place) {
    if (!(distance_mm > result_.facets_to_surface_mm)) return;
    if (distance_mm > result_.largest_mm())
      result_.worst_place_mm = {place.x(), place.y(), place.z()};
    result_.facets_to_surface_mm = distance_mm;
  }

  [[nodiscard]] std::size_t slab_at(double z_mm) const {
    std::size_t s = 0;
    while (s + 1 < slabs_.size() && z_mm > slabs_[s].z_upper_mm) ++s;
    return s;
  }
  [[nodiscard]] double plane_distance_mm(const Point3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (double plane : planes_mm_) nearest = std::min(nearest, std::abs(p.z() - plane));
    if (nearest == 0.0) return nearest;
    // the edge of a face goes with displaced teeth
    for (const Wall& wall : slabs_[slab_at(p.z())].walls)
      if (wall.surface)
        for (double plane : planes_mm_)
          nearest = std::min(nearest, std::abs(undisplaced_z_mm(*wall.surface, p) - plane));
    return nearest;
  }
  [[nodiscard]] double outside_stack_mm(double z_mm) const {
    return std::max({0.0, planes_mm_.front() - z_mm, z_mm - planes_mm_.back()});
  }

  /// `first` is looked at first: the others will be too far to look at where it is the nearest.
  [[nodiscard]] TRUEFLANK_ALWAYS_INLINE static NearestWall nearest_wall(const SlabWalls& slab,
                                                                        const Point3& point,
                                                                        std::size_t first) {
    NearestWall nearest{.wall = 0, .excess_mm = std::numeric_limits<double>::infinity()};
    look_at(slab, first, point, nearest);
    for (std::size_t w = 0; w < slab.walls.size(); ++w)
      if (w != first) look_at(slab, w, point, nearest);
    return nearest;
  }
  // Always inline: this and what calls it, once for every place of a mesh.
  TRUEFLANK_ALWAYS_INLINE static double lower_bound_mm(const Wall& wall, const Point3& p) {
    return wall.surface ? trueflank::lower_bound_mm(*wall.surface, p)
                        : wall.curves.lower_bound_mm(p.head<2>());
  }
  TRUEFLANK_ALWAYS_INLINE static void look_at(const SlabWalls& slab, std::size_t index,
                                              const Point3& point, NearestWall& nearest) {
    const Point2 p = point.head<2>();
    const Wall& wall = slab.walls[index];
    if (lower_bound_mm(wall, point) >= std::abs(nearest.excess_mm)) return;
    if (wall.surface) {
      const double distance = distance_mm(*wall.surface, point);
      if (std::abs(distance) < std::abs(nearest.excess_mm))
        nearest = {index, wall.hole ? -distance : distance, p};
      return;
    }
    const OutlineFoot foot = wall.curves.foot(p);
    if (std::abs(foot.distance_mm) < std::abs(nearest.excess_mm))
      nearest = {index, wall.hole ? -foot.distance_mm : foot.distance_mm, foot.point};
  }

  void measure_triangle(const std::array<std::uint32_t, 3>& t) {
    const std::array<Point3, 3> corner{vertex(t[0]), vertex(t[1]), vertex(t[2])};
    const Point3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const double length = normal.norm();
    if (!(length > 0.0)) return;
    const std::size_t slab = slab_at((corner[0].z() + corner[1].z() + corner[2].z()) / 3.0);
    if (std::hypot(normal.x(), normal.y()) <= kSteep * length) {
      for (const Point3& p : corner) facet_is_off(plane_distance_mm(p), p);
      return;
    }
    if (!slabs_[slab].prismatic) {
      bool no_prism = true;
      for (std::size_t i = 0; i < 3; ++i)
        no_prism = slabs_[slab].walls[wall_of_corner(t[i], slab)].surface && no_prism;
      if (no_prism) {
        measure_twisted_facet(corner, slab);
        last_wall_ = vertex_walls_[t[0]];
        cut_triangle(corner, slab);
        return;
      }
    }
    if (std::abs(normal.z()) <= kSteep * length) {
      measure_wall_facet(t, corner, slab);
      cut_triangle(corner, slab);
    } else {
      measure_slanting_facet(corner, slab);
      cut_triangle(corner, slabs_.size());
    }
  }

  /// Measures a corner once a slab; the wall it belongs to.
  std::size_t wall_of_corner(std::uint32_t v, std::size_t slab) {
    const auto stamp = static_cast<std::int32_t>(slab);
    if (measured_[v] != stamp) vertex_walls_[v] = measure_on_wall(slab, vertex(v));
    measured_[v] = stamp;
    return vertex_walls_[v];
  }

  /// A facet of a wall that is no prism, its corners measured: places along the edges, where all
  /// surfaces but domes are farthest, and of some facets the middle. An edge has two facets: it is
  /// looked at with the one that runs it upwards in the order of its coordinates.
  void measure_twisted_facet(const std::array<Point3, 3>& corner, std::size_t slab) {
    if (twisted_facets_++ % kFacetsPerMiddle == 0)
      measure_on_wall(slab, (corner[0] + corner[1] + corner[2]) / 3.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 &from = corner[i], &to = corner[(i + 1) % 3];
      if (!std::lexicographical_compare(from.begin(), from.end(), to.begin(), to.end())) continue;
      const bool is_long =
          (to - from).squaredNorm() > std::pow(kLongEdge, 2) * from.head<2>().squaredNorm();
      // by no rule that the rows of a grid could follow
      const bool look = is_long || (edges_++ * 2654435761U >> 16U) % kEdgesPerLook == 0;
      measure_edge(slab, from, to, look);
      if (is_long)
        for (const double share : {0.25, 0.75}) measure_on_wall(slab, from + share * (to - from));
    }
  }

  /// An edge in its middle; with `look_beside` also beside it, where it could be farther off than
  /// all yet. Returns the wall the middle belongs to.
  std::size_t measure_edge(std::size_t slab, const Point3& from, const Point3& to,
                           bool look_beside) {
    const auto distance_at = [&](double share) {
      measure_on_wall(slab, from + share * (to - from));
      return last_distance_mm_;
    };
    const double yet = result_.facets_to_surface_mm;
    const std::size_t wall = measure_on_wall(slab, 0.5 * (from + to));
    const double middle = last_distance_mm_;
    if (!look_beside || middle < kWorthALook * yet) return wall;
    for (const double quarter : {0.25, 0.75}) {
      double share = quarter, largest = distance_at(share);
      if (largest < kAsMuchBeside * middle) continue;
      for (double step = 0.125; step > 0.02; step *= 0.5)
        for (const double next : {share - step, share + step})
          if (const double there = distance_at(next); there > largest)
            largest = there, share = next;
    }
    return wall;
  }

  /// A facet of a wall seen from above is a chord.
  void measure_wall_facet(const std::array<std::uint32_t, 3>& t,
                          const std::array<Point3, 3>& corner, std::size_t slab) {
    const auto stamp = static_cast<std::int32_t>(slab);
    for (std::size_t i = 0; i < 3; ++i) {
      if (measured_[t[i]] == stamp) continue;
      measured_[t[i]] = stamp;
      // the vertex below or above was measured just before: walls come in rows
      if (corner[i].head<2>() != last_vertex_ || slab != last_slab_)
        measure_on_wall(slab, corner[i]);
      else
        facet_is_off(outside_stack_mm(corner[i].z()), corner[i]);
      last_vertex_ = corner[i].head<2>();
    }
    std::size_t longest = 0;
    double length = -1.0;
    for (std::size_t e = 0; e < 3; ++e) {
      const double l = (corner[(e + 1) % 3] - corner[e]).head<2>().squaredNorm();
      if (l > length) longest = e, length = l;
    }
    const Point3 &from = corner[longest], &to = corner[(longest + 1) % 3];
    // the other triangle of a rectangle is seen from above as the same chord
    const bool same =
        slab == last_slab_ && ((from.head<2>() == last_from_ && to.head<2>() == last_to_) ||
                               (to.head<2>() == last_from_ && from.head<2>() == last_to_));
    if (same) return;
    last_slab_ = slab;
    last_from_ = from.head<2>();
    last_to_ = to.head<2>();
    if (length <= std::pow(kLongChord, 2) * from.head<2>().squaredNorm()) {
      last_wall_ = measure_edge(slab, from, to, true);
      return;
    }
    constexpr int kParts = 8;
    for (int i = 1; i < kParts; ++i)
      last_wall_ = measure_on_wall(slab, from + (to - from) * (static_cast<double>(i) / kParts));
  }

  /// Returns the wall the point belongs to.
  std::size_t measure_on_wall(std::size_t slab, const Point3& p) {
    const std::size_t likely = slabs_[slab].last_nearest;
    const Wall& wall = slabs_[slab].walls[likely];
    const auto place = wall.surface ? std::nullopt : wall.curves.place_of_copies(p.head<2>());
    if (!place) return measure_place(slab, p).wall;
    KnownPlaces::Place& known = known_places_.at(*place);
    const bool copy = known.slab == slab && known.wall == likely &&
                      std::abs(known.folded.x() - place->x()) < kSamePlace_mm &&
                      std::abs(known.folded.y() - place->y()) < kSamePlace_mm;
    if (copy && tells_nothing(slab, likely, known.excess_mm, p)) {
      last_distance_mm_ = std::abs(known.excess_mm);
      return likely;
    }
    const NearestWall nearest = measure_place(slab, p);
    if (nearest.wall == likely) known = {slab, likely, *place, nearest.excess_mm};
    return nearest.wall;
  }

  /// Whether a place whose copy was measured on a wall belongs to that wall and is no farther off
  /// than others.
  [[nodiscard]] bool tells_nothing(std::size_t slab, std::size_t index, double excess_mm,
                                   const Point3& p) const {
    const std::vector<Wall>& walls = slabs_[slab].walls;
    const double most_mm = std::abs(excess_mm) + 2.0 * kSamePlace_mm;
    if (most_mm > walls[index].error_mm ||
        excess_mm + 2.0 * kSamePlace_mm > result_.most_excess_mm ||
        excess_mm - 2.0 * kSamePlace_mm < result_.most_deficit_mm ||
        most_mm + outside_stack_mm(p.z()) > result_.facets_to_surface_mm)
      return false;
    if (most_mm < 0.5 * walls[index].alone_mm) return true;
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (w != index && lower_bound_mm(walls[w], p) <= most_mm) return false;
    return true;
  }

  TRUEFLANK_ALWAYS_INLINE NearestWall measure_place(std::size_t slab, const Point3& p) {
    const NearestWall nearest = nearest_wall(slabs_[slab], p, slabs_[slab].last_nearest);
    slabs_[slab].last_nearest = nearest.wall;
    last_distance_mm_ = std::abs(nearest.excess_mm);
    Wall& wall = slabs_[slab].walls[nearest.wall];
    if (std::abs(nearest.excess_mm) > wall.error_mm) {
      wall.error_mm = std::abs(nearest.excess_mm);
      wall.error_foot = nearest.foot;
    }
    result_.most_excess_mm = std::max(result_.most_excess_mm, nearest.excess_mm);
    result_.most_deficit_mm = std::min(result_.most_deficit_mm, nearest.excess_mm);
    facet_is_off(std::hypot(nearest.excess_mm, outside_stack_mm(p.z())), p);
    return nearest;
  }

  /// Neither wall nor plane face: no part has such facets, so a coarse measure will do.
  void measure_slanting_facet(const std::array<Point3, 3>& corner, std::size_t slab) {
    constexpr int kParts = 4;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const double u = static_cast<double>(i) / kParts, v = static_cast<double>(j) / kParts;
        const Point3 p = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
        const double excess = nearest_wall(slabs_[slab], p, slabs_[slab].last_nearest).excess_mm;
        facet_is_off(std::min(plane_distance_mm(p), std::hypot(excess, outside_stack_mm(p.z()))),
                     p);
      }
  }

  /// Keeps where a facet crosses the heights at which slabs are cut. In its own slab a wall facet
  /// has just been measured.
  void cut_triangle(const std::array<Point3, 3>& corner, std::size_t measured_slab) {
    const double lower = std::min({corner[0].z(), corner[1].z(), corner[2].z()});
    const double upper = std::max({corner[0].z(), corner[1].z(), corner[2].z()});
    for (std::size_t s = 0; s < slabs_.size(); ++s)
      for (std::size_t k = 0; k < slabs_[s].cut_heights_mm.size(); ++k) {
        const double z = slabs_[s].cut_heights_mm[k];
        if (z < lower || z > upper) continue;
        std::array<Point2, 2> ends;
        std::size_t count = 0;
        for (std::size_t e = 0; e < 3; ++e) {
          const Point3 &a = corner[e], &b = corner[(e + 1) % 3];
          if ((a.z() < z) == (b.z() < z)) continue;
          ends[count++] = (a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>();
        }
        if (count != 2) continue;
        std::size_t wall = last_wall_;
        if (s != measured_slab) {
          const Point2 middle = 0.5 * (ends[0] + ends[1]);
          wall = measure_on_wall(s, {middle.x(), middle.y(), z});
        }
        slabs_[s].walls[wall].cuts[k].push_back({ends[0], ends[1]});
      }
  }

  // ------------------------------------------------------------ from the surface to the facets

  struct Worst {
    double distance_mm = -1.0, parameter = 0.0, step = 0.0;
    std::size_t piece = 0;
    int copy = 0;
  };

  /// The true curves of a wall at a height, and the mesh's cut there.
  struct TrueCurves {
    const Wall& wall;
    const SegmentFan& fan;
    double z_mm;
    [[nodiscard]] Point2 place(std::size_t piece, double parameter, int copy) const {
      if (wall.surface) return point_at_height(*wall.surface, piece, parameter, copy, z_mm);
      return wall.curves.to_outline(point_at(wall.curves.pieces()[piece].curve, parameter), copy);
    }
    /// Square to the surface; where even the distance within the plane is less than `least_mm`,
    /// that.
    [[nodiscard]] double distance_mm(std::size_t piece, double parameter, int copy,
                                     double least_mm) const {
      const double within = fan.distance_mm(place(piece, parameter, copy));
      if (!wall.surface || within <= least_mm) return within;
      return within * slope_share(*wall.surface, piece, parameter, copy, z_mm);
    }
  };

  void measure_curves(const SlabWalls& slab, Wall& wall) {
    for (std::size_t k = 0; k < wall.cuts.size(); ++k) measure_curves_at(slab, wall, k);
  }

  void measure_curves_at(const SlabWalls& slab, Wall& wall, std::size_t height) {
    std::vector<Segment>& cut = wall.cuts[height];
    const double z_mm = slab.cut_heights_mm[height];
    if (cut.empty()) {  // the wall is missing: whatever else is there is far away
      for (const Wall& other : slab.walls)
        cut.insert(cut.end(), other.cuts[height].begin(), other.cuts[height].end());
      if (cut.empty()) {
        surface_is_off(std::numeric_limits<double>::infinity(), Point2::Zero(), z_mm);
        return;
      }
    }
    const SegmentFan fan(std::move(cut), wall.curves.centre());
    const TrueCurves curves{wall, fan, z_mm};
    Worst worst;
    for (std::size_t i = 0; i < wall.curves.pieces().size(); ++i) sample(curves, height, i, worst);
    refine(curves, worst);
    surface_is_off(worst.distance_mm, curves.place(worst.piece, worst.parameter, worst.copy), z_mm);
    if (!wall.surface) surface_is_off(fan.distance_mm(wall.error_foot), wall.error_foot, z_mm);
    wall.cuts[height].clear();
  }

  void surface_is_off(double distance_mm, const Point2& place, double z_mm) {
    if (!(distance_mm > result_.surface_to_facets_mm)) return;
    if (distance_mm > result_.largest_mm()) result_.worst_place_mm = {place.x(), place.y(), z_mm};
    result_.surface_to_facets_mm = distance_mm;
  }

  static void sample(const TrueCurves& curves, std::size_t height, std::size_t index,
                     Worst& worst) {
    const Wall& wall = curves.wall;
    const OutlineDistance::Piece& piece = wall.curves.pieces()[index];
    // a curve of length s that turns by t needs sqrt(s t / (8 error)) chords, spread at their best
    const double error = std::max(wall.error_mm, 1e-6);
    const double chords = std::sqrt(piece.length_mm * piece.turning_rad / (8.0 * error));
    const int samples =
        std::clamp(static_cast<int>(kSamplesPerChord * chords), kLeastSamples, kMostSamples);
    const double span = piece.curve.end - piece.curve.begin;
    for (int i = 0; i <= samples; ++i) {
      const double parameter = piece.curve.begin + span * i / samples;
      const Point2 on_piece = point_at(piece.curve, parameter);
      for (int copy = 0; copy < wall.curves.copies(); ++copy) {
        if (wall.surface && (static_cast<std::size_t>(i + copy) + height) % kSampleStride != 0)
          continue;
        const double distance =
            wall.surface ? curves.distance_mm(index, parameter, copy, worst.distance_mm)
                         : curves.fan.distance_mm(wall.curves.to_outline(on_piece, copy));
        if (distance > worst.distance_mm)
          worst = {distance, parameter, span / samples, index, copy};
      }
    }
    if (wall.surface) sample_breaks(curves, index, span / samples, worst);
  }

  /// Where a deviation breaks, facets are farthest off if no edge lies there: nearer to it than
  /// samples are to each other, if what begins there is low.
  static void sample_breaks(const TrueCurves& curves, std::size_t index, double step,
                            Worst& worst) {
    for (int copy = 0; copy < curves.wall.curves.copies(); ++copy)
      for (const double at : breaks_at_height(*curves.wall.surface, index, copy, curves.z_mm)) {
        const double distance = curves.distance_mm(index, at, copy, worst.distance_mm);
        if (distance > worst.distance_mm) worst = {distance, at, step, index, copy};
      }
  }

  /// Climbs to the largest distance next to the worst sample.
  static void refine(const TrueCurves& curves, Worst& worst) {
    const Curve& curve = curves.wall.curves.pieces()[worst.piece].curve;
    const double low = std::min(curve.begin, curve.end), high = std::max(curve.begin, curve.end);
    for (double step = 0.5 * worst.step; std::abs(step) > 0.01 * std::abs(worst.step); step *= 0.5)
      for (double sign : {-1.0, 1.0}) {
        const double at = std::clamp(worst.parameter + sign * step, low, high);
        const double distance = curves.distance_mm(worst.piece, at, worst.copy, worst.distance_mm);
        if (distance <= worst.distance_mm) continue;
        worst.distance_mm = distance;
        worst.parameter = at;
      }
  }

  const TriangleMesh& mesh_;
  std::vector<SlabWalls> slabs_;
  std::vector<double> planes_mm_;
  std::vector<std::int32_t> measured_;     ///< slab a vertex was last measured in
  std::vector<std::size_t> vertex_walls_;  ///< of vertices measured in slabs that are no prisms
  std::size_t twisted_facets_ = 0;
  std::uint32_t edges_ = 0;  ///< of twisted walls
  KnownPlaces known_places_;
  double last_distance_mm_ = 0.0;              ///< of measure_on_wall()
  std::size_t last_slab_ = 0, last_wall_ = 0;  ///< of the chord measured last
  Point2 last_from_ = Point2::Zero(), last_to_ = Point2::Zero(), last_vertex_ = Point2::Zero();
  Accuracy result_;
};

}  // namespace

Accuracy measure_accuracy(const TriangleMesh& mesh, const PartShape& shape) {
  return Measurement(mesh, shape).run();
}

}  // namespace trueflank
