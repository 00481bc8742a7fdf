// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/loop/bench_answers.h"
#include "tests/loop/drawn_bench.h"
#include "tests/support/survey_size.h"

// Kinds that an outside judge hid and found told in pieces or wrongly: drawn anew on random
// benches, one form with its size and its place each.
namespace trueflank::test {
namespace {

const int kOfEach = survey_size(4, 80);

double nothing(const DrawnRow&) { return 0.0; }

bool says(const loop::FoundEffect& effect, const std::string& words) {
  return effect.sentence.find(words) != std::string::npos;
}

/// What one bench hides, and whether an answer is right.
struct Hidden {
  DrawnBench::Loss loss = nothing, reading = nothing;
  std::string truth;
  std::function<bool(const loop::LoopResult&)> is_right;
};

/// Surveys benches of which so many are right, but for chance.
void survey(const char* what, std::uint64_t first, RowOrder order, double chance,
            const std::function<Hidden(DrawnBench&, int)>& hide) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(run);
    DrawnBench bench(seed, order);
    const Hidden hidden = hide(bench, run);
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data(hidden.loss, 0.1, hidden.reading));
    answers.add(seed, hidden.truth, closed, closed && hidden.is_right(closed->result));
  }
  std::printf("%s: %s", what, answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(chance)) << answers.text();
}

/// The one effect, which has this figure.
const loop::FoundEffect* alone_with(const loop::LoopResult& result, const std::string& figure) {
  return result.effects.size() == 1 ? with_figure(result, figure) : nullptr;
}

TEST(JudgedOnBenches, AResonanceOfOneDirectionHasItsSpeedItsWidthAndItsDirection) {
  survey("a resonance of one direction", 81000, RowOrder::kShuffled, 0.9,
         [](DrawnBench& bench, int run) {
           const bool forward = run % 2 == 0;
           const double at = bench.between(0.35, 0.65) * 3000.0, half = bench.between(350.0, 600.0),
                        most = bench.scatter_nm() * bench.between(6.0, 12.0);
           Hidden hidden;
           hidden.truth = std::to_string(at) + " rpm, " + std::to_string(half) + " wide";
           hidden.loss = [=](const DrawnRow& row) {
             const double x = (row.rpm - at) / half;
             return row.forward == forward ? most / (1.0 + x * x) : 0.0;
           };
           hidden.is_right = [=](const loop::LoopResult& result) {
             const loop::FoundEffect* form = alone_with(result, "at_rpm");
             return form != nullptr && is_about(*form, "at_rpm", at, 0.1) &&
                    is_about(*form, "half_width_rpm", half, 0.4) &&
                    is_about(*form, "amplitude_nm", most, 0.2) &&
                    says(*form, forward ? "while the input drives" : "while the output drives");
           };
           return hidden;
         });
}

TEST(JudgedOnBenches, WhatIsOnUpToATemperatureFollowsItAndNotTheTimesAtWhichItWasThere) {
  survey("a pump that is on in the cold", 82000, RowOrder::kShuffled, 0.9,
         [](DrawnBench& bench, int) {
           bench.warm_up();
           std::vector<double> warm;
           for (const DrawnRow& row : bench.rows) warm.push_back(row.warm_c);
           std::sort(warm.begin(), warm.end());
           const double at = warm[warm.size() * 45 / 100] + 0.05,
                        more = bench.scatter_nm() * bench.between(5.0, 12.0);
           Hidden hidden;
           hidden.truth = std::to_string(at) + " C, " + std::to_string(more);
           hidden.loss = [=](const DrawnRow& row) { return row.warm_c < at ? more : 0.0; };
           hidden.is_right = [=](const loop::LoopResult& result) {
             for (const loop::FoundEffect& effect : result.effects)
               if (says(effect, "nothing that was recorded")) return false;
             const loop::FoundEffect* form = with_figure(result, "at_c");
             return form != nullptr && is_about(*form, "amplitude_nm", more, 0.15) &&
                    std::abs(parameter(*form, "at_c")->value - at) < 1.0;
           };
           return hidden;
         });
}

TEST(JudgedOnBenches, AnArmThatRubsIsAReadingThatExplainsTheGain) {
  survey("an arm that rubs", 83000, RowOrder::kShuffled, 0.9, [](DrawnBench& bench, int) {
    const double more = bench.noise_output_nm * bench.between(3.0, 6.0);
    Hidden hidden;
    hidden.truth = std::to_string(more) + " N m";
    hidden.reading = [=](const DrawnRow& row) { return row.forward ? more : -more; };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = alone_with(result, "reads_more_nm");
      return form != nullptr && is_about(*form, "reads_more_nm", more, 0.15) &&
             says(*form, "as much less while the output drives") &&
             result.verdict == loop::Verdict::kExplained;
    };
    return hidden;
  });
}

TEST(JudgedOnBenches, AGainThatJumpsHasItsLineAndItsPercent) {
  survey("a gain that jumps", 84000, RowOrder::kShuffled, 0.9, [](DrawnBench& bench, int run) {
    const int from =
        static_cast<int>(static_cast<double>(bench.rows.size()) * bench.between(0.3, 0.7));
    const double more = (run % 2 == 0 ? 0.01 : -0.01) * bench.between(2.0, 4.0);
    Hidden hidden;
    hidden.truth = "row " + std::to_string(from) + ", " + std::to_string(100.0 * more) + " %";
    hidden.reading = [=](const DrawnRow& row) {
      return row.row >= from ? more * row.output_nm : 0.0;
    };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = alone_with(result, "gain_changes_percent");
      return form != nullptr && is_about(*form, "gain_changes_percent", 100.0 * more, 0.2) &&
             std::abs(parameter(*form, "at_line")->value - from - 2) < 6.0;
    };
    return hidden;
  });
}

TEST(JudgedOnBenches, AZeroThatJumpsIsNotDeniedByARowBesideTheJump) {
  survey("a zero that jumps", 85000, RowOrder::kShuffled, 0.9, [](DrawnBench& bench, int run) {
    const int from =
        static_cast<int>(static_cast<double>(bench.rows.size()) * bench.between(0.3, 0.7));
    const double more =
        (run % 2 == 0 ? 1.0 : -1.0) * bench.noise_output_nm * bench.between(5.0, 15.0);
    Hidden hidden;
    hidden.truth = "row " + std::to_string(from) + ", " + std::to_string(more) + " N m";
    hidden.reading = [=](const DrawnRow& row) { return row.row >= from ? more : 0.0; };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = alone_with(result, "reads_more_nm");
      return form != nullptr && is_about(*form, "reads_more_nm", more, 0.15) &&
             std::abs(parameter(*form, "at_line")->value - from - 2) < 4.0 &&
             result.verdict == loop::Verdict::kExplained;
    };
    return hidden;
  });
}

TEST(JudgedOnBenches, ASensorThatReadsByAPowerOfItsLoadIsOneFormWithItsPower) {
  survey("a power of the load", 86000, RowOrder::kShuffled, 0.9, [](DrawnBench& bench, int run) {
    const double power = run % 2 == 0 ? 2.0 : 3.0,
                 more =
                     bench.noise_output_nm * bench.between(6.0, 12.0) * (run % 3 == 0 ? -1.0 : 1.0),
                 most_nm = bench.most_output_nm;
    Hidden hidden;
    hidden.truth = std::to_string(more) + " N m by the power " + std::to_string(power);
    hidden.reading = [=](const DrawnRow& row) {
      return more * std::pow(row.output_nm / most_nm, power);
    };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = alone_with(result, "percent_at_most");
      return form != nullptr && is_about(*form, "reads_more_nm", more, 0.15) &&
             is_about(*form, "power", power, 0.3) && says(*form, "a reading, no loss");
    };
    return hidden;
  });
}

TEST(JudgedOnBenches, ALossByTheRootOfTheSpeedIsOneForm) {
  survey("the root of the speed", 87000, RowOrder::kShuffled, 0.85, [](DrawnBench& bench, int) {
    const double most = bench.scatter_nm() * bench.between(12.0, 20.0);
    Hidden hidden;
    hidden.truth = std::to_string(most) + " N m";
    hidden.loss = [=](const DrawnRow& row) { return most * std::sqrt(row.rpm / 3000.0); };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = with_figure(result, "power");
      return form != nullptr && is_about(*form, "power", 0.5, 0.3) &&
             is_about(*form, "amplitude_nm", most, 0.2);
    };
    return hidden;
  });
}

/// A wave over the angle of the planets, of a size of every row.
Hidden wave(DrawnBench& bench, const std::function<double(const DrawnRow&)>& share,
            const std::string& words, bool reads) {
  bench.with_angle = true;
  const double order = bench.between(0.1, 0.6),
               most = bench.scatter_nm() * bench.between(5.0, 10.0),
               phase = bench.between(0.0, 6.0), ratio = bench.ratio;
  const auto size = [=](const DrawnRow& row) {
    return most * share(row) * std::cos(6.283185307179586 * order * row.input_turns - phase);
  };
  Hidden hidden;
  hidden.truth = "order " + std::to_string(order) + ", " + std::to_string(most) + " N m";
  if (reads)
    hidden.reading = [=](const DrawnRow& row) { return ratio * size(row); };
  else
    hidden.loss = size;
  hidden.is_right = [=](const loop::LoopResult& result) {
    const loop::FoundEffect* form = alone_with(result, "order");
    return form != nullptr && std::abs(parameter(*form, "order")->value - order) < 0.003 &&
           is_about(*form, "amplitude_nm", most, 0.2) && says(*form, words);
  };
  return hidden;
}

TEST(JudgedOnBenches, AWaveInProportionToTheLoadIsToldSo) {
  survey("a wave in proportion to the load", 88000, RowOrder::kShuffled, 0.85,
         [](DrawnBench& bench, int) {
           return wave(
               bench, [](const DrawnRow& row) { return row.share; }, "in proportion to the load",
               false);
         });
}

TEST(JudgedOnBenches, AWaveThatGrowsOverTheRunIsOneWave) {
  survey("a wave that grows", 88500, RowOrder::kShuffled, 0.85, [](DrawnBench& bench, int) {
    const double rows = static_cast<double>(bench.rows.size());
    return wave(
        bench, [=](const DrawnRow& row) { return row.row / rows; }, "grows over the run", false);
  });
}

TEST(JudgedOnBenches, AWaveOfTheOutputsReadingIsNoLoss) {
  survey("a wave of a reading", 89000, RowOrder::kShuffled, 0.85, [](DrawnBench& bench, int) {
    return wave(
        bench, [](const DrawnRow&) { return 1.0; }, "reading of the output's torque", true);
  });
}

TEST(JudgedOnBenches, AZeroThatSwingsWithTheTimeHasAPeriodInRows) {
  survey("a zero that swings with the time", 89500, RowOrder::kShuffled, 0.8,
         [](DrawnBench& bench, int) {
           bench.with_angle = true;
           const double period = bench.between(12.0, 25.0),
                        most = bench.noise_output_nm * bench.between(5.0, 10.0);
           Hidden hidden;
           hidden.truth = std::to_string(period) + " rows, " + std::to_string(most) + " N m";
           hidden.reading = [=](const DrawnRow& row) {
             return most * std::sin(6.283185307179586 * row.row / period + 1.0);
           };
           hidden.is_right = [=](const loop::LoopResult& result) {
             const loop::FoundEffect* form = alone_with(result, "period_rows");
             return form != nullptr && is_about(*form, "period_rows", period, 0.05) &&
                    is_about(*form, "reads_more_nm", most, 0.2);
           };
           return hidden;
         });
}

TEST(JudgedOnBenches, ALossThatBeginsAtAPowerIsOneForm) {
  survey("a loss from a power on", 90000, RowOrder::kShuffled, 0.85, [](DrawnBench& bench, int) {
    const double from = bench.between(0.25, 0.45),
                 most = bench.scatter_nm() * bench.between(8.0, 15.0);
    Hidden hidden;
    hidden.truth = std::to_string(100.0 * from) + " %, " + std::to_string(most) + " N m";
    hidden.loss = [=](const DrawnRow& row) {
      return most * std::max(0.0, row.share * row.rpm / 3000.0 - from) / (1.0 - from);
    };
    hidden.is_right = [=](const loop::LoopResult& result) {
      const loop::FoundEffect* form = with_figure(result, "share_of_power_percent");
      return form != nullptr && result.effects.size() <= 2 &&
             is_about(*form, "share_of_power_percent", 100.0 * from, 0.25) &&
             is_about(*form, "amplitude_nm", most, 0.2);
    };
    return hidden;
  });
}

TEST(JudgedOnBenches, WhereRowsScatterMoreIsANoteAndNoEffect) {
  Answers answers;
  for (int run = 1; run <= kOfEach; ++run) {
    const std::uint64_t seed = 91000 + static_cast<std::uint64_t>(run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double below = bench.between(0.25, 0.5) * 3000.0, times = bench.between(3.0, 5.0);
    bench.noise_factor = [=](const DrawnRow& row) { return row.rpm < below ? times : 1.0; };
    const auto closed = loop::close_drive_loop(bench.model(), bench.data(nothing));
    const auto noted = [&](const char* words) {
      return closed && std::any_of(closed->result.notes.begin(), closed->result.notes.end(),
                                   [&](const std::string& note) {
                                     return note.find(words) != std::string::npos;
                                   });
    };
    answers.add(seed, "below " + std::to_string(below) + " rpm", closed,
                closed && closed->result.effects.empty() && noted("up to a speed of"));
  }
  std::printf("rows that scatter more: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(JudgedOnBenches, RowsThatScatterAlikeHaveNoSuchNote) {
  Answers answers;
  for (int run = 1; run <= 2 * kOfEach; ++run) {
    const std::uint64_t seed = 92000 + static_cast<std::uint64_t>(run);
    DrawnBench bench(seed, run % 2 == 0 ? RowOrder::kShuffled : RowOrder::kUpAndDown);
    bench.with_angle = true;
    bench.warm_up();
    const auto closed = loop::close_drive_loop(bench.model(), bench.data(nothing));
    answers.add(seed, "nothing", closed,
                closed && closed->result.effects.empty() && closed->result.notes.empty());
  }
  std::printf("quiet: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.96)) << answers.text();
}

}  // namespace
}  // namespace trueflank::test
