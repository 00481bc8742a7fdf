// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "bindings.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/new_design.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/step/step_writer.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/session/evaluate.h"
#include "trueflank/solid/brep/brep.h"

namespace trueflank::python {
namespace {

/// Section of a gear's teeth as points of a closed polygon, one row each.
py::array_t<double> profile(const Gearbox& self, const std::string& name, double tolerance_um) {
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  const SectionPolygon section = section_polygon(gear_of(self, name).profile, tolerance_mm);
  py::array_t<double> points({static_cast<py::ssize_t>(section.points.size()), py::ssize_t{2}});
  auto at = points.mutable_unchecked<2>();
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    at(i, 0) = section.points[i].x();
    at(i, 1) = section.points[i].y();
  }
  return points;
}

Mesh mesh(const Gearbox& self, const std::string& part, double tolerance_um) {
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  py::gil_scoped_release unlocked;
  PartMesh made = part_mesh(part_of(self, part), {.tolerance_mm = tolerance_mm});
  return {.mesh = std::move(made.mesh), .chord_error_um = um_from_mm(made.chord_error_mm)};
}

std::vector<std::string> part_names(const Gearbox& self) {
  std::vector<std::string> names;
  for (const PartShape& part : shapes_of(self).parts) names.push_back(part.name);
  return names;
}

/// Where every body stands: name, part and a 4 x 4 matrix.
py::list assembly(const Gearbox& self) {
  py::list bodies;
  for (const Placement& place : shapes_of(self).assembly) {
    py::array_t<double> matrix({4, 4});
    auto at = matrix.mutable_unchecked<2>();
    const double c = std::cos(place.rotation_rad), s = std::sin(place.rotation_rad);
    const double rows[4][4] = {{c, -s, 0, place.translation_mm[0]},
                               {s, c, 0, place.translation_mm[1]},
                               {0, 0, 1, place.translation_mm[2]},
                               {0, 0, 0, 1}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) at(i, j) = rows[i][j];
    py::dict body;
    body["name"] = place.name;
    body["part"] = shapes_of(self).parts[static_cast<std::size_t>(place.part)].name;
    body["matrix"] = matrix;
    bodies.append(body);
  }
  return bodies;
}

py::object report(const Gearbox& self) {
  std::string text;
  {
    py::gil_scoped_release unlocked;
    text = io::report_json(evaluate(self));
  }
  return json_loads(text);
}

std::string report_html(const Gearbox& self) {
  py::gil_scoped_release unlocked;
  return report_page(self, evaluate(self));
}

py::dict drive_dict(const DirectionEfficiency& drive) {
  py::list members, meshes;
  for (const auto& m : drive.members) {
    py::dict member;
    member["name"] = m.name;
    member["speed"] = number(m.speed);
    member["torque"] = number(m.torque);
    member["power"] = number(m.power);
    members.append(member);
  }
  for (const auto& m : drive.meshes) {
    py::dict flow;
    flow["name"] = m.name;
    flow["driving_gear"] = m.driving_gear;
    flow["rolling_power"] = number(m.rolling_power);
    flow["loss"] = number(m.loss);
    meshes.append(flow);
  }
  py::dict dict;
  dict["efficiency"] = number(drive.efficiency);
  dict["self_locking"] = drive.self_locking;
  dict["members"] = members;
  dict["meshes"] = meshes;
  return dict;
}

py::dict efficiency_dict(const Gearbox& self, std::optional<double> friction, const std::string& model) {
  if (model != "contact_ratios" && model != "path_integral")
    throw Failure({.code = ErrorCode::kUsage, .message = "no such loss model", .key = "loss_model",
                   .value = model, .remedy = "contact_ratios or path_integral"});
  if (friction && !(*friction >= 0.0 && *friction <= 1.0))
    throw Failure({.code = ErrorCode::kOutOfRange,
                   .message = "no friction coefficient",
                   .key = "friction",
                   .value = trimmed_number(*friction),
                   .remedy = "0 to 1"});
  const EfficiencyResult result = efficiency(
      self.train(), {.model = model == "contact_ratios" ? LossModel::kContactRatios : LossModel::kPathIntegral,
                     .friction = friction});
  py::list meshes;
  for (const MeshEfficiency& m : result.meshes) {
    py::dict mesh;
    mesh["name"] = m.name;
    mesh["basic_efficiency"] = number(m.basic_efficiency);
    mesh["by_contact_ratios"] = number(m.by_contact_ratios);
    mesh["by_path_integral"] = number(m.by_path_integral);
    mesh["by_path_integral_gear2_driving"] = number(m.by_path_integral_gear2_driving);
    meshes.append(mesh);
  }
  py::dict dict;
  dict["friction"] = number(result.friction);
  dict["forward"] = number(result.forward);
  dict["backward"] = number(result.backward);
  dict["self_locking"] = result.self_locking;
  dict["meshes"] = meshes;
  dict["forward_drive"] = drive_dict(result.forward_drive);
  dict["backward_drive"] = drive_dict(result.backward_drive);
  return dict;
}

std::string step(const Gearbox& self, const std::string& part) {
  py::gil_scoped_release unlocked;
  const auto stepped = [](const PartShape& shape) {
    const io::Colour colour = io::part_colour(shape.role);
    return io::StepPart{.name = shape.name,
                        .solid = value_or_throw(brep_of(shape)),
                        .colour = {colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0}};
  };
  if (!part.empty()) return io::step_text(stepped(part_of(self, part)));
  std::vector<io::StepPart> parts;
  for (const PartShape& shape : shapes_of(self).parts) parts.push_back(stepped(shape));
  return io::step_text(parts, shapes_of(self).assembly, self.train().design.name);
}

py::list export_files(const Gearbox& self, const py::object& folder, const std::vector<std::string>& formats,
                      double tolerance_um, const std::string& part) {
  const std::string path = path_text(folder);
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  std::vector<io::ReportedFile> files;
  {
    py::gil_scoped_release unlocked;
    const auto wanted = value_or_throw(io::parse_formats(formats));
    auto written = io::export_parts({.train = &self.train(), .shapes = &shapes_of(self)},
                                    {.folder = path, .formats = wanted, .tolerance_mm = tolerance_mm,
                                     .kerf_mm = self.train().design.made.kerf_mm.value_or(0.0), .part = part});
    if (!written) throw Failure(self.located(written.error()));
    files = std::move(*written);
  }
  py::list list;
  for (const io::ReportedFile& file : files) {
    py::dict entry;
    entry["path"] = file.path;
    entry["part"] = file.part;
    entry["format"] = file.format;
    entry["bytes"] = file.bytes;
    entry["triangles"] = file.triangles > 0 ? py::object(py::int_(file.triangles)) : py::object(py::none());
    entry["accuracy_um"] = number(file.accuracy_um);
    entry["volume_mm3"] = number(file.volume_mm3);
    list.append(entry);
  }
  return list;
}

std::string new_design(const std::string& kind, const std::string& name) {
  if (const TrainKind* known = find_train_kind(kind)) return new_design_text(*known, name);
  throw Failure({.code = ErrorCode::kUsage, .message = "no such kind", .key = "kind", .value = kind,
                 .remedy = train_kind_names()});
}

}  // namespace

const PartShapes& shapes_of(const Gearbox& gearbox) {
  const auto& shapes = gearbox.parts();
  if (!shapes) throw Failure(shapes.error());
  return *shapes;
}

const TrainGear& gear_of(const Gearbox& gearbox, const std::string& name) {
  return *value_or_throw(gearbox.gear(name));
}

const PartShape& part_of(const Gearbox& gearbox, const std::string& name) {
  std::string names;
  for (const PartShape& part : shapes_of(gearbox).parts) {
    if (part.name == name) return part;
    names += (names.empty() ? "" : ", ") + part.name;
  }
  throw Failure({.code = ErrorCode::kUsage, .message = "this design has no such part", .key = "part",
                 .value = name, .remedy = names});
}

void bind_gearbox(py::module_& module) {
  module.def(
      "read", [](const py::object& path) { return value_or_throw(Gearbox::read(path_text(path))); },
      py::arg("path"), "Reads a design file and lays it out: shifts, tip circles and places solved.");
  module.def(
      "read_text",
      [](const std::string& text, const std::string& name) {
        return value_or_throw(Gearbox::read_text(text, name));
      },
      py::arg("text"), py::arg("name") = "design.toml",
      "The same for the text of a design file; `name` stands for the file in errors.");
  module.def("new_design", &new_design, py::arg("kind") = "3k", py::arg("name") = "my-gearbox",
             "A commented design file to start from, of kind 3k, stepped, simple, two-stage, pair or gear, as text.");

  py::class_<Gearbox>(module, "Gearbox",
      "A design laid out. From read() or read_text(). Never changes.")
      .def_property_readonly("name", [](const Gearbox& self) { return self.train().design.name; },
                             "Name of the design.")
      .def_property_readonly(
          "kind", [](const Gearbox& self) { return self.train().topology().kind; },
          "3k, stepped, simple, two-stage, pair or gear.")
      .def_property_readonly(
          "gears",
          [](const Gearbox& self) {
            std::vector<std::string> names;
            for (const TrainGear& gear : self.train().gears) names.push_back(gear.name);
            return names;
          },
          "Names of the gears in the order of the design file.")
      .def_property_readonly("parts", &part_names,
                             "Names of the parts to be made; planet1 and planet2 are one part `planet`.")
      .def_property_readonly(
          "centre_distance_mm", [](const Gearbox& self) { return number(self.train().centre_distance_mm); },
          "None for a single gear.")
      .def("design_text", [](const Gearbox& self) { return design_file_text(self.train().design); },
           "The design as a design file, every number to the last bit.")
      .def("profile", &profile, py::arg("gear") = "", py::arg("tolerance_um") = 1.0,
           "Teeth of one gear in its transverse section (at its lower face), tooth 1 on +x: n x 2 points\n"
           "[mm] of a closed polygon, counter-clockwise, each on the true curve, chords within the\n"
           "tolerance. Without modifications. The gear's name may be left out where there is but one.")
      .def("mesh", &mesh, py::arg("part"), py::arg("tolerance_um") = 1.0,
           "One part as a closed mesh in its own frame, facets within the tolerance of the true surface.")
      .def("assembly", &assembly,
           "Every body in mesh: list of dicts with `name`, `part` and `matrix`, 4 x 4 [mm], from the part's\n"
           "frame to the assembly's.")
      .def("report", &report, "report.json as a dict: gears, meshes, efficiency, checks, verdict.")
      .def("checks", [](const Gearbox& self) -> py::object { return report(self)["checks"]; },
           "The findings alone: list of dicts with id, where, status, value, limit, margin, message, cure.")
      .def("report_html", &report_html, "The report as one offline page.")
      .def("efficiency", &efficiency_dict, py::arg("friction") = py::none(),
           py::arg("loss_model") = "path_integral",
           "Efficiency both ways with the flows through members and meshes per unit of driving torque and\n"
           "sun speed. `friction` instead of the design's; `loss_model` path_integral or contact_ratios.")
      .def("step_text", &step, py::arg("part") = "",
           "Exact STEP (AP214) of one part, or of the assembly, as text.")
      .def("export", &export_files, py::arg("folder"),
           py::arg("formats") = std::vector<std::string>{"stl", "3mf"}, py::arg("tolerance_um") = 1.0,
           py::arg("part") = "",
           "Writes the parts (one part, where named) and the assembly: list of dicts with path, part,\n"
           "format, bytes, triangles, accuracy_um (measured on the file) and volume_mm3. Checks decide\n"
           "nothing here: ask report()[\"verdict\"] before.")
      .def("__repr__", [](const Gearbox& self) {
        return "<trueflank.Gearbox \"" + self.train().design.name + "\": " + self.train().topology().kind + ">";
      });
}

}  // namespace trueflank::python
