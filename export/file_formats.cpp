// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/file_formats.h"

#include <algorithm>

namespace trueflank::io {
namespace {

template <class Wanted>
std::string names_where(std::string_view separator, const Wanted& wanted) {
  std::string names;
  for (const FileFormatInfo& row : file_format_table()) {
    if (!wanted(row)) continue;
    if (!names.empty()) names += separator;
    names += row.name;
  }
  return names;
}

}  // namespace

const std::vector<FileFormatInfo>& file_format_table() {
  using enum FileFormat;
  using enum FormatContent;
  static const std::vector<FileFormatInfo> table = {
      {kStl, "stl", kMesh, true, "binary STL: triangles alone"},
      {k3mf, "3mf", kMesh, true, "3MF: what slicers read, bodies with names"},
      {kObj, "obj", kMesh, true, "Wavefront OBJ"},
      {kPly, "ply", kMesh, true, "binary PLY in double precision"},
      {kGlb, "glb", kMesh, true, "binary glTF: for pictures and web pages"},
      {kStep, "step", kSolid, true, "STEP AP214: exact surfaces for CAD and CAM"},
      {kDxf, "dxf", kSection, true, "DXF: sections for wire erosion and laser"},
      {kSvg, "svg", kSection, true, "SVG: sections as a picture"},
      {kScad, "scad", kProgram, false, "OpenSCAD: the part as a program to build on"},
      {kPdf, "pdf", kPaper, true, "PDF: workshop drawings, and their DXF"},
      {kPng, "png", kPaper, true, "PNG: pictures, the assembly's with a quarter cut away", false},
      {kApng, "apng", kPaper, true, "animated PNG: the assembly turning, a quarter cut away", false},
  };
  return table;
}

const FileFormatInfo& info(FileFormat format) {
  return file_format_table()[static_cast<std::size_t>(format)];
}

bool is_mesh(FileFormat format) { return info(format).content == FormatContent::kMesh; }
bool is_paper(FileFormat format) { return info(format).content == FormatContent::kPaper; }

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> all = [] {
    std::vector<FileFormat> formats;
    for (const FileFormatInfo& row : file_format_table()) formats.push_back(row.format);
    return formats;
  }();
  return all;
}

const char* to_text(FileFormat format) {
  return info(format).name.data();
}  // of a literal: ends with 0

std::string format_names(std::string_view separator) {
  return names_where(separator, [](const FileFormatInfo&) { return true; });
}

std::string format_names(std::string_view separator, FormatContent content) {
  return names_where(separator, [&](const FileFormatInfo& row) { return row.content == content; });
}

std::string asked_format_names(std::string_view separator) {
  return names_where(separator, [](const FileFormatInfo& row) { return !row.unasked; });
}

ResultAll<std::vector<FileFormat>> parse_formats(const std::vector<std::string>& names) {
  const auto& all = file_formats();
  std::vector<FileFormat> formats;
  if (names.empty()) {
    for (const FileFormatInfo& row : file_format_table())
      if (row.unasked) formats.push_back(row.format);
    return formats;
  }
  Errors errors;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](FileFormat format) { return name == to_text(format); });
    if (found == all.end())
      errors.push_back({.code = ErrorCode::kUsage,
                        .message = "no such format",
                        .key = "--formats",
                        .value = name,
                        .remedy = format_names(", ")});
    else if (std::find(formats.begin(), formats.end(), *found) == formats.end())
      formats.push_back(*found);
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  return formats;
}

Result<StepSchema> step_schema_of(const std::string& name) {
  if (name == "ap214") return StepSchema::kAp214;
  if (name == "ap242") return StepSchema::kAp242;
  return fail(Error{.code = ErrorCode::kUsage,
                    .message = "no such STEP schema",
                    .key = "--step-schema",
                    .value = name,
                    .remedy = "ap214 (the default) or ap242, which holds tolerances too"});
}

}  // namespace trueflank::io
