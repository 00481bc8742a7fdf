// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/told_as_one_form.h"

// Benches drawn anew whose loss follows what the rows before were, how fast something changes, or
// an angle that is read late. Each is told as one effect with its size and how long it lasts.
namespace trueflank::test {
namespace {

using Quantity = double (*)(const DrawnRow&);
double speed_of(const DrawnRow& r) { return r.rpm; }
double load_of(const DrawnRow& r) { return r.output_nm; }

/// A store of which a share is renewed by every row; what it holds when the row comes. Of the first
/// rows it is the mean of what there was.
std::vector<double> held_before(const DrawnBench& bench, Quantity quantity, double rows) {
  const double kept = std::exp(-1.0 / rows);
  std::vector<double> held;
  double sum = 0.0, of = 0.0;
  for (const DrawnRow& r : bench.rows) {
    held.push_back(of > 0.0 ? sum / of : quantity(r));
    sum = kept * sum + quantity(r);
    of = kept * of + 1.0;
  }
  return held;
}

/// 0 ... 1 over the rows.
std::vector<double> from_least(std::vector<double> values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double from = *least, range = *most - *least;
  for (double& v : values) v = (v - from) / range;
  return values;
}

/// Speeds, loads or temperatures that wander as those of a log do.
template <class Set>
void wander(DrawnBench& bench, double rows, const Set& set) {
  const double kept = std::exp(-1.0 / rows);
  double x = bench.between(-1.0, 1.0);
  for (DrawnRow& r : bench.rows) {
    // (six even draws make a normal one, nearly)
    double normal = 0.0;
    for (int k = 0; k < 6; ++k) normal += bench.between(-0.7071, 0.7071);
    x = kept * x + std::sqrt(1.0 - kept * kept) * normal;
    set(r, 0.5 * (1.0 + std::erf(x / std::sqrt(2.0))));
  }
}
void wander_in_speed(DrawnBench& bench) {
  wander(bench, bench.between(6.0, 20.0),
         [](DrawnRow& r, double share) { r.rpm = 40.0 * std::pow(70.0, share); });
}

TEST(MemoriesOnBenches, ALossThatFollowsTheSpeedOfTheRowsBeforeIsOneForm) {
  expect_all(9800, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, seed % 2 == 0, 400);
    wander_in_speed(bench);
    const double size = bench.scatter_nm() * bench.between(7.0, 14.0),
                 rows = bench.between(3.0, 15.0);
    const std::vector<double> held = from_least(held_before(bench, speed_of, rows));
    closes_as(answers, seed, "speed of " + std::to_string(rows) + " rows", bench,
              [&](const DrawnRow& r) {
                const double share = held[static_cast<std::size_t>(r.row)];
                return size * (seed % 3 == 0 ? 1.0 - share : share);
              },
              {{"amplitude_nm", size}, {"fades_within_rows", rows}});
  });
}

TEST(MemoriesOnBenches, ALossThatFollowsTheLoadOfTheRowsBeforeIsOneForm) {
  expect_all(9900, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 300);
    bench.noise_input_nm *= 0.2;
    const double size = bench.scatter_nm() * bench.between(8.0, 14.0),
                 rows = bench.between(3.0, 8.0);
    const std::vector<double> held = from_least(held_before(bench, load_of, rows));
    closes_as(answers, seed, "load of " + std::to_string(rows) + " rows", bench,
              [&](const DrawnRow& r) { return size * held[static_cast<std::size_t>(r.row)]; },
              {{"amplitude_nm", size}, {"fades_within_rows", rows}});
  });
}

TEST(MemoriesOnBenches, WhatTurnsTakesTorqueWhileItIsSpedUp) {
  expect_all(10000, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 220);
    const double size = bench.scatter_nm() * bench.between(7.0, 14.0);
    double most = 0.0;
    for (std::size_t i = 1; i < bench.rows.size(); ++i)
      most = std::max(most, std::abs(bench.rows[i].rpm - bench.rows[i - 1].rpm));
    closes_as(answers, seed, "inertia", bench,
              [&](const DrawnRow& r) {
                const auto at = static_cast<std::size_t>(r.row);
                return at == 0 ? 0.0 : size * (r.rpm - bench.rows[at - 1].rpm) / most;
              },
              {{"amplitude_nm", size}, {"change_rpm", most}});
  });
}

TEST(MemoriesOnBenches, WhatGoesWithHowFastTheTemperatureChangesIsNoWave) {
  expect_all(10100, 4, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 320);
    bench.with_temperature = true;
    const double size = bench.scatter_nm() * bench.between(8.0, 14.0);
    wander(bench, 40.0, [](DrawnRow& r, double share) { r.warm_c = share; });
    // The slow course of a room that is smoothed twice, of which the rate is known.
    std::vector<double> smooth{0.5, 0.5}, rate{0.0, 0.0};
    double speed = 0.0;
    for (std::size_t i = 2; i < bench.rows.size(); ++i) {
      speed += 0.02 * (bench.rows[i].warm_c - smooth.back()) - 0.15 * speed;
      smooth.push_back(smooth.back() + speed);
      rate.push_back(speed);
    }
    double most = 0.0;
    for (const double r : rate) most = std::max(most, std::abs(r));
    for (std::size_t i = 0; i < bench.rows.size(); ++i)
      bench.rows[i].warm_c =
          0.1 * std::round(10.0 * (30.0 + 0.8 / most * smooth[i] + bench.between(-0.2, 0.2)));
    const auto closed = loop::close_drive_loop(bench.model(), bench.data([&](const DrawnRow& r) {
      return size * rate[static_cast<std::size_t>(r.row)] / most;
    }));
    answers.add(seed, "rate of the temperature", closed,
                leaves_noise(closed, bench) && is_told_once(closed, "amplitude_nm", size) &&
                    closed->result.effects.front().sentence.find(
                        "by how fast the temperature changes") != std::string::npos);
  });
}

TEST(MemoriesOnBenches, AWaveWhosePhaseGoesWithTheSpeedIsReadLate) {
  expect_all(10200, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 300);
    bench.with_angle = true;
    const double size = bench.scatter_nm() * bench.between(6.0, 12.0), order = bench.whole(1, 5),
                 phase = bench.between(0.0, 1.0), late_ms = bench.between(2.0, 12.0) / order;
    closes_as(answers, seed, "order " + std::to_string(order) + ", " + std::to_string(late_ms),
              bench,
              [&](const DrawnRow& r) {
                const double turns_late = r.rpm / 60.0 * 1e-3 * late_ms;
                return size * std::cos(2.0 * M_PI * (order * (r.input_turns - turns_late) - phase));
              },
              {{"amplitude_nm", size}, {"order", order}, {"later_ms", late_ms}});
  });
}

TEST(MemoriesOnBenches, AWaveWhosePhaseGoesWithTheLoadWindsUp) {
  expect_all(10300, 3, [](Answers& answers, std::uint64_t seed) {
    DrawnBench bench = any_rows(seed, false, 300);
    bench.with_angle = true;
    bench.noise_input_nm *= 0.2;
    const double size = bench.scatter_nm() * bench.between(6.0, 12.0), order = bench.whole(1, 5),
                 phase = bench.between(0.0, 1.0),
                 late = bench.between(0.3, 0.9) * (seed % 2 == 0 ? 1.0 : -1.0);
    closes_as(answers, seed, "order " + std::to_string(order) + ", " + std::to_string(late), bench,
              [&](const DrawnRow& r) {
                return size *
                       std::cos(2.0 * M_PI * (order * r.input_turns - phase - late * r.share));
              },
              {{"amplitude_nm", size}, {"order", order}});
  });
}

}  // namespace
}  // namespace trueflank::test
