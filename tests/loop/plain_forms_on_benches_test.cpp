// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/told_as_one_form.h"

// What a person sees at once in a plot of the residual, drawn anew: rows that go by turns, a block
// of rows, a corner of two quantities, steps of a reading, a wave that grows with the speed. Each
// is told as one effect with its place and size, and nothing far above the noise is left.
namespace trueflank::test {
namespace {

TEST(PlainFormsOnBenches, RowsByTurnsAreOneForm) {
  expect_all(5100, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const int every = seed % 2 == 0 ? 2 : bench.whole(3, 4), first = bench.whole(0, every - 1);
    const double size = bench.scatter_nm() * bench.between(4.0, 9.0),
                 middle = every == 2 ? 0.5 : 0.0;
    closes_as(
        answers, seed, "every " + std::to_string(every) + " " + std::to_string(size), bench,
        [&](const DrawnRow& r) { return size * ((r.row % every == first ? 1.0 : 0.0) - middle); },
        {{"amplitude_nm", size}, {"comes_again_after_rows", every}});
  });
}

TEST(PlainFormsOnBenches, ABlockOfRowsHasItsTwoEnds) {
  expect_all(5200, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0);
    const auto n = static_cast<double>(bench.rows.size());
    const int from = static_cast<int>(bench.between(0.15, 0.4) * n),
              to = from + static_cast<int>(bench.between(0.12, 0.4) * n);
    const double size = bench.scatter_nm() * bench.between(5.0, 10.0);
    closes_as(answers, seed, std::to_string(from) + " to " + std::to_string(to), bench,
              [&](const DrawnRow& r) { return r.row >= from && r.row < to ? size : 0.0; },
              {{"amplitude_nm", size}, {"from_line", from + 2}, {"to_line", to + 1}});
  });
}

// The hold-out of runs is whole stretches of them: it may have all of a block.
TEST(PlainFormsOnBenches, ABlockThatIsHeldOutIsFound) {
  DrawnBench bench = any_rows(5301, false);
  while (bench.rows.size() < 150) {
    bench.rows.push_back(bench.rows[bench.rows.size() / 2]);
    bench.rows.back().row = static_cast<int>(bench.rows.size()) - 1;
  }
  bench.rows.resize(150);
  const double size = 12.0 * bench.scatter_nm();
  for (const int from : {25, 50, 75, 100}) {
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return r.row >= from && r.row < from + 12 ? size : 0.0;
    }));
    EXPECT_TRUE(is_told_once(closed, "amplitude_nm", size) &&
                is_told_once(closed, "from_line", from + 2))
        << from << ": " << told(closed->result);
  }
}

TEST(PlainFormsOnBenches, WarmerOrColderThanTheRowBeforeIsOneForm) {
  expect_all(5400, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.any_warmth();
    const double size = bench.scatter_nm() * bench.between(4.0, 9.0);
    closes_as(answers, seed, std::to_string(size), bench,
              [&](const DrawnRow& r) {
                if (r.row == 0) return 0.0;
                const double warmer =
                    r.warm_c - bench.rows[static_cast<std::size_t>(r.row) - 1].warm_c;
                return 0.5 * size * (warmer > 0.0 ? 1.0 : warmer < 0.0 ? -1.0 : 0.0);
              },
              {{"between_nm", size}});
  });
}

TEST(PlainFormsOnBenches, ACornerOfTwoQuantitiesIsOneForm) {
  expect_all(5500, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.any_warmth();
    double sum = 0.0;
    for (const DrawnRow& r : bench.rows) sum += r.warm_c;
    const double at_c = sum / static_cast<double>(bench.rows.size()) + bench.between(-3.0, 3.0),
                 at_rpm = bench.between(250.0, 600.0),
                 size = bench.scatter_nm() * bench.between(6.0, 10.0);
    closes_as(answers, seed, std::to_string(at_c) + " C " + std::to_string(at_rpm) + " rpm", bench,
              [&](const DrawnRow& r) { return r.warm_c > at_c && r.rpm > at_rpm ? size : 0.0; },
              {{"amplitude_nm", size}, {"above_rpm", at_rpm}, {"above_c", at_c}});
  });
}

TEST(PlainFormsOnBenches, ALossOfSlowAndLoadedRowsIsACorner) {
  expect_all(5600, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const double from = bench.between(0.35, 0.5), at_rpm = bench.between(200.0, 400.0),
                 size = bench.scatter_nm() * bench.between(14.0, 20.0);
    closes_as(answers, seed, std::to_string(from) + " " + std::to_string(at_rpm) + " rpm", bench,
              [&](const DrawnRow& r) {
                return r.rpm < at_rpm ? size * std::max(0.0, (r.share - from) / (1.0 - from)) : 0.0;
              },
              {{"amplitude_nm", size},
               {"below_rpm", at_rpm},
               {"above_output_nm", from * bench.most_output_nm}});
  });
}

TEST(PlainFormsOnBenches, AReadingInStepsHasTheirWidth) {
  expect_all(5700, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    // (a step of so many of the noise, in a range of no fewer steps than a dozen)
    const double step = bench.noise_output_nm * bench.between(9.0, 18.0);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                  [&](const DrawnRow& r) {
                                    return step * std::round(r.output_nm / step) - r.output_nm;
                                  }));
    answers.add(seed, "steps of " + std::to_string(step), closed,
                is_told_once(closed, "step_output_nm", step) &&
                    is_told_once(closed, "reads_between_nm", step) && leaves_noise(closed, bench));
  });
}

TEST(PlainFormsOnBenches, AWaveThatGrowsWithTheSpeedHasItsSize) {
  expect_all(5800, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.with_angle = true;
    const int order = bench.whole(1, 3);
    const double size = bench.scatter_nm() * bench.between(8.0, 14.0),
                 phase = bench.between(0.0, 6.28);
    double fastest = 0.0;
    for (const DrawnRow& r : bench.rows) fastest = std::max(fastest, r.rpm);
    closes_as(answers, seed, "order " + std::to_string(order) + " " + std::to_string(size), bench,
              [&](const DrawnRow& r) {
                return size * r.rpm / fastest *
                       std::cos(2.0 * M_PI * order * r.input_turns - phase);
              },
              {{"amplitude_nm", size}, {"order", order}});
  });
}

TEST(PlainFormsOnBenches, ALossThatFallsStraightToAFootIsNoExponential) {
  expect_all(5900, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const double n = static_cast<double>(bench.rows.size()), foot = bench.between(0.3, 0.6),
                 size = bench.scatter_nm() * bench.between(9.0, 14.0);
    closes_as(answers, seed, std::to_string(size) + " to " + std::to_string(foot), bench,
              [&](const DrawnRow& r) { return size * std::max(0.0, 1.0 - r.row / (foot * n)); },
              {{"amplitude_nm", size}, {"ends_at_line", foot * n + 2.0}});
  });
}

TEST(PlainFormsOnBenches, ALossByTheLogarithmOfTheSpeedIsNoResonance) {
  expect_all(6000, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    const double from = bench.between(250.0, 600.0),
                 size = bench.scatter_nm() * bench.between(12.0, 18.0);
    double fastest = 0.0;
    for (const DrawnRow& r : bench.rows) fastest = std::max(fastest, r.rpm);
    closes_as(answers, seed, std::to_string(size) + " from " + std::to_string(from), bench,
              [&](const DrawnRow& r) {
                return size * std::max(0.0, std::log(r.rpm / from) / std::log(fastest / from));
              },
              {{"amplitude_nm", size}, {"begins_at_rpm", from}});
  });
}

TEST(PlainFormsOnBenches, AResonanceThatMovesWithTheTemperatureIsOneForm) {
  expect_all(6100, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.any_warmth();
    double low = 1e9, high = -1e9;
    for (const DrawnRow& r : bench.rows) {
      low = std::min(low, r.warm_c);
      high = std::max(high, r.warm_c);
    }
    const double cold = bench.between(150.0, 250.0), warm = cold * bench.between(3.0, 5.0),
                 size = bench.scatter_nm() * bench.between(9.0, 14.0);
    closes_as(
        answers, seed, std::to_string(cold) + " to " + std::to_string(warm) + " rpm", bench,
        [&](const DrawnRow& r) {
          const double at = cold * std::pow(warm / cold, (r.warm_c - low) / (high - low));
          return size * std::exp(-std::pow(std::log(r.rpm / at) / 0.35, 2));
        },
        {{"amplitude_nm", size}, {"at_rpm_at_lowest_c", cold}, {"at_rpm_at_highest_c", warm}});
  });
}

TEST(PlainFormsOnBenches, NarrowPlacesSeveralTimesATurnAreNoWavesBesideADrag) {
  expect_all(6200, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.with_angle = true;
    const int often = bench.whole(2, 4);
    const double size = bench.scatter_nm() * bench.between(9.0, 14.0), at = bench.between(0.2, 0.8),
                 half = 0.06;
    closes_as(answers, seed, std::to_string(often) + " a turn " + std::to_string(size), bench,
              [&](const DrawnRow& r) {
                double off = often * r.input_turns - at;
                off -= std::round(off);
                return size * std::exp2(-std::pow(off / half, 2));
              },
              {{"amplitude_nm", size}, {"order", often}, {"at_deg", 360.0 * at}});
  });
}

TEST(PlainFormsOnBenches, ArchesOverTheTurnAreOneForm) {
  expect_all(6300, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(8.0, 14.0),
                 edge_deg = bench.between(40.0, 160.0);
    closes_as(answers, seed, std::to_string(size) + " edge " + std::to_string(edge_deg), bench,
              [&](const DrawnRow& r) {
                return size *
                       std::abs(std::sin(2.0 * M_PI * r.input_turns - edge_deg * M_PI / 180.0));
              },
              {{"amplitude_nm", size}, {"periods_per_turn", 2.0}, {"edge_at_deg", edge_deg}});
  });
}

TEST(PlainFormsOnBenches, EitherDirectionMayHaveAResonanceOfItsOwn) {
  expect_all(6400, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true);
    const double forward = bench.between(250.0, 450.0), backward = bench.between(800.0, 1100.0),
                 size = bench.scatter_nm() * bench.between(12.0, 16.0);
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return size *
             std::exp(-std::pow(std::log(r.rpm / (r.forward ? forward : backward)) / 0.25, 2));
    }));
    int seen = 0;
    for (const loop::FoundEffect& effect : closed->result.effects)
      seen += is_about(effect, "amplitude_nm", size, 0.25) &&
                      (is_about(effect, "at_rpm", forward, 0.1) ||
                       is_about(effect, "at_rpm", backward, 0.1))
                  ? 1
                  : 0;
    answers.add(seed, std::to_string(forward) + " and " + std::to_string(backward) + " rpm", closed,
                seen == 2 && closed->result.effects.size() == 2);
  });
}

}  // namespace
}  // namespace trueflank::test
