// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/wave_spectrum.h"

#include <gtest/gtest.h>

#include <random>

namespace trueflank::loop {
namespace {

TEST(WaveSpectrum, LinesSummedByTransformAreThePlainSums) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-40.0, 6000.0);
  std::normal_distribution<double> normal;
  std::vector<double> angle, size;
  double total = 0.0;
  for (int i = 0; i < 300; ++i) {
    angle.push_back(place(random));
    size.push_back(normal(random));
    total += std::abs(size.back());
  }
  for (const int lines : {5, 700, 4096}) {
    const auto sums = line_sums(angle, size, 0.31, 0.0007, lines);
    ASSERT_EQ(sums.size(), static_cast<std::size_t>(lines));
    for (int k = 0; k < lines; ++k) {
      std::complex<double> plain;
      for (std::size_t i = 0; i < angle.size(); ++i)
        plain += size[i] * std::polar(1.0, (0.31 + 0.0007 * k) * angle[i]);
      EXPECT_NEAR(std::abs(sums[static_cast<std::size_t>(k)] - plain), 0.0, 1e-10 * total) << lines << " " << k;
    }
  }
}

}  // namespace
}  // namespace trueflank::loop
