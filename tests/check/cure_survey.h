// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "trueflank/check/cure/joint_cure.h"

// The joint cure on random designs that fail.
namespace trueflank::test {

struct CureSurvey {
  int failing = 0;        ///< designs that fail, each put to the cure
  int cured = 0;
  int worse = 0;          ///< more failing checks than before
  int newly_failing = 0;  ///< designs in which a check fails that passed before
  int claims_broken = 0;  ///< the findings told are not those of the design as it is read from its file
  double seconds = 0.0, longest_s = 0.0;  ///< of the processor
};
/// Goes through random_design() until so many fail; prints the counts. Every cured design is written into the file
/// of the failing one, as `trueflank fix` does, read back and checked anew.
[[nodiscard]] CureSurvey survey_cures(std::uint64_t first_seed, int failing, const JointCureOptions& options = {});

}  // namespace trueflank::test
