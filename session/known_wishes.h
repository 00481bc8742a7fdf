// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/base/result.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/session/wished_design.h"
#include "trueflank/session/wished_sets.h"

namespace trueflank {

constexpr double kLargestWish_mm = 500.0;  ///< outer diameter

/// Wishes with everything they name found in the tables. Not copied: it points into itself.
struct KnownWishes {
  ToolTables tools = standard_tools();
  const WishedSets* sets = nullptr;
  const Process* process = nullptr;
  std::string material;
  const Motor* motor = nullptr;  ///< nothing: gears alone

  KnownWishes() = default;
  KnownWishes(const KnownWishes&) = delete;
  KnownWishes& operator=(const KnownWishes&) = delete;

  /// Errors: a name that is not known, a ratio or a diameter out of range (kUsage); a file of tools
  /// that cannot be read.
  [[nodiscard]] Errors read(const DesignWishes& wishes);
};

}  // namespace trueflank
