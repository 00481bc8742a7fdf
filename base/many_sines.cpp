// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/many_sines.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "trueflank/base/contract.h"
#include "trueflank/base/sine_series.h"
#include "trueflank/base/widest_registers.h"

namespace trueflank {
namespace {

using FourAngles [[gnu::vector_size(4 * sizeof(double))]] = double;
using FourBits [[gnu::vector_size(4 * sizeof(std::int64_t))]] = std::int64_t;

/// As elementary_functions.cpp does it for one.
[[gnu::always_inline]] inline void sines_of_four(const FourAngles& x, FourAngles& sines,
                                                 FourAngles& cosines) {
  const FourAngles size = reinterpret_cast<FourAngles>(reinterpret_cast<FourBits>(x) & INT64_MAX);
  const AngleOfQuarter<FourAngles> r = angle_of_quarter(x);
  const FourBits is_reduced = size < kReducedAlready;
  const FourAngles high = is_reduced ? x : r.high, low = is_reduced ? FourAngles{} : r.low;
  const FourAngles of_sine = sine_within_quarter(high, low),
                   of_cosine = cosine_within_quarter(high, low);
  // (the bits of an integer are the last ones beside the number that rounds to it)
  const FourBits turns =
      is_reduced ? FourBits{} : reinterpret_cast<FourBits>(r.quarters + kRoundsToInteger) & 3;
  const FourBits is_odd = (turns & 1) != 0;
  const FourBits sign_of_sine = (turns & 2) << 62, sign_of_cosine = ((turns + 1) & 2) << 62;
  const FourAngles sine = is_odd ? of_cosine : of_sine, cosine = is_odd ? of_sine : of_cosine;
  sines = size < kIsItsSine
              ? x
              : reinterpret_cast<FourAngles>(reinterpret_cast<FourBits>(sine) ^ sign_of_sine);
  cosines = reinterpret_cast<FourAngles>(reinterpret_cast<FourBits>(cosine) ^ sign_of_cosine);
}

}  // namespace

void sines_and_cosines(std::span<const double> angles_rad, std::span<double> sines,
                       std::span<double> cosines) {
  TRUEFLANK_EXPECTS(sines.size() == angles_rad.size() && cosines.size() == angles_rad.size());
  const std::size_t count = angles_rad.size();
  bool all_reduced = true;
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    FourBits are_large = {};
    for (std::size_t i = 0; i < count; i += 4) {
      const std::size_t bytes = (count - i < 4 ? count - i : 4) * sizeof(double);
      FourAngles x = {}, sine, cosine;
      if (bytes == sizeof x)
        std::memcpy(&x, angles_rad.data() + i, sizeof x);
      else
        std::memcpy(&x, angles_rad.data() + i, bytes);
      const FourAngles size =
          reinterpret_cast<FourAngles>(reinterpret_cast<FourBits>(x) & INT64_MAX);
      are_large |= ~FourBits(size <= kLargestReducedAngle);
      sines_of_four(x, sine, cosine);
      if (bytes == sizeof x) {
        std::memcpy(sines.data() + i, &sine, sizeof sine);
        std::memcpy(cosines.data() + i, &cosine, sizeof cosine);
        continue;
      }
      std::memcpy(sines.data() + i, &sine, bytes);
      std::memcpy(cosines.data() + i, &cosine, bytes);
    }
    all_reduced = (are_large[0] | are_large[1] | are_large[2] | are_large[3]) == 0;
  });
  if (all_reduced) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(angles_rad[i]) <= kLargestReducedAngle) continue;
    sines[i] = std::sin(angles_rad[i]);
    cosines[i] = std::cos(angles_rad[i]);
  }
}

}  // namespace trueflank
