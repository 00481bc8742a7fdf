// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "tests/support/survey_size.h"

// Drawn gears that hide one form, and what is asked of the answer: one effect of its size.
namespace trueflank::test {

/// Numbers of a draw, evenly between two.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  int whole(int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random_);
  }
  double sign() { return whole(0, 1) == 1 ? 1.0 : -1.0; }

 private:
  std::mt19937_64 random_;
};

inline double bell_of(double off, double half) { return std::exp(-off * off / (half * half)); }

/// The size of the first effect's first term.
inline double amplitude_of_first(const loop::LoopResult& result) {
  const auto& terms = result.effects.front().terms;
  return terms.empty() ? 0.0 : terms.front().amplitude();
}

/// One effect, of this size within a share of it, and nothing is left.
inline void expect_one_of_size(const loop::LoopResult& result, double um, double within) {
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_NEAR(amplitude_of_first(result), um, within * um) << list(result);
}

}  // namespace trueflank::test
