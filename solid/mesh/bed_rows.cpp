// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/bed_rows.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// Chords of arcs have this share of the tolerance: where an arc's ends walk along it with the height
/// (at keyways and flats), a facet's diagonal spans a little more than a chord.
constexpr double kShareOfChords = 0.8;
/// An arc's ends walk at most this share of a chord from row to row.
constexpr double kWalk = 0.1;
constexpr int kLeastChords = 8;

struct Arc {
  double radius_mm = 0.0, from_rad = 0.0, angle_rad = 0.0;
};
Arc arc_of(const BoreEdge& edge) {
  const double from = polar_angle_rad(edge.from);
  const bool full = edge.from == edge.to;
  return {edge.from.norm(), from, full ? kTwoPi : wrapped_rad(polar_angle_rad(edge.to) - from)};
}

std::vector<BoreEdge> edges_at(const Outline& outline, double z_mm) {
  const Outline here = outline_at_height(outline, z_mm);
  if (const auto* bore = std::get_if<BoreOutline>(&here)) return bore_edges(bore->bore);
  const auto& circle = std::get<CircleOutline>(here);
  return {{{circle.radius_mm, 0.0}, {circle.radius_mm, 0.0}, true}};
}

std::vector<Point2> row_at(const Outline& outline, double z_mm, const std::vector<int>& chords) {
  const auto* circle = std::get_if<CircleOutline>(&outline);
  const Point2 centre = circle != nullptr ? circle->centre : Point2(Point2::Zero());
  std::vector<Point2> row;
  const std::vector<BoreEdge> edges = edges_at(outline, z_mm);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    row.push_back(centre + edges[e].from);
    if (!edges[e].arc) continue;
    const Arc arc = arc_of(edges[e]);
    for (int i = 1; i < chords[e]; ++i)
      row.push_back(centre + arc.radius_mm * unit_vector(arc.from_rad + arc.angle_rad * i / chords[e]));
  }
  return row;
}

}  // namespace

BedRows bed_rows(const Outline& outline, double tolerance_mm) {
  const double height = bed_height_mm(outline);
  TRUEFLANK_EXPECTS(height > 0.0 && tolerance_mm > 0.0);
  const std::vector<BoreEdge> at_bed = edges_at(outline, 0.0), above = edges_at(outline, height);
  std::vector<int> chords;
  BedRows result;
  int layers = 1;
  for (std::size_t e = 0; e < above.size(); ++e) {
    chords.push_back(1);
    if (!above[e].arc) continue;
    const Arc low = arc_of(at_bed[e]), high = arc_of(above[e]);
    const double radius = std::max(low.radius_mm, high.radius_mm);
    const double angle = std::max(low.angle_rad, high.angle_rad);
    const double bounded = std::min(kShareOfChords * tolerance_mm, 0.5 * radius);
    const double widest = 2.0 * std::acos(1.0 - bounded / radius);
    const double least = std::max(2.0, std::ceil(kLeastChords * angle / kTwoPi));
    chords.back() = static_cast<int>(std::max(least, std::ceil(angle / widest - 1e-9)));
    const double chord = angle / chords.back();
    const double walk = std::max(std::abs(low.from_rad - high.from_rad),
                                 std::abs(low.angle_rad - high.angle_rad));
    layers = std::max(layers, static_cast<int>(std::ceil(walk / (kWalk * chord) - 1e-9)));
    result.chord_error_mm =
        std::max(result.chord_error_mm, radius * (1.0 - std::cos(0.5 * (1.0 + kWalk) * chord)));
  }
  for (int k = 0; k <= layers; ++k) {
    result.heights_mm.push_back(height * k / layers);
    result.rows.push_back(row_at(outline, result.heights_mm.back(), chords));
  }
  return result;
}

}  // namespace trueflank
