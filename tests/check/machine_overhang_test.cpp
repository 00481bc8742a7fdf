// SPDX-License-Identifier: GPL-3.0-or-later
// What hangs free while it is printed.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/machine_designs.h"
#include "trueflank/solid/measure/overhang.h"

namespace trueflank {
namespace {

CircleOutline disc(double radius_mm, double x = 0.0) {
  return {.centre = {x, 0.0}, .radius_mm = radius_mm};
}

TEST(Overhang, OfADiscOnANarrowerOneIsTheRestOfItsRadius) {
  const PartShape part{.name = "mushroom", .slabs = {{0, 4, disc(3)}, {4, 6, disc(5)}}};
  const Overhang stands = overhang(part, false), lies = overhang(part, true);
  EXPECT_NEAR(stands.ledge_mm, 2.0, 1e-12);
  EXPECT_NEAR(stands.ledge_height_mm, 4.0, 1e-12);
  EXPECT_EQ(lies.ledge_mm, 0.0);
  EXPECT_EQ(lies.bridge_mm, 0.0);
}

TEST(Overhang, OverAHoleIsTheLongestLineAcrossIt) {
  // closed: the diameter; narrower: the chord that touches the narrower hole; wider or the same:
  // none
  const auto over = [](std::vector<Outline> above) {
    return overhang({.name = "plate",
                     .slabs = {{0, 2, disc(20), {disc(5, 8)}}, {2, 4, disc(20), std::move(above)}}},
                    false);
  };
  EXPECT_NEAR(over({}).bridge_mm, 10.0, 1e-12);
  EXPECT_NEAR(over({}).bridge_height_mm, 2.0, 1e-12);
  EXPECT_NEAR(over({disc(3, 8)}).bridge_mm, 8.0, 1e-12);
  EXPECT_EQ(over({disc(5, 8)}).bridge_mm, 0.0);
  EXPECT_EQ(over({disc(6, 8)}).bridge_mm, 0.0);
  EXPECT_NEAR(over({disc(2, -8)}).bridge_mm, 10.0, 1e-12);
  EXPECT_EQ(over({disc(3, 8)}).ledge_mm, 0.0);
}

TEST(Overhang, IsJudgedByTheWorstOfALimit) {
  Process process;
  EXPECT_EQ(overhang_share({.ledge_mm = 9.0, .bridge_mm = 90.0, .lean_rad = 1.5}, process), 0.0);
  process.ledge_mm = 1.0;
  process.bridge_mm = 10.0;
  process.overhang_rad = 1.0;
  EXPECT_NEAR(overhang_share({.ledge_mm = 0.5, .bridge_mm = 20.0, .lean_rad = 0.1}, process), 2.0,
              1e-12);
  EXPECT_NEAR(overhang_share({.ledge_mm = 3.0, .bridge_mm = 20.0, .lean_rad = 0.1}, process), 3.0,
              1e-12);
}

TEST(Overhang, OfTwistedTeethIsTheLeanOfTheirTips) {
  const Made made(replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 30") +
                  kMachine);
  const TrainGear& sun = made.train.gear(0);
  const double lean = std::atan(sun.profile.tip_radius_mm() * std::abs(sun.twist.turn_rad_per_mm));
  EXPECT_GT(lean, rad_from_deg(30.0));
  EXPECT_NEAR(overhang(made.part("sun"), false).lean_rad, lean, 1e-12);
  EXPECT_EQ(made.finding("overhang", "sun").status, CheckStatus::kPass);
  const Made steep(replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 43") +
                   kMachine);
  EXPECT_EQ(steep.finding("overhang", "sun").status, CheckStatus::kWarn);
  EXPECT_NE(steep.finding("overhang", "sun").cure.find("helix_angle_deg"), std::string::npos);
}

TEST(Overhang, NoPartLiesOnItsWorseSide) {
  const Process process = *ProcessTable().find("fdm-0.4");
  for (const std::string& text :
       {k3k + kMachine, kSimple + kMachine, kStepped + kMachine, kPair + kBox, kRingPair + kRingBox,
        replaced(k3k, "output = \"ring2\"", "output = \"ring1\"") + kMachine}) {
    const Made made(text);
    for (const PartShape& part : made.shapes.parts) {
      if (!part.bought.empty()) continue;
      const double share = overhang_share(overhang(part, part.upside_down, process), process);
      if (share > 1.0) {
        EXPECT_LE(share, overhang_share(overhang(part, !part.upside_down, process), process))
            << part.name;
      }
      EXPECT_EQ(made.finding("overhang", part.name).status,
                share > 1.0 ? CheckStatus::kWarn : CheckStatus::kPass)
          << part.name;
      // teeth over a neck alone hang
      if (!part.name.starts_with("planet")) {
        EXPECT_LE(share, 1.0) << part.name;
      }
    }
  }
}

TEST(Overhang, TeethInsideTheOthersRootsGoOnInThePlaceOfANeckThatIsPrinted) {
  const Made printed(k3k + kMachine), milled(replaced(k3k + kMachine, "fdm-0.4", "hobbing"));
  const auto neck_of = [](const Made& made) -> const Slab& {
    for (const Slab& slab : made.part("planet").slabs)
      if (std::abs(slab.z_lower_mm - 10.0) < 1e-9) return slab;
    throw std::runtime_error("no neck");
  };
  const auto* teeth = std::get_if<ToothedOutline>(&neck_of(printed).outer);
  ASSERT_TRUE(teeth);
  EXPECT_EQ(teeth->profile, &printed.train.gears[3].profile);  // planet2's
  EXPECT_TRUE(std::holds_alternative<CircleOutline>(neck_of(milled).outer));
  EXPECT_EQ(printed.finding("overhang", "planet").status, CheckStatus::kPass);
  EXPECT_EQ(printed.finding("collision", "train").status, CheckStatus::kPass);
}

TEST(Overhang, OfTeethThatLieInNobodysRootsIsALayer) {
  // planets of 39 and 37 teeth: either's tips reach beyond the other's roots
  const std::string near = replaced(replaced(replaced(k3k, "teeth = 32", "teeth = 37"),
                                             "teeth = 81\nshift = 1.9967", "teeth = 88"),
                                    "shift = 0.5225", "") +
                           kMachine;
  const Made made(near);
  EXPECT_EQ(made.finding("overhang", "planet").status, CheckStatus::kPass)
      << made.finding("overhang", "planet").message;
  EXPECT_GT(overhang(made.part("planet"), false).ledge_mm, 1.0);
  // a neck of 0.2 mm in the middle of the gap of 1 mm
  const Slab* neck = nullptr;
  for (const Slab& slab : made.part("planet").slabs)
    if (std::holds_alternative<CircleOutline>(slab.outer)) neck = &slab;
  ASSERT_TRUE(neck);
  EXPECT_NEAR(neck->z_lower_mm, 10.4, 1e-9);
  EXPECT_NEAR(neck->z_upper_mm, 10.6, 1e-9);
  // twisted teeth do not go on: they hang
  const Made twisted(replaced(near, "module_mm = 0.8", "module_mm = 0.8\nhelix_angle_deg = 1"));
  const Finding& told = twisted.finding("overhang", "planet");
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_NE(told.cure.find("inside the other's roots"), std::string::npos) << told.cure;
}

TEST(Overhang, TeethGoOnOverTheFootOfASetScrew) {
  const Made made(round_shaft(k3k + kMachine));
  ASSERT_TRUE(machine_layout(made.train)->set_screw.is_there());
  // from the foot to the end of the teeth one outline
  const auto& slabs = made.part("sun").slabs;
  double lowest = 1e300;
  for (const Slab& slab : slabs)
    if (std::holds_alternative<ToothedOutline>(slab.outer))
      lowest = std::min(lowest, slab.z_lower_mm);
  const auto m = machine_layout(made.train);
  EXPECT_NEAR(lowest, m->set_screw.foot.upper_mm - m->hub.lower_mm, 1e-9);
  EXPECT_EQ(made.finding("overhang", "sun").status, CheckStatus::kPass);
  EXPECT_EQ(made.finding("collision", "train").status, CheckStatus::kPass);
}

TEST(Overhang, IsNotJudgedWhereTheProcessNeedsNoSupport) {
  const Made sintered(replaced(k3k + kMachine, "fdm-0.4", "sls"));
  EXPECT_THROW((void)sintered.finding("overhang", "planet"), std::runtime_error);
}

}  // namespace
}  // namespace trueflank
