// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/obj_writer.h"

#include <algorithm>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"

namespace trueflank::io {

Status write_obj(const std::filesystem::path& path, const Scene& scene) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  file->write("# Trueflank, units: mm\n");

  std::string& text = file->buffer();
  std::int64_t first = 1;
  for (const Placement& body : scene.bodies) {
    std::string name = body.name;
    std::replace(name.begin(), name.end(), ' ', '_');  // many readers end a name at a space
    file->write("o " + name + "\ng " + name + "\n");
    const PlacementTransform place(body);
    const TriangleMesh& mesh = *scene.shapes[body.part].mesh;
    for (const auto& vertex : mesh.vertices) {
      text += 'v';
      for (const double coordinate : place(vertex)) {
        text += ' ';
        append_decimal(text, coordinate);
      }
      text += '\n';
      file->flush_when_full();
    }
    for (const auto& triangle : mesh.triangles) {
      text += 'f';
      for (const std::uint32_t corner : triangle) {
        text += ' ';
        append_integer(text, first + corner);
      }
      text += '\n';
      file->flush_when_full();
    }
    first += static_cast<std::int64_t>(mesh.vertices.size());
  }
  return file->commit();
}

}  // namespace trueflank::io
