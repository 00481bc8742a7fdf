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

/// With at most so many decimals (0 to 15), none of them an idle zero: "46", "0.25"; never "-0".
[[nodiscard]] std::string trimmed_number(double value, int decimals = 6);

/// A length for a message, to the micrometre: "12.500".
[[nodiscard]] inline std::string fixed_mm(double value_mm) { return printed_number(value_mm, "%.3f"); }
/// The same as a whole number of micrometres: "12 um".
[[nodiscard]] std::string whole_um(double length_mm);

/// "a, b, c"
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

}  // namespace trueflank
