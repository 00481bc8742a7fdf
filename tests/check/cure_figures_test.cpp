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
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/check/cure/joint_cure_moves.h"
#include "trueflank/check/cure/needed_changes.h"
#include "trueflank/check/design_tolerances.h"

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

TEST(DesignChangeFigures, AShiftAloneMovesTheLeadingGearAndNoneLeavesTheDesignAsItIs) {
  GearboxDesign design = paper_design(0.05);
  const GearTrain train = laid_out(design);
  for (const double shift : {0.0, 0.2, -0.15})
    for (const int layer : {1, 2}) {
      const DesignChange change{.shift_of_layer = {{layer, shift}}};
      EXPECT_EQ(change.moves_shifts(), shift != 0.0);
      const GearboxDesign moved = changed_design(train, change, true);
      if (shift == 0.0) {
        GearboxDesign clear = design;
        clear.tips = TipCircles::kClear;
        EXPECT_EQ(moved, clear);
        continue;
      }
      const std::size_t leads = layer == 1 ? 1 : 3;
      for (std::size_t i = 0; i < 5; ++i) {
        ASSERT_EQ(moved.gears[i].shift.has_value(), i == 1 || i == 3) << i;
        if (moved.gears[i].shift) {
          EXPECT_NEAR(*moved.gears[i].shift, train.gears[i].shift + (i == leads ? shift : 0.0),
                      1e-4);
        }
      }
      EXPECT_EQ(moved.centre_distance_mm, design.centre_distance_mm);
    }
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

TEST(JointCureFigures, WhereBacklashAloneIsLackingSoMuchBacklashAloneIsAdded) {
  for (const double module_mm : {1.0, 2.0})
    for (const bool tolerances : {true, false}) {
      GearboxDesign design = pair_design(24, 60, false, 0.0);
      design.module_mm = module_mm;
      design.tips = TipCircles::kClear;
      if (tolerances)
        design.made.tolerance_class = 7;
      else
        design.made.clearance_mm = 0.03;
      const GearTrain train = laid_out(design);
      const double lacking_mm =
          std::max(lacking_backlash_mm(train), lacking_for_clearance_mm(train));
      ASSERT_GT(lacking_mm, 0.02);
      const JointCure cure = joint_cure(train, {.farther = false});
      ASSERT_TRUE(cure.changed && cure.cured()) << cure.conflict;
      EXPECT_GE(cure.design.backlash_mm, lacking_mm);
      EXPECT_LE(cure.design.backlash_mm, lacking_mm + 3e-4);  // as it is written
      GearboxDesign expected = design;
      expected.backlash_mm = cure.design.backlash_mm;
      EXPECT_EQ(cure.design, expected);
    }
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

}  // namespace
}  // namespace trueflank::test
