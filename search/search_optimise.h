// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <vector>

#include "trueflank/search/search_figures.h"
#include "trueflank/search/search_model.h"
#include "trueflank/search/search_requirements.h"

namespace trueflank {

/// One design of a tooth set: where its free variables stand and what that is worth.
struct SearchCandidate {
  FreeShifts free;
  double forward = kNaN, backward = kNaN;
  DesignDimensions dimensions;
  double torque_nm = kNaN;  ///< allowable at the output
  double size_mm = kNaN;    ///< outer diameter of the larger ring
  DesignFigures figures;
  double score = kNaN;  ///< of a weighted ranking
  double least_margin = kNaN;
  /// Of the objective an efficiency was swept for: what may be lacking, as measured (search_sweep.h); NaN: not measured.
  double gap = kNaN;

  /// Larger is better, whatever the objective.
  [[nodiscard]] double merit(SearchObjective objective) const;
  [[nodiscard]] double value(SearchObjective objective) const;
};

/// What the continuous optimisation of one tooth set found.
struct SetResult {
  std::vector<SearchCandidate> candidates;  ///< empty: nothing keeps all limits
  /// Index into SearchTrain::limits of the limit that could be kept least; from kLimits on: into
  /// asked_limits(); -1 where there is a candidate, or a start that led to none.
  int failed_limit = -1;
  int evaluations = 0;  ///< of a layer
};

/// Extra distance kept from each kind of limit, where an exact check found a design too close.
using LimitReserve = std::array<double, 8>;  // index = Limit

/// Best shifts and centre distance of a tooth set. An efficiency is swept for (search_sweep.h); torque, size and
/// compromises climb from the sweep's peaks by SLSQP, then Subplex with a price on breaches (both NLopt). One
/// objective gives one candidate; several give the optimum of each and, between the first and each other,
/// compromises.
/// Guarantees: candidates keep every limit; the same input gives the same candidates; it ends (COBYLA
/// would not always: docs/decisions/0060-search-optimiser.md).
/// Accuracy: efficiencies within 1e-5 of dense grids with refinement, tested in tests/search/search_sweep_test.cpp.
[[nodiscard]] SetResult optimise_set(const SearchRequirements& requirements, const ToothSet& set,
                                     const LimitReserve& reserve = {});

/// All values of a design at given free variables; least_margin < 0 where it breaks a limit.
[[nodiscard]] SearchCandidate evaluate_candidate(const SearchRequirements& requirements,
                                                 const SearchModel& model, const FreeShifts& free,
                                                 const LimitReserve& reserve = {});

}  // namespace trueflank
