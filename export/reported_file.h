// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "trueflank/base/units.h"

namespace trueflank::io {

/// A file as it was written and measured again.
struct ReportedFile {
  std::string path;  ///< relative to the output folder
  std::string part;  ///< "assembly" for the assembly
  std::string format;
  std::uint64_t bytes = 0;
  std::uint64_t triangles = 0;    ///< 0 where the format has none
  double accuracy_um = kNaN;      ///< largest distance between file and true surface, both ways
  double volume_mm3 = kNaN;
  double kerf_mm = kNaN;  ///< NaN: the file does not hold the path of a wire
  std::size_t unreached_corners = 0;  ///< corners that the wire is too thick for
  double left_um = kNaN;  ///< deepest material that stays in them
  std::string compensated_for = {};  ///< process whose effects the walls are moved against; or empty
};

}  // namespace trueflank::io
