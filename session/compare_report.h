// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/base/result.h"
#include "trueflank/solid/measure/mesh_difference.h"

namespace trueflank {

/// What a comparison of two meshes found, for a reader and for a program.
struct CompareReport {
  std::string golden, fresh;  ///< paths; empty for meshes that are in no file
  double tolerance_um = 1.0;
  MeshComparison comparison;
  std::optional<MeshDifference> difference;  ///< where the parts differ, or it was asked for
  std::string picture;                       ///< file it is drawn in; empty: none

  /// The new file's name without folder and extension: parts are called by their files.
  [[nodiscard]] std::string part() const;
};

struct CompareFilesOptions {
  double tolerance_um = 1.0;
  bool locate_always = false;  ///< name the worst place though the parts are the same
};
/// Compares two mesh files, or two meshes, as surfaces. Errors: kUsage (tolerance), those of both files.
[[nodiscard]] ResultAll<CompareReport> compare_files(const std::string& golden, const std::string& fresh,
                                                     const CompareFilesOptions& options = {});
[[nodiscard]] ResultAll<CompareReport> compare_surfaces(const TriangleMesh& golden,
                                                        const TriangleMesh& fresh,
                                                        const CompareFilesOptions& options = {});

/// "sun: 12.34 um too much material on the left flank of tooth 3"; ASCII.
[[nodiscard]] std::string headline(const CompareReport& report);
/// A table of at most 80 columns but for paths.
[[nodiscard]] std::string comparison_text(const CompareReport& report);
[[nodiscard]] std::string comparison_json(const CompareReport& report);
/// The worst place as SVG. Requires: a difference.
[[nodiscard]] std::string comparison_picture(const CompareReport& report);

}  // namespace trueflank
