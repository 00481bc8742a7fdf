// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// Benches drawn anew with a file that is another than the others, a pit that balls run over, a loss
// that comes and goes over the run, first rows of dwells, and what slow rows leave behind. Each is
// told as one effect with its size and place.
namespace trueflank::test {
namespace {

TEST(WhatComesAgainOnBenches, AFileWithMoreDragThanTheOthersIsNamed) {
  expect_all(9100, 6, [](Answers& answers, std::uint64_t seed) {
    const int days = 2 + static_cast<int>(seed % 3);
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 18 * days);
    const int day = bench.whole(0, days - 1), rows = static_cast<int>(bench.rows.size());
    const double size = bench.scatter_nm() * bench.between(5.0, 14.0);
    const auto closed =
        loop::close_drive_loop(bench.model(), as_days(bench.data([&](const DrawnRow& r) {
                                 return r.row * days / rows == day ? size : 0.0;
                               }),
                                                      days));
    answers.add(seed, "day " + std::to_string(day + 1) + " of " + std::to_string(days), closed,
                leaves_noise(closed, bench) && is_told_once(closed, "amplitude_nm", size) &&
                    is_told_once(closed, "file", day + 1.0) &&
                    closed->result.effects.front().sentence.find(
                        "in day" + std::to_string(day + 1) + ".csv") != std::string::npos);
  });
}

TEST(WhatComesAgainOnBenches, OfFilesThatAreAlikeNothingIsTold) {
  expect_all(9200, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 48);
    const auto closed = loop::close_drive_loop(
        bench.model(), as_days(bench.data([](const DrawnRow&) { return 0.0; }), 2));
    answers.add(seed, "nothing", closed, closed && closed->result.effects.empty());
  });
}

TEST(WhatComesAgainOnBenches, APitThatBallsRunOverHasItsSpacingAndWidth) {
  expect_all(9300, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 420);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(7.0, 14.0),
                 order = bench.whole(1, 5) + bench.between(0.25, 0.75),
                 wide = bench.between(0.1, 0.2), at = bench.between(0.0, 1.0);
    closes_as(answers, seed, "order " + std::to_string(order), bench,
              [&](const DrawnRow& r) {
                const double place = order * r.input_turns - at;
                return place - std::floor(place) < wide ? size : 0.0;
              },
              {{"amplitude_nm", size},
               {"every_deg", 360.0 / order},
               {"width_deg", 360.0 * wide / order}});
  });
}

TEST(WhatComesAgainOnBenches, WavesWhosePeriodGrowsAreOneForm) {
  expect_all(9400, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 320);
    const double size = bench.scatter_nm() * bench.between(7.0, 14.0), n = 320.0,
                 first = bench.between(16.0, 26.0), last = first * bench.between(2.0, 3.2);
    closes_as(answers, seed, std::to_string(first) + " to " + std::to_string(last), bench,
              [&](const DrawnRow& r) {
                const double cycles =
                    n / (last - first) * std::log(1.0 + (last - first) * r.row / (n * first));
                return 0.5 * size * (1.0 + std::cos(2.0 * M_PI * cycles));
              },
              {{"amplitude_nm", size}, {"first_period_rows", first}, {"last_period_rows", last}});
  });
}

TEST(WhatComesAgainOnBenches, ALossThatComesAndGoesWithTheSpeedIsOneForm) {
  expect_all(9500, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 260);
    double most = 0.0;
    for (const DrawnRow& r : bench.rows) most = std::max(most, r.rpm);
    const double size = bench.scatter_nm() * bench.between(7.0, 14.0),
                 period = bench.between(25.0, 70.0), phase = bench.between(0.0, 6.28);
    closes_as(answers, seed, "every " + std::to_string(period), bench,
              [&](const DrawnRow& r) {
                return 0.5 * size * r.rpm / most *
                       (1.0 + std::cos(2.0 * M_PI * r.row / period - phase));
              },
              {{"amplitude_nm", size}, {"period_rows", period}});
  });
}

TEST(WhatComesAgainOnBenches, FirstRowsOfDwellsAreTold) {
  expect_all(9600, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 230);
    std::vector<bool> is_first;
    for (std::size_t i = 0; i < bench.rows.size();) {
      const auto dwell = static_cast<std::size_t>(bench.whole(3, 7));
      for (std::size_t k = 0; k < dwell && i < bench.rows.size(); ++k, ++i) {
        is_first.push_back(k == 0);
        if (k == 0) continue;
        bench.rows[i].forward = bench.rows[i - k].forward;
        bench.rows[i].rpm = bench.rows[i - k].rpm;
        bench.rows[i].output_nm = bench.rows[i - k].output_nm;
      }
    }
    bench.noise_input_nm *= 0.2;
    const double size = bench.scatter_nm() * bench.between(6.0, 14.0);
    closes_as(
        answers, seed, "first rows", bench,
        [&](const DrawnRow& r) { return is_first[static_cast<std::size_t>(r.row)] ? size : 0.0; },
        {{"amplitude_nm", size}});
  });
}

TEST(WhatComesAgainOnBenches, WhatSlowRowsLeaveBehindIsOneForm) {
  expect_all(9700, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 300);
    const double size = bench.scatter_nm() * bench.between(8.0, 16.0),
                 below = bench.between(60.0, 140.0), within = bench.between(3.0, 9.0);
    std::vector<double> left;
    for (const DrawnRow& r : bench.rows)
      left.push_back(r.rpm < below  ? 1.0
                     : left.empty() ? 0.0
                                    : left.back() * std::exp(-1.0 / within));
    closes_as(answers, seed, std::to_string(below) + " rpm, " + std::to_string(within) + " rows",
              bench,
              [&](const DrawnRow& r) { return size * left[static_cast<std::size_t>(r.row)]; },
              {{"amplitude_nm", size}, {"dies_within_rows", within}});
  });
}

}  // namespace
}  // namespace trueflank::test
