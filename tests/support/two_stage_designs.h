// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "trueflank/base/units.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/gearbox_design.h"

// Designs of two stages in series that can be made, for tests.
namespace trueflank::test {

/// A simple stage without shifts: teeth that assemble with their planets at equal spacing.
struct StageTeeth {
  int sun = 18, planet = 27, planets = 3;
  double module_mm = 1.0, face_width_mm = 10.0;
  [[nodiscard]] int ring() const { return sun + 2 * planet; }
};

inline void add_stage_gears(const StageTeeth& stage, const std::string& number, GearboxDesign& design) {
  const double bore = 0.35 * stage.module_mm * stage.planet;
  design.gears.push_back({.name = "sun" + number, .teeth = stage.sun, .face_width_mm = stage.face_width_mm});
  design.gears.push_back({.name = "planet" + number, .teeth = stage.planet, .face_width_mm = stage.face_width_mm,
                          .bore = {.diameter_mm = bore}});
  design.gears.push_back({.name = "ring" + number, .kind = GearKind::kInternal, .teeth = stage.ring(),
                          .face_width_mm = stage.face_width_mm});
}

inline GearboxDesign two_stage_design(const StageTeeth& first, const StageTeeth& second) {
  GearboxDesign design{.name = "two stages", .topology = train_topology("two-stage")};
  design.planets = first.planets;
  design.module_mm = first.module_mm;
  design.backlash_mm = 0.05;
  design.later_stages = {{.planets = second.planets, .module_mm = second.module_mm}};
  add_stage_gears(first, "1", design);
  add_stage_gears(second, "2", design);
  return design;
}

/// One of the stages as a design of kind simple.
inline GearboxDesign simple_design(const StageTeeth& stage) {
  GearboxDesign design{.name = "stage", .topology = train_topology("simple")};
  design.planets = stage.planets;
  design.module_mm = stage.module_mm;
  design.backlash_mm = 0.05;
  add_stage_gears(stage, "", design);
  return design;
}

/// Stages that assemble and whose planets keep clear of each other.
class RandomStages {
 public:
  explicit RandomStages(std::uint64_t seed) : engine_(seed) {}

  int whole(int low, int high) { return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1)); }

  StageTeeth next() {
    for (;;) {
      const StageTeeth stage{.sun = whole(14, 40), .planet = whole(18, 45), .planets = whole(2, 5),
                             .module_mm = 0.1 * whole(4, 16), .face_width_mm = whole(4, 16) * 1.0};
      if ((stage.sun + stage.ring()) % stage.planets != 0) continue;
      const double apart = (stage.sun + stage.planet) * std::sin(kPi / stage.planets);
      if (apart > stage.planet + 3.0) return stage;
    }
  }
  GearboxDesign design() {
    const StageTeeth first = next(), second = next();
    return two_stage_design(first, second);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trueflank::test
