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

/// In which rows something is there, of the few figures that were asked last: what a row has
/// depends on the rows before it, and a model with two such effects asks for both at every row. Not
/// for several threads.
class LastRows {
 public:
  template <class Function>
  [[nodiscard]] const std::vector<char>& of(const std::vector<double>& figures,
                                            const Function& function) {
    for (const Kept& one : kept_)
      if (one.is_known && one.figures == figures) return one.rows;
    Kept& one = kept_[next_];
    one = {true, figures, function()};
    next_ = (next_ + 1) % kept_.size();
    return one.rows;
  }

 private:
  struct Kept {
    bool is_known = false;
    std::vector<double> figures = {};
    std::vector<char> rows = {};
  };
  std::array<Kept, 4> kept_ = {};
  std::size_t next_ = 0;
};

}  // namespace trueflank::loop
