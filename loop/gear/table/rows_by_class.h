// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// The rows of a table by class (a flank, a patch), each class in the order of the table. Classes
/// are then summed on all processors, and every sum is added up in the order it would be added up
/// in by one of them: the same digits on any number of processors. Two bytes a row.
class RowsByClass {
 public:
  /// `class_of(row)` is below `classes`; negative: of none.
  template <class ClassOf>
  RowsByClass(std::size_t rows, std::size_t classes, const ClassOf& class_of)
      : chunk_(rows < kManyRows ? kMostOfChunk / 4 : kMostOfChunk), chunks_((rows + chunk_ - 1) / chunk_) {
    for_each_piece(chunks_.size(), [&](std::size_t c) {
      const std::size_t from = c * chunk_;
      chunks_[c] = sorted(from, std::min(rows, from + chunk_), classes, class_of);
    });
  }
  /// `visit(row)` for the rows of a class, in order.
  template <class Visit>
  void for_each(std::size_t of_class, const Visit& visit) const {
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const Chunk& chunk = chunks_[c];
      for (std::size_t k = chunk.first[of_class]; k < chunk.first[of_class + 1]; ++k)
        visit(c * chunk_ + chunk.rows[k]);
    }
  }
  /// The same, with the rows and places to come fetched from memory ahead: where the points of a
  /// scan are in no order, those of a class lie far apart.
  template <class Visit>
  void for_each(std::size_t of_class, const Observations& table, const Visit& visit) const {
    constexpr std::size_t kRowsAhead = 24, kPlacesAhead = 12;
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const Chunk& chunk = chunks_[c];
      const Observation* const rows = table.rows.data() + c * chunk_;
      const std::size_t end = chunk.first[of_class + 1];
      for (std::size_t k = chunk.first[of_class]; k < end; ++k) {
        if (k + kRowsAhead < end) __builtin_prefetch(rows + chunk.rows[k + kRowsAhead]);
        if (k + kPlacesAhead < end) fetch_place(table, rows[chunk.rows[k + kPlacesAhead]]);
        visit(c * chunk_ + chunk.rows[k]);
      }
    }
  }
  [[nodiscard]] std::size_t count(std::size_t of_class) const {
    std::size_t rows = 0;
    for (const Chunk& chunk : chunks_) rows += chunk.first[of_class + 1] - chunk.first[of_class];
    return rows;
  }

 private:
  static constexpr std::size_t kMostOfChunk = 65536;
  static constexpr std::size_t kManyRows = 524288;  // fewer are cut finer, so that processors end together
  struct Chunk {
    std::vector<std::uint32_t> first;  ///< of each class in `rows`, and the end
    std::vector<std::uint16_t> rows;   ///< from the chunk's first on
  };

  static void fetch_place(const Observations& table, const Observation& row) {
    const Place* const place = &table.place(row);
    __builtin_prefetch(place);
    __builtin_prefetch(reinterpret_cast<const char*>(place + 1) - 1);  // its last byte
  }
  template <class ClassOf>
  static Chunk sorted(std::size_t from, std::size_t to, std::size_t classes,
                      const ClassOf& class_of) {
    std::vector<int> own(to - from);
    Chunk chunk;
    chunk.first.assign(classes + 1, 0);
    for (std::size_t i = from; i < to; ++i) {
      own[i - from] = class_of(i);
      if (own[i - from] >= 0) ++chunk.first[static_cast<std::size_t>(own[i - from]) + 1];
    }
    for (std::size_t k = 0; k < classes; ++k) chunk.first[k + 1] += chunk.first[k];
    chunk.rows.resize(chunk.first.back());
    std::vector<std::uint32_t> next(chunk.first.begin(), chunk.first.end() - 1);
    for (std::size_t k = 0; k < own.size(); ++k)
      if (own[k] >= 0)
        chunk.rows[next[static_cast<std::size_t>(own[k])]++] = static_cast<std::uint16_t>(k);
    return chunk;
  }

  std::size_t chunk_;  ///< rows
  std::vector<Chunk> chunks_;
};

}  // namespace trueflank::loop
