// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/facet_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trueflank::io {
namespace {

using Point = std::array<double, 3>;

constexpr double kSureStep_mm2 = 16.0 * kTextStep_mm * kTextStep_mm;  // no facet's step is less

double squared_mm2(const Point& p, const Point& q) {
  const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return x * x + y * y + z * z;
}

double largest_coordinate_mm(const Point& p) {
  return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
}

}  // namespace

void FacetComparison::take(const Facet& facet) {
  volume_.add(facet[0], facet[1], facet[2]);
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

const std::array<std::uint32_t, 3>* FacetComparison::next_body() {
  for (; next_ == end_ && body_ < scene_.bodies.size(); ++body_) {
    const Placement& body = scene_.bodies[body_];
    mesh_ = scene_.shapes[static_cast<std::size_t>(body.part)].mesh;
    next_ = mesh_->triangles.data();
    end_ = next_ + mesh_->triangles.size();
    const PlacementTransform place(body);
    placed_.clear();
    placed_.reserve(mesh_->vertices.size());
    for (const auto& vertex : mesh_->vertices) placed_.push_back(place(vertex));
  }
  return next_ == end_ ? nullptr : next_;
}

/// The larger of both kinds of file.
double FacetComparison::largest_step_mm(const std::array<std::uint32_t, 3>& triangle) const {
  // Some formats round in the assembly's frame, some in the part's, whose origin may be far.
  const auto& vertices = mesh_->vertices;
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

}  // namespace trueflank::io
