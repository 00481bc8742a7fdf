// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures that findings tell and cures ask for, against formulas of textbooks. Changes of
// single operators in these checks (scripts/mutate) went unnoticed where only the status was looked
// at.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/check/axial.h"
#include "trueflank/check/backlash.h"
#include "trueflank/check/centre_distance.h"
#include "trueflank/check/contact_ratio.h"
#include "trueflank/check/design_tolerances.h"
#include "trueflank/check/finding.h"
#include "trueflank/check/planet_spacing.h"
#include "trueflank/check/tip_clearance.h"
#include "trueflank/check/tip_thickness.h"

namespace trueflank::test {
namespace {

/// The number that follows some words; NaN where they are missing.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

double involute(double angle) { return std::tan(angle) - angle; }
const double kCos20 = std::cos(kPi / 9.0);

TEST(PlanetSpacingFigures, AreTheChordBetweenTheAxes) {
  GearboxDesign d = simple_design(12, 30, 72, 4);
  const Finding f = check_planet_spacing(laid_out(d))[0];
  const double chord = 2.0 * 21.0 * std::sin(kPi / 4.0);
  EXPECT_NEAR(f.value, chord - 32.0, 1e-9);
  EXPECT_EQ(f.margin, f.value);
  EXPECT_NEAR(number_after(f.message, "of diameter "), 32.0, 1e-4);
  EXPECT_NEAR(number_after(f.message, "overlap by "), 32.0 - chord, 1e-4);
  EXPECT_EQ(number_after(f.message, "up to "), 3.0);
  EXPECT_EQ(number_after(f.cure, "at most "), 3.0);
  EXPECT_NEAR(number_after(f.cure, "below "), chord, 1e-3);
  d.planets = 3;
  EXPECT_NEAR(number_after(check_planet_spacing(laid_out(d))[0].message, "clear each other by "),
              42.0 * std::sin(kPi / 3.0) - 32.0, 1e-4);
}

TEST(PlanetSpacingFigures, AreThoseOfTheNearestNeighbours) {
  GearTrain train = laid_out(simple_design(12, 30, 72, 3));
  for (const auto& [positions, nearest] :
       {std::pair<std::vector<double>, double>{{0.0, 3.0, 1.0}, 1.0},
        {{0.0, 2.0, 3.5}, 1.5},
        {{0.1, 2.5, 6.2}, kTwoPi - 6.1}}) {
    train.phases.position_rad[static_cast<std::size_t>(train.topology().first_planet())] =
        positions;
    EXPECT_NEAR(check_planet_spacing(train)[0].value, 42.0 * std::sin(0.5 * nearest) - 32.0, 1e-9);
  }
}

TEST(PlanetSpacingFigures, MostPlanetsAreThoseThatOneMoreWouldOverlap) {
  for (const double tip : {0.05, 0.11, 0.26, 0.3, 0.49, 0.499, 0.501, 0.7, 0.86, 0.87, 0.95}) {
    int most = 1;
    while (std::sin(kPi / (most + 1)) > tip) ++most;
    EXPECT_EQ(most_planets(1.0, tip), most) << tip;
    EXPECT_EQ(most_planets(8.0, 8.0 * tip), most) << tip;
  }
  EXPECT_EQ(most_planets(1.0, 1.0), 1);
  EXPECT_EQ(most_planets(1.0, 1.05), 1);
  EXPECT_EQ(most_planets(1.0, 3.0), 1);
  for (int n = 3; n < 60; ++n) EXPECT_EQ(most_planets(7.0, 7.0 * std::sin(kPi / n)), n - 1) << n;
  EXPECT_EQ(check_planet_spacing(laid_out(simple_design(12, 30, 72, 1)))[0].status,
            CheckStatus::kNotApplicable);
}

TEST(ContactRatioFigures, TheLimitIsOneBelowOneAndTheWantedAbove) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "pinion").tip_diameter_mm = 21.2;
  gear(d, "wheel").tip_diameter_mm = 41.2;
  const double c = kCos20, s = std::sin(kPi / 9.0);
  const double ratio =
      (std::sqrt(10.6 * 10.6 - 100.0 * c * c) + std::sqrt(20.6 * 20.6 - 400.0 * c * c) - 30.0 * s) /
      (kPi * c);
  Finding f = check_contact_ratio(laid_out(d))[0];
  ASSERT_GT(ratio, 1.0);
  ASSERT_LT(ratio, 1.1);
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NEAR(f.value, ratio, 1e-9);
  EXPECT_EQ(f.limit, 1.1);
  EXPECT_NEAR(f.margin, ratio - 1.1, 1e-9);
  gear(d, "pinion").tip_diameter_mm = number_after(f.cure, "tip diameter of pinion of ");
  EXPECT_NEAR(check_contact_ratio(laid_out(d))[0].value, 1.1, 1e-3);
  gear(d, "pinion").tip_diameter_mm = gear(d, "wheel").tip_diameter_mm = std::nullopt;
  d.gears[0].tip_diameter_mm = 20.6;
  d.gears[1].tip_diameter_mm = 40.6;
  f = check_contact_ratio(laid_out(d))[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_EQ(f.limit, 1.0);
  EXPECT_NEAR(f.margin, f.value - 1.0, 1e-12);
}

TEST(ContactRatioFigures, TheHelixAddsItsOverlap) {
  GearboxDesign d = pair_design(20, 40, false);
  d.helix_angle_rad = 0.3;
  gear(d, "pinion").face_width_mm = gear(d, "wheel").face_width_mm = 7.0;
  const Finding f = check_contact_ratio(laid_out(d))[0];
  const double overlap = 7.0 * std::sin(0.3) / kPi;
  EXPECT_NEAR(number_after(f.message, "and "), overlap, 1e-3);
  EXPECT_NEAR(f.value, number_after(f.message, "transverse ") + overlap, 1e-3);
}

TEST(ContactRatioFigures, TheCureCountsTheHelix) {
  GearboxDesign d = pair_design(20, 40, false);
  d.gears[0].shift = d.gears[1].shift = 0.0;
  d.helix_angle_rad = 0.2;
  for (GearDesign& g : d.gears) {
    g.face_width_mm = 3.0;
    g.tip_diameter_mm = g.teeth / std::cos(0.2) + 0.9;
  }
  const Finding f = check_contact_ratio(laid_out(d))[0];
  ASSERT_LT(f.margin, 0.0);
  gear(d, "pinion").tip_diameter_mm = number_after(f.cure, "tip diameter of pinion of ");
  const Finding cured = check_contact_ratio(laid_out(d))[0];
  EXPECT_NEAR(cured.value, f.limit, 1e-3) << f.cure;
  EXPECT_GE(cured.value, f.limit - 1e-12);
}

TEST(ContactRatioFigures, BetweenTheStartsOfReliefs) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  for (GearDesign& g : d.gears) {
    g.modifications.tip_relief_um = 20.0;
    g.modifications.tip_relief_start_diameter_mm = g.teeth + 0.8;
  }
  const double c = kCos20, s = std::sin(kPi / 9.0);
  const double between =
      (std::sqrt(10.4 * 10.4 - 100.0 * c * c) + std::sqrt(20.4 * 20.4 - 400.0 * c * c) - 30.0 * s) /
      (kPi * c);
  const Finding f = check_contact_ratio(laid_out(d))[0];
  ASSERT_LT(between, 1.0);
  EXPECT_NEAR(number_after(f.message, "starts of the reliefs "), between, 1e-3);
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NEAR(number_after(f.cure, "tip and root, by "), (1.0 - between) * kPi * c, 1e-3);
}

TEST(ContactRatioFigures, OnlyWhatIsThereIsTold) {
  GearboxDesign d = pair_design(20, 40, false);
  const auto told = [&] { return check_contact_ratio(laid_out(d))[0].message; };
  const auto says = [&](const char* words) { return told().find(words) != std::string::npos; };
  EXPECT_TRUE(says("from the tip circles"));
  EXPECT_FALSE(says("by the helix"));
  EXPECT_FALSE(says("between the starts"));
  for (const char* name : {"pinion", "wheel"}) {
    d = pair_design(20, 40, false);
    gear(d, name).modifications.tip_rounding_mm = 0.1;
    EXPECT_TRUE(says("from the tip form circles")) << name;
  }
}

TEST(ContactRatioFigures, TheHelixCarriesOverReliefs) {
  GearboxDesign d = pair_design(20, 40, false);
  for (GearDesign& g : d.gears) {
    g.modifications.tip_relief_um = 20.0;
    g.modifications.tip_relief_start_diameter_mm = g.teeth / std::cos(0.2) + 0.9;
  }
  int enough = 0, missing = 0;
  for (const double width : {1.0, 4.0, 7.0, 10.0}) {
    d.helix_angle_rad = 0.2;
    for (GearDesign& g : d.gears) g.face_width_mm = width;
    const Finding f = check_contact_ratio(laid_out(d))[0];
    const double overlap = width * std::sin(0.2) / kPi;
    const double there = number_after(f.message, "starts of the reliefs ") + overlap;
    ASSERT_GT(std::abs(there - 1.0), 2e-3);
    EXPECT_EQ(f.status, there > 1.0 ? CheckStatus::kPass : CheckStatus::kWarn) << there;
    ++(there > 1.0 ? enough : missing);
    const double base_pitch =
        kPi / std::cos(0.2) * std::cos(std::atan(std::tan(kPi / 9.0) / std::cos(0.2)));
    if (there < 1.0) {
      EXPECT_NEAR(number_after(f.cure, "tip and root, by "), (1.0 - there) * base_pitch, 3e-3);
    }
  }
  EXPECT_GT(enough, 0);
  EXPECT_GT(missing, 0);
}

TEST(ContactRatioFigures, NameTheRootThatTakesContactAway) {
  for (const bool pinion_first : {true, false}) {
    GearboxDesign d = pinion_first ? pair_design(7, 40, false) : pair_design(40, 7, false);
    d.gears[0].shift = d.gears[1].shift = 0.0;
    const GearTrain train = laid_out(d);
    const TrainGear& small = train.gears[pinion_first ? 0 : 1];
    const auto roll = [](double radius, int teeth) {
      return std::sqrt(radius * radius - std::pow(0.5 * teeth * kCos20, 2));
    };
    // contact from the start of the undercut pinion's involute to its tip
    const double ratio =
        (roll(4.5, 7) - roll(small.profile.root_form_radius_mm(), 7)) / (kPi * kCos20);
    const double total =
        (roll(4.5, 7) + roll(21.0, 40) - 23.5 * std::sin(kPi / 9.0)) / (kPi * kCos20);
    const Finding f = check_contact_ratio(train)[0];
    ASSERT_LT(ratio, 1.1);
    EXPECT_NEAR(f.value, ratio, 1e-9);
    EXPECT_NEAR(number_after(f.message, "transverse "), total, 1e-3);
    EXPECT_EQ(f.cure.find("the root of " + small.name + " takes "), 0U) << f.cure;
    EXPECT_NEAR(number_after(f.cure, "takes "), total - ratio, 1e-3);
  }
}

TEST(TipClearanceFigures, NameTheTipThatIsTooNear) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "wheel").tip_diameter_mm = 42.0 + 2.0 * 0.2;
  Finding f = check_tip_clearance(laid_out(d))[0];
  EXPECT_NEAR(f.value, 0.05, 1e-9);
  EXPECT_NEAR(f.margin, -0.05, 1e-9);
  EXPECT_NEAR(number_after(f.message, "tip of pinion to root of wheel "), 0.25, 1e-6);
  EXPECT_NEAR(number_after(f.message, "tip of wheel to root of pinion "), 0.05, 1e-6);
  EXPECT_NEAR(number_after(f.cure, "tip diameter of wheel of "), 42.3, 1e-6);
  EXPECT_NEAR(number_after(f.cure, " mm ("), -0.1, 1e-6);
  EXPECT_NEAR(number_after(f.cure, "gives "), 0.1, 1e-6);
  GearboxDesign ring = pair_design(20, 60, true);
  gear(ring, "pinion").shift = gear(ring, "wheel").shift = 0.0;
  gear(ring, "wheel").tip_diameter_mm = 58.0 - 2.0 * 0.2;
  f = check_tip_clearance(laid_out(ring))[0];
  EXPECT_NEAR(number_after(f.cure, "tip diameter of wheel of "), 57.7, 1e-6);
  EXPECT_NEAR(number_after(f.cure, " mm (+"), 0.1, 1e-6);
}

TEST(TipClearanceFigures, OfEqualTipsTheFirstIsNamed) {
  GearboxDesign d = pair_design(30, 30, false);
  d.gears[0].shift = d.gears[1].shift = 0.0;
  d.gears[0].tip_diameter_mm = d.gears[1].tip_diameter_mm = 32.4;
  const Finding f = check_tip_clearance(laid_out(d))[0];
  EXPECT_NEAR(f.value, 0.05, 1e-9);
  EXPECT_NEAR(number_after(f.cure, "tip diameter of pinion of "), 32.3, 1e-6) << f.cure;
}

TEST(TipClearanceFigures, OfStandardTipsAreEqualWhateverTheShifts) {
  for (int i = 0; i < 60; ++i) {
    GearboxDesign d = pair_design(18 + i, 41, false);
    d.module_mm = 1.0 + 0.1 * (i % 7);
    d.gears[0].shift = 0.013 * i - 0.3;
    d.gears[1].shift = 0.7 - 0.009 * i;
    d.rack.dedendum = 1.05;
    const Finding f = check_tip_clearance(laid_out(d))[0];
    ASSERT_EQ(f.status, CheckStatus::kWarn) << f.message;
    EXPECT_EQ(number_after(f.message, "root of wheel "),
              number_after(f.message, "root of pinion "));
    EXPECT_EQ(f.cure.find("a tip diameter of pinion "), 0u) << f.cure;
  }
}

/// Where the flanks of a tooth without backlash meet, by bisection; module 1.
double pointed_diameter(int teeth, double shift) {
  double low = teeth * kCos20, high = 2.0 * teeth;
  while (high - low > 1e-12) {
    const double d = 0.5 * (low + high);
    const double half = (kPi / 2.0 + 2.0 * shift * std::tan(kPi / 9.0)) / teeth +
                        involute(kPi / 9.0) - involute(std::acos(teeth * kCos20 / d));
    (half > 0.0 ? low : high) = d;
  }
  return low;
}

TEST(TipThicknessFigures, TheLimitIsAFifthOfTheModule) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.module_mm = 2.0;
  d.gears = {{.name = "gear", .teeth = 24, .shift = 0.3}};
  EXPECT_NEAR(check_tip_thickness(laid_out(d))[0].limit, 0.4, 1e-12);
}

TEST(TipThicknessFigures, APointedToothEndsBeforeItsTipCircle) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 8, .shift = 1.0}};
  const Finding f = check_tip_thickness(laid_out(d))[0];
  EXPECT_NEAR(number_after(f.message, "pointed at diameter "), pointed_diameter(8, 1.0), 1e-4);
  EXPECT_NEAR(number_after(f.message, "before the tip circle of "), 12.0, 1e-6);
}

TEST(TipThicknessFigures, CrowningTakesItsShareOnBothSides) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 24, .shift = 0.3}};
  const Finding plain = check_tip_thickness(laid_out(d))[0];
  EXPECT_EQ(plain.message.find("modifications"), std::string::npos);
  d.gears[0].modifications.crowning_um = 25.0;
  d.gears[0].modifications.edge_chamfer_mm = 0.2;
  const Finding f = check_tip_thickness(laid_out(d))[0];
  EXPECT_NE(f.message.find("where the modifications leave least"), std::string::npos);
  // along the tangent of the base circle, so more by its ratio to the tip circle, in diameters
  EXPECT_NEAR(plain.value - f.value, 2.0 * 0.025 * 26.6 / (24.0 * kCos20), 1e-9);
}

TEST(TipThicknessFigures, TheCureOfARingIsALargerTipDiameter) {
  GearboxDesign d{.name = "ring", .topology = train_topology("gear")};
  d.rack.pressure_angle_rad = rad_from_deg(30.0);
  d.gears = {{.name = "gear", .kind = GearKind::kInternal, .teeth = 60, .shift = 0.0}};
  d.gears[0].tip_diameter_mm = 57.0;
  const Finding f = check_tip_thickness(laid_out(d))[0];
  ASSERT_EQ(f.status, CheckStatus::kWarn) << f.message;
  EXPECT_NE(f.cure.find("a smaller shift of the ring"), std::string::npos) << f.cure;
  d.gears[0].tip_diameter_mm = number_after(f.cure, "tip diameter of ");
  EXPECT_GT(*d.gears[0].tip_diameter_mm, 57.0);
  const Finding cured = check_tip_thickness(laid_out(d))[0];
  EXPECT_NEAR(cured.margin, 0.0, 1e-3);
  EXPECT_GE(cured.margin, 0.0);
}

TEST(TipThicknessFigures, AreTheInvolutes) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .teeth = 10, .shift = 0.6}};
  const Finding f = check_tip_thickness(laid_out(d))[0];
  const double tip = number_after(f.message, "tip diameter ");
  EXPECT_NEAR(tip, 10.0 + 2.0 * 1.6, 1e-4);
  const double thickness = tip * ((kPi / 2.0 + 1.2 * std::tan(kPi / 9.0)) / 10.0 +
                                  involute(kPi / 9.0) - involute(std::acos(10.0 * kCos20 / tip)));
  EXPECT_NEAR(f.value, thickness, 1e-6);
  EXPECT_NEAR(number_after(f.message, "gear: "), thickness, 1e-4);
  EXPECT_NEAR(f.margin, f.value - f.limit, 1e-12);
}

TEST(BacklashFigures, ThinningIsOnTheReferenceCircle) {
  GearboxDesign d = pair_design(20, 40, false, -0.02);
  gear(d, "pinion").shift = 0.6;
  gear(d, "wheel").shift = 0.4;
  const GearTrain train = laid_out(d);
  const Finding f = check_backlash(train)[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(f.value, -0.02, 1e-9);
  EXPECT_NEAR(number_after(f.message, "circumferential backlash "), -0.02, 1e-6);
  // pitch circle 1 is a third of the centre distance
  EXPECT_NEAR(number_after(f.cure, "another "), 20.0 * 30.0 / train.centre_distance_mm, 0.02);
}

TEST(BacklashFigures, NormalToTheFlanksItIsLessByBothAngles) {
  GearboxDesign d = pair_design(20, 40, false, 0.05);
  d.gears[0].shift = d.gears[1].shift = 0.0;
  d.helix_angle_rad = 0.4;
  const Finding f = check_backlash(laid_out(d))[0];
  const double transverse = std::atan(std::tan(kPi / 9.0) / std::cos(0.4));
  const double base_helix = std::asin(std::sin(0.4) * kCos20);
  EXPECT_NEAR(number_after(f.message, "pitch circle, "),
              1e3 * f.value * std::cos(transverse) * std::cos(base_helix), 0.011);
  EXPECT_EQ(f.message.find("no play"), std::string::npos);
  EXPECT_EQ(f.message.find("modifications"), std::string::npos);
  EXPECT_NE(check_backlash(laid_out(pair_design(20, 40, false)))[0].message.find("no play"),
            std::string::npos);
}

TEST(BacklashFigures, AClearanceThatIsAskedForLacksWhatItTakesOnTwoFlanks) {
  for (const double helix : {0.0, kPi / 9.0}) {
    GearboxDesign d = pair_design(20, 40, false, 0.02);
    d.helix_angle_rad = helix;
    EXPECT_EQ(lacking_for_clearance_mm(laid_out(d)), 0.0);
    d.made.clearance_mm = 0.03;
    const double transverse = std::atan(std::tan(kPi / 9.0) / std::cos(helix)),
                 base_helix = std::asin(std::sin(helix) * kCos20);
    EXPECT_NEAR(lacking_for_clearance_mm(laid_out(d)),
                0.06 / (std::cos(transverse) * std::cos(base_helix)) - 0.02, 1e-6);
  }
}

TEST(BacklashFigures, AHelixThatIsOffTakesItFromBothSides) {
  GearboxDesign d = pair_design(20, 40, false, 0.05);
  d.gears[0].shift = d.gears[1].shift = 0.0;
  gear(d, "pinion").modifications.helix_slope_um = 20.0;
  const Finding f = check_backlash(laid_out(d))[0];
  EXPECT_NEAR(f.value, 0.05 - 0.02 / kCos20, 1e-6);
  EXPECT_NEAR(number_after(f.message, "modifications leave ("), 0.05, 1e-6);
}

TEST(CentreDistanceFigures, OfTheCureHold) {
  GearboxDesign d = pair_design(20, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.2;
  d.centre_distance_mm = 30.1;
  const Finding f = check_centre_distance(laid_out(d))[0];
  ASSERT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(number_after(f.message, "at centre distance "), 30.1, 1e-6);
  const double shift = number_after(f.cure, "shift of wheel ");
  const double change = number_after(f.cure, "(");
  EXPECT_LT(change, 0.0);
  EXPECT_NEAR(0.2 + change, shift, 1e-5);
  d.centre_distance_mm = number_after(f.cure, "centre distance ");
  EXPECT_NEAR(check_centre_distance(laid_out(d))[0].value, 0.0, 1e-4);
}

TEST(Findings, TheVerdictIsTheWorstOfThem) {
  const Finding passes{.status = CheckStatus::kPass}, warns{.status = CheckStatus::kWarn},
      fails{.status = CheckStatus::kFail}, idle{.status = CheckStatus::kNotApplicable};
  EXPECT_EQ(verdict({}), CheckStatus::kPass);
  EXPECT_EQ(verdict({idle, passes, idle}), CheckStatus::kPass);
  EXPECT_EQ(verdict({passes, warns, passes}), CheckStatus::kWarn);
  EXPECT_EQ(verdict({warns, fails, passes}), CheckStatus::kFail);
}

TEST(Findings, FoundAnewStandForThoseOfTheSameChecksAndNoOthers) {
  Findings findings{{.id = "tolerance", .where = "sun-planet"},
                    {.id = "axial", .where = "train"},
                    {.id = "tolerance", .where = "train"}};
  renew_findings(findings,
                 {{.id = "tolerance", .where = "sun-planet", .status = CheckStatus::kFail}});
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].id, "axial");
  EXPECT_EQ(findings[1].status, CheckStatus::kFail);
  renew_findings(findings, {});
  EXPECT_EQ(findings.size(), 2U);
}

TEST(CentreDistanceFigures, OfTheCureOfARingHold) {
  GearboxDesign d = pair_design(20, 60, true);
  gear(d, "pinion").shift = 0.3;
  gear(d, "wheel").shift = 0.1;
  d.centre_distance_mm = 20.0;
  const Finding tight = check_centre_distance(laid_out(d))[0];
  ASSERT_EQ(tight.status, CheckStatus::kFail);
  EXPECT_EQ(tight.margin, tight.value);
  GearboxDesign shifted = d;
  gear(shifted, "wheel").shift = number_after(tight.cure, "shift of wheel ");
  EXPECT_NEAR(check_centre_distance(laid_out(shifted))[0].value, 0.0, 1e-4);
  EXPECT_NEAR(number_after(tight.cure, "(+"), *gear(shifted, "wheel").shift - 0.1, 1e-5);
  d.centre_distance_mm = number_after(tight.cure, "centre distance ");
  EXPECT_NEAR(check_centre_distance(laid_out(d))[0].value, 0.0, 1e-4);
  d.centre_distance_mm = 19.0;
  const Finding loose = check_centre_distance(laid_out(d))[0];
  ASSERT_GT(loose.value, 0.25);
  EXPECT_NEAR(loose.limit, 0.25, 1e-12);
  EXPECT_NEAR(loose.margin, 0.25 - loose.value, 1e-12);
}

TEST(AxialFigures, APlanetUnderTheOtherRingIsInItsWay) {
  GearTrain train = laid_out(paper_design());
  train.gears[1].face_width_mm += 2.0;
  const Finding f = check_axial(train)[0];
  EXPECT_EQ(f.message.find("planet1 and ring2 touch"), 0U) << f.message;
  EXPECT_NEAR(f.value, -1.0, 1e-9);
}

TEST(AxialFigures, AreTheGapBetweenTheLayers) {
  GearboxDesign d = paper_design();
  const Finding apart = check_axial(laid_out(d))[0];
  EXPECT_NEAR(number_after(apart.message, "stand "), 1.0, 1e-6);
  EXPECT_EQ(apart.margin, apart.value);
  gear(d, "ring1").face_width_mm = 11.5;
  const Finding f = check_axial(laid_out(d))[0];
  EXPECT_NEAR(number_after(f.message, "overlap by "), 0.5, 1e-6);
  EXPECT_EQ(f.message.find("ring1 and ring2"), 0U) << f.message;
  EXPECT_NEAR(number_after(f.cure, "layer_gap_mm above "), 1.5, 1e-6);
  EXPECT_NEAR(number_after(f.cure, "face width of ring1 below "), 11.0, 1e-6);
  d.layer_gap_mm = 1.51;
  EXPECT_NEAR(check_axial(laid_out(d))[0].value, 0.01, 1e-9);
  EXPECT_EQ(check_axial(laid_out(simple_design(12, 30, 72, 3)))[0].status,
            CheckStatus::kNotApplicable);
}

/// Second planets so large that neither the sun nor the first ring passes them.
GearboxDesign large_second_planets() {
  GearboxDesign d = paper_design();
  d.centre_distance_mm = 22.6;
  const int teeth[] = {15, 30, 75, 36, 81};
  for (std::size_t i = 0; i < 5; ++i) d.gears[i].teeth = teeth[i];
  d.gears[2].shift = d.gears[4].shift = 0.3;
  return d;
}

TEST(AxialFigures, AreThoseOfTheNearestParts) {
  EXPECT_EQ(check_axial(laid_out(paper_design()))[0].message.find("planet1 and ring2"),
            0U);  // the first of equal ones
  GearTrain train = laid_out(large_second_planets());
  train.gears[1].face_width_mm -= 1.0;
  train.gears[3].z_lower_mm += 3.0;
  const Finding f = check_axial(train)[0];
  EXPECT_EQ(f.message.find("ring1 and ring2"), 0U) << f.message;
  EXPECT_NEAR(f.value, 1.0, 1e-9);
}

TEST(AxialFigures, CountOnlyPartsThatDoNotPassEachOther) {
  GearboxDesign d = paper_design();
  gear(d, "sun").face_width_mm = 14.0;  // up between the second planets, which are smaller
  EXPECT_NEAR(check_axial(laid_out(d))[0].value, 1.0, 1e-9);
  d = large_second_planets();
  gear(d, "sun").face_width_mm = 14.0;
  const GearTrain train = laid_out(d);
  const Finding f = check_axial(train)[0];
  EXPECT_EQ(f.message.find("sun and planet2"), 0U) << f.message;
  EXPECT_NEAR(f.value, train.gears[3].z_lower_mm - train.gears[0].z_lower_mm - 14.0, 1e-9);
  EXPECT_EQ(f.status, CheckStatus::kFail);
}

}  // namespace
}  // namespace trueflank::test
