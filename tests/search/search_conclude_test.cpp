// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "tests/search/small_search.h"
#include "tests/support/survey_size.h"
#include "trueflank/search/search.h"
#include "trueflank/search/search_corner.h"

namespace trueflank {
namespace {

TEST(Search, WhatIsPassedOverChangesNothingOfWhatIsListed) {
  const SearchRecords few = run_search(listing(3), sets(), {.threads = 2});
  ASSERT_EQ(few.optimised.size(), 3u);
  EXPECT_EQ(few.sets(), sets().sets.size());
  EXPECT_EQ(text_of(few),
            text_of(listed_records(listing(3), records().optimised, sets().sets.size())));
  const SearchReport &all = report(), short_list = conclude_search(listing(3), sets(), few, {});
  ASSERT_EQ(short_list.designs.size(), all.designs.size());
  for (std::size_t i = 0; i < all.designs.size(); ++i)
    EXPECT_EQ(short_list.designs[i].candidate.free, all.designs[i].candidate.free);
  long long sum = static_cast<long long>(short_list.feasible);
  for (const SetClass& c : short_list.classes) sum += c.count;
  EXPECT_EQ(sum, short_list.considered);
}

TEST(Search, WithTheLossesOfADriveTheSameAreListedAsWithoutABound) {
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const SearchObjective objective :
       test::survey_of(1, {SearchObjective::kForward, SearchObjective::kBackward})) {
    SearchRequirements r = requirements();
    r.objectives = {objective};
    r.losses = LossesDesign{};
    r.losses->load_nm = 0.5 + 10.0 * share(random);
    r.losses->drag_torque_nm = 0.02 * share(random);
    r.losses->load_friction = 0.05 * share(random);
    r.losses->bearing_load_share = 0.03 * share(random);
    r.listed = r.results = 2;
    const SearchRecords few = run_search(r, sets(), {.threads = 1});
    SearchRequirements all = r;
    all.listed = 0;
    const SearchRecords every = run_search(all, sets(), {.threads = 1});
    ASSERT_EQ(every.optimised.size(), sets().sets.size());
    EXPECT_EQ(few.optimised.size(), 2u);
    EXPECT_EQ(text_of(few), text_of(listed_records(r, every.optimised, sets().sets.size())));
  }
}

TEST(Search, WhereListedDesignsFailAChecksThoseBehindThemAreOptimised) {
  // the first three sets fail what no distance mends: the answer is that of the whole list
  const SearchReport& plain = report();
  const auto judge = [&](const GearTrain& train) {
    DesignVerdict verdict;
    for (const FoundDesign& found : plain.designs)
      if (found.design.centre_distance_mm == train.centre_distance_mm)
        verdict.failed.push_back("axial");
    return verdict;
  };
  const SearchReport all = conclude_search(requirements(), sets(), records(), judge);
  const SearchReport short_list =
      conclude_search(listing(3), sets(), run_search(listing(3), sets()), judge);
  ASSERT_EQ(short_list.designs.size(), all.designs.size());
  ASSERT_FALSE(all.designs.empty());
  for (std::size_t i = 0; i < all.designs.size(); ++i)
    EXPECT_EQ(short_list.designs[i].candidate.free, all.designs[i].candidate.free);
}

TEST(Search, DesignsAreRankedAndEveryClassIsCounted) {
  const SearchReport& ranked = report();
  ASSERT_EQ(ranked.designs.size(), 3u);
  EXPECT_GE(ranked.designs[0].candidate.forward, ranked.designs[1].candidate.forward);
  EXPECT_GE(ranked.designs[1].candidate.forward, ranked.designs[2].candidate.forward);
  long long sum = static_cast<long long>(ranked.feasible);
  for (const SetClass& c : ranked.classes) sum += c.count;
  EXPECT_EQ(sum, ranked.considered);
  for (const FoundDesign& found : ranked.designs) EXPECT_TRUE(lay_out(found.design).has_value());
}

TEST(Search, ADesignThatFailsACheckIsTightenedUntilItPasses) {
  int asked = 0;
  const DesignJudge strict = [&](const GearTrain&) {
    DesignVerdict verdict;
    if (++asked <= 2) verdict.failed.push_back("overlap");
    return verdict;
  };
  const SearchReport report = conclude_search(requirements(), sets(), records(), strict);
  ASSERT_FALSE(report.designs.empty());
  bool any = false;
  for (const FoundDesign& found : report.designs) any = any || found.tightened() > 0.0;
  EXPECT_TRUE(any);
}

TEST(Search, ADesignThatFailsACheckIsMovedToTheBorderOfTheCheckAndNoFarther) {
  // a check that asks for 2.3 um where the search keeps 2
  const DesignJudge wider = [](const GearTrain& train) {
    GearboxDesign design = train.design;
    design.backlash_mm = 0.0;
    const auto tight = lay_out(design);
    DesignVerdict verdict;
    for (const TrainMesh& mesh : tight->meshes) {
      const GearPair pair = tight->pair(mesh);
      if (std::min(corner_clearance_in_gear1_mm(pair), corner_clearance_in_gear2_mm(pair)) < 0.0023)
        verdict.failed.emplace_back("fillet_interference");
    }
    return verdict;
  };
  SearchRequirements asked = requirements();  // of a set that stands on the limit of a corner
  asked.planet1 = {39, 39};
  asked.ring1 = {90, 90};
  asked.planet2 = {32, 32};
  asked.ring2 = {81, 81};
  const SetEnumeration one = enumerate_sets(asked);
  const SearchReport report = conclude_search(asked, one, run_search(asked, one), wider);
  ASSERT_FALSE(report.designs.empty());
  asked.clearance_um = 2.3;
  int moved = 0;
  for (const FoundDesign& found : report.designs) {
    if (found.tightened() == 0.0) continue;
    const SetResult best = optimise_set(asked, found.set);
    ASSERT_FALSE(best.candidates.empty());
    EXPECT_GE(found.candidate.forward, best.candidates[0].forward - 1e-5);
    ++moved;
  }
  EXPECT_GE(moved, 1);
}

TEST(Search, NoDesignOfAParetoFrontIsDominated) {
  SearchRequirements r = requirements();
  r.objectives = {SearchObjective::kForward, SearchObjective::kSize};
  r.results = 100;
  const SearchRecords list = run_search(r, sets(), {.threads = 1, .part = {1, 4}});
  const SearchReport report = conclude_search(r, sets(), list, {});
  ASSERT_GE(report.designs.size(), 2u);
  for (const FoundDesign& found : report.designs)
    for (const RankedCandidate& other : report.ranking)
      EXPECT_FALSE(other.candidate.forward > found.candidate.forward &&
                   other.candidate.size_mm < found.candidate.size_mm);
}

}  // namespace
}  // namespace trueflank
