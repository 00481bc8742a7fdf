// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/table/alike_rows.h"

namespace trueflank::loop {

/// Values of effects at rows of one table, kept for where the same is asked again: half to four
/// fifths of what is tried was tried before. As many as memory for them is given; when it is full
/// all are forgotten. Threads may share it. They are of the places the table had: where these
/// change, a new one begins (SharedTable::own).
class EffectValues {
 public:
  /// A matrix with a row for each of the table's, and a column for each of the effect's.
  using Values = std::shared_ptr<const Eigen::MatrixXd>;
  /// Tells sets of rows apart.
  static std::uint64_t key_of(const std::vector<std::uint32_t>& rows);
  /// Empty: not kept. `rows`: their key.
  [[nodiscard]] Values find(const Effect& effect, std::uint64_t rows) const;
  void keep(const Effect& effect, std::uint64_t rows, Values values);
  /// Rows of traces that differ by the tooth alone. `key`: of these rows.
  [[nodiscard]] std::shared_ptr<const AlikeRows> alike(const Observations& table,
                                                       const std::vector<std::uint32_t>& rows,
                                                       std::uint64_t key);

 private:
  struct Kept {
    Effect effect;
    std::uint64_t rows = 0;
    Values values;
  };
  mutable std::mutex mutex_;
  std::unordered_multimap<std::uint64_t, Kept> kept_;
  Eigen::Index count_ = 0;  ///< of all values
  /// By the key of the rows; the last ones that were asked for.
  std::vector<std::pair<std::uint64_t, std::shared_ptr<const AlikeRows>>> alike_;
};

}  // namespace trueflank::loop
