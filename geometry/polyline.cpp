// SPDX-License-Identifier: GPL-3.0-or-later
//
// Greedy marching gives the least number of chords of a smooth piece with vertices on the curve; the
// tolerance is then lowered until the same number of chords just suffices, which evens them out.
#include "trueflank/geometry/polyline.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// Farthest parameter whose chord from `from` keeps the tolerance; `guess` is a signed step.
double reach(const Curve& curve, double from, double tolerance_mm, double& guess) {
  const double room = curve.end - from;
  double step = std::abs(guess) < std::abs(room) ? guess : room;
  double low = 0.0, high = 0.0;  // error(low) <= tolerance < error(high); high = 0: none known
  for (int i = 0; i < 60; ++i) {
    const double error = chord_error_mm(curve, from, from + step);
    if (error <= tolerance_mm) {
      low = step;
      if (step == room) return curve.end;
      if (error > 0.999 * tolerance_mm) break;
    } else {
      high = step;
    }
    double next = error > 0.0 ? step * std::sqrt(0.9995 * tolerance_mm / error) : 2.0 * step;
    if (high != 0.0 && !(std::abs(next) < std::abs(high))) next = 0.5 * (low + high);
    if (!(std::abs(next) > std::abs(low))) next = high != 0.0 ? 0.5 * (low + high) : 1.5 * low;
    if (std::abs(next) > std::abs(room)) next = room;
    if (high != 0.0 && std::abs(high - low) < 1e-6 * std::abs(high)) break;
    step = next;
  }
  // a tolerance below rounding: the smallest step that still moves
  if (low == 0.0) low = 1e-9 * (curve.end - curve.begin);
  if (std::abs(low) >= std::abs(room)) return curve.end;
  guess = low;
  return from + low;
}

struct March {
  std::vector<double> parameters;  ///< begin ... end
  double fractional_count = 0.0;   ///< chords, the last one counted by its share
};

March march(const Curve& curve, double tolerance_mm) {
  March result;
  result.parameters.push_back(curve.begin);
  double at = curve.begin, guess = 0.1 * (curve.end - curve.begin);
  while (at != curve.end) {
    const double next = reach(curve, at, tolerance_mm, guess);
    if (next == curve.end) {
      const double error = chord_error_mm(curve, at, next);
      result.fractional_count += std::min(1.0, std::sqrt(error / tolerance_mm));
    } else {
      result.fractional_count += 1.0;
    }
    result.parameters.push_back(next);
    at = next;
  }
  return result;
}

std::vector<double> spread_parameters(const Curve& curve, double tolerance_mm) {
  March best = march(curve, tolerance_mm);
  const auto count = best.parameters.size();
  double tried = tolerance_mm;
  for (int i = 0; i < 4 && count > 2; ++i) {  // one chord has nothing to share
    const double ratio = best.fractional_count / static_cast<double>(count - 1);
    if (ratio > 0.995) break;
    tried *= ratio * ratio * 1.002;
    March next = march(curve, tried);
    if (next.parameters.size() > count) {  // overshot: halfway back
      tried = tried / (ratio * ratio) * std::sqrt(ratio * ratio);
      next = march(curve, tried);
      if (next.parameters.size() > count) break;
    }
    best = std::move(next);
  }
  return best.parameters;
}

/// Chords of an arc of a given total angle.
int arc_chords(double radius_mm, double angle_rad, double tolerance_mm) {
  if (tolerance_mm >= radius_mm) return 1;
  const double widest = 2.0 * std::acos(1.0 - tolerance_mm / radius_mm);
  return std::max(1, static_cast<int>(std::ceil(angle_rad / widest - 1e-9)));
}

struct ArcSpan {
  std::vector<double> parameters;
  bool vertex_at_middle = true;
  double error_mm = 0.0;
};

/// An arc that continues, mirrored, beyond one end (`middle`): the chords are counted over the whole.
ArcSpan split_symmetric_arc(const Curve& curve, double radius_mm, double tolerance_mm,
                            bool middle_at_begin) {
  const double half = curve.end - curve.begin;
  const int chords = arc_chords(radius_mm, 2.0 * half, tolerance_mm);
  const double chord = 2.0 * half / chords;
  ArcSpan span;
  span.vertex_at_middle = chords % 2 == 0;
  span.error_mm = radius_mm * (1.0 - std::cos(0.5 * chord));
  const int kept = chords / 2;  // whole chords of this half
  for (int i = 0; i <= kept; ++i) {
    const double from_outer = i * chord;
    if (middle_at_begin)
      span.parameters.insert(span.parameters.begin(), curve.end - from_outer);
    else
      span.parameters.push_back(curve.begin + from_outer);
  }
  if (span.vertex_at_middle) (middle_at_begin ? span.parameters.front() : span.parameters.back()) =
      middle_at_begin ? curve.begin : curve.end;
  return span;
}

/// A piece shorter than this share of the tolerance gets no edge: its ends become one vertex. Else the
/// rest of a nearly pointed tooth would leave edges that 32-bit coordinates cannot tell apart.
constexpr double kSkippedShare = 0.25;

/// Whole length of a piece: tip and root go on, mirrored, beyond the middle.
double whole_length_mm(const ProfilePiece& piece) {
  const double length = (piece.curve.end_point() - piece.curve.start_point()).norm();
  const bool mirrored = piece.kind == PieceKind::kTip || piece.kind == PieceKind::kRoot;
  return mirrored ? 2.0 * length : length;
}

}  // namespace

HalfToothPolyline tessellate(const ToothProfile& profile, double asked_tolerance_mm) {
  TRUEFLANK_EXPECTS(asked_tolerance_mm > 0.0);
  HalfToothPolyline line;
  const auto& pieces = profile.pieces();
  double skipped_mm = 0.0;  // moves a vertex that far along the outline: costs as much tolerance
  for (const ProfilePiece& piece : pieces)
    if (const double length = whole_length_mm(piece); length < kSkippedShare * asked_tolerance_mm)
      skipped_mm = std::max(skipped_mm, length);
  const double tolerance_mm = asked_tolerance_mm - skipped_mm;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Curve& curve = pieces[k].curve;
    if (whole_length_mm(pieces[k]) <= skipped_mm) {
      if (line.points.empty()) line.points.push_back(curve.start_point());
      if (k + 1 == pieces.size()) line.points.back() = curve.end_point();
      continue;
    }
    std::vector<double> parameters;
    const auto* arc = std::get_if<CircularArc>(&curve.shape);
    if (arc && (pieces[k].kind == PieceKind::kTip || pieces[k].kind == PieceKind::kRoot)) {
      const bool tip = pieces[k].kind == PieceKind::kTip;
      ArcSpan span = split_symmetric_arc(curve, arc->radius_mm, tolerance_mm, tip);
      (tip ? line.vertex_at_tooth_middle : line.vertex_at_gap_middle) = span.vertex_at_middle;
      line.chord_error_mm = std::max(line.chord_error_mm, span.error_mm);
      parameters = std::move(span.parameters);
    } else {
      parameters = spread_parameters(curve, tolerance_mm);
      for (std::size_t i = 1; i < parameters.size(); ++i)
        line.chord_error_mm = std::max(
            line.chord_error_mm, chord_error_mm(curve, parameters[i - 1], parameters[i]));
    }
    if (line.points.empty()) line.points.push_back(point_at(curve, parameters.front()));
    for (std::size_t i = 1; i < parameters.size(); ++i) {
      line.points.push_back(point_at(curve, parameters[i]));
      line.edges.push_back({static_cast<int>(k), parameters[i - 1], parameters[i]});
    }
  }
  line.chord_error_mm += skipped_mm;
  // exact symmetry lines
  const double gap = kPi / profile.gear().teeth;
  if (line.vertex_at_tooth_middle) line.points.front() = {line.points.front().norm(), 0.0};
  if (line.vertex_at_gap_middle) line.points.back() = line.points.back().norm() * unit_vector(gap);
  return line;
}

HalfToothPolyline with_middles(HalfToothPolyline half, const ToothProfile& profile) {
  if (!half.vertex_at_tooth_middle) {
    const Point2 middle(half.points.front().norm(), 0.0);
    half.points.insert(half.points.begin(), middle);
    half.edges.insert(half.edges.begin(), {0, profile.pieces().front().curve.begin,
                                           half.edges.empty() ? 0.0 : half.edges.front().from});
  }
  if (!half.vertex_at_gap_middle) {
    const Curve& root = profile.pieces().back().curve;
    half.points.push_back(half.points.back().norm() * unit_vector(kPi / profile.gear().teeth));
    half.edges.push_back({static_cast<int>(profile.pieces().size()) - 1,
                          half.edges.empty() ? root.begin : half.edges.back().to, root.end});
  }
  half.vertex_at_tooth_middle = half.vertex_at_gap_middle = true;
  return half;
}

namespace {

/// One tooth from the clockwise gap's middle on; the next tooth supplies its end.
std::vector<Point2> tooth_points(const ToothProfile& profile, double tolerance_mm,
                                 double& chord_error_mm) {
  HalfToothPolyline half = tessellate(profile, tolerance_mm);
  chord_error_mm = half.chord_error_mm;
  std::vector<Point2> tooth;
  if (profile.symmetric()) {
    for (auto p = half.points.rbegin(); p != half.points.rend(); ++p) tooth.push_back(mirrored(*p));
  } else {
    const ToothProfile image = profile.mirror_image();
    const HalfToothPolyline other = with_middles(tessellate(image, tolerance_mm), image);
    chord_error_mm = std::max(chord_error_mm, other.chord_error_mm);
    for (auto p = other.points.rbegin(); p != other.points.rend(); ++p)
      tooth.push_back(mirrored(*p));
    half = with_middles(std::move(half), profile);
  }
  // a vertex in the gap's middle belongs to the tooth that starts there
  for (std::size_t i = half.vertex_at_tooth_middle ? 1 : 0; i < half.points.size(); ++i)
    tooth.push_back(half.points[i]);
  if (half.vertex_at_gap_middle) tooth.pop_back();
  return tooth;
}

}  // namespace

SectionPolygon section_polygon(const ToothProfile& profile, double tolerance_mm,
                               double rotation_rad) {
  SectionPolygon section;
  section.teeth = profile.gear().teeth;
  const std::vector<Point2> tooth = tooth_points(profile, tolerance_mm, section.chord_error_mm);
  section.points_per_tooth = static_cast<int>(tooth.size());
  section.points.reserve(tooth.size() * static_cast<std::size_t>(section.teeth));
  for (int k = 0; k < section.teeth; ++k) {
    const Point2 axis = unit_vector(rotation_rad + kTwoPi * k / section.teeth);
    for (const Point2& p : tooth) section.points.push_back(p.x() * axis + p.y() * perpendicular(axis));
  }
  return section;
}

int circle_segments(double radius_mm, double tolerance_mm) {
  return std::max(8, arc_chords(radius_mm, kTwoPi, tolerance_mm));
}

}  // namespace trueflank
