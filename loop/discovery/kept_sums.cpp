// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/kept_sums.h"

#include <algorithm>
#include <utility>

#include "trueflank/loop/discovery/block_statistics.h"

namespace trueflank::loop {

/// Sums of one set of rows: values, weights, units, folds.
struct KeptSums::OfRows {
  DiscoveryProblem of;  ///< without its columns
  std::unique_ptr<BlockStatistics> sums;
  std::vector<bool> forgotten;  ///< groups

  [[nodiscard]] bool has_rows_of(const DiscoveryProblem& problem) const {
    return of.value == problem.value && of.weight == problem.weight && of.unit == problem.unit &&
           of.fold == problem.fold && of.zero == problem.zero && of.whole == problem.whole;
  }
  [[nodiscard]] bool stayed(const DiscoveryProblem& problem, std::size_t group) const {
    if (group < forgotten.size() && forgotten[group]) return false;
    if (group >= of.groups.size()) return false;
    const CandidateGroup &before = of.groups[group], &now = problem.groups[group];
    return before.first_column == now.first_column && before.columns == now.columns;
  }
};

KeptSums::KeptSums() = default;
KeptSums::~KeptSums() = default;

void KeptSums::forget(std::size_t group) {
  for (OfRows& kept : kept_) {
    if (group >= kept.forgotten.size()) kept.forgotten.resize(group + 1, false);
    kept.forgotten[group] = true;
  }
}

/// Those asked for longest ago go where all take too much memory.
void KeptSums::make_room() {
  constexpr std::size_t kMostBytes = 48'000'000;
  std::size_t bytes = 0;
  std::erase_if(kept_, [&](const OfRows& kept) {
    if (kept.sums != nullptr) bytes += kept.sums->bytes();
    return kept.sums == nullptr || bytes > kMostBytes;
  });
}

std::unique_ptr<BlockStatistics> KeptSums::taken_for(const DiscoveryProblem& problem) {
  OfRows taken;
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const OfRows& kept) { return kept.has_rows_of(problem); });
  if (found != kept_.end()) {
    taken = std::move(*found);
    kept_.erase(found);
  }
  make_room();
  std::unique_ptr<BlockStatistics> sums;
  if (taken.sums != nullptr) {
    std::vector<bool> stayed;
    for (std::size_t g = 0; g < problem.groups.size(); ++g)
      stayed.push_back(taken.stayed(problem, g));
    sums = std::make_unique<BlockStatistics>(problem, std::move(*taken.sums), stayed);
  } else {
    sums = std::make_unique<BlockStatistics>(problem);
    taken.of.value = problem.value;
    taken.of.weight = problem.weight;
    taken.of.unit = problem.unit;
    taken.of.fold = problem.fold;
    taken.of.zero = problem.zero;
    taken.of.whole = problem.whole;
  }
  taken.of.groups = problem.groups;
  taken.forgotten.clear();
  taken.sums.reset();
  kept_.insert(kept_.begin(), std::move(taken));
  return sums;
}

void KeptSums::give_back(std::unique_ptr<BlockStatistics> sums) {
  kept_.front().sums = std::move(sums);
}

}  // namespace trueflank::loop
