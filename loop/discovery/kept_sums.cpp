// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/kept_sums.h"

#include <utility>

#include "trueflank/loop/discovery/block_statistics.h"

namespace trueflank::loop {

KeptSums::KeptSums() = default;
KeptSums::~KeptSums() = default;

void KeptSums::forget(std::size_t group) {
  if (group >= forgotten_.size()) forgotten_.resize(group + 1, false);
  forgotten_[group] = true;
}

bool KeptSums::has_same_rows(const DiscoveryProblem& problem) const {
  return of_.value == problem.value && of_.weight == problem.weight && of_.unit == problem.unit &&
         of_.fold == problem.fold && of_.zero == problem.zero && of_.whole == problem.whole;
}

bool KeptSums::stayed(const DiscoveryProblem& problem, std::size_t group) const {
  if (group < forgotten_.size() && forgotten_[group]) return false;
  if (group >= of_.groups.size()) return false;
  const CandidateGroup &before = of_.groups[group], &now = problem.groups[group];
  return before.first_column == now.first_column && before.columns == now.columns;
}

std::unique_ptr<BlockStatistics> KeptSums::taken_for(const DiscoveryProblem& problem) {
  std::unique_ptr<BlockStatistics> sums;
  if (sums_ != nullptr && has_same_rows(problem)) {
    std::vector<bool> kept;
    for (std::size_t g = 0; g < problem.groups.size(); ++g) kept.push_back(stayed(problem, g));
    sums = std::make_unique<BlockStatistics>(problem, std::move(*sums_), kept);
  } else {
    sums = std::make_unique<BlockStatistics>(problem);
  }
  sums_.reset();
  forgotten_.clear();
  of_.value = problem.value;
  of_.weight = problem.weight;
  of_.unit = problem.unit;
  of_.fold = problem.fold;
  of_.zero = problem.zero;
  of_.whole = problem.whole;
  of_.groups = problem.groups;
  return sums;
}

void KeptSums::give_back(std::unique_ptr<BlockStatistics> sums) { sums_ = std::move(sums); }

}  // namespace trueflank::loop
