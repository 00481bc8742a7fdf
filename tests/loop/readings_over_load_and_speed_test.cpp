// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// Benches drawn anew whose sensors or logger are at fault over the load or the speed: a bow of the
// output's cell, a gain that changes at a speed, a column that is a row late, coarse steps; and a
// loss at low load, which is no drag beside a loss that takes it back.
namespace trueflank::test {
namespace {

TEST(ReadingsOverLoadAndSpeed, ABowOfTheOutputsSensorIsNoZero) {
  expect_all(12000, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 220);
    const double size =
        bench.noise_output_nm * bench.between(5.0, 8.0) * (seed % 2 == 0 ? 1.0 : -1.0);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                  [&](const DrawnRow& r) {
                                    const double x = r.output_nm / bench.most_output_nm;
                                    return 4.0 * size * x * (1.0 - x);
                                  }));
    answers.add(seed, "bow of " + std::to_string(size), closed,
                leaves_noise(closed, bench) && says(closed, "in a bow over its load") &&
                    is_told_once(closed, "reads_more_nm", size));
  });
}

TEST(ReadingsOverLoadAndSpeed, ALossAtLowLoadIsNoDragThatALossTakesBack) {
  expect_all(12100, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 300);
    const double size = bench.scatter_nm() * bench.between(16.0, 24.0),
                 within = bench.between(0.16, 0.24);
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return size * std::exp(-r.share / within);
    }));
    const bool named =
        closed && std::any_of(closed->result.effects.begin(), closed->result.effects.end(),
                              [](const auto& e) { return e.named; });
    answers.add(seed, "fades within " + std::to_string(within), closed,
                leaves_noise(closed, bench) && !named &&
                    says(closed, "at low load that dies away as the load grows") &&
                    is_told_once(closed, "amplitude_nm", size));
  });
}

TEST(ReadingsOverLoadAndSpeed, AGainThatChangesAtASpeedIsInProportionToTheLoad) {
  expect_all(12200, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 260);
    const double gain = bench.between(0.012, 0.02) * (seed % 2 == 0 ? 1.0 : -1.0),
                 at = bench.between(1100.0, 1900.0);
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                   [&](const DrawnRow& r) { return r.rpm > at ? gain * r.output_nm : 0.0; }));
    answers.add(seed, "gain at " + std::to_string(at), closed,
                leaves_noise(closed, bench) &&
                    is_told_once(closed, "gain_changes_percent", 100.0 * gain) &&
                    is_told_once(closed, "at_rpm", at));
  });
}

TEST(ReadingsOverLoadAndSpeed, ASpeedThatIsLoggedARowLateIsNoDrag) {
  expect_all(12300, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 240);
    const double size = bench.scatter_nm() * bench.between(8.0, 12.0);
    loop::BenchData data = bench.data([&](const DrawnRow& r) { return size * r.rpm / 3000.0; });
    for (std::size_t i = data.rows.size() - 1; i > 0; --i)
      data.rows[i].speed_rpm = data.rows[i - 1].speed_rpm;
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(
        seed, "a row late", closed,
        says(closed, "logged a row late") && is_told_once(closed, "nm_per_rpm", size / 3000.0));
  });
}

TEST(ReadingsOverLoadAndSpeed, StepsAsCoarseAsTheNoiseAreSaid) {
  for (const std::uint64_t seed : {12400U, 12401U}) {
    DrawnBench bench = any_rows(seed, true, 200);
    loop::BenchData data = bench.data([](const DrawnRow&) { return 0.0; });
    const double step = 6.0 * bench.noise_output_nm;
    const auto said = [&] {
      const auto closed = loop::close_drive_loop(bench.model(), data);
      return closed && std::any_of(closed->result.notes.begin(), closed->result.notes.end(),
                                   [](const std::string& note) {
                                     return note.find("output's torque is logged in steps") !=
                                            std::string::npos;
                                   });
    };
    EXPECT_FALSE(said()) << seed;
    for (loop::BenchRow& row : data.rows) row.output_nm = step * std::round(row.output_nm / step);
    EXPECT_TRUE(said()) << seed;
  }
}

// Over loads of which none is low a zero is wrong at all of them. (A guard: of fourteen draws none
// was told otherwise before.)
TEST(ReadingsOverLoadAndSpeed, AZeroBesideAWindageIsAZero) {
  expect_all(12500, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 280);
    std::erase_if(bench.rows, [](const DrawnRow& r) { return r.share < 0.16; });
    const double size = bench.scatter_nm() * bench.between(7.0, 12.0),
                 zero = bench.noise_output_nm * bench.between(5.0, 9.0);
    const auto closed = loop::close_drive_loop(
        bench.model(),
        bench.data([&](const DrawnRow& r) { return size * std::pow(r.rpm / 3000.0, 2.0); }, 0.1,
                   [&](const DrawnRow&) { return zero; }));
    const auto zeros =
        !closed ? 0
                : std::count_if(closed->result.effects.begin(), closed->result.effects.end(),
                                [](const auto& e) { return e.id == "torque_offset"; });
    answers.add(seed, "zero of " + std::to_string(zero), closed,
                zeros == 1 && !says(closed, "under load and not at none"));
  });
}

}  // namespace
}  // namespace trueflank::test
