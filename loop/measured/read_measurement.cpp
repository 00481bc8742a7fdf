// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/measured/read_measurement.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

/// First line that is neither empty nor a comment: a CSV file's header.
std::string_view header_of(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = trimmed(next_line(text));
    if (!line.empty() && line.front() != '#') return line;
  }
  return {};
}

bool has_column(const std::vector<std::string_view>& fields, std::string_view name) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](std::string_view field) { return lowered(field) == name; });
}

enum class FileKind { kScanCsv, kXyz, kMesh, kInspection, kSizes, kMka, kGde, kUnknown };

FileKind kind_of(const std::string& path, std::string_view text) {
  const std::string ending = lowered(std::filesystem::path(path).extension().string());
  if (io::is_mesh_extension(ending)) return FileKind::kMesh;
  if (ending == ".xyz" || ending == ".asc" || ending == ".pts") return FileKind::kXyz;
  if (ending == ".mka") return FileKind::kMka;
  if (ending == ".gde" || ending == ".xml") return FileKind::kGde;
  const std::string_view head = trimmed(text.substr(0, 200));
  if (head.starts_with("<?xml") || head.starts_with("<")) return FileKind::kGde;
  std::vector<std::string_view> fields;
  split_fields(header_of(text), fields);
  if (has_column(fields, "x_mm")) return FileKind::kScanCsv;
  if (has_column(fields, "record")) return FileKind::kInspection;
  if (has_column(fields, "quantity")) return FileKind::kSizes;
  if (text.find("Normalmodul") != std::string_view::npos) return FileKind::kMka;
  return FileKind::kUnknown;
}

/// NAME of a comment line `# key = NAME` (PLY: `comment key = NAME`) before the data; empty: none.
std::string comment_in(std::string_view text, std::string_view key) {
  constexpr int kHeaderLines = 60;
  for (int i = 0; i < kHeaderLines && !text.empty(); ++i) {
    std::string_view line = trimmed(next_line(text));
    if (line.starts_with("comment")) line.remove_prefix(7);
    else if (line.starts_with("#")) line.remove_prefix(1);
    else continue;
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && lowered(trimmed(line.substr(0, equals))) == key)
      return std::string(trimmed(line.substr(equals + 1)));
  }
  return {};
}

/// `PART=FILE`, unless there is a file of that very name.
std::pair<std::string, std::string> part_and_path(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  std::error_code ignored;
  if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size() || std::filesystem::exists(argument, ignored) ||
      argument.find_first_of("/\\") < equals)
    return {{}, argument};
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

template <class T>
void keep(Result<T> result, const std::string& part, std::vector<T>& kept, Errors& errors) {
  if (!result) {
    errors.push_back(result.error());
    return;
  }
  result->part = part;
  kept.push_back(std::move(*result));
}

void read_one(const std::string& argument, MeasuredData& data, Errors& errors) {
  const auto [named, path] = part_and_path(argument);
  const auto text = read_whole_file(path);
  if (!text) {
    errors.push_back(text.error());
    return;
  }
  const std::string part = named.empty() ? comment_in(*text, "part") : named;
  if (std::string process = comment_in(*text, "process"); !process.empty())
    if (std::find(data.processes.begin(), data.processes.end(), process) == data.processes.end())
      data.processes.push_back(std::move(process));
  switch (kind_of(path, *text)) {
    case FileKind::kScanCsv:
      keep(read_scan_csv(path, *text, data.notes), part, data.scans, errors);
      break;
    case FileKind::kXyz:
      keep(read_xyz(path, *text, data.notes), part, data.scans, errors);
      break;
    case FileKind::kMesh:
      keep(read_scan_mesh(path, *text, data.notes), part, data.scans, errors);
      break;
    case FileKind::kInspection:
      keep(read_inspection_csv(path, *text, data.notes), part, data.inspections, errors);
      break;
    case FileKind::kSizes:
      keep(read_sizes_csv(path, *text, data.notes), part, data.sizes, errors);
      break;
    case FileKind::kMka:
      keep(read_mka(path, *text, data.notes), part, data.inspections, errors);
      break;
    case FileKind::kGde:
      keep(read_gde(path, *text, data.notes), part, data.inspections, errors);
      break;
    case FileKind::kUnknown:
      errors.push_back(
          {.code = ErrorCode::kSyntax,
           .message = text->empty() ? "the file is empty"
                                    : "this is no kind of measured data the loop knows",
           .value = std::string(trimmed(header_of(*text)).substr(0, 60)),
           .remedy = "a scan (.ply .stl .obj .3mf .glb .xyz, or .csv with x_mm,y_mm,z_mm), an inspection .csv "
                     "with record,tooth,flank,diameter_mm,z_mm,deviation_um, sizes .csv with "
                     "quantity,value_mm, a .mka or a GDE file",
           .file = path,
           .line = 1});
  }
}

}  // namespace

ResultAll<MeasuredData> read_measured_files(const std::vector<std::string>& paths) {
  MeasuredData data;
  Errors errors;
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  for (const std::string& path : paths) {
    read_one(path, data, errors);
    notes.emplace_back(path, std::exchange(data.notes, {}));
  }
  // What is said does not depend on the order in which files are named.
  std::sort(notes.begin(), notes.end());
  for (auto& [path, of_file] : notes)
    data.notes.insert(data.notes.end(), of_file.begin(), of_file.end());
  if (!errors.empty()) return fail_all(std::move(errors));
  return data;
}

namespace {

/// The first line that says something; of a file on a disk its beginning alone is read.
Result<std::string> header_line_of(const std::string& path) {
  constexpr std::size_t kBeginning = 1U << 16;
  io::InputFile file(path);
  std::error_code ignored;
  if (file.error_number() == 0 && !file.regular_size() && !std::filesystem::is_directory(path, ignored))
    return fail({.code = ErrorCode::kUnsupported,
                 .message = "measured data are read twice, and a pipe or device only once",
                 .remedy = "a file on a disk",
                 .file = path});
  if (file.regular_size().value_or(0) > kBeginning) {
    std::string beginning(kBeginning, '\0');
    beginning.resize(file.fill(beginning.data(), beginning.size()));
    const std::size_t last_line = beginning.rfind('\n');
    beginning.resize(last_line == std::string::npos ? 0 : last_line);
    const std::string_view text = beginning;
    const std::string_view header =
        header_of(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text);
    if (!header.empty()) return std::string(header);
  }
  const auto text = read_whole_file(path);
  if (!text) return fail(text.error());
  return std::string(header_of(*text));
}

}  // namespace

Result<bool> is_bench_file(const std::string& argument) {
  const auto [part, path] = part_and_path(argument);
  const auto header = header_line_of(path);
  if (!header) return fail(header.error());
  if (!part.empty()) return false;  // of a part: not of the whole drive
  std::vector<std::string_view> fields;
  split_fields(*header, fields);
  if (has_column(fields, "direction") || has_column(fields, "input_torque_nm")) return true;
  if (!has_column(fields, "quantity") || has_column(fields, "value_mm")) return false;
  return has_column(fields, "value");
}

}  // namespace trueflank::loop
