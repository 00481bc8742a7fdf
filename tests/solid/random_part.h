// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/shape/part_shape.h"

// Random single gears and rings with everything that can be in them, for properties of meshes.
namespace trueflank::test {

struct RandomPart {
  std::unique_ptr<GearTrain> train;  ///< the part points into it
  PartShape part;
  double tolerance_mm = 0.0;
  std::string text;  ///< for the failing test's message
};

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  double between(double a, double b) {
    return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_between(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  bool chance(double share) { return between(0.0, 1.0) < share; }

 private:
  std::mt19937_64 engine_;
};

/// A bore that keeps a little more than a quarter of the module of wall.
[[nodiscard]] inline BoreDesign random_bore(RandomNumbers& random, double root_mm, double module_mm) {
  const double most = root_mm - 0.2501 * module_mm;
  const double reach = random.chance(0.3) ? most : random.between(0.05, 1.0) * most;
  if (!(reach > 0.0)) return {};
  switch (static_cast<int>(random.between(0.0, 5.0))) {
    case 1:
      return {.diameter_mm = 2.0 * reach};
    case 2: {
      const double r = reach * random.between(0.5, 0.95), half = 0.5 * r * random.between(0.1, 1.9);
      const double depth = std::sqrt(std::max(0.0, reach * reach - half * half)) - r;
      if (!(depth > 0.0) || half >= r) return {};
      return {.diameter_mm = 2.0 * r,
              .kind = BoreKind::kKeyway,
              .keyway_width_mm = 2.0 * half,
              .keyway_depth_mm = depth};
    }
    case 3:
      return {.diameter_mm = 2.0 * reach,
              .kind = BoreKind::kDFlat,
              .d_flat_mm = reach * random.between(1.02, 1.98)};
    case 4:
      return {.diameter_mm = 2.0 * reach * std::cos(kPi / 6.0), .kind = BoreKind::kHex};
    default:
      return {};
  }
}

/// A rim and, often, bolts in it, with walls down to a quarter of the module.
inline void add_random_rim(RandomNumbers& random, double root_mm, double module_mm, GearDesign& ring) {
  const double thickness =
      module_mm * (random.chance(0.3) ? 0.26 : std::max(0.26, random.between(0.3, 10.0)));
  ring.outer_diameter_mm = 2.0 * (root_mm + thickness);
  const double room = thickness - 0.52 * module_mm;
  if (room < 0.5 * module_mm || random.chance(0.5)) return;
  const double hole = random.between(0.05, 0.5) * room;
  const double circle =
      root_mm + 0.26 * module_mm + hole + random.between(0.0, 1.0) * (room - 2.0 * hole);
  const int count = 1 + static_cast<int>(random.between(0.0, 30.0));
  const double apart = 2.0 * circle * std::sin(kPi / count);
  if (count == 1 || apart >= 2.0 * hole + 0.251 * module_mm)
    ring.bolt_circle = {count, 2.0 * circle, 2.0 * hole};
}

/// Nothing where the random values make no gear.
[[nodiscard]] inline std::optional<RandomPart> random_part(std::uint64_t seed) {
  RandomNumbers random(seed);
  GearboxDesign design;
  design.topology = train_topology("gear");
  design.module_mm = random.log_between(0.2, 10.0);
  GearDesign gear;
  gear.name = "gear";
  const bool ring = random.chance(0.4);
  gear.kind = ring ? GearKind::kInternal : GearKind::kExternal;
  gear.teeth = static_cast<int>(random.log_between(ring ? 8.0 : 5.0, 500.0));
  gear.shift = random.between(-1.0, 1.5);
  gear.face_width_mm = random.between(1.0, 20.0);
  gear.thinning_mm = random.between(0.0, 0.1) * design.module_mm;
  design.rack = {.pressure_angle_rad = rad_from_deg(random.between(12.0, 30.0)),
                 .addendum = random.between(0.7, 1.2),
                 .dedendum = random.between(1.0, 1.5),
                 .root_radius = random.chance(0.2) ? 0.0 : random.between(0.0, 0.45)};
  if (ring && random.chance(0.3)) {
    gear.root = RingRoot::kShaper;
    gear.cutter = ShaperCutter{.teeth = std::max(3, static_cast<int>(gear.teeth * random.between(0.1, 0.6))),
                               .shift = random.between(-0.2, 0.3),
                               .tip_radius = random.between(0.0, 0.3)};
  }
  design.gears = {gear};
  const auto bare = lay_out(design);
  if (!bare) return std::nullopt;
  const double root = bare->gears[0].profile.root_radius_mm();
  if (ring) add_random_rim(random, root, design.module_mm, design.gears[0]);
  else design.gears[0].bore = random_bore(random, root, design.module_mm);
  auto train = lay_out(design);
  if (!train) return std::nullopt;
  RandomPart result{.train = std::make_unique<GearTrain>(std::move(*train))};
  auto shapes = part_shapes(*result.train);
  if (!shapes) return std::nullopt;
  result.part = std::move(shapes->parts[0]);
  result.tolerance_mm = random.log_between(5e-5, 5e-2);
  result.text = "seed " + std::to_string(seed) + ": " + (ring ? "ring " : "gear ") +
                std::to_string(gear.teeth) + " teeth, module " + std::to_string(design.module_mm) +
                " mm, tolerance " + std::to_string(result.tolerance_mm) + " mm";
  return result;
}

}  // namespace trueflank::test
