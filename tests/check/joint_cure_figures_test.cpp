// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "tests/check/recorded_cures.h"
#include "tests/support/recorded.h"
#include "tests/support/two_stage_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/cure/cure_trial.h"
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/design/design_edit.h"

// How the joint cure compares what it tried, and what it ends with.
namespace trueflank::test {
namespace {

Finding of(const char* id, const char* where, CheckStatus status) {
  return {.id = id, .where = where, .status = status};
}
constexpr CheckStatus kPass = CheckStatus::kPass, kWarn = CheckStatus::kWarn,
                      kFail = CheckStatus::kFail;

TEST(CureTrial, WhatFailsLessIsBetterThenWhatIsCleanThenHalfAWarningThenWhatCostsLess) {
  const auto trial = [](double failing, double worrying, double cost) {
    return CureTrial{.change = {}, .cost = cost, .failing = failing, .worrying = worrying};
  };
  const std::vector<CureTrial> best_first{
      trial(0.0, 0.0, 0.1), trial(0.0, 0.0, 5.0), trial(0.0, 1.1, 0.2), trial(0.0, 1.0, 0.3),
      trial(0.0, 2.1, 0.1), trial(0.0, 2.0, 0.2), trial(1.1, 0.0, 0.2), trial(1.1, 0.4, 0.3),
      trial(1.1, 3.0, 0.0), trial(1.2, 0.0, 0.0)};
  for (std::size_t i = 0; i < best_first.size(); ++i)
    for (std::size_t k = 0; k < best_first.size(); ++k)
      EXPECT_EQ(better(best_first[i], best_first[k]), i < k) << i << ' ' << k;
  EXPECT_TRUE(better(trial(0.0, 1.0, 1.0), trial(0.0, 1.55, 0.0)));
  EXPECT_FALSE(better(trial(0.0, 1.0, 1.0), trial(0.0, 1.5, 0.0)));
  EXPECT_TRUE(better(best_first.back(), CureTrial{}));
  EXPECT_FALSE(better(CureTrial{}, CureTrial{}));
  EXPECT_TRUE(trial(0.0, 1.0, 0.0).passes());
  EXPECT_FALSE(trial(0.1, 0.0, 0.0).passes());
}

TEST(CureTrial, TipsCostWhatTheirRadiusChangesInModules) {
  GearboxDesign design = pair_design(20, 40, false, 0.05);
  design.module_mm = 2.0;
  const GearTrain train = laid_out(design);
  EXPECT_EQ(tip_cost(train, {}), 0.0);
  EXPECT_NEAR(tip_cost(train, {.tip_diameter_mm = {{0, 43.2}, {1, 84.4}}}), (0.4 + 0.2) / 2.0,
              1e-12);  // standard tips: 44 mm and 84 mm
}

TEST(CureTrial, ShiftsFitWhereTheBacklashTheyImplyIsAboveZeroAndBelowAQuarterOfTheModule) {
  GearboxDesign design = paper_design();
  design.module_mm = 2.0;
  *design.centre_distance_mm *= 2.0;
  GearTrain train = laid_out(design);
  for (std::size_t mesh = 0; mesh < train.meshes.size(); ++mesh)
    for (const auto& [backlash_mm, fits] : {std::pair(0.0, true),
                                            {0.4, true},
                                            {0.49, true},
                                            {-1e-4, true},
                                            {-2e-4, false},
                                            {0.5, false}}) {
      for (TrainMesh& m : train.meshes) m.implied_backlash_mm = 0.1;
      train.meshes[mesh].implied_backlash_mm = backlash_mm;
      EXPECT_EQ(shifts_fit(train), fits) << mesh << ' ' << backlash_mm;
    }
}

TEST(CureTrial, WarningsAreThoseOfGearsOfTheLayer) {
  GearboxDesign design = paper_design();
  gear(design, "sun").teeth = 9;  // undercut
  gear(design, "ring1").teeth = 87;
  gear(design, "sun").shift = -0.3;
  design.centre_distance_mm = 24.0;
  gear(design, "planet2").tip_diameter_mm = 38.0;  // tips of no width
  const GearTrain train = laid_out(design);
  const std::set<std::string> all = warned_gears(train, 0), first = warned_gears(train, 1),
                              second = warned_gears(train, 2);
  EXPECT_TRUE(first.contains("undercut@sun"));
  EXPECT_TRUE(second.contains("tip_thickness@planet2"));
  EXPECT_EQ(all.size(), first.size() + second.size());
  std::set<std::string> expected;
  for (const Finding& f : check_gearbox(train))
    if (f.status == kWarn && (f.id == "profile" || f.id == "undercut" || f.id == "tip_thickness"))
      expected.insert(f.id + "@" + f.where);
  EXPECT_EQ(all, expected);
}

TEST(CureTrial, WhatPassedAndFailsNewlyFailsButForPartsAround) {
  const Findings before{of("a", "x", kPass), of("a", "y", kFail), of("b", "x", kWarn),
                        of("housing", "x", kPass)};
  EXPECT_FALSE(any_newly_fails(before, {}, {}));
  EXPECT_FALSE(any_newly_fails(before, before, {}));
  EXPECT_TRUE(any_newly_fails(before, {of("a", "y", kPass), of("a", "x", kFail)}, {}));
  EXPECT_FALSE(any_newly_fails(before, {of("a", "x", kWarn)}, {}));
  EXPECT_FALSE(any_newly_fails(before, {of("b", "x", kFail), of("a", "z", kFail)}, {}));
  EXPECT_TRUE(any_newly_fails(before, {of("housing", "x", kFail)}, {}));
  EXPECT_FALSE(any_newly_fails(before, {of("housing", "x", kFail)}, {"housing"}));
  EXPECT_EQ(count_of(before, kPass), 2);
  EXPECT_EQ(count_of(before, kFail), 1);
}

TEST(CureTrial, ConflictsNameTheFewestChecksAndOfThoseWhatFailedMostOften) {
  EXPECT_EQ(conflict_text({}, {}), "");
  EXPECT_EQ(conflict_text({}, {of("a", "x", kPass), of("b", "x", kFail)}),
            "nothing near this design clears b");
  EXPECT_EQ(conflict_text({{{"a"}, 3}, {{"a", "b"}, 9}}, {}), "nothing near this design clears a");
  EXPECT_EQ(conflict_text({{{"a"}, 3}}, {}), "nothing near this design clears a");
  EXPECT_EQ(conflict_text({{{"a"}, 2}, {{"b"}, 2}, {{"c"}, 2}}, {}),
            "a and b contradict each other near this design: what clears one fails the other");
  EXPECT_EQ(conflict_text({{{"a"}, 3}, {{"b"}, 1}, {{"c"}, 7}, {{"a", "b"}, 9}}, {}),
            "c and a contradict each other near this design: what clears one fails the other");
  EXPECT_EQ(conflict_text({{{"a", "b", "c"}, 9}, {{"b", "c"}, 2}, {{"b", "d"}, 4}}, {}),
            "b and d fail together in every design near this one");
}

/// The keys that a cure changes, as the file writes them; why it is none; whether its search ended.
std::string text_of(const GearboxDesign& before, const JointCure& cure) {
  std::ostringstream text;
  for (const DesignKeyChange& change : design_changes(before, cure.design))
    text << change.dotted() << ' ' << (change.after.empty() ? "none" : change.after) << "; ";
  text << cure.conflict << (cure.search_ended ? "" : "(not ended)");
  return text.str().substr(0, text.str().find_last_not_of("; ") + 1);
}

/// Random designs, some of module 2, some with tolerances or a clearance asked for, some with
/// little time, some with a wall around them.
std::string of_seed(int seed) {
  GearboxDesign design = random_design(static_cast<std::uint64_t>(seed));
  if (seed / 2 % 2 == 1) {
    design.module_mm *= 2.0;
    design.backlash_mm *= 2.0;
    if (design.centre_distance_mm) *design.centre_distance_mm *= 2.0;
    for (GearDesign& gear : design.gears)
      if (gear.tip_diameter_mm) *gear.tip_diameter_mm *= 2.0;
  }
  if (seed % 7 == 3) design.made.clearance_mm = 0.01 * design.module_mm;
  if (seed % 7 == 5) design.made.tolerance_class = 7;
  const auto train = lay_out(design);
  if (!train) return "not laid out";
  const int kind = seed % 4;
  const JointCureOptions options{.most_designs = std::array{400, 400, 40, 150}[kind],
                                 .most_turned = std::array{30, 30, 8, 4}[kind],
                                 .most_judged = std::array{40, 40, 6, 15}[kind],
                                 .farther = seed % 3 == 0};
  const AroundGears wall = [&](const GearTrain& gears) -> std::optional<Findings> {
    const double wider = gears.centre_distance_mm - train->centre_distance_mm;
    if (wider > 0.15 * design.module_mm) return std::nullopt;
    return Findings{of("wall", "train", wider > 0.04 * design.module_mm ? kFail : kPass)};
  };
  Findings before = check_gearbox(*train);
  if (seed % 5 == 2) {
    before.push_back(of("wall", "train", kPass));
    return text_of(design, joint_cure(*train, before, options, wall));
  }
  return text_of(design, joint_cure(*train, before, options));
}

TEST(JointCureFigures, OfRandomDesignsAreTheChangesWrittenDown) {
  expect_as_recorded(kRecordedCures, of_seed);
}

TEST(JointCureFigures, OfRandomDesignsThatTakeLongerAreTheChangesWrittenDown) {
  expect_as_recorded(kRecordedLongerCures, of_seed);
}

/// A pair without backlash whose class asks for some, in a housing.
GearboxDesign lacking_backlash() {
  GearboxDesign design = pair_design(24, 60, false, 0.0);
  design.tips = TipCircles::kClear;
  design.made.tolerance_class = 7;
  return design;
}

std::string keys_of(const GearboxDesign& before, const GearboxDesign& after) {
  std::string keys;
  for (const DesignKeyChange& change : design_changes(before, after)) keys += change.dotted() + ' ';
  return keys;
}

TEST(JointCureFigures, AHousingOfFixedSizeGrowsWhereThatHelps) {
  GearboxDesign design = lacking_backlash();
  design.machine.emplace().housing.outer_diameter_mm = 100.0;
  const GearTrain train = laid_out(design);
  enum class Wall { kTooSmall, kTooSmallToMake, kFailsAnyway, kFits };
  const auto cured = [&](Wall wall) {
    const AroundGears around = [&](const GearTrain& gears) -> std::optional<Findings> {
      const bool fixed = gears.design.machine->housing.outer_diameter_mm.has_value(),
                 changed = gears.design.backlash_mm > 0.0;
      if (wall == Wall::kTooSmallToMake && fixed && changed) return std::nullopt;
      const bool fails = (wall == Wall::kTooSmall && fixed) || wall == Wall::kFailsAnyway;
      return Findings{of("housing", "housing", fails ? kFail : kPass)};
    };
    Findings before = check_gearbox(train);
    const Findings of_parts = around(train).value();
    before.insert(before.end(), of_parts.begin(), of_parts.end());
    return joint_cure(train, before, {.most_designs = 20, .most_turned = 20, .farther = false},
                      around);
  };
  const std::string backlash = "gearbox.backlash_mm ", size = "housing.outer_diameter_mm ";
  EXPECT_EQ(keys_of(design, cured(Wall::kFits).design), backlash);
  EXPECT_EQ(keys_of(design, cured(Wall::kTooSmall).design), backlash + size);
  EXPECT_TRUE(cured(Wall::kTooSmall).cured());
  const JointCure anyway = cured(Wall::kFailsAnyway);
  EXPECT_EQ(keys_of(design, anyway.design), backlash);
  EXPECT_EQ(anyway.conflict, "the gears pass; what is around them has to follow by hand");
  // parts that cannot be made: no change of the gears is one
  const JointCure none = cured(Wall::kTooSmallToMake);
  EXPECT_FALSE(none.cured());
  EXPECT_FALSE(none.changed);
}

TEST(JointCureFigures, AHousingOfFixedSizeStaysWhereALargerOneFailsMore) {
  GearboxDesign design = lacking_backlash();
  design.machine.emplace().housing.outer_diameter_mm = 100.0;
  const GearTrain train = laid_out(design);
  const AroundGears around = [](const GearTrain& gears) -> std::optional<Findings> {
    const bool fixed = gears.design.machine->housing.outer_diameter_mm.has_value();
    return Findings{of("housing", "housing", kFail), of("housing", "lid", fixed ? kPass : kFail),
                    of("housing", "screws", fixed ? kPass : kFail)};
  };
  Findings before = check_gearbox(train);
  const Findings of_parts = around(train).value();
  before.insert(before.end(), of_parts.begin(), of_parts.end());
  const JointCure cure =
      joint_cure(train, before, {.most_designs = 20, .most_turned = 20, .farther = false}, around);
  EXPECT_TRUE(cure.changed);
  EXPECT_EQ(keys_of(design, cure.design), "gearbox.backlash_mm ");
}

TEST(JointCureFigures, ACentreDistanceIsMovedNoFartherThanItMustBe) {
  GearboxDesign design = pair_design(24, 60, false, 0.1);
  design.tips = TipCircles::kClear;
  design.centre_distance_mm = 40.2;
  const JointCure cure =
      joint_cure(laid_out(design), {.most_designs = 600, .most_turned = 60, .farther = false});
  ASSERT_TRUE(cure.cured());
  EXPECT_EQ(keys_of(design, cure.design), "gearbox.centre_distance_mm pinion.shift ");
  // by steps of a tenth of a module, less than an eighth of one
  EXPECT_GT(*cure.design.centre_distance_mm, 40.2);
  EXPECT_LT(*cure.design.centre_distance_mm, 40.2 + 0.1 / 8.0 - 1e-4);
}

TEST(JointCureFigures, WhatFailsAroundTheGearsAloneIsNoReasonToLookFarther) {
  GearboxDesign design = pair_design(24, 60, false, 0.1);
  design.tips = TipCircles::kClear;
  const GearTrain train = laid_out(design);
  int asked = 0;
  const AroundGears never = [&](const GearTrain&) {
    ++asked;
    return Findings{of("housing", "housing", kFail)};
  };
  Findings before = check_gearbox(train);
  before.push_back(of("housing", "housing", kFail));
  const JointCure cure = joint_cure(train, before, {.most_designs = 60, .most_turned = 20}, never);
  EXPECT_FALSE(cure.changed);
  EXPECT_EQ(cure.conflict, "the gears pass; what is around them has to follow by hand");
  EXPECT_LT(asked, 20);
}

TEST(JointCureFigures, StartsAgainFromAStandardRackWhereNothingNearPasses) {
  GearboxDesign design = pair_design(24, 60, false, 0.1);
  design.tips = TipCircles::kClear;
  design.rack.addendum = 0.45;  // tips that reach too short
  design.rack.dedendum = 0.75;
  const GearTrain train = laid_out(design);
  const Findings before = check_gearbox(train);
  ASSERT_EQ(verdict(before), kFail);
  const auto cured = [&](bool farther) {
    return joint_cure(train, before, {.most_designs = 2, .most_turned = 2, .farther = farther});
  };
  EXPECT_FALSE(cured(false).cured());
  const JointCure cure = cured(true);
  EXPECT_TRUE(cure.cured());
  EXPECT_TRUE(cure.changed);
  EXPECT_FALSE(cure.search_ended);
  // of the way to the addendum of 1 a half, and five eighths of that
  EXPECT_EQ(text_of(design, cure), "rack.addendum 0.6219; rack.dedendum 1.0; (not ended)");
}

TEST(JointCureFigures, GoesOnToTheNextStartWhereOneIsNotCured) {
  GearboxDesign design = pair_design(18, 34, false, 0.1);
  design.tips = TipCircles::kClear;
  design.rack.pressure_angle_rad = rad_from_deg(30.0);
  design.rack.addendum = 0.1;  // too short half way to the standard rack, too
  design.rack.dedendum = 0.35;
  design.rack.root_radius = 0.1;
  const JointCure cure = joint_cure(laid_out(design), {.most_designs = 2, .most_turned = 2});
  EXPECT_TRUE(cure.cured());
  EXPECT_TRUE(cure.changed);
  EXPECT_EQ(cure.design.gears[0].teeth, 18);
  EXPECT_GT(cure.design.rack.addendum, 0.6);
}

TEST(JointCureFigures, ATipThatTurningShowsInTheWayIsShortenedAlone) {
  const std::string key = "wheel.tip_diameter_mm ";
  for (const auto& [pinion, tip] : {std::pair(18, "22.847"), {25, "29.85"}, {32, "36.861"}}) {
    GearboxDesign design = pair_design(pinion, pinion + 6, true, 0.02);
    design.gears[0].shift = design.gears[1].shift = 0.0;
    const JointCure cure = joint_cure(laid_out(design), {.most_designs = 1, .farther = false});
    EXPECT_TRUE(cure.cured());
    EXPECT_EQ(text_of(design, cure), key + tip + "; (not ended)");
    // a hundredth more material is too much
    gear(design, "wheel").tip_diameter_mm = *cure.design.gears[1].tip_diameter_mm - 0.02;
    const Findings findings = check_gearbox(laid_out(design));
    EXPECT_TRUE(only(findings, "overlap").status == kFail ||
                only(findings, "corner_contact").status != kPass);
  }
}

TEST(JointCureFigures, StagesThatFailAreCuredOneAfterTheOtherAndOthersLeftAlone) {
  constexpr StageTeeth kFirst{
      .sun = 18, .planet = 36, .planets = 3, .module_mm = 0.8, .face_width_mm = 8.0},
      kSecond{.sun = 20, .planet = 26, .planets = 4, .module_mm = 1.0, .face_width_mm = 14.0};
  GearboxDesign plain = two_stage_design(kFirst, kSecond);
  plain.tips = TipCircles::kClear;
  ASSERT_NE(verdict(check_gearbox(laid_out(plain))), kFail);
  const auto cured = [&](std::initializer_list<const char*> too_long,
                         const JointCureOptions& options, double longer2_mm = 0.0) {
    GearboxDesign design = plain;
    if (longer2_mm > 0.0)
      gear(design, "sun2").tip_diameter_mm =
          2.0 * (laid_out(plain).find("sun2")->profile.tip_radius_mm() + longer2_mm);
    for (const char* name : too_long)
      gear(design, name).tip_diameter_mm =
          2.0 * laid_out(plain).find(name)->profile.tip_radius_mm() + 0.6;
    const JointCure cure = joint_cure(laid_out(design), options);
    return keys_of(design, cure.design) + (cure.cured() ? "" : "fails ") + cure.conflict +
           (cure.search_ended ? "" : "not ended");
  };
  const JointCureOptions soon{.most_designs = 2, .most_turned = 1, .farther = false};
  EXPECT_EQ(cured({"sun1"}, soon), "sun1.tip_diameter_mm not ended");
  EXPECT_EQ(cured({"sun2"}, soon), "sun2.tip_diameter_mm not ended");
  // that it warns of a tip is no reason to change the stage where the other one fails
  EXPECT_EQ(cured({"sun1"}, soon, 0.18), "sun1.tip_diameter_mm not ended");
  EXPECT_EQ(cured({}, soon, 0.18), "sun2.tip_diameter_mm not ended");
  EXPECT_EQ(cured({"sun1", "sun2"}, soon), "sun1.tip_diameter_mm sun2.tip_diameter_mm not ended");
}

TEST(JointCureFigures, LayersThatOverlapAreSetApartAndTheirGapIsTheOneThingChanged) {
  const JointCureOptions soon{.most_designs = 30, .most_turned = 30, .farther = false};
  for (const double module_mm : {1.0, 2.5}) {
    GearboxDesign design = paper_design(0.05 * module_mm);
    design.tips = TipCircles::kClear;
    design.module_mm = module_mm;
    *design.centre_distance_mm *= module_mm;
    ASSERT_FALSE(joint_cure(laid_out(design), soon).changed);
    design.layer_gap_mm = -0.7;
    const JointCure cure = joint_cure(laid_out(design), soon);
    EXPECT_TRUE(cure.cured());
    EXPECT_EQ(keys_of(design, cure.design), "gearbox.layer_gap_mm ");
    // set apart by a fifth of the module more than they lack, and back by eighths of the way
    const double eighth = (0.7 + 0.2 * module_mm) / 8.0;
    EXPECT_NEAR(cure.design.layer_gap_mm, -0.7 + eighth * (std::floor(0.7 / eighth) + 1.0), 1e-4);
  }
}

TEST(JointCureFigures, WhatFailsTogetherInEveryDesignTriedIsToldTogether) {
  // seven planets stand in each other, and tips that reach too short leave the teeth too early
  GearboxDesign design = simple_design(12, 30, 72, 7);
  design.tips = TipCircles::kClear;
  const JointCureOptions soon{.most_designs = 1, .most_turned = 1, .farther = false};
  EXPECT_EQ(joint_cure(laid_out(design), soon).conflict,
            "nothing near this design clears planet_spacing");
  design.rack.addendum = 0.45;
  design.rack.dedendum = 0.75;
  EXPECT_EQ(joint_cure(laid_out(design), soon).conflict,
            "contact_ratio and planet_spacing fail together in every design near this one");
}

TEST(JointCureFigures, TheSearchIsOverOnceItsDesignsOrTurnsAreSpent) {
  GearboxDesign design = pair_design(12, 60, false, 0.1);
  design.gears[0].shift = design.gears[1].shift = 0.0;
  const GearTrain train = laid_out(design);
  const Findings before = check_gearbox(train);
  const auto ended = [&](int JointCureOptions::*limit, int most) {
    JointCureOptions options{.most_designs = 100000, .most_turned = 100000, .farther = false};
    options.*limit = most;
    return joint_cure(train, before, options).search_ended;
  };
  EXPECT_TRUE(ended(&JointCureOptions::most_designs, 3));
  EXPECT_FALSE(ended(&JointCureOptions::most_designs, 2));
  EXPECT_TRUE(ended(&JointCureOptions::most_turned, 2));
  EXPECT_FALSE(ended(&JointCureOptions::most_turned, 1));
}

/// Planets and teeth of all designs for which parts were asked that nobody can make.
std::set<std::vector<int>> teeth_tried(const GearboxDesign& design, int most_designs) {
  const GearTrain train = laid_out(design);
  std::set<std::vector<int>> tried;
  const AroundGears none = [&](const GearTrain& gears) -> std::optional<Findings> {
    std::vector<int> teeth{gears.design.planets};
    for (const GearDesign& g : gears.design.gears) teeth.push_back(g.teeth);
    tried.insert(teeth);
    return std::nullopt;
  };
  const JointCure cure = joint_cure(
      train, {}, {.most_designs = most_designs, .most_turned = 100000, .farther = false}, none);
  EXPECT_FALSE(cure.changed);
  return tried;
}

TEST(JointCureFigures, OfAPairAllTeethWithinThreeAreTried) {
  EXPECT_EQ(teeth_tried(pair_design(24, 60, false, 0.1), 450).size(), 7u * 7u);
}

TEST(JointCureFigures, OfASetThatDoesNotMeshFortyCountsOfTeethAreTried) {
  const std::size_t of_set = teeth_tried(simple_design(13, 30, 73, 4), 100000).size();
  EXPECT_GT(of_set, 20u);
  EXPECT_LE(of_set, 40u + 1u);
}

}  // namespace
}  // namespace trueflank::test
