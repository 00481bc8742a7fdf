// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Numbers that enclose what they stand for, rounded outwards after every step: an interval, and a
// function's values over a box with its slopes along three variables. For the certificate of a
// search alone; functions are written once, for plain numbers and for these.
namespace trueflank {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Interval {
  double lo = 0.0, hi = 0.0;
  Interval() = default;
  Interval(double value) : lo(value), hi(value) {}  // NOLINT: a number is an interval
  Interval(double low, double high) : lo(low), hi(high) {}
  [[nodiscard]] double middle() const { return 0.5 * (lo + hi); }
  [[nodiscard]] double width() const { return hi - lo; }
  [[nodiscard]] bool has(double value) const { return lo <= value && value <= hi; }
};

inline Interval everything() { return {-kUnbounded, kUnbounded}; }

/// One rounding of + - * / sqrt errs by half a unit of the last place; those of the functions by
/// less than three (docs/decisions/0153-our-own-sine.md). Four are given.
inline Interval outwards(double low, double high) {
  constexpr double kUlps = 4.0 * 2.220446049250313e-16;
  // Of less its share is no normal number, with which processors compute a hundred times as slowly.
  constexpr double kSmall = 1e-280;
  if (!(low <= high)) return everything();
  return {low - (std::max(std::abs(low), kSmall) * kUlps + 1e-300),
          high + (std::max(std::abs(high), kSmall) * kUlps + 1e-300)};
}

inline Interval operator+(const Interval& p, const Interval& q) {
  return outwards(p.lo + q.lo, p.hi + q.hi);
}
inline Interval operator-(const Interval& p) { return {-p.hi, -p.lo}; }
inline Interval operator-(const Interval& p, const Interval& q) {
  return outwards(p.lo - q.hi, p.hi - q.lo);
}
inline Interval operator*(const Interval& p, const Interval& q) {
  if ((p.lo == 0.0 && p.hi == 0.0) || (q.lo == 0.0 && q.hi == 0.0)) return 0.0;
  const double a = p.lo * q.lo, b = p.lo * q.hi, c = p.hi * q.lo, d = p.hi * q.hi;
  // 0 times a number is 0, times what is none it is none
  if (!((a * 0.0 + b * 0.0) + (c * 0.0 + d * 0.0) == 0.0)) return everything();
  return outwards(std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)));
}
inline Interval operator/(const Interval& p, const Interval& q) {
  if (q.has(0.0)) return everything();
  return p * outwards(1.0 / q.hi, 1.0 / q.lo);
}
inline Interval hull(const Interval& p, const Interval& q) {
  return {std::min(p.lo, q.lo), std::max(p.hi, q.hi)};
}
inline Interval abs(const Interval& p) {
  if (p.lo >= 0.0) return p;
  if (p.hi <= 0.0) return -p;
  return {0.0, std::max(-p.lo, p.hi)};
}
inline Interval min(const Interval& p, const Interval& q) {
  return {std::min(p.lo, q.lo), std::min(p.hi, q.hi)};
}
inline Interval square(const Interval& p) {
  const Interval a = abs(p);
  return outwards(a.lo * a.lo, a.hi * a.hi);
}
/// Of what is below 0: 0.
inline Interval sqrt(const Interval& p) {
  const Interval r = outwards(std::sqrt(std::max(0.0, p.lo)), std::sqrt(std::max(0.0, p.hi)));
  return {std::max(0.0, r.lo), r.hi};
}
inline Interval atan(const Interval& p) { return outwards(std::atan(p.lo), std::atan(p.hi)); }
/// Requires: within -1 and 1; of what is beyond: the value there.
inline Interval acos(const Interval& p) {
  return outwards(std::acos(std::clamp(p.hi, -1.0, 1.0)), std::acos(std::clamp(p.lo, -1.0, 1.0)));
}
/// inv a of tan a. The difference tan a - a cancels: its error is that of its parts.
inline Interval involute_of_tangent(const Interval& u) {
  return {(Interval(u.lo) - atan(Interval(u.lo))).lo, (Interval(u.hi) - atan(Interval(u.hi))).hi};
}

/// A function over a box: what it is anywhere in it, and its slopes there along three variables (of
/// a function with kinks all that lie between).
struct Slope {
  Interval v;
  std::array<Interval, 3> d{};
  Slope() = default;
  Slope(double value) : v(value) {}           // NOLINT: a number is a function
  Slope(const Interval& value) : v(value) {}  // NOLINT
  static Slope variable(const Interval& range, std::size_t which) {
    Slope s(range);
    s.d[which] = 1.0;
    return s;
  }
};

/// Chain rule: the value is known, each slope is that of the argument times `factor`.
inline Slope chain(const Slope& p, const Interval& value, const Interval& factor) {
  Slope s(value);
  for (std::size_t i = 0; i < 3; ++i) s.d[i] = p.d[i] * factor;
  return s;
}
inline Slope operator+(const Slope& p, const Slope& q) {
  Slope s(p.v + q.v);
  for (std::size_t i = 0; i < 3; ++i) s.d[i] = p.d[i] + q.d[i];
  return s;
}
inline Slope operator-(const Slope& p) { return chain(p, -p.v, -1.0); }
inline Slope operator-(const Slope& p, const Slope& q) { return p + (-q); }
inline Slope operator*(const Slope& p, const Slope& q) {
  Slope s(p.v * q.v);
  for (std::size_t i = 0; i < 3; ++i) s.d[i] = p.d[i] * q.v + q.d[i] * p.v;
  return s;
}
inline Slope operator/(const Slope& p, const Slope& q) {
  const Interval one_over = Interval(1.0) / q.v;
  return p * chain(q, one_over, -square(one_over));
}
inline Slope hull(const Slope& p, const Slope& q, const Interval& value) {
  Slope s(value);
  for (std::size_t i = 0; i < 3; ++i) s.d[i] = hull(p.d[i], q.d[i]);
  return s;
}
inline Slope abs(const Slope& p) {
  if (p.v.lo >= 0.0) return p;
  if (p.v.hi <= 0.0) return -p;
  return hull(p, -p, abs(p.v));
}
inline Slope min(const Slope& p, const Slope& q) {
  if (p.v.hi <= q.v.lo) return p;
  if (q.v.hi <= p.v.lo) return q;
  return hull(p, q, min(p.v, q.v));
}
inline Slope square(const Slope& p) { return chain(p, square(p.v), Interval(2.0) * p.v); }
inline Slope sqrt(const Slope& p) {
  const Interval root = sqrt(p.v);
  return chain(p, root, p.v.lo > 0.0 ? Interval(0.5) / root : everything());
}
inline Slope atan(const Slope& p) {
  return chain(p, atan(p.v), Interval(1.0) / (Interval(1.0) + square(p.v)));
}
inline Slope acos(const Slope& p) {
  const Interval rest = Interval(1.0) - square(p.v);
  return chain(p, acos(p.v), rest.lo > 0.0 ? Interval(-1.0) / sqrt(rest) : everything());
}
inline Slope involute_of_tangent(const Slope& u) {
  const Interval square_u = square(u.v);
  return chain(u, involute_of_tangent(u.v), square_u / (Interval(1.0) + square_u));
}

/// @name The same of plain numbers, and what a number is at least and at most
/// @{
inline double abs(double p) { return std::abs(p); }
inline double min(double p, double q) { return std::min(p, q); }
inline double sqrt(double p) { return std::sqrt(p); }
inline double atan(double p) { return std::atan(p); }
inline double acos(double p) { return std::acos(p); }
inline double square(double p) { return p * p; }
inline double involute_of_tangent(double u) { return u - std::atan(u); }
inline Interval range_of(double p) { return p; }
inline Interval range_of(const Interval& p) { return p; }
inline Interval range_of(const Slope& p) { return p.v; }
/// @}

}  // namespace trueflank
