// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drive_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace trueflank::loop {
namespace {

/// 6 speeds, 5 loads, both directions, 4 times each; `left` of the torque at the input stays after
/// the fit.
template <class Left>
DriveLoop bench(unsigned seed, const Left& left) {
  DriveLoop closed;
  closed.model.ratio = 50.0;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (const bool forward : {true, false})
    for (const double speed : {50.0, 100.0, 200.0, 400.0, 800.0, 1500.0})
      for (const double load : {0.1, 0.3, 0.5, 0.8, 1.0})
        for (int again = 0; again < 4; ++again) {
          BenchPoint p;
          p.forward = forward;
          p.speed_rpm = speed;
          p.load_nm = load;
          p.driving_nm = forward ? load : 50.0 * load;
          p.driven_nm = 0.9 * (forward ? 50.0 * load : load);
          closed.table.points.push_back(p);
          const double after = (left(p) + noise(random)) * (forward ? 50.0 : 1.0);
          closed.after_nm.push_back(after);
          closed.before_nm.push_back(after - (forward ? 50.0 : 1.0) * 0.02);
        }
  return closed;
}

TEST(BenchPage, TellsThatWhatIsLeftFollowsTheSpeedAndNothingElse) {
  const auto sentences = residual_trends(
      bench(1, [](const BenchPoint& p) { return p.speed_rpm < 150.0 ? -0.012 : 0.006; }));
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_THAT(sentences[0], testing::HasSubstr("input speed"));
  EXPECT_THAT(sentences[0], testing::ContainsRegex("-0[.]01[0-9]* N m at (50|100) rpm"));
}

TEST(BenchPage, IsSilentWhereOnlyNoiseIsLeft) {
  for (unsigned seed = 1; seed <= 200; ++seed)
    EXPECT_TRUE(residual_trends(bench(seed, [](const BenchPoint&) { return 0.0; })).empty())
        << seed;
  // noise that grows with the load is noise too
  std::mt19937 random(7);
  std::normal_distribution<double> more(0.0, 0.04);
  for (unsigned seed = 1; seed <= 200; ++seed)
    EXPECT_TRUE(
        residual_trends(bench(seed, [&](const BenchPoint& p) { return p.load_nm * more(random); }))
            .empty())
        << seed;
}

TEST(BenchPage, ChartsEveryPointBeforeAndAfter) {
  const DriveLoop closed = bench(1, [](const BenchPoint&) { return 0.0; });
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      ++n;
    return n;
  };
  const std::string residuals = residual_charts(closed), torques = torque_charts(closed);
  const std::size_t points = closed.table.points.size();
  for (const char* kind : {"<circle class='a'", "<circle class='w'"}) {
    EXPECT_EQ(count(residuals, kind),
              2 * points);  // over load and over speed; nothing else was measured
    EXPECT_EQ(count(torques, kind), points);
  }
  EXPECT_EQ(count(residuals, "class='am'"), 2u);
}

}  // namespace
}  // namespace trueflank::loop
