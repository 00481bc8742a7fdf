// SPDX-License-Identifier: GPL-3.0-or-later
// How the parts around the gears go together.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Whether body a, moved along the axis by any of many steps, runs into b: circles of the slabs.
bool meets_on_its_way(const PartShapes& shapes, std::size_t a, std::size_t b, double way) {
  const auto discs_clear = [](const OutlineExtent& one, const Point2& at,
                              const OutlineExtent& other, const Point2& there,
                              const std::vector<std::pair<Point2, double>>& holes) {
    if ((at - there).norm() > one.outer_radius_mm + other.outer_radius_mm - 1e-4) return true;
    return std::any_of(holes.begin(), holes.end(), [&](const auto& hole) {
      return (at - hole.first).norm() + one.outer_radius_mm < hole.second + 1e-4;
    });
  };
  const auto part = [&](std::size_t body) -> const PartShape& {
    return shapes.parts[static_cast<std::size_t>(shapes.assembly[body].part)];
  };
  const auto place = [&](std::size_t body, const Point2& p) {
    const Placement& where = shapes.assembly[body];
    return Point2(rotated(p, where.rotation_rad) +
                  Point2(where.translation_mm[0], where.translation_mm[1]));
  };
  const auto holes_of = [&](std::size_t body, const Slab& slab) {
    std::vector<std::pair<Point2, double>> holes;
    for (const Outline& hole : slab.holes) {
      const auto* bore = std::get_if<BoreOutline>(&hole);  // a shaft's flat finds the bore's
      holes.emplace_back(place(body, extent(hole).centre),
                         bore ? 0.5 * bore->bore.diameter_mm : extent(hole).inner_radius_mm);
    }
    return holes;
  };
  const auto toothed = [](const Slab& slab) {
    return std::holds_alternative<ToothedOutline>(slab.outer) ||
           (!slab.holes.empty() && std::holds_alternative<ToothedOutline>(slab.holes.front()));
  };
  for (double step = 0.0; step < 200.0; step += 0.5)
    for (const Slab& s : part(a).slabs)
      for (const Slab& t : part(b).slabs) {
        const double z = shapes.assembly[a].translation_mm[2] + way * step,
                     w = shapes.assembly[b].translation_mm[2];
        if (z + s.z_upper_mm < w + t.z_lower_mm + 1e-3 ||
            w + t.z_upper_mm < z + s.z_lower_mm + 1e-3)
          continue;
        if (toothed(s) && toothed(t)) continue;  // gears in mesh slide along each other
        const OutlineExtent one = extent(s.outer), other = extent(t.outer);
        const Point2 at = place(a, one.centre), there = place(b, other.centre);
        if (!discs_clear(one, at, other, there, holes_of(b, t)) &&
            !discs_clear(other, there, one, at, holes_of(a, s)))
          return true;
      }
  return false;
}

/// Every body once, every step free, by moving the bodies in small steps.
void expect_proved(const Made& made, const char* name) {
  const AssemblyOrder order = assembly_order(made.train, made.shapes);
  ASSERT_TRUE(order.exists()) << name;
  ASSERT_FALSE(order.units.empty());
  for (const AssemblyUnit& unit : order.units) {
    std::vector<std::size_t> there;
    for (const AssemblyStep& step : unit.steps) {
      for (const std::size_t body : step.bodies)
        for (const std::size_t other : there)
          EXPECT_FALSE(meets_on_its_way(made.shapes, body, other, step.from))
              << name << ", " << unit.name << ": " << made.shapes.assembly[body].name << " meets "
              << made.shapes.assembly[other].name;
      there.insert(there.end(), step.bodies.begin(), step.bodies.end());
      if (step.unit >= 0) {
        std::size_t count = 0;
        for (const AssemblyStep& s : order.units[static_cast<std::size_t>(step.unit)].steps)
          count += s.bodies.size();
        EXPECT_EQ(count, step.bodies.size());
      }
    }
    if (&unit == &order.units.back()) {
      std::sort(there.begin(), there.end());
      EXPECT_EQ(std::unique(there.begin(), there.end()), there.end()) << name;
      EXPECT_EQ(there.size(), made.shapes.assembly.size()) << name;
    }
  }
}

TEST(AssemblyOrder, EveryKindGoesTogetherBodyByBody) {
  expect_proved(Made(k3k + kMachine), "type I");
  expect_proved(Made(type_two(k3k) + kMachine), "type II");
  expect_proved(Made(split_ring(k3k) + kMachine), "split ring");
  expect_proved(Made(kSimple + kMachine), "simple");
  expect_proved(Made(kStepped + kMachine), "stepped");
  expect_proved(Made(held_carrier(kSimple) + kMachine), "simple, held carrier");
  expect_proved(Made(held_carrier(kStepped) + kMachine), "stepped, held carrier");
  expect_proved(Made(kPair + kBox), "pair");
  expect_proved(Made(kRingPair + kRingBox), "pair with a ring");
  expect_proved(Made(round_shaft(k3k + kMachine)), "type I, round shaft");
  expect_proved(Made(round_shaft(kPair + kBox)), "pair, round shaft");
}

TEST(AssemblyOrder, UnitsAreMadeByThemselves) {
  const Made made(k3k + kMachine);
  const AssemblyOrder order = assembly_order(made.train, made.shapes);
  ASSERT_TRUE(order.exists());
  std::vector<std::string> names;
  for (const AssemblyUnit& unit : order.units) names.push_back(unit.name);
  for (const char* name : {"housing", "lid", "planet", "carrier", "gearbox"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_EQ(names.back(), "gearbox");
  EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(AssemblyOrder, HerringboneTeethHoldEachOtherUnlessRingsAreInHalves) {
  const std::string herringbone =
      replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20\nherringbone = true");
  const Made whole(replaced(herringbone, "[ring]", "[ring]\nhalves = false") + kMachine);
  const Finding& finding = whole.finding("assembly_order", "train");
  EXPECT_EQ(finding.status, CheckStatus::kFail);
  EXPECT_GE(finding.value, 4.0);  // the ring and three planets
  EXPECT_NE(finding.cure.find("halves"), std::string::npos);
  const Made halves(herringbone + kMachine);
  EXPECT_EQ(halves.finding("assembly_order", "train").status, CheckStatus::kPass)
      << halves.finding("assembly_order", "train").message;
  // sun and planets first, from the side; then one half of the ring from either side
  const AssemblyOrder order = assembly_order(halves.train, halves.shapes);
  const auto core =
      std::find_if(order.units.begin(), order.units.end(),
                   [](const AssemblyUnit& unit) { return unit.name == "sun_and_planets"; });
  ASSERT_NE(core, order.units.end());
  ASSERT_EQ(core->steps.size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(core->steps[i].from, 0.0);
  std::map<std::string, int> times;
  int now = 0;
  for (const AssemblyStep& step : order.units.back().steps) {
    ++now;
    for (const std::size_t body : step.bodies) times[halves.shapes.assembly[body].name] = now;
  }
  EXPECT_LT(times["ring_lower"], times["sun"]);
  EXPECT_LT(times["sun"], times["ring_upper"]);
  // what runs into each other as it stands is told as what it is
  const Made pierced(replaced(k3k + kMachine, "nema17\"", "nema17\"\nshaft_length_mm = 60"));
  EXPECT_EQ(pierced.finding("collision", "train").status, CheckStatus::kFail);
  EXPECT_NE(pierced.finding("assembly_order", "train").cure.find("collision"), std::string::npos);
  const Made helical(replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20") +
                     kMachine);
  EXPECT_EQ(helical.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(AssemblyOrder, APlateThatNoRingPassesIsTold) {
  const Made made(k3k + kMachine + "[carrier]\nplate_thickness_mm = 8\nouter_diameter_mm = 74\n");
  const Finding& finding = made.finding("assembly_order", "train");
  EXPECT_EQ(finding.status, CheckStatus::kFail);
  EXPECT_NE(finding.cure.find("outer_diameter_mm"), std::string::npos);
}

}  // namespace
}  // namespace trueflank
