// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "trueflank/solid/mesh/triangle_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// How far a mesh is from the part it stands for, measured against the true curves.
struct Accuracy {
  /// Largest distance of a point of a facet from the true surface, and of a point of the true outlines
  /// from the facets.
  double facets_to_surface_mm = 0.0;
  double surface_to_facets_mm = 0.0;
  std::array<double, 3> worst_place_mm{};  ///< of the larger of both, on the mesh or on the surface
  /// Extremes of the walls' distance along the normal: too much material (+), too little (-).
  double most_excess_mm = 0.0;
  double most_deficit_mm = 0.0;

  [[nodiscard]] double largest_mm() const {
    return facets_to_surface_mm > surface_to_facets_mm ? facets_to_surface_mm
                                                       : surface_to_facets_mm;
  }
};

/// Measures any mesh of a part against its true curves, whoever made the mesh and however it is
/// tessellated; nothing of the program's own tessellation is used.
/// Frame: the part's. Shared vertices are not needed.
/// How: every facet beside the axis' direction is measured at its vertices and along it; plane faces by
/// their height; every true curve is sampled four times as densely as chords of the error
/// found would need, against a cut of the mesh at half height of each slab, and refined at the worst
/// place.
/// Guarantees: a wall, tooth, hole or plane face that is missing, added or moved is found. That the mesh is
/// closed is mesh_validity()'s to say.
/// Accuracy: 2 % of the largest distance for chords of smooth curves; of displaced teeth also the share by which
/// the displacement stretches the place: distances are taken before it. Cost: linear, about 1 us a facet.
[[nodiscard]] Accuracy measure_accuracy(const TriangleMesh& mesh, const PartShape& shape);

}  // namespace trueflank
