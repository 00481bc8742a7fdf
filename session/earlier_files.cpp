// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/earlier_files.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "trueflank/design/design_file.h"

namespace trueflank {
namespace {

/// Far above the report of any set; a larger file is none of ours.
constexpr std::size_t kLargestReport_bytes = 64 << 20;

/// A file of the folder itself: a report from elsewhere must not reach outside.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos;
}

}  // namespace

std::vector<std::string> remove_earlier_files(const std::filesystem::path& folder) {
  std::vector<std::string> removed;
  const auto text = read_text_file((folder / "report.json").string(), kLargestReport_bytes);
  if (!text) return removed;
  const auto report = nlohmann::json::parse(*text, nullptr, false);
  if (!report.is_object() || report.value("format", nlohmann::json()) != "trueflank-report") return removed;
  const auto files = report.find("files");
  if (files == report.end() || !files->is_array()) return removed;
  for (const auto& entry : *files) {
    if (!entry.is_object()) continue;
    const auto path = entry.find("path"), bytes = entry.find("bytes");
    if (path == entry.end() || bytes == entry.end() || !path->is_string() || !bytes->is_number_unsigned())
      continue;
    const auto name = path->get<std::string>();
    std::error_code error;
    const std::filesystem::path file = folder / name;
    if (!is_plain_name(name) || !std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)) ||
        std::filesystem::file_size(file, error) != bytes->get<std::uint64_t>() || error)
      continue;
    if (std::filesystem::remove(file, error)) removed.push_back(name);
  }
  return removed;
}

}  // namespace trueflank
