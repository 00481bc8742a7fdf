// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::json;
using Matrix = Eigen::Matrix4d;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr std::size_t kTriangles = 4;
// Names, numbers and places of parts: kilobytes in honest files, and 20 times as much when read.
constexpr std::size_t kMostJsonBytes = 32U << 20;
constexpr std::size_t kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;

/// What is wrong in the file, thrown within this source only: JSON is left at any depth.
struct Broken {
  ErrorCode code;
  std::string message, remedy = {};
};
[[noreturn]] void broken(const std::string& message) { throw Broken{ErrorCode::kSyntax, message}; }
[[noreturn]] void unsupported(const std::string& message) {
  throw Broken{ErrorCode::kUnsupported, message};
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (at + sizeof word > bytes.size()) broken("the GLB file is cut off");
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// JSON knows numbers of any size, signs and fractions; a number, count or offset in a file is none of these.
std::size_t whole(const Json& value) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost)
    broken("a number, count or offset of the GLB file is impossible");
  return value.get<std::size_t>();
}

std::size_t index_of(const Json& owner, const char* key) { return whole(owner.at(key)); }

std::size_t index_or(const Json& owner, const char* key, std::size_t otherwise) {
  const auto found = owner.find(key);
  return found == owner.end() ? otherwise : whole(*found);
}

void demand(const Status& status) {
  if (!status) throw Broken{status.error().code, status.error().message, status.error().remedy};
}

/// A run of values in the binary chunk.
struct View {
  const char* data = nullptr;
  std::size_t count = 0, stride = 0;
  std::size_t component = 0;
};

class Reader {
 public:
  Reader(const Json& document, std::string_view bin, Reading& reading)
      : document_(document), bin_(bin), reading_(reading) {}

  Bodies bodies() {
    if (document_.contains("extensionsRequired") && !document_["extensionsRequired"].empty())
      unsupported("the GLB file needs the extension " +
                  document_["extensionsRequired"].at(0).get<std::string>());
    Matrix to_mm = Matrix::Zero();  // metres, y up -> millimetres, z up
    to_mm(0, 0) = 1000.0;
    to_mm(1, 2) = -1000.0;
    to_mm(2, 1) = 1000.0;
    to_mm(3, 3) = 1.0;
    const std::size_t scene = index_or(document_, "scene", 0);
    for (const Json& node : document_.at("scenes").at(scene).value("nodes", Json::array()))
      add_node(whole(node), to_mm, 0);
    return std::move(bodies_);
  }

 private:
  View view_of(std::size_t accessor_index, const char* type, std::size_t components) {
    const Json& accessor = document_.at("accessors").at(accessor_index);
    if (accessor.contains("sparse") || !accessor.contains("bufferView"))
      unsupported("sparse accessors in a GLB file are not read");
    if (accessor.at("type") != type) broken("an accessor of the GLB file has the wrong type");
    View view;
    view.component = index_of(accessor, "componentType");
    view.count = index_of(accessor, "count");
    const std::size_t width = view.component == kUint8 ? 1 : view.component == kUint16 ? 2 : 4;
    const Json& buffer_view = document_.at("bufferViews").at(index_of(accessor, "bufferView"));
    if (index_or(buffer_view, "buffer", 0) != 0) unsupported("GLB files with more than one buffer");
    view.stride = index_or(buffer_view, "byteStride", components * width);
    const std::size_t begin =
        index_or(buffer_view, "byteOffset", 0) + index_or(accessor, "byteOffset", 0);
    if (begin > bin_.size() || view.stride == 0 ||
        view.count > (bin_.size() - begin) / view.stride + 1 ||
        (view.count > 0 &&
         begin + (view.count - 1) * view.stride + components * width > bin_.size()))
      broken("an accessor of the GLB file reaches beyond its buffer: cut off?");
    view.data = bin_.data() + begin;
    return view;
  }

  static std::uint32_t index_at(const View& view, std::size_t i) {
    const char* at = view.data + i * view.stride;
    if (view.component == kUint8) return static_cast<unsigned char>(*at);
    if (view.component == kUint16) {
      std::uint16_t value;
      std::memcpy(&value, at, sizeof value);
      return value;
    }
    if (view.component != kUint32) broken("indices of an impossible type");
    std::uint32_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  struct Primitive {
    View positions, indices;
    bool indexed = false;
    std::size_t count = 0;  ///< of corners
  };

  /// What a primitive has, taken from the budget: nothing of a mesh is read before all of it is.
  Primitive taken(const Json& primitive) {
    demand(reading_.take_piece());
    if (index_or(primitive, "mode", kTriangles) != kTriangles)
      unsupported("only lists of triangles are read from a GLB file");
    Primitive result;
    result.positions = view_of(index_of(primitive.at("attributes"), "POSITION"), "VEC3", 3);
    if (result.positions.component != kFloat) unsupported("GLB positions that are not float");
    result.indexed = primitive.contains("indices");
    if (result.indexed) result.indices = view_of(index_of(primitive, "indices"), "SCALAR", 1);
    result.count = result.indexed ? result.indices.count : result.positions.count;
    demand(reading_.take_facets(result.count / 3, result.positions.count));
    return result;
  }

  static void add(const Primitive& primitive, TriangleMesh& mesh) {
    const View& positions = primitive.positions;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < positions.count; ++i) {
      float p[3];
      std::memcpy(p, positions.data + i * positions.stride, sizeof p);
      mesh.vertices.push_back({p[0], p[1], p[2]});
    }
    const auto corner = [&](std::size_t i) {
      return first +
             (primitive.indexed ? index_at(primitive.indices, i) : static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i + 2 < primitive.count; i += 3)
      mesh.triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
  }

  static Matrix local_matrix(const Json& node) {
    if (node.contains("matrix")) {
      const auto values = node["matrix"].get<std::array<double, 16>>();
      return Eigen::Map<const Matrix>(values.data());  // both column by column
    }
    using Three = std::array<double, 3>;
    const auto move = node.value("translation", Three{0, 0, 0});
    const auto turn = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
    const auto scale = node.value("scale", Three{1, 1, 1});
    Eigen::Affine3d local = Eigen::Affine3d::Identity();
    local.translate(Eigen::Vector3d(move[0], move[1], move[2]));
    local.rotate(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]).normalized());
    local.scale(Eigen::Vector3d(scale[0], scale[1], scale[2]));
    return local.matrix();
  }

  void add_node(std::size_t index, const Matrix& outer, int depth) {
    demand(reading_.take_piece(depth));
    const Json& node = document_.at("nodes").at(index);
    const Matrix global = outer * local_matrix(node);
    if (node.contains("mesh")) {
      const Json& shape = document_.at("meshes").at(index_of(node, "mesh"));
      MeshBody body{node.value("name", shape.value("name", std::string())), {}};
      std::vector<Primitive> primitives;
      for (const Json& primitive : shape.at("primitives")) primitives.push_back(taken(primitive));
      for (const Primitive& primitive : primitives) add(primitive, body.mesh);
      for (auto& v : body.mesh.vertices) {
        const Eigen::Vector4d p = global * Eigen::Vector4d(v[0], v[1], v[2], 1.0);
        v = {p[0], p[1], p[2]};
      }
      if (global.topLeftCorner<3, 3>().determinant() < 0.0)
        for (auto& triangle : body.mesh.triangles) std::swap(triangle[1], triangle[2]);
      bodies_.push_back(std::move(body));
    }
    for (const Json& child : node.value("children", Json::array()))
      add_node(whole(child), global, depth + 1);
  }

  const Json& document_;
  std::string_view bin_;
  Reading& reading_;
  Bodies bodies_;
};

Bodies read(std::string_view content, Reading& reading) {
  if (word_at(content, 4) != 2) unsupported("only version 2 of GLB is read");
  if (word_at(content, 8) > content.size()) broken("the GLB file is cut off");
  std::string_view text, bin;
  for (std::size_t at = 12; at + 8 <= content.size();) {
    const std::size_t length = word_at(content, at);
    const std::uint32_t kind = word_at(content, at + 4);
    if (at + 8 + length > content.size()) broken("the GLB file is cut off");
    if (kind == kJsonChunk) text = content.substr(at + 8, length);
    if (kind == kBinChunk && bin.empty()) bin = content.substr(at + 8, length);
    at += 8 + length;
  }
  if (text.size() > kMostJsonBytes) unsupported("the GLB file describes more parts than are read");
  const Json document = Json::parse(text);
  return Reader(document, bin, reading).bodies();
}

}  // namespace

Result<Bodies> parse_glb(std::string_view content, Reading& reading) {
  try {
    return read(content, reading);
  } catch (const Broken& what) {
    return fail(Error{.code = what.code, .message = what.message, .remedy = what.remedy});
  } catch (const Json::exception& what) {
    return syntax_error(std::string("the GLB file is damaged: ") + what.what());
  }
}

}  // namespace trueflank::io
