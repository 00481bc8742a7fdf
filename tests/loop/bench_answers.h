// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "tests/loop/sample_bench.h"
#include "tests/support/survey_size.h"

// What surveys of drawn benches count: answers with one form, its size and its place.
namespace trueflank::test {

/// Answers of a survey: how many are right, and the others to be read.
struct Answers {
  int runs = 0, right = 0;
  std::string others;
  void add(std::uint64_t seed, const std::string& truth, const ResultAll<loop::DriveLoop>& closed,
           bool is_right) {
    ++runs;
    right += is_right ? 1 : 0;
    if (!is_right)
      others += "seed " + std::to_string(seed) + ": " + truth + "\n" +
                (closed ? told(closed->result) + "\n" + std::to_string(closed->result.outliers) +
                              " outliers of " + std::to_string(closed->result.observations)
                        : std::string("refused")) +
                "\n";
  }
  [[nodiscard]] std::string text() const {
    return std::to_string(right) + " of " + std::to_string(runs) + "\n" + others;
  }
  [[nodiscard]] int seldom_fewer(double chance) const { return test::seldom_fewer(runs, chance); }
};

/// The effect with this figure, if there is one alone.
inline const loop::FoundEffect* with_figure(const loop::LoopResult& result,
                                            const std::string& figure) {
  const loop::FoundEffect* found = nullptr;
  for (const loop::FoundEffect& effect : result.effects)
    if (parameter(effect, figure) != nullptr) {
      if (found != nullptr) return nullptr;
      found = &effect;
    }
  return found;
}

inline bool is_about(const loop::FoundEffect& effect, const std::string& figure, double truth,
                     double within) {
  const loop::Parameter* p = parameter(effect, figure);
  return p != nullptr && std::abs(p->value - truth) <= within * std::abs(truth);
}

/// The one effect there is, if it has this figure within a fifth.
inline bool is_told_once(const ResultAll<loop::DriveLoop>& closed, const std::string& figure,
                         double truth) {
  if (!closed || closed->result.effects.size() != 1) return false;
  const loop::FoundEffect* effect = with_figure(closed->result, figure);
  return effect != nullptr && is_about(*effect, figure, truth, 0.2);
}

inline bool says(const ResultAll<loop::DriveLoop>& closed, const std::string& words) {
  return closed && told(closed->result).find(words) != std::string::npos;
}

}  // namespace trueflank::test
