// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "trueflank/base/arc_tangent.h"

// What sine and cosine are made of, for one number and for four at once: the same digits of both.
// Always inlined (arc_tangent.h says why).
namespace trueflank {

/// A sum with this holds a number below 2^51 as its nearest integer.
inline constexpr double kRoundsToInteger = 0x1.8p52;
inline constexpr double kLargestReducedAngle = 1e6;
/// An angle below it needs no reduction; the sine of one below the other is that angle.
inline constexpr double kReducedAlready = 0.785, kIsItsSine = 0x1p-27;

template <typename Value>
[[gnu::always_inline]] inline Value nearest_integer(const Value& x) {
  return (x + kRoundsToInteger) - kRoundsToInteger;
}

/// An angle less so many quarters of a turn, in two parts, within pi/4 of zero.
template <typename Value>
struct AngleOfQuarter {
  Value high, low, quarters;
};

/// Requires: |x| <= kLargestReducedAngle, so that the first two products are exact.
template <typename Value>
[[gnu::always_inline]] inline AngleOfQuarter<Value> angle_of_quarter(const Value& x) {
  // pi/2 in pieces of 33, 33 and 53 bits
  constexpr double kHalfPi1 = 0x1.921fb544p+0, kHalfPi2 = 0x1.0b4611a6p-34,
                   kHalfPi3 = 0x1.3198a2e037073p-69;
  const Value k = nearest_integer(x * 0x1.45f306dc9c883p-1);
  const Value a = x - k * kHalfPi1;
  const Value b = k * kHalfPi2;
  const Value difference = a - b;  // and what its rounding lost (Knuth)
  const Value subtracted = a - difference;
  const Value lost = (a - (difference + subtracted)) + (subtracted - b);
  const Value rest = lost - k * kHalfPi3;
  const Value high = difference + rest;
  return {high, (difference - high) + rest, k};
}

// The two polynomials are Chebyshev's of (sin(r)/r - 1) / r^2 and of (cos(r) - 1 + r^2/2) / r^4 in
// r^2; the sine is 1e-20 of itself off by it, the cosine 5e-19.
template <typename Value>
[[gnu::always_inline]] inline Value sine_within_quarter(const Value& high, const Value& low) {
  constexpr std::array kSeries = {
      -0x1.5555555555555p-3,  0x1.1111111111110p-7,  -0x1.a01a01a01992fp-13, 0x1.71de3a545f836p-19,
      -0x1.ae645410e937bp-26, 0x1.61217d9252c03p-33, -0x1.ab16f5caa198ap-41};
  const Value z = high * high;
  return high + (low * (1.0 - 0.5 * z) + high * z * polynomial(z, kSeries));
}
template <typename Value>
[[gnu::always_inline]] inline Value cosine_within_quarter(const Value& high, const Value& low) {
  constexpr std::array kSeries = {0x1.5555555555555p-5,  -0x1.6c16c16c16963p-10,
                                  0x1.a01a019f4ddfdp-16, -0x1.27e4fa16cc2d1p-22,
                                  0x1.1eeb67d026ec6p-29, -0x1.907cd8ff5ede7p-37};
  const Value z = high * high;
  const Value half = 0.5 * z;
  const Value head = 1.0 - half;
  return head + (((1.0 - head) - half) + (z * z * polynomial(z, kSeries) - high * low));
}

}  // namespace trueflank
