// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/app/commands.h"
#include "trueflank/solid/mesh_difference.h"

namespace trueflank::app {

/// What `compare` found, for a reader and for a program.
struct CompareReport {
  CompareOptions options;
  trueflank::MeshComparison comparison;
  std::optional<MeshDifference> difference;  ///< where the parts differ, or a picture was asked for

  /// The new file's name without folder and extension: parts are called by their files.
  [[nodiscard]] std::string part() const;
};

/// "sun: 12.34 um too much material on the left flank of tooth 3"; ASCII.
[[nodiscard]] std::string headline(const CompareReport& report);
/// A table of at most 80 columns but for paths.
[[nodiscard]] std::string comparison_text(const CompareReport& report);
[[nodiscard]] std::string comparison_json(const CompareReport& report);

}  // namespace trueflank::app
