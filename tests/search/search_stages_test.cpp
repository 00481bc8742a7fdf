// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "trueflank/search/search.h"
#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

SearchRequirements requirements(double ratio_min = 16.0, double ratio_max = 18.5) {
  SearchRequirements r;
  r.kinds = {"two-stage"};
  r.ratio_min = ratio_min;
  r.ratio_max = ratio_max;
  r.sun = {17, 18};
  r.planet1 = {18, 19};
  r.ring1 = {54, 55};
  r.planet2 = {19, 20};
  r.ring2 = {55, 57};
  r.results = 1;
  r.listed = 4;
  return r;
}

/// Every pair of sets, each optimised: what bounds and order can hide is not hidden here.
std::vector<double> efficiencies_of_all_pairs(const SearchRequirements& r) {
  std::vector<std::pair<double, double>> stages[2];  // ratio, efficiency
  for (const ToothSet& set : enumerate_sets(r).stages)
    if (const SetResult result = optimise_set_or_stage(r, set); !result.candidates.empty())
      stages[set.train->stage - 1].emplace_back(signed_ratio(set),
                                                result.candidates[0].merit(r.objectives.front()));
  std::vector<double> all;
  for (const auto& [ratio1, efficiency1] : stages[0])
    for (const auto& [ratio2, efficiency2] : stages[1])
      if (ratio1 * ratio2 >= r.ratio_min && ratio1 * ratio2 <= r.ratio_max)
        all.push_back(efficiency1 * efficiency2);
  std::sort(all.rbegin(), all.rend());
  return all;
}

TEST(SearchStages, TheBestPairsAreThoseOfAllPairsInEitherDirection) {
  for (const SearchObjective objective : {SearchObjective::kForward, SearchObjective::kBackward}) {
    SearchRequirements r = requirements();
    r.objectives = {objective};
    const std::vector<double> all = efficiencies_of_all_pairs(r);
    const auto stages = enumerate_sets(r).stages;
    const StagePairs found = best_stage_pairs(r, stages, 3);
    ASSERT_GT(all.size(), 3u);
    ASSERT_EQ(found.best.size(), 3u);
    EXPECT_LT(found.optimised, stages.size());  // else nothing was spared
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_DOUBLE_EQ(found.best[i].whole.merit(objective), all[i]) << i;
  }
}

TEST(SearchStages, AFoundTrainIsLaidOutWithTheRatioAndTheEfficienciesTold) {
  SearchRequirements r = requirements();
  r.layer2_module_ratios = {1.25};
  r.figure_limits = {{SearchObjective::kMass, 0.5}};
  const SetEnumeration sets = enumerate_sets(r);
  EXPECT_TRUE(sets.sets.empty());
  const SearchReport report = conclude_search(r, sets, {}, {});
  ASSERT_FALSE(report.designs.empty());
  for (const FoundDesign& found : report.designs) {
    ASSERT_TRUE(found.stages.has_value());
    const auto train = lay_out(found.design);
    ASSERT_TRUE(train.has_value());
    EXPECT_EQ(train->stages.size(), 2u);
    EXPECT_NEAR(1.0 / train->speeds.output, signed_ratio(*found.stages), 1e-9);
    EXPECT_GE(signed_ratio(*found.stages), r.ratio_min);
    EXPECT_LE(signed_ratio(*found.stages), r.ratio_max);
    const EfficiencyResult exact = efficiency(*train);
    EXPECT_NEAR(found.candidate.forward, exact.forward, 1e-9);
    EXPECT_NEAR(found.candidate.backward, exact.backward, 1e-9);
    EXPECT_DOUBLE_EQ(found.design.later_stages.at(0).module_mm.value(), 1.25);
    EXPECT_LE(found.candidate.figures.mass_kg, 0.5);
    EXPECT_GE(found.certified_bound, found.candidate.forward - 1e-12);
    EXPECT_LE(found.certified_gap, 1e-3);
  }
}

TEST(SearchStages, OtherKindsAreRankedTogetherWithThem) {
  SearchRequirements r = requirements(15.5, 21.0);
  r.kinds = {"3k", "two-stage"};
  r.identical_planets = false;
  r.sun = r.planet1 = {18, 18};
  r.ring1 = {54, 54};
  r.planet2 = {14, 18};
  r.ring2 = {52, 54};
  r.results = r.listed = 20;
  const SetEnumeration sets = enumerate_sets(r);
  const SearchReport report = conclude_search(r, sets, run_search(r, sets), {});
  std::set<std::string> kinds;
  for (const FoundDesign& found : report.designs) kinds.insert(found.set.train->kind());
  EXPECT_EQ(kinds, (std::set<std::string>{"3k", "two-stage"}));
  EXPECT_TRUE(std::is_sorted(report.designs.begin(), report.designs.end(),
                             [](const FoundDesign& p, const FoundDesign& q) {
                               return p.candidate.forward > q.candidate.forward;
                             }));
}

TEST(SearchStages, ObjectivesThatStagesDoNotShareAreRefused) {
  SearchRequirements r = requirements();
  EXPECT_TRUE(validate(r).empty());
  r.objectives = {SearchObjective::kMass};
  ASSERT_EQ(validate(r).size(), 1u);
  EXPECT_EQ(validate(r).front().key, "search.objectives");
}

}  // namespace
}  // namespace trueflank
