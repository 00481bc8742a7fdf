// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <vector>

#include "trueflank/search/search_model.h"
#include "trueflank/search/search_requirements.h"

namespace trueflank {

/// One design of a tooth set: where its free variables stand and what that is worth.
struct SearchCandidate {
  FreeShifts free;
  double forward = kNaN, backward = kNaN;
  double torque_nm = kNaN;  ///< allowable at the output
  double size_mm = kNaN;    ///< outer diameter of the larger ring
  double least_margin = kNaN;

  /// Larger is better, whatever the objective.
  [[nodiscard]] double merit(SearchObjective objective) const;
};

/// What the continuous optimisation of one tooth set found.
struct SetResult {
  std::vector<SearchCandidate> candidates;  ///< empty: nothing keeps all limits
  /// Index into limit_entries() of the limit that could be kept least; kLimits: the torque asked for;
  /// -1 where there is a candidate, or a start that led to none.
  int failed_limit = -1;
  int evaluations = 0;  ///< of a layer
};

/// Extra distance kept from each kind of limit, where an exact check found a design too close.
using LimitReserve = std::array<double, 8>;  // index = Limit

/// Best shifts and centre distance of a tooth set. The starts come from grids that use how the layers
/// decouple at a fixed centre distance; from the best of them SLSQP, then Subplex with a price on
/// breaches (both NLopt) go to the optimum. One objective gives one candidate; several give the
/// optimum of each and, between the first and each other, compromises.
/// Guarantees: candidates keep every limit; the same input gives the same candidates; it ends (COBYLA
/// would not always: docs/decisions/0060-search-optimiser.md).
/// Accuracy: within 2e-4 of the best of a dense grid, tested in tests/train/search_optimise_test.cpp.
[[nodiscard]] SetResult optimise_set(const SearchRequirements& requirements, const ToothSet& set,
                                     const LimitReserve& reserve = {});

/// All values of a design at given free variables; least_margin < 0 where it breaks a limit.
[[nodiscard]] SearchCandidate evaluate_candidate(const SearchRequirements& requirements,
                                                 const SearchModel& model, const FreeShifts& free,
                                                 const LimitReserve& reserve = {});

}  // namespace trueflank
