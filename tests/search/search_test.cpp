// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <gtest/gtest.h>

#include <random>

#include "trueflank/search/search_corner.h"

namespace trueflank {
namespace {

const SearchRequirements& requirements() {
  static const SearchRequirements r = [] {
    SearchRequirements q;
    q.ratio_min = 90;
    q.ratio_max = 100;
    q.sun = {12, 12};
    q.planet1 = {37, 39};
    q.planet2 = {30, 43};
    q.ring1 = {87, 93};
    q.ring2 = {78, 100};
    q.results = 3;
    return q;
  }();
  return r;
}
const SetEnumeration& sets() {
  static const SetEnumeration found = enumerate_sets(requirements());
  return found;
}
const SearchRecords& records() {
  static const SearchRecords found = run_search(requirements(), sets(), {.threads = 1});
  return found;
}
std::string text_of(const std::vector<SearchRecord>& list) {
  std::string text = journal_header(requirements(), sets()) + "\n";
  for (const SearchRecord& record : list) text += journal_line(record) + "\n";
  return text;
}
std::string text_of(const SearchRecords& list) { return text_of(list.optimised); }

/// The same search with so few listed that most sets are passed over.
SearchRequirements listing(int listed) {
  SearchRequirements r = requirements();
  r.listed = listed;
  return r;
}

TEST(Search, AnyNumberOfThreadsGivesTheSameRecords) {
  ASSERT_GT(sets().sets.size(), 4u);
  ASSERT_EQ(records().optimised.size(), sets().sets.size());
  EXPECT_EQ(text_of(run_search(requirements(), sets(), {.threads = 3})), text_of(records()));
}

TEST(Search, PartsPutTogetherAreTheWhole) {
  std::vector<SearchRecord> all;
  for (int part = 1; part <= 3; ++part)
    for (const SearchRecords found = run_search(requirements(), sets(), {.threads = 1, .part = {part, 3}});
         const SearchRecord& record : found.optimised)
      all.push_back(record);
  EXPECT_EQ(all.size(), sets().sets.size());
  std::sort(all.begin(), all.end(),
            [](const SearchRecord& p, const SearchRecord& q) { return p.index < q.index; });
  EXPECT_EQ(text_of(all), text_of(records()));
}

TEST(Search, StoppedAndResumedItEndsAsIfItHadRunThrough) {
  std::atomic<bool> stop{false};
  SearchRunOptions options{.threads = 2, .stop = &stop};
  options.on_record = [&](const SearchRecord&, std::size_t finished, std::size_t) {
    if (finished >= 4) stop = true;
  };
  const auto first = run_search(requirements(), sets(), options).optimised;
  ASSERT_LT(first.size(), sets().sets.size());
  ASSERT_GE(first.size(), 4u);
  const auto read = read_journal(text_of(first), requirements(), sets());
  ASSERT_TRUE(read.has_value());
  std::size_t fresh = 0;
  SearchRunOptions again{.threads = 1, .done = read->records};
  again.on_record = [&](const SearchRecord&, std::size_t, std::size_t) { ++fresh; };
  EXPECT_EQ(text_of(run_search(requirements(), sets(), again)), text_of(records()));
  EXPECT_EQ(fresh, sets().sets.size() - first.size());
}

TEST(Search, JournalsReadBackBitForBitAndForgiveALineCutShort) {
  const std::string text = text_of(records());
  const auto read = read_journal(text, requirements(), sets());
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(text_of(read->records), text);
  const auto cut = read_journal(text.substr(0, text.size() - 5), requirements(), sets());
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->records.size(), records().optimised.size() - 1);
}

TEST(Search, ThePartsOfAJournalThatHaveEndedAreRead) {
  const std::string text = text_of(records());
  for (const SearchPart part : {SearchPart{1, 1}, SearchPart{2, 3}}) {
    const auto read = read_journal(text + journal_end(part) + "\n", requirements(), sets());
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->ended, std::vector<SearchPart>{part});
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(read->covers(i), part.holds(i));
  }
  std::string damaged = journal_end({2, 3});
  damaged[4] = '1';
  EXPECT_FALSE(read_journal(text + damaged + "\n", requirements(), sets()).has_value());
}

TEST(Search, WhatIsPassedOverChangesNothingOfWhatIsListed) {
  const SearchRecords few = run_search(listing(3), sets(), {.threads = 2});
  ASSERT_EQ(few.optimised.size(), 3u);
  EXPECT_EQ(few.sets(), sets().sets.size());
  EXPECT_EQ(text_of(few), text_of(listed_records(listing(3), records().optimised, sets().sets.size())));
  const SearchReport all = conclude_search(requirements(), sets(), records(), {}),
                     short_list = conclude_search(listing(3), sets(), few, {});
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
  for (const SearchObjective objective : {SearchObjective::kForward, SearchObjective::kBackward}) {
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

TEST(Search, SetsThatAreNotKeptGiveTheSameRecords) {
  EXPECT_EQ(text_of(run_search(listing(3), enumerate_sets(requirements(), 0), {.threads = 2})),
            text_of(run_search(listing(3), sets())));
}

TEST(Search, PartsOfAShortListPutTogetherAreTheWhole) {
  std::vector<SearchRecord> all;
  for (int part = 1; part <= 3; ++part) {
    const SearchRecords found =
        run_search(listing(3), sets(), {.threads = 1, .part = {part, 3}});
    all.insert(all.end(), found.optimised.begin(), found.optimised.end());
  }
  EXPECT_GE(all.size(), 3u);
  EXPECT_EQ(text_of(listed_records(listing(3), all, sets().sets.size())),
            text_of(run_search(listing(3), sets())));
}

TEST(Search, WhereListedDesignsFailAChecksThoseBehindThemAreOptimised) {
  // the first three sets fail what no distance mends: the answer is that of the whole list
  const SearchReport plain = conclude_search(requirements(), sets(), records(), {});
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

TEST(Search, AJournalOfOtherRequirementsOrDamagedIsRefused) {
  SearchRequirements other = requirements();
  other.friction = 0.05;
  EXPECT_EQ(read_journal(text_of(records()), other, sets()).error().code, ErrorCode::kInconsistent);
  const std::string header = journal_header(requirements(), sets()) + "\n";
  for (const char* line : {"x\n", "0 -1 5 1 1.0\n", "999999999 -1 5 0\n", "0 -1 5 0 7\n"})
    EXPECT_EQ(read_journal(header + line, requirements(), sets()).error().code, ErrorCode::kSyntax)
        << line;
  EXPECT_FALSE(read_journal("", requirements(), sets()).has_value());
}

TEST(Search, AJournalWithOneDigitChangedIsRefusedAndTheLineNamed) {
  const std::string text = text_of(records());
  const std::size_t first = text.find('\n') + 1, last = text.size() - 2;
  int changed = 0;
  for (std::size_t at = first; at < last; at += 7) {
    if (text[at] < '0' || text[at] > '9') continue;
    std::string other = text;
    other[at] = static_cast<char>('0' + (text[at] - '0' + 1) % 10);
    const auto read = read_journal(other, requirements(), sets());
    ASSERT_FALSE(read.has_value()) << "character " << at;
    EXPECT_EQ(read.error().code, ErrorCode::kSyntax);
    EXPECT_EQ(read.error().line,
              1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    ++changed;
  }
  EXPECT_GT(changed, 20);
}

TEST(Search, DesignsAreRankedAndEveryClassIsCounted) {
  const SearchReport report = conclude_search(requirements(), sets(), records(), {});
  ASSERT_EQ(report.designs.size(), 3u);
  EXPECT_GE(report.designs[0].candidate.forward, report.designs[1].candidate.forward);
  EXPECT_GE(report.designs[1].candidate.forward, report.designs[2].candidate.forward);
  long long sum = static_cast<long long>(report.feasible);
  for (const SetClass& c : report.classes) sum += c.count;
  EXPECT_EQ(sum, report.considered);
  for (const FoundDesign& found : report.designs) EXPECT_TRUE(lay_out(found.design).has_value());
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
  const SearchReport report = conclude_search(requirements(), sets(), records(), wider);
  ASSERT_FALSE(report.designs.empty());
  SearchRequirements asked = requirements();
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

TEST(Search, ADesignNoDistanceMendsIsCounted) {
  const DesignJudge never = [](const GearTrain&) {
    return DesignVerdict{.failed = {"axial"}, .warned = {}};
  };
  const SearchReport report = conclude_search(requirements(), sets(), records(), never);
  EXPECT_TRUE(report.designs.empty());
  ASSERT_EQ(report.fell_in_checks.size(), 1u);
  EXPECT_EQ(report.fell_in_checks[0].count, static_cast<long long>(report.feasible));
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
