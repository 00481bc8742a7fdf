// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/pictured_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace trueflank::io {
namespace {

constexpr float kCreaseCosine = 0.88F;  // facets that meet in more than 28 degrees have an edge

Eigen::Vector3d vertex(const TriangleMesh& mesh, std::uint32_t index) {
  const auto& v = mesh.vertices[index];
  return {v[0], v[1], v[2]};
}

/// A corner of a facet and the angle there, by which its normal counts.
struct Corner {
  std::uint32_t triangle = 0;
  float angle_rad = 0.0F;
};

}  // namespace

PicturedMesh pictured_mesh(TriangleMesh mesh) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Eigen::Vector3f> facet(count);
  std::vector<std::uint32_t> first(mesh.vertices.size() + 1, 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) ++first[v + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<Corner> corners(3 * count);
  std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < count; ++t) {
    const auto& triangle = mesh.triangles[t];
    const std::array<Eigen::Vector3d, 3> p{vertex(mesh, triangle[0]), vertex(mesh, triangle[1]),
                                           vertex(mesh, triangle[2])};
    facet[t] = (p[1] - p[0]).cross(p[2] - p[0]).normalized().cast<float>();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
      corners[filled[triangle[k]]++] = {
          static_cast<std::uint32_t>(t),
          static_cast<float>(std::atan2(u.cross(w).norm(), u.dot(w)))};
    }
  }
  PicturedMesh result{.mesh = std::move(mesh), .normals = {}};
  result.normals.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = result.mesh.triangles[t][k];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::uint32_t c = first[v]; c < first[v + 1]; ++c)
        if (const Eigen::Vector3f& n = facet[corners[c].triangle]; n.dot(facet[t]) > kCreaseCosine)
          sum += corners[c].angle_rad * n;
      const float length = sum.norm();
      result.normals[t][k] = length > 0.0F ? Eigen::Vector3f(sum / length) : facet[t];
    }
  return result;
}

}  // namespace trueflank::io
