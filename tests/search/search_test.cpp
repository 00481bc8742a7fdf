// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <gtest/gtest.h>

#include "tests/search/small_search.h"

namespace trueflank {
namespace {

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

TEST(Search, ADesignNoDistanceMendsIsCounted) {
  const DesignJudge never = [](const GearTrain&) {
    return DesignVerdict{.failed = {"axial"}, .warned = {}};
  };
  const SearchReport report = conclude_search(requirements(), sets(), records(), never);
  EXPECT_TRUE(report.designs.empty());
  ASSERT_EQ(report.fell_in_checks.size(), 1u);
  EXPECT_EQ(report.fell_in_checks[0].count, static_cast<long long>(report.feasible));
}

}  // namespace
}  // namespace trueflank
