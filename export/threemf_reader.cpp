// SPDX-License-Identifier: GPL-3.0-or-later
//
// 3MF core specification 1.2 and the production extension's model parts. Materials, slices and what
// else a file may hold are passed over.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <optional>

#include "trueflank/export/known_meshes.h"
#include "trueflank/export/mesh_parsers.h"
#include "trueflank/export/xml_scanner.h"
#include "trueflank/export/packed/zip_archive.h"

namespace trueflank::io {
namespace {

/// Rows: images of x, y, z and the origin; a point is a row vector.
using Transform = std::array<double, 12>;
constexpr Transform kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

std::array<double, 3> transformed(const Transform& m, const std::array<double, 3>& p) {
  std::array<double, 3> q{};
  for (int c = 0; c < 3; ++c) q[c] = p[0] * m[c] + p[1] * m[3 + c] + p[2] * m[6 + c] + m[9 + c];
  return q;
}

/// First `inner`, then `outer`.
Transform combined(const Transform& inner, const Transform& outer) {
  Transform result{};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 3; ++c) {
      double sum = r == 3 ? outer[9 + c] : 0.0;
      for (int k = 0; k < 3; ++k) sum += inner[3 * r + k] * outer[3 * k + c];
      result[3 * r + c] = sum;
    }
  return result;
}

bool mirrors(const Transform& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
             m[2] * (m[3] * m[7] - m[4] * m[6]) < 0.0;
}

struct Reference {
  int object = 0;
  std::string model;  ///< part of the package; empty: the same
  Transform transform = kIdentity;
};
struct Object {
  std::string name;
  bool is_support = false;
  TriangleMesh mesh;
  std::vector<Reference> components;
};
struct Model {
  double unit_mm = 1.0;
  std::map<int, Object> objects;
  std::vector<Reference> build;
};

std::optional<double> unit_mm(std::string_view unit) {
  if (unit == "millimeter") return 1.0;
  if (unit == "micron") return 1e-3;
  if (unit == "centimeter") return 10.0;
  if (unit == "inch") return 25.4;
  if (unit == "foot") return 304.8;
  if (unit == "meter") return 1000.0;
  return std::nullopt;
}

bool number_attribute(const XmlScanner::Tag& tag, std::string_view name, double& value) {
  auto text = tag.attribute(name);
  return text && take_number(*text, value);
}

template <class Integer>
bool integer_attribute(const XmlScanner::Tag& tag, std::string_view name, Integer& value) {
  const auto text = tag.attribute(name);
  return text &&
         std::from_chars(text->data(), text->data() + text->size(), value).ec == std::errc();
}

Result<Reference> reference_of(const XmlScanner::Tag& tag) {
  Reference reference;
  if (!integer_attribute(tag, "objectid", reference.object))
    return syntax_error("<" + std::string(tag.name) + "> without a valid objectid");
  reference.model = tag.text_attribute("path");
  if (auto text = tag.attribute("transform"))
    for (double& value : reference.transform)
      if (!take_number(*text, value)) return syntax_error("a transform without twelve numbers");
  return reference;
}

// Always inline: six calls for every facet, and compilers judge otherwise with every source they see beside this one.
TRUEFLANK_ALWAYS_INLINE inline bool take_plain(const char*& at, const char* end, double& value) {
  if (take_short_decimal(at, end, value)) return true;
  std::string_view text(at, static_cast<std::size_t>(end - at));
  if (!take_number(text, value)) return false;
  at = text.data();
  return true;
}
TRUEFLANK_ALWAYS_INLINE inline bool take_plain(const char*& at, const char* end, std::uint32_t& value) {
  constexpr std::ptrdiff_t kShort = 9;  // as many digits fit into the value whatever they are
  const char* digits = at;
  std::uint32_t sum = 0;
  for (; digits != end && *digits >= '0' && *digits <= '9' && digits - at < kShort; ++digits)
    sum = 10 * sum + static_cast<std::uint32_t>(*digits - '0');
  if (digits - at < kShort) {
    if (digits == at) return false;
    at = digits;
    value = sum;
    return true;
  }
  const auto result = std::from_chars(at, end, value);
  at = result.ptr;
  return result.ec == std::errc();
}
template <std::size_t kSize>
TRUEFLANK_ALWAYS_INLINE inline bool take_plain(const char*& at, const char* end, const char (&word)[kSize]) {
  constexpr std::ptrdiff_t kLength = kSize - 1;
  if (end - at < kLength || std::memcmp(at, word, kLength) != 0) return false;
  at += kLength;
  return true;
}

/// Behind the last number of a plain tag: its end, with whatever else programs say of every facet (colours).
/// The scanner judges all unusual ends.
bool take_plain_end(const char*& at, const char* end) {
  if (take_plain(at, end, "\"/>")) return true;
  const std::string_view rest(at, static_cast<std::size_t>(end - at));
  const std::size_t close = rest.find('>');
  if (rest.empty() || rest.front() != '"' || close == rest.npos || rest[close - 1] != '/' ||
      rest.substr(0, close).find_first_of("<\'") != rest.npos ||
      std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(close), '"') % 2 == 0)
    return false;
  at += close + 1;
  return true;
}

/// An empty element whose first three attributes are these in this order; `from` is left as it was where
/// something else stands there.
template <class Number, std::size_t kFirst, std::size_t kSecond, std::size_t kThird>
bool take_plain_tag(const char*& from, const char* end, const char (&first)[kFirst],
                    const char (&second)[kSecond], const char (&third)[kThird],
                    std::array<Number, 3>& values) {
  const char* at = from;
  while (at != end && (*at == '\n' || *at == ' ' || *at == '\t' || *at == '\r')) ++at;
  if (!take_plain(at, end, first) || !take_plain(at, end, values[0]) ||
      !take_plain(at, end, second) || !take_plain(at, end, values[1]) ||
      !take_plain(at, end, third) || !take_plain(at, end, values[2]) || !take_plain_end(at, end))
    return false;
  from = at;
  return true;
}

/// Fills a model tag by tag.
class ModelParser {
 public:
  explicit ModelParser(Reading& reading) : reading_(reading) {}

  [[nodiscard]] Status take(const XmlScanner::Tag& tag) {
    if (tag.name == "vertex" && tag.is_start) return take_vertex(tag);
    if (tag.name == "triangle" && tag.is_start) return take_triangle(tag);
    if (tag.name == "object") return tag.is_start ? take_object(tag) : Status{};
    if (tag.name == "model" && tag.is_start) {
      seen_ = true;
      const auto unit = unit_mm(tag.attribute("unit").value_or("millimeter"));
      if (!unit) return syntax_error("unknown unit '" + tag.text_attribute("unit") + "'");
      model_.unit_mm = *unit;
    } else if ((tag.name == "component" || tag.name == "item") && tag.is_start) {
      auto reference = reference_of(tag);
      if (!reference) return fail(reference.error());
      if (tag.name == "item") model_.build.push_back(std::move(*reference));
      else if (object_) object_->components.push_back(std::move(*reference));
    }
    return {};
  }
  /// Takes the vertices or triangles at the front that are written as most programs do; the scanner
  /// reads them eight times as slowly. Stops at whatever looks different.
  [[nodiscard]] Status take_plain(std::string_view& text) {
    if (!object_) return {};
    TriangleMesh& mesh = object_->mesh;
    make_room(text, "<vertex ", "</vertices>", mesh.vertices);
    const char *at = text.data(), *const end = at + text.size();
    std::array<double, 3> v{};
    while (take_plain_tag(at, end, "<vertex x=\"", "\" y=\"", "\" z=\"", v))
      if (auto status = add(v); !status) return status;
    text.remove_prefix(static_cast<std::size_t>(at - text.data()));
    make_room(text, "<triangle ", "</triangles>", mesh.triangles);
    std::array<std::uint32_t, 3> t{};
    while (take_plain_tag(at, end, "<triangle v1=\"", "\" v2=\"", "\" v3=\"", t))
      if (auto status = add(t); !status) return status;
    text.remove_prefix(static_cast<std::size_t>(at - text.data()));
    return {};
  }
  /// A piece of text begins, between tags.
  void begin_piece() { searched_to_ = nullptr; }
  /// Whether an object is open that has no mesh yet.
  [[nodiscard]] bool is_at_mesh() const {
    return object_ && object_->mesh.vertices.empty() && object_->mesh.triangles.empty();
  }
  [[nodiscard]] const TriangleMesh& mesh() const { return object_->mesh; }
  /// The open object's mesh, read before.
  [[nodiscard]] Status take(const TriangleMesh& mesh) {
    if (auto status = reading_.take_facets(mesh.triangles.size(), mesh.vertices.size()); !status)
      return status;
    object_->mesh = mesh;
    return {};
  }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] Model finish() { return std::move(model_); }

 private:
  /// For all there are before the list's end, so that the list need not grow and be copied again. No part
  /// of the text is searched twice.
  template <class List>
  void make_room(std::string_view text, std::string_view first, std::string_view end, List& list) {
    constexpr std::size_t kLeastBytes = 36;
    if (text.data() < searched_to_) return;
    if (!text.starts_with(first) && !(text.starts_with('\n') && text.substr(1).starts_with(first))) return;
    const std::size_t at = std::min(text.find(end), text.size());
    searched_to_ = text.data() + at;
    list.reserve(std::min(list.size() + at / kLeastBytes, kMostFacets));
  }
  Status add(const std::array<double, 3>& vertex) {
    if (auto status = reading_.take_facets(0, 1); !status) return status;
    object_->mesh.vertices.push_back(vertex);
    return {};
  }
  Status add(const std::array<std::uint32_t, 3>& triangle) {
    if (auto status = reading_.take_facets(1, 0); !status) return status;
    object_->mesh.triangles.push_back(triangle);
    return {};
  }
  Status take_vertex(const XmlScanner::Tag& tag) {
    std::array<double, 3> v{};
    if (!number_attribute(tag, "x", v[0]) || !number_attribute(tag, "y", v[1]) ||
        !number_attribute(tag, "z", v[2]))
      return syntax_error("a vertex without three numbers");
    return object_ ? add(v) : Status{};
  }
  Status take_triangle(const XmlScanner::Tag& tag) {
    std::array<std::uint32_t, 3> t{};
    if (!integer_attribute(tag, "v1", t[0]) || !integer_attribute(tag, "v2", t[1]) ||
        !integer_attribute(tag, "v3", t[2]))
      return syntax_error("a triangle without three vertex numbers");
    return object_ ? add(t) : Status{};
  }
  Status take_object(const XmlScanner::Tag& tag) {
    int id = 0;
    if (!integer_attribute(tag, "id", id)) return syntax_error("an object without a valid id");
    const auto [at, is_new] = model_.objects.try_emplace(id);
    if (!is_new) return syntax_error("two objects with the id " + std::to_string(id));
    object_ = &at->second;
    object_->name = tag.text_attribute("name");
    const auto type = tag.attribute("type").value_or("model");
    object_->is_support = type == "support" || type == "solidsupport";
    return {};
  }

  Reading& reading_;
  Model model_;
  Object* object_ = nullptr;
  const char* searched_to_ = nullptr;
  bool seen_ = false;
};

tl::unexpected<Error> broken_model() {
  return syntax_error("the 3MF model is no valid XML, or cut off");
}

/// Tags from the first to the last of a text that is cut between tags.
Status parse_text(std::string_view text, ModelParser& parser) {
  XmlScanner scanner(text);
  XmlScanner::Tag tag;
  parser.begin_piece();
  while (scanner.next(tag)) {
    if (auto status = parser.take(tag); !status) return status;
    if (auto status = parser.take_plain(scanner.rest()); !status) return status;
  }
  return scanner.is_broken() ? broken_model() : Status{};
}

Result<Model> parse_model(std::string_view text, Reading& reading) {
  ModelParser parser(reading);
  if (auto status = parse_text(text, parser); !status) return fail(status.error());
  if (!parser.seen()) return broken_model();
  return parser.finish();
}

/// A mesh among the pieces is what an open object holds, and all of it.
Result<Model> parse_model(const std::vector<ContentPiece>& pieces, Reading& reading) {
  ModelParser parser(reading);
  for (const ContentPiece& piece : pieces) {
    if (piece.mesh != nullptr && !parser.is_at_mesh()) return broken_model();
    const bool is_read = piece.mesh != nullptr && piece.mesh->read;
    if (auto status = is_read ? parser.take(piece.mesh->mesh) : parse_text(piece.text, parser);
        !status)
      return fail(status.error());
    if (piece.mesh == nullptr || is_read) continue;
    piece.mesh->mesh = parser.mesh();
    piece.mesh->read = true;
  }
  if (!parser.seen()) return broken_model();
  return parser.finish();
}

/// The models of a package, read when they are asked for.
class Package {
 public:
  Package(std::string_view archive, Reading& reading) : archive_(archive), reading_(reading) {}

  [[nodiscard]] Result<std::string> root_name() const {
    const auto names = zip_names(archive_);
    if (!names) return fail(names.error());
    if (const auto relationships = zip_content(archive_, "_rels/.rels", reading_)) {
      XmlScanner scanner(*relationships);
      for (XmlScanner::Tag tag; scanner.next(tag);)
        if (tag.name == "Relationship" &&
            tag.text_attribute("Type").find("/3dmodel") != std::string::npos)
          return tag.text_attribute("Target");
    }
    for (const std::string& name : *names)
      if (name.ends_with(".model")) return name;
    return syntax_error("the archive holds no 3MF model");
  }

  [[nodiscard]] Result<const Model*> model(const std::string& name) {
    const std::string entry = name.starts_with('/') ? name.substr(1) : name;
    if (const auto known = models_.find(entry); known != models_.end()) return &known->second;
    if (const auto pieces = zip_pieces(archive_, entry, reading_))
      if (auto parsed = parse_model(*pieces, reading_))
        return &models_.emplace(entry, std::move(*parsed)).first->second;
    const auto text = zip_content(archive_, entry, reading_);
    if (!text) return fail(text.error());
    auto parsed = parse_model(*text, reading_);
    if (!parsed) return fail(parsed.error());
    return &models_.emplace(entry, std::move(*parsed)).first->second;
  }

 private:
  std::string_view archive_;
  Reading& reading_;
  std::map<std::string, Model> models_;
};

/// Places the objects that the build names, components and all.
class Builder {
 public:
  Builder(Package& package, Reading& reading) : package_(package), reading_(reading) {}

  /// `name`: of the object above, kept where it has but this one component.
  [[nodiscard]] Status add(const std::string& model_name, const Reference& reference,
                           const Transform& outer, const std::string& name, int depth) {
    // components of components of ... multiply
    if (auto status = reading_.take_piece(depth); !status) return status;
    const std::string& where = reference.model.empty() ? model_name : reference.model;
    const auto model = package_.model(where);
    if (!model) return fail(model.error());
    const auto found = (*model)->objects.find(reference.object);
    if (found == (*model)->objects.end())
      return syntax_error("object " + std::to_string(reference.object) + " does not exist");
    const Object& object = found->second;
    if (object.is_support) return {};
    const Transform transform = combined(reference.transform, outer);
    const std::string& shown = name.empty() ? object.name : name;
    if (!object.mesh.triangles.empty()) {
      const TriangleMesh& mesh = object.mesh;
      if (auto status = reading_.take_facets(mesh.triangles.size(), mesh.vertices.size()); !status)
        return status;
      add_mesh(mesh, transform, shown);
    }
    for (const Reference& component : object.components) {
      const bool alone = object.components.size() == 1;
      if (auto status = add(where, component, transform, alone ? shown : std::string(), depth + 1);
          !status)
        return status;
    }
    return {};
  }
  [[nodiscard]] Bodies take() { return std::move(bodies_); }

 private:
  void add_mesh(const TriangleMesh& mesh, const Transform& transform, const std::string& name) {
    MeshBody body{name, mesh};
    if (transform != kIdentity)
      for (auto& vertex : body.mesh.vertices) vertex = transformed(transform, vertex);
    if (mirrors(transform))
      for (auto& triangle : body.mesh.triangles) std::swap(triangle[1], triangle[2]);
    bodies_.push_back(std::move(body));
  }

  Package& package_;
  Reading& reading_;
  Bodies bodies_;
};

}  // namespace

Result<Bodies> parse_3mf(std::string_view content, Reading& reading) {
  Package package(content, reading);
  const auto root_name = package.root_name();
  if (!root_name) return fail(root_name.error());
  const auto root = package.model(*root_name);
  if (!root) return fail(root.error());
  const double s = (*root)->unit_mm;
  const Transform to_mm = {s, 0, 0, 0, s, 0, 0, 0, s, 0, 0, 0};
  Builder builder(package, reading);
  for (const Reference& item : (*root)->build)
    if (auto status = builder.add(*root_name, item, to_mm, {}, 0); !status)
      return fail(status.error());
  Bodies bodies = builder.take();
  if (bodies.empty()) return syntax_error("the 3MF file builds no object");
  return bodies;
}

}  // namespace trueflank::io
