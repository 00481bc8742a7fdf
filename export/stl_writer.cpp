// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/stl_writer.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "trueflank/export/atomic_file.h"

namespace trueflank::io {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is written as it lies in memory");

using Float3 = std::array<float, 3>;

std::vector<Float3> rounded_vertices(const Scene& scene, const Placement& body) {
  const PlacementTransform place(body);
  std::vector<Float3> rounded;
  const auto& vertices = scene.shapes[body.part].mesh->vertices;
  rounded.reserve(vertices.size());
  for (const auto& vertex : vertices) {
    const auto p = place(vertex);
    // + 0: no negative zeros, which readers that weld by bytes take for other points
    rounded.push_back({static_cast<float>(p[0]) + 0.0F, static_cast<float>(p[1]) + 0.0F,
                       static_cast<float>(p[2]) + 0.0F});
  }
  return rounded;
}

Float3 unit_normal(const Float3& a, const Float3& b, const Float3& c) {
  double u[3], v[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = static_cast<double>(b[i]) - a[i];
    v[i] = static_cast<double>(c[i]) - a[i];
  }
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (length == 0.0) return {0.0F, 0.0F, 0.0F};
  return {static_cast<float>(n[0] / length) + 0.0F, static_cast<float>(n[1] / length) + 0.0F,
          static_cast<float>(n[2] / length) + 0.0F};
}

bool is_collapsed(const Float3& a, const Float3& b, const Float3& c) {
  return a == b || b == c || c == a;
}

}  // namespace

Status write_stl(const std::filesystem::path& path, const Scene& scene) {
  std::vector<std::vector<Float3>> vertices;
  std::uint32_t count = 0;
  for (const Placement& body : scene.bodies) {
    vertices.push_back(rounded_vertices(scene, body));
    for (const auto& t : scene.shapes[body.part].mesh->triangles)
      count += is_collapsed(vertices.back()[t[0]], vertices.back()[t[1]], vertices.back()[t[2]]) ? 0 : 1;
  }

  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  // Must not begin with "solid": readers would take the file for text. No time: same bytes each run.
  std::string header = "Trueflank binary STL, millimetres: ";
  header += scene.shapes.size() == 1 ? scene.shapes.front().name : scene.name;
  header.resize(80, '\0');
  file->write(header);
  file->write({reinterpret_cast<const char*>(&count), sizeof count});

  struct Record {
    Float3 normal, a, b, c;
  };
  static_assert(sizeof(Record) == 48);
  std::string& buffer = file->buffer();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& points = vertices[i];
    for (const auto& t : scene.shapes[scene.bodies[i].part].mesh->triangles) {
      Record record{{}, points[t[0]], points[t[1]], points[t[2]]};
      if (is_collapsed(record.a, record.b, record.c)) continue;
      record.normal = unit_normal(record.a, record.b, record.c);
      char bytes[50] = {};
      std::memcpy(bytes, &record, sizeof record);
      buffer.append(bytes, sizeof bytes);
      file->flush_when_full();
    }
  }
  return file->commit();
}

}  // namespace trueflank::io
