// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/bench_answers.h"
#include "tests/loop/drawn_bench.h"
#include "tests/support/survey_size.h"

// What a bench holds and no library of names knows, drawn anew: waves over the logarithm of the
// speed or over the run, a rhythm of rows, the first row after a turn, states at random, sawteeth,
// ways, ranges, valleys. Each is told once, with its amount.
namespace trueflank::test {
namespace {

constexpr int kAll = 8, kMost = 7;
const int kDraws = survey_size(4, kAll);

using Draw = std::function<void(Answers&, std::uint64_t)>;
void expect_most(const Draw& draw, std::uint64_t first, int least = kMost) {
  Answers answers;
  for (int run = 0; run < kDraws; ++run) draw(answers, first + static_cast<std::uint64_t>(run));
  EXPECT_GE(kAll * answers.right, least * kDraws) << answers.text();
}

TEST(WholeFormsOnBenches, AWaveOverTheLogarithmOfTheSpeedIsNoNoise) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double size = bench.scatter_nm() * bench.between(5.0, 12.0),
                     times = bench.between(2.4, 5.0), phase = bench.between(0.0, 6.28);
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return size * std::sin(2.0 * M_PI * std::log(r.rpm) / std::log(times) + phase);
            }));
        answers.add(seed, "wave of " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        says(closed, "over the logarithm of the speed"));
      },
      100);
}

TEST(WholeFormsOnBenches, ALossThatComesAndGoesOverTheRunIsOneForm) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double size = bench.scatter_nm() * bench.between(6.0, 12.0),
                     periods = bench.between(2.8, 8.0);
        const double n = static_cast<double>(bench.rows.size());
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return 0.5 * size * (1.0 - std::cos(2.0 * M_PI * periods * r.row / n));
            }));
        answers.add(seed, "from nothing to " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        says(closed, "over the course of the run"));
      },
      200);
}

TEST(WholeFormsOnBenches, ARhythmOfRowsIsOneForm) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const int every = bench.whole(5, 11), first = bench.whole(0, every - 1);
        const double size = bench.scatter_nm() * bench.between(6.0, 12.0);
        const auto closed = loop::close_drive_loop(
            bench.model(),
            bench.data([&](const DrawnRow& r) { return r.row % every == first ? size : 0.0; }));
        answers.add(seed, std::to_string(size) + " every " + std::to_string(every), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        is_told_once(closed, "comes_again_after_rows", every));
      },
      300);
}

TEST(WholeFormsOnBenches, TheFirstRowAfterAChangeOfDirectionIsOneForm) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, true);
        const double size = bench.scatter_nm() * bench.between(6.0, 12.0);
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return r.row > 0 && r.since_turn == 0 ? size : 0.0;
            }));
        answers.add(seed, "first row " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        says(closed, "after every change of direction"));
      },
      400);
}

TEST(WholeFormsOnBenches, TwoStatesAtRandomAreTwoStates) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double size = bench.scatter_nm() * bench.between(7.0, 14.0),
                     often = bench.between(0.25, 0.6);
        std::vector<bool> on;
        for (std::size_t i = 0; i < bench.rows.size(); ++i)
          on.push_back(bench.between(0.0, 1.0) < often);
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return on[static_cast<std::size_t>(r.row)] ? size : 0.0;
            }));
        answers.add(seed, "states " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        says(closed, "at times and at times not"));
      },
      500);
}

TEST(WholeFormsOnBenches, ASawtoothOverTheAngleIsOneForm) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        bench.with_angle = true;
        const int teeth = bench.whole(2, 5);
        const double size = bench.scatter_nm() * bench.between(7.0, 14.0),
                     jump = bench.between(0.0, 1.0), way = seed % 2 == 0 ? 1.0 : -1.0;
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              const double place = teeth * r.input_turns - jump;
              return way * size * (place - std::floor(place) - 0.5);
            }));
        answers.add(seed, "sawtooth " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        is_told_once(closed, "periods_per_turn", teeth));
      },
      600);
}

TEST(WholeFormsOnBenches, AWayOfLoadingIsAFormWithItsAmount) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench(seed, RowOrder::kUpAndDown);
        std::erase_if(bench.rows, [](const DrawnRow& r) { return !r.forward; });
        const double half = bench.noise_output_nm * bench.between(2.5, 6.0);
        for (std::size_t i = 0; i < bench.rows.size(); ++i) {
          DrawnRow& row = bench.rows[i];
          const double before = i > 0 ? bench.rows[i - 1].share : row.share;
          row.row = static_cast<int>(i);
          row.way = row.share > before ? 1 : row.share < before ? -1 : 0;
        }
        const auto closed = loop::close_drive_loop(
            bench.model(), bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                                      [&](const DrawnRow& r) { return half * r.way; }));
        // (a reading is told in the output's torque, a loss in the input's)
        const double truth = says(closed, "the output's torque reads") ? half : half / bench.ratio;
        answers.add(seed, "to either side " + std::to_string(truth), closed,
                    is_told_once(closed, "to_either_side_nm", truth) &&
                        closed->result.verdict == loop::Verdict::kExplained);
      },
      700);
}

TEST(WholeFormsOnBenches, AStepBelowASpeedHasNoNameOfAFadingFriction) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double size = bench.scatter_nm() * bench.between(6.0, 12.0),
                     at = bench.between(150.0, 400.0);
        const auto closed = loop::close_drive_loop(
            bench.model(), bench.data([&](const DrawnRow& r) { return r.rpm < at ? size : 0.0; }));
        answers.add(
            seed, "step at " + std::to_string(at) + " of " + std::to_string(size), closed,
            closed && with_figure(closed->result, "at_rpm") != nullptr &&
                is_about(*with_figure(closed->result, "at_rpm"), "amplitude_nm", size, 0.2) &&
                found(closed->result, "stribeck_friction") == nullptr &&
                found(closed->result, "mixed_friction") == nullptr);
      },
      800);
}

TEST(WholeFormsOnBenches, AGainOfOneRangeIsNoScale) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double gain = bench.between(0.02, 0.06) * (seed % 2 == 0 ? 1.0 : -1.0),
                     at = bench.between(0.3, 0.55);
        const auto closed = loop::close_drive_loop(
            bench.model(),
            bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                       [&](const DrawnRow& r) { return r.share > at ? gain * r.output_nm : 0.0; }));
        // (what reads less takes no power: a loss does the same in one direction)
        const bool is_right =
            gain > 0.0 ? is_told_once(closed, "gain_percent", 100.0 * gain) &&
                             is_told_once(closed, "from_output_nm", at * bench.most_output_nm)
                       : closed && closed->result.verdict != loop::Verdict::kNoEffect;
        answers.add(seed, "gain " + std::to_string(gain) + " from " + std::to_string(at), closed,
                    is_right);
      },
      900);
}

TEST(WholeFormsOnBenches, ALossThatIsLeastAtATemperatureIsOneForm) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        bench.any_warmth();
        double low = 1e9, high = -1e9;
        for (const DrawnRow& r : bench.rows) {
          low = std::min(low, r.warm_c);
          high = std::max(high, r.warm_c);
        }
        const double share = bench.between(0.3, 0.7), least = low + share * (high - low),
                     room = std::max(share, 1.0 - share) * (high - low),
                     size = bench.scatter_nm() * bench.between(6.0, 12.0);
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return size * std::pow((r.warm_c - least) / room, 2);
            }));
        answers.add(seed, "least at " + std::to_string(least) + ", " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        is_told_once(closed, "turns_at_c", least));
      },
      survey_size(1004, 1000));  // (the fourth is the one of eight that is told otherwise)
}

TEST(WholeFormsOnBenches, ALossThatSaturatesWithTheLoadIsNoDragAndFriction) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        const double size = bench.scatter_nm() * bench.between(12.0, 20.0),
                     within = bench.between(0.1, 0.2);
        const auto closed =
            loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
              return size * (1.0 - std::exp(-r.share / within));
            }));
        answers.add(seed, "saturates at " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) && says(closed, "saturates"));
      },
      // (drag, friction and where a loss begins come near)
      1100, 5);
}

TEST(WholeFormsOnBenches, ALossAboveATemperatureIsExplained) {
  expect_most(
      [](Answers& answers, std::uint64_t seed) {
        DrawnBench bench = any_rows(seed, false);
        bench.warm_up();
        const double size = bench.scatter_nm() * bench.between(6.0, 12.0);
        double mean = 0.0;
        for (const DrawnRow& r : bench.rows)
          mean += r.warm_c / static_cast<double>(bench.rows.size());
        const double at = mean + bench.between(-3.0, 5.0);
        const auto closed = loop::close_drive_loop(
            bench.model(),
            bench.data([&](const DrawnRow& r) { return r.warm_c > at ? size : 0.0; }));
        answers.add(seed, "from " + std::to_string(at) + " C " + std::to_string(size), closed,
                    is_told_once(closed, "amplitude_nm", size) &&
                        closed->result.verdict == loop::Verdict::kExplained);
      },
      1200);
}

TEST(WholeFormsOnBenches, OfNoiseOfManyKindsNothingIsTold) {
  int alarms = 0;
  const int benches = survey_size(24, 64);
  std::string said;
  for (int run = 0; run < benches; ++run) {
    const auto seed = static_cast<std::uint64_t>(3000 + run);
    DrawnBench bench = any_rows(seed, run % 2 == 0);
    bench.with_angle = run % 3 == 0;
    if (run % 5 == 0) bench.any_warmth();
    if (run % 4 == 1) bench.noise_factor = [](const DrawnRow& r) { return 0.3 + r.share; };
    if (run % 4 == 2)  // slips
      bench.noise_factor = [](const DrawnRow& r) { return r.row % 37 == 5 ? 7.0 : 1.0; };
    if (run % 8 == 3) bench.rows.resize(40);
    double hangs = 0.0;
    std::vector<double> together;
    for (std::size_t i = 0; i < bench.rows.size(); ++i)
      together.push_back(hangs = 0.6 * hangs + bench.between(-1.4, 1.4));
    const bool correlated = run % 4 == 3;
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return correlated ? bench.scatter_nm() * together[static_cast<std::size_t>(r.row)] : 0.0;
    }));
    ASSERT_TRUE(closed);
    if (closed->result.effects.empty()) continue;
    ++alarms;
    said += std::to_string(run) + ": " + told(closed->result) + "\n";
  }
  EXPECT_LE(64 * alarms, 2 * benches) << said;
}

}  // namespace
}  // namespace trueflank::test
