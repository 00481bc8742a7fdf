// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <gtest/gtest.h>

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
const std::vector<SearchRecord>& records() {
  static const std::vector<SearchRecord> found =
      run_search(requirements(), sets(), {.threads = 1});
  return found;
}
std::string text_of(const std::vector<SearchRecord>& list) {
  std::string text = journal_header(requirements(), sets()) + "\n";
  for (const SearchRecord& record : list) text += journal_line(record) + "\n";
  return text;
}

TEST(Search, AnyNumberOfThreadsGivesTheSameRecords) {
  ASSERT_GT(sets().sets.size(), 4u);
  ASSERT_EQ(records().size(), sets().sets.size());
  EXPECT_EQ(text_of(run_search(requirements(), sets(), {.threads = 3})), text_of(records()));
}

TEST(Search, PartsPutTogetherAreTheWhole) {
  std::vector<SearchRecord> all;
  for (int part = 1; part <= 3; ++part)
    for (SearchRecord& record :
         run_search(requirements(), sets(), {.threads = 1, .part = {part, 3}}))
      all.push_back(std::move(record));
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
  const auto first = run_search(requirements(), sets(), options);
  ASSERT_LT(first.size(), sets().sets.size());
  ASSERT_GE(first.size(), 4u);
  const auto read = read_journal(text_of(first), requirements(), sets());
  ASSERT_TRUE(read.has_value());
  std::size_t fresh = 0;
  SearchRunOptions again{.threads = 1, .done = *read};
  again.on_record = [&](const SearchRecord&, std::size_t, std::size_t) { ++fresh; };
  EXPECT_EQ(text_of(run_search(requirements(), sets(), again)), text_of(records()));
  EXPECT_EQ(fresh, sets().sets.size() - first.size());
}

TEST(Search, JournalsReadBackBitForBitAndForgiveALineCutShort) {
  const std::string text = text_of(records());
  const auto read = read_journal(text, requirements(), sets());
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(text_of(*read), text);
  const auto cut = read_journal(text.substr(0, text.size() - 5), requirements(), sets());
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->size(), records().size() - 1);
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
  for (const FoundDesign& found : report.designs) any = any || found.tightened > 0.0;
  EXPECT_TRUE(any);
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
  const auto list = run_search(r, sets(), {.threads = 1, .part = {1, 4}});
  const SearchReport report = conclude_search(r, sets(), list, {});
  ASSERT_GE(report.designs.size(), 2u);
  for (const FoundDesign& found : report.designs)
    for (const RankedCandidate& other : report.ranking)
      EXPECT_FALSE(other.candidate.forward > found.candidate.forward &&
                   other.candidate.size_mm < found.candidate.size_mm);
}

}  // namespace
}  // namespace trueflank
