// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/base/units.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/cure/shortened_tips.h"
#include "trueflank/check/mesh_clearance.h"

// Tips that end where a mesh clears, and the shifts that do the same, by formulas.
namespace trueflank::test {
namespace {

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

Judgement failing_judgement(const char* id) {
  return {.complaints = {{.id = id, .layer = 1, .lacking = 0.1, .fails = true}}};
}
/// What the wheel's tip becomes where one is written and a check fails; 0: it stays.
double shortened_wheel_mm(GearboxDesign& design, double tip_diameter_mm, const char* id) {
  gear(design, "wheel").tip_diameter_mm = tip_diameter_mm;
  DesignChange change;
  const bool any = shorten_given(laid_out(design), failing_judgement(id), change);
  EXPECT_EQ(any, !change.tip_diameter_mm.empty());
  return any ? change.tip_diameter_mm.at(1) : 0.0;
}

TEST(ShortenedTips, ThatAreWrittenAndDigIntoAFilletEndWhereClearOnesDo) {
  GearboxDesign design = pair_design(12, 60, false, 0.05);
  design.tips = TipCircles::kClear;
  gear(design, "pinion").shift = gear(design, "wheel").shift = 0.0;
  const GearTrain open = laid_out(design);
  ASSERT_GT(open.gears[1].tip_shortened_mm, 0.0);
  const double clear_mm = 2.0 * open.gears[1].profile.gear().tip_radius_mm;
  const auto shortened = [&](double by_mm, const char* id) {
    return shortened_wheel_mm(design, clear_mm + by_mm, id);
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
  EXPECT_FALSE(shorten_given(laid_out(design), failing_judgement("fillet_interference"), none));
}

TEST(ShortenedTips, OfARingThatAreWrittenEndWhereClearOnesDoToo) {
  GearboxDesign design = pair_design(20, 60, true, 0.05);
  design.tips = TipCircles::kClear;
  gear(design, "pinion").shift = gear(design, "wheel").shift = 0.0;
  const GearTrain open = laid_out(design);
  ASSERT_GT(open.gears[1].tip_shortened_mm, 0.0);
  const double clear_mm = 2.0 * open.gears[1].profile.gear().tip_radius_mm;
  const auto shortened = [&](double by_mm, const char* id) {
    return shortened_wheel_mm(design, clear_mm - by_mm, id);
  };
  EXPECT_NEAR(shortened(0.4, "fillet_interference"), clear_mm, 1.1e-3);
  EXPECT_GE(shortened(0.4, "fillet_interference"), clear_mm);
  EXPECT_EQ(shortened(-0.4, "fillet_interference"), 0.0);
  EXPECT_NEAR(shortened(-0.4, "contact_ratio"), clear_mm, 1.1e-3);
  EXPECT_EQ(shortened(0.4, "contact_ratio"), 0.0);
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

TEST(ContactJudge, LooksAtOneLayerAsAtThatLayerOfTheWhole) {
  GearboxDesign design = paper_design(0.0);
  const GearTrain plain = laid_out(design);
  for (const auto& [name, longer] : {std::pair("sun", 0.8), {"planet2", 0.8}, {"ring2", -0.7}})
    gear(design, name).tip_diameter_mm = 2.0 * plain.find(name)->profile.tip_radius_mm() + longer;
  const GearTrain train = laid_out(design);
  ContactJudge judge;
  const auto told = [](const Judgement& judgement, int layer) {
    std::vector<std::pair<std::string, double>> complaints;
    for (const Complaint& c : judgement.complaints)
      if (layer == 0 || c.layer == layer) complaints.emplace_back(c.id, c.lacking);
    return complaints;
  };
  const Judgement whole = ContactJudge::without_turning(train), turned = judge.by_turning(train);
  int layers_with_complaints = 0, layers_turned = 0;
  for (const int layer : {1, 2}) {
    EXPECT_EQ(told(ContactJudge::without_turning(train, layer), 0), told(whole, layer)) << layer;
    EXPECT_EQ(told(judge.by_turning(train, layer), 0), told(turned, layer)) << layer;
    layers_with_complaints += told(whole, layer).empty() ? 0 : 1;
    layers_turned += told(turned, layer).empty() ? 0 : 1;
  }
  EXPECT_EQ(layers_with_complaints, 2);
  EXPECT_EQ(layers_turned, 2);
}

TEST(ContactJudge, ClearancesAreThoseOfTheTurnedTeeth) {
  for (const double asked_mm : {0.0, 0.01})
    for (const auto& [pinion, wheel, ring] :
         {std::tuple{25, 29, true}, {20, 60, true}, {17, 40, false}}) {
      GearboxDesign design = pair_design(pinion, wheel, ring, 0.05);
      if (asked_mm > 0.0) design.made.clearance_mm = asked_mm;
      const GearTrain train = laid_out(design);
      const GearPair pair = train.pair(train.meshes[0]);
      ContactJudge judge;
      const ContactJudge::Clearances& c = judge.clearances(train, train.meshes[0]);
      const double driving_mm = driving_clearance(pair).clearance_mm;
      EXPECT_EQ(c.driving_mm, driving_mm);
      if (driving_mm < 0.0 || asked_mm > 0.0)
        EXPECT_EQ(c.centred_mm, sweep_clearance_mm(pair)) << pinion << ' ' << asked_mm;
      else
        EXPECT_GE(sweep_clearance_mm(pair), c.centred_mm) << pinion;
    }
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
