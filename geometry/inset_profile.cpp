// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/inset_profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

/// Depths at which corners are solved for; between them their places are interpolated. A corner that
/// begins at a tangent joint (a flank past its centres of curvature) starts with a root's steepness.
constexpr int kNodes = 257;
/// A piece may lose all but this share of itself.
constexpr double kLeastLeft = 0.1;
/// Sine of the angle below which a joint is smooth.
constexpr double kSmooth = 1e-5;

/// A moved curve as the zeros of a function of the plane, and the parameter of a point on it.
struct MovedCurve {
  const Curve& curve;
  double depth_mm = 0.0;       ///< into the material
  double material_inside = 1.0;  ///< +1: towards the axis for arcs, towards the base tangent point
  bool known = false;

  MovedCurve(const Curve& c, double depth, double inside)
      : curve(c), depth_mm(depth), material_inside(inside) {
    const auto* arc = std::get_if<CircularArc>(&c.shape);
    known = std::holds_alternative<Involute>(c.shape) ||
            (arc != nullptr && arc->centre.norm() < 1e-12);
  }
  [[nodiscard]] double side_of(const Point2& p) const {
    if (const auto* arc = std::get_if<CircularArc>(&curve.shape))
      return p.norm() - (arc->radius_mm - material_inside * depth_mm);
    const auto& involute = std::get<Involute>(curve.shape);
    const double r_b = involute.base_radius_mm;
    const double inv = involute_function(pressure_angle_at_radius_rad(std::max(p.norm(), r_b), r_b));
    return polar_angle_rad(p) -
           (involute.base_half_angle_rad - depth_mm / r_b + involute.sense * inv);
  }
  [[nodiscard]] double parameter_of(const Point2& p) const {
    if (std::holds_alternative<CircularArc>(curve.shape)) return polar_angle_rad(p);
    const double r_b = std::get<Involute>(curve.shape).base_radius_mm;
    return (roll_length_mm(std::max(p.norm(), r_b), r_b) + material_inside * depth_mm) / r_b;
  }
};

/// Along the run; an involute's at its base circle, where points give no direction, too.
Point2 run_tangent(const Curve& curve, double parameter) {
  const auto* involute = std::get_if<Involute>(&curve.shape);
  if (involute == nullptr) return tangent_at(curve, parameter);
  const Point2 outwards = unit_vector(involute->base_half_angle_rad + involute->sense * parameter);
  return curve.end > curve.begin ? outwards : Point2(-outwards);
}

/// The first zero on the way from one parameter to another; close steps at the start, where slight
/// corners are.
template <class Function>
std::optional<double> first_zero(const Function& f, double from, double to) {
  for (const int steps : {40, 400}) {
    double last = from;
    const double at_start = f(from);
    for (int i = 1; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps;
      const double t = from + (to - from) * u * u;
      if (f(t) * at_start < 0.0) return find_root(f, last, t);
      last = t;
    }
  }
  return std::nullopt;
}

}  // namespace

InsetProfile::InsetProfile(const ToothProfile& profile, double depth_mm)
    : profile_(&profile),
      into_material_(profile.gear().kind == GearKind::kExternal ? 1.0 : -1.0) {
  TRUEFLANK_EXPECTS(depth_mm > 0.0);
  std::vector<Range> left;
  double possible = 0.0, impossible = depth_mm;
  if (cut_pieces(depth_mm, left)) possible = depth_mm;
  else
    for (int i = 0; i < 20; ++i) {
      const double middle = 0.5 * (possible + impossible);
      (cut_pieces(middle, left) ? possible : impossible) = middle;
    }
  deepest_ = possible;
  for (int i = 0; i < kNodes; ++i) {
    // a corner that is slight to rounding is not found: as at the depth before
    const bool found = cut_pieces(deepest_ * i / (kNodes - 1), left);
    nodes_.push_back(found || nodes_.empty() ? left : nodes_.back());
  }
}

Point2 InsetProfile::moved(std::size_t piece, double parameter, double depth_mm) const {
  const Curve& curve = profile_->pieces()[piece].curve;
  return point_at(curve, parameter) +
         into_material_ * depth_mm * perpendicular(run_tangent(curve, parameter));
}

/// Where nothing is cut off, the pieces as they are. False where not enough is left.
bool InsetProfile::cut_pieces(double depth_mm, std::vector<Range>& left) const {
  const auto& pieces = profile_->pieces();
  left.clear();
  for (const ProfilePiece& piece : pieces) left.emplace_back(piece.curve.begin, piece.curve.end);
  if (depth_mm == 0.0) return true;
  if (!cut_tooth_middle(depth_mm, left)) return false;
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
    if (!cut_joint(k, depth_mm, left)) return false;
  // a gap that ends in a corner would have to become round
  const Curve& last = pieces.back().curve;
  if (std::abs(tangent_at(last, last.end).dot(last.end_point().normalized())) > kSmooth) return false;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Curve& curve = pieces[k].curve;
    if (pieces[k].kind == PieceKind::kTipRounding &&
        std::get<CircularArc>(curve.shape).radius_mm - depth_mm <
            kLeastLeft * std::get<CircularArc>(curve.shape).radius_mm)
      return false;
    if ((left[k].second - left[k].first) / (curve.end - curve.begin) < kLeastLeft) return false;
  }
  return true;
}

bool InsetProfile::cut_tooth_middle(double depth_mm, std::vector<Range>& left) const {
  const Curve& first = profile_->pieces().front().curve;
  const Point2 tangent = tangent_at(first, first.begin);
  if (std::abs(tangent.dot(first.start_point().normalized())) <= kSmooth) return true;
  const auto cut = first_zero([&](double t) { return moved(0, t, depth_mm).y(); }, first.begin, first.end);
  if (cut) left.front().first = *cut;
  return cut.has_value();
}

bool InsetProfile::cut_joint(std::size_t first, double depth_mm, std::vector<Range>& left) const {
  const auto& pieces = profile_->pieces();
  const Curve &a = pieces[first].curve, &b = pieces[first + 1].curve;
  const double bend = into_material_ * cross(run_tangent(a, a.end), run_tangent(b, b.begin));
  if (bend < -kSmooth) return false;  // points into the material: would have to become round
  const auto* involute = std::get_if<Involute>(&a.shape);
  const bool past_centres = involute != nullptr && into_material_ > 0.0 &&
                            involute->base_radius_mm * a.end < depth_mm;
  if (bend < kSmooth && !past_centres) return true;
  const MovedCurve on_a(a, depth_mm, into_material_), on_b(b, depth_mm, into_material_);
  if (!on_a.known && !on_b.known) return false;
  if (on_a.known) {
    const auto cut = first_zero(
        [&](double t) { return on_a.side_of(moved(first + 1, t, depth_mm)); }, b.begin, b.end);
    if (!cut) return false;
    left[first + 1].first = *cut;
    left[first].second = on_a.parameter_of(moved(first + 1, *cut, depth_mm));
    return true;
  }
  const auto cut =
      first_zero([&](double t) { return on_b.side_of(moved(first, t, depth_mm)); }, a.end, a.begin);
  if (!cut) return false;
  left[first].second = *cut;
  left[first + 1].first = on_b.parameter_of(moved(first, *cut, depth_mm));
  return true;
}

InsetProfile::Range InsetProfile::left_of(std::size_t piece, double depth_mm) const {
  const double at = deepest_ > 0.0 ? depth_mm / deepest_ * (kNodes - 1) : 0.0;
  const auto node = static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, kNodes - 2.0));
  const Range &here = nodes_[node][piece], &next = nodes_[node + 1][piece];
  const double share = std::clamp(at - static_cast<double>(node), 0.0, 1.0);
  return {std::lerp(here.first, next.first, share), std::lerp(here.second, next.second, share)};
}

double InsetProfile::foot(std::size_t piece, double parameter, double depth_mm) const {
  const Curve& curve = profile_->pieces()[piece].curve;
  const Range left = left_of(piece, depth_mm);
  return std::lerp(left.first, left.second, (parameter - curve.begin) / (curve.end - curve.begin));
}

Point2 InsetProfile::point(std::size_t piece, double parameter, double depth_mm) const {
  return moved(piece, foot(piece, parameter, depth_mm), depth_mm);
}

}  // namespace trueflank
