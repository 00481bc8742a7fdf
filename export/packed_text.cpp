// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/packed_text.h"

#include <isa-l.h>
#include <zlib.h>

#include <algorithm>
#include <memory>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

constexpr std::size_t kSampleBytes = 16 * 1024;  // of a block

}  // namespace

void PackedText::append(std::string_view text) {
  open_ += text;
  pack_when_full();
}

void PackedText::append(const PackedText& other) {
  TRUEFLANK_EXPECTS(other.open_.empty());
  pack();
  bytes_ += other.bytes_;
  checksum_ = static_cast<std::uint32_t>(
      crc32_combine(checksum_, other.checksum_, static_cast<z_off_t>(other.text_bytes_)));
  text_bytes_ += other.text_bytes_;
}

/// Blocks know nothing of each other ("full flush") and end on a byte.
void PackedText::pack() {
  if (open_.empty()) return;
  struct Packer {
    isal_zstream stream;
    isal_huff_histogram histogram;
    isal_hufftables code;
  };
  const auto packer = std::make_unique<Packer>();  // cleared: isa-l leaves members as they were
  isal_zstream& stream = packer->stream;
  isal_deflate_stateless_init(&stream);
  auto* const text = reinterpret_cast<std::uint8_t*>(open_.data());
  // Level 0 with a code of its own: what levels 1 and 2 find depends, once in a hundred times, on where
  // the memory lies. The code has all symbols, so a part of the text may stand for all.
  isal_update_histogram(text, static_cast<int>(std::min(open_.size(), kSampleBytes)), &packer->histogram);
  isal_create_hufftables(&packer->code, &packer->histogram);
  stream.hufftables = &packer->code;
  stream.flush = FULL_FLUSH;
  stream.end_of_stream = 0;
  const std::size_t before = bytes_.size();
  // what cannot be packed is stored, in pieces of 64 kB with a header of 5 bytes
  const std::size_t most = open_.size() + 5 * (open_.size() / 65535 + 1) + 64;
  bytes_.resize(before + most);
  stream.next_in = text;
  stream.avail_in = static_cast<std::uint32_t>(open_.size());
  stream.next_out = reinterpret_cast<std::uint8_t*>(bytes_.data()) + before;
  stream.avail_out = static_cast<std::uint32_t>(most);
  const int status = isal_deflate_stateless(&stream);
  TRUEFLANK_EXPECTS(status == COMP_OK && stream.avail_in == 0);
  bytes_.resize(before + stream.total_out);
  checksum_ = crc32_gzip_refl(checksum_, reinterpret_cast<const std::uint8_t*>(open_.data()), open_.size());
  text_bytes_ += open_.size();
  open_.clear();
}

}  // namespace trueflank::io
