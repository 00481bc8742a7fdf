// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {

/// Walks a CSV text: comments `# key = value`, one header, rows.
class CsvRows {
 public:
  CsvRows(std::string file, std::string_view text) : bad(file), file_(std::move(file)), rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    while (next_content()) {
      split_fields(line_text_, fields_);
      for (const auto field : fields_) header_.push_back(lowered(field));
      break;
    }
  }
  [[nodiscard]] int column(std::string_view name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    return found == header_.end() ? -1 : static_cast<int>(found - header_.begin());
  }
  [[nodiscard]] std::optional<Error> missing(const std::vector<std::string_view>& needed) const {
    for (const auto name : needed)
      if (column(name) < 0)
        return Error{.code = ErrorCode::kMissingKey,
                     .message = "the header has no column \"" + std::string(name) + "\"",
                     .key = std::string(name),
                     .file = file_,
                     .line = line_};
    return std::nullopt;
  }
  bool next() {
    if (!next_content()) return false;
    split_fields(line_text_, fields_);
    return true;
  }
  [[nodiscard]] std::string_view field(int column) const {
    return column >= 0 && column < static_cast<int>(fields_.size()) ? fields_[column]
                                                                    : std::string_view();
  }
  [[nodiscard]] double number(int column) const { return number_in(field(column)); }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] const std::vector<std::string>& header() const { return header_; }

  std::map<std::string, std::string> keys;
  BadLines bad;

 private:
  bool next_content() {
    while (!rest_.empty()) {
      line_text_ = trimmed(next_line(rest_));
      ++line_;
      if (line_text_.empty()) continue;
      if (line_text_.front() != '#') return true;
      const std::size_t equals = line_text_.find('=');
      if (equals != std::string_view::npos)
        keys[lowered(trimmed(line_text_.substr(1, equals - 1)))] =
            std::string(trimmed(line_text_.substr(equals + 1)));
    }
    return false;
  }
  std::string file_;
  std::string_view rest_, line_text_;
  std::vector<std::string> header_;
  std::vector<std::string_view> fields_;
  int line_ = 0;
};

}  // namespace trueflank::loop
