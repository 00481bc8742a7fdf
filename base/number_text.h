// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

// Numbers and lists as text: the same in every locale that a host program may have set.
namespace trueflank {

/// As std::printf writes it in the C locale, with the compiler's check of the arguments.
/// Knows d, i, u (with l, ll, z), s, c, f, e, g and %%, with flags, width and precision.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

/// One number by a format such as "%.2f"; never "-0".
[[nodiscard]] std::string printed_number(double value, const char* format = "%.2f");

/// "a, b, c"
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

}  // namespace trueflank
