// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_optimise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/search/one_set.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/search/search_corner.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

SearchRequirements requirements(double shift_limit = 2.0) {
  SearchRequirements r;
  r.clearance_um = 0.0;
  r.ratio_min = 20;
  r.ratio_max = 400;
  r.shift_max = shift_limit;
  r.shift_min = -shift_limit;
  return r;
}

/// The paper's own figures: its formula.
SearchRequirements paper_requirements(double shift_limit = 2.0) {
  SearchRequirements r = requirements(shift_limit);
  r.loss_model = LossModel::kContactRatios;
  return r;
}

TEST(SearchModel, HasTheEfficiencyOfTheLaidOutTrainByEitherModel) {
  for (const LossModel loss : {LossModel::kPathIntegral, LossModel::kContactRatios}) {
    SearchRequirements r = requirements();
    r.loss_model = loss;
    const SearchModel model(r, set_of(r, 12, 39, 90, 32, 81));
    int undercut = 0;
    for (const FreeShifts& free :
         {FreeShifts{25.75, 0.55, 1.6}, {25.7, 0.4, 1.9}, {25.6, 0.3, 1.2}, {25.55, 0.1, 1.2}}) {
      const LayerEvaluation layer1 = model.layer1(free.centre_distance, free.layer1_shift);
      const LayerEvaluation layer2 = model.layer2(free.centre_distance, free.layer2_shift);
      const auto train = lay_out(model.design(free));
      ASSERT_TRUE(train.has_value());
      undercut += train->gears[0].profile.notes().undercut;
      GearboxDesign whole_teeth = train->design;
      whole_teeth.backlash_mm = 0.0;  // the model's teeth
      const EfficiencyResult whole = efficiency(*lay_out(whole_teeth), {.model = loss});
      for (const auto direction : {DriveDirection::kForward, DriveDirection::kBackward})
        EXPECT_NEAR(model.efficiency(layer1, layer2, direction),
                    direction == DriveDirection::kForward ? whole.forward : whole.backward, 1e-9)
            << free.centre_distance;
    }
    EXPECT_GT(undercut, 0);
  }
}

TEST(SearchModel, IsTheLaidOutTrainSeenFromTheOptimiser) {
  SearchRequirements r = requirements();
  r.backlash_mm = 0.0;
  const SearchModel model(r, set_of(r, 12, 39, 90, 32, 81));
  const FreeShifts free{25.75, 0.55, 1.6};
  const LayerEvaluation layer1 = model.layer1(free.centre_distance, free.layer1_shift);
  const LayerEvaluation layer2 = model.layer2(free.centre_distance, free.layer2_shift);
  const auto train = lay_out(model.design(free));
  ASSERT_TRUE(train.has_value());
  double least = 1e9, thinnest = 1e9;
  for (const TrainMesh& mesh : train->meshes) {
    const GearPair pair = train->pair(mesh);
    least = std::min({least, tip_clearance_of_gear1_mm(pair), tip_clearance_of_gear2_mm(pair)});
  }
  for (const TrainGear& gear : train->gears)
    thinnest = std::min(thinnest, gear.profile.tip_thickness_mm());
  double model_least = 1e9, model_thinnest = 1e9;
  for (std::size_t i = 0; i < model.limits(); ++i) {
    const double margin = i < model.train().layer1_limits
                              ? layer1.margins[i]
                              : layer2.margins[i - model.train().layer1_limits];
    if (model.train().limits[i].limit == Limit::kTipClearance)
      model_least = std::min(model_least, margin + r.tip_clearance);
    if (model.train().limits[i].limit == Limit::kTipThickness)
      model_thinnest = std::min(model_thinnest, margin + r.tip_thickness);
  }
  EXPECT_NEAR(model_least, least, 1e-9);
  EXPECT_NEAR(model_thinnest, thinnest, 1e-9);
}

/// Requirements of which a few sets of each kind are left.
SearchRequirements few_of(const std::string& kind) {
  SearchRequirements r = requirements(0.8);
  r.kinds = {kind};
  r.outputs = r.inputs = {"any"};
  r.external_wheels = r.internal_wheels = true;
  r.ratio_min = kind == "3k" ? 30 : kind == "stepped" ? 9 : 5;
  r.ratio_max = r.ratio_min * 1.05;
  r.sun = {14, 15};
  r.planet1 = {18, 44};
  r.planet2 = {18, 20};
  r.wheel = {70, 76};
  return r;
}

TEST(SearchModel, EveryKindsBestDesignIsTheLaidOutTrainWithTheEfficiencyTold) {
  for (const char* kind : {"simple", "stepped", "pair", "3k"}) {
    const SearchRequirements r = few_of(kind);
    std::set<const SearchTrain*> seen;
    for (const ToothSet& set : enumerate_sets(r).sets) {
      if (seen.contains(set.train)) continue;
      const SetResult result = optimise_set(r, set);
      if (result.candidates.empty()) continue;
      seen.insert(set.train);
      const SearchModel model(r, set);
      GearboxDesign design = model.design(result.candidates[0].free);
      const auto with_backlash = lay_out(design);
      ASSERT_TRUE(with_backlash.has_value())
          << kind << ": " << with_backlash.error().front().message;
      design.backlash_mm = 0.0;
      const auto train = lay_out(design);
      ASSERT_TRUE(train.has_value()) << kind;
      const EfficiencyResult exact = efficiency(*train, {.model = LossModel::kPathIntegral});
      EXPECT_NEAR(exact.forward, result.candidates[0].forward, 1e-9)
          << kind << ' ' << set.train->output;
      EXPECT_NEAR(exact.backward, result.candidates[0].backward, 1e-9)
          << kind << ' ' << set.train->output;
      const LayerEvaluation layer1 = model.layer1(result.candidates[0].free.centre_distance,
                                                  result.candidates[0].free.layer1_shift);
      const LayerEvaluation layer2 = model.layer2(result.candidates[0].free.centre_distance,
                                                  result.candidates[0].free.layer2_shift);
      double least = 1e9, model_least = 1e9;
      for (const TrainMesh& mesh : train->meshes) {
        const GearPair pair = train->pair(mesh);
        least = std::min({least, tip_clearance_of_gear1_mm(pair), tip_clearance_of_gear2_mm(pair)});
      }
      const auto& limits = set.train->limits;
      for (std::size_t i = 0; i < limits.size(); ++i)
        if (limits[i].limit == Limit::kTipClearance)
          model_least = std::min(
              model_least, r.tip_clearance + (i < set.train->layer1_limits
                                                  ? layer1.margins[i]
                                                  : layer2.margins[i - set.train->layer1_limits]));
      EXPECT_NEAR(model_least, least, 1e-9) << kind << ' ' << set.train->output;
    }
    EXPECT_GE(seen.size(), 2u) << kind;
  }
}

TEST(SearchModel, TipsAreThickEnoughWithTheBacklashToo) {
  SearchRequirements r = requirements();
  r.backlash_mm = 0.1;
  const SearchModel model(r, set_of(r, 12, 39, 90, 32, 81));
  const FreeShifts free{25.75, 0.55, 1.6};
  const LayerEvaluation layer1 = model.layer1(free.centre_distance, free.layer1_shift);
  const auto train = lay_out(model.design(free));
  ASSERT_TRUE(train.has_value());
  for (std::size_t i = 0; i < model.train().layer1_limits; ++i) {
    if (model.train().limits[i].limit != Limit::kTipThickness) continue;
    const double thickness = train->find(model.train().limits[i].where)->profile.tip_thickness_mm();
    const double model_thickness = layer1.margins[i] + r.tip_thickness;
    EXPECT_LE(model_thickness, thickness + 1e-9) << model.train().limits[i].where;
    EXPECT_GT(model_thickness, thickness - 0.1) << model.train().limits[i].where;
  }
}

TEST(SearchModel, FastEfficiencyEqualsTheBalanceForEveryTrainAndBothDirections) {
  const SearchRequirements r = requirements();
  for (const SearchTrain& kind : search_trains())
    for (const ToothNumbers& z : {ToothNumbers{12, 39, 90, 32, 81}, {12, 36, 87, 41, 91}}) {
      ToothSet set{.train = &kind, .centre_distance_min = 20, .centre_distance_max = 30};
      std::vector<int> teeth;
      for (const TrainPlace place : kind.places()) {
        const auto at = static_cast<std::size_t>(place);
        int* places[] = {&set.sun, &set.planet1, &set.ring1, &set.planet2, &set.ring2};
        *places[at] = z[at];
        teeth.push_back(place == TrainPlace::kRing1 || place == TrainPlace::kRing2 ? -z[at]
                                                                                   : z[at]);
      }
      const SearchModel model(r, set);
      BalanceTrain train = balance_train(kind.topology, teeth);
      for (const double loss : {0.001, 0.01, 0.03}) {
        const MeshLoss a{1 - loss, 1 - 1.1 * loss}, b{1 - 0.3 * loss, 1 - 0.4 * loss},
            c{1 - 0.5 * loss, 1 - 0.6 * loss};
        const LayerEvaluation layer1{.sun_planet = a, .planet_ring = b}, layer2{.planet_ring = c};
        for (std::size_t k = 0; k < kind.topology.meshes.size(); ++k) {
          const auto layer =
              kind.topology.gears[static_cast<std::size_t>(kind.topology.meshes[k].gear1)].layer;
          const bool internal = teeth[static_cast<std::size_t>(kind.topology.meshes[k].gear2)] < 0;
          const MeshLoss& own = layer == 2 ? c : internal ? b : a;
          train.losses[k] = {own.driving1, own.driving2};
        }
        for (const auto direction : {DriveDirection::kForward, DriveDirection::kBackward})
          EXPECT_NEAR(model.efficiency(layer1, layer2, direction),
                      solve_balance(train, direction).efficiency, 1e-12)
              << kind.kind() << ' ' << kind.output << ' ' << kind.input;
      }
    }
}

/// Deepest cut of gear 2's tip corner into gear 1 (external pair or ring tip in planet), by turning
/// both gears through the mesh and looking where the corner is: by position, not by radius.
double swept_corner_clearance(const GearPair& pair) {
  const Gear &g1 = pair.gear1(), &g2 = pair.gear2();
  const double tip = pair.profile2->tip_form_radius_mm(), a = pair.centre_distance_mm;
  const double half = tooth_half_angle_rad(g2, tip);
  double least = 1e9;
  // fine polygon of the root fillet, by angle from the gap's middle
  std::vector<Point2> fillet;
  for (const ProfilePiece& piece : pair.profile1->pieces())
    if (piece.kind == PieceKind::kFillet)
      for (int i = 0; i <= 500; ++i)
        fillet.push_back(point_at(
            piece.curve, piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / 500));
  for (int i = -8000; i <= 8000; ++i) {
    const double turn2 = 1.5 * kTwoPi / g2.teeth * i / 8000;
    Point2 corner;
    double turn1;
    if (pair.internal()) {
      corner = {-a + tip * std::cos(turn2 + half), tip * std::sin(turn2 + half)};
      turn1 = turn2 * g2.teeth / g1.teeth;
    } else {
      corner = {a + tip * std::cos(kPi + turn2 + half), tip * std::sin(kPi + turn2 + half)};
      turn1 = -turn2 * g2.teeth / g1.teeth;
    }
    const double radius = corner.norm();
    const double angle =
        std::abs(std::remainder(std::atan2(corner.y(), corner.x()) - turn1, kTwoPi));
    if (angle > 1.5 * kPi / g1.teeth) continue;
    for (std::size_t k = 0; k + 1 < fillet.size(); ++k) {
      const double r1 = fillet[k].norm(), r2 = fillet[k + 1].norm();
      if ((r1 - radius) * (r2 - radius) > 0.0) continue;
      const Point2 at = fillet[k] + (fillet[k + 1] - fillet[k]) * (radius - r1) / (r2 - r1);
      const double gap = kPi / g1.teeth - std::atan2(at.y(), at.x());
      least = std::min(least, radius * (gap - angle));
    }
  }
  return least;
}

TEST(SearchCorner, IsTheClearanceFoundByTurningTheGears) {
  const SearchRequirements r = requirements();
  const SearchModel model(r, set_of(r, 12, 39, 90, 32, 81));
  for (const FreeShifts& free : {FreeShifts{25.70, 0.48, 2.0}, FreeShifts{25.6, 0.2, 1.0}}) {
    const auto train = lay_out(model.design(free));
    ASSERT_TRUE(train.has_value());
    for (const TrainMesh& mesh : train->meshes) {
      const GearPair pair = train->pair(mesh);
      const double swept = swept_corner_clearance(pair);
      if (swept > 1e8) continue;
      EXPECT_NEAR(corner_clearance_in_gear1_mm(pair), swept, 2e-4) << mesh.name;
    }
  }
}

TEST(SearchCorner, SeesACutBetweenTheEndOfTheFlankAndTheFirstSample) {
  // the ring's tip reaches 0.012 modules below the form circle; by turning the mate in numpy, the
  // root swept by the rack (tests/search/brute_force.py): 0.053 um deep
  const SearchRequirements r = requirements();
  const SearchModel model(r, set_of(r, 16, 28, 71, 21, 66));
  const LayerEvaluation layer2 = model.layer2(21.986516, 0.133407);
  double least = 1.0;
  for (std::size_t i = model.train().layer1_limits; i < model.limits(); ++i)
    if (model.train().limits[i].limit == Limit::kFillet)
      least = std::min(least, layer2.margins[i - model.train().layer1_limits]);
  EXPECT_NEAR(least, -5.27e-5, 2e-7);
}

/// Best of a grid, by exhaustion at each centre distance.
double dense_grid(const SearchRequirements& r, const ToothSet& set, int n) {
  const SearchModel model(r, set);
  double best = -1.0;
  for (int i = 0; i <= n; ++i) {
    const double a =
        set.centre_distance_min + (set.centre_distance_max - set.centre_distance_min) * i / n;
    const auto range1 = model.shift_range(0, a), range2 = model.shift_range(1, a);
    std::optional<LayerEvaluation> layer2;
    for (int k = 0; k <= n; ++k) {
      const auto e = model.layer2(a, range2[0] + (range2[1] - range2[0]) * k / n, 0.0);
      if (e.least_margin >= 5.1e-6 &&
          (!layer2 || e.planet_ring.driving1 > layer2->planet_ring.driving1))
        layer2 = e;
    }
    for (int k = 0; layer2 && k <= n; ++k) {
      const auto e = model.layer1(a, range1[0] + (range1[1] - range1[0]) * k / n, 0.0);
      if (e.least_margin >= 5.1e-6)
        best = std::max(best, model.efficiency(e, *layer2, DriveDirection::kForward));
    }
  }
  return best;
}

TEST(SearchOptimise, ReachesTheBestOfADenseGrid) {
  const SearchRequirements r = requirements();
  int feasible = 0;
  for (const std::vector<int>& z : {std::vector<int>{12, 39, 90, 32, 81},
                                    {11, 46, 103, 38, 95},
                                    {12, 36, 87, 41, 91},
                                    {18, 39, 96, 43, 99},
                                    {15, 42, 105, 37, 101}}) {
    const ToothSet set = set_of(r, z[0], z[1], z[2], z[3], z[4]);
    const SetResult result = optimise_set(r, set);
    const double dense = dense_grid(r, set, 60);
    if (dense > 0.0) {
      ++feasible;
      ASSERT_EQ(result.candidates.size(), 1u) << z[0] << ' ' << z[1];
    }
    if (result.candidates.empty()) continue;
    EXPECT_GE(result.candidates[0].forward, dense - 2e-4) << z[0] << ' ' << z[1];
    EXPECT_GE(result.candidates[0].least_margin, 0.0);
  }
  EXPECT_GE(feasible, 3);
}

TEST(SearchOptimise, PrototypeTeethReachTheKnownOptimumWithoutInterference) {
  // Matsuki et al.: the same teeth uncorrected 68.5 %; known without interference: 90.8 %
  const SearchRequirements r = paper_requirements();
  const SetResult result = optimise_set(r, set_of(r, 12, 39, 90, 32, 81));
  ASSERT_EQ(result.candidates.size(), 1u);
  EXPECT_GT(result.candidates[0].forward, 0.908);
  EXPECT_LT(result.candidates[0].forward, 0.9095);  // the bound without interference limits
}

TEST(SearchOptimise, NarrowShiftBoundsCostEfficiency) {
  const SearchRequirements wide = paper_requirements(2.0), narrow = paper_requirements(0.9);
  const auto at = [](const SearchRequirements& r) {
    return optimise_set(r, set_of(r, 12, 39, 90, 32, 81)).candidates.at(0).forward;
  };
  EXPECT_GT(at(wide), at(narrow) + 0.01);
}

TEST(SearchOptimise, ThePathIntegralFindsWhatTheFormulaCannotSee) {
  const SearchRequirements paper = paper_requirements(), r = requirements();
  const ToothSet set = set_of(r, 12, 39, 90, 32, 81);
  const SetResult by_formula = optimise_set(paper, set), by_path = optimise_set(r, set);
  ASSERT_EQ(by_formula.candidates.size(), 1u);
  ASSERT_EQ(by_path.candidates.size(), 1u);
  const auto train = lay_out(SearchModel(r, set).design(by_formula.candidates[0].free));
  ASSERT_TRUE(train.has_value());
  EXPECT_GE(by_path.candidates[0].forward, efficiency(*train).forward - 1e-4);
}

TEST(SearchOptimise, TheClearanceThatIsAskedForIsKept) {
  SearchRequirements r = requirements();
  r.clearance_um = 5.0;
  const ToothSet set = set_of(r, 12, 39, 90, 32, 81);
  const SetResult result = optimise_set(r, set);
  ASSERT_EQ(result.candidates.size(), 1u);
  GearboxDesign design = SearchModel(r, set).design(result.candidates[0].free);
  EXPECT_NEAR(design.backlash_mm, 0.04, 1e-12);
  design.backlash_mm = 0.0;
  const auto train = lay_out(design);
  ASSERT_TRUE(train.has_value());
  for (const TrainMesh& mesh : train->meshes) {
    const GearPair pair = train->pair(mesh);
    EXPECT_GE(corner_clearance_in_gear1_mm(pair), 0.005 - 1e-6) << mesh.name;
    EXPECT_GE(corner_clearance_in_gear2_mm(pair), 0.005 - 1e-6) << mesh.name;
  }
}

TEST(SearchOptimise, ATorqueThatIsAskedForIsKeptOrNamed) {
  SearchRequirements r = requirements();
  const ToothSet set = set_of(r, 12, 39, 90, 32, 81);
  const double free = optimise_set(r, set).candidates.at(0).torque_nm;
  r.output_torque_nm = free * 1.005;
  const SetResult bound = optimise_set(r, set);
  ASSERT_EQ(bound.candidates.size(), 1u);
  EXPECT_GE(bound.candidates[0].torque_nm, *r.output_torque_nm * (1 - 1e-9));
  r.output_torque_nm = free * 10;
  const SetResult none = optimise_set(r, set);
  EXPECT_TRUE(none.candidates.empty());
  EXPECT_EQ(none.failed_limit, static_cast<int>(kLimits));
}

TEST(SearchOptimise, SeveralObjectivesGiveTheirOptimaAndCompromises) {
  SearchRequirements r = requirements();
  r.objectives = {SearchObjective::kForward, SearchObjective::kTorque};
  const auto candidates = optimise_set(r, set_of(r, 12, 39, 90, 32, 81)).candidates;
  ASSERT_GE(candidates.size(), 3u);
  EXPECT_GT(candidates[1].torque_nm, candidates[0].torque_nm);
  for (const SearchCandidate& c : candidates) {
    EXPECT_LE(c.forward, candidates[0].forward + 1e-6);
    EXPECT_GE(c.least_margin, 0.0);
  }
}

TEST(SearchOptimise, AnOuterDiameterFixesTheModule) {
  SearchRequirements r = requirements();
  r.outer_diameter_mm = 60.0;
  const ToothSet set = set_of(r, 12, 39, 90, 32, 81);
  const SetResult result = optimise_set(r, set);
  ASSERT_EQ(result.candidates.size(), 1u);
  EXPECT_NEAR(result.candidates[0].size_mm, 60.0, 1e-9);
  const GearboxDesign design = SearchModel(r, set).design(result.candidates[0].free);
  EXPECT_NEAR(std::max(*design.gears[2].outer_diameter_mm, *design.gears[4].outer_diameter_mm),
              60.0, 1e-9);
}

}  // namespace
}  // namespace trueflank
