// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// What counts rows or comes at a speed, drawn anew: a loss in a sawtooth over the rows, a zero that
// was set anew several times, waves that grow with the square of the speed or are largest at one, a
// chip that is felt in one direction. Each is told as one effect with its size and place.
namespace trueflank::test {
namespace {

DrawnBench longer_rows(std::uint64_t seed, bool both) {
  for (std::uint64_t more = 0;; ++more)
    if (DrawnBench bench = any_rows(seed + 100000 * more, both); bench.rows.size() >= 160)
      return bench;
}

TEST(FormsOfTheRunOnBenches, ASawtoothOverTheRowsIsOneFormAndNoDrag) {
  expect_all(8100, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = longer_rows(seed, seed % 2 == 0);
    const int every = bench.whole(17, 45), first = bench.whole(0, every - 1);
    const double size = bench.scatter_nm() * bench.between(5.0, 12.0);
    closes_as(
        answers, seed, "every " + std::to_string(every), bench,
        [&](const DrawnRow& r) { return size * ((r.row + every - first) % every) / (every - 1.0); },
        {{"amplitude_nm", size}, {"comes_again_after_rows", every}});
  });
}

TEST(FormsOfTheRunOnBenches, AZeroThatWasSetAnewSeveralTimesHasItsLinesAndLevels) {
  expect_all(8200, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = longer_rows(seed, seed % 2 == 0);
    const int parts = bench.whole(4, 5), rows = static_cast<int>(bench.rows.size());
    const double size = bench.scatter_nm() * bench.ratio * bench.between(7.0, 14.0);
    const std::vector<double> share{0.0, 0.7, -0.4, 0.35, -0.8};
    const auto part = [&](int row) { return row * parts / rows; };
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                  [&](const DrawnRow& r) {
                                    return size * share[static_cast<std::size_t>(part(r.row))];
                                  }));
    bool is_right = leaves_noise(closed, bench) && is_told_once(closed, "changes", parts - 1);
    for (int k = 1; k < parts && is_right; ++k) {
      int row = 0;
      while (part(row) < k) ++row;
      const std::string number = std::to_string(k);
      const loop::FoundEffect& effect = closed->result.effects.front();
      const loop::Parameter *line = parameter(effect, "from_line_" + number),
                            *level = parameter(effect, "reads_more_" + number + "_nm");
      is_right = line != nullptr && level != nullptr && std::abs(line->value - (row + 2)) <= 1.0 &&
                 std::abs(level->value - size * share[static_cast<std::size_t>(k)]) < 0.12 * size;
    }
    answers.add(seed, std::to_string(parts) + " levels", closed, is_right);
  });
}

TEST(FormsOfTheRunOnBenches, AZeroSetAnewInOneDirectionHasThreeToSevenLevelsOfAnyLength) {
  expect_all(8600, 6, [](Answers& answers, std::uint64_t seed) {
    const int levels = 3 + static_cast<int>(seed % 5);
    DrawnBench bench = any_rows(seed, false, 40 * levels + (seed % 2 == 0 ? 0 : 150));
    const int rows = static_cast<int>(bench.rows.size()), shortest = rows / (2 * levels);
    const double size = bench.scatter_nm() * bench.ratio * bench.between(8.0, 16.0);
    std::vector<int> first{0};
    std::vector<double> level{0.0};
    for (int k = 1; k < levels; ++k) {
      first.push_back(first.back() + shortest + bench.whole(0, shortest));
      double next = level.back();
      while (std::abs(next - level.back()) < 0.4 || std::abs(next) < 0.25)
        next = bench.between(-1.0, 1.0);
      level.push_back(next);
    }
    const auto level_of = [&](int row) {
      const auto after = std::upper_bound(first.begin(), first.end(), row);
      return size * level[static_cast<std::size_t>(after - first.begin() - 1)];
    };
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                  [&](const DrawnRow& r) { return level_of(r.row); }));
    bool is_right = leaves_noise(closed, bench) && is_told_once(closed, "changes", levels - 1);
    for (int k = 1; k < levels && is_right; ++k) {
      const std::string number = std::to_string(k);
      const loop::FoundEffect& effect = closed->result.effects.front();
      const auto at = static_cast<std::size_t>(k);
      const loop::Parameter *line = parameter(effect, "from_line_" + number),
                            *told = parameter(effect, "reads_more_" + number + "_nm");
      is_right = line != nullptr && told != nullptr &&
                 std::abs(line->value - (first[at] + 2)) <= 1.0 &&
                 std::abs(told->value - size * level[at]) < 0.12 * size;
    }
    answers.add(seed, std::to_string(levels) + " levels", closed, is_right);
  });
}

TEST(FormsOfTheRunOnBenches, AWaveThatGrowsWithTheSquareOfTheSpeedSaysSo) {
  expect_all(8300, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = longer_rows(seed, false);
    bench.with_angle = true;
    const int order = bench.whole(1, 3);
    const double size = bench.scatter_nm() * bench.between(9.0, 15.0),
                 phase = bench.between(0.0, 6.28);
    double most = 0.0;
    for (const DrawnRow& r : bench.rows) most = std::max(most, r.rpm);
    closes_as(answers, seed, "order " + std::to_string(order), bench,
              [&](const DrawnRow& r) {
                return size * std::pow(r.rpm / most, 2) *
                       std::cos(2.0 * M_PI * order * r.input_turns - phase);
              },
              {{"amplitude_nm", size}, {"order", order}, {"speed_exponent", 2.0}});
  });
}

TEST(FormsOfTheRunOnBenches, AWaveThatIsLargestAtASpeedSaysWhichAndHowWide) {
  expect_all(8400, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = longer_rows(seed, false);
    bench.with_angle = true;
    const int order = bench.whole(1, 4);
    const double size = bench.scatter_nm() * bench.between(10.0, 18.0),
                 phase = bench.between(0.0, 6.28), at = bench.between(300.0, 900.0),
                 half = bench.between(0.22, 0.4);
    closes_as(answers, seed, "order " + std::to_string(order) + " at " + std::to_string(at), bench,
              [&](const DrawnRow& r) {
                const double x = std::log(r.rpm / at) / half;
                return size * std::cos(2.0 * M_PI * order * r.input_turns - phase) / (1.0 + x * x);
              },
              {{"amplitude_nm", size}, {"order", order}, {"at_rpm", at}});
  });
}

TEST(FormsOfTheRunOnBenches, AChipThatIsFeltInOneDirectionHasItsPlaceAndWidth) {
  expect_all(8500, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = longer_rows(seed, true);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(9.0, 16.0),
                 at = bench.between(40.0, 320.0), half = bench.between(15.0, 24.0);
    closes_as(answers, seed, "at " + std::to_string(at) + ", half " + std::to_string(half), bench,
              [&](const DrawnRow& r) {
                const double turns = r.input_turns - at / 360.0,
                             x = 360.0 * (turns - std::round(turns)) / half;
                return r.forward ? size * std::exp2(-x * x) : 0.0;
              },
              {{"amplitude_nm", size}, {"at_deg", at}, {"half_width_deg", half}});
  });
}

}  // namespace
}  // namespace trueflank::test
