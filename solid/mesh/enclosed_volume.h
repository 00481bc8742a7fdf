// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace trueflank {

/// Signed volume of a closed surface, facet by facet: tetrahedra from a corner of the first one. The sum is
/// compensated, since terms of both signs cancel.
class EnclosedVolume {
 public:
  using Point = std::array<double, 3>;

  void add(const Point& a, const Point& b, const Point& c) {
    if (!begun_) origin_ = a;
    begun_ = true;
    const Point u = from_origin(a), v = from_origin(b), w = from_origin(c);
    const double six_volumes = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                               u[2] * (v[0] * w[1] - v[1] * w[0]);
    const double term = six_volumes - carry_;
    const double sum = six_volumes_ + term;
    carry_ = (sum - six_volumes_) - term;
    six_volumes_ = sum;
  }
  [[nodiscard]] double mm3() const { return six_volumes_ / 6.0; }

 private:
  [[nodiscard]] Point from_origin(const Point& p) const {
    return {p[0] - origin_[0], p[1] - origin_[1], p[2] - origin_[2]};
  }

  bool begun_ = false;
  Point origin_{};
  double six_volumes_ = 0.0, carry_ = 0.0;
};

}  // namespace trueflank
