// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/toml_text.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

Error at_line(int line, std::string message, std::string remedy) {
  return {.code = ErrorCode::kSyntax,
          .message = std::move(message),
          .remedy = std::move(remedy),
          .line = line};
}

int line_of(std::string_view text, std::size_t position) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + position, '\n'));
}

/// Bytes of the UTF-8 sequence at `position`; 0 where it is none (too long a form, surrogates and
/// numbers beyond Unicode included).
std::size_t utf8_length(std::string_view text, std::size_t position) {
  const auto byte = [&](std::size_t i) {
    return position + i < text.size() ? static_cast<unsigned char>(text[position + i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  const unsigned second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

Status check_encoding(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return fail(at_line(1, "the file is UTF-16 text", "the same text saved as UTF-8"));
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\0')
      return fail(at_line(line_of(text, i), "the file holds a NUL byte: it is no text",
                          "a design file in TOML"));
    const std::size_t length = utf8_length(text, i);
    if (length == 0)
      return fail(at_line(line_of(text, i), "the file is not UTF-8 text",
                          "a design file in TOML, saved as UTF-8"));
    i += length;
  }
  return {};
}

/// Follows strings and comments, so that what is left is keys, punctuation and bare values.
class BareScanner {
 public:
  explicit BareScanner(std::string_view text) : text_(text) {}

  Status scan() {
    while (position_ < text_.size()) {
      const char c = text_[position_];
      if (c == '#') {
        skip_comment();
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (auto status = bare(c); !status) {
        return status;
      }
    }
    return {};
  }

 private:
  void skip_comment() { position_ = std::min(text_.find('\n', position_), text_.size()); }

  /// Leaves a one-line string at its line's end, as the parser does.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool multi_line = text_.substr(position_).starts_with(three);
    position_ += multi_line ? 3 : 1;
    while (position_ < text_.size()) {
      if (quote == '"' && text_[position_] == '\\') {
        next();
        if (position_ < text_.size()) next();
      } else if (multi_line && text_.substr(position_).starts_with(three)) {
        position_ += 3;
        // up to two more quotes belong to the string
        for (int i = 0; i < 2 && position_ < text_.size() && text_[position_] == quote; ++i)
          ++position_;
        return;
      } else if (!multi_line && (text_[position_] == quote || text_[position_] == '\n')) {
        if (text_[position_] == quote) ++position_;
        return;
      } else {
        next();
      }
    }
  }

  Status bare(char c) {
    if (static_cast<unsigned char>(c) >= 0x80)
      return fail(at_line(line_, "non-ASCII letter outside of strings and comments",
                          "keys of the letters a-z, digits and _; text in quotes"));
    if (c == '.' && ++dots_ >= kDeepestToml)
      return fail(at_line(line_, "a key of more than " + std::to_string(kDeepestToml) + " parts",
                          "table.key = value"));
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots_ = 0;
    next();
    return {};
  }

  void next() {
    if (text_[position_] == '\n') ++line_;
    ++position_;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  int line_ = 1;
  int dots_ = 0;
};

}  // namespace

Status check_toml_text(std::string_view text) {
  if (auto status = check_encoding(text); !status) return status;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return BareScanner(text).scan();
}

}  // namespace trueflank
