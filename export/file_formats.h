// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"

// The one table of the file formats that parts are written in. Help, shell completion, manual page,
// error messages and the tests of the documentation follow it.
namespace trueflank::io {

enum class FileFormat { kStl, k3mf, kObj, kPly, kGlb, kStep, kDxf, kSvg, kScad, kPdf, kPng, kApng };

/// What a file of a format holds.
enum class FormatContent {
  kMesh,     ///< facets within the tolerance of the true surface
  kSolid,    ///< the surfaces themselves
  kSection,  ///< a drawing of the parts' sections
  kProgram,  ///< a text that another program makes the part from
  kPaper,    ///< sheets and pictures for people; written by report/, not by export_parts
};

struct FileFormatInfo {
  FileFormat format = FileFormat::kStl;
  std::string_view name;  ///< value of --formats, key of report.json, and extension without its dot
  FormatContent content = FormatContent::kMesh;
  bool corrected = true;  ///< can hold teeth that a correction has displaced
  std::string_view description;
  bool unasked = true;  ///< written too where no format is named
};

/// Every format, in the order of the enumeration.
[[nodiscard]] const std::vector<FileFormatInfo>& file_format_table();
[[nodiscard]] const FileFormatInfo& info(FileFormat format);
[[nodiscard]] bool is_mesh(FileFormat format);
[[nodiscard]] bool is_paper(FileFormat format);

/// Every format, in the order of the enumeration.
[[nodiscard]] const std::vector<FileFormat>& file_formats();
/// The name that is option value and file extension: "stl", "3mf", ...
[[nodiscard]] const char* to_text(FileFormat format);
/// The names of all formats, of those with this content, or of those that are not written unasked.
[[nodiscard]] std::string format_names(std::string_view separator);
[[nodiscard]] std::string format_names(std::string_view separator, FormatContent content);
[[nodiscard]] std::string asked_format_names(std::string_view separator);
/// Formats by their names, each once; for an empty list those that are written unasked. Errors:
/// kUsage, one a wrong name.
[[nodiscard]] ResultAll<std::vector<FileFormat>> parse_formats(
    const std::vector<std::string>& names);

/// Application protocol of STEP files: the words one may use. By AP242 they hold sizes, limits, datum
/// and runouts beside the solids.
enum class StepSchema { kAp214, kAp242 };
/// By its name, "ap214" or "ap242". Errors: kUsage.
[[nodiscard]] Result<StepSchema> step_schema_of(const std::string& name);

}  // namespace trueflank::io
