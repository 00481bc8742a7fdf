// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/mesh_slicing.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace trueflank::loop {
namespace {

constexpr double kOnPlane_mm = 1e-7;

/// Cuts all triangles at one height.
void slice(TriangleMesh& mesh, double z) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts;
  const auto side = [&](std::uint32_t v) {
    const double d = mesh.vertices[v][2] - z;
    return std::abs(d) < kOnPlane_mm ? 0 : d > 0.0 ? 1 : -1;
  };
  const auto cut = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto found = cuts.find(key);
    if (found != cuts.end()) return found->second;
    const auto p = mesh.vertices[key.first], q = mesh.vertices[key.second];
    const double t = (z - p[2]) / (q[2] - p[2]);
    const auto index = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), z});
    cuts.emplace(key, index);
    return index;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    // The corners in order with the cuts between them, split into what lies above and below.
    std::vector<std::uint32_t> above, below;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if (side(a) >= 0) above.push_back(a);
      if (side(a) <= 0) below.push_back(a);
      if (side(a) * side(b) < 0) {
        const std::uint32_t c = cut(a, b);
        above.push_back(c);
        below.push_back(c);
      }
    }
    const bool crosses = std::any_of(triangle.begin(), triangle.end(), [&](auto v) { return side(v) > 0; }) &&
                         std::any_of(triangle.begin(), triangle.end(), [&](auto v) { return side(v) < 0; });
    if (!crosses) {
      triangles.push_back(triangle);
      continue;
    }
    for (const auto* polygon : {&above, &below})
      for (std::size_t k = 2; k < polygon->size(); ++k)
        triangles.push_back({(*polygon)[0], (*polygon)[k - 1], (*polygon)[k]});
  }
  mesh.triangles = std::move(triangles);
}

}  // namespace

TriangleMesh sliced(const TriangleMesh& mesh, const std::vector<double>& heights_mm) {
  TriangleMesh result = mesh;
  for (const double z : heights_mm) slice(result, z);
  return result;
}

}  // namespace trueflank::loop
