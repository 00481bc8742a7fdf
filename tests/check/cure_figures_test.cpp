// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "tests/check/check_designs.h"
#include "trueflank/base/units.h"
#include "trueflank/check/cure/design_change.h"
#include "trueflank/check/cure/farther_designs.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/check/cure/joint_cure_moves.h"
#include "trueflank/check/cure/needed_changes.h"
#include "trueflank/check/cure/shortened_tips.h"
#include "trueflank/check/mesh_clearance.h"

// What cures are put together from, by counting and by formulas.
namespace trueflank::test {
namespace {

TEST(DesignChangeFigures, CostsAreThoseThatAreWrittenDown) {
  EXPECT_EQ(DesignChange{}.cost(), 0.0);
  EXPECT_DOUBLE_EQ(DesignChange{.centre_distance = -0.5}.cost(), 0.6);
  EXPECT_DOUBLE_EQ(DesignChange{.backlash = 0.1}.cost(), 0.2);
  EXPECT_DOUBLE_EQ(DesignChange{.root_radius = -0.2}.cost(), 0.3);
  EXPECT_DOUBLE_EQ(DesignChange{.addendum = -0.2}.cost(), 0.3);
  EXPECT_DOUBLE_EQ((DesignChange{.shift_of_layer = {{1, 0.3}, {2, -0.2}}}.cost()), 0.5);
  EXPECT_DOUBLE_EQ((DesignChange{.teeth = {1, 0, -2}}.cost()), 2.9);
  EXPECT_EQ((DesignChange{.teeth = {0, 0}}.cost()), 0.0);
  EXPECT_DOUBLE_EQ(DesignChange{.planets = -2}.cost(), 4.0);
  const DesignChange all{.centre_distance = 0.5,
                         .backlash = 0.1,
                         .root_radius = -0.2,
                         .addendum = -0.2,
                         .shift_of_layer = {{1, 0.3}},
                         .teeth = {1},
                         .planets = 1};
  EXPECT_DOUBLE_EQ(all.cost(), 0.6 + 0.2 + 0.3 + 0.3 + 0.3 + 2.3 + 2.0);
}

TEST(DesignChangeFigures, OfTheGearWithMostMeshesOfEachLayer) {
  const GearTrain train = laid_out(paper_design());
  EXPECT_EQ(meshing_layers(train), (std::vector<int>{1, 2}));
  EXPECT_EQ(leading_gear(train, 1), 1u);  // planet1: sun and ring1
  EXPECT_EQ(leading_gear(train, 2), 3u);  // planet2 and ring2 have one mesh each: the first
}

TEST(DesignChangeFigures, AreWrittenAsPeopleWriteThemWithinWhatFilesTake) {
  const GearTrain train = laid_out(pair_design(20, 40, false, 0.05));
  const GearboxDesign& old = train.design;
  const GearboxDesign moved = changed_design(
      train, {.backlash = 0.03003, .root_radius = -0.1, .addendum = -0.2, .layer_gap_mm = 0.25},
      true);
  EXPECT_DOUBLE_EQ(moved.backlash_mm, 0.08);
  EXPECT_DOUBLE_EQ(moved.rack.root_radius, 0.28);
  EXPECT_DOUBLE_EQ(moved.rack.addendum, 0.8);
  EXPECT_DOUBLE_EQ(moved.layer_gap_mm, old.layer_gap_mm + 0.25);
  EXPECT_EQ(moved.centre_distance_mm, old.centre_distance_mm);
  EXPECT_FALSE(moved.gears[0].shift);
  const GearboxDesign least =
      changed_design(train, {.backlash = 3.0, .root_radius = -1.0, .addendum = -2.0}, true);
  EXPECT_EQ(least.backlash_mm, 1.0);  // a module
  EXPECT_EQ(least.rack.root_radius, 0.0);
  EXPECT_EQ(least.rack.addendum, 0.05);
}

TEST(DesignChangeFigures, OfTheCentreDistanceFollowTheTeeth) {
  GearboxDesign design = pair_design(20, 40, false, 0.05);
  design.centre_distance_mm = 30.2;
  design.gears[0].shift = 0.1;
  const GearTrain train = laid_out(design);
  const GearboxDesign other = changed_design(train, {.teeth = {2, -1}}, true);
  EXPECT_EQ(other.gears[0].teeth, 22);
  EXPECT_EQ(other.gears[1].teeth, 39);
  EXPECT_DOUBLE_EQ(*other.centre_distance_mm, 30.7);
  EXPECT_EQ(other.gears[0].shift, 0.1);
  EXPECT_FALSE(other.gears[1].shift);
  const GearboxDesign wider =
      changed_design(train, {.centre_distance = 0.3, .shift_of_layer = {{1, -0.25}}}, true);
  EXPECT_DOUBLE_EQ(*wider.centre_distance_mm, 30.5);
  EXPECT_DOUBLE_EQ(*wider.gears[0].shift, -0.15);
  // shifts and distance that do not fit are solved for, whatever else changes
  const GearboxDesign fitted = changed_design(train, {}, false);
  EXPECT_EQ(fitted.centre_distance_mm, 30.2);
  EXPECT_EQ(fitted.gears[0].shift, 0.1);
  EXPECT_FALSE(fitted.gears[1].shift);
}

TEST(DesignChangeFigures, AShiftThatWasSolvedForAFarDistanceIsForgotten) {
  GearboxDesign design = pair_design(20, 40, false, 0.05);
  design.centre_distance_mm = 30.9;
  const GearTrain train = laid_out(design);
  ASSERT_GT(std::abs(train.gears[0].shift), 0.1);
  EXPECT_EQ(changed_design(train, {.centre_distance = -0.9}, true).gears[0].shift, 0.0);
  EXPECT_NEAR(*changed_design(train, {.centre_distance = -0.4}, true).gears[0].shift,
              train.gears[0].shift, 1e-6);
  design.gears[0].shift = 0.3;
  EXPECT_EQ(changed_design(laid_out(design), {.centre_distance = -0.9}, true).gears[0].shift, 0.3);
}

void expect_from_small_to_large(const std::vector<DesignChange>& moves) {
  for (std::size_t i = 1; i < moves.size(); ++i)
    EXPECT_LE(moves[i - 1].cost(), moves[i].cost()) << i;
}

TEST(JointCureMoves, OfCommonValuesAreAllOfThemFromSmallToLarge) {
  const std::vector<DesignChange> near = common_moves(laid_out(pair_design(20, 40, false, 0.05)));
  EXPECT_EQ(near.size(), 11u * 3u * 4u * 4u);
  EXPECT_EQ(near.front().cost(), 0.0);
  expect_from_small_to_large(near);
  // of equal cost: the nearer distance first, then less backlash, less of the root, less of the addendum
  const auto order = [](const DesignChange& m) {
    return std::tuple(std::abs(m.centre_distance), m.centre_distance < 0.0, m.backlash,
                      -m.root_radius, -m.addendum);
  };
  int alike = 0;
  for (std::size_t i = 1; i < near.size(); ++i)
    if (near[i - 1].cost() == near[i].cost()) {
      ++alike;
      EXPECT_LT(order(near[i - 1]), order(near[i])) << i;
    }
  EXPECT_GT(alike, 100);
  // a distance far from that of the teeth: there, and half way where that is far, too
  GearboxDesign design = pair_design(20, 40, false, 0.05);
  design.module_mm = 2.0;
  std::set<double> distances;
  for (const double off : {1.2, 2.4}) {
    design.centre_distance_mm = 60.0 - off;
    const std::vector<DesignChange> far = common_moves(laid_out(design));
    EXPECT_EQ(far.size(), (off > 2.0 ? 13u : 12u) * 48u);
    expect_from_small_to_large(far);
    for (const DesignChange& move : far)
      distances.insert(std::round(1e6 * move.centre_distance) * 1e-6);
  }
  EXPECT_EQ(distances.count(0.6), 1u);
  EXPECT_EQ(distances.count(1.2), 1u);
  EXPECT_EQ(distances.count(-0.6), 0u);
}

TEST(JointCureMoves, OfShiftsGoUpAndDownByAsMuchAndWider) {
  ASSERT_EQ(shift_moves().size(), 19u);
  ASSERT_EQ(coarse_shift_moves().size(), 11u);
  for (const std::vector<double>& moves : {shift_moves(), coarse_shift_moves()}) {
    EXPECT_EQ(moves[0], 0.0);
    for (std::size_t i = 1; i < moves.size(); i += 2) {
      EXPECT_GT(moves[i], std::abs(moves[i - 1]));
      EXPECT_LE(moves[i], std::abs(moves[i - 1]) + 0.3 + 1e-12);
      EXPECT_EQ(moves[i + 1], -moves[i]);
    }
    EXPECT_EQ(moves.back(), -1.0);
  }
}

/// How many changes of two counts there are with so many steps at most together and three of each.
int pairs_of_steps(int together) {
  int n = 0;
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) n += std::abs(i) + std::abs(k) <= together ? 1 : 0;
  return n;
}

TEST(JointCureMoves, OfTeethAreAllOfThemAtTheirDistanceAndTwoThatAreWider) {
  const std::vector<DesignChange> moves = teeth_moves(laid_out(pair_design(20, 40, false, 0.05)));
  EXPECT_EQ(static_cast<int>(moves.size()), 3 * (pairs_of_steps(6) - 1));
  expect_from_small_to_large(moves);
  std::set<double> wider;
  for (const DesignChange& move : moves) {
    EXPECT_EQ(move.planets, 0);
    wider.insert(move.centre_distance);
  }
  EXPECT_EQ(wider, (std::set<double>{0.0, 0.2, 0.4}));
  // no gear of fewer than five teeth
  GearboxDesign few = pair_design(6, 40, false, 0.05);
  few.gears[0].shift = 0.6;
  int least = 6;
  for (const DesignChange& move : teeth_moves(laid_out(few)))
    least = std::min(least, 6 + move.teeth[0]);
  EXPECT_EQ(least, 5);
  // far from the distance of the teeth each is tried there, too
  GearboxDesign far = pair_design(20, 40, false, 0.05);
  far.centre_distance_mm = 29.4;
  const std::vector<DesignChange> both = teeth_moves(laid_out(far));
  ASSERT_EQ(both.size(), 2 * moves.size());
  for (std::size_t i = 0; i < both.size(); i += 2) {
    EXPECT_EQ(both[i].teeth, both[i + 1].teeth);
    EXPECT_NEAR(both[i + 1].centre_distance, 0.6, 1e-9);
  }
}

TEST(JointCureMoves, TakeAsManyPlanetsAwayAsDoNotFit) {
  const auto planets = [](int of) {
    std::set<int> steps;
    for (const DesignChange& move : teeth_moves(laid_out(simple_design(12, 40, 92, of)))) {
      steps.insert(move.planets);
      int moved = 0;
      for (const int step : move.teeth) {
        EXPECT_LE(std::abs(step), 3);
        moved += std::abs(step);
      }
      EXPECT_LE(moved, 6);
      EXPECT_TRUE(moved > 0 || move.planets != 0);
    }
    return steps;
  };
  // pi / asin(42 / 52) is 3.3: three fit
  EXPECT_EQ(planets(3), (std::set<int>{-1, 0, 1}));
  EXPECT_EQ(planets(4), (std::set<int>{-2, -1, 0, 1}));
  EXPECT_EQ(planets(15), (std::set<int>{-11, -12, -13}));
  EXPECT_EQ(planets(5), (std::set<int>{-2, -1, 0, 1}));
  EXPECT_EQ(planets(2), (std::set<int>{0, 1}));
  for (const DesignChange& move : teeth_moves(laid_out(simple_design(12, 40, 92, 2))))
    EXPECT_EQ(move.centre_distance, 0.0);  // the wider distances are for pairs
}

TEST(JointCureMoves, OfManyGearsAreFewerTeethTogether) {
  const auto most = [](const GearboxDesign& design) {
    int moved = 0;
    for (const DesignChange& move : teeth_moves(laid_out(design))) {
      int sum = 0;
      for (const int step : move.teeth) sum += std::abs(step);
      moved = std::max(moved, sum);
    }
    return moved;
  };
  EXPECT_EQ(most(simple_design(12, 40, 92, 3)), 6);
  EXPECT_EQ(most(paper_design()), 4);
}

TEST(JointCureMoves, PlanetsCollideWhereNoShorterTipClearsThem) {
  EXPECT_FALSE(planets_collide(laid_out(pair_design(20, 40, false, 0.05))));
  // room beside a planet's axis: a sin(pi / n) of a = 29 modules; tips may lose 0.6 modules
  GearboxDesign design = simple_design(18, 40, 98, 4);
  const double room = 29.0 * std::sin(kPi / 4.0);
  for (const double over : {-0.55, 0.55, 0.65}) {
    gear(design, "planet").tip_diameter_mm = 2.0 * (room + over);
    EXPECT_EQ(planets_collide(laid_out(design)), over > 0.6) << over;
  }
}

TEST(FartherDesigns, AreHalfWayToAndAtTheStandardRackAndOfMoreTeeth) {
  GearboxDesign design = pair_design(8, 24, false, 0.05);
  design.rack = {.pressure_angle_rad = rad_from_deg(25.0),
                 .addendum = 0.8,
                 .dedendum = 1.05,
                 .root_radius = 0.2};
  design.centre_distance_mm = 16.25;
  gear(design, "pinion").shift = 0.3;
  gear(design, "wheel").tip_diameter_mm = 25.5;
  const std::vector<GearboxDesign> far = farther_designs(laid_out(design));
  ASSERT_EQ(far.size(), 5u);
  EXPECT_NEAR(deg_from_rad(far[0].rack.pressure_angle_rad), 22.5, 1e-9);
  EXPECT_DOUBLE_EQ(far[0].rack.addendum, 0.9);
  EXPECT_DOUBLE_EQ(far[0].rack.dedendum, 1.15);
  EXPECT_DOUBLE_EQ(far[0].rack.root_radius, 0.29);
  EXPECT_NEAR(deg_from_rad(far[1].rack.pressure_angle_rad), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(far[1].rack.addendum, 1.0);
  const std::vector<std::pair<int, int>> teeth{{9, 27}, {12, 36}, {17, 51}};
  for (std::size_t i = 0; i < 3; ++i) {
    const GearboxDesign& more = far[2 + i];
    EXPECT_EQ(more.gears[0].teeth, teeth[i].first);
    EXPECT_EQ(more.gears[1].teeth, teeth[i].second);
    EXPECT_NEAR(*more.centre_distance_mm, 16.25 + 0.5 * (teeth[i].first + teeth[i].second - 32),
                1e-9);
    EXPECT_EQ(more.rack, design.rack);
  }
  for (const GearboxDesign& any : far) EXPECT_FALSE(any.gears[1].tip_diameter_mm);
  // a pinion that has twelve already
  GearboxDesign twelve = pair_design(12, 24, false, 0.05);
  gear(twelve, "wheel").tip_diameter_mm = 25.5;
  std::set<int> more;
  for (const GearboxDesign& any : farther_designs(laid_out(twelve)))
    if (!any.gears[1].tip_diameter_mm) more.insert(any.gears[0].teeth);
  EXPECT_EQ(more, (std::set<int>{12, 17}));  // 12 with the standard rack
  EXPECT_EQ(farther_designs(laid_out(twelve)).size(), 3u);
}

TEST(FartherDesigns, OfSetsHaveTwiceTheTeethAndNoneWherePlanetsDoNotMesh) {
  const std::vector<GearboxDesign> far = farther_designs(laid_out(simple_design(12, 40, 92, 2)));
  ASSERT_EQ(far.size(), 1u);  // the rack is the standard's
  EXPECT_EQ(far[0].gears[2].teeth, 184);
  EXPECT_TRUE(farther_designs(laid_out(simple_design(13, 30, 73, 4))).empty());
  GearboxDesign cut = pair_design(20, 40, false, 0.05);
  cut.rack.addendum = 0.8;
  cut.rack.protuberance = 0.05;
  EXPECT_TRUE(farther_designs(laid_out(cut)).empty());  // of that tool, and no more teeth than 17
}

Finding failing(const char* id) {
  return {.id = id, .where = "train", .status = CheckStatus::kFail};
}

/// Wants 0.3 mm of backlash, and of the addendum 0.85 at most.
std::optional<Findings> wants(const GearboxDesign& d) {
  Findings findings;
  if (d.backlash_mm < 0.3) findings.push_back(failing("backlash"));
  if (d.rack.addendum > 0.85) findings.push_back(failing("fillet"));
  if (d.planets > 3) findings.push_back(failing("planets"));
  return findings;
}

TEST(NeededChanges, TakeBackWhatIsNotNeededAndMoveNumbersBackAsFarAsEighths) {
  const GearTrain train = laid_out(paper_design(0.1));
  GearboxDesign changed = train.design;
  changed.backlash_mm = 0.5;
  changed.rack.addendum = 0.6;
  changed.rack.root_radius = 0.1;
  changed.centre_distance_mm = 25.9;
  changed.layer_gap_mm += 2.0;
  changed.gears[0].tip_diameter_mm = 13.0;
  changed.gears[2].shift = 0.9;
  changed.gears[4].teeth = 84;
  changed.planets = 2;
  const JudgedDesign needed = with_needed_changes(train, {changed, *wants(changed)}, wants, 200);
  GearboxDesign expected = train.design;
  expected.backlash_mm = 0.3;     // of 0.1 ... 0.5 in eighths, down to what is wanted
  expected.rack.addendum = 0.85;  // of 1 ... 0.6 in eighths: the last that is no more
  EXPECT_EQ(needed.design.backlash_mm, expected.backlash_mm);
  EXPECT_EQ(needed.design.rack.addendum, expected.rack.addendum);
  EXPECT_EQ(needed.design, expected);
  EXPECT_TRUE(needed.findings.empty());
}

TEST(NeededChanges, AskTheJudgeNoMoreThanAllowedAndTakeNoRefusalForAYes) {
  const GearTrain train = laid_out(paper_design(0.1));
  GearboxDesign changed = train.design;
  changed.backlash_mm = 0.5;
  changed.rack.root_radius = 0.1;
  int asked = 0;
  const DesignJudge counted = [&](const GearboxDesign& d) {
    ++asked;
    return wants(d);
  };
  for (const int most : {0, 1, 2, 5}) {
    asked = 0;
    const JudgedDesign needed =
        with_needed_changes(train, {changed, {failing("fillet")}}, counted, most);
    EXPECT_LE(asked, most);
    EXPECT_GE(needed.design.backlash_mm, 0.3);
  }
  const JudgedDesign kept = with_needed_changes(
      train, {changed, {}}, [](const GearboxDesign&) { return std::nullopt; }, 50);
  EXPECT_EQ(kept.design, changed);
}

TEST(NeededChanges, MoveDistancesGapsAndShiftsBackAsFarAsEighths) {
  const GearTrain train = laid_out(paper_design(0.1));
  GearboxDesign changed = train.design;
  const double a = train.centre_distance_mm, x = train.gears[1].shift;
  changed.centre_distance_mm = a + 0.8;
  changed.layer_gap_mm += 1.6;
  changed.gears[1].shift = x - 0.8;
  const DesignJudge wants_half = [&](const GearboxDesign& d) {
    Findings findings;
    if (*d.centre_distance_mm < a + 0.29) findings.push_back(failing("distance"));
    if (d.layer_gap_mm < train.design.layer_gap_mm + 0.5) findings.push_back(failing("gap"));
    if (d.gears[1].shift.value_or(x) > x - 0.35) findings.push_back(failing("shift"));
    return std::optional(findings);
  };
  const JudgedDesign needed = with_needed_changes(train, {changed, {}}, wants_half, 200);
  EXPECT_NEAR(*needed.design.centre_distance_mm, a + 0.3, 1e-4);  // of eighths of 0.8
  EXPECT_NEAR(needed.design.layer_gap_mm, train.design.layer_gap_mm + 0.6, 1e-4);
  EXPECT_NEAR(*needed.design.gears[1].shift, x - 0.4, 1e-4);
}

TEST(NeededChanges, AKeyThatANumberMovedBackFreesIsTakenBackAndWhatThatFrees) {
  const GearTrain train = laid_out(paper_design(0.1));
  GearboxDesign changed = train.design;
  changed.backlash_mm = 0.5;
  changed.rack.addendum = 0.8;
  changed.planets = 2;
  const DesignJudge chain = [&](const GearboxDesign& d) {
    Findings findings;
    if (d.backlash_mm < 0.3) findings.push_back(failing("backlash"));
    if (d.backlash_mm > 0.4 && d.rack.addendum > 0.8) findings.push_back(failing("addendum"));
    if (d.rack.addendum < 1.0 && d.planets > 2) findings.push_back(failing("planets"));
    return std::optional(findings);
  };
  GearboxDesign expected = train.design;
  expected.backlash_mm = 0.3;
  EXPECT_EQ(with_needed_changes(train, {changed, {}}, chain, 200).design, expected);
}

TEST(NeededChanges, TakeBackShiftsThatFitEachOtherTogether) {
  const GearTrain train = laid_out(pair_design(20, 40, false, 0.1));
  GearboxDesign changed = train.design;
  changed.gears[0].shift = 0.2;
  changed.gears[1].shift = -0.2;
  const DesignJudge fit = [](const GearboxDesign& d) {
    Findings findings;
    if (d.gears[0].shift.value_or(0.0) != -d.gears[1].shift.value_or(0.0))
      findings.push_back(failing("shifts"));
    return std::optional(findings);
  };
  EXPECT_EQ(with_needed_changes(train, {changed, {}}, fit, 100).design, train.design);
}

TEST(JointCureFigures, WhereBacklashAloneIsLackingBacklashAloneIsAdded) {
  GearboxDesign design = pair_design(24, 60, false, 0.0);
  design.tips = TipCircles::kClear;
  design.made.tolerance_class = 7;
  const JointCure cure = joint_cure(laid_out(design));
  ASSERT_TRUE(cure.changed && cure.cured()) << cure.conflict;
  EXPECT_GT(cure.design.backlash_mm, 0.0);
  EXPECT_LT(cure.design.backlash_mm, 0.2);
  GearboxDesign expected = design;
  expected.backlash_mm = cure.design.backlash_mm;
  EXPECT_EQ(cure.design, expected);
}

TEST(JointCureFigures, WhatNothingClearsIsNamed) {
  GearboxDesign design = pair_design(24, 60, false, 0.05);
  design.made.clearance_mm = 2.0;  // of teeth of module 1, whose backlash is a module at most
  const JointCure cure =
      joint_cure(laid_out(design), {.most_designs = 30, .most_turned = 6, .farther = false});
  EXPECT_FALSE(cure.cured());
  EXPECT_FALSE(cure.search_ended);
  EXPECT_EQ(cure.conflict, "nothing near this design clears overlap");
}

TEST(ShortenedTips, AtRootsLeaveATenthOfAModule) {
  for (const bool internal : {false, true}) {
    GearboxDesign design = pair_design(20, internal ? 60 : 40, internal, 0.05);
    design.module_mm = 2.0;
    const GearTrain plain = laid_out(design);
    const GearPair pair = plain.pair(plain.meshes[0]);
    // both tips 0.05 mm from the mate's root circle
    const double longer1 = tip_clearance_of_gear1_mm(pair) - 0.05,
                 longer2 = tip_clearance_of_gear2_mm(pair) - 0.05;
    gear(design, "pinion").tip_diameter_mm = 2.0 * (pair.profile1->tip_radius_mm() + longer1);
    gear(design, "wheel").tip_diameter_mm =
        2.0 * (pair.profile2->tip_radius_mm() + (internal ? -longer2 : longer2));
    const GearTrain laid = laid_out(design);
    Judgement judgement{
        .complaints = {{.id = "tip_clearance", .layer = 1, .lacking = 0.1, .fails = true}}};
    DesignChange change;
    EXPECT_TRUE(shorten_at_roots(laid, judgement, change));
    ASSERT_EQ(change.tip_diameter_mm.size(), 2u);
    for (const auto& [i, diameter] : change.tip_diameter_mm)
      design.gears[i].tip_diameter_mm = diameter;
    const GearTrain shortened = laid_out(design);
    const GearPair after = shortened.pair(shortened.meshes[0]);
    for (const double left : {tip_clearance_of_gear1_mm(after), tip_clearance_of_gear2_mm(after)}) {
      EXPECT_GE(left, 0.2);
      EXPECT_LE(left, 0.2 + 0.6e-3);  // diameters are written to a micrometre
    }
    DesignChange none;
    EXPECT_FALSE(shorten_at_roots(laid, {}, none));
    EXPECT_FALSE(shorten_at_roots(shortened, judgement, none)) << "no tip is too long";
    EXPECT_TRUE(none.tip_diameter_mm.empty());
  }
}

TEST(ShortenedTips, AtRootsLoseSixTenthsOfAModuleAtMost) {
  const Judgement judgement{
      .complaints = {{.id = "tip_clearance", .layer = 1, .lacking = 0.1, .fails = true}}};
  for (const double lacking : {0.55, 0.65}) {
    GearboxDesign design = pair_design(100, 120, false, 0.05);
    design.module_mm = 2.0;
    const GearTrain plain = laid_out(design);
    const GearPair pair = plain.pair(plain.meshes[0]);
    const double longer = tip_clearance_of_gear1_mm(pair) - 0.2 + 2.0 * lacking;
    gear(design, "pinion").tip_diameter_mm = 2.0 * (pair.profile1->tip_radius_mm() + longer);
    DesignChange change;
    EXPECT_EQ(shorten_at_roots(laid_out(design), judgement, change), lacking < 0.6) << lacking;
  }
}

TEST(ShortenedTips, OfNeighbouringPlanetsLeaveAFiftiethOfAModuleEach) {
  GearboxDesign design = simple_design(18, 40, 98, 4);
  design.module_mm = 2.0;
  const double room = 58.0 * std::sin(kPi / 4.0);
  gear(design, "planet").tip_diameter_mm = 2.0 * (room + 0.3);
  const Judgement judgement{
      .complaints = {{.id = "planet_spacing", .layer = 1, .lacking = 0.1, .fails = true}}};
  DesignChange change;
  EXPECT_TRUE(shorten_at_roots(laid_out(design), judgement, change));
  ASSERT_EQ(change.tip_diameter_mm.size(), 1u);
  EXPECT_NEAR(change.tip_diameter_mm.at(1), 2.0 * (room - 0.04), 1.1e-3);
  gear(design, "planet").tip_diameter_mm = 2.0 * (room - 0.05);
  DesignChange none;
  EXPECT_FALSE(shorten_at_roots(laid_out(design), judgement, none));
}

TEST(ShortenedTips, ThatAreWrittenAndDigIntoAFilletEndWhereClearOnesDo) {
  GearboxDesign design = pair_design(12, 60, false, 0.05);
  design.tips = TipCircles::kClear;
  gear(design, "pinion").shift = gear(design, "wheel").shift = 0.0;
  const GearTrain open = laid_out(design);
  ASSERT_GT(open.gears[1].tip_shortened_mm, 0.0);
  const double clear_mm = 2.0 * open.gears[1].profile.gear().tip_radius_mm;
  const auto complaint = [](const char* id) {
    return Judgement{.complaints = {{.id = id, .layer = 1, .lacking = 0.1, .fails = true}}};
  };
  const auto shortened = [&](double by_mm, const char* id) {
    gear(design, "wheel").tip_diameter_mm = clear_mm + by_mm;
    DesignChange change;
    const bool any = shorten_given(laid_out(design), complaint(id), change);
    EXPECT_EQ(any, !change.tip_diameter_mm.empty());
    return any ? change.tip_diameter_mm.at(1) : 0.0;
  };
  EXPECT_NEAR(shortened(0.4, "fillet_interference"), clear_mm, 1.1e-3);
  EXPECT_LE(shortened(0.4, "fillet_interference"), clear_mm);
  EXPECT_EQ(shortened(-0.4, "fillet_interference"), 0.0);
  EXPECT_NEAR(shortened(-0.4, "contact_ratio"), clear_mm, 1.1e-3);  // too short: longer
  EXPECT_EQ(shortened(0.4, "contact_ratio"), 0.0);
  EXPECT_EQ(shortened(0.4, "overlap"), 0.0);
  // past a tip that is written and short enough
  gear(design, "pinion").tip_diameter_mm = 2.0 * open.gears[0].profile.gear().tip_radius_mm - 0.1;
  EXPECT_NEAR(shortened(0.4, "fillet_interference"), clear_mm, 1.1e-3);
  gear(design, "pinion").tip_diameter_mm.reset();
  // tips that are not written follow by themselves
  gear(design, "wheel").tip_diameter_mm.reset();
  DesignChange none;
  EXPECT_FALSE(shorten_given(laid_out(design), complaint("fillet_interference"), none));
}

TEST(ShortenedTips, ThatAreWrittenStayWhereClearOnesAreNoShorterThanTheStandards) {
  GearboxDesign design = pair_design(30, 60, false, 0.05);
  design.tips = TipCircles::kClear;
  const GearTrain open = laid_out(design);
  ASSERT_EQ(open.gears[1].tip_shortened_mm, 0.0);
  gear(design, "wheel").tip_diameter_mm = 2.0 * open.gears[1].profile.gear().tip_radius_mm + 0.4;
  const Judgement judgement{
      .complaints = {{.id = "fillet_interference", .layer = 1, .lacking = 0.1, .fails = true}}};
  DesignChange change;
  EXPECT_FALSE(shorten_given(laid_out(design), judgement, change));
}

/// Of a layer: tips that turning shows in the way.
DesignChange in_the_way(const GearTrain& train, int layer) {
  ContactJudge judge;
  int bisected = 0;
  DesignChange change;
  const bool any = shorten_in_the_way(train, layer, judge, bisected, change);
  EXPECT_EQ(any, !change.tip_diameter_mm.empty());
  EXPECT_EQ(any, bisected > 0);
  return change;
}

TEST(ShortenedTips, InTheWayEndWhereTheMeshClears) {
  GearboxDesign design = pair_design(25, 29, true, 0.02);
  const GearTrain train = laid_out(design);
  ContactJudge judge;
  const ContactJudge::Clearances before = judge.clearances(train, train.meshes[0]);
  ASSERT_LT(std::min(before.driving_mm, before.centred_mm), -1e-4);
  const DesignChange change = in_the_way(train, 0);
  ASSERT_EQ(change.tip_diameter_mm.size(), 1u);
  for (const double longer_mm : {0.0, 0.01}) {
    GearboxDesign cured = design;
    for (const auto& [i, diameter] : change.tip_diameter_mm)
      cured.gears[i].tip_diameter_mm = diameter + (i == 0 ? longer_mm : -longer_mm);
    const GearTrain laid = laid_out(cured);
    const ContactJudge::Clearances after = judge.clearances(laid, laid.meshes[0]);
    EXPECT_EQ(std::min(after.driving_mm, after.centred_mm) > -1e-6, longer_mm == 0.0);
  }
  // nothing is in the way of a pair that clears, or of another layer
  EXPECT_TRUE(in_the_way(train, 2).tip_diameter_mm.empty());
  EXPECT_TRUE(in_the_way(laid_out(pair_design(24, 60, false, 0.1)), 0).tip_diameter_mm.empty());
}

TEST(ShortenedTips, InTheWayAreThoseOfTheLayerAlone) {
  GearboxDesign design = paper_design();
  const GearTrain plain = laid_out(design);  // planet1 and ring1 touch with their tips
  for (const char* gear_name : {"planet2", "ring2"})
    gear(design, gear_name).tip_diameter_mm =
        2.0 * plain.find(gear_name)->profile.tip_radius_mm() + (gear_name[0] == 'p' ? 0.7 : -0.7);
  const GearTrain train = laid_out(design);
  const auto gears = [&](int layer) {
    std::set<std::size_t> changed;
    for (const auto& [i, diameter] : in_the_way(train, layer).tip_diameter_mm) changed.insert(i);
    return changed;
  };
  const std::set<std::size_t> first = gears(1), second = gears(2), all = gears(0);
  ASSERT_FALSE(second.empty());
  ASSERT_FALSE(first.empty());
  for (const std::size_t i : first) EXPECT_EQ(train.gears[i].layer, 1);
  for (const std::size_t i : second) EXPECT_EQ(train.gears[i].layer, 2);
  EXPECT_EQ(all.size(), first.size() + second.size());
}

TEST(ShortenedTips, MakeRoomForAClearanceThatIsAskedFor) {
  GearboxDesign design = pair_design(24, 60, false, 0.1);
  gear(design, "pinion").tip_diameter_mm = 2.0 * laid_out(design).gears[0].profile.tip_radius_mm() + 0.36;
  const auto centred = [](const GearboxDesign& d) {
    const GearTrain train = laid_out(d);
    return sweep_clearance_mm(train.pair(train.meshes[0]));
  };
  // less than the flanks have, more than the tip
  const double left = centred(design);
  GearboxDesign shorter = design;
  gear(shorter, "pinion").tip_diameter_mm = *gear(design, "pinion").tip_diameter_mm - 0.5;
  ASSERT_GT(centred(shorter), left + 0.004);
  EXPECT_TRUE(in_the_way(laid_out(design), 0).tip_diameter_mm.empty());
  design.made.clearance_mm = left + 0.002;
  const DesignChange change = in_the_way(laid_out(design), 0);
  ASSERT_EQ(change.tip_diameter_mm.size(), 1u);
  gear(design, "pinion").tip_diameter_mm = change.tip_diameter_mm.at(0);
  EXPECT_NEAR(centred(design), left + 0.002, 1e-3);
  EXPECT_GE(centred(design), left + 0.002 - 1e-6);
}

TEST(InterferenceCure, IsToldWithBothWaysAndOfSetsWithTheRestOfTheLayer) {
  const GearTrain pair = laid_out(pair_design(20, 40, false, 0.05)), set = laid_out(paper_design());
  const auto text = [](const GearTrain& train, bool tips_help, bool shifts_help) {
    const GearPair now = train.pair(train.meshes[0]);
    const double tip = now.profile1->tip_radius_mm(), shift = now.gear1().shift;
    return cure_text(train, train.meshes[0], true, {.exact = [=](const GearPair& p) {
                       const bool shorter = p.profile1->tip_radius_mm() < tip - 0.1;
                       const bool shifted = std::abs(p.gear1().shift - shift) > 0.2;
                       return (tips_help && shorter && !shifted) || (shifts_help && shifted) ? 1.0
                                                                                             : -1.0;
                     }});
  };
  const std::string both = text(pair, true, true);
  EXPECT_EQ(both.find("tip diameter of pinion 21.7"), 0u) << both;
  EXPECT_NE(both.find("(-0.2"), std::string::npos) << both;
  EXPECT_NE(both.find("; or shift of pinion "), std::string::npos) << both;
  EXPECT_EQ(both.find("rest of the layer"), std::string::npos) << both;
  EXPECT_EQ(text(pair, false, true).find("shift of pinion "), 0u);
  EXPECT_NE(text(pair, false, true).find(" (+0.2"), std::string::npos);
  EXPECT_NE(text(set, false, true).find("the rest of the layer alike"), std::string::npos);
  EXPECT_EQ(text(pair, false, false),
            "other tooth counts: neither a shorter tip nor a profile shift within 1 clears it");
}

TEST(InterferenceCure, OfATipIsWhereTheMarginBecomesZero) {
  const GearTrain train = laid_out(pair_design(20, 60, true, 0.05));
  const GearPair pair = train.pair(train.meshes[0]);
  const double tip1 = pair.profile1->tip_radius_mm() - 0.3,
               tip2 = pair.profile2->tip_radius_mm() + 0.2;
  const PairMargin first = [&](const GearPair& p) { return tip1 - p.profile1->tip_radius_mm(); };
  const PairMargin second = [&](const GearPair& p) { return p.profile2->tip_radius_mm() - tip2; };
  const auto radius1 = tip_radius_cure_mm(pair, true, {.exact = first});
  const auto radius2 = tip_radius_cure_mm(pair, false, {.exact = second});
  ASSERT_TRUE(radius1 && radius2);
  EXPECT_LE(*radius1, tip1);
  EXPECT_GE(*radius1, tip1 - 5e-4);
  EXPECT_GE(*radius2, tip2);
  EXPECT_LE(*radius2, tip2 + 5e-4);
  // what just touches is good
  const PairMargin touching = [&](const GearPair& p) { return std::min(first(p), 0.0); };
  const auto touches = tip_radius_cure_mm(pair, true, {.exact = touching});
  ASSERT_TRUE(touches);
  EXPECT_NEAR(*touches, tip1, 5e-4);
  // the bound is told to the good side
  const auto told = [&](bool of_gear1, const PairMargin& margin) {
    const std::string text = cure_text(train, train.meshes[0], of_gear1, {.exact = margin});
    const std::string words = std::string("tip diameter of ") + (of_gear1 ? "pinion " : "wheel ");
    EXPECT_EQ(text.find(words), 0u) << text;
    EXPECT_NE(text.find(of_gear1 ? " mm (-0.6" : " mm (+0.4"), std::string::npos) << text;
    return std::stod(text.substr(words.size()));
  };
  EXPECT_LE(told(true, first), 2.0 * *radius1 + 1e-9);
  EXPECT_GE(told(true, first), 2.0 * *radius1 - 1e-3);
  EXPECT_GE(told(false, second), 2.0 * *radius2 - 1e-9);
  EXPECT_LE(told(false, second), 2.0 * *radius2 + 1e-3);
  const PairMargin never = [](const GearPair&) { return -1.0; };
  EXPECT_FALSE(tip_radius_cure_mm(pair, true, {.exact = never}));
  // what the quick answer finds is taken where the exact one agrees, and sought again where not
  const auto generous = [&](const GearPair& p) { return first(p) + 0.1 >= 0.0; };
  const auto sought = tip_radius_cure_mm(pair, true, {.exact = first, .quick = generous});
  ASSERT_TRUE(sought);
  EXPECT_NEAR(*sought, tip1, 5e-4);
  EXPECT_FALSE(tip_radius_cure_mm(pair, true, {.exact = first, .quick = [](const GearPair&) { return false; }}));
}

TEST(InterferenceCure, OfAShiftIsTheSmallestOfBothDirectionsAndMovesTheLayer) {
  const GearTrain train = laid_out(paper_design());
  const TrainMesh& mesh = train.meshes[1];  // planet1 and ring1
  ASSERT_TRUE(train.pair(mesh).internal());
  const double x1 = train.gears[1].shift, x2 = train.gears[2].shift;
  for (const double wanted : {0.01, 0.03, 0.33, -0.27}) {
    const PairMargin margin = [&](const GearPair& p) {
      const double moved = p.profile1->gear().shift - x1;
      return wanted > 0.0 ? moved - wanted : wanted - moved;
    };
    const auto cure = shift_cure(train, mesh, {.exact = margin});
    ASSERT_TRUE(cure) << wanted;
    EXPECT_NEAR(cure->change, wanted, 1e-3);
    EXPECT_GE(std::abs(cure->change), std::abs(wanted));
    EXPECT_NEAR(cure->shift1, x1 + cure->change, 1e-12);
    EXPECT_NEAR(cure->shift2, x2 + cure->change, 1e-12);
  }
  // seen from the sun: planets and rings up, the sun down
  const PairMargin sun_down = [&](const GearPair& p) {
    return train.gears[0].shift - p.profile1->gear().shift - 0.1;
  };
  const auto cure = shift_cure(train, train.meshes[0], {.exact = sun_down});
  ASSERT_TRUE(cure);
  EXPECT_NEAR(cure->change, -0.1, 1e-3);
  EXPECT_NEAR(cure->shift1, train.gears[0].shift + cure->change, 1e-12);
  EXPECT_NEAR(cure->shift2, x1 - cure->change, 1e-12);
}

}  // namespace
}  // namespace trueflank::test
