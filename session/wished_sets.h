// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/search/search_requirements.h"

namespace trueflank {

/// What is searched of a train when a design is wished for: tooth numbers that are small enough for
/// teeth that can be printed, and what the best is judged by.
struct WishedSets {
  std::string kind, input, output;
  double ratio_min = 1.0, ratio_max = 1.0;  ///< that such tooth numbers have
  ToothRange sun, planet1, planet2, ring;
  double face_width_mm = 10.0;
  SearchObjective objective = SearchObjective::kForward;
};

/// All of them, the usual input and output of each kind first.
[[nodiscard]] const std::vector<WishedSets>& all_wished_sets();

/// The first of a kind with this input and output; empty names mean any. nullptr: none.
[[nodiscard]] const WishedSets* find_wished_sets(const std::string& kind, const std::string& input,
                                                 const std::string& output);

}  // namespace trueflank
