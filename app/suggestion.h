// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace trueflank::app {

/// The word of a list that is most like a mistyped one; empty where none is near: letters left out,
/// added, changed or swapped with a neighbour, one for every three of the word.
[[nodiscard]] std::string nearest_word(const std::string& typed, const std::vector<std::string>& words);

}  // namespace trueflank::app
