// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/reading.h"

// One parser per format behind mesh_reader.h, and the few things they share.
namespace trueflank::io {

using Bodies = std::vector<MeshBody>;
[[nodiscard]] Result<Bodies> parse_binary_stl(std::string_view content, Reading& reading);
constexpr std::size_t kStlHeaderBytes = 84, kStlRecordBytes = 50;
/// The facet that a record of a binary STL begins with.
[[nodiscard]] Facet stl_facet(const char* record);
[[nodiscard]] Result<Bodies> parse_text_stl(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_obj(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_ply(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_3mf(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_glb(std::string_view content, Reading& reading);

[[nodiscard]] tl::unexpected<Error> syntax_error(std::string message, int line = 0);

/// A number at the front of `text`, cut off with the blanks before it. Errors: false.
[[nodiscard]] bool take_number(std::string_view& text, double& value);
/// The next word at the front of `text`, cut off with the blanks before it; empty at the end.
[[nodiscard]] std::string_view take_word(std::string_view& text);
/// The next line without its end, cut off.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// Gathers triangles whose corners are given by coordinates: equal coordinates become one vertex.
class Welder {
 public:
  explicit Welder(std::size_t expected_triangles);
  [[nodiscard]] std::uint32_t vertex(const std::array<double, 3>& point);
  void add_triangle(const Facet& corners);
  [[nodiscard]] TriangleMesh take();

 private:
  void grow();
  TriangleMesh mesh_;
  std::vector<std::uint32_t> table_;  // open addressing; vertex index + 1, 0: free
};

/// Stands for a vertex number that cannot be, where damage is noted.
constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};

/// Checks indices and coordinates. Errors: kSyntax.
[[nodiscard]] Status check_mesh(const TriangleMesh& mesh);

}  // namespace trueflank::io
