// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"

namespace trueflank {

/// What a new design is to be.
struct DesignWishes {
  std::string kind = "3k";
  std::string input, output;  ///< members; empty: the usual ones of the kind
  double ratio = 0.0;         ///< input over output speed; met within 2 %
  std::string motor;          ///< of the table; empty: gears alone
  std::string process = "fdm-0.4";
  std::string material =
      "pla";  ///< its name, or the beginning of the only one that goes on with "-"
  double outer_diameter_mm = 90.0;  ///< of the housing, at most
  std::string bed;                  ///< of the printer, as in find_bed; empty: no print plates
  std::string tools;                ///< file of own motors and processes; empty: none
  std::string tools_named;          ///< the same, as the design file names it
};

struct WishedDesign {
  std::string text;               ///< the design file
  std::vector<std::string> told;  ///< what was chosen and why, a sentence each
};

/// Searches tooth numbers and shifts for the best forward efficiency (3k) or the largest torque
/// (other kinds) among the sets of which no check fails or warns, with housing and bearings where a
/// motor is named. Errors: kUsage (a name that is not known, a kind that is not searched),
/// kInfeasible where nothing is found: the remedy names changed wishes that were tried and give a
/// design.
[[nodiscard]] ResultAll<WishedDesign> wished_design(const std::string& name,
                                                    const DesignWishes& wishes);

}  // namespace trueflank
