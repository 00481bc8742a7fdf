// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// Benches drawn anew: what one file of several has, a reading that goes no lower, a reading that
// stays behind the load, a friction by a power of the speed, losses that grow with the warmth or
// fill up slowly, a gain that creeps; and loads that are held over rows, whose scatter is no way.
namespace trueflank::test {
namespace {

double nothing(const DrawnRow&) { return 0.0; }

bool has_a_name(const ClosedBench& closed, const std::string& id) {
  return closed && std::any_of(closed->result.effects.begin(), closed->result.effects.end(),
                               [&](const auto& e) { return e.id == id; });
}

TEST(LimitsAndFilesOnBenches, AZeroThatOneFileForgotIsOfThatFileWherePowerIsGainedToo) {
  expect_all(13000, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 240);
    const double zero = bench.noise_output_nm * bench.between(6.0, 9.0);
    loop::BenchData data = as_days(bench.data(nothing), 2);
    for (loop::BenchRow& row : data.rows)
      if (row.file == 1) row.output_nm += zero;
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, "zero of " + std::to_string(zero), closed,
                leaves_noise(closed, bench) && says(closed, "that one file has: in day2.csv") &&
                    is_told_once(closed, "reads_more_nm", zero));
  });
}

TEST(LimitsAndFilesOnBenches, ThickerOilOfOneFileGrowsWithTheSpeed) {
  expect_all(13100, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 260);
    const double slope = bench.scatter_nm() * bench.between(4.0, 6.0),
                 more = slope * bench.between(1.0, 1.5);
    const auto closed = loop::close_drive_loop(
        bench.model(), as_days(bench.data([&](const DrawnRow& r) {
          const bool second = 2 * static_cast<std::size_t>(r.row) >= bench.rows.size();
          return (slope + (second ? more : 0.0)) * r.rpm / 3000.0;
        }),
                               2));
    const loop::FoundEffect* name = closed ? with_figure(closed->result, "nm_per_rpm") : nullptr;
    answers.add(seed, "more of " + std::to_string(more), closed,
                leaves_noise(closed, bench) && says(closed, "at the largest speed") &&
                    name != nullptr && name->id == "viscous_drag" &&
                    closed->result.effects.size() == 2);
  });
}

TEST(LimitsAndFilesOnBenches, AReadingThatGoesNoLowerIsAFloor) {
  expect_all(13200, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 240);
    const double floor = bench.most_output_nm * bench.between(0.22, 0.3);
    loop::BenchData data = bench.data(nothing);
    for (loop::BenchRow& row : data.rows) row.output_nm = std::max(row.output_nm, floor);
    const auto closed = loop::close_drive_loop(bench.model(), data);
    answers.add(seed, "floor at " + std::to_string(floor), closed,
                leaves_noise(closed, bench) && says(closed, "reads no less than") &&
                    is_told_once(closed, "least_it_reads_nm", floor));
  });
}

TEST(LimitsAndFilesOnBenches, AReadingThatStaysBehindTheLoadStandsStillWhereItTurns) {
  expect_all(13300, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 260);
    const double behind = bench.noise_output_nm * bench.between(4.0, 6.0);
    double share = 0.5, to = 0.5, step = 0.0, read = 0.5 * bench.most_output_nm;
    for (DrawnRow& row : bench.rows) {
      if ((to - share) * step <= 0.0) {
        to = bench.between(0.12, 1.0);
        step = (to - share) / bench.whole(5, 12);
      }
      share += step;
      row.share = share;
      row.output_nm = share * bench.most_output_nm;
    }
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data(nothing, 0.1, [&](const DrawnRow& r) {
          read = std::clamp(read, r.output_nm - behind, r.output_nm + behind);
          return read - r.output_nm;
        }));
    answers.add(seed, "behind by " + std::to_string(behind), closed,
                leaves_noise(closed, bench) && says(closed, "stays behind the load") &&
                    is_told_once(closed, "to_either_side_nm", behind));
  });
}

TEST(LimitsAndFilesOnBenches, AFrictionByAPowerOfTheSpeedIsOne) {
  expect_all(13400, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 260);
    const double power = bench.between(0.18, 0.28), middle = std::sqrt(40.0 * 2800.0);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data(
                           nothing,
                           [&](const DrawnRow& r) { return 0.1 * std::pow(r.rpm / middle, -power); },
                           nothing));
    answers.add(seed, "power of " + std::to_string(power), closed,
                leaves_noise(closed, bench) && says(closed, "by a power of the speed") &&
                    !has_a_name(closed, "mixed_friction") &&
                    is_told_once(closed, "exponent", power));
  });
}

TEST(LimitsAndFilesOnBenches, ALossThatGrowsWithTheWarmthDoublesEverySoManyDegrees) {
  expect_all(13500, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 260);
    bench.any_warmth();
    const auto most = std::max_element(
        bench.rows.begin(), bench.rows.end(),
        [](const DrawnRow& a, const DrawnRow& b) { return a.warm_c < b.warm_c; });
    const double hottest = most->warm_c, within = bench.between(3.5, 5.0),
                 size = bench.scatter_nm() * bench.between(9.0, 12.0);
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
          return size * std::exp((r.warm_c - hottest) / within);
        }));
    answers.add(seed, "e times within " + std::to_string(within), closed,
                leaves_noise(closed, bench) && says(closed, "ever faster with the temperature") &&
                    is_told_once(closed, "doubles_within_c", std::log(2.0) * within));
  });
}

TEST(LimitsAndFilesOnBenches, ALossThatFillsUpSlowlyNeedsNoFrictionBesideIt) {
  expect_all(13600, 2, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 300);
    const double size = bench.scatter_nm() * bench.between(14.0, 18.0),
                 half = bench.between(0.15, 0.25);
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return size * r.share / (r.share + half);
    }));
    answers.add(seed, "half of it within " + std::to_string(half), closed,
                leaves_noise(closed, bench) && says(closed, "and saturates") &&
                    !has_a_name(closed, "friction_coefficient") &&
                    is_told_once(closed, "amplitude_nm", size));
  });
}

// Two forms that do nearly the same cancelled: a gain of 0 % beside 11 N m more and 12 N m less.
TEST(LimitsAndFilesOnBenches, AGainThatCreepsIsToldOnce) {
  expect_all(13700, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 300);
    const double gain = bench.between(0.015, 0.025);
    const auto closed = loop::close_drive_loop(
        bench.model(), bench.data(nothing, 0.1, [&](const DrawnRow& r) {
          return gain * r.output_nm * r.row / static_cast<double>(bench.rows.size());
        }));
    answers.add(seed, "creeps by " + std::to_string(gain), closed,
                leaves_noise(closed, bench) && closed->result.effects.size() == 1 &&
                    is_told_once(closed, "gain_changes_percent", 100.0 * gain));
  });
}

// A load that is held scatters by its sensor's noise, which is in the loss too.
TEST(LimitsAndFilesOnBenches, ScatterOfAHeldLoadIsNoWay) {
  const FormDraw draw = [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 320);
    bench.noise_input_nm = 2.0 * bench.noise_output_nm / bench.ratio;
    double share = 0.5;
    int held = 0;
    for (DrawnRow& row : bench.rows) {
      if (held-- == 0) {
        share = bench.between(0.12, 1.0);
        held = bench.whole(5, 8);
      }
      row.share = share;
      row.output_nm = share * bench.most_output_nm;
    }
    const auto closed = loop::close_drive_loop(bench.model(), bench.data(nothing));
    answers.add(seed, "nothing", closed, closed && closed->result.effects.empty());
  };
  // (the first of each was told a loss that differs with the way of the load)
  expect_all(13820, 2, draw);
  expect_all(13838, 2, draw);
}

// Beside a form that leaves nothing but noise a second one is found by chance, which few rows
// follow: the first is told all the same.
TEST(LimitsAndFilesOnBenches, RowsInAnotherUnitAreABlock) {
  expect_all(14037, 1, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, true, 300);
    const int from = static_cast<int>(300.0 * bench.between(0.3, 0.5)),
              to = from + static_cast<int>(300.0 * bench.between(0.15, 0.25));
    const auto closed =
        loop::close_drive_loop(bench.model(), bench.data(nothing, 0.1, [&](const DrawnRow& r) {
          return r.row >= from && r.row < to ? (0.73756 - 1.0) * r.output_nm : 0.0;
        }));
    answers.add(seed, "from line " + std::to_string(from + 2), closed,
                leaves_noise(closed, bench) && says(closed, "over a block of the run") &&
                    is_told_once(closed, "from_line", from + 2));
  });
}

}  // namespace
}  // namespace trueflank::test
