// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>

namespace trueflank::test {

/// How many random trials a survey makes: the first `gate` of them in `make test`, all of them in `make campaign`.
/// The trials are the same ones: their seeds follow each other.
inline int survey_size(int gate, int all) { return std::getenv("TRUEFLANK_CAMPAIGN") != nullptr ? all : gate; }

/// Of so many trials, where each is right with this chance: fewer come once in a thousand surveys
/// of the campaign. The gate asks the same few seeds each time, which were seen to hold: two
/// standard deviations there, so that ten trials tell as much as twenty would with the campaign's
/// three.
inline int seldom_fewer(int runs, double chance) {
  const double deviations = std::getenv("TRUEFLANK_CAMPAIGN") != nullptr ? 3.1 : 2.0;
  return static_cast<int>(
      std::floor(runs * chance - deviations * std::sqrt(runs * chance * (1.0 - chance))));
}

}  // namespace trueflank::test
