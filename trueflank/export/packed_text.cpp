// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/packed_text.h"

#include <isa-l.h>
#include <zlib.h>

#include <memory>

#include "trueflank/base/contract.h"

namespace trueflank::io {

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
    std::uint8_t level_buffer[ISAL_DEF_LVL1_SMALL];
  };
  const auto packer = std::make_unique_for_overwrite<Packer>();  // not cleared: 150 kB
  isal_zstream& stream = packer->stream;
  isal_deflate_stateless_init(&stream);
  stream.hist_bits = 0;  // the whole window; the one member that is read and that init leaves as it was
  stream.level = 1;  // 2 is no smaller on our text, libdeflate a sixth smaller in twice the time
  stream.level_buf = packer->level_buffer;
  stream.level_buf_size = sizeof packer->level_buffer;
  stream.flush = FULL_FLUSH;
  stream.end_of_stream = 0;
  const std::size_t before = bytes_.size();
  // what cannot be packed is stored, in pieces of 64 kB with a header of 5 bytes
  const std::size_t most = open_.size() + 5 * (open_.size() / 65535 + 1) + 64;
  bytes_.resize(before + most);
  stream.next_in = reinterpret_cast<std::uint8_t*>(open_.data());
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
