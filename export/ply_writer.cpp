// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/ply_writer.h"

#include <bit>
#include <cstring>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"

namespace trueflank::io {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as it lies in memory");

std::string header_text(const Scene& scene, bool coloured) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment Trueflank, units: mm\n";
  for (const Placement& body : scene.bodies) text += "comment body: " + body.name + "\n";
  text += "element vertex ";
  append_integer(text, static_cast<std::int64_t>(vertex_count(scene)));
  text += "\nproperty double x\nproperty double y\nproperty double z\n";
  if (coloured) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face ";
  append_integer(text, static_cast<std::int64_t>(triangle_count(scene)));
  text += "\nproperty list uchar uint vertex_indices\nend_header\n";
  return text;
}

}  // namespace

Status write_ply(const std::filesystem::path& path, const Scene& scene) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  const bool coloured = scene.bodies.size() > 1;
  file->write(header_text(scene, coloured));

  std::string& buffer = file->buffer();
  for (const Placement& body : scene.bodies) {
    const PlacementTransform place(body);
    const Colour colour = scene.shapes[body.part].colour;
    for (const auto& vertex : scene.shapes[body.part].mesh->vertices) {
      const auto p = place(vertex);
      char bytes[27];
      std::memcpy(bytes, p.data(), 24);
      bytes[24] = static_cast<char>(colour.red);
      bytes[25] = static_cast<char>(colour.green);
      bytes[26] = static_cast<char>(colour.blue);
      buffer.append(bytes, coloured ? 27 : 24);
      file->flush_when_full();
    }
  }
  std::uint32_t first = 0;
  for (const Placement& body : scene.bodies) {
    const TriangleMesh& mesh = *scene.shapes[body.part].mesh;
    for (const auto& triangle : mesh.triangles) {
      const std::uint32_t corners[3] = {first + triangle[0], first + triangle[1],
                                        first + triangle[2]};
      char bytes[13];
      bytes[0] = 3;
      std::memcpy(bytes + 1, corners, 12);
      buffer.append(bytes, sizeof bytes);
      file->flush_when_full();
    }
    first += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  return file->commit();
}

}  // namespace trueflank::io
