// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstring>

#include "bindings.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/session/compare_report.h"
#include "trueflank/solid/measure/mesh_validity.h"

namespace trueflank::python {
namespace {

using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Triangles = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

Failure shape_failure(const char* key, const char* remedy) {
  return Failure({.code = ErrorCode::kWrongType, .message = "an array of the wrong shape or content",
                  .key = key, .remedy = remedy});
}

Mesh mesh_of_arrays(const Vertices& vertices, const Triangles& triangles) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3)
    throw shape_failure("vertices", "n x 3 coordinates in millimetres");
  if (triangles.ndim() != 2 || triangles.shape(1) != 3)
    throw shape_failure("triangles", "m x 3 indices of vertices");
  Mesh mesh;
  mesh.mesh.vertices.resize(vertices.shape(0));
  if (vertices.size() > 0)
    std::memcpy(mesh.mesh.vertices.data(), vertices.data(), sizeof(double) * vertices.size());
  mesh.mesh.triangles.reserve(triangles.shape(0));
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i) {
    std::array<std::uint32_t, 3> triangle{};
    for (py::ssize_t k = 0; k < 3; ++k) {
      const std::int64_t index = triangles.at(i, k);
      if (index < 0 || index >= vertices.shape(0))
        throw shape_failure("triangles", "indices from 0 to the number of vertices less one");
      triangle[k] = static_cast<std::uint32_t>(index);
    }
    mesh.mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// A read-only view that keeps the mesh alive.
template <class T, class Row>
py::array view(const std::vector<Row>& rows, const py::object& owner) {
  py::array array(py::dtype::of<T>(), {static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}},
                  {static_cast<py::ssize_t>(sizeof(Row)), static_cast<py::ssize_t>(sizeof(T))},
                  rows.data(), owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Mesh read(const py::object& path) {
  const std::string file = path_text(path);
  py::gil_scoped_release unlocked;
  return {.mesh = value_or_throw(io::read_mesh(file))};
}

py::object compare(const Mesh& golden, const Mesh& made, double tolerance_um) {
  checked_tolerance_mm(tolerance_um);
  std::string text;
  {
    py::gil_scoped_release unlocked;
    text = comparison_json(
        value_or_throw(compare_surfaces(golden.mesh, made.mesh, {.tolerance_um = tolerance_um})));
  }
  return json_loads(text);
}

}  // namespace

double checked_tolerance_mm(double tolerance_um) {
  if (!(tolerance_um > 0.0 && std::isfinite(tolerance_um)))
    throw Failure({.code = ErrorCode::kUsage,
                   .message = "no tolerance",
                   .key = "tolerance_um",
                   .value = trimmed_number(tolerance_um),
                   .remedy = "a number above 0"});
  return mm_from_um(tolerance_um);
}

void bind_mesh(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "A mesh of triangles in millimetres, counter-clockwise seen from outside.")
      .def(py::init(&mesh_of_arrays), py::arg("vertices"), py::arg("triangles"),
           "From n x 3 coordinates [mm] and m x 3 indices; both are copied.")
      .def_static("read", &read, py::arg("path"),
                  "Reads STL, OBJ, PLY, 3MF or GLB, told by content; all bodies as one mesh.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) { return view<double>(self.cast<const Mesh&>().mesh.vertices, self); },
          "n x 3, float64 [mm]; a read-only view.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return view<std::uint32_t>(self.cast<const Mesh&>().mesh.triangles, self);
          },
          "m x 3, uint32 indices of vertices; a read-only view.")
      .def_property_readonly(
          "chord_error_um",
          [](const Mesh& self) -> py::object {
            return std::isfinite(self.chord_error_um) ? py::object(py::float_(self.chord_error_um))
                                                      : py::object(py::none());
          },
          "Bound on the distance between facets and true surface, both ways; None where unknown.")
      .def_property_readonly(
          "volume_mm3", [](const Mesh& self) { return volume_mm3(self.mesh); },
          "Signed volume; positive for a closed mesh with its normals outwards.")
      .def_property_readonly(
          "is_valid", [](const Mesh& self) { return mesh_validity(self.mesh).valid(); },
          "Closed, oriented, 2-manifold, outward, no triangle without area.")
      .def("__repr__", [](const Mesh& self) {
        return "<trueflank.Mesh: " + std::to_string(self.mesh.vertices.size()) + " vertices, " +
               std::to_string(self.mesh.triangles.size()) + " triangles>";
      });
  module.def("compare", &compare, py::arg("golden"), py::arg("new"), py::arg("tolerance_um") = 1.0,
             "Compares two meshes as surfaces: the document of `trueflank compare --json` as a dict, with\n"
             "`same`, distances both ways, the worst place and, where they differ, its name.");
}

}  // namespace trueflank::python
