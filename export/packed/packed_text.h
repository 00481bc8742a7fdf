// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "trueflank/export/packed/deflate.h"

namespace trueflank::io {

/// Text, deflated as it comes (RFC 1951, without the last block), so that packed texts can be put one
/// behind the other. The same text, appended in the same pieces, gives the same bytes on every processor.
class PackedText {
 public:
  PackedText() = default;
  explicit PackedText(std::string_view text) { append(text); }

  void append(std::string_view text);
  /// What was packed elsewhere; costs no second packing.
  void append(const PackedText& other);
  /// Text to be filled by the caller, at its end; pack_when_full() afterwards.
  [[nodiscard]] std::string& open_text() { return open_; }
  void pack_when_full() {
    if (open_.size() >= kBlockBytes) pack();
  }
  /// No text is left open. Call before the following are asked for.
  void close() { pack(); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t text_bytes() const { return text_bytes_; }
  /// CRC-32 of the text, as zip has it.
  [[nodiscard]] std::uint32_t checksum() const { return checksum_; }
  /// The block that ends a deflated entry.
  static constexpr std::string_view kLastBlock = kLastDeflatedBlock;

 private:
  static constexpr std::size_t kBlockBytes = 128 * 1024;
  void pack();

  std::string open_;   ///< not yet packed
  std::string bytes_;
  std::size_t text_bytes_ = 0;
  std::uint32_t checksum_ = 0;
};

}  // namespace trueflank::io
