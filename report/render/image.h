// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trueflank::io {

/// A picture of sRGB pixels, row by row from the top left.
struct Image {
  int width_px = 0, height_px = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels = {};

  [[nodiscard]] const std::array<std::uint8_t, 3>& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x)];
  }
  bool operator==(const Image&) const = default;
};

}  // namespace trueflank::io
