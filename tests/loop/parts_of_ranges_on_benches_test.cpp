// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// What a part of the loads, speeds, temperatures, directions or the run alone has, drawn anew:
// waves that turn over or end at a place, losses that come in between two places, a bow over the
// run. Each is told as one effect with its place and size, and beside it no name that stands for a
// part of it.
namespace trueflank::test {
namespace {

/// A wave over the turns of the input, of a drawn order, size (in scatters of a row) and phase.
struct DrawnWave {
  int order = 0;
  double size = 0.0, phase = 0.0;

  DrawnWave(DrawnBench& bench, std::pair<int, int> orders, std::pair<double, double> sizes)
      : order(bench.whole(orders.first, orders.second)),
        size(bench.scatter_nm() * bench.between(sizes.first, sizes.second)),
        phase(bench.between(0.0, 6.28)) {}
  [[nodiscard]] double at(const DrawnRow& r) const {
    return size * std::cos(2.0 * M_PI * order * r.input_turns - phase);
  }
  /// The wave, and at which place of the range it changes.
  [[nodiscard]] std::string text(double place = NAN) const {
    return "order " + std::to_string(order) +
           (std::isnan(place) ? "" : " at " + std::to_string(place));
  }
};

DrawnBench turning(std::uint64_t seed, bool both) {
  DrawnBench bench = any_rows(seed, both);
  bench.with_angle = true;
  return bench;
}

TEST(PartsOfRangesOnBenches, AWaveThatTurnsOverAtASpeedIsOneForm) {
  expect_all(7100, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = turning(seed, seed % 2 == 0);
    const DrawnWave wave(bench, {1, 3}, {5.0, 9.0});
    const double at = place_of(bench, bench.between(0.35, 0.65), [](auto& r) { return r.rpm; });
    closes_as(answers, seed, wave.text(at), bench,
              [&](const DrawnRow& r) { return r.rpm > at ? -wave.at(r) : wave.at(r); },
              {{"amplitude_nm", wave.size}, {"order", wave.order}, {"turns_over_at_rpm", at}});
  });
}

TEST(PartsOfRangesOnBenches, AWaveOfSmallLoadsAloneIsOneForm) {
  expect_all(7200, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = turning(seed, seed % 2 == 0);
    const DrawnWave wave(bench, {1, 3}, {7.0, 12.0});
    const double up_to = place_of(bench, bench.between(0.4, 0.65), [](auto& r) { return r.share; });
    closes_as(answers, seed, wave.text(up_to), bench,
              [&](const DrawnRow& r) { return r.share < up_to ? wave.at(r) : 0.0; },
              {{"amplitude_nm", wave.size},
               {"order", wave.order},
               {"below_load_nm", up_to * bench.most_output_nm / bench.ratio}});
  });
}

TEST(PartsOfRangesOnBenches, AWaveOfOneDirectionWithTheLoadIsNoPairOfNames) {
  expect_all(7300, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = turning(seed, true);
    const DrawnWave wave(bench, {1, 2}, {9.0, 14.0});
    const bool forward = seed % 2 == 0;
    closes_as(answers, seed, wave.text(), bench,
              [&](const DrawnRow& r) { return r.forward == forward ? r.share * wave.at(r) : 0.0; },
              {{"amplitude_nm", wave.size}, {"order", wave.order}});
  });
}

TEST(PartsOfRangesOnBenches, AWaveOfAWholeOrderHasItsName) {
  expect_all(7400, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = turning(seed, seed % 2 == 0);
    const DrawnWave wave(bench, {3, 6}, {3.0, 5.0});
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([&](const DrawnRow& r) { return wave.at(r); }));
    answers.add(seed, wave.text(), closed,
                is_told_once(closed, "amplitude_nm", wave.size) &&
                    closed->result.effects.front().id == "angle_periodic_friction" &&
                    is_about(closed->result.effects.front(), "order", wave.order, 1e-9));
  });
}

TEST(PartsOfRangesOnBenches, ALossThatComesInBetweenTwoTemperaturesIsOneForm) {
  expect_all(7500, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.any_warmth();
    const auto warmth = [](auto& r) { return r.warm_c; };
    const double from = place_of(bench, bench.between(0.15, 0.25), warmth),
                 to = place_of(bench, bench.between(0.5, 0.7), warmth),
                 size = bench.scatter_nm() * bench.between(8.0, 14.0);
    closes_as(answers, seed, std::to_string(from) + " to " + std::to_string(to) + " C", bench,
              [&](const DrawnRow& r) {
                return size * std::clamp((r.warm_c - from) / (to - from), 0.0, 1.0);
              },
              {{"amplitude_nm", size}, {"nothing_at_c", from}, {"whole_at_c", to}});
  });
}

TEST(PartsOfRangesOnBenches, ALossInTwoStepsIsOneForm) {
  expect_all(7600, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const auto speed = [](auto& r) { return r.rpm; };
    const double first = place_of(bench, bench.between(0.25, 0.4), speed),
                 second = place_of(bench, bench.between(0.6, 0.75), speed),
                 size = bench.scatter_nm() * bench.between(10.0, 16.0);
    closes_as(
        answers, seed, std::to_string(first) + " and " + std::to_string(second) + " rpm", bench,
        [&](const DrawnRow& r) {
          return 0.5 * size * ((r.rpm > first ? 1.0 : 0.0) + (r.rpm > second ? 1.0 : 0.0));
        },
        {{"amplitude_nm", size}, {"first_step_at_rpm", first}, {"second_step_at_rpm", second}});
  });
}

TEST(PartsOfRangesOnBenches, ABowOverTheRunIsOneForm) {
  expect_all(7700, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    const double n = static_cast<double>(bench.rows.size()) - 1.0,
                 size = bench.scatter_nm() * bench.between(6.0, 12.0);
    closes_as(answers, seed, std::to_string(size), bench,
              [&](const DrawnRow& r) { return size * (1.0 - std::pow(2.0 * r.row / n - 1.0, 2)); },
              {{"amplitude_nm", size}, {"most_at_line", 0.5 * n + 2.0}});
  });
}

TEST(PartsOfRangesOnBenches, ARunMayBeginLongAfterARest) {
  expect_all(7800, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true);
    const double within = bench.between(1.2, 3.0),
                 size = bench.scatter_nm() * bench.between(25.0, 40.0);
    int turns = 0;
    std::vector<bool> turned_before;
    for (const DrawnRow& r : bench.rows) {
      turns += r.row > 0 && r.since_turn == 0 ? 1 : 0;
      turned_before.push_back(turns > 0);
    }
    closes_as(answers, seed, std::to_string(within) + " rows", bench,
              [&](const DrawnRow& r) {
                return turned_before[static_cast<std::size_t>(r.row)]
                           ? size * std::exp(-r.since_turn / within)
                           : 0.0;
              },
              {{"amplitude_nm", size}, {"dies_within_rows", within}});
  });
}

TEST(PartsOfRangesOnBenches, AFrictionThatFadesByAnExponentialHasItsName) {
  expect_all(7900, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const double at = bench.between(200.0, 400.0),
                 size = bench.scatter_nm() * bench.between(12.0, 18.0);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([&](const DrawnRow& r) { return size * std::exp(-r.rpm / at); }));
    answers.add(seed, std::to_string(at) + " rpm", closed,
                is_told_once(closed, "torque_nm", size) &&
                    closed->result.effects.front().id == "stribeck_friction" &&
                    is_about(closed->result.effects.front(), "exponent", 1.0, 1e-9));
  });
}

}  // namespace
}  // namespace trueflank::test
