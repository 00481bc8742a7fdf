// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::test {

/// What comparing random modified designs with brute force found.
struct ModifiedComparison {
  int designs = 0;
  int penetrate = 0;        ///< centred, both say so
  int wrong_verdicts = 0;   ///< outside a grey zone of 1 um
  int compared = 0;         ///< clearances inside the simulation's window
  double largest_difference_mm = 0.0;
};

/// Random modified designs of seeds from `first`, centred and driving on either side, against sections
/// sampled from the surface that meshes are made of, at `heights` heights of the common face.
[[nodiscard]] ModifiedComparison compare_modified(unsigned first, int designs, int heights);

}  // namespace trueflank::test
