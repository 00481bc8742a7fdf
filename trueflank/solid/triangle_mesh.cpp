// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/triangle_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trueflank {

double volume_mm3(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Eigen::Map<const Eigen::Vector3d> origin(mesh.vertices.front().data());
  double six_volumes = 0.0, carry = 0.0;  // compensated: terms of both signs cancel
  for (const auto& t : mesh.triangles) {
    const Eigen::Map<const Eigen::Vector3d> a(mesh.vertices[t[0]].data());
    const Eigen::Map<const Eigen::Vector3d> b(mesh.vertices[t[1]].data());
    const Eigen::Map<const Eigen::Vector3d> c(mesh.vertices[t[2]].data());
    const double term = (a - origin).dot((b - origin).cross(c - origin)) - carry;
    const double sum = six_volumes + term;
    carry = (sum - six_volumes) - term;
    six_volumes = sum;
  }
  return six_volumes / 6.0;
}

}  // namespace trueflank
