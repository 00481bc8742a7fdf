// SPDX-License-Identifier: GPL-3.0-or-later
//
// Half-edges are bucketed by the vertex they start from; the partner of a half-edge is looked for among
// the few that start from its end.
#include "trueflank/solid/mesh_validity.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trueflank {
namespace {

struct HalfEdge {
  std::uint32_t end;       ///< vertex it runs to
  std::uint32_t opposite;  ///< third vertex of its triangle
};

/// Half-edges that start from each vertex.
struct VertexStars {
  std::vector<std::size_t> begin;  ///< of vertex v: [begin[v], begin[v + 1])
  std::vector<HalfEdge> edges;

  explicit VertexStars(const TriangleMesh& mesh) : begin(mesh.vertices.size() + 1, 0) {
    for (const auto& t : mesh.triangles)
      for (std::uint32_t v : t) ++begin[v + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    edges.resize(3 * mesh.triangles.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const auto& t : mesh.triangles)
      for (std::size_t e = 0; e < 3; ++e)
        edges[next[t[e]]++] = {t[(e + 1) % 3], t[(e + 2) % 3]};
  }
  [[nodiscard]] std::size_t count(std::uint32_t from, std::uint32_t to) const {
    std::size_t n = 0;
    for (std::size_t i = begin[from]; i < begin[from + 1]; ++i) n += edges[i].end == to ? 1 : 0;
    return n;
  }
};

/// True where the triangles around a vertex form one closed fan.
bool is_one_fan(const VertexStars& stars, std::uint32_t vertex) {
  const std::size_t begin = stars.begin[vertex], end = stars.begin[vertex + 1];
  std::uint32_t at = stars.edges[begin].end;
  std::size_t walked = 0;
  for (; walked < end - begin; ++walked) {
    // the triangle (vertex, at, opposite) is followed by that which starts with opposite
    std::size_t i = begin;
    while (i < end && stars.edges[i].end != at) ++i;
    if (i == end) return false;
    at = stars.edges[i].opposite;
    if (at == stars.edges[begin].end) break;
  }
  return walked + 1 == end - begin;
}

void check_triangles(const TriangleMesh& mesh, MeshValidity& validity) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Eigen::Map<const Eigen::Vector3d> a(mesh.vertices[t[0]].data());
    const Eigen::Map<const Eigen::Vector3d> b(mesh.vertices[t[1]].data());
    const Eigen::Map<const Eigen::Vector3d> c(mesh.vertices[t[2]].data());
    const double longest = std::sqrt(
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    const double twice_area = (b - a).cross(c - a).norm();
    if (!(twice_area > 0.0)) ++validity.degenerate_triangles;
    smallest = std::min(smallest, longest > 0.0 ? twice_area / longest : 0.0);
  }
  validity.smallest_altitude_mm = mesh.triangles.empty() ? 0.0 : smallest;
}

std::size_t count_components(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t e = 1; e < 3; ++e) root[find(t[e])] = find(t[0]);
  std::vector<bool> used(mesh.vertices.size(), false);
  std::size_t components = 0;
  for (const auto& t : mesh.triangles) {
    const std::uint32_t r = find(t[0]);
    if (!used[r]) ++components;
    used[r] = true;
  }
  return components;
}

}  // namespace

MeshValidity mesh_validity(const TriangleMesh& mesh) {
  MeshValidity validity;
  for (const auto& t : mesh.triangles)
    for (std::uint32_t v : t)
      if (v >= mesh.vertices.size()) validity.indices_in_range = false;
  for (const auto& v : mesh.vertices)
    for (double x : v)
      if (!std::isfinite(x)) validity.coordinates_finite = false;
  if (!validity.indices_in_range || !validity.coordinates_finite) return validity;

  const VertexStars stars(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (stars.begin[v] == stars.begin[v + 1]) {
      ++validity.unused_vertices;
      continue;
    }
    bool regular = true;
    for (std::size_t i = stars.begin[v]; i < stars.begin[v + 1]; ++i) {
      const std::uint32_t end = stars.edges[i].end;
      if (stars.count(v, end) > 1) ++validity.misoriented_edges, regular = false;
      if (stars.count(end, v) == 0) ++validity.open_edges, regular = false;
    }
    if (regular && !is_one_fan(stars, v)) ++validity.non_manifold_vertices;
  }
  check_triangles(mesh, validity);
  validity.components = count_components(mesh);
  validity.volume_mm3 = volume_mm3(mesh);
  return validity;
}

}  // namespace trueflank
