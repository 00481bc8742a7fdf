// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/xml_text.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

namespace trueflank::io {
namespace {

constexpr std::array<std::pair<std::string_view, char>, 5> kNamed = {
    {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};

void append_utf8(std::string& text, std::uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | code >> 6);
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | code >> 12);
    text += static_cast<char>(0x80 | (code >> 6 & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x110000) {
    text += static_cast<char>(0xf0 | code >> 18);
    text += static_cast<char>(0x80 | (code >> 12 & 0x3f));
    text += static_cast<char>(0x80 | (code >> 6 & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  }
}

/// Length of the entity at the front of `text`, 0 where there is none; appends what it stands for.
std::size_t unescape_entity(std::string_view text, std::string& out) {
  for (const auto& [name, character] : kNamed)
    if (text.substr(0, name.size()) == name) {
      out += character;
      return name.size();
    }
  if (text.substr(0, 2) != "&#") return 0;
  const bool hexadecimal = text.size() > 2 && text[2] == 'x';
  const char* begin = text.data() + (hexadecimal ? 3 : 2);
  std::uint32_t code = 0;
  const auto [end, error] =
      std::from_chars(begin, text.data() + text.size(), code, hexadecimal ? 16 : 10);
  if (error != std::errc() || end == text.data() + text.size() || *end != ';') return 0;
  append_utf8(out, code);
  return static_cast<std::size_t>(end - text.data()) + 1;
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char character : text) {
    if (static_cast<unsigned char>(character) < 0x20 && character != '\n' && character != '\t')
      continue;
    bool named = false;
    for (const auto& [name, plain] : kNamed)
      if (character == plain) {
        out += name;
        named = true;
      }
    if (!named) out += character;
  }
  return out;
}

std::string xml_unescaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t entity = text.front() == '&' ? unescape_entity(text, out) : 0;
    if (entity == 0) out += text.front();
    text.remove_prefix(entity == 0 ? 1 : entity);
  }
  return out;
}

}  // namespace trueflank::io
