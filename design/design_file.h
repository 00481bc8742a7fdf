// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "trueflank/base/result.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/train/gearbox_design.h"

// The design file (docs/design-file.md): TOML in millimetres, micrometres and degrees.
namespace trueflank {

/// A design with the places of its keys, so that what later stations find can be shown there.
struct DesignFile {
  GearboxDesign design;
  std::string file;
  std::map<std::string, int> lines;  ///< of every dotted key and table there is, 1-based
  ToolTables tools = standard_tools();  ///< with those of the design's tools file
};

/// Largest design file; a hundred times what any needs.
inline constexpr std::size_t kLargestDesignFile_bytes = 1 << 20;

/// Reads and checks a whole design file (a pipe or device will do).
/// Errors: all of the file at once, in the order of its lines, each with file, line, dotted key,
/// the value found and what would be right. kFileNotFound, kPermission, kDisk where it cannot be
/// read; kUsage for a directory; kSyntax where a line is no TOML; kUnknownKey, kMissingKey,
/// kWrongType, kOutOfRange, kInconsistent. Not checked here: whether such gears exist and mesh.
[[nodiscard]] ResultAll<DesignFile> read_design_file(const std::string& path);
/// The same of a text; `file` names it in errors, its stem is the design's name where it has none.
[[nodiscard]] ResultAll<DesignFile> read_design_file_text(std::string_view text,
                                                          const std::string& file);

/// @name The design alone
/// @{
[[nodiscard]] ResultAll<GearboxDesign> read_design(const std::string& path);
[[nodiscard]] ResultAll<GearboxDesign> read_design_text(std::string_view text,
                                                        const std::string& file);
/// @}

/// Errors of later stations with file and line of their key (or of the nearest table around it).
[[nodiscard]] Errors located(Errors errors, const DesignFile& file);

/// Reads a whole text file of at most `largest_bytes`. Errors as read_design_file.
[[nodiscard]] Result<std::string> read_text_file(const std::string& path,
                                                 std::size_t largest_bytes);

}  // namespace trueflank
