// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/face_view.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank::io {
namespace {

constexpr int kLooks = 720;  // places on a circle where it is asked whether something is in front

struct Disc {
  Point2 centre = Point2::Zero();
  double radius = 0.0;
};

/// One slab as an obstacle.
struct Cover {
  double z = 0.0;
  Disc outer;
  std::vector<Disc> holes;

  [[nodiscard]] bool hides(const Point2& p) const {
    if ((p - outer.centre).norm() > outer.radius - tolerance::kSameSize_mm) return false;
    return std::none_of(holes.begin(), holes.end(), [&](const Disc& hole) { return (p - hole.centre).norm() < hole.radius + tolerance::kSameSize_mm; });
  }
};

struct Curve {
  Disc disc;
  std::vector<Point2> corners;
  Pen pen = Pen::kThick;
  double z = 0.0;
  bool hole_off_axis = false;
};

/// Of teeth the tip circle: what is seen of a ring, and of a gear from the side.
double seen_radius(const Outline& outline) {
  if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) return teeth->profile->tip_radius_mm();
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) return circle->radius_mm;
  return 0.5 * std::get<BoreOutline>(outline).bore.diameter_mm;
}

Point2 centre_of(const Outline& outline) {
  const auto* circle = std::get_if<CircleOutline>(&outline);
  return circle ? circle->centre : Point2::Zero();
}

/// The edge of a bore that is not round; arcs in pieces of 5 degrees.
std::vector<Point2> corners_of(const BoreDesign& bore) {
  std::vector<Point2> corners;
  for (const BoreEdge& edge : bore_edges(bore)) {
    corners.push_back(edge.from);
    if (!edge.arc) continue;
    const double a = std::atan2(edge.from.y(), edge.from.x()), sweep = wrapped_rad(std::atan2(edge.to.y(), edge.to.x()) - a);
    const int pieces = std::max(1, static_cast<int>(std::ceil(sweep / rad_from_deg(5.0))));
    for (int i = 1; i < pieces; ++i) corners.push_back(edge.from.norm() * unit_vector(a + sweep * i / pieces));
  }
  return corners;
}

class View {
 public:
  explicit View(const std::vector<ViewedBody>& bodies) {
    for (const ViewedBody& body : bodies)
      for (const Slab& slab : body.part->slabs) add(body, slab);
    std::stable_sort(curves_.begin(), curves_.end(), [](const Curve& a, const Curve& b) { return a.z < b.z; });
    std::stable_sort(covers_.begin(), covers_.end(), [](const Cover& a, const Cover& b) { return a.z < b.z; });
  }

  std::vector<ViewedEdge> edges() {
    for (std::size_t i = 0; i < curves_.size(); ++i)
      if (!drawn_before(i)) look_at(curves_[i]);
    return std::move(edges_);
  }

 private:
  void add(const ViewedBody& body, const Slab& slab) {
    const auto placed = [&](const Point2& p) { return Point2(rotated(p, body.rotation_rad) + body.offset); };
    const double z = body.z_mm + slab.z_lower_mm;
    Cover cover{z, {placed(centre_of(slab.outer)), seen_radius(slab.outer)}, {}};
    const auto add_curves = [&](const Outline& outline, bool hole) {
      const Point2 own = centre_of(outline), centre = placed(own);
      const auto put = [&](double radius, Pen pen) { curves_.push_back({{centre, radius}, {}, pen, z, hole && own.norm() > tolerance::kSameSize_mm}); };
      put(seen_radius(outline), Pen::kThick);
      if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
        put(reference_radius_mm(teeth->profile->gear()), Pen::kChain);
        put(teeth->profile->root_radius_mm(), Pen::kThin);
      } else if (const auto* bore = std::get_if<BoreOutline>(&outline); bore && bore->bore.kind != BoreKind::kRound) {
        for (const Point2& p : corners_of(bore->bore)) curves_.back().corners.push_back(placed(p));
      }
    };
    add_curves(slab.outer, false);
    for (const Outline& hole : slab.holes) {
      cover.holes.push_back({placed(centre_of(hole)), seen_radius(hole)});
      add_curves(hole, true);
    }
    covers_.push_back(std::move(cover));
  }

  /// The same circle was met nearer to the eye.
  [[nodiscard]] bool drawn_before(std::size_t i) const {
    const Curve& curve = curves_[i];
    return std::any_of(curves_.begin(), curves_.begin() + static_cast<std::ptrdiff_t>(i), [&](const Curve& other) {
      return other.pen == curve.pen && other.corners.empty() == curve.corners.empty() &&
             (other.disc.centre - curve.disc.centre).norm() < tolerance::kSameSize_mm && std::abs(other.disc.radius - curve.disc.radius) < tolerance::kSameSize_mm;
    });
  }

  [[nodiscard]] bool hidden(const Curve& curve, const Point2& p) const {
    for (const Cover& cover : covers_) {
      if (cover.z > curve.z - tolerance::kSameSize_mm) return false;
      if (cover.hides(p)) return true;
    }
    return false;
  }

  [[nodiscard]] Point2 at(const Curve& curve, double angle_rad) const { return curve.disc.centre + curve.disc.radius * unit_vector(angle_rad); }

  void look_at(const Curve& curve) {
    const auto edge = [&](double from, double to, bool unseen) {
      edges_.push_back({curve.disc.centre, curve.disc.radius, from, to, curve.corners, curve.pen, unseen, curve.hole_off_axis});
    };
    std::vector<double> changes;
    const bool first = hidden(curve, at(curve, 0.0));
    bool before = first;
    for (int i = 1; i <= kLooks; ++i) {
      const double a = kTwoPi * i / kLooks;
      const bool now = i == kLooks ? first : hidden(curve, at(curve, a));
      if (now != before) changes.push_back(change(curve, a - kTwoPi / kLooks, a, before));
      before = now;
    }
    if (changes.empty() || !curve.corners.empty()) return edge(0.0, kTwoPi, first);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const double to = i + 1 < changes.size() ? changes[i + 1] : changes.front() + kTwoPi;
      edge(changes[i], to, first == (i % 2 == 1));
    }
  }

  [[nodiscard]] double change(const Curve& curve, double from, double to, bool before) const {
    const auto as_before = [&](double place) { return hidden(curve, at(curve, place)) == before; };
    const auto [last, first] = sides_of_change(as_before, from, to, 14);
    return 0.5 * (last + first);
  }

  std::vector<Curve> curves_;
  std::vector<Cover> covers_;
  std::vector<ViewedEdge> edges_;
};

}  // namespace

namespace {

/// Dashes of 3 mm, gaps of 1 mm.
void dash(Sheet& sheet, const SheetArc& arc) {
  const double step = 4.0 / std::max(arc.radius_mm, 0.1);
  for (double from = arc.from_rad; from < arc.to_rad; from += step) {
    SheetArc piece = arc;
    piece.pen = Pen::kThin;
    piece.from_rad = from;
    piece.to_rad = std::min(from + 0.75 * step, arc.to_rad);
    sheet.arcs.push_back(piece);
  }
}

}  // namespace

void draw_view(Sheet& sheet, const std::vector<ViewedEdge>& edges, const ViewPlace& place) {
  for (const ViewedEdge& edge : edges) {
    if (edge.hidden && !(edge.hole_off_axis && edge.pen == Pen::kThick)) continue;
    if (!edge.corners.empty()) {
      SheetPath path{.closed = true, .pen = edge.pen};
      for (const Point2& p : edge.corners) path.points.push_back(place(p));
      sheet.paths.push_back(std::move(path));
      continue;
    }
    // the paper is the bodies' frame mirrored: counter-clockwise becomes clockwise
    const bool whole = edge.to_rad - edge.from_rad > kTwoPi - 1e-9;
    const double from = whole ? 0.0 : wrapped_rad(0.5 * kPi - edge.to_rad), sweep = edge.to_rad - edge.from_rad;
    const SheetArc arc{.centre = place(edge.centre), .radius_mm = place.scale * edge.radius_mm, .from_rad = from, .to_rad = from + sweep, .pen = edge.pen};
    if (edge.hidden)
      dash(sheet, arc);
    else
      sheet.arcs.push_back(arc);
  }
}

std::vector<ViewedEdge> view_from_below(const std::vector<ViewedBody>& bodies) { return View(bodies).edges(); }

}  // namespace trueflank::io
