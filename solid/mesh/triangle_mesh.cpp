// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/triangle_mesh.h"

#include "trueflank/solid/mesh/enclosed_volume.h"


namespace trueflank {

double volume_mm3(const TriangleMesh& mesh) {
  EnclosedVolume volume;
  for (const auto& t : mesh.triangles)
    volume.add(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  return volume.mm3();
}

}  // namespace trueflank
