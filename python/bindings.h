// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <memory>
#include <string>

#include "failure.h"
#include "trueflank/session/gearbox.h"
#include "trueflank/solid/mesh/gear_mesh.h"

// The Python module, one part a file. Texts of JSON become dicts by Python's own json: the numbers
// are those of the program's files, null is None.
namespace trueflank::python {

namespace py = pybind11;

/// @name A gearbox's things by name; throw Failure where there is none
/// @{
[[nodiscard]] const PartShapes& shapes_of(const Gearbox& gearbox);
/// The only gear for an empty name.
[[nodiscard]] const TrainGear& gear_of(const Gearbox& gearbox, const std::string& name);
[[nodiscard]] const PartShape& part_of(const Gearbox& gearbox, const std::string& name);
/// @}

/// A mesh of triangles that NumPy sees without copying.
struct Mesh {
  TriangleMesh mesh;
  double chord_error_um = kNaN;  ///< NaN: unknown
};

[[nodiscard]] inline py::object json_loads(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

/// None for what is not a number.
[[nodiscard]] inline py::object number(double value) {
  return std::isfinite(value) ? py::object(py::float_(value)) : py::object(py::none());
}

/// os.fspath of a str or PathLike.
[[nodiscard]] inline std::string path_text(const py::object& path) {
  return py::cast<std::string>(py::module_::import("os").attr("fspath")(path));
}

/// Throws Failure for what is no tolerance.
double checked_tolerance_mm(double tolerance_um);

void bind_mesh(py::module_& module);
void bind_gear(py::module_& module);
void bind_gearbox(py::module_& module);
void bind_search(py::module_& module);
/// Onto the class Gearbox.
void bind_loop(py::module_& module);

}  // namespace trueflank::python
