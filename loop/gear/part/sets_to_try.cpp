// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/sets_to_try.h"

namespace trueflank::loop {

std::vector<std::vector<std::size_t>> with_and_without(const std::vector<std::size_t>& all,
                                                       const std::vector<std::size_t>& names) {
  std::vector<std::vector<std::size_t>> sets{all};
  for (const std::size_t kept : names) {
    sets.push_back(all);
    std::erase(sets.back(), kept);
  }
  if (names.size() > 1) {
    sets.push_back(all);
    for (const std::size_t kept : names) std::erase(sets.back(), kept);
  }
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

std::vector<std::vector<std::size_t>> all_pairs_and_each(const std::vector<std::size_t>& all) {
  std::vector<std::vector<std::size_t>> sets;
  if (all.size() > 2) sets.push_back(all);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b) sets.push_back({all[a], all[b]});
  for (const std::size_t one : all) sets.push_back({one});
  return sets;
}

}  // namespace trueflank::loop
