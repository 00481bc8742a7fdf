// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/mesh_reader.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "trueflank/export/assimp_reader.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/known_meshes.h"
#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

enum class FileMark { kNone, k3mf, kGlb, kPly, kBinaryStl };

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

bool begins_with(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word;
}

/// Of a file of this size that begins so.
bool is_binary_stl_by_size(std::string_view head, std::size_t size) {
  if (head.size() < kStlHeaderBytes) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, head.data() + 80, sizeof count);
  return size == kStlHeaderBytes + kStlRecordBytes * static_cast<std::size_t>(count);
}

/// By the marks that some formats begin with.
FileMark mark_of(std::string_view head, std::size_t size) {
  if (begins_with(head, "PK\3\4")) return FileMark::k3mf;
  if (begins_with(head, "glTF")) return FileMark::kGlb;
  if (begins_with(head, "ply\n") || begins_with(head, "ply\r")) return FileMark::kPly;
  return is_binary_stl_by_size(head, size) ? FileMark::kBinaryStl : FileMark::kNone;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

Error with_file(Error error, const std::filesystem::path& path) {
  if (error.file.empty()) error.file = path.string();
  return error;
}

Error no_triangle(const std::filesystem::path& path) {
  return with_file({.code = ErrorCode::kSyntax, .message = "the mesh has no triangle"}, path);
}

Error not_finite() {
  return {.code = ErrorCode::kSyntax, .message = "a coordinate is not a finite number"};
}

bool is_finite(const std::array<double, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

bool is_mesh_extension(std::string_view extension) {
  const std::string ending = lower_case(extension);
  if (is_assimp_extension(ending)) return true;
  return std::any_of(file_formats().begin(), file_formats().end(), [&](FileFormat format) {
    return is_mesh(format) && ending == "." + std::string(to_text(format));
  });
}

tl::unexpected<Error> syntax_error(std::string message, int line) {
  return fail(Error{.code = ErrorCode::kSyntax, .message = std::move(message), .line = line});
}

bool take_number(std::string_view& text, double& value) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* at = text.data();
  if (take_short_decimal(at, at + text.size(), value)) {
    text.remove_prefix(static_cast<std::size_t>(at - text.data()));
    return true;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && (is_blank(text[begin]) || text[begin] == '\n')) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end]) && text[end] != '\n') ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

Welder::Welder(std::size_t expected_triangles) {
  mesh_.triangles.reserve(expected_triangles);
  mesh_.vertices.reserve(expected_triangles / 2 + 2);
  table_.resize(std::bit_ceil(expected_triangles + 16));
}

std::uint32_t Welder::vertex(const std::array<double, 3>& point) {
  if (2 * mesh_.vertices.size() >= table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  std::uint64_t hash = 0;
  for (const double coordinate : point)  // + 0: negative zero is zero
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9E3779B97F4A7C15U;
  hash ^= hash >> 29;
  hash *= 0xBF58476D1CE4E5B9U;
  for (std::size_t at = (hash ^ hash >> 32) & mask;; at = (at + 1) & mask) {
    if (table_[at] == 0) {
      mesh_.vertices.push_back(point);
      return (table_[at] = static_cast<std::uint32_t>(mesh_.vertices.size())) - 1;
    }
    if (mesh_.vertices[table_[at] - 1] == point) return table_[at] - 1;
  }
}

void Welder::grow() {
  Welder larger(2 * table_.size());
  for (const auto& point : mesh_.vertices) static_cast<void>(larger.vertex(point));
  table_ = std::move(larger.table_);
}

void Welder::add_triangle(const Facet& corners) {
  // neighbours follow each other in most files: two corners of three were just there
  const auto known = [&](const std::array<double, 3>& point) {
    if (!mesh_.triangles.empty())
      for (const std::uint32_t v : mesh_.triangles.back())
        if (mesh_.vertices[v] == point) return v;
    return vertex(point);
  };
  mesh_.triangles.push_back({known(corners[0]), known(corners[1]), known(corners[2])});
}

TriangleMesh Welder::take() { return std::move(mesh_); }

Status check_mesh(const TriangleMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  for (const auto& t : mesh.triangles)
    if (t[0] >= count || t[1] >= count || t[2] >= count)
      return syntax_error("a triangle refers to a vertex that does not exist (" +
                          std::to_string(std::max({t[0], t[1], t[2]}) + 1) + " of " +
                          std::to_string(count) + ")");
  for (const auto& v : mesh.vertices)
    if (!is_finite(v)) return fail(not_finite());
  return {};
}

namespace {

Result<Bodies> parsed(std::string_view content, std::string_view extension, Reading& reading) {
  if (content.empty()) return syntax_error("the file is empty");
  switch (mark_of(content, content.size())) {
    case FileMark::k3mf: return parse_3mf(content, reading);
    case FileMark::kGlb: return parse_glb(content, reading);
    case FileMark::kPly: return parse_ply(content, reading);
    case FileMark::kBinaryStl: return parse_binary_stl(content, reading);
    case FileMark::kNone: break;
  }
  const std::string ending = lower_case(extension);
  if (ending == ".obj") return parse_obj(content, reading);
  // Text has no zero bytes; the counts and attributes of a binary file that was cut short do.
  const bool may_be_text = content.substr(0, 1000).find('\0') == content.npos;
  std::string_view rest = content;
  if (may_be_text && lower_case(take_word(rest)) == "solid" && content.find("facet") != content.npos)
    return parse_text_stl(content, reading);
  if (ending == ".stl") return parse_binary_stl(content, reading);  // which says what is wrong
  if (is_assimp_extension(ending)) return parse_by_assimp(content, ending, reading);
  return syntax_error("this is no mesh of a format known here (STL, OBJ, PLY, 3MF, GLB; by their endings " +
                      assimp_extensions(", ") + ")");
}

TriangleMesh merged(Bodies&& bodies) {
  TriangleMesh all;
  for (MeshBody& body : bodies) {
    if (all.vertices.empty()) {
      all = std::move(body.mesh);
      continue;
    }
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), body.mesh.vertices.begin(), body.mesh.vertices.end());
    for (const auto& t : body.mesh.triangles)
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all;
}

}  // namespace

namespace {

Result<Bodies> checked_bodies(std::string_view content, std::string_view extension,
                              Reading& reading) {
  auto bodies = parsed(content, extension, reading);
  if (!bodies) return bodies;
  for (const MeshBody& body : *bodies)
    if (auto status = check_mesh(body.mesh); !status) return fail(std::move(status.error()));
  return bodies;
}

Status show_facets(const Bodies& bodies, const std::filesystem::path& path,
                   const std::function<void(const Facet&)>& show) {
  bool any = false;
  for (const auto& [name, mesh] : bodies)
    for (const auto& t : mesh.triangles) {
      show({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
      any = true;
    }
  return any ? Status{} : fail(no_triangle(path));
}

}  // namespace

Result<std::vector<MeshBody>> parse_bodies(std::string_view content, std::string_view extension) {
  Reading reading(content.size());
  return checked_bodies(content, extension, reading);
}

Result<ScanMesh> parse_scan(std::string_view content, std::string_view extension) {
  Reading reading(content.size(), Reading::Damage::kNote);
  auto bodies = parsed(content, extension, reading);
  if (!bodies) return fail(std::move(bodies.error()));
  const auto is_unusable = [](const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return v >= mesh.vertices.size() || !is_finite(mesh.vertices[v]);
    });
  };
  std::size_t left_out = 0;
  for (MeshBody& body : *bodies)
    left_out += std::erase_if(body.mesh.triangles,
                              [&](const auto& t) { return is_unusable(body.mesh, t); });
  if (left_out > 0)
    reading.note(std::to_string(left_out) +
                 " facets left out: a corner has no place or does not exist");
  return ScanMesh{.mesh = merged(std::move(*bodies)), .notes = reading.take_notes()};
}

Result<std::vector<MeshBody>> read_bodies(const std::filesystem::path& path) {
  const auto content = read_file(path);
  if (!content) return fail(content.error());
  auto bodies = parse_bodies(*content, path.extension().string());
  if (!bodies) return fail(with_file(std::move(bodies.error()), path));
  return bodies;
}

Result<TriangleMesh> read_mesh(const std::filesystem::path& path) {
  auto bodies = read_bodies(path);
  if (!bodies) return fail(std::move(bodies.error()));
  TriangleMesh all = merged(std::move(*bodies));
  if (all.triangles.empty()) return fail(no_triangle(path));
  return all;
}

Status visit_facets(const std::filesystem::path& path,
                    const std::function<void(const Facet&)>& show) {
  InputFile file(path);
  std::string head;
  if (const auto size = file.regular_size()) {  // a pipe's head could not be read again
    head.resize(std::min(*size, kStlHeaderBytes));
    head.resize(file.fill(head.data(), head.size()));
  }
  if (mark_of(head, file.regular_size().value_or(0)) != FileMark::kBinaryStl ||
      *file.regular_size() == kStlHeaderBytes) {
    const auto bodies = read_bodies(path);
    if (!bodies) return fail(bodies.error());
    return show_facets(*bodies, path, show);
  }
  std::string block(1000 * kStlRecordBytes, '\0');
  for (std::size_t left = *file.regular_size() - kStlHeaderBytes; left > 0;) {
    const std::size_t wanted = std::min(left, block.size());
    if (file.fill(block.data(), wanted) != wanted)
      return fail(file_error("read", path, file.error_number() != 0 ? file.error_number() : EIO));
    for (std::size_t at = 0; at < wanted; at += kStlRecordBytes) {
      const Facet facet = stl_facet(block.data() + at);
      for (const auto& corner : facet)
        if (!is_finite(corner)) return fail(with_file(not_finite(), path));
      show(facet);
    }
    left -= wanted;
  }
  return {};
}

Status visit_facets(const std::filesystem::path& path, std::vector<KnownMesh*> known,
                    const std::function<void(const Facet&)>& show) {
  const auto content = read_file(path);
  if (!content) return fail(content.error());
  Reading reading(content->size());
  reading.expect(std::move(known));
  const auto bodies = checked_bodies(*content, path.extension().string(), reading);
  if (!bodies) return fail(with_file(bodies.error(), path));
  return show_facets(*bodies, path, show);
}

Result<std::vector<std::array<double, 3>>> read_points(const std::filesystem::path& path) {
  auto bodies = read_bodies(path);
  if (!bodies) return fail(std::move(bodies.error()));
  std::vector<std::array<double, 3>> points;
  for (const MeshBody& body : *bodies)
    points.insert(points.end(), body.mesh.vertices.begin(), body.mesh.vertices.end());
  if (points.empty())
    return fail(with_file({.code = ErrorCode::kSyntax, .message = "the file has no point"}, path));
  return points;
}

}  // namespace trueflank::io
