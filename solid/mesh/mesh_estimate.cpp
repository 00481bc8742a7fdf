// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/mesh_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/bend_survey.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Heights at which a wall is looked at for how it bends.
constexpr int kHeights = 48;
/// Layers of a saddle: its facets are bent both ways.
constexpr double kLayersOfBentFace = 3.2;
/// Columns that are added where the flank is bent along the profile, too.
constexpr double kColumnsOfBentFlank = 1.3;

/// Cuts that the mesher makes of those a displacement asks for: on all lines together, and not always where
/// halves would do.
constexpr double kCutsMade = 1.3;
/// What these have of the tolerance, beside the section's own chords.
constexpr double kShareOfBends = 2.0 / 3.0;

/// Nets of modified teeth have so much of the facets of rows and columns.
constexpr double kShareOfNets = 0.6;

/// Largest turn of a chord about the axis that keeps the tolerance.
double widest_turn_rad(double radius_mm, double tolerance_mm) {
  return 2.0 * std::acos(1.0 - std::min(1.0, tolerance_mm / radius_mm));
}

/// Layers that a curve over the face needs: chords of a curvature k are sqrt(8 tolerance / k) long.
template <class Curve>
double layers_of_curve(const Curve& curve, double height_mm, double tolerance_mm) {
  double layers = 0.0;
  std::array<std::array<double, 3>, 3> last{};
  for (int i = 0; i <= kHeights; ++i) {
    last = {last[1], last[2], curve(height_mm * i / kHeights)};
    double bend_mm = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      bend_mm += std::pow(last[0][k] - 2.0 * last[1][k] + last[2][k], 2);
    if (i >= 2) layers += std::sqrt(std::sqrt(bend_mm) / (8.0 * tolerance_mm));
  }
  return layers;
}

/// Layers for what modifications bend the face into.
double layers_of_bent_face(const Toothing& toothing, double height_mm, double tolerance_mm) {
  const ToothProfile& profile = *toothing.profile;
  double layers = 0.0;
  const double low = profile.root_form_roll_length_mm(), high = profile.tip_form_roll_length_mm();
  for (const double share : {0.0, 0.5, 1.0}) {
    const double roll = std::lerp(low, high, share);
    if (toothing.has_deviation())
      layers = std::max(
          layers,
          layers_of_curve(
              [&](double z) -> std::array<double, 3> {
                return {toothing.deviation->deviation_mm(0, Flank::kLeft, roll, z), 0.0, 0.0};
              },
              height_mm, tolerance_mm));
  }
  return layers;
}

double facets_of_teeth(const ToothedOutline& outline, double height_mm, double tolerance_mm) {
  const ToothProfile& profile = *outline.profile;
  const Toothing toothing = outline.toothing();
  double flank = 0.0, others = 0.0, from = 0.0, to = 0.0;  // edges of a half tooth
  for (const HalfToothPolyline::Edge& e : tessellate(profile, tolerance_mm).edges) {
    const bool is_flank =
        profile.pieces()[static_cast<std::size_t>(e.piece)].kind == PieceKind::kInvolute;
    (is_flank ? flank : others) += 1.0;
    if (!is_flank) continue;
    if (flank == 1.0) from = e.from;
    to = e.to;
  }
  const double radius = std::max(profile.tip_radius_mm(), profile.root_radius_mm());
  const double turn = std::abs(outline.twist.turn_rad_per_mm) * height_mm;
  const double rows = std::max(1.0, std::ceil(turn / widest_turn_rad(radius, tolerance_mm)));
  const BendCuts cuts = bend_cuts(outline, height_mm, kShareOfBends * tolerance_mm);
  const double more_layers = kCutsMade * (cuts.layers - 1.0),
               more_chords = kCutsMade * (cuts.chords - 1.0);
  const double half_teeth = 2.0 * profile.gear().teeth,
               caps = 2.0 * half_teeth * (flank + others + more_chords);
  const bool bent = toothing.has_deviation() || toothing.displacement != nullptr;
  if (bent || outline.edge_chamfer_mm > 0.0 || outline.bed != nullptr) {
    const double layers =
        rows + kLayersOfBentFace * layers_of_bent_face(toothing, height_mm, tolerance_mm) +
        more_layers + (outline.edge_chamfer_mm > 0.0 ? 2.0 : 0.0) +
        (outline.bed != nullptr ? 1.0 : 0.0);
    const double columns =
        (flank * (bent ? kColumnsOfBentFlank : 1.0)) + others + more_chords;
    const bool net = toothing.displacement == nullptr && outline.bed == nullptr &&
                     !(toothing.has_deviation() && toothing.deviation->varies_by_tooth);
    return half_teeth * 2.0 * columns * layers * (net ? kShareOfNets : 1.0) + caps;
  }
  const double patches = outline.twist.herringbone ? 2.0 : 1.0;
  const double columns =
      turn > 0.0 ? std::max(2.0, std::ceil(std::abs(to - from) * rows / turn)) : flank;
  if (turn == 0.0 || rows <= 2.0 || patches * columns + rows >= flank * rows)
    return half_teeth * 2.0 * (flank + others) * rows + caps;
  return half_teeth * 2.0 * (others * rows + patches * columns + rows) + caps;
}

double facets_of_circle(const Outline& outline, double tolerance_mm) {
  const double turn = widest_turn_rad(extent(outline).outer_radius_mm, tolerance_mm);
  const double layers = bed_height_mm(outline) > 0.0 ? 3.0 : 2.0;  // with its edges in the faces
  return 2.0 * layers * std::max(8.0, kTwoPi / turn);
}

}  // namespace

double estimated_facets(const PartShape& shape, double tolerance_mm) {
  const double tolerance = meshing_tolerance_mm(shape, tolerance_mm);
  double facets = 0.0;
  for (const Slab& slab : shape.slabs) {
    const auto add = [&](const Outline& outline) {
      const auto* toothed = std::get_if<ToothedOutline>(&outline);
      facets += toothed != nullptr
                    ? facets_of_teeth(*toothed, slab.z_upper_mm - slab.z_lower_mm, tolerance)
                    : facets_of_circle(outline, tolerance);
    };
    add(slab.outer);
    for (const Outline& hole : slab.holes) add(hole);
  }
  return facets;
}

}  // namespace trueflank
