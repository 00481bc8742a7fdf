// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/bench_table.h"

// Data that cannot be what they say: signs, units, sides.
namespace trueflank::loop {
namespace {

/// Torques below this share of their column's largest may have any sign: they are noise about zero.
constexpr double kNearZero = 0.05;
/// Rows of the other sign up to this share of a direction are slips: left out and named.
constexpr double kMostSlips = 0.1;
/// An apparent efficiency beyond these is no loss but another unit.
constexpr double kUnitHigh = 30.0, kUnitLow = 0.003;
/// No sensor of a drive measures less, in N m: a side that never has more was not loaded, or its
/// sensor is dead.
constexpr double kLeastTorque = 1e-9;
/// From this ratio on interchanged columns are further off than any loss.
constexpr double kLeastRatio = 1.6;

std::string text(double value) { return printed("%.4g", value); }

struct Side {
  const char* column;
  double BenchRow::*torque;
};
constexpr std::array<Side, 2> kSides{
    {{"input_torque_nm", &BenchRow::input_nm}, {"output_torque_nm", &BenchRow::output_nm}}};

/// Rows of one direction of one file with torque enough to judge by.
struct Apparent {
  std::vector<const BenchRow*> rows;
  std::vector<double> efficiency;
};
Apparent apparent_efficiencies(const DriveModel& model, const BenchData& data, int file,
                               bool forward) {
  std::vector<double> driving;
  for (const BenchRow& row : data.rows)
    if (row.file == file && row.forward == forward)
      driving.push_back(forward ? row.input_nm : row.output_nm);
  driving.erase(std::remove_if(driving.begin(), driving.end(), [](double t) { return !(t > 0.0); }),
                driving.end());
  const double enough = driving.empty() ? kNaN : 0.5 * median(driving);
  Apparent result;
  for (const BenchRow& row : data.rows) {
    if (row.file != file || row.forward != forward) continue;
    const double in = forward ? row.input_nm : row.output_nm;
    const double out = forward ? row.output_nm : row.input_nm;
    if (!(in >= enough) || !(in > 0.0) || !(out > 0.0)) continue;
    result.rows.push_back(&row);
    result.efficiency.push_back(forward ? out / (model.ratio * in) : out * model.ratio / in);
  }
  return result;
}

/// True where torque gained grows with the load, as losses do that come out as gains. What a sensor
/// reads too much in either sense is the same at every load, and the flanks' losses take from it:
/// `loss`, of the driven torque. Between the two, nearer to the gain that stays.
bool gains_as_losses_do(const Apparent& a, bool forward, double loss) {
  constexpr double kBetween = -0.25;
  const auto driven = [&](std::size_t i) {
    return forward ? a.rows[i]->output_nm : a.rows[i]->input_nm;
  };
  std::vector<double> torques;
  for (std::size_t i = 0; i < a.rows.size(); ++i) torques.push_back(driven(i));
  const double middle = median(torques);
  std::vector<double> low, high, low_gain, high_gain;
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    (driven(i) < middle ? low : high).push_back(driven(i));
    (driven(i) < middle ? low_gain : high_gain).push_back(driven(i) * (1.0 - 1.0 / a.efficiency[i]));
  }
  if (low.empty() || high.empty()) return true;
  return median(high_gain) - median(low_gain) >=
         kBetween * loss * (median(high) - median(low));
}

Error unit_error(const BenchData& data, const BenchRow& row, const std::string& what) {
  return {.code = ErrorCode::kInconsistent,
          .message = what,
          .key = "input_torque_nm, output_torque_nm",
          .value = text(row.input_nm) + ", " + text(row.output_nm),
          .remedy = "torques of both sides in newton metres, in every row",
          .file = data.files[row.file],
          .line = row.line};
}

/// Leaves rows out whose torque has the other sign, and says so.
void leave_out_slips(const std::vector<const BenchRow*>& slips, const Side& side, BenchData& data,
                     std::vector<std::string>& notes) {
  std::vector<int> lines;
  for (const BenchRow* row : slips) {
    lines.push_back(row->line);
    notes.push_back(data.files[static_cast<std::size_t>(row->file)] + ":" +
                    std::to_string(row->line) + ": left out: " + side.column + " of " +
                    text(row->*side.torque) + " has the other sign than the rows around it");
  }
  const int file = slips.front()->file;
  std::erase_if(data.rows, [&](const BenchRow& row) {
    return row.file == file && std::find(lines.begin(), lines.end(), row.line) != lines.end();
  });
}

}  // namespace

Errors settle_signs(BenchData& data, std::vector<std::string>& notes) {
  Errors errors;
  for (int file = 0; file < static_cast<int>(data.files.size()); ++file)
    for (const bool forward : {true, false})
      for (const Side& side : kSides) {
        std::vector<BenchRow*> rows;
        double most = 0.0;
        for (BenchRow& row : data.rows)
          if (row.file == file && row.forward == forward) {
            rows.push_back(&row);
            most = std::max(most, std::abs(row.*side.torque));
          }
        int minus = 0, plus = 0;
        for (const BenchRow* row : rows) {
          if (row->*side.torque < -kNearZero * most) ++minus;
          if (row->*side.torque > kNearZero * most) ++plus;
        }
        if (minus > 0 && plus == 0) {
          for (BenchRow* row : rows) row->*side.torque = -(row->*side.torque);
          notes.push_back(
              data.files[file] + ": " + side.column + " of all " +
              (forward ? "forward" : "backward") +
              " rows is negative: a sign convention of the sensor; magnitudes were taken");
          continue;
        }
        if (minus == 0) continue;
        const bool odd_is_minus = minus <= plus;
        std::vector<const BenchRow*> odd;
        for (const BenchRow* row : rows)
          if (odd_is_minus ? row->*side.torque < -kNearZero * most
                           : row->*side.torque > kNearZero * most)
            odd.push_back(row);
        if (odd_is_minus &&
            static_cast<double>(odd.size()) <= kMostSlips * static_cast<double>(rows.size())) {
          leave_out_slips(odd, side, data, notes);
          continue;
        }
        errors.push_back(
            {.code = ErrorCode::kInconsistent,
             .message = std::string(side.column) + " changes its sign among the " +
                        (forward ? "forward" : "backward") + " rows (" +
                        std::to_string(std::min(minus, plus)) + " of " +
                        std::to_string(rows.size()) +
                        "): the power flows the other way there, or a sensor is swapped",
             .key = side.column,
             .value = text(odd.front()->*side.torque),
             .remedy = "magnitudes, each row under the direction in which its power flows",
             .file = data.files[file],
             .line = odd.front()->line});
      }
  return errors;
}

Errors refuse_no_torque(const BenchData& data) {
  Errors errors;
  for (const bool forward : {true, false})
    for (const Side& side : kSides) {
      const BenchRow* first = nullptr;
      double most = 0.0;
      for (const BenchRow& row : data.rows) {
        if (row.forward != forward) continue;
        if (first == nullptr) first = &row;
        most = std::max(most, std::abs(row.*side.torque));
      }
      if (first == nullptr || most >= kLeastTorque) continue;
      errors.push_back({.code = ErrorCode::kOutOfRange,
                        .message = std::string("every ") + (forward ? "forward" : "backward") +
                                   " row says a torque of 0: no power flows through the drive",
                        .key = side.column,
                        .value = text(first->*side.torque),
                        .remedy = "rows with a load on both sides, in newton metres",
                        .file = data.files[static_cast<std::size_t>(first->file)],
                        .line = first->line});
    }
  return errors;
}

Errors judge_units(const DriveModel& model, const BenchData& data, Impossible& swapped) {
  Errors errors;
  const double turn = 2.0 * std::log(model.ratio);
  int columns_swapped = 0, directions_above = 0, judged = 0;
  for (int file = 0; file < static_cast<int>(data.files.size()); ++file)
    for (const bool forward : {true, false}) {
      const Apparent a = apparent_efficiencies(model, data, file, forward);
      if (a.rows.empty()) continue;
      ++judged;
      const double middle = median(std::vector(a.efficiency));
      const double l = std::log(middle);
      if (model.ratio > kLeastRatio &&
          std::abs(l + (forward ? turn : -turn)) < std::min(std::log(2.5), 0.4 * turn)) {
        ++columns_swapped;
        continue;
      }
      if (middle > kUnitHigh || middle < kUnitLow) {
        errors.push_back(unit_error(
            data, *a.rows.front(),
            "the torques differ by a factor of " + text(middle) + " from what the ratio of " +
                text(model.ratio) +
                " allows: one of the two columns is in another unit (mN m, N cm, kg cm?)"));
        continue;
      }
      std::vector<const BenchRow*> odd;
      for (std::size_t i = 0; i < a.rows.size(); ++i)
        if (a.efficiency[i] > kUnitHigh * middle || a.efficiency[i] * kUnitHigh < middle)
          odd.push_back(a.rows[i]);
      if (!odd.empty())
        errors.push_back(unit_error(
            data, *odd.front(),
            std::to_string(odd.size()) + " of " + std::to_string(a.rows.size()) +
                " rows differ from the others by a factor of more than 30: mixed units"));
      // Who is called driving is driven: the losses come out as gains, of about their size.
      const DriveEfficiency e = model.at(model.friction);
      const double other = forward ? e.backward : e.forward;
      const bool above =
          std::all_of(a.efficiency.begin(), a.efficiency.end(), [](double x) { return x > 1.0; });
      if (above && std::abs(1.0 / middle - other) < 0.1 && gains_as_losses_do(a, forward, 1.0 - other))
        ++directions_above;
    }
  if (judged > 0 && columns_swapped == judged)
    swapped = Impossible::kSwappedColumns;
  else if (columns_swapped > 0)
    errors.push_back(
        {.code = ErrorCode::kInconsistent,
         .message = "in some files or directions input and output torque are interchanged",
         .key = "input_torque_nm, output_torque_nm",
         .remedy = "the sun side's torque under input_torque_nm, everywhere",
         .file = data.files.front()});
  else if (judged > 1 && directions_above == judged)
    swapped = Impossible::kSwappedDirections;
  return errors;
}

}  // namespace trueflank::loop
