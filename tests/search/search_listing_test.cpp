// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_listing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/survey_size.h"
#include "trueflank/search/search.h"

namespace trueflank {
namespace {

std::string lines_of(const SearchRecords& records) {
  std::string text;
  for (const SearchRecord& record : records.optimised) text += journal_line(record) + "\n";
  return text;
}

TEST(SearchListing, ExcludedIsWhatAsManyOthersBeatInWhateverOrderTheyCome) {
  std::mt19937 random(20261126);
  std::uniform_int_distribution<int> place(0, 9);  // with ties
  for (const std::size_t objectives : {1u, 2u, 3u}) {
    std::vector<std::vector<Merits>> sets(60);
    for (auto& designs : sets)
      for (int i = 0; i < 2; ++i) {
        Merits merits;
        for (std::size_t k = 0; k < objectives; ++k) merits.push_back(place(random));
        designs.push_back(merits);
      }
    for (int order = 0; order < 3; ++order) {
      std::shuffle(sets.begin(), sets.end(), random);
      Listing listing(5);
      for (const auto& designs : sets) listing.add(designs);
      for (const auto& designs : sets)
        for (const Merits& merits : designs) {
          const auto better = std::count_if(sets.begin(), sets.end(), [&](const auto& others) {
            return std::any_of(others.begin(), others.end(),
                               [&](const Merits& m) { return dominates(m, merits); });
          });
          EXPECT_EQ(listing.excludes(merits), better >= 5);
        }
    }
  }
}

TEST(SearchListing, WithSeveralObjectivesOrWeightsTheSameAreListedAsWithoutABound) {
  using enum SearchObjective;
  SearchRequirements r;
  r.ratio_min = 90;
  r.ratio_max = 100;
  r.sun = {12, 12};
  r.planet1 = {39, 39};
  r.planet2 = {test::survey_size(34, 30), 36};
  r.ring1 = {87, 93};
  r.ring2 = {78, 90};
  const SetEnumeration some = enumerate_sets(r);
  r.listed = r.results = 2;
  const std::vector<std::vector<SearchObjective>> rankings{{kForward, kSize}, {kWeighted}, {kSize}};
  for (const std::vector<SearchObjective>& objectives : rankings) {
    r.objectives = objectives;
    r.weights.clear();
    if (objectives.front() == kWeighted)
      r.weights = {{kForward, 1.0}, {kBackward, 0.5}, {kSize, 0.2}};
    const SearchRecords few = run_search(r, some, {.threads = 1});
    SearchRequirements all = r;
    all.listed = 0;
    const SearchRecords every = run_search(all, some, {.threads = 1});
    ASSERT_EQ(every.optimised.size(), some.sets.size());
    EXPECT_GT(few.passed_over, 0u);
    EXPECT_EQ(lines_of(few), lines_of(listed_records(r, every.optimised, some.sets.size())));
    const auto front_of = [&](const SearchRecords& list) {
      std::vector<FreeShifts> front;
      for (const RankedCandidate& c : conclude_search(r, some, list, {}).ranking)
        if (c.on_front) front.push_back(c.candidate.free);
      return front;
    };
    EXPECT_EQ(front_of(few), front_of(every));
  }
}

}  // namespace
}  // namespace trueflank
