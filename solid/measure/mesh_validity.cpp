// SPDX-License-Identifier: GPL-3.0-or-later
//
// Half-edges are bucketed by the vertex they start from; the partner of a half-edge is looked for among
// the few that start from its end.
#include "trueflank/solid/measure/mesh_validity.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace trueflank {
namespace {

struct HalfEdge {
  std::uint32_t end;       ///< vertex it runs to
  std::uint32_t opposite;  ///< third vertex of its triangle
};

/// Half-edges that start from each vertex, in the order of the vertices they run to: a fan of a million facets,
/// or one facet a million times, takes no square of time.
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
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      std::sort(at(v), at(v + 1), [](const HalfEdge& a, const HalfEdge& b) { return a.end < b.end; });
  }
  /// Those that run to a vertex.
  [[nodiscard]] std::span<const HalfEdge> between(std::uint32_t from, std::uint32_t to) const {
    const auto first = std::lower_bound(at(from), at(from + 1), to,
                                        [](const HalfEdge& e, std::uint32_t v) { return e.end < v; });
    auto last = first;
    while (last != at(from + 1) && last->end == to) ++last;
    return {first, last};
  }

 private:
  [[nodiscard]] std::vector<HalfEdge>::iterator at(std::size_t vertex) {
    return edges.begin() + static_cast<std::ptrdiff_t>(begin[vertex]);
  }
  [[nodiscard]] std::vector<HalfEdge>::const_iterator at(std::size_t vertex) const {
    return edges.begin() + static_cast<std::ptrdiff_t>(begin[vertex]);
  }
};

/// True where the triangles around a vertex form one closed fan.
bool is_one_fan(const VertexStars& stars, std::uint32_t vertex) {
  const std::size_t begin = stars.begin[vertex], end = stars.begin[vertex + 1];
  std::uint32_t at = stars.edges[begin].end;
  std::size_t walked = 0;
  for (; walked < end - begin; ++walked) {
    // the triangle (vertex, at, opposite) is followed by that which starts with opposite
    const auto next = stars.between(vertex, at);
    if (next.empty()) return false;
    at = next.front().opposite;
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
    for (std::size_t i = stars.begin[v]; i < stars.begin[v + 1];) {
      const std::uint32_t end = stars.edges[i].end;
      const std::size_t alike = stars.between(v, end).size();
      if (alike > 1) validity.misoriented_edges += alike, regular = false;
      if (stars.between(end, v).empty()) validity.open_edges += alike, regular = false;
      i += alike;
    }
    if (regular && !is_one_fan(stars, v)) ++validity.non_manifold_vertices;
  }
  check_triangles(mesh, validity);
  validity.components = count_components(mesh);
  validity.volume_mm3 = volume_mm3(mesh);
  return validity;
}

}  // namespace trueflank
