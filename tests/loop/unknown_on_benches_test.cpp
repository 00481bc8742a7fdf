// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/bench_answers.h"
#include "tests/loop/drawn_bench.h"
#include "tests/support/survey_size.h"

// What no effect of the library does, on random benches: told as one form with its size and place,
// and nothing where nothing is.
namespace trueflank::test {
namespace {

const int kBenches = survey_size(4, 160);

/// Which branch of a hysteresis a row stands on: it goes over at once where the load turns, what
/// stands there stays on the one it came by (`as_it_came`) or counts as risen.
std::vector<int> branches(const DrawnBench& bench, bool as_it_came) {
  std::vector<int> branch;
  for (const DrawnRow& row : bench.rows) {
    const double before = branch.empty() ? -1.0 : bench.rows[branch.size() - 1].share;
    branch.push_back(row.share > before   ? 1
                     : row.share < before ? -1
                     : as_it_came         ? branch.back()
                                          : 1);
  }
  return branch;
}

TEST(UnknownOnBenches, AHysteresisOfConstantWidthIsToldWithItsWidthWhateverStandsAtTheTurns) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(51000 + run);
    DrawnBench bench(seed, RowOrder::kStandsAtTurns);
    const bool as_it_came = run % 2 == 0;
    const double half = bench.noise_output_nm * bench.between(1.5, 5.0);
    const std::vector<int> branch = branches(bench, as_it_came);
    const auto data = bench.data(
        [](const DrawnRow&) { return 0.0; }, 0.1,
        [&](const DrawnRow& row) { return half * branch[static_cast<std::size_t>(row.row)]; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "to_either_side_nm") : nullptr;
    answers.add(seed,
                "half " + std::to_string(half) + (as_it_came ? " as it came" : " as it rises"),
                closed,
                form != nullptr && closed->result.effects.size() == 1 &&
                    is_about(*form, "to_either_side_nm", half, 0.12) &&
                    closed->result.structure_left.find("losses beside") == std::string::npos &&
                    form->sentence.find("middle of the range") == std::string::npos);
  }
  std::printf("hysteresis of constant width: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.95)) << answers.text();
}

TEST(UnknownOnBenches, AHysteresisThatGoesOverByAndByLeavesNoStructure) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(52000 + run);
    DrawnBench bench(seed, RowOrder::kStandsAtTurns);
    // Friction inside a sensor: it drags behind the load by up to so much.
    const double play = bench.between(0.06, 0.3),
                 half = bench.noise_output_nm * bench.between(2.0, 5.0);
    double dragged = 0.0;
    std::vector<double> error;
    for (const DrawnRow& row : bench.rows) {
      dragged = std::clamp(dragged, row.share - play, row.share + play);
      error.push_back(half * (row.share - dragged) / play);
    }
    const auto data =
        bench.data([](const DrawnRow&) { return 0.0; }, 0.1,
                   [&](const DrawnRow& row) { return error[static_cast<std::size_t>(row.row)]; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "to_either_side_nm") : nullptr;
    // Loads stand too far apart to show all of the way over: the width within a quarter.
    answers.add(seed, "half " + std::to_string(half) + " play " + std::to_string(play), closed,
                form != nullptr && is_about(*form, "to_either_side_nm", half, 0.25) &&
                    (closed->result.verdict != loop::Verdict::kExplained ||
                     closed->result.noise < 1.3 * bench.noise_output_nm));
  }
  std::printf("hysteresis with play: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

DrawnBench::Loss nothing() {
  return [](const DrawnRow&) { return 0.0; };
}

TEST(UnknownOnBenches, FlanksThatRubMoreFromASpeedOnAreOneFormAndNoMesh) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(54000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double from = bench.between(bench.rpm[1], bench.rpm[bench.rpm.size() - 4]),
                 more = 0.1 * bench.between(0.3, 0.8);
    const auto data = bench.data(
        nothing(),
        [&](const DrawnRow& row) {
          return 0.1 + more * std::max(0.0, row.rpm - from) / (bench.rpm.back() - from);
        },
        nothing());
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "coefficient_change") : nullptr;
    answers.add(seed, "from " + std::to_string(from) + " rpm " + std::to_string(more) + " more",
                closed,
                form != nullptr && closed->result.effects.size() == 1 &&
                    is_about(*form, "coefficient_change", more, 0.2) &&
                    is_about(*form, "begins_at_rpm", from, 0.25) &&
                    form->sentence.find("rub more from") != std::string::npos);
  }
  std::printf("flanks that rub more from a speed on: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

TEST(UnknownOnBenches, FlanksThatRubLessTheWarmerTheyAreSayTheirCoefficientAtEitherEnd) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(55000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    // Flanks that lose next to nothing do not show what they do.
    if (1.0 - bench.model().efficiency({0.1}).forward < 0.025) continue;
    bench.warm_up();
    const double rate = bench.between(0.008, 0.02) * (run % 2 == 0 ? 1.0 : -1.0);
    const auto mu = [&](double c) { return 0.1 * std::exp(-rate * (c - 35.0)); };
    const auto data = bench.data(
        nothing(), [&](const DrawnRow& row) { return mu(row.warm_c); }, nothing());
    const auto closed = loop::close_drive_loop(bench.model(), data);
    double low = 1e300, high = -1e300;
    for (const DrawnRow& row : bench.rows) {
      low = std::min(low, row.warm_c);
      high = std::max(high, row.warm_c);
    }
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "coefficient_change") : nullptr;
    const double change = std::abs(mu(low) - mu(high));
    answers.add(seed, "coefficient changes by " + std::to_string(change), closed,
                form != nullptr && is_about(*form, "coefficient_change", change, 0.25) &&
                    form->sentence.find(rate > 0.0 ? "rub less" : "rub more") != std::string::npos);
  }
  std::printf("friction that follows the warmth: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(UnknownOnBenches, AZeroThatFollowsTheWarmthIsOneReadingWithItsSign) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(56000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.warm_up();
    const double per_c =
                     bench.noise_output_nm * bench.between(0.15, 0.5) * (run % 2 == 0 ? 1.0 : -1.0),
                 drag = bench.scatter_nm() * bench.between(0.0, 5.0);
    const auto data = bench.data([&](const DrawnRow&) { return drag; }, 0.1,
                                 [&](const DrawnRow& row) { return per_c * (row.warm_c - 25.0); });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "reads_more_nm_per_c") : nullptr;
    answers.add(
        seed, std::to_string(per_c) + " N m per C", closed,
        form != nullptr && is_about(*form, "reads_more_nm_per_c", per_c, 0.2) &&
            form->sentence.find(per_c > 0.0 ? "reads more" : "reads less") != std::string::npos);
  }
  std::printf("a zero that follows the warmth: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.9)) << answers.text();
}

TEST(UnknownOnBenches, AResonanceLeavesTheViscousDragBesideItItsName) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(57000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double at = bench.between(bench.rpm[2], bench.rpm[bench.rpm.size() - 3]),
                 half = bench.between(250.0, 500.0),
                 most = bench.scatter_nm() * bench.between(5.0, 9.0),
                 per_rpm = bench.scatter_nm() * bench.between(3.0, 10.0) / 3000.0;
    const auto data = bench.data([&](const DrawnRow& row) {
      const double x = (row.rpm - at) / half;
      return most / (1.0 + x * x) + per_rpm * row.rpm;
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form =
        closed ? with_figure(closed->result, "half_width_rpm") : nullptr;
    const loop::FoundEffect* drag = nullptr;
    if (closed)
      for (const loop::FoundEffect& effect : closed->result.effects)
        if (effect.id == "viscous_drag" || effect.id == "bearing_friction") drag = &effect;
    answers.add(seed,
                "resonance at " + std::to_string(at) + ", half width " + std::to_string(half) +
                    ", viscous " + std::to_string(per_rpm),
                closed,
                form != nullptr && drag != nullptr && closed->result.effects.size() <= 3 &&
                    is_about(*form, "at_rpm", at, 0.15));
  }
  std::printf("a resonance beside a viscous drag: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(UnknownOnBenches, AScaleIsNoFrictionThatWouldBeNextToNothingInOneDirection) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(58000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    const double off = bench.between(0.02, 0.04) * (run % 2 == 0 ? 1.0 : -1.0),
                 drag = bench.scatter_nm() * bench.between(4.0, 9.0);
    const auto data = bench.data([&](const DrawnRow&) { return drag; }, 0.1,
                                 [&](const DrawnRow& row) { return off * row.output_nm; });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    bool scale = false, other = false;
    if (closed)
      for (const loop::FoundEffect& effect : closed->result.effects) {
        scale =
            scale || (effect.id == "torque_scale" && is_about(effect, "factor", 1.0 + off, 0.01) &&
                      effect.sentence.find(off > 0.0 ? "too much against" : "too little against") !=
                          std::string::npos);
        if (effect.id == "direction_dependent_friction") {
          // Of flanks of 0.1 that lose little a small scale may be a likely difference.
          const loop::Parameter* p = parameter(effect, "difference");
          other = other || p == nullptr || std::abs(p->value) > 0.1 ||
                  effect.sentence.find("is ruled out") == std::string::npos;
        }
      }
    answers.add(seed, "factor " + std::to_string(1.0 + off), closed, (scale || !other) && !other);
  }
  std::printf("a scale: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.97)) << answers.text();
}

TEST(UnknownOnBenches, ABurrThatRubsInAShortPartOfATurnIsNoOutlier) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(59000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.with_angle = true;
    const double at = bench.between(0.0, 1.0), half = bench.between(0.03, 0.05),
                 most = bench.scatter_nm() * bench.between(8.0, 14.0);
    const auto data = bench.data([&](const DrawnRow& row) {
      double off = row.input_turns - at;
      off -= std::round(off);
      return most * std::exp(-off * off / (half * half));
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    const loop::FoundEffect* form = closed ? with_figure(closed->result, "at_deg") : nullptr;
    double away = 1e300;
    if (form != nullptr) {
      away = parameter(*form, "at_deg")->value / 360.0 - at;
      away = 360.0 * std::abs(away - std::round(away));
    }
    answers.add(seed, "burr at " + std::to_string(360.0 * at) + " degrees", closed,
                away < 6.0 && closed->result.outliers <= 3);
  }
  std::printf("a burr: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.85)) << answers.text();
}

TEST(UnknownOnBenches, CoarseReadingsOfNothingAreQuietAndNoOutliers) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(60000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    auto data = bench.data(nothing());
    const double output_step = bench.noise_output_nm * bench.between(1.0, 3.0),
                 input_step = output_step / bench.ratio * bench.between(0.1, 0.6);
    for (loop::BenchRow& row : data.rows) {
      row.output_nm = output_step * std::round(row.output_nm / output_step);
      row.input_nm = input_step * std::round(row.input_nm / input_step);
    }
    std::erase_if(data.rows, [](const loop::BenchRow& row) {
      return !(row.output_nm > 0.0) || !(row.input_nm > 0.0);
    });
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, "nothing, in steps of " + std::to_string(output_step), closed,
                closed && closed->result.verdict == loop::Verdict::kNoEffect &&
                    closed->result.outliers == 0);
  }
  std::printf("coarse readings of nothing: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.94)) << answers.text();
}

TEST(UnknownOnBenches, SlipsOfASensorAreLeftOutAsBefore) {
  Answers answers;
  for (int run = 1; run <= kBenches; ++run) {
    const auto seed = static_cast<std::uint64_t>(61000 + run);
    DrawnBench bench(seed, RowOrder::kShuffled);
    bench.with_angle = true;
    auto data = bench.data(nothing());
    const int slips = bench.whole(1, 3);
    for (int k = 0; k < slips; ++k) {
      loop::BenchRow& row = data.rows[static_cast<std::size_t>(
          bench.whole(0, static_cast<int>(data.rows.size()) - 1))];
      row.output_nm +=
          (k % 2 == 0 ? 1.0 : -0.5) * bench.noise_output_nm * bench.between(15.0, 60.0);
      row.output_nm = std::abs(row.output_nm);
    }
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, std::to_string(slips) + " slips", closed,
                closed && closed->result.verdict == loop::Verdict::kNoEffect &&
                    closed->result.outliers >= 1);
  }
  std::printf("slips: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.94)) << answers.text();
}

TEST(UnknownOnBenches, NoiseAloneHasNoName) {
  Answers answers;
  for (int run = 1; run <= survey_size(12, 320); ++run) {
    const auto seed = static_cast<std::uint64_t>(53000 + run);
    DrawnBench bench(seed, run % 2 == 0 ? RowOrder::kStandsAtTurns : RowOrder::kShuffled);
    if (run % 4 < 2) bench.warm_up();
    const auto closed = loop::close_drive_loop(bench.model(), bench.data(nothing()));
    answers.add(seed, "nothing", closed,
                closed && closed->result.verdict == loop::Verdict::kNoEffect);
  }
  std::printf("nothing: %s", answers.text().c_str());
  EXPECT_GE(answers.right, answers.seldom_fewer(0.97)) << answers.text();
}

}  // namespace
}  // namespace trueflank::test
