// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

// What the arc tangent is made of, for one number and for four at once: the same digits of both.
// Always inlined: how four are handed to a function depends on the registers it was compiled for,
// and these are called from code for wide ones (widest_registers.h).
namespace trueflank {

/// pi in two parts.
inline constexpr double kPiHigh = 0x1.921fb54442d18p+1, kPiLow = 0x1.1a62633145c07p-53;

/// c[0] + x (c[1] + x (...))
template <typename Value, typename Real, std::size_t count>
[[gnu::always_inline]] inline Value polynomial(const Value& x, const std::array<Real, count>& c) {
  Value sum = Value{} + c[count - 1];
  for (std::size_t i = count - 1; i-- > 0;) sum = c[i] + x * sum;
  return sum;
}

/// 1/first, sign/(first + 2), 1/(first + 4), ...
template <typename Real, std::size_t count>
constexpr std::array<Real, count> inverse_odd_numbers(int first, int sign) {
  std::array<Real, count> c{};
  Real s = 1;
  for (std::size_t i = 0; i < count; ++i, s *= static_cast<Real>(sign))
    c[i] = s / static_cast<Real>(first + 2 * static_cast<int>(i));
  return c;
}

/// atan(i / 16) in two parts.
inline constexpr double kAtanTable[17][2] = {{0.0, 0.0},
                                             {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
                                             {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                             {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
                                             {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                             {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
                                             {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                             {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
                                             {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                             {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
                                             {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                             {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
                                             {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                             {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
                                             {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                             {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
                                             {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

/// Of 0 <= x <= 1 beside c = i/16, whose arc tangent stands in the table: atan(c) + atan((x - c) /
/// (1 + x c)).
template <typename Value>
[[gnu::always_inline]] inline Value arc_tangent_beside(const Value& x, const Value& c,
                                                       const Value& high, const Value& low) {
  constexpr auto kSeries = inverse_odd_numbers<double, 7>(3, -1);
  const Value t = (x - c) / (1.0 + x * c);
  const Value z = t * t;
  return high + (t - (t * z * polynomial(z, kSeries) - low));
}

}  // namespace trueflank
