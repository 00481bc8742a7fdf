// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

// The joint cure on random designs that fail.
namespace trueflank::test {

struct CureSurvey {
  int failing = 0;        ///< designs that fail, each put to the cure
  int cured = 0;
  int worse = 0;          ///< more failing checks than before
  int claims_broken = 0;  ///< the findings told are not those of the design given
  double seconds = 0.0, longest_s = 0.0;
};
/// Goes through random_design() until so many fail; prints the counts.
[[nodiscard]] CureSurvey survey_cures(std::uint64_t first_seed, int failing);

}  // namespace trueflank::test
