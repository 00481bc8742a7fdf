// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/bench_answers.h"
#include "tests/loop/drawn_bench.h"

// Drawn benches that hide one form: told as one effect with these figures, and nothing far above
// the noise left.
namespace trueflank::test {

using ClosedBench = ResultAll<loop::DriveLoop>;

/// No more than the noise is left: of the drawn bench at the output, forward.
inline bool leaves_noise(const ClosedBench& closed, const DrawnBench& bench) {
  constexpr double kOfNoise = 1.3;
  return closed && closed->result.after.rms <
                       kOfNoise * (bench.noise_output_nm + bench.noise_input_nm * bench.ratio);
}

/// Rows of the bench as days: so many files of equal length.
inline loop::BenchData as_days(loop::BenchData data, int days) {
  data.files.clear();
  for (int day = 0; day < days; ++day)
    data.files.push_back("day" + std::to_string(day + 1) + ".csv");
  const std::size_t rows = data.rows.size();
  std::size_t first = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto file = static_cast<int>(i * static_cast<std::size_t>(days) / rows);
    if (i > 0 && file != data.rows[i - 1].file) first = i;
    data.rows[i].file = file;
    data.rows[i].line = static_cast<int>(i - first) + 2;
  }
  return data;
}

using FormDraw = std::function<void(Answers&, std::uint64_t)>;
inline void expect_all(std::uint64_t first, int draws, const FormDraw& draw) {
  Answers answers;
  for (int run = 0; run < draws; ++run) draw(answers, first + static_cast<std::uint64_t>(run));
  EXPECT_EQ(answers.right, draws) << answers.text();
}

/// The drawn bench with this loss, closed; right where one effect has these figures within a fifth.
inline void closes_as(Answers& answers, std::uint64_t seed, const std::string& truth,
                      DrawnBench& bench, const DrawnBench::Loss& loss,
                      const std::vector<std::pair<std::string, double>>& figures) {
  const auto closed = loop::close_drive_loop(bench.model(), bench.data(loss));
  bool is_right = leaves_noise(closed, bench);
  for (const auto& [name, value] : figures)
    is_right = is_right && is_told_once(closed, name, value);
  answers.add(seed, truth, closed, is_right);
}

}  // namespace trueflank::test
