// SPDX-License-Identifier: GPL-3.0-or-later
//
// zlib unpacks what isa-l packed.
#include "trueflank/export/packed_text.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <zlib.h>

#include <random>
#include <string>
#include <vector>

namespace trueflank::io {
namespace {

std::string unpacked(const PackedText& packed) {
  std::string bytes = packed.bytes() + std::string(PackedText::kLastBlock), text;
  text.resize(packed.text_bytes() + 1);
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

std::uint32_t checksum(const std::string& text) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

void expect_holds(const PackedText& packed, const std::string& text) {
  EXPECT_EQ(packed.text_bytes(), text.size());
  EXPECT_EQ(packed.checksum(), checksum(text));
  EXPECT_TRUE(unpacked(packed) == text);
}

/// Numbers as in a mesh, or bytes that no packer can make smaller.
std::string sample_text(std::size_t bytes, bool packs) {
  std::mt19937 random(7);
  std::string text;
  while (text.size() < bytes)
    text += packs ? "<vertex x=\"" + std::to_string(random() % 1000) + "\"/>\n"
                  : std::string(1, static_cast<char>(random()));
  text.resize(bytes);
  return text;
}

TEST(PackedText, UnpacksToWhatWasAppendedInAnyPieces) {
  for (const bool packs : {true, false})
    for (const std::size_t bytes : {0U, 1U, 1000U, 131072U, 300000U}) {
      const std::string text = sample_text(bytes, packs);
      for (const std::size_t piece : {std::size_t{7000}, bytes + 1}) {
        PackedText packed;
        for (std::size_t at = 0; at < bytes; at += piece)
          packed.append(std::string_view(text).substr(at, piece));
        packed.close();
        expect_holds(packed, text);
        if (packs && bytes > 1000) {
          EXPECT_LT(packed.bytes().size(), bytes / 3);
        }
      }
    }
}

TEST(PackedText, TextsPackedElsewhereFollowEachOther) {
  const std::string first = sample_text(200001, true), second = sample_text(77, false);
  PackedText one(first), two(second), empty;
  one.close(), two.close(), empty.close();
  PackedText all("before ");
  all.append(one);
  all.append(empty);
  all.append(two);
  all.append(two);
  all.append(" behind");
  all.close();
  expect_holds(all, "before " + first + second + second + " behind");
}

TEST(PackedText, DoesNotDependOnWhatTheMemoryHeldBefore) {
  mallopt(M_MMAP_THRESHOLD, 1 << 28);  // from the heap: fresh pages would be zero
  const std::string text = sample_text(60000, true);
  std::string first;
  for (std::uint16_t value = 0; value <= 16; ++value) {
    {
      const std::vector<std::uint16_t> used(200000, value);
      EXPECT_EQ(used.back(), value);
    }
    PackedText packed;
    packed.append(text);
    packed.close();
    if (first.empty()) first = packed.bytes();
    EXPECT_TRUE(packed.bytes() == first) << "on memory full of " << value;
  }
}

TEST(PackedText, TheSameTextGivesTheSameBytes) {
  const std::string text = sample_text(250000, true);
  PackedText one(text), two(text);
  one.close(), two.close();
  EXPECT_TRUE(one.bytes() == two.bytes());
}

}  // namespace
}  // namespace trueflank::io
