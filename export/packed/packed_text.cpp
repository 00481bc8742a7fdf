// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/packed/packed_text.h"

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
  checksum_ = joined_checksum(checksum_, other.checksum_, other.text_bytes_);
  text_bytes_ += other.text_bytes_;
}

void PackedText::pack() {
  append_deflated(bytes_, open_);
  checksum_ = io::checksum(open_, checksum_);
  text_bytes_ += open_.size();
  open_.clear();
}

}  // namespace trueflank::io
