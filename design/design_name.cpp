// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_name.h"

#include "trueflank/design/toml_lexer.h"

namespace trueflank {
namespace {

constexpr std::size_t kLongest_bytes = 100;

/// Without control characters, those from U+0080 on (two bytes) included.
std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    if (byte == 0xC2 && next >= 0x80 && next < 0xA0)
      ++i;
    else if (byte >= 0x20 && byte != 0x7F)
      result += text[i];
  }
  return result;
}

}  // namespace

bool is_design_name(const std::string& text) {
  return !text.empty() && text.size() <= kLongest_bytes && check_text_encoding(text) &&
         printable(text) == text;
}

std::string design_name_from(const std::string& text) {
  if (!check_text_encoding(text)) return "gearbox";
  std::string name = printable(text);
  if (name.size() > kLongest_bytes) {
    std::size_t end = kLongest_bytes;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;
    name.resize(end);
  }
  return name.empty() ? "gearbox" : name;
}

}  // namespace trueflank
