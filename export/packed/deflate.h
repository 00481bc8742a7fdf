// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Packing and unpacking of what 3MF files hold (RFC 1951). Packing is our own, so that the bytes depend on
// the text alone, on every processor and with every version of a library; libdeflate unpacks.
namespace trueflank::io {

/// Appends `text` to `bytes`, packed into blocks of which none is the last, from a whole byte to a whole
/// byte: what was packed apart can be put one behind the other.
/// Guarantees: at most 10 bytes more than the text for each 64 kB begun.
void append_deflated(std::string& bytes, std::string_view text);

/// The block that ends such a row of blocks.
constexpr std::string_view kLastDeflatedBlock{"\3\0", 2};

/// Fills `content` with exactly what `packed` holds; false where it is damaged or of another size.
[[nodiscard]] bool inflate(std::string_view packed, std::string& content);

/// What a row of blocks holds of which none is the last, at most `most_bytes`. Errors: nothing
/// where it is damaged, where it goes on beyond its end or begins before it, and where it holds
/// more.
[[nodiscard]] std::optional<std::string> inflated_row(std::string_view packed,
                                                      std::size_t most_bytes);

/// CRC-32 as zip has it, of `text` behind a text whose checksum is `before`.
[[nodiscard]] std::uint32_t checksum(std::string_view text, std::uint32_t before = 0);

/// The checksum of two texts one behind the other, from theirs and the second one's size.
[[nodiscard]] std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second,
                                            std::size_t second_bytes);

}  // namespace trueflank::io
