// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/search/search_optimise.h"

// Which limits a design stands on, and what each costs.
namespace trueflank {

/// A limit that binds: a key of the requirements file, or what teeth are by their nature.
struct BindingLimit {
  std::string limit;  ///< "shift", "contact_ratio", "fillet_interference", "mass", "teeth", "ratio"
  std::string where;  ///< gears or meshes by commas; empty: the whole design
  std::string key;    ///< "shift.max"; empty: none can be relaxed
  double value = kNaN, relaxed = kNaN;  ///< of the key, as it is and as tried
  /// What the first objective is with the key at `relaxed` and all else as it is; NaN: not computed.
  double objective = kNaN;
};

/// The limits that a design of a set stands on, each relaxed by a step of its own (a tenth of a
/// module of shift, half a clearance, a tenth of a figure), and the set optimised again where
/// `costs` are asked for.
/// Requires: the candidate is an optimum of the set within the requirements.
[[nodiscard]] std::vector<BindingLimit> binding_limits(const SearchRequirements& requirements,
                                                       const ToothSet& set,
                                                       const SearchCandidate& candidate,
                                                       const LimitReserve& reserve = {},
                                                       bool costs = true);

/// The tooth ranges and ends of the ratio on which a design stands, each with the best of the sets
/// just beyond (as many teeth more as there are planets, a hundredth of the ratio) where that is
/// better. Ranges of one number are wishes. Computed where one efficiency ranks and bounds are known
/// (listed_sets).
[[nodiscard]] std::vector<BindingLimit> binding_ranges(const SearchRequirements& requirements,
                                                       const ToothSet& set,
                                                       const SearchCandidate& candidate);

}  // namespace trueflank
