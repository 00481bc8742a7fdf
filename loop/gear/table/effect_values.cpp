// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/effect_values.h"

#include <bit>
#include <utility>

#include "trueflank/loop/discovery/mixed_bits.h"

namespace trueflank::loop {
namespace {

std::uint64_t key_of(const Effect& effect, std::uint64_t rows) {
  std::uint64_t key = mixed_bits(rows, static_cast<std::uint64_t>(effect.flank));
  for (const double value : effect.shape)
    key = mixed_bits(key, std::bit_cast<std::uint64_t>(value));
  return key;
}

}  // namespace

std::uint64_t EffectValues::key_of(const std::vector<std::uint32_t>& rows) {
  std::uint64_t key = rows.size();
  for (const std::uint32_t row : rows) key = mixed_bits(key, row);
  return key;
}

EffectValues::Values EffectValues::find(const Effect& effect, std::uint64_t rows) const {
  const std::scoped_lock lock(mutex_);
  const auto [first, last] = kept_.equal_range(loop::key_of(effect, rows));
  for (auto it = first; it != last; ++it)
    if (it->second.rows == rows && it->second.effect == effect) return it->second.values;
  return nullptr;
}

void EffectValues::keep(const Effect& effect, std::uint64_t rows, Values values) {
  constexpr Eigen::Index kMost = 6'000'000, kMostOfOne = kMost / 64;
  const Eigen::Index count = values->size();
  if (count > kMostOfOne) return;
  const std::scoped_lock lock(mutex_);
  if (count_ + count > kMost) {
    kept_.clear();
    count_ = 0;
  }
  count_ += count;
  kept_.emplace(loop::key_of(effect, rows), Kept{effect, rows, std::move(values)});
}

std::shared_ptr<const AlikeRows> EffectValues::alike(const Observations& table,
                                                     const std::vector<std::uint32_t>& rows,
                                                     std::uint64_t key) {
  constexpr std::size_t kMost = 4;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [of_rows, kept] : alike_)
      if (of_rows == key) return kept;
  }
  auto found = std::make_shared<const AlikeRows>(alike_rows(table, rows));
  const std::scoped_lock lock(mutex_);
  if (alike_.size() == kMost) alike_.erase(alike_.begin());
  alike_.emplace_back(key, found);
  return found;
}

}  // namespace trueflank::loop
