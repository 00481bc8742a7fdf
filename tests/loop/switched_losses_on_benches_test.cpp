// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// What is turned on and off by a quantity that was recorded, what a slow sensor still holds of the
// row before, and friction that follows the speed over the load, drawn anew. Each is told as one
// effect with its place and size.
namespace trueflank::test {
namespace {

TEST(SwitchedLossesOnBenches, ABandOfSpeedsIsOneForm) {
  expect_all(8100, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    const auto speed = [](const DrawnRow& r) { return r.rpm; };
    const double from = place_of(bench, bench.between(0.2, 0.4), speed),
                 to = place_of(bench, bench.between(0.55, 0.75), speed),
                 size = bench.scatter_nm() * bench.between(5.0, 12.0);
    closes_as(answers, seed, std::to_string(from) + " to " + std::to_string(to) + " rpm", bench,
              [&](const DrawnRow& r) { return r.rpm > from && r.rpm < to ? size : 0.0; },
              {{"amplitude_nm", size}, {"from_rpm", from}, {"up_to_rpm", to}});
  });
}

TEST(SwitchedLossesOnBenches, EverywhereButInABandOfTemperaturesIsOneForm) {
  expect_all(8200, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    bench.any_warmth();
    const auto warmth = [](const DrawnRow& r) { return r.warm_c; };
    const double below = place_of(bench, bench.between(0.2, 0.4), warmth),
                 above = place_of(bench, bench.between(0.55, 0.75), warmth),
                 size = bench.scatter_nm() * bench.between(6.0, 12.0);
    closes_as(answers, seed, std::to_string(below) + " and " + std::to_string(above) + " C", bench,
              [&](const DrawnRow& r) { return r.warm_c > below && r.warm_c < above ? 0.0 : size; },
              {{"amplitude_nm", size}, {"below_c", below}, {"above_c", above}});
  });
}

/// Temperatures that go up and down over the run.
void warm_up_and_down(DrawnBench& bench, double fewest_rows, double most_rows) {
  bench.with_temperature = true;
  const double middle = bench.between(30.0, 50.0), swing = bench.between(6.0, 12.0),
               rows = bench.between(fewest_rows, most_rows), phase = bench.between(0.0, 6.28);
  for (DrawnRow& row : bench.rows)
    row.warm_c = 0.1 * std::round(10.0 * (middle + bench.between(-0.4, 0.4) +
                                          swing * std::sin(2.0 * M_PI * row.row / rows + phase)));
}

void expect_thermostats(std::uint64_t first_seed, int count, int rows, double fewest_rows,
                        double most_rows) {
  expect_all(first_seed, count, [=](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, rows);
    warm_up_and_down(bench, fewest_rows, most_rows);
    const auto warmth = [](const DrawnRow& r) { return r.warm_c; };
    const double lower = place_of(bench, bench.between(0.25, 0.35), warmth) - 0.05,
                 upper = place_of(bench, bench.between(0.65, 0.8), warmth) + 0.05,
                 size = bench.scatter_nm() * bench.between(5.0, 12.0);
    std::vector<bool> is_on;
    bool on = false;
    for (const DrawnRow& row : bench.rows) {
      on = row.warm_c > upper || (on && row.warm_c >= lower);
      is_on.push_back(on);
    }
    closes_as(
        answers, seed, std::to_string(upper) + " and " + std::to_string(lower) + " C", bench,
        [&](const DrawnRow& r) { return is_on[static_cast<std::size_t>(r.row)] ? size : 0.0; },
        {{"amplitude_nm", size}, {"on_above_c", upper}, {"off_below_c", lower}});
  });
}

TEST(SwitchedLossesOnBenches, AThermostatIsToldWithItsTwoTemperatures) {
  expect_thermostats(8300, 4, 0, 35.0, 55.0);
}

// It goes on and off between the rows on which it is sought.
TEST(SwitchedLossesOnBenches, AThermostatOfALogIsToldWithItsTwoTemperatures) {
  expect_thermostats(8350, survey_size(1, 4), 6000, 10.0, 14.0);
}

TEST(SwitchedLossesOnBenches, AShareOfTheRowBeforeIsOneForm) {
  expect_all(8400, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    const double share = bench.between(0.02, 0.06);
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([](const DrawnRow&) { return 0.0; }, 0.1, held_of_the_row_before(bench, share)));
    answers.add(seed, std::to_string(100.0 * share) + " %", closed,
                leaves_noise(closed, bench) &&
                    is_told_once(closed, "share_percent", 100.0 * share) &&
                    (says(closed, "the output's torque is read before") ||
                     says(closed, "The output's torque is read before")));
  });
}

TEST(SwitchedLossesOnBenches, FrictionBySpeedOverLoadIsOneForm) {
  expect_all(8500, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    const double knee = bench.between(550.0, 1100.0),
                 size = bench.scatter_nm() * bench.between(16.0, 26.0);
    closes_as(answers, seed, std::to_string(knee) + " rpm", bench,
              [&](const DrawnRow& r) {
                return size * r.share / (1.0 + std::pow(r.rpm / (knee * r.share), 2));
              },
              {{"amplitude_nm", size}, {"half_at_rpm_at_largest_load", knee}});
  });
}

}  // namespace
}  // namespace trueflank::test
