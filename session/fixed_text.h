// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

// Numbers in texts and tables: the same in every locale that a host program may have set.
namespace trueflank {

/// With so many decimals: "0.50".
[[nodiscard]] std::string fixed_text(double value, int decimals);
/// The same with its sign, + too.
[[nodiscard]] std::string signed_text(double value, int decimals);
/// At most so many digits, the shorter of both notations: "0.5", "1e-09".
[[nodiscard]] std::string general_text(double value, int digits = 6);

/// Spaces before (after) a text, up to a width.
[[nodiscard]] std::string right_aligned(const std::string& text, std::size_t width);
[[nodiscard]] std::string left_aligned(const std::string& text, std::size_t width);

}  // namespace trueflank
