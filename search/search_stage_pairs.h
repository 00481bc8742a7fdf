// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <vector>

#include "trueflank/search/search_record.h"
#include "trueflank/search/search_stages.h"

// Which stages of trains in series are optimised, and which pairs of them are listed.
namespace trueflank {

struct StageRunOptions {
  std::size_t listed = 0;  ///< pairs
  std::size_t threads = 1;
  SearchPart part;                          ///< pairs whose first stage it holds
  std::vector<SearchRecord> done;           ///< of an earlier run: not computed again
  const std::atomic<bool>* stop = nullptr;  ///< set: what is under way is finished, no more started
  /// Called for every stage newly optimised, in a fixed order.
  std::function<void(const SearchRecord&)> on_record;
};
struct StageRun {
  std::vector<SearchRecord> stages;  ///< optimised, by index; of earlier runs too
  bool stopped = false;
};
/// Optimises stages until no other pair can be among those listed. A stage is optimised once a pair
/// with it could be among them by what bounds (search_bound.h) say; those of the most promising
/// pairs first, in a fixed order: the same on any number of threads.
[[nodiscard]] StageRun run_stages(const SearchRequirements& requirements,
                                  const std::vector<ToothSet>& stages,
                                  const StageRunOptions& options);

struct RankedPair {
  std::array<std::size_t, 2> stages{};  ///< indices
  StagePair pair;
  SearchCandidate whole;
};
/// Of all pairs of optimised stages that keep the ratio and every limit asked for those that are
/// listed: the best `listed` by one objective; by several all that fewer others dominate.
[[nodiscard]] std::vector<RankedPair> best_stage_pairs(const SearchRequirements& requirements,
                                                       const std::vector<ToothSet>& stages,
                                                       const std::vector<SearchRecord>& optimised,
                                                       std::size_t listed);
/// The stages of those, among pairs of one part.
[[nodiscard]] std::vector<SearchRecord> stages_of_best_pairs(
    const SearchRequirements& requirements, const std::vector<ToothSet>& stages,
    const std::vector<SearchRecord>& optimised, std::size_t listed, const SearchPart& part);

}  // namespace trueflank
