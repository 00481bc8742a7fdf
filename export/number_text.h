// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

// Numbers as text: the same on every machine and in every locale.
namespace trueflank::io {

/// Rounded to 10^-6, trailing zeros dropped: a nanometre where the number is in millimetres. Never
/// "-0". Not a number and what exceeds 9e12 is written as append_shortest does.
void append_decimal(std::string& text, double value);
[[nodiscard]] std::string decimal_text(double value);

/// The shortest digits that read back as the same double.
void append_shortest(std::string& text, double value);
/// The shortest digits that read back as the same float.
void append_shortest(std::string& text, float value);

void append_integer(std::string& text, std::int64_t value);

/// @name The same into memory of the caller's, for millions of numbers; the end of the text.
/// Requires: room for kNumberRoom characters.
/// @{
inline constexpr std::size_t kNumberRoom = 32;
[[nodiscard]] char* put_decimal(char* at, double value);
[[nodiscard]] char* put_integer(char* at, std::uint32_t value);
/// @}

}  // namespace trueflank::io
