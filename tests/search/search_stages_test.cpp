// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_stage_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "trueflank/search/search.h"
#include "trueflank/search/search_listing.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

SearchRequirements train_requirements(double ratio_min = 16.0, double ratio_max = 18.5) {
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
    SearchRequirements r = train_requirements();
    r.objectives = {objective};
    const std::vector<double> all = efficiencies_of_all_pairs(r);
    const auto stages = enumerate_sets(r).stages;
    const StageRun run = run_stages(r, stages, {.listed = 3});
    const std::vector<RankedPair> found = best_stage_pairs(r, stages, run.stages, 3);
    ASSERT_GT(all.size(), 3u);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_LT(run.stages.size(), stages.size());  // else nothing was spared
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_DOUBLE_EQ(found[i].whole.merit(objective), all[i]) << i;
  }
}

TEST(SearchStages, AFoundTrainIsLaidOutWithTheRatioAndTheEfficienciesTold) {
  SearchRequirements r = train_requirements();
  r.layer2_module_ratios = {1.25};
  r.figure_limits = {{SearchObjective::kMass, 0.5}};
  const SetEnumeration sets = enumerate_sets(r);
  EXPECT_TRUE(sets.sets.empty());
  const SearchReport report = conclude_search(r, sets, run_search(r, sets), {});
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
  SearchRequirements r = train_requirements(15.5, 21.0);
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

/// Few stages: two first ones, three second ones.
SearchRequirements few() {
  SearchRequirements r = train_requirements(15.0, 20.0);
  r.sun = {17, 18};
  r.planet1 = {18, 18};
  r.ring1 = {54, 55};
  r.planet2 = {19, 20};
  r.ring2 = {56, 57};
  return r;
}

std::string lines_of(const std::vector<SearchRecord>& stages) {
  std::string text;
  for (const SearchRecord& stage : stages) text += journal_stage_line(stage) + "\n";
  return text;
}

TEST(SearchStages, TheFrontOfSeveralObjectivesIsThatOfEveryDesignOfEveryPair) {
  SearchRequirements r = few();
  r.objectives = {SearchObjective::kForward, SearchObjective::kSize};
  r.listed = 1;
  const SetEnumeration sets = enumerate_sets(r);
  std::vector<SetResult> results;
  for (const ToothSet& set : sets.stages) results.push_back(optimise_set_or_stage(r, set));
  std::vector<Merits> all;
  for (std::size_t i = 0; i < results.size(); ++i)
    for (std::size_t j = 0; j < results.size(); ++j)
      if (sets.stages[i].train->stage == 1 && sets.stages[j].train->stage == 2)
        for (const SearchCandidate& p : results[i].candidates)
          for (const SearchCandidate& q : results[j].candidates)
            all.push_back(merits_of(evaluate_stages(r, {{sets.stages[i], sets.stages[j]}, {p, q}}),
                                    r.objectives));
  std::vector<Merits> front, found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(front), [&](const Merits& m) {
    return std::none_of(all.begin(), all.end(), [&](const Merits& o) { return dominates(o, m); });
  });
  r.results = 1;
  const SearchRecords records = run_search(r, sets);
  for (const RankedPair& pair : best_stage_pairs(r, sets.stages, records.stages, 1))
    found.push_back(merits_of(pair.whole, r.objectives));
  std::sort(front.begin(), front.end());
  std::sort(found.begin(), found.end());
  EXPECT_GT(front.size(), 3u);
  EXPECT_EQ(found, front);
}

TEST(SearchStages, ThreadsPartsAndResumedRunsKnowTheSameStages) {
  const SearchRequirements r = few();
  const SetEnumeration sets = enumerate_sets(r);
  const SearchRecords whole = run_search(r, sets, {.threads = 1});
  EXPECT_FALSE(whole.stages_left);
  ASSERT_GT(whole.stages.size(), 3u);
  EXPECT_EQ(lines_of(run_search(r, sets, {.threads = 3}).stages), lines_of(whole.stages));
  const std::vector<SearchRecord> some(whole.stages.begin(), whole.stages.begin() + 2);
  EXPECT_EQ(lines_of(run_search(r, sets, {.threads = 1, .done_stages = some}).stages),
            lines_of(whole.stages));
  std::vector<SearchRecord> parts;
  for (const int part : {1, 2})
    for (const SearchRecords own = run_search(r, sets, {.threads = 1, .part = {part, 2}});
         const SearchRecord& stage : own.stages)
      if (std::none_of(parts.begin(), parts.end(),
                       [&](const SearchRecord& p) { return p.index == stage.index; }))
        parts.push_back(stage);
  std::sort(parts.begin(), parts.end(),
            [](const SearchRecord& p, const SearchRecord& q) { return p.index < q.index; });
  EXPECT_EQ(lines_of(listed_stages(r, sets, parts)), lines_of(whole.stages));
}

TEST(SearchStages, AStoppedRunSaysSoAndItsJournalIsReadBack) {
  SearchRequirements r = few();
  r.listed = 1;  // two stages at a time
  const SetEnumeration sets = enumerate_sets(r);
  std::atomic<bool> stop = false;
  std::string journal = journal_header(r, sets) + "\n";
  SearchRunOptions options{.threads = 1, .stop = &stop};
  options.on_stage = [&](const SearchRecord& stage, std::size_t) {
    journal += journal_stage_line(stage) + "\n";
    stop = true;
  };
  const SearchRecords stopped = run_search(r, sets, options);
  EXPECT_TRUE(stopped.stages_left);
  EXPECT_FALSE(conclude_search(r, sets, stopped, {}).complete());
  const auto read = read_journal(journal, r, sets);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(lines_of(read->stages), lines_of(stopped.stages));
  SearchRequirements fewer = r;
  fewer.ring2 = {57, 57};
  EXPECT_FALSE(read_journal(journal, fewer, enumerate_sets(fewer)).has_value());
}

TEST(SearchStages, BothStagesGetAsWideAndAsLargeAsTheTorqueAsksFor) {
  SearchRequirements r = few();
  r.listed = 1;
  const SetEnumeration sets = enumerate_sets(r);
  const SearchRecords plain = run_search(r, sets);
  const SearchCandidate base = best_stage_pairs(r, sets.stages, plain.stages, 1).front().whole;
  r.face_width_max_mm = 12.0;
  r.module_max_mm = 4.0;
  r.output_torque_nm = 8.0 * base.torque_nm;
  const SearchRecords records = run_search(r, sets);
  const std::vector<RankedPair> found = best_stage_pairs(r, sets.stages, records.stages, 1);
  ASSERT_EQ(found.size(), 1u);
  const auto train = lay_out(design_of_stages(r, found.front().pair));
  ASSERT_TRUE(train.has_value());
  const auto carried = strength(*train, r.strength);
  EXPECT_GE(carried->output_torque_nm, *r.output_torque_nm);
  EXPECT_LE(carried->output_torque_nm, 1.001 * *r.output_torque_nm);
  EXPECT_DOUBLE_EQ(train->stages[1].gears.front().face_width_mm, 12.0);
  EXPECT_GT(found.front().pair.candidates[1].dimensions.module_mm, 1.0);
  EXPECT_GT(train->stages[0].gears.front().face_width_mm, 10.0);
  EXPECT_NEAR(found.front().whole.forward, base.forward, 1e-3);
}

TEST(SearchStages, FiguresThatStagesDoNotMakeAreRefusedAsObjectives) {
  SearchRequirements r = train_requirements();
  r.objectives = {SearchObjective::kMass, SearchObjective::kTorque};
  EXPECT_TRUE(validate(r).empty());
  r.objectives = {SearchObjective::kMass, SearchObjective::kBacklash};
  ASSERT_EQ(validate(r).size(), 1u);
  EXPECT_EQ(validate(r).front().key, "search.objectives");
  EXPECT_EQ(validate(r).front().value, "backlash");
}

}  // namespace
}  // namespace trueflank
