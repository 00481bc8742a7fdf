// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain twisted teeth as nets: each column has the rows its own curvature asks for.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

using Point3 = Eigen::Vector3d;

/// Rounds of finer rows and columns where facets do not keep the tolerance.
constexpr int kNetRounds = 10;
/// A net is measured, not bounded: what its error is taken for.
constexpr double kSafety = 0.99;

/// Of the surface at a place of the section, run counter-clockwise.
struct Bend {
  double length_mm = 0.0, turn_rad = 0.0;  ///< of the way looked at
  double support_mm = 0.0;
  double cosine = 0.0;  ///< of the normal and the section's plane
  [[nodiscard]] double curvature() const { return turn_rad / length_mm; }
  /// Curved to one side: no straight line lies on it.
  [[nodiscard]] bool is_dome() const { return curvature() * support_mm > 1.0; }
};

double support_at(const Curve& curve, double parameter) {
  const Point2 t = tangent_at(curve, parameter);
  return point_at(curve, parameter).dot(Point2(t.y(), -t.x()));
}

Bend bend_of(const Curve& curve, double from, double to, double turn_rad_per_mm) {
  const double middle = 0.5 * (from + to);
  const Point2 t0 = tangent_at(curve, from), t1 = tangent_at(curve, to),
               t = tangent_at(curve, middle);
  Bend bend;
  bend.length_mm = (point_at(curve, to) - point_at(curve, from)).norm();
  bend.turn_rad = std::atan2(cross(t0, t1), t0.dot(t1));
  if (const auto* involute = std::get_if<Involute>(&curve.shape)) {
    bend.turn_rad = involute->sense * (to - from);
    bend.support_mm = std::copysign(involute->base_radius_mm * middle, bend.turn_rad);
  } else {
    bend.support_mm = support_at(curve, middle);
  }
  bend.cosine = 1.0 / std::hypot(1.0, turn_rad_per_mm * point_at(curve, middle).dot(t));
  return bend;
}

bool is_developable(PieceKind kind) {
  return kind == PieceKind::kTip || kind == PieceKind::kRoot || kind == PieceKind::kInvolute;
}

/// A radial flank: no curvature along the section.
bool is_straight(const NetEdge& e) { return !e.developable && std::abs(e.turn_rad) < 1e-9; }

/// Columns for a piece, as their density at each of its samples, with a step of rows.
double column_density(const Bend& b, double step_rad, double room_mm) {
  const double bent = std::abs(b.curvature());
  if (b.is_dome()) {
    // isosceles triangles with this base touch the tolerance over their circumcentre
    const double base = std::min(std::abs(b.support_mm) * step_rad * step_rad * b.cosine, room_mm);
    const double root = 0.5 * (std::sqrt(room_mm) + std::sqrt(room_mm - base));
    return std::sqrt(bent * b.cosine) / root;
  }
  // along the section, and along what is conjugate to the axis, if that is near it
  const double conjugate = bent + std::min(1.0 / std::abs(b.support_mm), bent);
  return std::sqrt(conjugate * b.cosine / room_mm);
}

}  // namespace

double ToothingGrid::patch_turn_rad(std::size_t patch) const {
  return section_turn_rad(toothing_.twist, breaks_mm_[patch + 1]) -
         section_turn_rad(toothing_.twist, breaks_mm_[patch]);
}

/// The samples of its piece that an edge spans.
std::pair<std::size_t, std::size_t> ToothingGrid::samples_of(std::size_t edge) const {
  const HalfEdge& e = edges_[edge_of_[edge]];
  const Curve& curve = toothing_.profile->pieces()[e.piece].curve;
  const auto sample = [&](double parameter) {
    return kSamples * std::clamp((parameter - curve.begin) / (curve.end - curve.begin), 0.0, 1.0);
  };
  const auto from = std::min(static_cast<std::size_t>(sample(e.from) + 1e-6), kSamples - 1);
  const auto to = static_cast<std::size_t>(std::ceil(sample(e.to) - 1e-6));
  return {from, std::clamp(to, from + 1, kSamples)};
}

double ToothingGrid::aim_of(const Aims& aims_mm, std::size_t edge) const {
  const auto [from, to] = samples_of(edge);
  const auto& piece = aims_mm[middles_[edge].piece];
  return *std::min_element(piece.begin() + static_cast<std::ptrdiff_t>(from),
                           piece.begin() + static_cast<std::ptrdiff_t>(to));
}

/// Columns of fillets and other surfaces that are bent both ways, with the rows that make the
/// fewest facets of them. Flanks and lands keep the section's chords.
void ToothingGrid::spread_columns(const Aims& aims_mm, double widest_rad) {
  const double twist = toothing_.twist.turn_rad_per_mm;
  std::vector<HalfEdge> edges;
  for (std::size_t i = 0; i < edges_.size();) {
    const std::size_t piece = edges_[i].piece;
    const auto& [kind, curve] = toothing_.profile->pieces()[piece];
    std::size_t end = i;
    while (end < edges_.size() && edges_[end].piece == piece) ++end;
    if (is_developable(kind)) {
      std::vector<HalfEdge> chords(edges_.begin() + static_cast<std::ptrdiff_t>(i),
                                   edges_.begin() + static_cast<std::ptrdiff_t>(end));
      if (aims_mm[piece].front() < aims_mm.front().front()) {
        chords.clear();
        for (const auto& e : tessellate(*toothing_.profile, aims_mm[piece].front()).edges)
          if (static_cast<std::size_t>(e.piece) == piece) chords.push_back({piece, e.from, e.to});
      }
      edges.insert(edges.end(), chords.begin(), chords.end());
      i = end;
      continue;
    }
    const double from = edges_[i].from, to = edges_[end - 1].to;
    std::vector<Bend> bends;
    double steepest = 0.0;
    const double least_aim_mm = *std::min_element(aims_mm[piece].begin(), aims_mm[piece].end());
    bool dome = false;
    for (std::size_t k = 0; k < kSamples; ++k) {
      const auto share = static_cast<double>(k);
      bends.push_back(bend_of(curve, std::lerp(from, to, share / kSamples),
                              std::lerp(from, to, (share + 1.0) / kSamples), twist));
      steepest = std::max(steepest, std::abs(bends.back().support_mm) * bends.back().cosine);
      dome = dome || bends.back().is_dome();
    }
    const auto columns_at = [&](std::size_t k, double step_rad) {
      return bends[k].length_mm * column_density(bends[k], step_rad, 8.0 * aims_mm[piece][k]);
    };
    const auto columns_for = [&](double step_rad) {
      double sum = 0.0;
      for (std::size_t k = 0; k < kSamples; ++k) sum += columns_at(k, step_rad);
      return sum;
    };
    double step = std::sqrt(8.0 * least_aim_mm / steepest);
    double least = 1e300;
    if (dome) {
      const int fewest = std::max(1, static_cast<int>(std::ceil(widest_rad / step)));
      for (int rows = fewest; rows <= 2 * fewest + 1; ++rows) {
        const double facets = std::ceil(columns_for(widest_rad / rows)) * rows;
        if (facets < least) least = facets, step = widest_rad / rows;
      }
    }
    const double columns = columns_for(step);
    const int count = std::max(1, static_cast<int>(std::ceil(columns - 1e-9)));
    double at = from, sum = 0.0;
    int next = 1;
    for (std::size_t k = 0; k < kSamples; ++k) {
      const double more = columns_at(k, step) * count / columns;
      for (; next < count && sum + more >= next; ++next) {
        const double there =
            std::lerp(from, to, (static_cast<double>(k) + (next - sum) / more) / kSamples);
        edges.push_back({piece, at, there});
        at = there;
      }
      sum += more;
    }
    edges.push_back({piece, at, to});
    i = end;
  }
  edges_ = std::move(edges);
  place_columns();
}

/// The tooth's edges, counter-clockwise, as the net sees them.
std::vector<NetEdge> ToothingGrid::net_edges() const {
  const auto& pieces = toothing_.profile->pieces();
  const std::size_t n = points_.size();
  std::vector<NetEdge> edges(n);
  int region = 0;
  const auto point = [&](std::size_t i) {
    const Place& p = points_[i % n];
    return section_point(toothing_, {i < n ? 0 : 1, p.side, p.piece, p.parameter}, 0.0);
  };
  const auto same_region = [&](std::size_t a, std::size_t b) {
    const PieceKind kind = pieces[middles_[a].piece].kind;
    if (middles_[a].piece != middles_[b].piece) return false;
    return kind == PieceKind::kTip || kind == PieceKind::kRoot ||
           middles_[a].side == middles_[b].side;
  };
  for (std::size_t i = 0; i < n; ++i) {
    NetEdge& e = edges[i];
    if (i > 0 && !same_region(i - 1, i)) ++region;
    e.region = region;
    const auto& [kind, curve] = pieces[middles_[i].piece];
    e.developable = is_developable(kind);
    const Point2 a = point(i), b = point(i + 1);
    e.length_mm = (b - a).norm();
    if (kind == PieceKind::kTip || kind == PieceKind::kRoot) {
      e.turn_rad = std::atan2(cross(a, b), a.dot(b));
      e.support_mm = e.support_from_mm = e.support_to_mm = a.norm();
      continue;
    }
    const HalfEdge& half = edges_[edge_of_[i]];
    const Bend bend = bend_of(curve, half.from, half.to, toothing_.twist.turn_rad_per_mm);
    e.turn_rad = bend.turn_rad;
    e.support_mm = bend.support_mm;
    e.cosine = bend.cosine;
    const auto end_support = [&bend, &on = curve](double parameter) {
      if (const auto* involute = std::get_if<Involute>(&on.shape))
        return std::copysign(involute->base_radius_mm * parameter, bend.support_mm);
      return support_at(on, parameter);
    };
    e.support_from_mm = end_support(half.from), e.support_to_mm = end_support(half.to);
    if (middles_[i].side < 0) std::swap(e.support_from_mm, e.support_to_mm);
  }
  if (same_region(n - 1, 0))  // the gap's land begins before the tooth does
    for (NetEdge& e : edges)
      if (e.region == region) e.region = 0;
  return edges;
}

/// Steps of rows, in turns of the section, that each column keeps the tolerance with.
std::vector<double> ToothingGrid::column_steps(const std::vector<NetEdge>& edges,
                                               const Aims& aims_mm) const {
  const std::size_t n = edges.size();
  std::vector<double> steps(n, 1e300);
  const auto bound = [&](std::size_t column, double step) {
    double& bounded = steps[column % n];
    bounded = std::min(bounded, step);
  };
  // a ridge departs from its chords in the plane of the section
  const auto ridge = [&](std::size_t column, double aim_mm) {
    const Place& p = points_[column % n];
    const double radius = section_point(toothing_, {0, p.side, p.piece, p.parameter}, 0.0).norm();
    bound(column, 2.0 * std::acos(1.0 - std::min(1.0, aim_mm / radius)));
  };
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i + 1;
    while (end < n && edges[end].region == edges[i].region) ++end;
    const std::size_t piece = middles_[i].piece;
    const double first_aim = aims_mm[piece].front(), room = 8.0 * first_aim;
    const PieceKind kind = toothing_.profile->pieces()[piece].kind;
    if (kind == PieceKind::kTip || kind == PieceKind::kRoot) {
      if (i > 0 || kind == PieceKind::kTip) ridge(i, first_aim);
      if (end < n || kind == PieceKind::kTip) ridge(end, first_aim);
    } else if (edges[i].developable) {
      // by its own helix, and by edges across, half as wide as the far border's steps
      const double from = std::abs(edges[i].support_from_mm),
                   to = std::abs(edges[end - 1].support_to_mm);
      const double across = 2.0 * std::sqrt(room / (0.5 * (from + to) * edges[i].cosine));
      bound(i, std::min(across, std::sqrt(room / (from * edges[i].cosine))));
      bound(end, std::min(across, std::sqrt(room / (to * edges[i].cosine))));
    } else {
      double dome = 1e300;
      for (std::size_t k = i; k < end; ++k) {
        const NetEdge& e = edges[k];
        const double edge_room = 8.0 * aim_of(aims_mm, k);
        const double support = std::abs(e.support_mm) * e.cosine;
        if (e.turn_rad / e.length_mm * e.support_mm > 1.0) {
          const double bent = std::abs(e.turn_rad) * e.length_mm * e.cosine;
          const double base = 4.0 * (std::sqrt(edge_room * bent) - bent);
          dome = std::min(dome, std::sqrt(std::clamp(base, 0.1 * edge_room, edge_room) / support));
          continue;
        }
        // by its own helix, and by the one diagonal that lies towards it
        const double length = e.length_mm, bent = std::abs(e.turn_rad) * length;
        if (is_straight(e)) {
          bound(k, edge_room / (length * e.cosine)), bound(k + 1, edge_room / (length * e.cosine));
          continue;
        }
        for (const auto& [column, at] :
             {std::pair(k, e.support_from_mm), std::pair(k + 1, e.support_to_mm)}) {
          const double reach = std::max(std::abs(at), 1e-9 * length);
          const double whole = edge_room / e.cosine;
          const double diagonal =
              (whole + bent) / (length + std::sqrt(length * length + reach * (whole + bent)));
          bound(column, std::min(diagonal, std::sqrt(whole / reach)));
        }
      }
      if (dome < 1e300)
        for (std::size_t k = i; k <= end; ++k) bound(k, dome);
    }
    i = end;
  }
  if (toothing_.profile->pieces().front().kind != PieceKind::kTip)
    ridge(n / 2, aims_mm.front().front());
  return steps;
}

/// Rows of a patch: evenly spread on each column; on domes every other column has them between its
/// neighbours', and so has the far end of a straight line.
std::vector<std::vector<double>> ToothingGrid::inner_rows(const std::vector<NetEdge>& edges,
                                                          const std::vector<double>& steps,
                                                          double turn_rad) const {
  const std::size_t n = edges.size();
  std::vector<std::vector<double>> inner(n);
  for (std::size_t i = 0; i < n; ++i) {
    const NetEdge &before = edges[(i + n - 1) % n], &after = edges[i];
    const bool inside = before.region == after.region;
    if (inside && after.developable) continue;
    const int parts =
        std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / steps[i] - 1e-9)));
    const bool dome = after.turn_rad * after.support_mm > after.length_mm;
    std::size_t since = 0;  // columns from the region's beginning
    while (since < i && edges[i - since - 1].region == after.region) ++since;
    const bool between = parts > 1 && ((inside && dome && since % 2 == 1) ||
                                       (is_straight(before) && !is_straight(after)));
    for (int k = between ? 0 : 1; k < parts; ++k)
      inner[i].push_back((k + (between ? 0.5 : 0.0)) / parts);
  }
  return inner;
}

/// Raises, by piece, the largest distance of facets from the surface; lands are right by their
/// steps.
void ToothingGrid::measure_net(const NetPatch& net, const std::vector<NetEdge>& edges,
                               std::size_t patch, Aims& error_mm) const {
  const std::size_t n = edges.size();
  const double low = breaks_mm_[patch], high = breaks_mm_[patch + 1];
  const double twist_rad_per_mm = patch_turn_rad(patch) / (high - low);
  for (std::size_t t = 0; t < net.facets.size(); ++t) {
    const auto& facet = net.facets[t];
    const int first = std::min({facet[0].column, facet[1].column, facet[2].column});
    const std::size_t edge = static_cast<std::size_t>(first) % n;
    const Place& surface = middles_[edge];
    const PieceKind kind = toothing_.profile->pieces()[surface.piece].kind;
    if (kind == PieceKind::kTip || kind == PieceKind::kRoot) continue;
    double largest = 0.0;
    struct At {
      double parameter, z;
    };
    std::array<At, 3> place;
    std::array<Point3, 3> corner;
    const auto on_surface = [&](const At& p) {
      const auto point = at({surface.side, surface.piece, p.parameter}, 0, p.z);
      return Point3(point.data());
    };
    const auto normal_at = [&](const At& p) {
      const Curve& curve = toothing_.profile->pieces()[surface.piece].curve;
      const Point2 along = tangent_at(curve, p.parameter);
      const Point2 forwards = surface.side > 0 ? along : Point2(-along.x(), along.y());
      const Point2 on =
          section_point(toothing_, {0, surface.side, surface.piece, p.parameter}, p.z);
      const Point2 outwards =
          rotated(Point2(forwards.y(), -forwards.x()), section_turn_rad(toothing_.twist, p.z));
      return Point3(outwards.x(), outwards.y(), twist_rad_per_mm * on.dot(forwards)).normalized();
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const NetNode& node = facet[k];
      const auto column = static_cast<std::size_t>(node.column) % n;
      const auto& rows = net.inner[column];
      const auto row = static_cast<std::size_t>(node.row);
      const double share = row == 0 ? 0.0 : row > rows.size() ? 1.0 : rows[row - 1];
      // a column at the region's end is the end of its last edge
      const bool at_end = net.region[t] != edges[column].region;
      const HalfEdge& e = edges_[edge_of_[at_end ? (column + n - 1) % n : column]];
      const bool up = surface.side > 0;
      place[k] = {at_end == up ? e.to : e.from, std::lerp(low, high, share)};
      corner[k] = on_surface(place[k]);
    }
    std::array<double, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const At &p = place[k], &q = place[(k + 1) % 3];
      // of a point of the edge from the tangent plane near it
      const auto off = [&](double share) {
        const At on{std::lerp(p.parameter, q.parameter, share), std::lerp(p.z, q.z, share)};
        const Point3 away = corner[k] + share * (corner[(k + 1) % 3] - corner[k]) - on_surface(on);
        return away.dot(normal_at(on));
      };
      middle[k] = off(0.5);
      if (edges[edge].developable)
        for (const double share : {0.25, 0.75}) largest = std::max(largest, std::abs(off(share)));
    }
    largest = std::max(largest, triangle_error(middle[0], middle[1], middle[2]));
    const auto [from, to] = edges[edge].developable
                                ? std::pair<std::size_t, std::size_t>(0, kSamples)
                                : samples_of(edge);
    for (std::size_t k = from; k < to; ++k)
      error_mm[surface.piece][k] = std::max(error_mm[surface.piece][k], largest);
  }
}

bool ToothingGrid::tighten(Aims& aims_mm, const Aims& error_mm, double tolerance_mm) {
  bool tightened = false;
  for (std::size_t piece = 0; piece < aims_mm.size(); ++piece)
    for (std::size_t k = 0; k < kSamples; ++k) {
      if (error_mm[piece][k] <= tolerance_mm) continue;
      tightened = true;
      aims_mm[piece][k] *= std::clamp(0.99 * tolerance_mm / error_mm[piece][k], 0.8, 0.98);
    }
  return tightened;
}

void ToothingGrid::try_net(double tolerance_mm) {
  const std::vector<HalfEdge> chords = edges_;
  double widest = 0.0;
  for (std::size_t k = 0; k + 1 < breaks_mm_.size(); ++k)
    widest = std::max(widest, std::abs(patch_turn_rad(k)));
  Aims aims(toothing_.profile->pieces().size());
  for (auto& piece : aims) piece.fill(tolerance_mm);
  for (int round = 0; round < kNetRounds; ++round) {
    edges_ = chords;
    spread_columns(aims, widest);
    const std::vector<NetEdge> edges = net_edges();
    const std::vector<double> steps = column_steps(edges, aims);
    patches_.clear();
    Aims errors(aims.size(), std::array<double, kSamples>{});
    for (std::size_t k = 0; k + 1 < breaks_mm_.size(); ++k) {
      const double turn = patch_turn_rad(k);
      const bool as_before = k > 0 && std::abs(turn - patch_turn_rad(k - 1)) < 1e-12;
      patches_.push_back(as_before ? patches_.back()
                                   : net_patch(edges, inner_rows(edges, steps, turn), turn));
      if (!as_before) measure_net(patches_.back(), edges, k, errors);
    }
    if (!tighten(aims, errors, tolerance_mm)) {
      heights_mm_ = breaks_mm_;
      facet_error_mm_ = tolerance_mm / kSafety;
      return;
    }
  }
  patches_.clear();
  edges_ = chords;
  place_columns();
}

std::vector<std::array<double, 3>> ToothingGrid::inner_points(std::size_t patch) const {
  std::vector<Point> result;
  const double low = breaks_mm_[patch], high = breaks_mm_[patch + 1];
  if (!teeth_alike_) {
    for (int k = 0; k < teeth_; ++k)
      for (std::size_t i = 0; i < points_.size(); ++i)
        for (const double share : patches_[patch].inner[i])
          result.push_back(in_part(points_[i], k, std::lerp(low, high, share)));
    return result;
  }
  std::vector<Point3> tooth;  // before it is turned
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (const double share : patches_[patch].inner[i]) {
      const Place& p = points_[i];
      const double z = std::lerp(low, high, share);
      const Point2 turned = rotated(section_point(toothing_, place_at(p, 0, z), z),
                                    outline_->rotation_rad + section_turn_rad(toothing_.twist, z));
      tooth.push_back({turned.x(), turned.y(), z + outline_->z_lower_mm});
    }
  result.reserve(tooth.size() * static_cast<std::size_t>(teeth_));
  for (int k = 0; k < teeth_; ++k) {
    const Point2 direction = unit_vector(kTwoPi * k / teeth_);
    for (const Point3& p : tooth)
      result.push_back({direction.x() * p.x() - direction.y() * p.y(),
                        direction.y() * p.x() + direction.x() * p.y(), p.z()});
  }
  return result;
}

}  // namespace trueflank
