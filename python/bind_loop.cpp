// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include "bindings.h"
#include "trueflank/app/corrected_parts.h"
#include "trueflank/app/effects_file.h"
#include "trueflank/loop/close_drive_loop.h"
#include "trueflank/loop/close_loop.h"
#include "trueflank/loop/drive_html.h"
#include "trueflank/loop/loop_html.h"

namespace trueflank::python {
namespace {

/// A closed loop; keeps the gearbox, whose profiles it refers to.
struct ClosedLoop {
  std::shared_ptr<Gearbox> gearbox;
  loop::GearLoop closed;
};

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

std::shared_ptr<ClosedLoop> close_loop(const std::shared_ptr<Gearbox>& self, const std::string& gear,
                                       const py::object& data, bool aligned, const py::object& effects) {
  const std::vector<std::string> files = paths_of(data);
  const std::string name = self->gear(gear).name;
  const std::string own = effects.is_none() ? "" : path_text(effects);
  py::gil_scoped_release unlocked;
  loop::LoopOptions options{.aligned = aligned};
  if (!own.empty()) options.declared = value_or_throw(app::read_effects_file(own));
  return std::make_shared<ClosedLoop>(
      ClosedLoop{self, value_or_throw(loop::close_loop(self->train(), name, files, options))});
}

std::shared_ptr<loop::DriveLoop> close_drive_loop(const Gearbox& self, const py::object& data) {
  const std::vector<std::string> files = paths_of(data);
  py::gil_scoped_release unlocked;
  return std::make_shared<loop::DriveLoop>(value_or_throw(loop::close_drive_loop(self.train(), files)));
}

template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict corrected_meshes(const Gearbox& self, const py::object& loop_json, double tolerance_um) {
  const std::string file = path_text(loop_json);
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  std::vector<PartMesh> made;
  {
    py::gil_scoped_release unlocked;
    app::CorrectedParts corrected =
        value_or_throw(app::corrected_parts(self.train(), self.shapes(), nullptr, file, tolerance_mm));
    made = std::move(corrected.meshes);
    if (made.empty())
      for (const PartShape& part : corrected.shapes.parts)
        made.push_back(part_mesh(part, {.tolerance_mm = tolerance_mm}));
  }
  py::dict meshes;
  for (std::size_t i = 0; i < made.size(); ++i)
    meshes[py::str(self.shapes().parts[i].name)] = Mesh{.mesh = std::move(made[i].mesh)};
  return meshes;
}

}  // namespace

void bind_loop(py::module_& module) {
  py::class_<ClosedLoop, std::shared_ptr<ClosedLoop>>(module, "ClosedLoop",
      "What measured data say of a gear. From Gearbox.close_loop().")
      .def_property_readonly(
          "result", [](const ClosedLoop& self) { return json_loads(loop::loop_json(self.closed.result)); },
          "loop.json as a dict: data, before, after, effects, structure_left, verdict.")
      .def_property_readonly(
          "verdict", [](const ClosedLoop& self) { return std::string(to_text(self.closed.result.verdict)); },
          "no_effect, explained or partly_explained.")
      .def_property_readonly(
          "before_um", [](const ClosedLoop& self) { return array_of(self.closed.before_um); },
          "Residual of every observation against the model as designed, float32 [um].")
      .def_property_readonly(
          "after_um", [](const ClosedLoop& self) { return array_of(self.closed.after_um); },
          "The same after the effects found.")
      .def("json_text", [](const ClosedLoop& self) { return loop::loop_json(self.closed.result); },
           "loop.json as text, for `trueflank make --correct` and corrected_meshes().")
      .def("text", [](const ClosedLoop& self) { return loop::loop_text(self.closed.result); },
           "What a person reads first.")
      .def("html",
           [](const ClosedLoop& self) {
             py::gil_scoped_release unlocked;
             return loop::loop_html(self.closed);
           },
           "loop.html: charts before and after, one offline page.");
  py::class_<loop::DriveLoop, std::shared_ptr<loop::DriveLoop>>(module, "ClosedDriveLoop",
      "What bench data say of the whole drive. From Gearbox.close_drive_loop().")
      .def_property_readonly(
          "result", [](const loop::DriveLoop& self) { return json_loads(loop::loop_json(self.result)); },
          "loop.json as a dict.")
      .def_property_readonly(
          "verdict", [](const loop::DriveLoop& self) { return std::string(to_text(self.result.verdict)); },
          "no_effect, explained or partly_explained.")
      .def_property_readonly(
          "before_nm", [](const loop::DriveLoop& self) { return array_of(self.before_nm); },
          "Measured less predicted torque on the driven side, float64 [N m]; one a row of the bench table.")
      .def_property_readonly(
          "after_nm", [](const loop::DriveLoop& self) { return array_of(self.after_nm); },
          "The same after the effects found.")
      .def("json_text", [](const loop::DriveLoop& self) { return loop::loop_json(self.result); },
           "loop.json as text.")
      .def("text", [](const loop::DriveLoop& self) { return loop::loop_text(self.result); },
           "What a person reads first.")
      .def("html",
           [](const loop::DriveLoop& self) {
             py::gil_scoped_release unlocked;
             return loop::drive_html(self);
           },
           "loop.html: effects in words, efficiency maps and residuals, one offline page.");
  const py::object gearbox = module.attr("Gearbox");
  auto type = py::reinterpret_borrow<py::class_<Gearbox, std::shared_ptr<Gearbox>>>(gearbox);
  type.def("close_loop", &close_loop, py::arg("gear"), py::arg("data"), py::arg("aligned") = false,
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
