// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "trueflank/base/large_pages.h"
#include "trueflank/base/threads.h"
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
      if (parsed.ec != std::errc() || parsed.ptr != count.data() + count.size())
        return syntax_error("an element without a count", header.lines);
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
  /// `words_are_nan`: whatever stands in the place of a number in a text is not one, but is read.
  Body(std::string_view content, Coding coding, bool words_are_nan)
      : content_(content), coding_(coding), words_are_nan_(words_are_nan) {}
  [[nodiscard]] std::size_t left() const { return content_.size(); }

  /// False at the end of the file or where no number stands.
  [[nodiscard]] bool take(Type type, double& value) {
    if (coding_ == Coding::kText) {
      while (!content_.empty() && content_.front() <= ' ' && content_.front() >= 0)
        content_.remove_prefix(1);
      if (take_number(content_, value)) return true;
      value = std::numeric_limits<double>::quiet_NaN();
      return words_are_nan_ && !take_word(content_).empty();
    }
    const std::size_t size = bytes_of(type);
    if (content_.size() < size) return false;
    value = value_of(content_.data(), type);
    content_.remove_prefix(size);
    return true;
  }

  /// Of an element, the same for all of them; 0: of text and of lists it is not.
  [[nodiscard]] std::size_t bytes_of_each(const Element& element) const {
    if (coding_ == Coding::kText) return 0;
    std::size_t bytes = 0;
    for (const Property& property : element.properties) {
      if (property.count_type) return 0;
      bytes += bytes_of(property.type);
    }
    return bytes;
  }
  [[nodiscard]] const char* data() const { return content_.data(); }
  void skip(std::size_t bytes) { content_.remove_prefix(bytes); }
  /// Of the bytes there.
  [[nodiscard]] double value_of(const char* at, Type type) const {
    const bool little = coding_ == Coding::kLittleEndian;
    if (little == (std::endian::native == std::endian::little)) return converted(at, type);
    char bytes[8];
    std::reverse_copy(at, at + bytes_of(type), bytes);
    return converted(bytes, type);
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
  bool words_are_nan_;
};

/// Reads the elements of the body in their order.
class ElementReader {
 public:
  ElementReader(Body body, Reading& reading) : body_(body), reading_(reading) {}

  /// False where the file ends too early and what there is shall be used.
  Result<bool> read(const Element& element) {
    if (element.name == "tristrips")
      return fail(Error{.code = ErrorCode::kUnsupported,
                        .message = "triangle strips in a PLY file are not read"});
    if (element.properties.empty()) return true;  // occupies nothing, however often
    if (auto status = choose_properties(element); !status) return fail(status.error());
    const auto read = read_plain_vertices(element);
    if (!read) return fail(read.error());
    for (std::uint64_t i = *read; i < element.count; ++i) {
      const bool whole = read_one(element);
      if (!whole) return cut_off(element, i);
      if (has_impossible_corner_ && !reading_.notes_damage())
        return syntax_error("face " + std::to_string(i + 1) + " has an impossible vertex number");
      if (auto status = keep(element.name == "vertex"); !status) return fail(status.error());
    }
    return true;
  }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  Status choose_properties(const Element& element) {
    places_.clear();
    std::array<bool, 3> has_axis{};
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    for (const Property& property : element.properties) {
      const bool is_list = property.count_type.has_value();
      int place = kUnused;
      if (is_vertex && !is_list && property.name.size() == 1 && property.name[0] >= 'x' &&
          property.name[0] <= 'z')
        place = property.name[0] - 'x';
      if (is_face && is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
        place = kCorners;
      places_.push_back(place);
      if (place >= 0) has_axis[static_cast<std::size_t>(place)] = true;
    }
    if (is_vertex && !(has_axis[0] && has_axis[1] && has_axis[2]))
      return syntax_error("the vertices of the PLY file have no x, y and z");
    return {};
  }

  /// Vertices whose properties all take the same bytes, as many as the body holds whole, on all
  /// processors; 0 of other elements. What is left is read one by one.
  Result<std::uint64_t> read_plain_vertices(const Element& element) {
    const std::size_t bytes = element.name == "vertex" ? body_.bytes_of_each(element) : 0;
    if (bytes == 0) return 0;
    const std::uint64_t count = std::min<std::uint64_t>(element.count, body_.left() / bytes);
    if (auto status = reading_.take_facets(0, count); !status) return fail(status.error());
    // Some at a time: the list grows by doubling, and what it leaves behind holds what is made of it later.
    constexpr std::uint64_t kOfWork = 8192, kMost = 8 * kOfWork;
    for (std::uint64_t done = 0; done < count; done += kMost) {
      const std::uint64_t some = std::min(count - done, kMost);
      const std::size_t before = mesh_.vertices.size();
      if (before + some > mesh_.vertices.capacity())
        reserve_in_large_pages(mesh_.vertices, before + std::max<std::size_t>(before, some));
      mesh_.vertices.resize(before + some);
      for_each_run(some, kOfWork, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i)
          read_plain_vertex(element, body_.data() + i * bytes, mesh_.vertices[before + i]);
      });
      body_.skip(some * bytes);
    }
    return count;
  }

  void read_plain_vertex(const Element& element, const char* at, std::array<double, 3>& vertex) const {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Type type = element.properties[k].type;
      if (places_[k] >= 0) vertex[static_cast<std::size_t>(places_[k])] = body_.value_of(at, type);
      at += bytes_of(type);
    }
  }

  /// The values of one vertex, face or other; false at the end of the file.
  bool read_one(const Element& element) {
    corners_.clear();
    has_impossible_corner_ = false;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      double value = 0.0;
      if (!property.count_type) {
        if (!body_.take(property.type, value)) return false;
        if (places_[k] >= 0) vertex_[static_cast<std::size_t>(places_[k])] = value;
        continue;
      }
      if (!body_.take(*property.count_type, value)) return false;
      if (!(value >= 0.0 && value <= static_cast<double>(body_.left()))) return false;
      for (auto left = static_cast<std::uint64_t>(value); left > 0; --left) {
        double item = 0.0;
        if (!body_.take(property.type, item)) return false;
        if (places_[k] == kCorners) corners_.push_back(corner_of(item));
      }
    }
    return true;
  }

  std::uint32_t corner_of(double value) {
    if (value >= 0.0 && value < static_cast<double>(kNoVertex) && value == std::floor(value))
      return static_cast<std::uint32_t>(value);
    has_impossible_corner_ = true;
    return kNoVertex;
  }

  /// A polygon becomes a fan.
  Status keep(bool is_vertex) {
    if (is_vertex) mesh_.vertices.push_back(vertex_);
    const std::size_t facets = corners_.size() < 3 ? 0 : corners_.size() - 2;
    for (std::size_t c = 2; c < corners_.size(); ++c)
      mesh_.triangles.push_back({corners_[0], corners_[c - 1], corners_[c]});
    return reading_.take_facets(facets, is_vertex ? 1 : 0);
  }

  Result<bool> cut_off(const Element& element, std::uint64_t index) {
    const std::string place =
        element.name + " " + std::to_string(index + 1) + " of " + std::to_string(element.count);
    if (!reading_.notes_damage())
      return syntax_error("the PLY file is cut off or damaged at " + place);
    reading_.note("ends in the middle of element " + place);
    return false;
  }

  static constexpr int kUnused = -1, kCorners = -2;

  Body body_;
  Reading& reading_;
  TriangleMesh mesh_;
  std::vector<int> places_;  ///< of each property: axis, kCorners or kUnused
  std::array<double, 3> vertex_{};
  std::vector<std::uint32_t> corners_;
  bool has_impossible_corner_ = false;
};

}  // namespace

Result<Bodies> parse_ply(std::string_view content, Reading& reading) {
  const auto header = parse_header(content);
  if (!header) return fail(header.error());
  ElementReader elements(Body(content, header->coding, reading.notes_damage()), reading);
  for (const Element& element : header->elements) {
    const auto whole = elements.read(element);
    if (!whole) return fail(whole.error());
    if (!*whole) break;
  }
  Bodies bodies(1);
  bodies.front().mesh = elements.take();
  return bodies;
}

}  // namespace trueflank::io
