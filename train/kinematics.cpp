// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/kinematics.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

__extension__ using Wide = __int128;

/// A fraction in lowest terms. What outgrows 63 bits is no number any more (see `whole`).
class Fraction {
 public:
  Fraction() = default;
  Fraction(int value) : top_(value) {}  // NOLINT: a whole number is a fraction

  [[nodiscard]] bool is_zero() const { return top_ == 0; }
  [[nodiscard]] bool overflowed() const { return bottom_ == 0; }
  [[nodiscard]] double value() const { return static_cast<double>(top_) / static_cast<double>(bottom_); }

  friend Fraction operator-(const Fraction& a, const Fraction& b) {
    return reduced(Wide(a.top_) * b.bottom_ - Wide(b.top_) * a.bottom_, Wide(a.bottom_) * b.bottom_);
  }
  friend Fraction operator*(const Fraction& a, const Fraction& b) {
    return reduced(Wide(a.top_) * b.top_, Wide(a.bottom_) * b.bottom_);
  }
  friend Fraction operator/(const Fraction& a, const Fraction& b) {
    const int sign = b.top_ < 0 ? -1 : 1;
    return reduced(sign * Wide(a.top_) * b.bottom_, sign * Wide(a.bottom_) * b.top_);
  }

 private:
  static Fraction reduced(Wide top, Wide bottom) {
    Wide a = top < 0 ? -top : top, b = bottom;
    while (b != 0) {
      const Wide rest = a % b;
      a = b;
      b = rest;
    }
    Fraction result;
    constexpr Wide kLargest = INT64_MAX;
    if (a != 0) {
      top /= a;
      bottom /= a;
    }
    const bool fits = bottom > 0 && bottom <= kLargest && top <= kLargest && -top <= kLargest;
    result.top_ = fits ? static_cast<std::int64_t>(top) : 1;
    result.bottom_ = fits ? static_cast<std::int64_t>(bottom) : 0;
    return result;
  }

  std::int64_t top_ = 0, bottom_ = 1;
};

/// The same equations in floating point, for trains whose fractions outgrow 63 bits.
class Rounded {
 public:
  Rounded() = default;
  Rounded(int value) : value_(value) {}  // NOLINT
  [[nodiscard]] bool is_zero() const { return std::abs(value_) < 1e-14L; }
  [[nodiscard]] bool overflowed() const { return !std::isfinite(value_); }
  [[nodiscard]] double value() const { return static_cast<double>(value_); }
  friend Rounded operator-(Rounded a, Rounded b) { return Rounded(a.value_ - b.value_, 0); }
  friend Rounded operator*(Rounded a, Rounded b) { return Rounded(a.value_ * b.value_, 0); }
  friend Rounded operator/(Rounded a, Rounded b) { return Rounded(a.value_ / b.value_, 0); }

 private:
  Rounded(long double value, int) : value_(value) {}
  long double value_ = 0.0L;
};

template <class Number>
using Row = std::vector<Number>;  ///< coefficients of the members' speeds, then the right-hand side

template <class Number>
std::vector<Row<Number>> willis_equations(const Topology& topology, const std::vector<int>& teeth) {
  const std::size_t count = topology.members.size();
  std::vector<Row<Number>> rows;
  for (const TopologyMesh& mesh : topology.meshes) {
    const auto g1 = static_cast<std::size_t>(mesh.gear1), g2 = static_cast<std::size_t>(mesh.gear2);
    // by their common divisor, which keeps the numbers small
    const int common = std::gcd(teeth[g1], teeth[g2]);
    const int z1 = teeth[g1] / common, z2 = teeth[g2] / common;
    std::vector<int> row(count + 1, 0);
    row[static_cast<std::size_t>(topology.gears[g1].member)] += z1;
    row[static_cast<std::size_t>(topology.gears[g2].member)] += z2;
    if (const int arm = topology.arm_of(mesh); arm != kHousing) row[static_cast<std::size_t>(arm)] -= z1 + z2;
    rows.emplace_back(row.begin(), row.end());
  }
  const auto turns_at = [&](int member, int speed) {
    Row<Number> row(count + 1, Number(0));
    row[static_cast<std::size_t>(member)] = Number(1);
    row[count] = Number(speed);
    rows.push_back(std::move(row));
  };
  for (const int fixed : topology.fixed) turns_at(fixed, 0);
  turns_at(topology.input, 1);
  return rows;
}

/// Solves by elimination, row by row to the reduced form. An empty answer: numbers became too large.
/// NaN: the equations leave that member open, or contradict each other.
template <class Number>
std::optional<std::vector<double>> solved(std::vector<Row<Number>> rows, std::size_t count) {
  std::vector<double> speeds(count, kNaN);
  std::vector<std::size_t> column_of;
  std::size_t settled = 0;
  for (std::size_t column = 0; column < count && settled < rows.size(); ++column) {
    std::size_t pivot = settled;
    while (pivot < rows.size() && rows[pivot][column].is_zero()) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[settled]);
    const Row<Number>& own = rows[settled];
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r == settled || rows[r][column].is_zero()) continue;
      const Number factor = rows[r][column] / own[column];
      for (std::size_t c = column; c <= count; ++c) {
        rows[r][c] = rows[r][c] - factor * own[c];
        if (rows[r][c].overflowed()) return std::nullopt;
      }
    }
    column_of.push_back(column);
    ++settled;
  }
  for (std::size_t r = settled; r < rows.size(); ++r)
    if (!rows[r][count].is_zero()) return speeds;  // a contradiction: nothing can turn as asked
  for (std::size_t r = 0; r < settled; ++r) {
    bool alone = true;
    for (std::size_t c = 0; c < count; ++c)
      alone = alone && (c == column_of[r] || rows[r][c].is_zero());
    if (!alone) continue;
    const Number speed = rows[r][count] / rows[r][column_of[r]];
    if (speed.overflowed()) return std::nullopt;
    speeds[column_of[r]] = speed.value();
  }
  return speeds;
}

}  // namespace

std::vector<int> signed_teeth(const GearboxDesign& design) {
  std::vector<int> teeth;
  for (const GearDesign& gear : design.gears)
    teeth.push_back(gear.kind == GearKind::kInternal ? -gear.teeth : gear.teeth);
  return teeth;
}

MemberSpeeds member_speeds(const Topology& topology, const std::vector<int>& signed_teeth) {
  TRUEFLANK_EXPECTS(signed_teeth.size() == topology.gears.size());
  const std::size_t count = topology.members.size();
  MemberSpeeds speeds;
  if (auto exact = solved(willis_equations<Fraction>(topology, signed_teeth), count))
    speeds.of = std::move(*exact);
  else
    speeds.of = solved(willis_equations<Rounded>(topology, signed_teeth), count)
                    .value_or(std::vector<double>(count, kNaN));
  if (topology.output != kNoMember) speeds.output = speeds.of[static_cast<std::size_t>(topology.output)];
  return speeds;
}

}  // namespace trueflank
