// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::loop {

/// Sums of pairs of values, taken in one after another: squares and products about their means.
struct PairedSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double one, double other) {
    n += 1.0;
    x += one;
    y += other;
    xx += one * one;
    xy += one * other;
    yy += other * other;
  }
  [[nodiscard]] double square_of_x() const { return xx - x * x / n; }
  [[nodiscard]] double product() const { return xy - x * y / n; }
  [[nodiscard]] double square_of_y() const { return yy - y * y / n; }
};

}  // namespace trueflank::loop
