// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>

namespace trueflank::test {

/// Evenly spread numbers of a seed, the same with every standard library.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  /// From `low` to, but not with, `high`.
  double operator()(double low, double high) {
    return std::lerp(low, high, static_cast<double>(random_() >> 8) * 0x1p-24);
  }
  double operator()() { return (*this)(0.0, 1.0); }

 private:
  std::mt19937 random_;
};

}  // namespace trueflank::test
