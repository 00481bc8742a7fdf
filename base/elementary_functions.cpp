// SPDX-License-Identifier: GPL-3.0-or-later
//
// sin, cos, tan, asin, acos, atan, atan2, exp, log and pow by plain sums and products. The C
// library has one version of them for processors with fused multiply-add and one for those without,
// and the two differ in the last digit; these give the same digits on both. The linker puts them in
// the place of the library's (--wrap, CMakeLists.txt), in our programs and the Python module; a
// program that links to the libraries keeps the functions it had.
//
// Accuracy: less than 1 unit in the last place for sin, cos, exp, log and pow, 1.5 for atan and
// atan2, 3 for tan, asin and acos (tests/base/elementary_functions_test.cpp). Angles beyond 1e6 and
// the special cases of pow are the C library's. Source: series after a reduction of the argument,
// their derivation beside each.
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "trueflank/base/arc_tangent.h"
#include "trueflank/base/sine_series.h"

extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
double __real_sin(double x);
double __real_cos(double x);
double __real_tan(double x);
double __real_pow(double x, double y);
double __wrap_sin(double x);
double __wrap_cos(double x);
void __wrap_sincos(double x, double* sine, double* cosine);
double __wrap_tan(double x);
double __wrap_asin(double x);
double __wrap_acos(double x);
double __wrap_atan(double x);
double __wrap_atan2(double y, double x);
double __wrap_exp(double x);
double __wrap_log(double x);
double __wrap_pow(double x, double y);
// NOLINTEND(bugprone-reserved-identifier)
}

namespace trueflank {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// pi and pi/2 in two pieces of 53 bits, ln 2 in pieces of 32 and 53 bits
constexpr double kPi = kPiHigh;
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

double absolute(double x) { return x < 0.0 ? -x : x; }
bool is_negative(double x) { return std::bit_cast<std::int64_t>(x) < 0; }

/// 1/first!, 1/(first + step)!, ..., each with the sign of the one before times `sign`.
template <typename Real, std::size_t count>
constexpr std::array<Real, count> inverse_factorials(int first, int step, int sign) {
  std::array<Real, count> c{};
  Real factorial = 1;
  int n = 1;
  for (; n <= first; ++n) factorial *= static_cast<Real>(n);
  Real s = 1;
  for (Real& value : c) {
    value = s / factorial;
    s *= static_cast<Real>(sign);
    for (int i = 0; i < step; ++i) factorial *= static_cast<Real>(n++);
  }
  return c;
}

/// An angle less `quarters` times pi/2, in two parts, within pi/4 of zero.
struct ReducedAngle {
  double high, low;
  unsigned quarters;
};

/// Requires: |x| <= kLargestReducedAngle.
ReducedAngle reduced(double x) {
  if (absolute(x) < kReducedAlready) return {x, 0.0, 0};
  const AngleOfQuarter<double> r = angle_of_quarter(x);
  return {r.high, r.low, static_cast<unsigned>(static_cast<std::int32_t>(r.quarters)) & 3U};
}

double sine_of(const ReducedAngle& r) { return sine_within_quarter(r.high, r.low); }
double cosine_of(const ReducedAngle& r) { return cosine_within_quarter(r.high, r.low); }
double sine(const ReducedAngle& r) {
  const double value = (r.quarters & 1U) != 0 ? cosine_of(r) : sine_of(r);
  return (r.quarters & 2U) != 0 ? -value : value;
}
double cosine(const ReducedAngle& r) {
  const double value = (r.quarters & 1U) != 0 ? sine_of(r) : cosine_of(r);
  return ((r.quarters + 1U) & 2U) != 0 ? -value : value;
}

/// Of 0 <= x <= 1.
double arctangent_below_one(double x) {
  const int i = x < 0.0625 ? 0 : static_cast<int>(x * 16.0 + 0.5);
  return arc_tangent_beside(x, i / 16.0, kAtanTable[i][0], kAtanTable[i][1]);
}
double arctangent(double x) {
  const double size = absolute(x);
  double value = size;  // not a number stays so
  if (size <= 1.0) value = arctangent_below_one(size);
  if (size > 1.0) value = 0.5 * kPi - (arctangent_below_one(1.0 / size) - 0.5 * kPiLow);
  return is_negative(x) ? -value : value;
}
double arctangent(double y, double x) {
  if (x != x || y != y) return kNan;
  const double ax = absolute(x), ay = absolute(y);
  double value = 0.0;
  if (ax == ay)
    value = ax == 0.0 ? 0.0 : 0.25 * kPi;
  else if (ay < ax)
    value = arctangent_below_one(ay / ax);
  else
    value = 0.5 * kPi - (arctangent_below_one(ax / ay) - 0.5 * kPiLow);
  if (is_negative(x)) value = kPi - (value - kPiLow);
  return is_negative(y) ? -value : value;
}

/// value * 2^exponent; in two steps, as 2^exponent alone may not be a number.
double scaled(double value, int exponent) {
  const auto power = [](int e) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + e) << 52U);
  };
  const int first = exponent / 2;
  return value * power(first) * power(exponent - first);
}

/// x = mantissa * 2^exponent with a mantissa from sqrt(1/2) to sqrt(2). Requires: x positive and
/// finite.
struct Parts {
  double mantissa;
  int exponent;
};
Parts parts(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52U) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFU) | 0x3FF0000000000000U);
  if (mantissa > 0x1.6a09e667f3bcdp+0) {
    mantissa *= 0.5;
    ++exponent;
  }
  return {mantissa, exponent};
}

/// exp(y log x) with 64 bits in between, of which exp loses at most ten.
double power(double x, double y) {
  static constexpr auto kAtanh = inverse_odd_numbers<long double, 15>(1, 1);
  static constexpr auto kExp = inverse_factorials<long double, 17>(1, 1, 1);
  constexpr long double kLn2 = 0x1.62e42fefa39ef357p-1L;
  const auto [mantissa, exponent] = parts(x);
  const long double f = static_cast<long double>(mantissa) - 1.0L;
  const long double s = f / (2.0L + f);
  const long double log =
      static_cast<long double>(exponent) * kLn2 + 2.0L * s * polynomial(s * s, kAtanh);
  const long double t = static_cast<long double>(y) * log;
  if (t > 1000.0L) return kInfinity;
  if (t < -1000.0L) return 0.0;
  const double k = nearest_integer(static_cast<double>(t / kLn2));
  const long double r = (t - static_cast<long double>(k) * static_cast<long double>(kLn2High)) -
                        static_cast<long double>(k) * static_cast<long double>(kLn2Low);
  return scaled(static_cast<double>(1.0L + r * polynomial(r, kExp)), static_cast<int>(k));
}

}  // namespace
}  // namespace trueflank

using namespace trueflank;

double __wrap_sin(double x) {
  if (!(absolute(x) <= kLargestReducedAngle)) return __real_sin(x);
  return absolute(x) < kIsItsSine ? x : sine(reduced(x));
}
double __wrap_cos(double x) {
  if (!(absolute(x) <= kLargestReducedAngle)) return __real_cos(x);
  return cosine(reduced(x));
}
void __wrap_sincos(double x, double* sine_of_x, double* cosine_of_x) {
  if (!(absolute(x) <= kLargestReducedAngle)) {
    *sine_of_x = __real_sin(x);
    *cosine_of_x = __real_cos(x);
    return;
  }
  const ReducedAngle r = reduced(x);
  *sine_of_x = absolute(x) < kIsItsSine ? x : sine(r);
  *cosine_of_x = cosine(r);
}
double __wrap_tan(double x) {
  if (!(absolute(x) <= kLargestReducedAngle)) return __real_tan(x);
  if (absolute(x) < kIsItsSine) return x;
  const ReducedAngle r = reduced(x);
  return sine(r) / cosine(r);
}
double __wrap_atan(double x) { return arctangent(x); }
double __wrap_atan2(double y, double x) { return arctangent(y, x); }
double __wrap_asin(double x) { return arctangent(x, __builtin_sqrt((1.0 - x) * (1.0 + x))); }
double __wrap_acos(double x) {
  return 2.0 * arctangent(__builtin_sqrt(1.0 - x), __builtin_sqrt(1.0 + x));
}

double __wrap_exp(double x) {
  static constexpr auto kSeries = inverse_factorials<double, 13>(2, 1, 1);
  if (x != x) return x;
  if (x > 710.0) return kInfinity;
  if (x < -746.0) return 0.0;
  const double k = nearest_integer(x * 0x1.71547652b82fep+0);
  const double high = x - k * kLn2High;  // exact
  const double low = k * kLn2Low;
  const double r = high - low;
  return scaled(1.0 + (high + (r * r * polynomial(r, kSeries) - low)), static_cast<int>(k));
}

double __wrap_log(double x) {
  static constexpr auto kSeries = inverse_odd_numbers<double, 11>(3, 1);
  if (x == 0.0) return -kInfinity;
  if (!(x > 0.0)) return kNan;
  if (x == kInfinity) return x;
  const auto [mantissa, exponent] = parts(x);
  const double k = exponent;
  const double f = mantissa - 1.0;  // log(1 + f) = f - (f^2/2 - s (f^2/2 + R)), s = f / (2 + f)
  const double half = 0.5 * f * f;
  const double s = f / (2.0 + f);
  const double rest = 2.0 * s * s * polynomial(s * s, kSeries);
  return k * kLn2High - ((half - (s * (half + rest) + k * kLn2Low)) - f);
}

double __wrap_pow(double x, double y) {
  const bool ordinary = x > 0.0 && x < kInfinity && absolute(y) < kInfinity;
  if (ordinary) return power(x, y);
  const bool whole = absolute(y) < 0x1p53 && static_cast<double>(static_cast<std::int64_t>(y)) == y;
  if (x < 0.0 && x > -kInfinity && whole) {
    const double size = power(-x, y);
    return (static_cast<std::int64_t>(y) & 1) != 0 ? -size : size;
  }
  return __real_pow(x, y);
}
