// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/xml_scanner.h"

#include <algorithm>

#include "trueflank/export/xml_text.h"

namespace trueflank::io {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool ends_name(char c) { return is_space(c) || c == '/' || c == '>' || c == '='; }

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

std::string_view take_name(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && !ends_name(text[length])) ++length;
  const std::string_view name = text.substr(0, length);
  text.remove_prefix(length);
  return without_prefix(name);
}

void skip_space(std::string_view& text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
}

}  // namespace

std::optional<std::string_view> XmlScanner::Tag::attribute(std::string_view wanted) const {
  for (const auto& [name_of, value] : attributes)
    if (name_of == wanted) return value;
  return std::nullopt;
}

std::string XmlScanner::Tag::text_attribute(std::string_view wanted) const {
  return xml_unescaped(attribute(wanted).value_or(""));
}

/// Passes over <!-- -->, <![CDATA[ ]]>, <? ?> and <! > at the front; false where one does not end.
bool XmlScanner::skip_markup() {
  std::string_view end = ">";
  if (rest_.substr(0, 4) == "<!--") end = "-->";
  else if (rest_.substr(0, 9) == "<![CDATA[") end = "]]>";
  else if (rest_.substr(0, 2) == "<?") end = "?>";
  const std::size_t at = rest_.find(end);
  if (at == rest_.npos) return stop();
  rest_.remove_prefix(at + end.size());
  return true;
}

bool XmlScanner::next(Tag& tag) {
  for (;;) {
    const std::size_t open = rest_.find('<');
    if (open == rest_.npos) return false;
    rest_.remove_prefix(open);
    if (rest_.size() < 2) return stop();
    if (rest_[1] != '!' && rest_[1] != '?') break;
    if (!skip_markup()) return false;
  }
  rest_.remove_prefix(1);
  tag.attributes.clear();
  tag.is_end = rest_.front() == '/';
  tag.is_start = !tag.is_end;
  if (tag.is_end) rest_.remove_prefix(1);
  tag.name = take_name(rest_);
  for (;;) {
    skip_space(rest_);
    if (rest_.empty()) return stop();
    if (rest_.front() == '>') {
      rest_.remove_prefix(1);
      return true;
    }
    if (rest_.front() == '/') {
      tag.is_end = true;
      rest_.remove_prefix(1);
      continue;
    }
    const std::string_view name = take_name(rest_);
    skip_space(rest_);
    if (name.empty() || rest_.empty() || rest_.front() != '=') return stop();
    rest_.remove_prefix(1);
    skip_space(rest_);
    if (rest_.empty() || (rest_.front() != '"' && rest_.front() != '\'')) return stop();
    const std::size_t close = rest_.find(rest_.front(), 1);
    if (close == rest_.npos) return stop();
    tag.attributes.emplace_back(name, rest_.substr(1, close - 1));
    rest_.remove_prefix(close + 1);
  }
}

}  // namespace trueflank::io
