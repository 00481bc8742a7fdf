// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "trueflank/session/close_loop.h"
#include "trueflank/session/corrected_parts.h"
#include "trueflank/solid/measure/measured_mesh.h"

namespace trueflank::python {
namespace {

/// One path or several, or those of several parts by the parts' names.
std::vector<std::string> paths_of(const py::object& data) {
  std::vector<std::string> files;
  if (py::isinstance<py::dict>(data)) {
    for (const auto& [part, paths] : py::reinterpret_borrow<py::dict>(data))
      for (const std::string& file : paths_of(py::reinterpret_borrow<py::object>(paths)))
        files.push_back(py::cast<std::string>(part) + "=" + file);
  } else if (py::isinstance<py::str>(data) || py::hasattr(data, "__fspath__"))
    files.push_back(path_text(data));
  else
    for (const py::handle file : data) files.push_back(path_text(py::reinterpret_borrow<py::object>(file)));
  return files;
}

/// Python knows a loop of a gear and one of a drive by their types.
struct ClosedGearLoop : ClosedLoop {};
struct ClosedDriveLoop : ClosedLoop {};

ClosedGearLoop close_gear_loop(const Gearbox& self, const std::string& gear, const py::object& data,
                               bool aligned, const py::object& effects) {
  const std::vector<std::string> files = paths_of(data);
  const CloseLoopOptions options{.gear = gear_of(self, gear).name,
                                 .aligned = aligned,
                                 .effects_file = effects.is_none() ? "" : path_text(effects)};
  py::gil_scoped_release unlocked;
  return ClosedGearLoop{value_or_throw(trueflank::close_gear_loop(self, files, options))};
}

ClosedDriveLoop close_drive_loop(const Gearbox& self, const py::object& data) {
  const std::vector<std::string> files = paths_of(data);
  py::gil_scoped_release unlocked;
  return ClosedDriveLoop{value_or_throw(trueflank::close_drive_loop(self, files))};
}

template <class T>
py::array_t<T> array_of(const std::vector<double>& values) {
  py::array_t<T> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

py::dict corrected_meshes(const Gearbox& self, const py::object& loop_json, double tolerance_um) {
  const std::string file = path_text(loop_json);
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  std::vector<TriangleMesh> made;
  {
    py::gil_scoped_release unlocked;
    CorrectedParts corrected =
        value_or_throw(corrected_parts(self.train(), shapes_of(self), nullptr, file));
    corrected.changes.resize(corrected.shapes.parts.size());
    for (std::size_t i = 0; i < corrected.changes.size(); ++i) {
      const auto& [change, magnification] = corrected.changes[i];
      TriangleMesh mesh = measured_part_mesh(corrected.shapes.parts[i],
                                             {.tolerance_mm = tolerance_mm / magnification})
                              .part.mesh;
      made.push_back(change ? change(mesh) : std::move(mesh));
    }
  }
  py::dict meshes;
  for (std::size_t i = 0; i < made.size(); ++i)
    meshes[py::str(shapes_of(self).parts[i].name)] = Mesh{.mesh = std::move(made[i])};
  return meshes;
}

/// What both kinds of loop have.
template <class T>
py::class_<T> bind_closed(py::module_& module, const char* name, const char* doc, const char* html_doc) {
  return py::class_<T>(module, name, doc)
      .def_property_readonly("result", [](const T& self) { return json_loads(self.json()); },
                             "loop.json as a dict: data, before, after, effects, structure_left, verdict.")
      .def_property_readonly(
          "verdict", [](const T& self) { return std::string(to_text(self.result().verdict)); },
          "no_effect, explained or partly_explained.")
      .def("json_text", [](const T& self) { return self.json(); },
           "loop.json as text, for `trueflank make --correct` and corrected_meshes().")
      .def("text", [](const T& self) { return self.text(); }, "What a person reads first.")
      .def("html",
           [](const T& self) {
             py::gil_scoped_release unlocked;
             return self.html();
           },
           html_doc);
}

}  // namespace

void bind_loop(py::module_& module) {
  bind_closed<ClosedGearLoop>(module, "ClosedLoop", "What measured data say of a gear. From Gearbox.close_loop().",
                              "loop.html: charts before and after, one offline page.")
      .def_property_readonly(
          "before_um", [](const ClosedGearLoop& self) { return array_of<float>(self.residuals_before()); },
          "Residual of every observation against the model as designed, float32 [um].")
      .def_property_readonly(
          "after_um", [](const ClosedGearLoop& self) { return array_of<float>(self.residuals_after()); },
          "The same after the effects found.");
  bind_closed<ClosedDriveLoop>(module, "ClosedDriveLoop",
                               "What bench data say of the whole drive. From Gearbox.close_drive_loop().",
                               "loop.html: effects in words, efficiency maps and residuals, one offline page.")
      .def_property_readonly(
          "before_nm", [](const ClosedDriveLoop& self) { return array_of<double>(self.residuals_before()); },
          "Measured less predicted torque on the driven side, float64 [N m]; one a row of the bench table.")
      .def_property_readonly(
          "after_nm", [](const ClosedDriveLoop& self) { return array_of<double>(self.residuals_after()); },
          "The same after the effects found.");
  const py::object gearbox = module.attr("Gearbox");
  auto type = py::reinterpret_borrow<py::class_<Gearbox>>(gearbox);
  type.def("close_loop", &close_gear_loop, py::arg("gear"), py::arg("data"), py::arg("aligned") = false,
           py::arg("effects") = py::none(),
           "Closes the loop of one gear with measured files (a path or several): scans, inspection, sizes;\n"
           "of several parts: {part: path or paths}, or \"part=path\".\n"
           "`aligned`: scans stand in the gear's own frame. `effects`: a file with effects of your own.")
      .def("close_drive_loop", &close_drive_loop, py::arg("data"),
           "Closes the loop of the whole drive with bench files (a path or several).")
      .def("corrected_meshes", &corrected_meshes, py::arg("loop_json"), py::arg("tolerance_um") = 1.0,
           "Meshes of all parts by name, the measured gear corrected by a loop.json (path): made by the\n"
           "same process, it comes out as designed.");
}

}  // namespace trueflank::python
