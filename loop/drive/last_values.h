// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trueflank/base/units.h"

namespace trueflank::loop {

/// Values of one function that were asked last: shapes that are tried ask for the same few at every
/// row. Not for several threads.
class LastValues {
 public:
  template <class Function>
  [[nodiscard]] double at(double argument, const Function& function) {
    for (const auto& [known, value] : kept_)
      if (known == argument) return value;
    const double value = function(argument);
    kept_[next_] = {argument, value};
    next_ = (next_ + 1) % kept_.size();
    return value;
  }

 private:
  struct Kept {
    double argument = kNaN, value = kNaN;
  };
  std::array<Kept, 4> kept_ = {};
  std::size_t next_ = 0;
};

/// What every row has, of the few figures that were asked last: it may depend on the rows before,
/// and a model with two such effects asks for both at every row. Not for several threads.
template <class Value>
class LastRows {
 public:
  template <class Function>
  [[nodiscard]] const std::vector<Value>& of(std::span<const double> figures,
                                             const Function& function) {
    for (const Kept& one : kept_)
      if (one.is_known && std::ranges::equal(one.figures, figures)) return one.rows;
    Kept& one = kept_[next_];
    one = {true, {figures.begin(), figures.end()}, function()};
    next_ = (next_ + 1) % kept_.size();
    return one.rows;
  }

 private:
  struct Kept {
    bool is_known = false;
    std::vector<double> figures = {};
    std::vector<Value> rows = {};
  };
  std::array<Kept, 4> kept_ = {};
  std::size_t next_ = 0;
};

/// Which of the rows it is; of a row that is none of them a number beyond them.
template <class Row>
[[nodiscard]] std::size_t place_among(const std::vector<Row>& rows, const Row& row) {
  return (reinterpret_cast<std::uintptr_t>(&row) - reinterpret_cast<std::uintptr_t>(rows.data())) /
         sizeof(Row);
}

/// A value of every row of one table, worked out where it is first asked; of a row that is not the
/// table's nothing is kept. Not for several threads.
class RowValues {
 public:
  template <class Row, class Function>
  [[nodiscard]] double of(const std::vector<Row>& rows, const Row& row, const Function& function) {
    const std::size_t at = place_among(rows, row);
    if (at >= rows.size()) return function();
    if (kept_.size() != rows.size()) kept_.assign(rows.size(), kNaN);
    if (std::isnan(kept_[at])) kept_[at] = function();
    return kept_[at];
  }

 private:
  std::vector<double> kept_ = {};
};

}  // namespace trueflank::loop
