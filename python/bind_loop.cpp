// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include "bindings.h"
#include "trueflank/app/corrected_parts.h"
#include "trueflank/loop/close_loop.h"
#include "trueflank/loop/loop_html.h"

namespace trueflank::python {
namespace {

/// A closed loop; keeps the gearbox, whose profiles it refers to.
struct ClosedLoop {
  std::shared_ptr<Gearbox> gearbox;
  loop::GearLoop closed;
};

std::shared_ptr<ClosedLoop> close_loop(const std::shared_ptr<Gearbox>& self, const std::string& gear,
                                       const py::object& data, bool aligned) {
  std::vector<std::string> files;
  if (py::isinstance<py::str>(data) || py::hasattr(data, "__fspath__"))
    files.push_back(path_text(data));
  else
    for (const py::handle file : data) files.push_back(path_text(py::reinterpret_borrow<py::object>(file)));
  const std::string name = self->gear(gear).name;
  py::gil_scoped_release unlocked;
  return std::make_shared<ClosedLoop>(ClosedLoop{
      self, value_or_throw(loop::close_loop(self->train(), name, files, {.aligned = aligned}))});
}

py::array_t<float> residuals(const std::vector<float>& values) {
  return py::array_t<float>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict corrected_meshes(const Gearbox& self, const py::object& loop_json, double tolerance_um) {
  const std::string file = path_text(loop_json);
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  std::vector<PartMesh> made;
  {
    py::gil_scoped_release unlocked;
    app::CorrectedParts corrected =
        value_or_throw(app::corrected_parts(self.train(), self.shapes(), file, tolerance_mm));
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
          "before_um", [](const ClosedLoop& self) { return residuals(self.closed.before_um); },
          "Residual of every observation against the model as designed, float32 [um].")
      .def_property_readonly(
          "after_um", [](const ClosedLoop& self) { return residuals(self.closed.after_um); },
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
  const py::object gearbox = module.attr("Gearbox");
  auto type = py::reinterpret_borrow<py::class_<Gearbox, std::shared_ptr<Gearbox>>>(gearbox);
  type.def("close_loop", &close_loop, py::arg("gear"), py::arg("data"), py::arg("aligned") = false,
           "Closes the loop of one gear with measured files (a path or several): scans, inspection, sizes.\n"
           "`aligned`: scans stand in the gear's own frame.")
      .def("corrected_meshes", &corrected_meshes, py::arg("loop_json"), py::arg("tolerance_um") = 1.0,
           "Meshes of all parts by name, the measured gear corrected by a loop.json (path): made by the\n"
           "same process, it comes out as designed.");
}

}  // namespace trueflank::python
