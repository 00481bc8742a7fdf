// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
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

/// In which rows something is there, of the figures that were asked last: what a row has depends on
/// the rows before it. Several are kept, as two shapes may be asked by turns, row by row. Not for
/// several threads.
class LastRows {
 public:
  template <class Function>
  [[nodiscard]] const std::vector<char>& of(const std::vector<double>& figures,
                                            const Function& function) {
    for (const Kept& kept : kept_)
      if (!kept.rows.empty() && kept.figures == figures) return kept.rows;
    Kept& kept = kept_[next_];
    next_ = (next_ + 1) % kept_.size();
    kept = {figures, function()};
    return kept.rows;
  }

 private:
  struct Kept {
    std::vector<double> figures;
    std::vector<char> rows;
  };
  std::array<Kept, 4> kept_ = {};
  std::size_t next_ = 0;
};

}  // namespace trueflank::loop
