// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/report/render/image.h"

namespace trueflank::io {

/// The picture as a PNG file (ISO/IEC 15948), eight bits a channel. The same picture, the same
/// bytes. Requires: a picture of one pixel at least.
[[nodiscard]] std::string png_file(const Image& image);

/// Pictures one after the other, for ever, as an animated PNG: browsers play it, other programs
/// show the first picture. Requires: one picture at least, all of one size.
[[nodiscard]] std::string animated_png_file(const std::vector<Image>& images, int milliseconds);

}  // namespace trueflank::io
