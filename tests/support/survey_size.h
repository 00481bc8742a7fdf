// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace trueflank::test {

/// Whether all trials of a survey are asked: in `make campaign`, not in `make test`.
inline bool surveys_are_whole() { return std::getenv("TRUEFLANK_CAMPAIGN") != nullptr; }

/// How many random trials a survey makes: the first `gate` of them in `make test`, all of them in `make campaign`.
/// The trials are the same ones: their seeds follow each other.
template <class Number>
Number survey_size(Number gate, Number all) {
  return surveys_are_whole() ? all : gate;
}

/// The first cases of a list of cases alike in `make test`, all of them in `make campaign`.
template <class Case>
std::vector<Case> survey_of(std::size_t gate, std::initializer_list<Case> cases) {
  return {cases.begin(), cases.begin() + static_cast<std::ptrdiff_t>(std::min(
                                             survey_size(gate, cases.size()), cases.size()))};
}

/// Whether a case is asked that `make test` asks, or does not: `make campaign` asks each.
inline bool is_surveyed(bool in_gate) { return in_gate || surveys_are_whole(); }

/// Of so many trials, where each is right with this chance: fewer come once in a thousand surveys
/// of the campaign. The gate asks the same few seeds each time, which were seen to hold: one
/// standard deviation there, so three of four where nine in ten are right.
inline int seldom_fewer(int runs, double chance) {
  const double deviations = surveys_are_whole() ? 3.1 : 1.0;
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::floor(
      runs * chance - deviations * std::sqrt(runs * chance * (1.0 - chance)) + kRounding));
}

}  // namespace trueflank::test
