// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/check/check_designs.h"
#include "trueflank/check/axial.h"
#include "trueflank/check/backlash.h"
#include "trueflank/check/centre_distance.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/contact_ratio.h"
#include "trueflank/check/planet_spacing.h"
#include "trueflank/check/profile.h"
#include "trueflank/check/tip_clearance.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/check/undercut.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank::test {
namespace {

TEST(Undercut, SeventeenTeethAreFreeOfItAndSixteenAreNot) {
  // the textbook limit z = 2 / sin^2 20 = 17.1 is that of a sharp rack of dedendum 1
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.rack = {.dedendum = 1.0, .root_radius = 0.0};
  d.gears = {{.name = "gear", .teeth = 18, .shift = 0.0}};
  EXPECT_EQ(check_undercut(laid_out(d))[0].status, CheckStatus::kPass);
  EXPECT_NEAR(check_undercut(laid_out(d))[0].limit, 1.0 - 9.0 * std::pow(std::sin(kPi / 9.0), 2),
              1e-12);
  d.gears[0].teeth = 17;
  EXPECT_EQ(check_undercut(laid_out(d))[0].status, CheckStatus::kWarn);
}

TEST(Undercut, TheCureIsWhereTheProfileStopsToBeUndercut) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 8, .shift = 0.0}};
  const double limit = check_undercut(laid_out(d))[0].limit;
  d.gears[0].shift = limit - 1e-3;
  EXPECT_TRUE(laid_out(d).gears[0].profile.notes().undercut);
  d.gears[0].shift = limit + 1e-6;
  EXPECT_FALSE(laid_out(d).gears[0].profile.notes().undercut);
}

TEST(TipThickness, TheCureLeavesTheWantedThickness) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 10, .shift = 0.75}};
  const Finding f = check_tip_thickness(laid_out(d))[0];
  ASSERT_EQ(f.status, CheckStatus::kWarn);
  const std::string number = "tip diameter of ";
  d.gears[0].tip_diameter_mm = std::stod(f.cure.substr(f.cure.find(number) + number.size()));
  EXPECT_NEAR(check_tip_thickness(laid_out(d))[0].margin, 0.0, 1e-4);
}

TEST(Profile, APointedToothIsToldNotRepaired) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 8, .shift = 1.0}};
  const Finding f = check_profile(laid_out(d))[0];
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NE(f.message.find("pointed"), std::string::npos);
  EXPECT_EQ(check_tip_thickness(laid_out(d))[0].value, 0.0);
}

TEST(TipClearance, FailsBelowZeroAndItsCureHolds) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  EXPECT_NEAR(check_tip_clearance(laid_out(d))[0].value, 0.25, 1e-12);
  gear(d, "pinion").tip_diameter_mm = 22.0 + 2.0 * 0.2;
  EXPECT_EQ(check_tip_clearance(laid_out(d))[0].status, CheckStatus::kWarn);
  gear(d, "pinion").tip_diameter_mm = 22.0 + 2.0 * 0.3;
  const Finding f = check_tip_clearance(laid_out(d))[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(f.value, -0.05, 1e-12);
  EXPECT_NE(f.cure.find("22.3 mm"), std::string::npos) << f.cure;
}

TEST(ContactRatio, OfAStandardPairIsTheTextbooks) {
  // eps = (sqrt(ra1^2-rb1^2) + sqrt(ra2^2-rb2^2) - a sin aw) / (pi m cos a)
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  const double c = std::cos(kPi / 9.0), s = std::sin(kPi / 9.0);
  const double expected = (std::sqrt(121.0 - 100.0 * c * c) + std::sqrt(441.0 - 400.0 * c * c) -
                           30.0 * s) / (kPi * c);
  EXPECT_NEAR(check_contact_ratio(laid_out(d))[0].value, expected, 1e-12);
}

TEST(ContactRatio, FailsWhereTheTipsEndTooEarly) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").tip_diameter_mm = 20.6;
  gear(d, "wheel").tip_diameter_mm = 40.6;
  const Finding f = check_contact_ratio(laid_out(d))[0];
  ASSERT_EQ(f.status, CheckStatus::kFail);
  const std::string number = "tip diameter of pinion of ";
  gear(d, "pinion").tip_diameter_mm =
      std::stod(f.cure.substr(f.cure.find(number) + number.size()));
  EXPECT_NEAR(check_contact_ratio(laid_out(d))[0].value, 1.0, 1e-3);
}

TEST(CentreDistance, NegativeAndLargeImpliedBacklashFailAndTheCureHolds) {
  GearboxDesign d = pair_design(20, 60, true);
  gear(d, "pinion").shift = 0.0;
  gear(d, "wheel").shift = 0.0;
  d.centre_distance_mm = 20.02;  // an internal pair tightens as the axes part
  const Finding tight = check_centre_distance(laid_out(d))[0];
  EXPECT_EQ(tight.status, CheckStatus::kFail);
  EXPECT_LT(tight.value, 0.0);
  gear(d, "wheel").shift = std::stod(tight.cure.substr(std::string("shift of wheel ").size()));
  EXPECT_EQ(check_centre_distance(laid_out(d))[0].status, CheckStatus::kPass);
  gear(d, "wheel").shift = 0.6;
  EXPECT_EQ(check_centre_distance(laid_out(d))[0].status, CheckStatus::kFail);
  EXPECT_GT(check_centre_distance(laid_out(d))[0].value, 0.25);
}

TEST(CentreDistance, ShiftsWrittenWithFourDecimalsAreNoOverlap) {
  GearboxDesign d = paper_design();
  const GearTrain solved = laid_out(d);
  for (std::size_t i = 0; i < d.gears.size(); ++i)
    d.gears[i].shift = std::round(solved.gears[i].shift * 1e4) / 1e4;
  for (const Finding& f : check_centre_distance(laid_out(d)))
    EXPECT_EQ(f.status, CheckStatus::kPass) << f.message;
}

TEST(Backlash, IsWhatTheDesignAsksFor) {
  for (const Finding& f : check_backlash(laid_out(paper_design(0.05)))) {
    EXPECT_NEAR(f.value, 0.05, 1e-9) << f.where;
    EXPECT_EQ(f.status, CheckStatus::kPass);
  }
}

TEST(PlanetSpacing, CountsThePlanetsThatFit) {
  GearboxDesign d = simple_design(12, 30, 72, 4);
  const GearTrain four = laid_out(d);
  EXPECT_EQ(check_planet_spacing(four)[0].status, CheckStatus::kFail);  // 4 x 30 teeth are too many
  d.planets = 3;
  const Finding f = check_planet_spacing(laid_out(d))[0];
  EXPECT_EQ(f.status, CheckStatus::kPass);
  EXPECT_NEAR(f.value, 2.0 * 21.0 * std::sin(kPi / 3.0) - 32.0, 1e-9);
}

TEST(Axial, TouchingLayersFail) {
  GearboxDesign d = paper_design();
  EXPECT_NEAR(check_axial(laid_out(d))[0].value, 1.0, 1e-12);
  gear(d, "ring1").face_width_mm = 11.5;
  const Finding f = check_axial(laid_out(d))[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(f.value, -0.5, 1e-12);
}

TEST(CheckGearbox, EveryIdAppearsForEveryKind) {
  const std::set<std::string> wanted{"profile",       "undercut",      "tip_thickness",
                                     "centre_distance", "backlash",    "tip_clearance",
                                     "contact_ratio", "assembly",      "planet_spacing", "axial",
                                     "overlap", "corner_contact", "fillet_interference", "involute_interference",
                                     "trochoid_interference", "trimming_interference"};
  GearboxDesign single{.name = "gear", .topology = train_topology("gear")};
  single.gears = {{.name = "gear", .kind = GearKind::kInternal, .teeth = 60, .shift = 0.0}};
  for (const GearboxDesign& d :
       {paper_design(), simple_design(12, 30, 72, 3), pair_design(20, 40, false), single}) {
    std::set<std::string> seen;
    for (const Finding& f : check_gearbox(laid_out(d))) {
      seen.insert(f.id);
      EXPECT_FALSE(f.message.empty()) << f.id;
      EXPECT_EQ(f.cure.empty(), f.status == CheckStatus::kPass ||
                                    f.status == CheckStatus::kNotApplicable) << f.id << f.message;
    }
    for (const std::string& id : wanted) EXPECT_TRUE(seen.contains(id)) << id;
  }
}

}  // namespace
}  // namespace trueflank::test
