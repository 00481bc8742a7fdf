// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <optional>

#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

/// Vertex number of a face's corner "7", "7/1", "7//3" or "-2"; 0-based.
std::optional<std::int64_t> corner_of(std::string_view word, std::size_t vertex_count) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || number == 0) return std::nullopt;
  if (end != word.data() + word.size() && *end != '/') return std::nullopt;
  return number > 0 ? number - 1 : static_cast<std::int64_t>(vertex_count) + number;
}

/// All vertices of the file are one list; each body gets those it uses.
struct ObjFile {
  std::vector<std::array<double, 3>> vertices;
  struct Body {
    std::string name;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };
  std::vector<Body> bodies;
};

Status add_face(ObjFile& file, std::string_view rest, int line_number, Reading& reading) {
  std::uint32_t fan[3];
  int corners = 0;
  for (auto word = take_word(rest); !word.empty() && word.front() != '#'; word = take_word(rest)) {
    const auto corner = corner_of(word, file.vertices.size());
    if (!corner) return syntax_error("`" + std::string(word) + "` is no vertex number", line_number);
    if (*corner < 0 || *corner >= static_cast<std::int64_t>(file.vertices.size()))
      return syntax_error("vertex " + std::string(word) + " does not exist (yet)", line_number);
    fan[corners < 2 ? corners : 2] = static_cast<std::uint32_t>(*corner);
    if (++corners < 3) continue;
    if (auto status = reading.take_facets(1, 0); !status) return status;
    file.bodies.back().triangles.push_back({fan[0], fan[1], fan[2]});
    fan[1] = fan[2];
  }
  if (corners < 3) return syntax_error("a face with fewer than three vertices", line_number);
  return {};
}

Bodies split(ObjFile&& file) {
  std::erase_if(file.bodies, [](const auto& body) { return body.triangles.empty(); });
  Bodies bodies;
  if (file.bodies.size() <= 1) {
    const bool any = !file.bodies.empty();
    bodies.push_back({any ? std::move(file.bodies.front().name) : std::string(),
                      {std::move(file.vertices),
                       any ? std::move(file.bodies.front().triangles)
                           : std::vector<std::array<std::uint32_t, 3>>{}}});
    return bodies;
  }
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> own(file.vertices.size(), kUnused);
  for (auto& part : file.bodies) {
    MeshBody body{.name = std::move(part.name), .mesh = {}};
    for (auto triangle : part.triangles) {
      for (std::uint32_t& corner : triangle) {
        if (own[corner] == kUnused) {
          own[corner] = static_cast<std::uint32_t>(body.mesh.vertices.size());
          body.mesh.vertices.push_back(file.vertices[corner]);
        }
        corner = own[corner];
      }
      body.mesh.triangles.push_back(triangle);
    }
    for (const auto& triangle : part.triangles)
      for (const std::uint32_t corner : triangle) own[corner] = kUnused;
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace

Result<Bodies> parse_obj(std::string_view content, Reading& reading) {
  ObjFile file;
  file.bodies.emplace_back();
  int line_number = 0;
  while (!content.empty()) {
    std::string_view rest = take_line(content);
    ++line_number;
    const std::string_view word = take_word(rest);
    if (word == "v") {
      std::array<double, 3> vertex{};
      for (double& coordinate : vertex)
        if (!take_number(rest, coordinate))
          return syntax_error("a vertex without three numbers", line_number);
      if (auto status = reading.take_facets(0, 1); !status) return fail(status.error());
      file.vertices.push_back(vertex);
    } else if (word == "f") {
      if (auto status = add_face(file, rest, line_number, reading); !status) return fail(status.error());
    } else if (word == "o" || (word == "g" && file.bodies.back().triangles.size() > 0)) {
      if (auto status = reading.take_piece(); !status) return fail(status.error());
      file.bodies.push_back({.name = std::string(take_word(rest)), .triangles = {}});
    } else if (word == "g" && file.bodies.back().name.empty()) {
      file.bodies.back().name = std::string(take_word(rest));
    }
  }
  if (file.vertices.empty()) return syntax_error("this is no OBJ file: it has no vertex");
  return split(std::move(file));
}

}  // namespace trueflank::io
