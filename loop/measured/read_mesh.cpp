// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "trueflank/export/mesh_reader.h"
#include "trueflank/loop/measured/read_measurement.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

using Point = std::array<double, 3>;

Error broken(const std::string& file, const std::string& what) {
  return {.code = ErrorCode::kSyntax, .message = what, .file = file};
}

/// Long edges give a dozen points each.
constexpr std::size_t kMostPoints = 60'000'000;

Point cross3(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot3(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Points with normals of a triangle mesh: every vertex once for each direction its facets look in.
/// A long narrow facet of a prismatic wall says more than its corners: its long straight edge is
/// sampled too (not the diagonal, which runs inside the curved wall).
class MeshSampler {
 public:
  MeshSampler(const TriangleMesh& surface, ScanData& scan)
      : surface_(surface), scan_(scan), seen_(surface.vertices.size()) {}
  void run() {
    for (const auto& t : surface_.triangles) {
      if (scan_.points_mm.size() > kMostPoints) return;
      const std::array<Point, 3> p{surface_.vertices[t[0]], surface_.vertices[t[1]],
                                   surface_.vertices[t[2]]};
      Point n = cross3(minus(p[1], p[0]), minus(p[2], p[0]));
      const double length = std::sqrt(dot3(n, n));
      if (!(length > 0.0)) continue;
      for (double& c : n) c /= length;
      for (int k = 0; k < 3; ++k) add_vertex(t[k], n);
      sample_long_edge(p, n);
    }
  }

 private:
  void add_vertex(std::uint32_t vertex, const Point& n) {
    for (const Point& before : seen_[vertex])
      if (dot3(before, n) > 0.8) return;
    seen_[vertex].push_back(n);
    add(surface_.vertices[vertex], n);
  }
  void add(const Point& p, const Point& n) {
    if (!is_measured_point(p)) return;
    scan_.points_mm.push_back(p);
    scan_.normals.push_back(
        {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
  }
  void sample_long_edge(const std::array<Point, 3>& p, const Point& n) {
    std::array<std::pair<double, int>, 3> edge;
    for (int k = 0; k < 3; ++k) {
      const Point d = minus(p[(k + 1) % 3], p[k]);
      edge[k] = {std::sqrt(dot3(d, d)), k};
    }
    std::sort(edge.begin(), edge.end());
    if (edge[1].first < 8.0 * edge[0].first) return;
    const Point& a = p[edge[1].second];
    const Point& b = p[(edge[1].second + 1) % 3];
    constexpr int kPlacesOfEdge = 12;
    for (int i = 1; i < kPlacesOfEdge; ++i) {
      const double f = static_cast<double>(i) / kPlacesOfEdge;
      add({a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])}, n);
    }
  }
  const TriangleMesh& surface_;
  ScanData& scan_;
  std::vector<std::vector<Point>> seen_;
};

}  // namespace

Result<ScanData> read_scan_mesh(const std::string& file, std::string_view text,
                                std::vector<std::string>& notes) {
  auto read = io::parse_scan(text, std::filesystem::path(file).extension().string());
  if (!read) {
    Error error = read.error();
    error.file = file;
    return fail(std::move(error));
  }
  for (const std::string& note : read->notes) notes.push_back(file + ": " + note);
  ScanData scan;
  scan.file = file;
  TriangleMesh& surface = read->mesh;
  if (!surface.triangles.empty()) {
    MeshSampler(surface, scan).run();
  } else {
    const std::size_t all = surface.vertices.size();
    scan.points_mm = std::move(surface.vertices);
    std::erase_if(scan.points_mm, [](const Point& p) { return !is_measured_point(p); });
    if (scan.points_mm.size() < all)
      notes.push_back(file + ": " + std::to_string(all - scan.points_mm.size()) +
                      " points without three numbers of a kilometre at most left out");
  }
  if (scan.points_mm.size() > kMostPoints)
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "the scan has more than " +
                                 std::to_string(kMostPoints / 1'000'000) + " million points",
                      .remedy = "a thinned scan: a gear needs some thousand points a tooth",
                      .file = file});
  if (scan.points_mm.empty()) return fail(broken(file, "the scan has no usable point"));
  return scan;
}

}  // namespace trueflank::loop
