// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/loop/told_as_one_form.h"

// Logs of thousands of rows, drawn anew: a form is told as of a bench of two hundred rows, what
// only so many rows show is found, and noise is noise.
namespace trueflank::test {
namespace {

TEST(LogsOfBenches, ALossThatEndsAtASpeedIsOneFormWithItsPlace) {
  expect_all(7800, survey_size(1, 6), [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 4000);
    const double at = bench.between(300.0, 900.0),
                 size = bench.scatter_nm() * bench.between(2.0, 4.0);
    closes_as(answers, seed, std::to_string(at), bench,
              [&](const DrawnRow& r) { return r.rpm < at ? size : 0.0; }, {{"amplitude_nm", size}});
  });
}

TEST(LogsOfBenches, AWaveOfAPartOfTheRunIsOneForm) {
  expect_all(7820, survey_size(1, 8), [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 4000);
    bench.with_angle = true;
    if (seed % 2 == 1)
      for (DrawnRow& row : bench.rows) row.input_turns *= 0.02;
    const int order = bench.whole(1, 3), until = bench.whole(1500, 2500);
    const double size = bench.scatter_nm() * bench.between(3.0, 6.0),
                 phase = bench.between(0.0, 6.28);
    closes_as(answers, seed, std::to_string(order) + " until " + std::to_string(until), bench,
              [&](const DrawnRow& r) {
                return r.row < until ? size * std::cos(2.0 * M_PI * order * r.input_turns - phase)
                                     : 0.0;
              },
              {{"amplitude_nm", size}, {"order", order}});
  });
}

// The rows before are not among those on which it is sought.
TEST(LogsOfBenches, AShareOfTheRowBeforeIsOneForm) {
  expect_all(7830, survey_size(1, 4), [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 3000);
    const double share = bench.between(0.04, 0.08);
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([](const DrawnRow&) { return 0.0; }, 0.1, held_of_the_row_before(bench, share)));
    answers.add(
        seed, std::to_string(100.0 * share) + " %", closed,
        leaves_noise(closed, bench) && is_told_once(closed, "share_percent", 100.0 * share));
  });
}

// A tenth of a row's scatter: a thousand rows do not show it.
TEST(LogsOfBenches, ADragThatOnlyManyRowsShowIsFound) {
  expect_all(7840, survey_size(1, 4), [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 20000);
    const double drag = 0.1 * bench.scatter_nm();
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow&) { return drag; }));
    answers.add(seed, std::to_string(drag), closed,
                is_told_once(closed, "torque_nm", drag) && says(closed, "drag_torque"));
  });
}

TEST(LogsOfBenches, OfNoiseNothingIsTold) {
  expect_all(7860, survey_size(2, 8), [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 15000);
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data([](const DrawnRow&) { return 0.0; }));
    answers.add(seed, "nothing", closed,
                closed && closed->result.verdict == loop::Verdict::kNoEffect);
  });
}

}  // namespace
}  // namespace trueflank::test
