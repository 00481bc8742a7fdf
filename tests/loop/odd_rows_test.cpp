// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/odd_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

bool says(const std::vector<std::string>& notes, const std::string& words) {
  return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

loop::InspectionData index_of(const MadeGear& gear, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.6;
  options.seed = seed;
  return inspection_of(gear, {off_centre(5.0, 70.0)}, options);
}

TEST(OddRows, ThatStandTwiceToTheLastDigitCountOnce) {
  auto data = index_of(spur(36), 1);
  const auto rows = data.rows;
  for (const std::size_t k : {3, 9, 20, 41, 41, 57}) data.rows.push_back(rows[k]);
  const auto notes = loop::leave_out_odd_rows(data);
  EXPECT_TRUE(says(notes, "6 rows stand there twice to the last digit"));
  EXPECT_EQ(data.rows.size(), rows.size());
}

TEST(OddRows, AFileThatIsGivenTwiceCountsOnce) {
  std::vector<loop::InspectionData> files{index_of(spur(36), 1), index_of(spur(36), 2)};
  files.push_back(files.front());
  files[0].file = "first.csv";
  files[2].file = "copy.csv";
  const auto notes = loop::leave_out_copies(files);
  EXPECT_TRUE(says(notes, "copy.csv: has the rows of first.csv to the last digit"));
  ASSERT_EQ(files.size(), 2U);
  EXPECT_TRUE(loop::leave_out_copies(files).empty());
  // (another part may be a copy in all but name only by mistake, but it is another part)
  files.push_back(files.front());
  files.back().part = "B";
  EXPECT_TRUE(loop::leave_out_copies(files).empty());
}

TEST(OddRows, OfAnIndexMeasuredAgainAllStay) {
  auto data = index_of(spur(36), 1);
  const auto again = index_of(spur(36), 2);  // (the first teeth are 0 in both)
  data.rows.insert(data.rows.end(), again.rows.begin(), again.rows.end());
  const std::size_t all = data.rows.size();
  EXPECT_TRUE(loop::leave_out_odd_rows(data).empty());
  EXPECT_EQ(data.rows.size(), all);
}

/// Helix traces that carry in the middle, those of two teeth in another unit.
loop::InspectionData helices(double times_smaller, unsigned seed) {
  const MadeGear gear = spur(22);
  InspectionOptions options = traced({1, 4, 9, 12, 18, 19}, 1.0, seed);
  options.profile = false;
  auto data = inspection_of(
      gear,
      {grown([](const MadeGear&, const FlankSpot& s, const Vec3&) { return -6.0 * s.v * s.v; })},
      options);
  for (loop::InspectionRow& row : data.rows)
    if (row.tooth == 9 || row.tooth == 18) row.deviation_um /= times_smaller;
  return data;
}

// A judge's crowning was a third too small, with a bow of its own on every tooth.
TEST(OddRows, TracesOfAnotherUnitAreLeftOutAndSaid) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed)
    for (const double times : {1000.0, 25.4}) {
      const auto result = close(spur(22), helices(times, seed));
      const auto* found = find(result, "crowning");
      ASSERT_NE(found, nullptr) << times << ": " << list(result);
      EXPECT_NEAR(parameter(*found, "amount_um").value, 6.0, 0.4) << list(result);
      EXPECT_TRUE(says(result.notes, "4 helix traces are left out, of tooth 9, 18")) << times;
      EXPECT_TRUE(says(result.notes, times > 100.0 ? "in mm" : "of an inch")) << times;
    }
}

TEST(OddRows, TeethThatAreMeasuredBetterAreNoOtherUnit) {
  for (const double times : {1.0, 3.0, 8.0, 100.0}) {
    auto data = helices(times, 5);
    EXPECT_TRUE(loop::leave_out_odd_rows(data).empty()) << times;
  }
}

}  // namespace
}  // namespace trueflank::test
