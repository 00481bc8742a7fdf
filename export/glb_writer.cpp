// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/glb_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"

namespace trueflank::io {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is written as it lies in memory");

constexpr int kFloatType = 5126, kUnsignedInt = 5125;               // componentType
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;      // bufferView target

std::string json_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out + '"';
}

template <class... Parts>
void append(std::string& text, const Parts&... parts) {
  const auto one = [&](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_integral_v<Part>)
      append_integer(text, static_cast<std::int64_t>(part));
    else if constexpr (std::is_floating_point_v<Part>)
      append_shortest(text, part);
    else
      text += part;
  };
  (one(parts), ...);
}

/// Entries of a JSON array, commas in between.
template <class Count, class Entry>
void append_array(std::string& text, const char* name, Count count, Entry entry) {
  append(text, "\"", name, "\":[");
  for (Count i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    entry(i);
  }
  text += ']';
}

float linear_channel(std::uint8_t srgb) {
  const double c = srgb / 255.0;
  const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return static_cast<float>(std::round(linear * 1e6) * 1e-6);  // a libm's last bit must not show
}

struct Bounds {
  float low[3], high[3];
};

Bounds bounds_of(const TriangleMesh& mesh) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const auto& vertex : mesh.vertices)
    for (int i = 0; i < 3; ++i) {
      bounds.low[i] = std::min(bounds.low[i], static_cast<float>(vertex[i]));
      bounds.high[i] = std::max(bounds.high[i], static_cast<float>(vertex[i]));
    }
  return bounds;
}

/// Accessors and buffer views 2 i (positions) and 2 i + 1 (indices) belong to shape i.
void append_geometry(std::string& json, const Scene& scene, std::size_t& bin_bytes) {
  append_array(json, "accessors", 2 * scene.shapes.size(), [&](std::size_t i) {
    const TriangleMesh& mesh = *scene.shapes[i / 2].mesh;
    if (i % 2 == 1) {
      append(json, "{\"bufferView\":", i, ",\"componentType\":", kUnsignedInt,
             ",\"count\":", 3 * mesh.triangles.size(), ",\"type\":\"SCALAR\"}");
      return;
    }
    const Bounds bounds = bounds_of(mesh);
    append(json, "{\"bufferView\":", i, ",\"componentType\":", kFloatType,
           ",\"count\":", mesh.vertices.size(), ",\"type\":\"VEC3\",");
    append_array(json, "min", 3, [&](int k) { append_shortest(json, bounds.low[k]); });
    json += ',';
    append_array(json, "max", 3, [&](int k) { append_shortest(json, bounds.high[k]); });
    json += '}';
  });
  json += ",\n";
  append_array(json, "bufferViews", 2 * scene.shapes.size(), [&](std::size_t i) {
    const TriangleMesh& mesh = *scene.shapes[i / 2].mesh;
    const std::size_t bytes = 12 * (i % 2 == 0 ? mesh.vertices.size() : mesh.triangles.size());
    append(json, "{\"buffer\":0,\"byteOffset\":", bin_bytes, ",\"byteLength\":", bytes,
           ",\"target\":", i % 2 == 0 ? kVertexBuffer : kIndexBuffer, "}");
    bin_bytes += bytes;
  });
  append(json, ",\n\"buffers\":[{\"byteLength\":", bin_bytes, "}]");
}

void append_shapes(std::string& json, const Scene& scene) {
  append_array(json, "meshes", scene.shapes.size(), [&](std::size_t i) {
    append(json, "{\"name\":", json_quoted(scene.shapes[i].name), ",\"primitives\":[{\"attributes\":{\"POSITION\":",
           2 * i, "},\"indices\":", 2 * i + 1, ",\"material\":", i, ",\"mode\":4}]}");
  });
  json += ",\n";
  append_array(json, "materials", scene.shapes.size(), [&](std::size_t i) {
    const Colour colour = scene.shapes[i].colour;
    append(json, "{\"name\":", json_quoted(scene.shapes[i].name),
           ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[", linear_channel(colour.red), ",",
           linear_channel(colour.green), ",", linear_channel(colour.blue),
           ",1],\"metallicFactor\":0.25,\"roughnessFactor\":0.55}}");
  });
}

/// Node 0 is the root that carries units and axes, node i + 1 is body i.
void append_nodes(std::string& json, const Scene& scene) {
  const double half = std::numbers::sqrt2 / 2;
  append(json, "\"scene\":0,\n\"scenes\":[{\"name\":", json_quoted(scene.name), ",\"nodes\":[0]}],\n");
  append_array(json, "nodes", scene.bodies.size() + 1, [&](std::size_t i) {
    if (i == 0) {
      const std::string name = scene.bodies.size() == 1 ? "millimetres, z up" : "assembly";
      append(json, "{\"name\":", json_quoted(name), ",\"rotation\":[", -half, ",0,0,", half,
             "],\"scale\":[0.001,0.001,0.001],");
      append_array(json, "children", scene.bodies.size(), [&](std::size_t k) { append(json, k + 1); });
      json += '}';
      return;
    }
    const Placement& body = scene.bodies[i - 1];
    append(json, "{\"name\":", json_quoted(body.name), ",\"mesh\":", body.part);
    if (body.rotation_rad != 0.0)
      append(json, ",\"rotation\":[0,0,", std::sin(0.5 * body.rotation_rad), ",",
             std::cos(0.5 * body.rotation_rad), "]");
    const auto& move = body.translation_mm;
    if (move != std::array<double, 3>{})
      append(json, ",\"translation\":[", move[0], ",", move[1], ",", move[2], "]");
    json += '}';
  });
}

void append_word(std::string& bytes, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void append_vertices(AtomicFile& file, const TriangleMesh& mesh) {
  for (const auto& vertex : mesh.vertices) {
    const float p[3] = {static_cast<float>(vertex[0]), static_cast<float>(vertex[1]),
                        static_cast<float>(vertex[2])};
    file.buffer().append(reinterpret_cast<const char*>(p), sizeof p);
    file.flush_when_full();
  }
}

}  // namespace

Status write_glb(const std::filesystem::path& path, const Scene& scene) {
  std::size_t bin_bytes = 0;
  std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Trueflank\"},\n";
  append_nodes(json, scene);
  json += ",\n";
  append_shapes(json, scene);
  json += ",\n";
  append_geometry(json, scene, bin_bytes);
  json += "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');  // chunks are aligned to 4 bytes
  const std::size_t total = 12 + 8 + json.size() + 8 + bin_bytes;
  if (total > std::numeric_limits<std::uint32_t>::max())
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "the file would be larger than the 4 GB a GLB holds"});

  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  std::string head = "glTF";
  append_word(head, 2);
  append_word(head, total);
  append_word(head, json.size());
  head += "JSON";
  head += json;
  append_word(head, bin_bytes);
  head += std::string_view("BIN\0", 4);
  file->write(head);
  for (const SceneShape& shape : scene.shapes) {
    append_vertices(*file, *shape.mesh);
    const auto& triangles = shape.mesh->triangles;
    file->write({reinterpret_cast<const char*>(triangles.data()), 12 * triangles.size()});
  }
  return file->commit();
}

}  // namespace trueflank::io
