// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/base/result.h"

namespace trueflank {

/// A design file with the smallest joint change after which every check passes (check/cure/joint_cure.h).
struct FixedDesign {
  bool cured = false;       ///< false: the nearest that was found, which still fails
  std::string design_text;  ///< the file with its comments and layout kept
  std::string summary;      ///< what was changed and what it costs, for a terminal
};

/// Errors: of the file, with line and key.
struct FixOptions {
  bool warnings = false;  ///< also change a design that passes, where that ends warnings about the contact
};

/// The smallest change after which every check passes, those of the parts around the gears too; they judge the
/// text that is returned. A design that passes is left to the byte. Errors: the file's; parts that cannot be made.
[[nodiscard]] ResultAll<FixedDesign> fixed_design(const std::string& path, const FixOptions& options = {});

}  // namespace trueflank
