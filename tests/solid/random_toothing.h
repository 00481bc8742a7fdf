// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>

#include "tests/solid/random_part.h"
#include "trueflank/design/kinds/train_kind.h"

// Random gears and rings that are no prisms, and distances from their true surface by a search that
// uses nothing but surface_point().
namespace trueflank::test {

struct RandomToothing {
  std::unique_ptr<GearTrain> train;  ///< the part points into it
  std::unique_ptr<Displacement> displacement;
  PartShape part;
  double tolerance_mm = 0.0;
  std::string text;

  [[nodiscard]] ToothedOutline& outline() {
    Slab& slab = part.slabs[0];
    if (auto* outer = std::get_if<ToothedOutline>(&slab.outer)) return *outer;
    return std::get<ToothedOutline>(slab.holes[0]);
  }
};

/// Crowning over the face, relief of the tip from a break on, pressure angle; some by tooth.
inline FlankDeviation random_deviation(RandomNumbers& random, const ToothProfile& profile,
                                       double face_width_mm, double size_mm) {
  const double low = profile.root_form_roll_length_mm(), high = profile.tip_form_roll_length_mm();
  const double start = low + random.between(0.3, 0.9) * (high - low);
  const double relief = random.between(0.0, 1.0) * size_mm, slope = random.between(-1.0, 1.0) * size_mm;
  const double crown = random.chance(0.5) ? random.between(0.0, 1.0) * size_mm : 0.0;
  const double by_tooth = random.chance(0.3) ? random.between(0.0, 1.0) * size_mm : 0.0;
  const int teeth = profile.gear().teeth;
  FlankDeviation deviation;
  deviation.deviation_mm = [=](int tooth, Flank flank, double roll, double z) {
    const double past = (roll - start) / (high - start);
    const double from_middle = 2.0 * z / face_width_mm - 1.0;
    const double along = (roll - low) / (high - low);
    return -crown * from_middle * from_middle - (past > 0.0 ? relief * past * past : 0.0) +
           (flank == Flank::kLeft ? slope : -slope) * along * (crown > 0.0 ? from_middle : 1.0) +
           by_tooth * std::cos(kTwoPi * tooth / teeth);
  };
  deviation.varies_by_tooth = by_tooth != 0.0;
  deviation.varies_along_face = crown != 0.0;
  deviation.roll_breaks_mm = {start};
  return deviation;
}

/// What a random toothing is to have.
struct ToothingKinds {
  bool deviation = false, displacement = false, chamfer = false;
};

[[nodiscard]] inline std::optional<RandomToothing> random_toothing(std::uint64_t seed,
                                                                   ToothingKinds kinds = {}) {
  RandomNumbers random(seed);
  GearboxDesign design;
  design.topology = train_topology("gear");
  design.module_mm = random.log_between(0.3, 5.0);
  const double helix = random.chance(kinds.deviation ? 0.3 : 0.0) ? 0.0 : random.between(-40.0, 40.0);
  design.helix_angle_rad = rad_from_deg(helix);
  design.herringbone = helix != 0.0 && random.chance(0.4);
  GearDesign gear;
  gear.name = "gear";
  const bool ring = random.chance(0.4);
  gear.kind = ring ? GearKind::kInternal : GearKind::kExternal;
  gear.teeth = static_cast<int>(random.log_between(ring ? 20.0 : 7.0, 90.0));
  gear.shift = random.between(-0.3, 0.8);
  gear.face_width_mm = random.between(3.0, 12.0) * design.module_mm;
  design.rack = {.pressure_angle_rad = rad_from_deg(random.between(15.0, 26.0)),
                 .addendum = random.between(0.8, 1.1),
                 .dedendum = random.between(1.1, 1.35),
                 .root_radius = random.between(0.05, 0.4)};
  RandomNumbers tool(seed + 0x9e3779b9);  // of its own: the other numbers stay those of the seed
  if (!ring && tool.chance(0.35)) {
    design.rack.protuberance = tool.between(0.01, 0.1);
    design.rack.protuberance_angle_rad = rad_from_deg(tool.between(4.0, 12.0));
  }
  design.gears = {gear};
  const auto bare = lay_out(design);
  if (!bare || bare->gears[0].profile.notes().pointed) return std::nullopt;
  const double root = bare->gears[0].profile.root_radius_mm();
  if (ring) add_random_rim(random, root, design.module_mm, design.gears[0]);
  else design.gears[0].bore = random_bore(random, root, design.module_mm);
  auto train = lay_out(design);
  if (!train) return std::nullopt;
  RandomToothing result{.train = std::make_unique<GearTrain>(std::move(*train)),
                        .displacement = nullptr, .part = {}, .tolerance_mm = 0.0, .text = {}};
  TrainGear& made = result.train->gears[0];
  if (kinds.deviation)
    made.deviation = random_deviation(random, made.profile, gear.face_width_mm,
                                      random.between(0.001, 0.01) * design.module_mm);
  if (kinds.chamfer) made.edge_chamfer_mm = random.between(0.05, 0.3) * design.module_mm;
  auto shapes = part_shapes(*result.train);
  if (!shapes) return std::nullopt;
  result.part = std::move(shapes->parts[0]);
  result.tolerance_mm = random.log_between(3e-4, 2e-2) * design.module_mm;
  if (kinds.displacement) {
    const double size = 0.005 * design.module_mm, b = gear.face_width_mm;
    result.displacement = std::make_unique<Displacement>([=](const std::array<double, 3>& p) {
      const double a = std::atan2(p[1], p[0]);
      return std::array<double, 3>{size * std::cos(2.0 * a) + 2.0 * size * p[2] / b,
                                   size * std::sin(a) - size * std::exp(-6.0 * p[2] / b), 0.0};
    });
    result.outline().displacement = result.displacement.get();
  }
  result.text = "seed " + std::to_string(seed) + ": " + (ring ? "ring " : "gear ") +
                std::to_string(gear.teeth) + " teeth, module " + std::to_string(design.module_mm) +
                " mm, helix " + std::to_string(helix) + (design.herringbone ? " herringbone" : "") +
                ", protuberance " + std::to_string(design.rack.protuberance) +
                ", tolerance " + std::to_string(result.tolerance_mm) + " mm";
  return result;
}

/// Distance of a point (gear's frame) from the toothing: Gauss and Newton's steps on every piece of the
/// teeth near it, from the best of many places at its height.
[[nodiscard]] inline double searched_distance_mm(const Toothing& toothing,
                                                 const Eigen::Vector3d& point) {
  const auto& pieces = toothing.profile->pieces();
  const int teeth = toothing.profile->gear().teeth;
  // between these heights the surface is smooth
  const double b = toothing.twist.face_width_mm, chamfer = toothing.edge_chamfer_mm;
  double floor = 0.0, ceiling = b;
  for (const double edge : {chamfer, 0.5 * b, b - chamfer}) {
    if (edge <= point.z() && edge > floor) floor = edge;
    if (edge > point.z() && edge < ceiling) ceiling = edge;
  }
  const double z = std::clamp(point.z(), floor, ceiling);
  const double angle = std::atan2(point.y(), point.x()) - section_turn_rad(toothing.twist, z);
  const int nearest = static_cast<int>(std::round(angle / (kTwoPi / teeth)));
  const int tooth = ((nearest % teeth) + teeth) % teeth;
  double best = 1e300;
  for (int side : {-1, 1})
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Curve& c = pieces[k].curve;
      const double low = std::min(c.begin, c.end), high = std::max(c.begin, c.end);
      const auto at = [&](double u, double v) {
        const auto p = surface_point(toothing, {tooth, side, k, u}, v);
        return Eigen::Vector3d(p.data());
      };
      double u = low, v = z, least = 1e300;
      for (int i = 0; i <= 12; ++i) {
        const double t = low + (high - low) * i / 12;
        const double d = (at(t, z) - point).norm();
        if (d < least) least = d, u = t;
      }
      const double du = 1e-5 * (high - low), dv = 1e-5 * b;
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d here = at(u, v), away = point - here;
        least = std::min(least, away.norm());
        const double u1 = u + du > high ? u - du : u + du, v1 = v + dv > ceiling ? v - dv : v + dv;
        Eigen::Matrix<double, 3, 2> slopes;
        slopes.col(0) = (at(u1, v) - here) / (u1 - u);
        slopes.col(1) = (at(u, v1) - here) / (v1 - v);
        const Eigen::Vector2d step = (slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * away);
        u = std::clamp(u + step.x(), low, high);
        v = std::clamp(v + step.y(), floor, ceiling);
      }
      best = std::min(best, least);
    }
  return best;
}

}  // namespace trueflank::test
