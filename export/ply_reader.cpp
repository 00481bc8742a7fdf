// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
enum class Coding { kText, kLittleEndian, kBigEndian };

struct Property {
  std::string name;
  Type type = Type::kFloat;
  std::optional<Type> count_type;  ///< of a list
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
struct Header {
  Coding coding = Coding::kText;
  std::vector<Element> elements;
  int lines = 0;
};

std::optional<Type> type_of(std::string_view word) {
  if (word == "char" || word == "int8") return Type::kInt8;
  if (word == "uchar" || word == "uint8") return Type::kUint8;
  if (word == "short" || word == "int16") return Type::kInt16;
  if (word == "ushort" || word == "uint16") return Type::kUint16;
  if (word == "int" || word == "int32") return Type::kInt32;
  if (word == "uint" || word == "uint32") return Type::kUint32;
  if (word == "float" || word == "float32") return Type::kFloat;
  if (word == "double" || word == "float64") return Type::kDouble;
  return std::nullopt;
}

std::size_t bytes_of(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kDouble:
      return 8;
    default:
      return 4;
  }
}

Status add_property(Header& header, std::string_view rest, int line) {
  if (header.elements.empty()) return syntax_error("a property without an element", line);
  Property property;
  std::string_view word = take_word(rest);
  if (word == "list") {
    property.count_type = type_of(take_word(rest));
    if (!property.count_type) return syntax_error("a list of an unknown type", line);
    word = take_word(rest);
  }
  const auto type = type_of(word);
  if (!type) return syntax_error("`" + std::string(word) + "` is no type", line);
  property.type = *type;
  property.name = std::string(take_word(rest));
  header.elements.back().properties.push_back(std::move(property));
  return {};
}

Result<Header> parse_header(std::string_view& content) {
  Header header;
  bool has_format = false;
  while (!content.empty()) {
    std::string_view rest = take_line(content);
    ++header.lines;
    const std::string_view word = take_word(rest);
    if (word == "end_header") {
      if (!has_format) return syntax_error("the PLY header names no format");
      return header;
    }
    if (word == "format") {
      const std::string_view name = take_word(rest);
      has_format = true;
      if (name == "ascii") header.coding = Coding::kText;
      else if (name == "binary_little_endian") header.coding = Coding::kLittleEndian;
      else if (name == "binary_big_endian") header.coding = Coding::kBigEndian;
      else return syntax_error("`" + std::string(name) + "` is no PLY format", header.lines);
    } else if (word == "element") {
      Element element{.name = std::string(take_word(rest)), .properties = {}};
      const std::string_view count = take_word(rest);
      const auto parsed = std::from_chars(count.data(), count.data() + count.size(), element.count);
      if (parsed.ec != std::errc()) return syntax_error("an element without a count", header.lines);
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (auto status = add_property(header, rest, header.lines); !status)
        return fail(status.error());
    }
  }
  return syntax_error("the PLY file is cut off: no end_header");
}

/// Reads values one after the other from the body of the file.
class Body {
 public:
  Body(std::string_view content, Coding coding) : content_(content), coding_(coding) {}
  [[nodiscard]] std::size_t left() const { return content_.size(); }

  /// False at the end of the file or where no number stands.
  [[nodiscard]] bool take(Type type, double& value) {
    if (coding_ == Coding::kText) {
      while (!content_.empty() && content_.front() <= ' ' && content_.front() >= 0)
        content_.remove_prefix(1);
      return take_number(content_, value);
    }
    const std::size_t size = bytes_of(type);
    if (content_.size() < size) return false;
    char bytes[8];
    std::memcpy(bytes, content_.data(), size);
    const bool little = coding_ == Coding::kLittleEndian;
    if (little != (std::endian::native == std::endian::little)) std::reverse(bytes, bytes + size);
    content_.remove_prefix(size);
    value = converted(bytes, type);
    return true;
  }

 private:
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  static double converted(const char* bytes, Type type) {
    switch (type) {
      case Type::kInt8: return as<std::int8_t>(bytes);
      case Type::kUint8: return as<std::uint8_t>(bytes);
      case Type::kInt16: return as<std::int16_t>(bytes);
      case Type::kUint16: return as<std::uint16_t>(bytes);
      case Type::kInt32: return as<std::int32_t>(bytes);
      case Type::kUint32: return as<std::uint32_t>(bytes);
      case Type::kFloat: return as<float>(bytes);
      case Type::kDouble: return as<double>(bytes);
    }
    return 0.0;
  }

  std::string_view content_;
  Coding coding_;
};

tl::unexpected<Error> cut_off(const Element& element, std::uint64_t index) {
  return syntax_error("the PLY file is cut off or damaged at " + element.name + " " +
                      std::to_string(index + 1) + " of " + std::to_string(element.count));
}

/// Values of a list, `values` reused. False at the end of the file.
bool take_list(Body& body, const Property& property, std::vector<double>& values) {
  double count = 0.0;
  if (!body.take(*property.count_type, count) || !(count >= 0.0) ||
      count > static_cast<double>(body.left()))
    return false;
  values.resize(static_cast<std::size_t>(count));
  for (double& value : values)
    if (!body.take(property.type, value)) return false;
  return true;
}

Status read_element(Body& body, const Element& element, TriangleMesh& mesh) {
  const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
  if (element.name == "tristrips")
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "triangle strips in a PLY file are not read"});
  const auto axis_of = [](const std::string& name) {
    return name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : -1;
  };
  std::vector<int> axes;
  for (const Property& property : element.properties) axes.push_back(axis_of(property.name));
  if (element.properties.empty()) return {};  // occupies nothing, however often
  if (is_vertex)
    for (int axis = 0; axis < 3; ++axis)
      if (std::find(axes.begin(), axes.end(), axis) == axes.end())
        return syntax_error("the vertices of the PLY file have no x, y and z");

  std::vector<double> list;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    std::array<double, 3> vertex{};
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      if (!property.count_type) {
        double value = 0.0;
        if (!body.take(property.type, value)) return cut_off(element, i);
        if (axes[k] >= 0) vertex[static_cast<std::size_t>(axes[k])] = value;
        continue;
      }
      if (!take_list(body, property, list)) return cut_off(element, i);
      if (!is_face || (property.name != "vertex_indices" && property.name != "vertex_index"))
        continue;
      for (const double value : list)
        if (!(value >= 0.0 && value < 4294967295.0 && value == std::floor(value)))
          return syntax_error("face " + std::to_string(i + 1) + " has an impossible vertex number");
      for (std::size_t c = 2; c < list.size(); ++c)
        mesh.triangles.push_back({static_cast<std::uint32_t>(list[0]),
                                  static_cast<std::uint32_t>(list[c - 1]),
                                  static_cast<std::uint32_t>(list[c])});
    }
    if (is_vertex) mesh.vertices.push_back(vertex);
  }
  return {};
}

}  // namespace

Result<Bodies> parse_ply(std::string_view content) {
  const auto header = parse_header(content);
  if (!header) return fail(header.error());
  Body body(content, header->coding);
  Bodies bodies(1);
  for (const Element& element : header->elements)
    if (auto status = read_element(body, element, bodies.front().mesh); !status)
      return fail(status.error());
  return bodies;
}

}  // namespace trueflank::io
