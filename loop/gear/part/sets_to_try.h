// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

// In place of which effects of an answer a form is tried: lists of their numbers.
namespace trueflank::loop {

/// All of these, and all less each name, and less all names; none that is empty.
[[nodiscard]] std::vector<std::vector<std::size_t>> with_and_without(
    const std::vector<std::size_t>& all, const std::vector<std::size_t>& names);
/// All of these where they are more than two, every two, and each by itself.
[[nodiscard]] std::vector<std::vector<std::size_t>> all_pairs_and_each(
    const std::vector<std::size_t>& all);

}  // namespace trueflank::loop
