// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>

#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

constexpr std::size_t kHeaderBytes = kStlHeaderBytes, kRecordBytes = kStlRecordBytes;

}  // namespace

Facet stl_facet(const char* record) {
  float values[12];  // normal, three corners
  std::memcpy(values, record, sizeof values);
  Facet facet;
  for (std::size_t k = 0; k < 9; ++k) facet[k / 3][k % 3] = values[3 + k];
  return facet;
}

Result<Bodies> parse_binary_stl(std::string_view content) {
  if (content.size() < kHeaderBytes)
    return syntax_error("this is no STL: shorter than the header of a binary one");
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  const std::size_t held = (content.size() - kHeaderBytes) / kRecordBytes;
  if (count == 0) return syntax_error("this is no STL, or one without a triangle");
  if (held < count)
    return syntax_error("this is no STL, or one cut off: its header speaks of " +
                        std::to_string(count) + " triangles, there is room for " +
                        std::to_string(held));
  Welder welder(count);
  for (std::size_t i = 0; i < count; ++i)
    welder.add_triangle(stl_facet(content.data() + kHeaderBytes + i * kRecordBytes));
  return Bodies{{.name = {}, .mesh = welder.take()}};
}

Result<Bodies> parse_text_stl(std::string_view content) {
  Bodies bodies;
  Welder welder(content.size() / 250);
  Facet corners{};
  int corner = 0, line_number = 0;
  bool inside = false;
  while (!content.empty()) {
    std::string_view line = take_line(content);
    ++line_number;
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "vertex") {
      if (!inside || corner == 3) return syntax_error("a vertex outside of a facet", line_number);
      for (double& coordinate : corners[corner])
        if (!take_number(rest, coordinate))
          return syntax_error("a vertex without three numbers", line_number);
      ++corner;
    } else if (word == "endfacet") {
      if (corner != 3) return syntax_error("a facet without three vertices", line_number);
      welder.add_triangle(corners);
      corner = 0;
    } else if (word == "solid") {
      if (inside) return syntax_error("a solid inside a solid", line_number);
      inside = true;
      while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
      bodies.push_back({.name = std::string(rest), .mesh = {}});
    } else if (word == "endsolid") {
      if (!inside || corner != 0) return syntax_error("`endsolid` out of place", line_number);
      bodies.back().mesh = welder.take();
      welder = Welder(content.size() / 250);
      inside = false;
    } else if (!word.empty() && word != "facet" && word != "outer" && word != "endloop") {
      return syntax_error("`" + std::string(word.substr(0, 40)) + "` is no word of an STL file",
                          line_number);
    }
  }
  if (inside) return syntax_error("the STL file is cut off: `endsolid` is missing", line_number);
  return bodies;
}

}  // namespace trueflank::io
