// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/facet_comparison.h"

#include <algorithm>
#include <cmath>

namespace trueflank::io {
namespace {

using Point = std::array<double, 3>;

constexpr double kSureStep_mm2 = 16.0 * kTextStep_mm * kTextStep_mm;  // no facet's step is less

Point difference(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }

double squared_mm2(const Point& p, const Point& q) {
  const Point d = difference(p, q);
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

double largest_coordinate_mm(const Point& p) {
  return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
}

}  // namespace

void FacetComparison::take(const Facet& facet) {
  add_volume(facet);
  ++facets_;
  while (!differs_) {
    const auto* triangle = expected();
    if (triangle == nullptr) {
      differs_ = true;
      return;
    }
    double moved_mm2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      moved_mm2 = std::max(moved_mm2, squared_mm2(placed_[(*triangle)[k]], facet[k]));
    ++next_;
    if (moved_mm2 <= kSureStep_mm2 || moved_mm2 <= std::pow(2.0 * largest_step_mm(*triangle), 2)) {
      farthest_mm_ = std::max(farthest_mm_, std::sqrt(moved_mm2));
      return;
    }
    differs_ = !may_be_missing(*triangle);
  }
}

std::optional<double> FacetComparison::rounding_mm() {
  while (!differs_) {
    const auto* triangle = expected();
    if (triangle == nullptr) return farthest_mm_;
    ++next_;
    differs_ = !may_be_missing(*triangle);
  }
  return std::nullopt;
}

const std::array<std::uint32_t, 3>* FacetComparison::expected() {
  for (; body_ < scene_.bodies.size(); ++body_, next_ = 0) {
    const Placement& body = scene_.bodies[body_];
    const TriangleMesh& mesh = *scene_.shapes[static_cast<std::size_t>(body.part)].mesh;
    if (next_ == mesh.triangles.size()) continue;
    if (placed_body_ != body_) {
      const PlacementTransform place(body);
      placed_.clear();
      placed_.reserve(mesh.vertices.size());
      for (const auto& vertex : mesh.vertices) placed_.push_back(place(vertex));
      placed_body_ = body_;
    }
    return &mesh.triangles[next_];
  }
  return nullptr;
}

/// The larger of both kinds of file.
double FacetComparison::largest_step_mm(const std::array<std::uint32_t, 3>& triangle) const {
  // Some formats round in the assembly's frame, some in the part's, whose origin may be far.
  const Placement& body = scene_.bodies[body_];
  const auto& vertices = scene_.shapes[static_cast<std::size_t>(body.part)].mesh->vertices;
  double reach_mm = 0.0;
  for (const std::uint32_t v : triangle)
    reach_mm = std::max({reach_mm, largest_coordinate_mm(placed_[v]),
                         largest_coordinate_mm(vertices[v])});
  return std::max(2.0 * kTextStep_mm, kFloatStep * reach_mm);
}

/// A side as short as the rounding may have collapsed.
bool FacetComparison::may_be_missing(const std::array<std::uint32_t, 3>& triangle) const {
  double shortest_mm2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    shortest_mm2 = std::min(shortest_mm2,
                            squared_mm2(placed_[triangle[k]], placed_[triangle[(k + 1) % 3]]));
  return shortest_mm2 <= std::pow(2.0 * largest_step_mm(triangle), 2);
}

void FacetComparison::add_volume(const Facet& facet) {
  if (facets_ == 0) origin_ = facet[0];
  const Point a = difference(facet[0], origin_), b = difference(facet[1], origin_),
              c = difference(facet[2], origin_);
  const double six_volumes = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                             a[2] * (b[0] * c[1] - b[1] * c[0]);
  const double term = six_volumes - carry_;  // compensated: terms of both signs cancel
  const double sum = six_volumes_ + term;
  carry_ = (sum - six_volumes_) - term;
  six_volumes_ = sum;
}

}  // namespace trueflank::io
