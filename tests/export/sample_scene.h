// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tests/support/scratch_folder.h"
#include "trueflank/base/units.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/scene.h"

// Meshes made by hand for the tests of files: their volumes are known in closed form.
namespace trueflank::test {

/// A prism on a star of 2 `points` corners with a polygonal bore of as many corners: closed, with
/// coordinates that no float holds. Lower face at z = 0.
[[nodiscard]] inline TriangleMesh star_prism(int points, double outer_mm, double inner_mm,
                                             double bore_mm, double height_mm) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(2 * points);
  for (const double z : {0.0, height_mm})
    for (const bool bore : {false, true})
      for (std::uint32_t i = 0; i < n; ++i) {
        const double r = bore ? bore_mm : i % 2 == 0 ? outer_mm : inner_mm;
        mesh.vertices.push_back({r * std::cos(kTwoPi * i / n), r * std::sin(kTwoPi * i / n), z});
      }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    quad(i, j, 2 * n + j, 2 * n + i);                          // outer wall
    quad(n + j, n + i, 3 * n + i, 3 * n + j);                  // bore
    quad(2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i);          // top
    quad(j, i, n + i, n + j);                                  // bottom
  }
  return mesh;
}

/// Area of a star: 2 n triangles with sides a, b and the angle pi / n between them; times height.
[[nodiscard]] inline double star_prism_volume_mm3(int points, double outer_mm, double inner_mm,
                                                  double bore_mm, double height_mm) {
  return points * std::sin(kPi / points) * (outer_mm * inner_mm - bore_mm * bore_mm) * height_mm;
}

/// Signed volume of a mesh, summed here so that the tests need no kernel.
[[nodiscard]] inline double summed_volume_mm3(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6.0;
}

/// Every edge once in each direction.
[[nodiscard]] inline bool is_closed(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      if (!edges.emplace(t[i], t[(i + 1) % 3]).second) return false;
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) return false;
  return true;
}

/// Farthest distance of corresponding vertices of two meshes with the same triangles in the same
/// order; infinity where they do not correspond.
[[nodiscard]] inline double farthest_corner_mm(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return INFINITY;
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto &p = a.vertices[a.triangles[i][k]], &q = b.vertices[b.triangles[i][k]];
      farthest = std::max(farthest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
  return farthest;
}

/// A small planetary set: shapes sun and planet, bodies "sun", "planet 1", "planet 2", turned and
/// moved. The meshes live as long as this.
struct SampleScene {
  TriangleMesh sun = star_prism(11, 7.3, 5.1, 2.05, 10.0);
  TriangleMesh planet = star_prism(17, 12.1, 10.2, 3.3, 8.4);
  double sun_volume_mm3 = star_prism_volume_mm3(11, 7.3, 5.1, 2.05, 10.0);
  double planet_volume_mm3 = star_prism_volume_mm3(17, 12.1, 10.2, 3.3, 8.4);

  [[nodiscard]] io::Scene part() const { return io::part_scene("sample", "sun", sun); }
  [[nodiscard]] io::Scene assembly() const {
    return {.name = "sample <&\"set\">",
            .shapes = {{"sun", &sun, {0xE6, 0xA8, 0x2E}}, {"planet", &planet, {0x10, 0x80, 0xC4}}},
            .bodies = {{.part = 0, .name = "sun", .rotation_rad = 0.3},
                       {.part = 1, .name = "planet 1", .rotation_rad = -1.1,
                        .translation_mm = {20.25, 0.0, 0.5}},
                       {.part = 1, .name = "planet 2", .rotation_rad = 2.0,
                        .translation_mm = {-10.0, 17.5, 0.5}}}};
  }
};

}  // namespace trueflank::test
