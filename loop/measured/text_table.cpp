// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/measured/text_table.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "trueflank/base/units.h"
#include "trueflank/export/input_file.h"

namespace trueflank::loop {
namespace {

/// Rows of one file that are named; of more only the count.
constexpr std::size_t kMostNamed = 20;
constexpr const char* kLeftOut = ": left out: ";

}  // namespace
namespace {

/// Of one line; what stands behind them is not looked at.
constexpr std::size_t kMostFields = 10'000;

}  // namespace

Result<std::string> read_whole_file(const std::string& path, std::size_t most_bytes) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status))
    return fail({.code = ErrorCode::kFileNotFound, .message = "there is no such file", .file = path});
  if (std::filesystem::is_directory(status))
    return fail({.code = ErrorCode::kUsage,
                 .message = "this is a folder, a file is needed",
                 .file = path});
  auto read = io::read_file(path, most_bytes);
  if (!read) return read;
  std::string text = std::move(*read);
  // Spreadsheets put a byte order mark before the first column's name.
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  char separator = ',';
  if (line.find(',') == std::string_view::npos) {
    if (line.find(';') != std::string_view::npos) separator = ';';
    else if (line.find('\t') != std::string_view::npos) separator = '\t';
  }
  while (fields.size() < kMostFields) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line = line.substr(end + 1);
  }
}

void split_blanks(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  // (asking a text for one of several characters takes a call for each)
  const auto is_blank = [](char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
  };
  const char *at = line.data(), *const end = at + line.size();
  while (fields.size() < kMostFields) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    const char* const begin = at;
    while (at != end && !is_blank(*at)) ++at;
    fields.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
}

std::string in_quotes(std::string_view field) { return "\"" + std::string(field) + "\""; }

double number_in(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double value = kNaN;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return kNaN;
  return std::isfinite(value) ? value : kNaN;
}

void BadLines::add(int line, const std::string& what) {
  if (first_.size() < kMostNamed) first_.emplace_back(line, what);
  ++count_;
}

void BadLines::tell(std::vector<std::string>& notes) const {
  for (const auto& [line, what] : first_)
    notes.push_back(file_ + ":" + std::to_string(line) + kLeftOut + what);
  if (count_ > static_cast<int>(first_.size()))
    notes.push_back(file_ + ": " + std::to_string(count_ - static_cast<int>(first_.size())) +
                    " more lines left out");
}

bool is_of_left_out_rows(std::string_view note) {
  return note.find(kLeftOut) != std::string_view::npos || note.ends_with(" more lines left out");
}

Error BadLines::error(const std::string& what) const {
  Error error{.code = ErrorCode::kSyntax, .message = what, .file = file_};
  if (!first_.empty()) {
    error.line = first_.front().first;
    error.message += ": " + first_.front().second;
  }
  return error;
}

}  // namespace trueflank::loop
