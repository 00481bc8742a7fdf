// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's exact predicates: nothing is constructed, so nothing is rounded.
#include "trueflank/solid/measure/solid_fault.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "trueflank/solid/measure/mesh_validity.h"

namespace trueflank {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Surface::Vertex_index;

/// False where CGAL refuses a triangle: then the mesh is not 2-manifold.
bool build(const TriangleMesh& mesh, Surface& surface) {
  const auto count = [](std::size_t number) { return static_cast<Surface::size_type>(number); };
  surface.reserve(count(mesh.vertices.size()), count(mesh.triangles.size() / 2 * 3),
                  count(mesh.triangles.size()));
  for (const auto& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v[0], v[1], v[2]));
  for (const auto& t : mesh.triangles)
    if (surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Surface::null_face())
      return false;
  return true;
}

}  // namespace

const char* to_text(SolidFault fault) {
  switch (fault) {
    case SolidFault::kNone:
      return "bounds a solid";
    case SolidFault::kBroken:
      return "is not closed";
    case SolidFault::kInsideOut:
      return "is inside out";
    case SolidFault::kCrossesItself:
      return "crosses itself";
  }
  return "";
}

SolidFault solid_fault(const TriangleMesh& mesh) {
  MeshValidity validity = mesh_validity(mesh);
  if (!(validity.volume_mm3 > 0.0)) {
    validity.volume_mm3 = 1.0;
    return validity.valid() ? SolidFault::kInsideOut : SolidFault::kBroken;
  }
  if (!validity.valid()) return SolidFault::kBroken;
  Surface surface;
  if (!build(mesh, surface)) return SolidFault::kBroken;
  if (processing::does_self_intersect(surface)) return SolidFault::kCrossesItself;
  return processing::does_bound_a_volume(surface) ? SolidFault::kNone : SolidFault::kInsideOut;
}

}  // namespace trueflank
