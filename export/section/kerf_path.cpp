// SPDX-License-Identifier: GPL-3.0-or-later
//
// Half an outline is enough: teeth and bores are mirror images in a line through the axis. Each smooth
// piece of it has an offset curve, each corner that opens an arc about it; the parts of these that
// are nearer to the outline than half the kerf are cut off, and what is left joins at crossings.
#include "trueflank/export/section/kerf_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/export/section/kerf_element.h"
#include "trueflank/geometry/biarc.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/geometry/section_profile.h"
#include "trueflank/solid/measure/outline_distance.h"

namespace trueflank::io {
namespace {

/// A point counts as on the offset curve down to this much less than half the kerf.
constexpr double kReach_mm = 1e-7;
constexpr int kSamples = 160;
/// What the fit may use of the tolerance; the rest is for what its samples miss.
constexpr double kFitShare = 0.9;
/// Corners that turn by less are smooth.
constexpr double kSmooth_rad = 1e-7;

class PathBuilder {
 public:
  PathBuilder(const Outline& outline, bool hole, double kerf_mm, double tolerance_mm)
      : distance_(unturned(outline)), hole_(hole), radius_mm_(0.5 * kerf_mm),
        tolerance_mm_(tolerance_mm), half_(half_outline(outline)) {
    if (const auto* toothed = std::get_if<ToothedOutline>(&outline)) {
      copies_ = toothed->profile->gear().teeth;
      rotation_rad_ = toothed->rotation_rad;
    }
    sector_rad_ = kPi / copies_;
  }

  std::optional<KerfPath> build() {
    add_elements();
    find_stretches();
    if (stretches_.empty()) return std::nullopt;
    if (!meets(stretches_.front(), true) || !meets(stretches_.back(), false)) return std::nullopt;
    for (std::size_t i = 0; i + 1 < stretches_.size(); ++i) join(stretches_[i], stretches_[i + 1]);
    KerfPath result;
    ArcChain path, edge;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      const Stretch& s = stretches_[i];
      append(path, s, radius_mm_);
      if (!s.element->corner) append(edge, s, 0.0);
      else edge.end = s.element->foot(0.0);
      if (i + 1 < stretches_.size()) fill_corner(edge, s, stretches_[i + 1], result);
    }
    fill_ends(edge, result);
    result.path = closed(path);
    result.as_cut = closed(edge);
    result.deviation_mm = std::max(path.deviation_mm, deviation_of(path));
    return result;
  }

 private:
  static Outline unturned(Outline outline) {
    if (auto* toothed = std::get_if<ToothedOutline>(&outline)) toothed->rotation_rad = 0.0;
    return outline;
  }
  [[nodiscard]] double side() const { return hole_ ? -1.0 : 1.0; }
  [[nodiscard]] double clearance_mm(const Point2& p) const {
    return side() * distance_.foot(p).distance_mm;
  }

  // -------------------------------------------------------------- elements

  void add_corner(const Point2& at, const Point2& before, const Point2& after) {
    const double turn = std::atan2(cross(before, after), before.dot(after));
    if (turn * side() < kSmooth_rad) return;  // smooth, or a corner that closes
    const double begin = polar_angle_rad(-perpendicular(before));
    elements_.push_back({{CircularArc{at, 0.0}, begin, begin + turn}, side() * radius_mm_, true});
  }

  void add_elements() {
    const Point2 first = tangent_at(half_.front(), half_.front().begin);
    // the mirror image before the first and after the last piece; half of a corner is ours
    add_corner(half_.front().start_point(), perpendicular(Point2::UnitX()), first);
    for (std::size_t i = 0; i < half_.size(); ++i) {
      elements_.push_back({half_[i], side() * radius_mm_, false});
      const Point2 end = tangent_at(half_[i], half_[i].end);
      const Point2 next = i + 1 < half_.size() ? tangent_at(half_[i + 1], half_[i + 1].begin)
                                               : perpendicular(unit_vector(sector_rad_));
      add_corner(half_[i].end_point(), end, next);
    }
  }

  // -------------------------------------------------------------- stretches

  [[nodiscard]] bool in_sector(const Point2& p) const {
    const Point2 end = unit_vector(sector_rad_);
    return p.y() >= -kReach_mm && cross(p, end) >= -kReach_mm;
  }
  [[nodiscard]] bool open(const Element& e, double u) const {
    const Point2 p = e.point(u);
    return in_sector(p) && clearance_mm(p) >= radius_mm_ - kReach_mm;
  }
  /// The last open place between an open and a closed one.
  [[nodiscard]] double edge_of(const Element& e, double inside, double outside) const {
    return sides_of_change([&](double u) { return open(e, u); }, inside, outside, 50).first;
  }

  void find_stretches() {
    for (const Element& e : elements_) {
      double last = 0.0;
      bool was_open = open(e, 0.0);
      double from = 0.0;
      for (int i = 1; i <= kSamples; ++i) {
        const double u = static_cast<double>(i) / kSamples;
        const bool is_open = open(e, u);
        if (is_open && !was_open) from = edge_of(e, u, last);
        if (!is_open && was_open) keep({&e, from, edge_of(e, last, u)});
        if (is_open && i == kSamples) keep({&e, from, 1.0});
        was_open = is_open;
        last = u;
      }
    }
  }
  void keep(const Stretch& s) {
    // touching in a point is no stretch
    if ((s.element->point(s.to) - s.element->point(s.from)).norm() > 10.0 * kReach_mm)
      stretches_.push_back(s);
  }

  /// Moves an end onto the mirror line; false where it does not reach it.
  bool meets(Stretch& s, bool start) {
    const Point2 line = start ? Point2(Point2::UnitX()) : unit_vector(sector_rad_);
    double& end = start ? s.from : s.to;
    const auto off = [&](double u) { return cross(line, s.element->point(u)); };
    if (std::abs(off(end)) < 1e-10) return true;
    const double reach = 1e-3;
    const double low = std::max(0.0, end - reach), high = std::min(1.0, end + reach);
    if (off(low) * off(high) <= 0.0) end = find_root(off, low, high);
    return std::abs(off(end)) < 1e-8;
  }

  /// Both ends to where the curves cross.
  static void join(Stretch& a, Stretch& b) {
    double u = a.to, v = b.from;
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 30; ++i) {
      const Point2 gap = a.element->point(u) - b.element->point(v);
      if (gap.norm() < 1e-13) break;
      const Point2 du = (a.element->point(u + kStep) - a.element->point(u - kStep)) / (2 * kStep);
      const Point2 dv = (b.element->point(v + kStep) - b.element->point(v - kStep)) / (2 * kStep);
      const double determinant = cross(du, dv);
      if (std::abs(determinant) < 1e-12 * du.norm() * dv.norm()) break;  // they touch
      u -= cross(gap, dv) / determinant;
      v -= cross(gap, du) / determinant;
    }
    const bool near = std::abs(u - a.to) < 1e-2 && std::abs(v - b.from) < 1e-2 && u > a.from &&
                      v < b.to && u <= 1.0 + 1e-9 && v >= -1e-9;
    if (!near || !((a.element->point(u) - b.element->point(v)).norm() < 1e-9)) return;
    a.to = std::min(u, 1.0);
    b.from = std::max(v, 0.0);
  }

  // -------------------------------------------------------------- chains

  void append(ArcChain& chain, const Stretch& s, double radius_mm) const {
    const Element& e = *s.element;
    const double offset = side() * radius_mm;
    const PlaneCurve curve{
        [&](double u) { return Point2(e.foot(u) + offset * e.normal(u)); },
        [&](double u) {
          // past the centre of curvature the offset runs backwards
          const double h = u < 0.5 ? 1e-6 : -1e-6;
          const Point2 travel = (e.foot(u + h) + offset * e.normal(u + h) - e.foot(u) -
                                 offset * e.normal(u)) * (h > 0.0 ? 1.0 : -1.0);
          const Point2 t = e.tangent(u);
          return travel.dot(t) < 0.0 ? Point2(-t) : t;
        }};
    ArcChain fitted;
    if (std::holds_alternative<CircularArc>(e.curve.shape)) {
      const double angle = (s.to - s.from) * (e.curve.end - e.curve.begin);
      const int count = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (0.5 * kPi))));
      for (int i = 0; i < count; ++i)
        fitted.edges.push_back({curve.point(s.from + (s.to - s.from) * i / count),
                                std::tan(0.25 * angle / count)});
      fitted.end = curve.point(s.to);
    } else if (!e.corner && std::holds_alternative<StraightLine>(e.curve.shape)) {
      fitted.edges.push_back({curve.point(s.from), 0.0});
      fitted.end = curve.point(s.to);
    } else {
      fitted = fit_arcs(curve, s.from, s.to, kFitShare * tolerance_mm_);
    }
    chain.edges.insert(chain.edges.end(), fitted.edges.begin(), fitted.edges.end());
    chain.end = fitted.end;
    chain.deviation_mm = std::max(chain.deviation_mm, fitted.deviation_mm);
  }

  /// The arc that the wire leaves about its middle, from one foot to another.
  void add_wire_arc(ArcChain& chain, const Point2& middle, const Point2& from, const Point2& to) const {
    const Point2 a = from - middle, b = to - middle;
    const double turn = std::atan2(cross(a, b), a.dot(b));
    chain.edges.push_back({from, std::tan(0.25 * turn)});
    chain.end = to;
  }

  /// What stays of the outline's points between two of its places.
  void note_corner(const Point2& middle, const Stretch& a, const Stretch& b, KerfPath& result) const {
    double left = 0.0;
    bool between = false;
    for (const Element& e : elements_) {
      if (&e == a.element) between = true;
      if (between && !e.corner)
        for (int i = 0; i <= kSamples; ++i) {
          const double u = static_cast<double>(i) / kSamples;
          if (&e == a.element && u < a.to) continue;
          if (&e == b.element && u > b.from) continue;
          left = std::max(left, (e.foot(u) - middle).norm() - radius_mm_);
        }
      if (&e == b.element) break;
    }
    add_copies(middle, left, result);
  }
  void add_copies(const Point2& middle, double left_mm, KerfPath& result) const {
    const bool on_line = std::abs(middle.y()) < 1e-8 ||
                         std::abs(cross(unit_vector(sector_rad_), middle)) < 1e-8;
    for (int k = 0; k < copies_; ++k) {
      const double turn = rotation_rad_ + 2.0 * sector_rad_ * k;
      result.corners.push_back({rotated(middle, turn), left_mm});
      if (!on_line) result.corners.push_back({rotated(mirrored(middle), turn), left_mm});
    }
  }

  void fill_corner(ArcChain& edge, const Stretch& a, const Stretch& b, KerfPath& result) const {
    const Point2 from = a.element->foot(a.to), to = b.element->foot(b.from);
    if ((from - to).norm() < 1e-8) return;  // one smooth outline, or a corner the wire goes round
    const Point2 middle = 0.5 * (a.element->point(a.to) + b.element->point(b.from));
    add_wire_arc(edge, middle, from, to);
    note_corner(middle, a, b, result);
  }

  /// Where the path crosses its own mirror image, the wire leaves an arc across the mirror line.
  void fill_ends(ArcChain& edge, KerfPath& result) const {
    const Stretch &first = stretches_.front(), &last = stretches_.back();
    const Point2 start = first.element->foot(first.from), end = last.element->foot(last.to);
    const Point2 line = unit_vector(sector_rad_);
    if (std::abs(start.y()) > 1e-8) {
      const Point2 middle = first.element->point(first.from);
      const Point2 on_axis = middle + std::copysign(radius_mm_, start.x() - middle.x()) * Point2::UnitX();
      ArcChain whole;
      add_wire_arc(whole, middle, on_axis, start);
      whole.edges.insert(whole.edges.end(), edge.edges.begin(), edge.edges.end());
      edge.edges = std::move(whole.edges);
      Stretch nothing{&elements_.front(), 0.0, 0.0};
      note_corner(middle, nothing, first, result);
    }
    if (std::abs(cross(line, end)) > 1e-8) {
      const Point2 middle = last.element->point(last.to);
      const Point2 on_line =
          middle + std::copysign(radius_mm_, (end - middle).dot(line)) * line;
      add_wire_arc(edge, middle, end, on_line);
      Stretch nothing{&elements_.back(), 1.0, 1.0};
      note_corner(middle, last, nothing, result);
    }
  }

  /// Distance of the chain's points from the true offset curve: how far they are from half the kerf.
  [[nodiscard]] double deviation_of(const ArcChain& chain) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < chain.edges.size(); ++i) {
      const Point2 end = i + 1 < chain.edges.size() ? chain.edges[i + 1].start : chain.end;
      for (int k = 0; k < 8; ++k)
        worst = std::max(worst, std::abs(clearance_mm(point_on(chain.edges[i], end, k / 8.0)) -
                                         radius_mm_));
    }
    return worst;
  }

  /// The half chain, its mirror image, and all copies.
  [[nodiscard]] Contour closed(const ArcChain& half) const {
    std::vector<ContourVertex> one;
    const std::size_t n = half.edges.size();
    const auto start = [&](std::size_t i) { return i < n ? half.edges[i].start : half.end; };
    for (std::size_t i = n; i > 0; --i) one.push_back({mirrored(start(i)), half.edges[i - 1].bulge});
    for (std::size_t i = 0; i < n; ++i) one.push_back({half.edges[i].start, half.edges[i].bulge});
    Contour contour;
    for (int k = 0; k < copies_; ++k)
      for (const ContourVertex& vertex : one)
        contour.vertices.push_back(
            {rotated(vertex.point, rotation_rad_ + 2.0 * sector_rad_ * k), vertex.bulge});
    contour.chord_error_mm = half.deviation_mm;
    return contour;
  }

  OutlineDistance distance_;
  bool hole_;
  double radius_mm_, tolerance_mm_;
  int copies_ = 1;
  double rotation_rad_ = 0.0, sector_rad_ = kPi;
  std::vector<Curve> half_;
  std::vector<Element> elements_;
  std::vector<Stretch> stretches_;
};

Error does_not_fit(double kerf_mm) {
  std::string value = trimmed_number(kerf_mm);
  return {.code = ErrorCode::kInfeasible,
          .message = "a wire or beam of this width does not fit into an opening of the part",
          .key = "made.kerf_mm",
          .value = std::move(value),
          .remedy = "a thinner wire, or a larger hole"};
}

constexpr const char* kUnlike = "the path of a wire is not built for teeth or flanks that differ";

Error not_built(double kerf_mm, std::string why) {
  return {.code = ErrorCode::kUnsupported,
          .message = std::move(why),
          .key = "made.kerf_mm",
          .value = trimmed_number(kerf_mm),
          .remedy =
              "no kerf, or straight teeth whose modifications are of the profile alone (tip and "
              "root relief, profile crowning and slope, tip rounding)"};
}

/// A straight wire leaves the same section at every height.
Status straight_wire_cuts(const ToothedOutline& teeth, double kerf_mm) {
  const Toothing toothing = teeth.toothing();
  std::string what;
  if (toothing.twist.turn_rad_per_mm != 0.0) what = "helical teeth";
  else if (toothing.edge_chamfer_mm != 0.0) what = "an edge chamfer";
  else if (toothing.has_deviation() && toothing.deviation->varies_along_face)
    what = "flanks that change along the face (crowning, helix slope, end relief)";
  if (!what.empty()) return fail(not_built(kerf_mm, "a straight wire or beam cannot cut " + what));
  const bool by_tooth = toothing.has_deviation() && toothing.deviation->varies_by_tooth;
  if (by_tooth || !toothing.prismatic()) return fail(not_built(kerf_mm, kUnlike));
  return {};
}

}  // namespace

Result<KerfPath> kerf_path(const Outline& outline, bool hole, double kerf_mm, double tolerance_mm) {
  const auto of_circle = [&](const CircleOutline& circle) -> Result<KerfPath> {
    const double radius = circle.radius_mm + (hole ? -0.5 : 0.5) * kerf_mm;
    if (!(radius > 0.0)) return fail(does_not_fit(kerf_mm));
    KerfPath result;
    result.path.circle = CircleOutline{circle.centre, radius};
    result.as_cut.circle = circle;
    return result;
  };
  const auto path_of = [&](const Outline& section) -> Result<KerfPath> {
    auto path = PathBuilder(section, hole, kerf_mm, tolerance_mm).build();
    if (!path) return fail(does_not_fit(kerf_mm));
    return std::move(*path);
  };
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) return of_circle(*circle);
  if (const auto* bore = std::get_if<BoreOutline>(&outline))
    if (bore->bore.kind == BoreKind::kRound)
      return of_circle({Point2::Zero(), 0.5 * bore->bore.diameter_mm});
  if (const auto* toothed = std::get_if<ToothedOutline>(&outline)) {
    if (auto cut = straight_wire_cuts(*toothed, kerf_mm); !cut) return fail(std::move(cut.error()));
    if (toothed->toothing().has_deviation()) {
      const ToothSection section = section_profile(toothed->toothing(), 0.5 * toothed->twist.face_width_mm);
      if (!section.profile.symmetric()) return fail(not_built(kerf_mm, kUnlike));
      return path_of(ToothedOutline{.profile = &section.profile, .rotation_rad = toothed->rotation_rad});
    }
  }
  return path_of(outline);
}

}  // namespace trueflank::io
