// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <unordered_map>

#include "trueflank/loop/read_measurement.h"
#include "trueflank/loop/text_table.h"

namespace trueflank::loop {
namespace {

using Point = std::array<double, 3>;
struct Surface3 {
  std::vector<Point> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Error broken(const std::string& file, const std::string& what, int line = 0) {
  return {.code = ErrorCode::kSyntax, .message = what, .file = file, .line = line};
}

bool finite(const Point& p) { return std::isfinite(p[0] + p[1] + p[2]); }

/// Vertices by exact place: STL repeats each vertex in every triangle.
class VertexIndex {
 public:
  explicit VertexIndex(Surface3& surface) : surface_(surface) {}
  std::uint32_t operator()(const Point& p) {
    std::uint64_t hash = 1469598103934665603ull;
    for (const double c : p) hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 1099511628211ull;
    hash ^= hash >> 29;
    auto [first, last] = found_.equal_range(hash);
    for (; first != last; ++first)
      if (surface_.vertices[first->second] == p) return first->second;
    const auto index = static_cast<std::uint32_t>(surface_.vertices.size());
    surface_.vertices.push_back(p);
    found_.emplace(hash, index);
    return index;
  }

 private:
  Surface3& surface_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> found_;
};

/// Facets that a binary STL file cut short still holds; 0 where it is none or complete.
std::uint32_t facets_of_cut_file(std::string_view text, std::uint32_t promised) {
  constexpr std::size_t kHead = 84, kFacet = 50, kFewest = 100;
  if (text.size() < kHead + kFacet * kFewest || text.size() >= kHead + kFacet * std::uint64_t{promised})
    return 0;
  const std::string_view head = text.substr(0, 1000);
  // Text has no zero bytes; a binary file's counts and attributes do.
  if (head.find('\0') == std::string_view::npos || promised > 400'000'000u) return 0;
  return static_cast<std::uint32_t>((text.size() - kHead) / kFacet);
}

Result<Surface3> read_stl(const std::string& file, std::string_view text,
                          std::vector<std::string>& notes) {
  Surface3 surface;
  VertexIndex index(surface);
  std::uint32_t count = 0;
  if (text.size() >= 84) std::memcpy(&count, text.data() + 80, 4);
  const std::uint32_t there = facets_of_cut_file(text, count);
  if (there > 0) {
    notes.push_back(file + ": the file is cut short; " + std::to_string(there) + " of " +
                    std::to_string(count) + " facets are there and used");
    count = there;
  }
  if (text.size() >= 84 && (there > 0 || text.size() == 84 + 50ull * count)) {
    for (std::uint32_t i = 0; i < count; ++i) {
      std::array<float, 9> c;
      std::memcpy(c.data(), text.data() + 84 + 50ull * i + 12, 36);
      std::array<std::uint32_t, 3> triangle;
      bool good = true;
      for (int k = 0; k < 3; ++k) {
        const Point p{c[3 * k], c[3 * k + 1], c[3 * k + 2]};
        good = good && finite(p);
        if (good) triangle[k] = index(p);
      }
      if (good) surface.triangles.push_back(triangle);
    }
    return surface;
  }
  if (!trimmed(text.substr(0, 80)).starts_with("solid"))
    return fail(broken(file, "this is no STL file: neither \"solid\" nor a binary header that fits "
                             "the file's length"));
  std::vector<std::string_view> fields;
  std::vector<std::uint32_t> corner;
  int line = 0;
  while (!text.empty()) {
    const std::string_view row = trimmed(next_line(text));
    ++line;
    if (row.starts_with("facet")) corner.clear();
    if (!row.starts_with("vertex")) continue;
    split_blanks(row, fields);
    if (fields.size() < 4) return fail(broken(file, "a vertex needs three numbers", line));
    const Point p{number_in(fields[1]), number_in(fields[2]), number_in(fields[3])};
    if (!finite(p)) return fail(broken(file, "a vertex needs three numbers", line));
    corner.push_back(index(p));
    if (corner.size() == 3) surface.triangles.push_back({corner[0], corner[1], corner[2]});
  }
  return surface;
}

void add_polygon(Surface3& surface, const std::vector<std::uint32_t>& corner) {
  for (std::size_t i = 2; i < corner.size(); ++i)
    surface.triangles.push_back({corner[0], corner[i - 1], corner[i]});
}

Result<Surface3> read_obj(const std::string& file, std::string_view text) {
  Surface3 surface;
  std::vector<std::string_view> fields;
  std::vector<std::uint32_t> corner;
  int line = 0;
  while (!text.empty()) {
    const std::string_view row = trimmed(next_line(text));
    ++line;
    if (row.starts_with("v ") || row.starts_with("v\t")) {
      split_blanks(row, fields);
      Point p{kNaN, kNaN, kNaN};
      for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i) p[i] = number_in(fields[i + 1]);
      if (!finite(p)) return fail(broken(file, "a vertex needs three numbers", line));
      surface.vertices.push_back(p);
    } else if (row.starts_with("f ")) {
      split_blanks(row, fields);
      corner.clear();
      for (std::size_t i = 1; i < fields.size(); ++i) {
        const double number = number_in(fields[i].substr(0, fields[i].find('/')));
        const double size = static_cast<double>(surface.vertices.size());
        const double index = number < 0.0 ? size + number : number - 1.0;
        if (!(index >= 0.0 && index < size))
          return fail(broken(file, "a face names a vertex that does not exist", line));
        corner.push_back(static_cast<std::uint32_t>(index));
      }
      add_polygon(surface, corner);
    }
  }
  return surface;
}

struct PlyProperty {
  std::string name, type, count_type;  // count_type: lists only
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

int ply_size(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" ||
      type == "float32")
    return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

/// Reads PLY values one by one, ASCII or binary of either byte order.
class PlyValues {
 public:
  PlyValues(std::string_view text, bool ascii, bool big_endian)
      : text_(text), ascii_(ascii), big_endian_(big_endian) {}
  std::optional<double> next(const std::string& type) {
    if (ascii_) {
      const std::size_t begin = text_.find_first_not_of(" \t\r\n");
      if (begin == std::string_view::npos) return std::nullopt;
      const std::size_t end = text_.find_first_of(" \t\r\n", begin);
      const double value =
          number_in(text_.substr(begin, end == std::string_view::npos ? end : end - begin));
      text_ = end == std::string_view::npos ? std::string_view() : text_.substr(end);
      return value;
    }
    const int size = ply_size(type);
    if (static_cast<int>(text_.size()) < size && text_.size() < 8) return std::nullopt;
    if (text_.size() < static_cast<std::size_t>(size)) return std::nullopt;
    char bytes[8];
    std::memcpy(bytes, text_.data(), size);
    if (big_endian_) std::reverse(bytes, bytes + size);
    text_.remove_prefix(size);
    return value_of(bytes, type, size);
  }

 private:
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  static double value_of(const char* bytes, const std::string& type, int size) {
    const bool is_unsigned = type.front() == 'u';
    if (size == 8) return as<double>(bytes);
    if (type.starts_with("float")) return as<float>(bytes);
    if (size == 1) return is_unsigned ? as<std::uint8_t>(bytes) : as<std::int8_t>(bytes);
    if (size == 2) return is_unsigned ? as<std::uint16_t>(bytes) : as<std::int16_t>(bytes);
    return is_unsigned ? as<std::uint32_t>(bytes) : as<std::int32_t>(bytes);
  }
  std::string_view text_;
  bool ascii_, big_endian_;
};

struct PlyHeader {
  bool ascii = true, big_endian = false;
  std::vector<PlyElement> elements;
};

Result<PlyHeader> read_ply_header(const std::string& file, std::string_view& text) {
  PlyHeader header;
  std::vector<std::string_view> fields;
  int line = 0;
  while (!text.empty()) {
    split_blanks(next_line(text), fields);
    ++line;
    if (line == 1 && (fields.empty() || fields[0] != "ply"))
      return fail(broken(file, "a PLY file begins with \"ply\"", 1));
    if (fields.empty()) continue;
    if (fields[0] == "end_header") return header;
    if (fields[0] == "format" && fields.size() > 1) {
      header.ascii = fields[1] == "ascii";
      header.big_endian = fields[1] == "binary_big_endian";
    } else if (fields[0] == "element" && fields.size() > 2) {
      const double count = number_in(fields[2]);
      if (!(count >= 0.0)) return fail(broken(file, "an element needs a count", line));
      header.elements.push_back({std::string(fields[1]), static_cast<std::size_t>(count), {}});
    } else if (fields[0] == "property" && !header.elements.empty() && fields.size() > 2) {
      PlyProperty property;
      property.name = std::string(fields.back());
      property.type = std::string(fields[fields.size() - 2]);
      if (fields[1] == "list" && fields.size() > 4) property.count_type = std::string(fields[2]);
      if (ply_size(property.type) == 0)
        return fail(broken(file, "a property of unknown type " + property.type, line));
      header.elements.back().properties.push_back(property);
    }
  }
  return fail(broken(file, "the PLY header has no end"));
}

Result<Surface3> read_ply(const std::string& file, std::string_view text,
                          std::vector<std::string>& notes) {
  const auto header = read_ply_header(file, text);
  if (!header) return fail(header.error());
  PlyValues values(text, header->ascii, header->big_endian);
  Surface3 surface;
  std::vector<std::uint32_t> corner;
  for (const PlyElement& element : header->elements) {
    for (std::size_t i = 0; i < element.count; ++i) {
      Point p{kNaN, kNaN, kNaN};
      for (const PlyProperty& property : element.properties) {
        double count = 1.0;
        if (!property.count_type.empty()) count = values.next(property.count_type).value_or(-1.0);
        if (!(count >= 0.0 && count < 1e6)) count = -1.0;
        corner.clear();
        for (int k = 0; k < count || count < 0.0; ++k) {
          const auto value = count < 0.0 ? std::nullopt : values.next(property.type);
          if (!value) {
            notes.push_back(file + ": ends in the middle of element " + element.name + " " +
                            std::to_string(i + 1) + " of " + std::to_string(element.count));
            return surface;
          }
          if (!property.count_type.empty()) corner.push_back(static_cast<std::uint32_t>(*value));
          else if (property.name == "x") p[0] = *value;
          else if (property.name == "y") p[1] = *value;
          else if (property.name == "z") p[2] = *value;
        }
      }
      if (element.name == "vertex") surface.vertices.push_back(p);
      if (element.name == "face") add_polygon(surface, corner);
    }
  }
  return surface;
}

Point cross3(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot3(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Points with normals of a triangle mesh: every vertex once for each direction its facets look in.
/// A long narrow facet of a prismatic wall says more than its corners: its long straight edge is
/// sampled too (not the diagonal, which runs inside the curved wall).
class MeshSampler {
 public:
  MeshSampler(const Surface3& surface, ScanData& scan)
      : surface_(surface), scan_(scan), seen_(surface.vertices.size()) {}
  void run() {
    for (const auto& t : surface_.triangles) {
      const std::array<Point, 3> p{surface_.vertices[t[0]], surface_.vertices[t[1]],
                                   surface_.vertices[t[2]]};
      Point n = cross3(minus(p[1], p[0]), minus(p[2], p[0]));
      const double length = std::sqrt(dot3(n, n));
      if (!(length > 0.0)) continue;
      for (double& c : n) c /= length;
      for (int k = 0; k < 3; ++k) add_vertex(t[k], n);
      sample_long_edge(p, n);
    }
  }

 private:
  void add_vertex(std::uint32_t vertex, const Point& n) {
    for (const Point& before : seen_[vertex])
      if (dot3(before, n) > 0.8) return;
    seen_[vertex].push_back(n);
    add(surface_.vertices[vertex], n);
  }
  void add(const Point& p, const Point& n) {
    scan_.points_mm.push_back(p);
    scan_.normals.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]),
                             static_cast<float>(n[2])});
  }
  void sample_long_edge(const std::array<Point, 3>& p, const Point& n) {
    std::array<std::pair<double, int>, 3> edge;
    for (int k = 0; k < 3; ++k) {
      const Point d = minus(p[(k + 1) % 3], p[k]);
      edge[k] = {std::sqrt(dot3(d, d)), k};
    }
    std::sort(edge.begin(), edge.end());
    if (edge[1].first < 8.0 * edge[0].first) return;
    const Point& a = p[edge[1].second];
    const Point& b = p[(edge[1].second + 1) % 3];
    constexpr int kParts = 12;
    for (int i = 1; i < kParts; ++i) {
      const double f = static_cast<double>(i) / kParts;
      add({a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])}, n);
    }
  }
  const Surface3& surface_;
  ScanData& scan_;
  std::vector<std::vector<Point>> seen_;
};

}  // namespace

Result<ScanData> read_scan_mesh(const std::string& file, std::string_view text,
                                std::vector<std::string>& notes) {
  const std::string ending = lowered(std::filesystem::path(file).extension().string());
  auto surface = ending == ".stl"   ? read_stl(file, text, notes)
                 : ending == ".obj" ? read_obj(file, text)
                                    : read_ply(file, text, notes);
  if (!surface) return fail(surface.error());
  ScanData scan;
  scan.file = file;
  const std::size_t count = surface->vertices.size();
  std::erase_if(surface->triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t i) {
      return i >= count || !finite(surface->vertices[i]);
    });
  });
  if (!surface->triangles.empty()) {
    MeshSampler(*surface, scan).run();
  } else {
    for (const Point& p : surface->vertices)
      if (finite(p)) scan.points_mm.push_back(p);
    if (scan.points_mm.size() < count)
      notes.push_back(file + ": " + std::to_string(count - scan.points_mm.size()) +
                      " points without three numbers left out");
  }
  if (scan.points_mm.empty()) return fail(broken(file, "the scan has no usable point"));
  return scan;
}

}  // namespace trueflank::loop
