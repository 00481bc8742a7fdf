// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_optimise.h"

// Trains of two stages in series. The stages share nothing but their speeds and torques: each is a
// tooth set of its own, enumerated and optimised once, and pairs are put together from those: at
// most n1 + n2 optimisations for n1 n2 trains, and far fewer as bounds tell which stages are worth
// it.
namespace trueflank {

/// What a stage alone is asked for; the requirements themselves of a set that is no stage. The
/// second stage carries the whole's output torque. Objectives are efficiencies of the meshes;
/// figures that only the whole has (mass, length, what needs the motor or the losses) are left to
/// the pairs.
[[nodiscard]] SearchRequirements stage_requirements(const SearchRequirements& requirements,
                                                    const ToothSet& set);

/// optimise_set() of a whole train or of a stage alone.
[[nodiscard]] SetResult optimise_set_or_stage(const SearchRequirements& requirements,
                                              const ToothSet& set,
                                              const LimitReserve& reserve = {});

/// Two stages that make a train, in their order.
struct StagePair {
  std::array<ToothSet, 2> sets;
  std::array<SearchCandidate, 2> candidates;
};

/// Input speed over output speed.
[[nodiscard]] double signed_ratio(const StagePair& pair);

/// The design file's design of the whole.
[[nodiscard]] GearboxDesign design_of_stages(const SearchRequirements& requirements,
                                             const StagePair& pair);

/// The values of the whole; `free` is the first stage's.
[[nodiscard]] SearchCandidate evaluate_stages(const SearchRequirements& requirements,
                                              const StagePair& pair);

struct RankedPair {
  StagePair pair;
  SearchCandidate whole;
};
struct StagePairs {
  std::vector<RankedPair> best;  ///< best first
  std::size_t optimised = 0;     ///< stages that had to be
  long long evaluations = 0;     ///< of a layer
};
/// Of all pairs of stages the best by the first objective that keep the ratio and every limit asked
/// for, `count` at most. A stage is optimised once a pair with it is among the best by what bounds
/// (search_bound.h) say, in a fixed order: the same on any number of threads.
[[nodiscard]] StagePairs best_stage_pairs(const SearchRequirements& requirements,
                                          const std::vector<ToothSet>& stages, std::size_t count);

}  // namespace trueflank
