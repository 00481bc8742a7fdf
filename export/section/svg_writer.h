// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/section/section_contour.h"

namespace trueflank::io {

/// SVG at true size (width and height in mm, one user unit a millimetre). Path data are in the frame
/// of part or assembly, y up; one transform a section turns them over and sets the sections side by
/// side. Whole circles are circles, every other outline is one closed path of straight lines within the
/// sections' tolerance. Errors: as AtomicFile's.
[[nodiscard]] Status write_svg(const std::filesystem::path& path, const std::string& title,
                               const std::vector<Section>& sections);

}  // namespace trueflank::io
