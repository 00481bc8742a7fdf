// SPDX-License-Identifier: GPL-3.0-or-later
//
// libdeflate unpacks what our own packer packed.
#include "trueflank/export/packed/packed_text.h"

#include <gtest/gtest.h>
#include <libdeflate.h>
#include <malloc.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace trueflank::io {
namespace {

std::string unpacked(const PackedText& packed) {
  std::string bytes = packed.bytes() + std::string(PackedText::kLastBlock), text;
  text.resize(packed.text_bytes() + 1);
  libdeflate_decompressor* const unpacker = libdeflate_alloc_decompressor();
  std::size_t read = 0, written = 0;
  EXPECT_EQ(libdeflate_deflate_decompress_ex(unpacker, bytes.data(), bytes.size(), text.data(), text.size(), &read,
                                             &written),
            LIBDEFLATE_SUCCESS);
  EXPECT_EQ(read, bytes.size());
  libdeflate_free_decompressor(unpacker);
  text.resize(written);
  return text;
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

// RFC 1951 wants codes of at most 15 bits: symbols as rare as these would get longer ones.
TEST(PackedText, SymbolsRarerThanTheLongestCodeArePacked) {
  std::string text;
  for (std::size_t a = 1, b = 1, symbol = 0; symbol < 24; ++symbol, b += a, a = b - a)
    for (std::size_t i = 0; i < a; ++i) text += static_cast<char>(symbol);
  std::shuffle(text.begin(), text.end(), std::mt19937(3));
  PackedText packed(text);
  packed.close();
  expect_holds(packed, text);
  EXPECT_LT(packed.bytes().size(), text.size() / 2);
}

TEST(PackedText, AnyTextIsPacked) {
  std::mt19937 random(20261122);
  for (int i = 0; i < 400; ++i) {
    const std::size_t bytes = random() % (i % 20 == 0 ? 300000 : 3000);
    const std::size_t letters = 1 + random() % 255, copies = random() % 60;
    std::string text;
    while (text.size() < bytes) {
      if (text.size() > 300 && random() % 60 < copies)
        text += text.substr(random() % (text.size() - 260), random() % 260);
      text += static_cast<char>(random() % letters);
    }
    PackedText packed(text);
    packed.close();
    expect_holds(packed, text);
    EXPECT_LE(packed.bytes().size(), text.size() + 10 * (text.size() / 65536 + 1)) << i;
  }
}

TEST(PackedText, LengthsAndDistancesAtTheirLimits) {
  for (const std::size_t length : {3U, 4U, 10U, 11U, 257U, 258U, 259U, 600U})
    for (const std::size_t distance : {1U, 2U, 4U, 5U, 257U, 32767U, 32768U, 32769U}) {
      std::string text;  // without repetitions of its own
      std::mt19937 random(1);
      while (text.size() < distance) text += static_cast<char>(random());
      for (std::size_t i = 0; i < length; ++i) text += text[text.size() - distance];
      PackedText packed(text + "end");
      packed.close();
      expect_holds(packed, text + "end");
    }
}

// Pinned, so that another processor or compiler has to give it too.
TEST(PackedText, GivesTheBytesItGaveElsewhere) {
  PackedText packed(sample_text(250000, true));
  packed.close();
  EXPECT_EQ(packed.bytes().size(), 30849U);
  EXPECT_EQ(checksum(packed.bytes()), 2839435141U);
}

TEST(Checksum, IsThatOfZip) {
  EXPECT_EQ(checksum("123456789"), 0xCBF43926U);  // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(joined_checksum(checksum("1234"), checksum("56789"), 5), 0xCBF43926U);
  EXPECT_EQ(joined_checksum(checksum("1234"), checksum(""), 0), checksum("1234"));
  const std::string first = sample_text(100, true), second = sample_text(70001, false);
  EXPECT_EQ(joined_checksum(checksum(first), checksum(second), second.size()), checksum(first + second));
}

}  // namespace
}  // namespace trueflank::io
