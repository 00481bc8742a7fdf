// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_optimise.h"

// Trains of two stages in series. The stages share nothing but their speeds and torques: each is a
// tooth set of its own, enumerated and optimised once, and pairs are put together from those
// (search_stage_pairs.h): at most n1 + n2 optimisations for n1 n2 trains.
namespace trueflank {

/// What a stage alone is asked for; the requirements themselves of a set that is no stage. The
/// second stage carries the whole's output torque. Objectives are the stage's share in the whole's,
/// efficiencies those of the meshes; limits on what only the whole has (mass, length, what needs
/// the motor or the losses) are left to the pairs.
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

/// With the first stage as wide and of such a module as the output torque asked for needs behind
/// this second stage, where they may grow.
[[nodiscard]] StagePair carrying(const SearchRequirements& requirements, StagePair pair);

/// The best train that two stages' designs make, by the first objective; nothing where one has
/// none.
[[nodiscard]] std::optional<StagePair> best_pair(
    const SearchRequirements& requirements, const std::array<ToothSet, 2>& sets,
    const std::array<std::vector<SearchCandidate>, 2>& designs);

/// The values of the whole; `free` and `dimensions` are the first stage's.
[[nodiscard]] SearchCandidate evaluate_stages(const SearchRequirements& requirements,
                                              const StagePair& pair);

/// What the stages alone say of the whole they would be when it carries what is asked for:
/// efficiencies, size, mass, length, torque and what follows from them, least contact ratio,
/// greatest sliding; NaN for the rest. Accuracy: torque 5 % where the losses are by the formula;
/// else rounding.
[[nodiscard]] SearchCandidate composed_of_stages(const SearchRequirements& requirements,
                                                 const StagePair& pair);
/// Cheap, and never wrong: whether the whole may keep a limit, by what is composed of its stages.
[[nodiscard]] bool may_keep(const FigureLimit& limit, const SearchCandidate& composed);

/// Figures by which a train in series can be ranked: sums, products or extremes of its stages'
/// figures give them.
[[nodiscard]] bool is_of_stages(SearchObjective objective);

}  // namespace trueflank
