// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace trueflank {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

/// From the crossing of one edge to that of the next.
struct Step {
  EdgeKey from, to;
  bool taken = false;
};

}  // namespace

MeshSection mesh_section(const TriangleMesh& mesh, const SectionPlane& plane) {
  const Eigen::Vector3d normal = plane.u.cross(plane.v);
  std::vector<double> height(mesh.vertices.size());
  for (std::size_t i = 0; i < height.size(); ++i)
    height[i] = normal.dot(Eigen::Vector3d(mesh.vertices[i].data()) - plane.origin_mm);

  std::vector<Step> steps;
  std::unordered_map<EdgeKey, std::size_t> step_from;
  for (const auto& t : mesh.triangles) {
    const bool above[] = {height[t[0]] >= 0.0, height[t[1]] >= 0.0, height[t[2]] >= 0.0};
    const int count = above[0] + above[1] + above[2];
    if (count == 0 || count == 3) continue;
    // the corner that is alone on its side
    const int alone = above[0] == above[1] ? 2 : above[0] == above[2] ? 1 : 0;
    EdgeKey from = edge_key(t[alone], t[(alone + 1) % 3]), to = edge_key(t[alone], t[(alone + 2) % 3]);
    if (!above[alone]) std::swap(from, to);
    step_from[from] = steps.size();
    steps.push_back({from, to});
  }

  const auto crossing = [&](EdgeKey key) {
    const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
    const Eigen::Vector3d p(mesh.vertices[a].data()), q(mesh.vertices[b].data());
    const Eigen::Vector3d at = p + (q - p) * (height[a] / (height[a] - height[b])) - plane.origin_mm;
    return Point2(plane.u.dot(at), plane.v.dot(at));
  };
  MeshSection section;
  for (std::size_t first = 0; first < steps.size(); ++first) {
    if (steps[first].taken) continue;
    std::vector<Point2> loop;
    std::size_t i = first;
    bool closed = false;
    while (!steps[i].taken) {
      steps[i].taken = true;
      const Point2 point = crossing(steps[i].from);
      if (loop.empty() || (point - loop.back()).squaredNorm() > 0.0) loop.push_back(point);
      closed = steps[i].to == steps[first].from;
      const auto next = step_from.find(steps[i].to);
      if (closed || next == step_from.end()) break;
      i = next->second;
    }
    if (closed && loop.size() >= 3)
      section.loops.push_back(std::move(loop));
    else if (!closed)
      section.closed = false;
  }
  return section;
}

bool in_material(const MeshSection& section, const Point2& point) {
  bool inside = false;
  for (const auto& loop : section.loops)
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
      if ((loop[i].y() > point.y()) != (loop[j].y() > point.y()) &&
          point.x() < loop[i].x() + (loop[j].x() - loop[i].x()) * (point.y() - loop[i].y()) /
                                        (loop[j].y() - loop[i].y()))
        inside = !inside;
  return inside;
}

}  // namespace trueflank
