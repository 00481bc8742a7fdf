// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>

#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

constexpr std::size_t kHeaderBytes = kStlHeaderBytes, kRecordBytes = kStlRecordBytes;
constexpr std::size_t kFewestOfCutFile = 100;
constexpr std::uint32_t kMostOfCutFile = 400'000'000;

}  // namespace

Facet stl_facet(const char* record) {
  float values[12];  // normal, three corners
  std::memcpy(values, record, sizeof values);
  Facet facet;
  for (std::size_t k = 0; k < 9; ++k) facet[k / 3][k % 3] = values[3 + k];
  return facet;
}

Result<Bodies> parse_binary_stl(std::string_view content, Reading& reading) {
  if (content.size() < kHeaderBytes)
    return syntax_error("this is no STL: shorter than the header of a binary one");
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  const std::size_t held = (content.size() - kHeaderBytes) / kRecordBytes;
  if (count == 0) return syntax_error("this is no STL, or one without a triangle");
  if (held < count) {
    // fewer facets, or more promised than any file has: the four bytes may be anything
    const bool is_cut = held >= kFewestOfCutFile && count <= kMostOfCutFile;
    if (!reading.notes_damage() || !is_cut)
      return syntax_error("this is no STL, or one cut off: its header speaks of " +
                          std::to_string(count) + " triangles, there is room for " +
                          std::to_string(held));
    reading.note("the file is cut short; " + std::to_string(held) + " of " + std::to_string(count) +
                 " facets are there and used");
    count = static_cast<std::uint32_t>(held);
  }
  if (auto status = reading.take_facets(count, 0); !status) return fail(status.error());
  Welder welder(count);
  for (std::size_t i = 0; i < count; ++i)
    welder.add_triangle(stl_facet(content.data() + kHeaderBytes + i * kRecordBytes));
  return Bodies{{.name = {}, .mesh = welder.take()}};
}

namespace {

/// A text STL line by line. Where damage is noted, facets count and the words around them do not.
class TextStl {
 public:
  TextStl(std::string_view content, Reading& reading) : content_(content), reading_(reading) {}

  Result<Bodies> read() {
    while (!content_.empty()) {
      std::string_view rest = take_line(content_);
      ++line_;
      const std::string_view word = take_word(rest);
      if (word.empty()) continue;
      const auto status = word == "vertex"     ? take_vertex(rest)
                          : word == "facet"    ? begin_facet()
                          : word == "endfacet" ? end_facet()
                          : word == "solid"    ? begin_solid(rest)
                          : word == "endsolid" ? end_solid()
                                               : other(word);
      if (!status) return fail(status.error());
    }
    if (inside_) {
      if (!reading_.notes_damage())
        return syntax_error("the STL file is cut off: `endsolid` is missing", line_);
      reading_.note("the file is cut short after line " + std::to_string(line_));
      bodies_.back().mesh = welder_.take();
    }
    return std::move(bodies_);
  }

 private:
  Status wrong(std::string what) const {
    return reading_.notes_damage() ? Status{} : Status(syntax_error(std::move(what), line_));
  }
  Status take_vertex(std::string_view rest) {
    if (!inside_ || corner_ == 3) return wrong("a vertex outside of a facet");
    for (double& coordinate : corners_[corner_])
      if (!take_number(rest, coordinate)) {
        if (reading_.notes_damage() && content_.empty()) return {};  // the end of a cut file
        return syntax_error("a vertex without three numbers", line_);
      }
    ++corner_;
    return {};
  }
  Status begin_facet() {
    corner_ = 0;
    return {};
  }
  Status end_facet() {
    if (corner_ != 3) return wrong("a facet without three vertices");
    if (auto status = reading_.take_facets(1, 0); !status) return status;
    welder_.add_triangle(corners_);
    corner_ = 0;
    return {};
  }
  Status begin_solid(std::string_view name) {
    if (inside_) return wrong("a solid inside a solid");
    if (auto status = reading_.take_piece(); !status) return status;
    inside_ = true;
    while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
    bodies_.push_back({.name = std::string(name), .mesh = {}});
    // room for what can still come in one solid; the second of many is seldom so large
    welder_ = Welder(bodies_.size() == 1 ? content_.size() / 250 : 0);
    return {};
  }
  Status end_solid() {
    if (!inside_ || corner_ != 0) return wrong("`endsolid` out of place");
    bodies_.back().mesh = welder_.take();
    inside_ = false;
    return {};
  }
  Status other(std::string_view word) const {
    if (word == "outer" || word == "endloop") return {};
    return wrong("`" + std::string(word.substr(0, 40)) + "` is no word of an STL file");
  }

  std::string_view content_;
  Reading& reading_;
  Bodies bodies_;
  Welder welder_{0};
  Facet corners_{};
  std::size_t corner_ = 0;
  int line_ = 0;
  bool inside_ = false;
};

}  // namespace

Result<Bodies> parse_text_stl(std::string_view content, Reading& reading) {
  return TextStl(content, reading).read();
}

}  // namespace trueflank::io
