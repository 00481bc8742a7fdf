// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/column_products.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "trueflank/base/widest_registers.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kOthers = 4, kColumns = 4;
constexpr std::size_t kRows = 512;  // of a block: all columns' stay at hand. Even
using FourOthers [[gnu::vector_size(kOthers * sizeof(double))]] = double;
using OfFour = std::array<double, kOthers>;

/// A sum over even rows and one over odd ones, as Eigen has them in registers of two.
struct TwoSums {
  OfFour even{}, odd{};
};

/// Of `count` columns that begin at `first`, so many rows apart, over rows of a block (an even
/// number of them).
template <std::size_t count>
void add_block(const double* first, std::size_t apart, const OfFour* others, std::size_t rows,
               TwoSums* sums) {
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    FourOthers even[count], odd[count];
    for (std::size_t c = 0; c < count; ++c) {
      std::memcpy(&even[c], &sums[c].even, sizeof even[c]);
      std::memcpy(&odd[c], &sums[c].odd, sizeof odd[c]);
    }
    for (std::size_t r = 0; r < rows; r += 2) {
      FourOthers one, next;
      std::memcpy(&one, &others[r], sizeof one);
      std::memcpy(&next, &others[r + 1], sizeof next);
      for (std::size_t c = 0; c < count; ++c) {
        even[c] += first[c * apart + r] * one;
        odd[c] += first[c * apart + r + 1] * next;
      }
    }
    for (std::size_t c = 0; c < count; ++c) {
      std::memcpy(&sums[c].even, &even[c], sizeof even[c]);
      std::memcpy(&sums[c].odd, &odd[c], sizeof odd[c]);
    }
  });
}

}  // namespace

Eigen::MatrixXd column_products(const Eigen::MatrixXd& columns,
                                const std::vector<const double*>& others) {
  const auto n = static_cast<std::size_t>(columns.rows()),
             width = static_cast<std::size_t>(columns.cols()), count = others.size();
  Eigen::MatrixXd products(columns.cols(), static_cast<Eigen::Index>(count));
  if (count == 1 || width == 1) {  // (Eigen sums a single product otherwise)
    for (Eigen::Index k = 0; k < products.cols(); ++k)
      products.col(k).noalias() =
          columns.transpose() *
          Eigen::Map<const Eigen::VectorXd>(others[static_cast<std::size_t>(k)], columns.rows());
    return products;
  }
  const std::size_t fours = (count + kOthers - 1) / kOthers, even_rows = n / 2 * 2;
  std::vector<TwoSums> sums(fours * width);
  std::vector<OfFour> beside(kRows);
  for (std::size_t from = 0; from < even_rows; from += kRows) {
    const std::size_t rows = std::min(kRows, even_rows - from);
    for (std::size_t four = 0; four < fours; ++four) {
      for (std::size_t k = 0; k < kOthers; ++k) {
        const std::size_t other = four * kOthers + k;
        const double* const values = other < count ? others[other] + from : nullptr;
        for (std::size_t r = 0; r < rows; ++r) beside[r][k] = values == nullptr ? 0.0 : values[r];
      }
      TwoSums* const of_four = sums.data() + four * width;
      std::size_t c = 0;
      for (; c + kColumns <= width; c += kColumns)
        add_block<kColumns>(columns.data() + c * n + from, n, beside.data(), rows, of_four + c);
      for (; c < width; ++c)
        add_block<1>(columns.data() + c * n + from, n, beside.data(), rows, of_four + c);
    }
  }
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < width; ++c) {
      const TwoSums& two = sums[k / kOthers * width + c];
      double sum = two.even[k % kOthers] + two.odd[k % kOthers];
      if (even_rows < n) sum += columns.data()[c * n + n - 1] * others[k][n - 1];
      products(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) = sum;
    }
  return products;
}

}  // namespace trueflank::loop
