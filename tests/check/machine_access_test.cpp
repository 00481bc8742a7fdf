// SPDX-License-Identifier: GPL-3.0-or-later
// A key gets to every screw when it is put in; and set screws are bodies as all others.
#include <gtest/gtest.h>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_access.h"
#include "trueflank/solid/measure/assembly_clearance.h"

namespace trueflank {
namespace {

const Finding& of(const Findings& findings, const std::string& where) {
  for (const Finding& finding : findings)
    if (finding.where == where) return finding;
  throw std::runtime_error("no finding of " + where);
}

TEST(ToolAccess, IsThereToEveryScrewOfEveryKind) {
  for (const std::string& text :
       {k3k + kMachine, replaced(k3k, "output = \"ring2\"", "output = \"ring1\"") + kMachine,
        kSimple + kMachine, kStepped + kMachine, kPair + kBox, kRingPair + kRingBox,
        round_shaft(k3k + kMachine)}) {
    const Made made(text);
    const bool planets = made.train.topology().has_planets();
    for (const char* group :
         {"motor", "housing", "output", "retainer", planets ? "carrier" : "output"}) {
      const Finding& finding = made.finding("tool_access", group);
      EXPECT_EQ(finding.status, CheckStatus::kPass) << group << ": " << finding.message;
    }
  }
  EXPECT_EQ(Made(round_shaft(k3k + kMachine)).finding("tool_access", "set screw").status,
            CheckStatus::kPass);
}

TEST(ToolAccess, ThatIsCoveredOrHasNothingToTurnIntoFails) {
  Made made(k3k + kMachine);
  const auto layout = machine_layout(made.train);
  AssemblyOrder order = assembly_order(made.train, made.shapes);
  // a lid that is closed over its screws' heads
  for (PartShape& part : made.shapes.parts)
    if (part.name == "lid") part.slabs.back().holes.clear();
  const Findings covered = check_access(made.train, *layout, made.shapes, order);
  EXPECT_EQ(of(covered, "housing").status, CheckStatus::kFail);
  EXPECT_NE(of(covered, "housing").message.find("lid"), std::string::npos)
      << of(covered, "housing").message;
  EXPECT_EQ(of(covered, "carrier").status, CheckStatus::kPass);
  // inserts that come after the screws
  for (AssemblyUnit& unit : order.units)
    std::stable_partition(unit.steps.begin(), unit.steps.end(), [&](const AssemblyStep& step) {
      return made.shapes
                     .parts[static_cast<std::size_t>(
                         made.shapes.assembly[step.bodies.front()].part)]
                     .name.find("_retainer") == std::string::npos ||
             made.shapes.assembly[step.bodies.front()].name.starts_with("screw_");
    });
  EXPECT_EQ(of(check_access(made.train, *layout, made.shapes, order), "retainer").status,
            CheckStatus::kFail);
}

TEST(SetScrewBody, RunsIntoAFloorWhoseHoleIsTooNarrow) {
  Made made(round_shaft(k3k + kMachine));
  EXPECT_TRUE(assembly_clearance(made.train, made.shapes).collisions.empty());
  const auto m = machine_layout(made.train);
  for (PartShape& part : made.shapes.parts)
    if (part.name == "housing")
      for (Slab& slab : part.slabs)
        for (Outline& hole : slab.holes)
          if (auto* circle = std::get_if<CircleOutline>(&hole);
              circle && std::abs(circle->radius_mm - m->floor_hole_radius_mm) < 1e-9)
            circle->radius_mm = 2.5 + m->set_screw.length_mm - 0.3;
  bool told = false;
  for (const Collision& c : assembly_clearance(made.train, made.shapes).collisions)
    told = told || c.body1.starts_with("set screw") || c.body2.starts_with("set screw");
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace trueflank
