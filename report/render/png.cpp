// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/png.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "trueflank/base/contract.h"
#include "trueflank/export/packed/deflate.h"

namespace trueflank::io {
namespace {

constexpr std::size_t kChannels = 3;
constexpr int kFilters = 5;

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
}

void append_chunk(std::string& file, const std::string& type, const std::string& content) {
  append_big_endian(file, static_cast<std::uint32_t>(content.size()));
  const std::string checked = type + content;
  file += checked;
  append_big_endian(file, checksum(checked));
}

/// RFC 1950.
std::uint32_t adler_32(const std::string& bytes) {
  constexpr std::uint32_t kPrime = 65521;
  constexpr std::size_t kBeforeOverflow = 5552;
  std::uint32_t a = 1, b = 0;
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t end = std::min(bytes.size(), i + kBeforeOverflow);
    for (; i < end; ++i) {
      a += static_cast<unsigned char>(bytes[i]);
      b += a;
    }
    a %= kPrime;
    b %= kPrime;
  }
  return b << 16 | a;
}

int paeth(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int l = std::abs(guess - left), a = std::abs(guess - above), c = std::abs(guess - corner);
  return l <= a && l <= c ? left : a <= c ? above : corner;
}

using Row = std::vector<std::uint8_t>;

/// A row less what a filter foretells of it.
void filter_row(int filter, const Row& row, const Row& above, Row& out) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int left = i < kChannels ? 0 : row[i - kChannels];
    const int corner = i < kChannels ? 0 : above[i - kChannels];
    const int predicted = filter == 0   ? 0
                         : filter == 1 ? left
                         : filter == 2 ? above[i]
                         : filter == 3 ? (left + above[i]) / 2
                                       : paeth(left, above[i], corner);
    out[i] = static_cast<std::uint8_t>(row[i] - predicted);
  }
}

/// Sum of the bytes as signed numbers: small ones pack well.
std::size_t cost(const Row& row) {
  std::size_t sum = 0;
  for (const std::uint8_t byte : row)
    sum += static_cast<std::size_t>(byte < 128 ? byte : 256 - byte);
  return sum;
}

/// All rows, each with the filter that makes it smallest.
std::string filtered(const Image& image) {
  const std::size_t bytes = kChannels * static_cast<std::size_t>(image.width_px);
  Row row(bytes), above(bytes, 0), tried(bytes), best(bytes);
  std::string text;
  text.reserve((bytes + 1) * static_cast<std::size_t>(image.height_px));
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x)
      std::copy_n(image.at(x, y).data(), kChannels,
                  row.data() + kChannels * static_cast<std::size_t>(x));
    int chosen = 0;
    std::size_t least = ~std::size_t{0};
    for (int filter = 0; filter < kFilters; ++filter) {
      filter_row(filter, row, above, tried);
      const std::size_t size = cost(tried);
      if (size >= least) continue;
      least = size;
      chosen = filter;
      best.swap(tried);
    }
    text += static_cast<char>(chosen);
    text.append(best.begin(), best.end());
    above.swap(row);
  }
  return text;
}

std::string header_of(const Image& image) {
  std::string header;
  append_big_endian(header, static_cast<std::uint32_t>(image.width_px));
  append_big_endian(header, static_cast<std::uint32_t>(image.height_px));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB, deflate, filters, no interlace
  return header;
}

std::string packed_rows(const Image& image) {
  const std::string rows = filtered(image);
  std::string packed("\x78\x01", 2);  // deflate, window of 32 kB
  append_deflated(packed, rows);
  packed += kLastDeflatedBlock;
  append_big_endian(packed, adler_32(rows));
  return packed;
}

std::string beginning_of(const Image& image) {
  std::string file("\x89PNG\r\n\x1a\n", 8);
  append_chunk(file, "IHDR", header_of(image));
  append_chunk(file, "sRGB", std::string(1, '\0'));
  return file;
}

/// How a picture of a row is shown: whole, in the place of the one before.
std::string frame_control(std::uint32_t number, const Image& image, int milliseconds) {
  std::string control;
  for (const std::uint32_t value : {number, static_cast<std::uint32_t>(image.width_px),
                                    static_cast<std::uint32_t>(image.height_px), 0U, 0U})
    append_big_endian(control, value);
  append_big_endian(control,
                    static_cast<std::uint32_t>(milliseconds) << 16 | 1000U);  // of a second
  return control + std::string(2, '\0');
}

}  // namespace

std::string png_file(const Image& image) {
  TRUEFLANK_EXPECTS(image.width_px > 0 && image.height_px > 0);
  std::string file = beginning_of(image);
  append_chunk(file, "IDAT", packed_rows(image));
  append_chunk(file, "IEND", "");
  return file;
}

std::string animated_png_file(const std::vector<Image>& images, int milliseconds) {
  TRUEFLANK_EXPECTS(!images.empty() && milliseconds > 0 && milliseconds < 65536);
  std::string file = beginning_of(images.front());
  std::string count;
  append_big_endian(count, static_cast<std::uint32_t>(images.size()));
  append_big_endian(count, 0);  // played for ever
  append_chunk(file, "acTL", count);
  std::uint32_t number = 0;  // of control and data chunks
  for (const Image& image : images) {
    TRUEFLANK_EXPECTS(image.width_px == images.front().width_px &&
                      image.height_px == images.front().height_px);
    append_chunk(file, "fcTL", frame_control(number++, image, milliseconds));
    if (&image == &images.front()) {
      append_chunk(file, "IDAT", packed_rows(image));
      continue;
    }
    std::string data;
    append_big_endian(data, number++);
    append_chunk(file, "fdAT", data + packed_rows(image));
  }
  append_chunk(file, "IEND", "");
  return file;
}

}  // namespace trueflank::io
