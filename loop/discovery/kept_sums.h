// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "trueflank/loop/discovery/discovery.h"

namespace trueflank::loop {

class BlockStatistics;

/// Sums over the candidates of a problem from which choices are made again and again: what stayed
/// is not summed once more. They belong to one choice at a time. The sums are the same numbers as
/// those made anew. Weights come and go with steps (patches across them are left out): sums of
/// earlier weights stay beside those of the last ones, as memory for them is given.
class KeptSums {
 public:
  KeptSums();
  ~KeptSums();
  KeptSums(const KeptSums&) = delete;
  KeptSums& operator=(const KeptSums&) = delete;

  /// The columns of a group are others than before.
  void forget(std::size_t group);
  /// For a choice from a problem whose candidates are those of the last one but for groups
  /// forgotten since.
  [[nodiscard]] std::unique_ptr<BlockStatistics> taken_for(const DiscoveryProblem& problem);
  /// After the choice.
  void give_back(std::unique_ptr<BlockStatistics> sums);

 private:
  struct OfRows;
  void make_room();
  std::vector<OfRows> kept_;  ///< those asked for last first
};

}  // namespace trueflank::loop
