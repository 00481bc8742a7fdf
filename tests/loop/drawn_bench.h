// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "trueflank/loop/drive/close_drive_loop.h"

// Benches drawn anew for every seed: ratio, efficiencies, loads, speeds, order of the rows and
// noise. The drive is two numbers that lose a share of the torque; what it loses besides is a
// function of the test. Shares no formula with trueflank/loop.
namespace trueflank::test {

/// kStandsAtTurns: up and down, and the load stands for one to three rows where it turns.
enum class RowOrder { kShuffled, kUpAndDown, kRuns, kStandsAtTurns };

/// One row as it was driven.
struct DrawnRow {
  bool forward = true;
  double rpm = 0.0;
  double output_nm = 0.0;
  double share = 0.0;  ///< of the largest load
  double input_turns = 0.0;
  int row = 0;
  int since_turn = 0;  ///< rows since the direction changed
  int way = 0;         ///< of the load
  double warm_c = 0.0;  ///< temperature
};

class DrawnBench {
 public:
  DrawnBench(std::uint64_t seed, RowOrder order) : random_(seed) {
    ratio = between(3.0, 40.0);
    most_output_nm = 10.0 * ratio * between(0.3, 3.0);
    forward_loss_ = between(0.01, 0.06);
    backward_loss_ = forward_loss_ * between(1.0, 1.3);
    noise_output_nm = 0.003 * most_output_nm;
    noise_input_nm = 0.2 * noise_output_nm / ratio;
    const int loads = 6 + static_cast<int>(between(0.0, 3.0)),
              speeds = 7 + static_cast<int>(between(0.0, 4.0));
    for (int k = 0; k < loads; ++k)
      load_shares.push_back(0.06 + 0.94 *
                                       (k + (k > 0 && k + 1 < loads ? between(-0.25, 0.25) : 0.0)) /
                                       (loads - 1.0));
    for (int k = 0; k < speeds; ++k)
      rpm.push_back(120.0 + 2880.0 * (k + (k > 0 && k + 1 < speeds ? between(-0.25, 0.25) : 0.0)) /
                                (speeds - 1.0));
    lay_out(order);
  }

  [[nodiscard]] double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] int whole(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random_);
  }

  /// Scatter of one row as a torque at the input.
  [[nodiscard]] double scatter_nm() const { return noise_output_nm / ratio; }

  /// The model that the user holds: the drive without what the test hides.
  [[nodiscard]] loop::DriveModel model() const {
    loop::DriveModel m;
    m.ratio = ratio;
    m.friction = 0.1;
    m.meshes = {"one"};
    const double f = 10.0 * forward_loss_, b = 10.0 * backward_loss_;
    m.efficiency = [f, b](const std::vector<double>& mu) {
      return loop::DriveEfficiency{1.0 - f * mu[0], 1.0 - b * mu[0]};
    };
    m.orders = {
        {"input", 1.0}, {"output", 1.0 / ratio}, {"planet against the carrier", planet_order}};
    return m;
  }

  using Loss = std::function<double(const DrawnRow&)>;
  /// Temperatures that rise over the run and wander meanwhile.
  void warm_up() {
    std::normal_distribution<double> normal;
    with_temperature = true;
    const double start = between(18.0, 26.0), span = between(15.0, 35.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double run = static_cast<double>(i) / static_cast<double>(rows.size());
      rows[i].warm_c =
          0.1 *
          std::round(10.0 * (start + span * (1.0 - std::exp(-3.0 * run)) + 4.0 * normal(random_)));
    }
  }

  /// Angles that go to and fro, so far to either side at the output.
  void swing_to_and_fro(double output_deg) {
    with_angle = true;
    double phase = between(0.0, 6.28);
    for (DrawnRow& row : rows) {
      phase += between(0.1, 0.9);
      row.input_turns = ratio * output_deg / 360.0 * std::sin(phase);
    }
  }

  /// Temperatures of a bench that is warm or cold as it comes.
  void any_warmth() {
    with_temperature = true;
    const double start = between(18.0, 28.0), span = between(15.0, 30.0);
    for (DrawnRow& row : rows)
      row.warm_c = 0.1 * std::round(10.0 * (start + span * between(0.0, 1.0)));
  }

  /// Readings with a loss at the input, a friction in place of the model's 0.1, and an error of the
  /// output's reading.
  [[nodiscard]] loop::BenchData data(
      const Loss& loss_nm, double friction = 0.1,
      const Loss& output_error_nm = [](const DrawnRow&) { return 0.0; }) {
    return data(
        loss_nm, [friction](const DrawnRow&) { return friction; }, output_error_nm);
  }
  /// The same with a friction of every row.
  [[nodiscard]] loop::BenchData data(const Loss& loss_nm, const Loss& friction_of,
                                     const Loss& output_error_nm) {
    std::normal_distribution<double> normal;
    loop::BenchData data;
    data.files = {"bench.csv"};
    for (const DrawnRow& row : rows) {
      const double friction = friction_of(row), loss = loss_nm(row),
                   f = 1.0 - 10.0 * forward_loss_ * friction,
                   b = 1.0 - 10.0 * backward_loss_ * friction;
      loop::BenchRow read;
      read.forward = row.forward;
      read.speed_rpm = row.rpm;
      read.input_nm =
          (row.forward ? row.output_nm / (ratio * f) + loss : row.output_nm * b / ratio - loss) +
          noise_input_nm * normal(random_);
      read.output_nm = row.output_nm + output_error_nm(row) +
                       noise_factor(row) * noise_output_nm * normal(random_);
      if (!row.forward)
        read.input_nm += noise_factor(row) * 0.5 * noise_output_nm / ratio * normal(random_);
      if (with_temperature) read.temperature_c = row.warm_c;
      if (with_angle) read.angle_deg = 360.0 * row.input_turns;
      read.line = row.row + 2;
      if (read.input_nm > 0.0 && read.output_nm > 0.0) data.rows.push_back(read);
    }
    return data;
  }

  double ratio = 1.0, most_output_nm = 1.0, noise_output_nm = 0.0, noise_input_nm = 0.0,
         planet_order = 0.5333;
  bool with_angle = false, with_temperature = false;
  /// How much noisier a row is than the bench.
  Loss noise_factor = [](const DrawnRow&) { return 1.0; };
  std::vector<double> load_shares, rpm;
  std::vector<DrawnRow> rows;

 private:
  void lay_out(RowOrder order) {
    std::vector<DrawnRow> all;
    const auto add = [&](std::vector<DrawnRow>& to, bool forward, double speed, double share) {
      to.push_back(
          {.forward = forward, .rpm = speed, .output_nm = share * most_output_nm, .share = share});
    };
    if (order == RowOrder::kShuffled)
      for (int repeat = 0; repeat < 3; ++repeat) {
        std::vector<DrawnRow> once;
        for (const bool forward : {true, false})
          for (const double speed : rpm)
            for (const double share : load_shares) add(once, forward, speed, share);
        std::shuffle(once.begin(), once.end(), random_);
        all.insert(all.end(), once.begin(), once.end());
      }
    if (order == RowOrder::kUpAndDown)
      for (int repeat = 0; repeat < 2; ++repeat)
        for (const bool forward : {true, false})
          for (const double speed : rpm) {
            for (const double share : load_shares) add(all, forward, speed, share);
            for (auto share = load_shares.rbegin() + 1; share != load_shares.rend(); ++share)
              add(all, forward, speed, *share);
          }
    if (order == RowOrder::kStandsAtTurns)
      for (const bool forward : {true, false})
        for (const double speed : rpm) {
          for (const double share : load_shares) add(all, forward, speed, share);
          for (int more = whole(1, 2); more > 0; --more)
            add(all, forward, speed, load_shares.back());
          for (auto share = load_shares.rbegin() + 1; share != load_shares.rend(); ++share)
            add(all, forward, speed, *share);
        }
    if (order == RowOrder::kRuns) {
      const int length = whole(14, 30);
      for (int run = 0; run < 16; ++run)
        for (int k = 0; k < length; ++k)
          add(all, run % 2 == 0,
              rpm[static_cast<std::size_t>(whole(0, static_cast<int>(rpm.size()) - 1))],
              load_shares[static_cast<std::size_t>(
                  whole(0, static_cast<int>(load_shares.size()) - 1))]);
    }
    double turns = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      DrawnRow& row = all[i];
      row.row = static_cast<int>(i);
      turns += between(0.1, 3.0);
      row.input_turns = turns;
      if (i == 0) continue;
      const DrawnRow& before = all[i - 1];
      row.since_turn = row.forward == before.forward ? before.since_turn + 1 : 0;
      row.way = row.share > before.share ? 1 : row.share < before.share ? -1 : 1;
    }
    if (!all.empty()) all.front().way = 1;
    rows = std::move(all);
  }

  std::mt19937_64 random_;
  double forward_loss_ = 0.0, backward_loss_ = 0.0;
};

/// Rows at random loads and speeds, which seldom come again; one direction, or one after the other
/// at random. `rows_asked`: 0 for 90 to 200 of them.
inline DrawnBench any_rows(std::uint64_t seed, bool both, int rows_asked = 0) {
  DrawnBench bench(seed, RowOrder::kRuns);
  const int n = rows_asked > 0 ? rows_asked : bench.whole(90, 200);
  std::vector<DrawnRow> rows;
  double turns = 0.0;
  for (int i = 0; i < n; ++i) {
    DrawnRow row;
    row.forward = !both || bench.between(0.0, 1.0) < 0.5;
    row.rpm = std::exp(bench.between(std::log(40.0), std::log(2800.0)));
    row.share = std::exp(bench.between(std::log(0.15), 0.0));
    row.output_nm = row.share * bench.most_output_nm;
    row.input_turns = turns += bench.between(0.1, 3.0);
    row.row = i;
    row.since_turn = i > 0 && row.forward == rows.back().forward ? rows.back().since_turn + 1 : 0;
    rows.push_back(row);
  }
  bench.rows = std::move(rows);
  return bench;
}

/// A place of a quantity that so much of the rows lies below.
template <class Quantity>
double place_of(const DrawnBench& bench, double share, const Quantity& quantity) {
  std::vector<double> values;
  for (const DrawnRow& r : bench.rows) values.push_back(quantity(r));
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
}

/// What the output reads too much where every row still holds this share of the row before.
inline DrawnBench::Loss held_of_the_row_before(const DrawnBench& bench, double share) {
  return [&bench, share](const DrawnRow& r) {
    const auto at = static_cast<std::size_t>(r.row);
    return at == 0 ? 0.0 : share * (bench.rows[at - 1].output_nm - r.output_nm);
  };
}

}  // namespace trueflank::test
