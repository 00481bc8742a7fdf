// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/input_file.h"

// Comma separated text as measuring programs write it.
namespace trueflank::loop {

/// Of files of formulas, loop.json and the like, which people write or programs write for one gear.
constexpr std::size_t kMostBytesOfText = 32U << 20;

/// The whole file. Errors: kFileNotFound, kPermission, kDisk; kUnsupported beyond most_bytes, and where a
/// pipe or device does not end.
[[nodiscard]] Result<std::string> read_whole_file(const std::string& path,
                                                  std::size_t most_bytes = io::kMostBytesOfFile);

/// Next line of a text without its end (LF or CRLF); the text moves on behind it.
[[nodiscard]] std::string_view next_line(std::string_view& text);
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Fields between separators (comma, semicolon or tab, whichever the line has), trimmed; the first 10 000.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);
/// Fields between blanks or commas, trimmed; the first 10 000.
void split_blanks(std::string_view line, std::vector<std::string_view>& fields);
/// The field between quotation marks, for messages.
[[nodiscard]] std::string in_quotes(std::string_view field);
/// The finite number a field is; NaN where it is none.
[[nodiscard]] double number_in(std::string_view field);

/// True for a note that names a row left out (BadLines::tell).
[[nodiscard]] bool is_of_left_out_rows(std::string_view note);

/// Notes about bad lines of one file: the first few in words, the rest counted.
class BadLines {
 public:
  explicit BadLines(std::string file) : file_(std::move(file)) {}
  void add(int line, const std::string& what);
  [[nodiscard]] int count() const { return count_; }
  /// One sentence a remembered line, and one for the rest.
  void tell(std::vector<std::string>& notes) const;
  /// The error where no line was good.
  [[nodiscard]] Error error(const std::string& what) const;

 private:
  std::string file_;
  std::vector<std::pair<int, std::string>> first_;
  int count_ = 0;
};

}  // namespace trueflank::loop
