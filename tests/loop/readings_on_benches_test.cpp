// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/bench_answers.h"
#include "tests/loop/drawn_bench.h"
#include "tests/support/survey_size.h"

// What a sensor reads wrong, what one direction alone loses, what comes and goes, and noise that is
// not the same everywhere: on random benches, told as one form beside what is known.
namespace trueflank::test {
namespace {

const int kOfEach = survey_size(4, 120);

DrawnBench::Loss no_loss() {
  return [](const DrawnRow&) { return 0.0; };
}

const loop::FoundEffect* named(const loop::LoopResult& result, const std::string& id) {
  for (const loop::FoundEffect& effect : result.effects)
    if (effect.id == id) return &effect;
  return nullptr;
}

bool says(const loop::FoundEffect& effect, const std::string& words) {
  return effect.sentence.find(words) != std::string::npos;
}

/// No word of the program's own, no slip, no place in thousands of degrees.
bool reads_well(const ResultAll<loop::DriveLoop>& closed) {
  if (!closed) return false;
  std::string all = closed->result.structure_left;
  for (const loop::FoundEffect& effect : closed->result.effects) all += "\n" + effect.sentence;
  for (const std::string& next : closed->result.measure_next) all += "\n" + next;
  for (const char* wrong : {"unnamed", ",:", "e+03 degrees", "e+04 degrees", "looks like"})
    if (all.find(wrong) != std::string::npos) return false;
  return true;
}

/// What is left agrees with what was put in.
bool leaves_the_noise(const loop::LoopResult& result) {
  return result.verdict != loop::Verdict::kExplained ||
         result.after.held_out_rms < 1.35 * result.noise;
}

TEST(ReadingsOnBenches, ALossOfOneDirectionThatJumpsAtASpeedIsOneFormOfThatDirection) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(61000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const bool forward = run % 2 == 0;
    const std::size_t level =
        static_cast<std::size_t>(bench.whole(2, static_cast<int>(bench.rpm.size()) - 3));
    const double from = 0.5 * (bench.rpm[level - 1] + bench.rpm[level]),
                 more = bench.scatter_nm() * bench.between(3.0, 8.0);
    const auto data = bench.data(
        [&](const DrawnRow& row) { return row.forward == forward && row.rpm > from ? more : 0.0; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = closed ? with_figure(closed->result, "at_rpm") : nullptr;
    answers.add(seed, "from " + std::to_string(from) + " rpm " + std::to_string(more), closed,
                reads_well(closed) && form != nullptr && closed->result.effects.size() == 1 &&
                    is_about(*form, "amplitude_nm", more, 0.2) &&
                    parameter(*form, "at_rpm")->value > bench.rpm[level - 1] - 1.0 &&
                    parameter(*form, "at_rpm")->value < bench.rpm[level] + 1.0 &&
                    says(*form, forward ? "while the input drives" : "while the output drives"));
  }
  std::printf("a loss of one direction that jumps: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

TEST(ReadingsOnBenches, AReadingThatFollowsTheSpeedIsNoLossAndTheFrictionKeepsItsName) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(62000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double power = bench.between(1.5, 2.8), friction = 0.1 * bench.between(1.4, 2.0),
                 more = bench.noise_output_nm * bench.between(4.0, 9.0) * (run % 2 ? 1.0 : -1.0);
    const auto data = bench.data(no_loss(), friction, [&](const DrawnRow& row) {
      return more * std::pow(row.rpm / 3000.0, power);
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = closed ? with_figure(closed->result, "reads_more_nm") : nullptr;
    const loop::FoundEffect* rubs =
        closed ? named(closed->result, "friction_coefficient") : nullptr;
    answers.add(
        seed,
        "power " + std::to_string(power) + " " + std::to_string(more) + ", friction " +
            std::to_string(friction),
        closed,
        reads_well(closed) && form != nullptr && rubs != nullptr &&
            closed->result.effects.size() == 2 && is_about(*form, "reads_more_nm", more, 0.2) &&
            is_about(*form, "power", power, 0.5) && is_about(*rubs, "value", friction, 0.12) &&
            says(*form, "a reading, no loss") && leaves_the_noise(closed->result));
  }
  std::printf("a reading that follows the speed: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(ReadingsOnBenches, AReadingThatStartsAfterADeadZoneIsOneForm) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(63000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double within = bench.most_output_nm * bench.between(0.06, 0.2),
                 less = bench.noise_output_nm * bench.between(5.0, 10.0);
    const auto data = bench.data(no_loss(), 0.1, [&](const DrawnRow& row) {
      return -less * (1.0 - std::exp(-row.output_nm / within));
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "within_output_nm") : nullptr;
    answers.add(
        seed, "within " + std::to_string(within) + " " + std::to_string(less) + " less", closed,
        reads_well(closed) && form != nullptr && closed->result.effects.size() == 1 &&
            is_about(*form, "reads_more_nm", -less, 0.2) &&
            is_about(*form, "within_output_nm", within, 0.5) && says(*form, "less under load"));
  }
  std::printf("a reading after a dead zone: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.8)) << answers.text();
}

TEST(ReadingsOnBenches, AGainThatFollowsTheTemperatureIsOneReadingBesideADrag) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(64000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.any_warmth();
    const double per_c = 0.01 * bench.between(0.08, 0.3) * (run % 2 ? -1.0 : 1.0),
                 drag = bench.scatter_nm() * bench.between(4.0, 9.0);
    const auto data = bench.data(
        [&](const DrawnRow&) { return drag; }, 0.1,
        [&](const DrawnRow& row) { return per_c * (row.warm_c - 25.0) * row.output_nm; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "gain_percent_per_c") : nullptr;
    const loop::FoundEffect* drags = closed ? named(closed->result, "drag_torque") : nullptr;
    answers.add(seed, std::to_string(100.0 * per_c) + " % per C, drag " + std::to_string(drag),
                closed,
                reads_well(closed) && form != nullptr && drags != nullptr &&
                    closed->result.effects.size() == 2 &&
                    is_about(*form, "gain_percent_per_c", 100.0 * per_c, 0.2) &&
                    is_about(*drags, "torque_nm", drag, 0.2) && leaves_the_noise(closed->result));
  }
  std::printf("a gain that follows the temperature: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(ReadingsOnBenches, ALineOverAnAngleThatDoesNotCloseIsNoWave) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(65000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double half = bench.between(40.0, 160.0), per_deg = bench.noise_output_nm *
                                                              bench.between(3.0, 9.0) / half *
                                                              (run % 2 ? 1.0 : -1.0);
    bench.swing_to_and_fro(half);
    const auto data = bench.data(no_loss(), 0.1, [&](const DrawnRow& row) {
      return per_deg * 360.0 * row.input_turns / bench.ratio;
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "reads_more_nm_per_output_deg") : nullptr;
    answers.add(seed, std::to_string(per_deg) + " N m per degree", closed,
                reads_well(closed) && form != nullptr && closed->result.effects.size() == 1 &&
                    is_about(*form, "reads_more_nm_per_output_deg", per_deg, 0.12) &&
                    says(*form, "degrees of the output") && leaves_the_noise(closed->result));
  }
  std::printf("a line over the output's angle: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.95)) << answers.text();
}

TEST(ReadingsOnBenches, AWaveSlowerThanATurnIsPlacedInTurns) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(69000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.with_angle = true;
    const double order = bench.between(0.03, 0.09), at = bench.between(0.0, 1.0),
                 half = bench.scatter_nm() * bench.between(2.0, 4.0);
    const auto data = bench.data([&](const DrawnRow& row) {
      return half * (1.0 + std::cos(6.283185307 * (order * row.input_turns - at)));
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = nullptr;
    if (closed)
      for (const loop::FoundEffect& effect : closed->result.effects)
        if (says(effect, "in a wave of order")) form = &effect;
    answers.add(seed, "order " + std::to_string(order), closed,
                reads_well(closed) && form != nullptr && is_about(*form, "order", order, 0.02) &&
                    (form->named || says(*form, "turns of the input")));
  }
  std::printf("a slow wave: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

TEST(ReadingsOnBenches, ADragThatIsThereAtTimesIsTwoStatesAndFollowsNoTemperature) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(66000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.warm_up();
    const double more = bench.scatter_nm() * bench.between(4.5, 9.0),
                 often = bench.between(0.03, 0.08);
    std::vector<double> there;
    double now = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < bench.rows.size(); ++i) {
      if (bench.between(0.0, 1.0) < often) now = 1.0 - now;
      there.push_back(now);
      rows += now;
    }
    const auto data = bench.data(
        [&](const DrawnRow& row) { return more * there[static_cast<std::size_t>(row.row)]; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = closed ? with_figure(closed->result, "rows_percent") : nullptr;
    answers.add(seed, std::to_string(more) + " N m in " + std::to_string(rows) + " rows", closed,
                reads_well(closed) && form != nullptr &&
                    is_about(*form, "amplitude_nm", more, 0.12) &&
                    std::abs(parameter(*form, "rows_percent")->value -
                             100.0 * rows / static_cast<double>(there.size())) < 6.0 &&
                    closed->result.effects.size() == 1);
  }
  std::printf("a drag that is there at times: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(ReadingsOnBenches, AFormOverATemperatureThatRoseWithTheRunIsNotAsGoodAsCertain) {
  int over_temperature = 0;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(70000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.with_temperature = true;
    const double span = bench.between(15.0, 30.0), at = bench.between(0.3, 0.7),
                 most = bench.scatter_nm() * bench.between(3.0, 6.0);
    for (DrawnRow& row : bench.rows)
      row.warm_c =
          22.0 + span * row.row / static_cast<double>(bench.rows.size()) + bench.between(-0.3, 0.3);
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& row) {
      const double x = (row.warm_c - 22.0) / span - at;
      return most * std::exp(-x * x / 0.02);
    }));
    ASSERT_TRUE(closed) << "seed " << seed;
    for (const loop::FoundEffect& effect : closed->result.effects) {
      if (effect.named || !says(effect, "temperature of")) continue;
      ++over_temperature;
      EXPECT_FALSE(effect.sure.starts_with("as good as certain")) << "seed " << seed;
      EXPECT_NE(effect.sure.find("changed meanwhile"), std::string::npos) << "seed " << seed;
    }
  }
  EXPECT_GT(over_temperature, 0);
}

TEST(ReadingsOnBenches, ALossByAPowerOfTheSpeedBeginsNowhere) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const auto seed = static_cast<std::uint64_t>(67000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double power = bench.between(1.8, 2.9),
                 most = bench.scatter_nm() * bench.between(4.0, 9.0);
    const auto data =
        bench.data([&](const DrawnRow& row) { return most * std::pow(row.rpm / 3000.0, power); });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = closed ? with_figure(closed->result, "power") : nullptr;
    answers.add(seed, "power " + std::to_string(power) + " " + std::to_string(most), closed,
                reads_well(closed) && form != nullptr && closed->result.effects.size() == 1 &&
                    is_about(*form, "amplitude_nm", most, 0.2) &&
                    is_about(*form, "power", power, 0.4) && !says(*form, "begins"));
  }
  std::printf("a loss by a power of the speed: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

TEST(ReadingsOnBenches, NoiseThatGrowsWithTheLoadOrTheSpeedIsNothing) {
  Answers answers;
  const int runs = survey_size(7, 240);
  for (int run = 1; run <= runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(68000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.with_angle = true;
    bench.warm_up();
    const bool of_load = run % 2 == 0;
    const double least = bench.between(0.2, 0.4), most = bench.between(1.2, 2.0);
    bench.noise_factor = [=](const DrawnRow& row) {
      return least + (most - least) * (of_load ? row.share : row.rpm / 3000.0);
    };
    const auto data = bench.data(no_loss());
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, of_load ? "noise grows with the load" : "noise grows with the speed", closed,
                closed && closed->result.verdict == loop::Verdict::kNoEffect &&
                    closed->result.effects.empty());
  }
  std::printf("noise that grows: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.95)) << answers.text();
}

}  // namespace
}  // namespace trueflank::test
