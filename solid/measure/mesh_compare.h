// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank {

struct CompareOptions {
  double tolerance_mm = 1e-3;
};

struct MeshSummary {
  std::size_t vertices = 0, triangles = 0, components = 0;
  std::array<double, 3> lower_mm{}, upper_mm{};  ///< bounding box
  double volume_mm3 = 0.0, area_mm2 = 0.0;
  bool closed = false;  ///< closed, oriented and 2-manifold
};

/// How far the surface of one mesh is from that of the other.
struct SurfaceDistance {
  double largest_mm = 0.0;  ///< a distance that occurs, at worst_place_mm
  double bound_mm = 0.0;    ///< no point of the surface is farther away
  double rms_mm = 0.0;      ///< over the area; distances below 1 % of the tolerance from above
  double share_beyond = 0.0;  ///< of the area, farther away than the tolerance; a piece counts by its middle
  std::array<double, 3> worst_place_mm{};
  bool exact = true;  ///< false: facets lie in such heaps that distances are upper bounds only
};

struct MeshComparison {
  MeshSummary golden, made;
  SurfaceDistance from_golden;  ///< of points of the golden mesh from the new one
  SurfaceDistance from_new;     ///< of points of the new mesh from the golden one
  bool same = false;            ///< both largest distances, and bounds, are within the tolerance

  [[nodiscard]] double largest_mm() const {
    return from_golden.largest_mm > from_new.largest_mm ? from_golden.largest_mm : from_new.largest_mm;
  }
  [[nodiscard]] bool worst_is_on_golden() const {
    return from_golden.largest_mm > from_new.largest_mm;
  }
};

/// Compares two meshes as surfaces, however each is tessellated; whole faces, not their vertices
/// alone. How: a facet is cut along the nearest triangles of the other mesh until each piece lies
/// over one of them; the distance from one triangle is convex, so a piece's corners bound all of
/// it. Guarantees: bound_mm is at most 1 % above the larger of tolerance and largest_mm (for meshes
/// on which that takes unreasonably long, it is higher; `same` is false then), so nothing that
/// stands out by more than 1 % over the tolerance is overlooked, however small. Not compared:
/// orientation of the facets, names, colours. Requires: indices in range. Meshes without triangles
/// or with coordinates that are no numbers are infinitely far from each other. Guarantees: time is
/// linear in the facets, whatever they are (some 50 us each at worst). Cost: about 0.3 us a facet
/// for two copies of one tessellation, 10 us and more for different ones.
[[nodiscard]] MeshComparison compare_meshes(const TriangleMesh& golden, const TriangleMesh& made,
                                            const CompareOptions& options = {});

}  // namespace trueflank
