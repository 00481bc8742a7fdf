// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// Benches drawn anew with what comes quickly over the rows, starts and dies away, grows ever
// faster, lies otherwise in one file, stops at a torque, or is of one direction alone. Each is told
// as one effect with its size and place.
namespace trueflank::test {
namespace {

TEST(CoursesOfBenches, AWaveOfFewRowsIsNoNoise) {
  expect_all(10400, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 180 + 60 * static_cast<int>(seed % 4));
    const double size = bench.scatter_nm() * bench.between(4.0, 12.0),
                 rows = bench.between(2.4, 9.0), phase = bench.between(0.0, 6.0);
    closes_as(answers, seed, "a wave every " + std::to_string(rows) + " rows", bench,
              [&](const DrawnRow& r) { return size * std::cos(2.0 * M_PI * r.row / rows - phase); },
              {{"amplitude_nm", size}, {"period_rows", rows}});
  });
}

TEST(CoursesOfBenches, AWaveOfFewRowsLeavesTheFrictionBesideIt) {
  expect_all(10500, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 240);
    const double size = bench.scatter_nm() * bench.between(5.0, 9.0),
                 rows = bench.between(3.0, 7.0);
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([&](const DrawnRow& r) { return size * std::sin(2.0 * M_PI * r.row / rows); },
                   0.17));
    const loop::FoundEffect* wave = closed ? with_figure(closed->result, "period_rows") : nullptr;
    answers.add(seed, "a wave every " + std::to_string(rows) + " rows, friction 0.17", closed,
                leaves_noise(closed, bench) && closed->result.effects.size() == 2 && wave &&
                    is_about(*wave, "period_rows", rows, 0.01) &&
                    says(closed, "friction_coefficient"));
  });
}

/// Shares of a loss that starts at rows and is gone to a third after so many.
double since_starts(const std::vector<int>& starts, double rows, int row) {
  double share = 0.0;
  for (const int start : starts)
    if (row >= start) share = std::exp(-(row - start) / rows);
  return share;
}

TEST(CoursesOfBenches, WhatStartsTwiceAndDiesAwayIsNoZeroSetAnew) {
  expect_all(10600, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 260);
    const double size = bench.scatter_nm() * bench.between(6.0, 12.0),
                 rows = bench.between(8.0, 25.0);
    const std::vector<int> starts{bench.whole(30, 90), bench.whole(150, 200)};
    closes_as(answers, seed,
              "starts at rows " + std::to_string(starts[0]) + " and " + std::to_string(starts[1]) +
                  ", dies within " + std::to_string(rows),
              bench, [&](const DrawnRow& r) { return size * since_starts(starts, rows, r.row); },
              {{"amplitude_nm", size},
               {"dies_within_rows", rows},
               {"from_line_1", starts[0] + 2.0},
               {"from_line_2", starts[1] + 2.0}});
  });
}

TEST(CoursesOfBenches, AColdStartMayGoWithTheSpeed) {
  expect_all(10700, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 320);
    const double size = bench.scatter_nm() * bench.between(10.0, 16.0),
                 rows = bench.between(30.0, 60.0);
    closes_as(answers, seed, "by the speed, dies within " + std::to_string(rows), bench,
              [&](const DrawnRow& r) { return size * r.rpm / 2800.0 * std::exp(-r.row / rows); },
              {{"amplitude_nm", size}, {"dies_within_rows", rows}});
  });
}

TEST(CoursesOfBenches, WhatGrowsEverFasterOverTheRunIsNoDrift) {
  expect_all(10800, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 240);
    const double size = bench.scatter_nm() * bench.between(8.0, 14.0),
                 power = bench.between(2.0, 4.0);
    closes_as(answers, seed, "by the power " + std::to_string(power), bench,
              [&](const DrawnRow& r) { return size * std::pow(r.row / 239.0, power); },
              {{"amplitude_nm", size}, {"power", power}});
  });
}

TEST(CoursesOfBenches, AWaveThatLiesOtherwiseInOneFileIsSeen) {
  expect_all(10900, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 240);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(5.0, 10.0),
                 turned = bench.between(0.25, 0.75), phase = bench.between(0.0, 1.0);
    const int order = bench.whole(1, 3);
    const auto closed = loop::close_drive_loop(
        bench.model(), as_days(bench.data([&](const DrawnRow& r) {
          return size * std::cos(2.0 * M_PI *
                                 (order * r.input_turns - phase - (r.row >= 120 ? turned : 0.0)));
        }),
                               2));
    answers.add(
        seed, "order " + std::to_string(order) + ", " + std::to_string(turned), closed,
        leaves_noise(closed, bench) && is_told_once(closed, "amplitude_nm", size) &&
            is_told_once(closed, "turned_deg", 360.0 / order * (turned - std::round(turned))) &&
            says(closed, "in day2.csv"));
  });
}

TEST(CoursesOfBenches, AnOutputThatReadsNoFurtherIsNoLoss) {
  expect_all(11000, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 220);
    bench.noise_input_nm *= 0.2;
    const double cap = bench.most_output_nm * bench.between(0.7, 0.9);
    double most = 0.0;
    for (const DrawnRow& r : bench.rows) most = std::max(most, r.output_nm);
    const double missed_nm = (most - cap) / bench.ratio;  // at the input
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                   [&](const DrawnRow& r) { return std::min(0.0, cap - r.output_nm); }));
    answers.add(seed, "no more than " + std::to_string(cap) + " N m", closed,
                leaves_noise(closed, bench) && is_told_once(closed, "most_it_reads_nm", cap) &&
                    is_about(closed->result.effects.front(), "amplitude_nm", missed_nm, 0.1) &&
                    std::abs(closed->result.effects.front().terms.front().amplitude() - missed_nm) <
                        0.1 * missed_nm);
  });
}

TEST(CoursesOfBenches, ALossOfOneDirectionIsNoFrictionThatAScaleTakesBack) {
  expect_all(11100, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 220);
    // (more than flanks can be, which have the name of a friction that differs between directions)
    const double size = bench.scatter_nm() * bench.between(30.0, 45.0);
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return r.forward ? 0.0 : size * r.share;
    }));
    answers.add(seed, "backward by the load", closed,
                leaves_noise(closed, bench) && is_told_once(closed, "amplitude_nm", size) &&
                    says(closed, "and not while the input drives"));
  });
}

TEST(CoursesOfBenches, AShortLossOfATurnMayGoWithTheLoad) {
  expect_all(11200, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 500);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(10.0, 16.0),
                 centre = bench.between(0.0, 1.0), half = bench.between(0.03, 0.06);
    closes_as(answers, seed, "at " + std::to_string(centre), bench,
              [&](const DrawnRow& r) {
                double off = r.input_turns - centre;
                off -= std::round(off);
                return size * r.share * std::exp2(-off * off / (half * half));
              },
              {{"amplitude_nm", size}, {"at_deg", 360.0 * centre}});
  });
}

TEST(CoursesOfBenches, ALossBySpeedMayGrowWithTheWarmth) {
  expect_all(11300, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 280);
    bench.any_warmth();
    const double size = bench.scatter_nm() * bench.between(10.0, 16.0);
    double least = 1e300, most = -1e300;
    for (const DrawnRow& r : bench.rows) {
      least = std::min(least, r.warm_c);
      most = std::max(most, r.warm_c);
    }
    closes_as(answers, seed, "by the speed times the warmth", bench,
              [&](const DrawnRow& r) {
                return size * r.rpm / 2800.0 * (r.warm_c - least) / (most - least);
              },
              {{"amplitude_nm", size}, {"nothing_at_c", least}});
  });
}

TEST(CoursesOfBenches, FirstRowsWithMoreLossAreNoDragOfTheWholeRun) {
  expect_all(11400, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 180);
    const double size = bench.scatter_nm() * bench.between(6.0, 10.0);
    const int rows = bench.whole(8, 16);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([&](const DrawnRow& r) { return r.row < rows ? size : 0.0; }));
    answers.add(seed, std::to_string(rows) + " rows", closed,
                leaves_noise(closed, bench) && closed->result.effects.size() == 1 &&
                    !closed->result.effects.front().named &&
                    is_about(closed->result.effects.front(), "amplitude_nm", size, 0.25));
  });
}

TEST(CoursesOfBenches, AFileInPoundFeetIsSaidToBe) {
  expect_all(11450, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 160);
    loop::BenchData data = as_days(bench.data([](const DrawnRow&) { return 0.0; }), 2);
    for (loop::BenchRow& row : data.rows)
      if (row.file == 1) row.output_nm *= 0.737562;
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, "day2 in pound-feet", closed,
                says(closed, "in day2.csv") && says(closed, "was it written in pound-feet?"));
  });
}

/// A loss of the fast rows alone, which are one in so many, in a bench of 26.
void adds_fast_rows(Answers& answers, std::uint64_t seed, int every, double least) {
  DrawnBench bench = any_rows(seed, false, 26);
  const double size = bench.scatter_nm() * bench.between(least, 18.0);
  for (DrawnRow& r : bench.rows)
    r.rpm = r.row % every == 0 ? bench.between(1700.0, 2800.0) : bench.between(40.0, 700.0);
  const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
    return size * std::max(0.0, r.rpm - 900.0) / 1900.0;
  }));
  answers.add(seed, "few fast rows", closed,
              closed && closed->result.effects.size() == 1 && says(closed, "speed"));
}

/// (six of 26; their signs alone tell one such bench of 24)
TEST(FewRowsOnBenches, ALossThatFewFastRowsShowIsTold) {
  Answers answers;
  for (std::uint64_t seed = 11500; seed < 11524; ++seed) adds_fast_rows(answers, seed, 5, 12.0);
  EXPECT_GE(answers.right, answers.seldom_fewer(0.95)) << answers.text();
}

/// (the signs of five fast rows show a friction that falls with the speed)
TEST(FewRowsOnBenches, ANameThatLeavesFarMoreGivesWay) {
  Answers answers;
  adds_fast_rows(answers, 11506, 6, 8.0);
  EXPECT_EQ(answers.right, 1) << answers.text();
}

TEST(FewRowsOnBenches, OfNoiseWithLongTailsNothingIsTold) {
  Answers answers;
  for (std::uint64_t seed = 11600; seed < 11700; ++seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 22 + static_cast<int>(seed % 20));
    std::mt19937_64 random(seed);
    std::student_t_distribution<double> tails(3.0);
    std::vector<double> factor;
    for (std::size_t i = 0; i < bench.rows.size(); ++i) factor.push_back(tails(random));
    bench.noise_factor = [factor](const DrawnRow& r) {
      return factor[static_cast<std::size_t>(r.row)];
    };
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data([](const DrawnRow&) { return 0.0; }));
    answers.add(seed, "nothing", closed, closed && closed->result.effects.empty());
  }
  EXPECT_GE(answers.right, answers.runs - 1) << answers.text();
}

TEST(FewRowsOnBenches, RowsThatStandTwiceCountOnce) {
  DrawnBench bench = any_rows(11700, false, 120);
  loop::BenchData once = bench.data([](const DrawnRow&) { return 0.0; }), twice = once;
  for (std::size_t i = 0; i < 60; ++i) {
    twice.rows.push_back(once.rows[2 * i]);
    twice.rows.back().line = 200 + static_cast<int>(i);
  }
  const auto of_once = loop::close_drive_loop(bench.model(), once),
             of_twice = loop::close_drive_loop(bench.model(), twice);
  ASSERT_TRUE(of_once && of_twice);
  EXPECT_EQ(of_twice->result.observations, of_once->result.observations);
  EXPECT_EQ(of_twice->result.after.rms, of_once->result.after.rms);
  const auto& notes = of_twice->result.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("60 rows stand twice to the last digit") != std::string::npos &&
           note.find("line 200 is line 2 again") != std::string::npos;
  }));
}

TEST(FewRowsOnBenches, RowsOfACoarseReadingMayBeAlike) {
  DrawnBench bench = any_rows(11800, false, 120);
  loop::BenchData data = bench.data([](const DrawnRow&) { return 0.0; });
  const double step = 0.05 * bench.most_output_nm;
  for (loop::BenchRow& row : data.rows) {
    row.output_nm = step * std::max(1.0, std::round(row.output_nm / step));
    row.input_nm =
        step / bench.ratio * std::max(1.0, std::round(row.input_nm * bench.ratio / step));
    row.speed_rpm = 1000.0;
  }
  const auto stands_twice = [&](const loop::BenchRow& row) {
    return std::count_if(data.rows.begin(), data.rows.end(), [&](const loop::BenchRow& other) {
             return other.input_nm == row.input_nm && other.output_nm == row.output_nm;
           }) > 1;
  };
  EXPECT_GT(2 * std::count_if(data.rows.begin(), data.rows.end(), stands_twice),
            static_cast<std::ptrdiff_t>(data.rows.size()));
  const auto closed = loop::close_drive_loop(bench.model(), data);
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->result.observations + closed->result.outliers,
            static_cast<int>(data.rows.size()));
}

/// Errors of which each row keeps nine tenths of the one before are noise, whatever wanders as
/// slowly beside them: a temperature, loads and speeds of a log.
TEST(NoiseOfBenches, ErrorsThatHangTogetherFollowNothing) {
  Answers answers;
  for (std::uint64_t seed = 11900; seed < 11912; ++seed) {
    DrawnBench bench = any_rows(seed, false, 400);
    bench.with_temperature = true;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto wander = [&](double kept) {
      std::vector<double> x{normal(random)};
      while (x.size() < bench.rows.size())
        x.push_back(kept * x.back() + std::sqrt(1.0 - kept * kept) * normal(random));
      return x;
    };
    const std::vector<double> error = wander(0.9), warmth = wander(0.98), load = wander(0.94);
    for (DrawnRow& r : bench.rows) {
      const auto at = static_cast<std::size_t>(r.row);
      r.warm_c = 0.1 * std::round(10.0 * (40.0 + 8.0 * warmth[at]));
      r.share = 0.15 + 0.85 * 0.5 * (1.0 + std::erf(load[at] / std::sqrt(2.0)));
      r.output_nm = r.share * bench.most_output_nm;
    }
    const double size = bench.noise_output_nm;
    bench.noise_factor = [](const DrawnRow&) { return 0.05; };
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                  [&](const DrawnRow& r) {
                                    return size * error[static_cast<std::size_t>(r.row)];
                                  }));
    answers.add(seed, "nothing", closed,
                closed && closed->result.effects.empty() && !says(closed, "what is left follows") &&
                    !says(closed, "moves slowly"));
  }
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

}  // namespace
}  // namespace trueflank::test
