// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <cmath>

#include "bindings.h"
#include "trueflank/base/units.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/geometry/tooth_span.h"

// Single gears and pairs without a design file. Every object is whole once it is made and never changes.
namespace trueflank::python {
namespace {

/// Walls thinner than this are none; as parts of a design have it.
constexpr double kThinnestWall_modules = 0.25;
constexpr double kRim_modules = 2.5, kLeastRim_mm = 2.0;

struct PyGear {
  std::shared_ptr<const ToothProfile> profile;
  double face_width_mm = 10.0;
  double bore_mm = 0.0;            ///< external
  double outer_diameter_mm = 0.0;  ///< ring
  bool herringbone = false;

  [[nodiscard]] const Gear& gear() const { return profile->gear(); }
  [[nodiscard]] bool ring() const { return gear().kind == GearKind::kInternal; }
};

struct PyPair {
  PyGear gear1, gear2;
  double centre_distance_mm = kNaN;

  [[nodiscard]] GearPair pair() const {
    return {gear1.profile.get(), gear2.profile.get(), centre_distance_mm};
  }
};

Failure out_of_range(const char* key, double value, const std::string& remedy) {
  return Failure({.code = ErrorCode::kOutOfRange, .message = "this cannot be", .key = key,
                  .value = py::cast<std::string>(py::repr(py::float_(value))), .remedy = remedy});
}

void expect(bool holds, const char* key, double value, const char* remedy) {
  if (!holds) throw out_of_range(key, value, remedy);  // NaN holds nothing
}

BasicRack make_rack(double pressure_angle_deg, double addendum, double dedendum, double root_radius,
                    double protuberance, double protuberance_angle_deg, double grinding_stock) {
  expect(pressure_angle_deg > 0.0 && pressure_angle_deg < 45.0, "pressure_angle_deg", pressure_angle_deg,
         "between 0 and 45");
  expect(addendum > 0.0 && addendum < 5.0, "addendum", addendum, "between 0 and 5 modules");
  expect(dedendum > 0.0 && dedendum < 5.0, "dedendum", dedendum, "between 0 and 5 modules");
  expect(root_radius >= 0.0 && root_radius < 5.0, "root_radius", root_radius, "0 to 5 modules");
  return {.pressure_angle_rad = rad_from_deg(pressure_angle_deg),
          .addendum = addendum,
          .dedendum = dedendum,
          .root_radius = root_radius,
          .protuberance = protuberance,
          .protuberance_angle_rad = rad_from_deg(protuberance_angle_deg),
          .grinding_stock = grinding_stock};
}

void check_body(const PyGear& made) {
  const double wall_mm = kThinnestWall_modules * made.gear().normal_module_mm;
  const double root_mm = 2.0 * made.profile->root_radius_mm();
  if (made.ring())
    expect(made.outer_diameter_mm >= root_mm + 2.0 * wall_mm, "outer_diameter_mm", made.outer_diameter_mm,
           "a rim of a quarter of the module at least");
  else
    expect(made.bore_mm >= 0.0 && made.bore_mm <= root_mm - 2.0 * wall_mm, "bore_mm", made.bore_mm,
           "0, or a wall of a quarter of the module at least");
}

PyGear make_gear(int teeth, double module_mm, double shift, bool internal, double helix_angle_deg,
                 const std::optional<BasicRack>& rack, std::optional<double> tip_diameter_mm,
                 double thinning_mm, double tip_rounding_mm, double face_width_mm, bool herringbone,
                 double bore_mm, std::optional<double> outer_diameter_mm) {
  expect(teeth >= 3, "teeth", teeth, "3 at least");
  expect(module_mm > 0.0 && std::isfinite(module_mm), "module_mm", module_mm, "above 0");
  expect(std::abs(helix_angle_deg) <= 60.0, "helix_angle_deg", helix_angle_deg, "-60 to 60");
  expect(face_width_mm > 0.0 && std::isfinite(face_width_mm), "face_width_mm", face_width_mm, "above 0");
  Gear gear{.kind = internal ? GearKind::kInternal : GearKind::kExternal,
            .teeth = teeth,
            .normal_module_mm = module_mm,
            .helix_angle_rad = rad_from_deg(helix_angle_deg),
            .rack = rack.value_or(BasicRack{}),
            .shift = shift,
            .thinning_mm = thinning_mm,
            .tip_rounding_mm = tip_rounding_mm};
  gear.tip_radius_mm = tip_diameter_mm ? 0.5 * *tip_diameter_mm : nominal_tip_radius_mm(gear);
  PyGear made{.profile = std::make_shared<const ToothProfile>(value_or_throw(ToothProfile::make(gear))),
              .face_width_mm = face_width_mm,
              .bore_mm = bore_mm,
              .herringbone = herringbone};
  made.outer_diameter_mm = outer_diameter_mm.value_or(
      2.0 * (made.profile->root_radius_mm() + std::max(kRim_modules * module_mm, kLeastRim_mm)));
  check_body(made);
  return made;
}

py::array_t<double> points_array(const std::vector<Point2>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto at = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    at(i, 0) = points[i].x();
    at(i, 1) = points[i].y();
  }
  return array;
}

py::array_t<double> tooth_points(const PyGear& self, int tooth, double tolerance_um) {
  expect(tooth >= 1 && tooth <= self.gear().teeth, "tooth", tooth, "1 to the number of teeth");
  const SectionPolygon section = section_polygon(*self.profile, checked_tolerance_mm(tolerance_um));
  const auto first = section.points.begin() + (tooth - 1) * section.points_per_tooth;
  return points_array({first, first + section.points_per_tooth});
}

Mesh gear_mesh(const PyGear& self, double tolerance_um) {
  const double tolerance_mm = checked_tolerance_mm(tolerance_um);
  py::gil_scoped_release unlocked;
  const ToothedOutline teeth{
      .profile = self.profile.get(),
      .twist = face_twist(self.gear(), self.face_width_mm, self.herringbone)};
  Slab slab{.z_lower_mm = 0.0, .z_upper_mm = self.face_width_mm, .outer = teeth, .holes = {}};
  if (self.ring()) {
    slab.outer = CircleOutline{.radius_mm = 0.5 * self.outer_diameter_mm};
    slab.holes = {teeth};
  } else if (self.bore_mm > 0.0) {
    slab.holes = {CircleOutline{.radius_mm = 0.5 * self.bore_mm}};
  }
  PartMesh made = part_mesh({.name = "gear", .slabs = {slab}}, {.tolerance_mm = tolerance_mm});
  return {.mesh = std::move(made.mesh), .chord_error_um = um_from_mm(made.chord_error_mm)};
}

PyPair make_pair(const PyGear& gear1, const PyGear& gear2, std::optional<double> centre_distance_mm) {
  if (gear1.ring())
    throw Failure({.code = ErrorCode::kInconsistent, .message = "gear1 is a ring", .key = "gear1",
                   .remedy = "the ring as gear2"});
  const MeshTeeth mesh = mesh_teeth(gear1.gear(), gear2.gear());
  const Gear &one = gear1.gear(), &two = gear2.gear();
  const double hands = one.helix_angle_rad + (mesh.internal ? -1.0 : 1.0) * two.helix_angle_rad;
  if (one.normal_module_mm != two.normal_module_mm ||
      one.rack.pressure_angle_rad != two.rack.pressure_angle_rad || std::abs(hands) > 1e-12)
    throw Failure({.code = ErrorCode::kInconsistent, .message = "these gears do not mesh", .key = "gear2",
                   .remedy = "equal modules and pressure angles; opposite hands (a ring: the same hand)"});
  const double sum = mesh.internal ? two.shift - one.shift : one.shift + two.shift;
  PyPair made{gear1, gear2, kNaN};
  made.centre_distance_mm = centre_distance_mm
                                ? *centre_distance_mm
                                : value_or_throw(zero_backlash_centre_distance_mm(mesh, sum));
  static_cast<void>(value_or_throw(working_pressure_angle_rad(mesh, made.centre_distance_mm)));
  return made;
}

void bind_rack(py::module_& module) {
  py::class_<BasicRack>(module, "Rack", "The basic rack that cuts a gear; lengths in modules. ISO 53 profile A.")
      .def(py::init(&make_rack), py::arg("pressure_angle_deg") = 20.0, py::arg("addendum") = 1.0,
           py::arg("dedendum") = 1.25, py::arg("root_radius") = 0.38, py::arg("protuberance") = 0.0,
           py::arg("protuberance_angle_deg") = 10.0, py::arg("grinding_stock") = 0.0,
           "Lengths are coefficients of the normal module.")
      .def_property_readonly(
          "pressure_angle_deg", [](const BasicRack& r) { return deg_from_rad(r.pressure_angle_rad); },
          "Of the normal section.")
      .def_property_readonly("addendum", [](const BasicRack& r) { return r.addendum; }, "In modules.")
      .def_property_readonly("dedendum", [](const BasicRack& r) { return r.dedendum; }, "In modules.")
      .def_property_readonly("root_radius", [](const BasicRack& r) { return r.root_radius; },
                             "Rounding of the tool's tip, in modules; 0: sharp.")
      .def("__eq__", [](const BasicRack& a, const BasicRack& b) { return a == b; });
}

/// A property that is a diameter, from a function that gives the radius.
template <class Radius>
void def_diameter(py::class_<PyGear>& type, const char* name, const Radius& radius_mm, const char* doc) {
  type.def_property_readonly(name, [radius_mm](const PyGear& g) { return 2.0 * radius_mm(g); }, doc);
}

void bind_diameters(py::class_<PyGear>& type) {
  def_diameter(type, "reference_diameter_mm", [](const PyGear& g) { return reference_radius_mm(g.gear()); },
               "Of the reference circle.");
  def_diameter(type, "base_diameter_mm", [](const PyGear& g) { return base_radius_mm(g.gear()); },
               "Of the base circle.");
  def_diameter(type, "tip_diameter_mm", [](const PyGear& g) { return g.profile->tip_radius_mm(); },
               "Where the tooth really ends.");
  def_diameter(type, "root_diameter_mm", [](const PyGear& g) { return g.profile->root_radius_mm(); },
               "Where the gap really ends.");
  def_diameter(type, "root_form_diameter_mm",
               [](const PyGear& g) { return g.profile->root_form_radius_mm(); },
               "Where involute and root fillet meet, undercut included.");
  def_diameter(type, "tip_form_diameter_mm", [](const PyGear& g) { return g.profile->tip_form_radius_mm(); },
               "Where the involute ends towards the tip.");
}

void bind_sizes(py::class_<PyGear>& type) {
  type.def_property_readonly("tip_thickness_mm", [](const PyGear& g) { return g.profile->tip_thickness_mm(); },
                             "Arc of the tooth at its tip; 0 where it is pointed.")
      .def_property_readonly("undercut", [](const PyGear& g) { return g.profile->notes().undercut; },
                             "The tool cut into the involute.")
      .def_property_readonly("pointed", [](const PyGear& g) { return g.profile->notes().pointed; },
                             "The flanks met before the tip circle.")
      .def_property_readonly(
          "span_teeth",
          [](const PyGear& g) -> py::object {
            return g.ring() ? py::object(py::none()) : py::object(py::int_(recommended_span_teeth(g.gear())));
          },
          "Teeth to measure the span over; None for a ring.")
      .def_property_readonly(
          "pin_diameter_mm", [](const PyGear& g) { return recommended_pin_diameter_mm(g.gear()); },
          "A pin that touches near the middle of the flank.")
      .def("span_mm",
           [](const PyGear& g, std::optional<int> teeth) {
             const int k = teeth.value_or(g.ring() ? 1 : recommended_span_teeth(g.gear()));
             expect(k >= 1 && k < g.gear().teeth, "teeth", k, "1 to the number of teeth less one");
             return number(base_tangent_length_mm(g.gear(), k));
           },
           py::arg("teeth") = py::none(), "Span (base tangent) over so many teeth; None for a ring.")
      .def("over_pins_mm",
           [](const PyGear& g, std::optional<double> pin_diameter_mm) {
             const double pin = pin_diameter_mm.value_or(recommended_pin_diameter_mm(g.gear()));
             expect(pin > 0.0, "pin_diameter_mm", pin, "above 0");
             return number(over_pins_mm(g.gear(), pin));
           },
           py::arg("pin_diameter_mm") = py::none(),
           "Size over two pins or balls, of a ring between them; None where they touch no involute.")
      .def("tooth_thickness_mm",
           [](const PyGear& g, std::optional<double> diameter_mm) {
             const double radius = diameter_mm ? 0.5 * *diameter_mm : reference_radius_mm(g.gear());
             expect(radius >= base_radius_mm(g.gear()), "diameter_mm", 2.0 * radius, "the base circle or more");
             return tooth_thickness_mm(g.gear(), radius);
           },
           py::arg("diameter_mm") = py::none(),
           "Arc of the tooth between its involute flanks, on the reference circle unless another is named.");
}

void bind_shape(py::class_<PyGear>& type) {
  type.def("profile",
           [](const PyGear& g, double tolerance_um) {
             return points_array(section_polygon(*g.profile, checked_tolerance_mm(tolerance_um)).points);
           },
           py::arg("tolerance_um") = 1.0,
           "All teeth in the transverse section at the lower face, tooth 1 on +x: n x 2 points [mm] of a\n"
           "closed polygon, counter-clockwise, each on the true curve, chords within the tolerance.")
      .def("tooth", &tooth_points, py::arg("tooth") = 1, py::arg("tolerance_um") = 1.0,
           "The same of one tooth, from gap to gap.")
      .def("mesh", &gear_mesh, py::arg("tolerance_um") = 1.0,
           "The gear over its face width, with bore or rim, as a closed mesh within the tolerance.");
}

void bind_one_gear(py::module_& module) {
  py::class_<PyGear> type(module, "Gear", "One gear or ring, without a design file. Never changes.");
  type.def(py::init(&make_gear), py::arg("teeth"), py::arg("module_mm") = 1.0, py::arg("shift") = 0.0,
           py::arg("internal") = false, py::arg("helix_angle_deg") = 0.0, py::arg("rack") = py::none(),
           py::arg("tip_diameter_mm") = py::none(), py::arg("thinning_mm") = 0.0,
           py::arg("tip_rounding_mm") = 0.0, py::arg("face_width_mm") = 10.0, py::arg("herringbone") = false,
           py::arg("bore_mm") = 0.0, py::arg("outer_diameter_mm") = py::none(),
           "`module_mm` is the normal module, `shift` the profile shift coefficient, `internal` makes a ring.\n"
           "Tip circle: module times (addendum + shift) beyond the reference circle unless it is named.\n"
           "`thinning_mm` thins the teeth on the reference circle.")
      .def_property_readonly("teeth", [](const PyGear& g) { return g.gear().teeth; }, "Number of teeth.")
      .def_property_readonly("module_mm", [](const PyGear& g) { return g.gear().normal_module_mm; },
                             "Normal module.")
      .def_property_readonly("shift", [](const PyGear& g) { return g.gear().shift; },
                             "Profile shift coefficient.")
      .def_property_readonly("internal", &PyGear::ring, "Whether it is a ring.")
      .def_property_readonly(
          "helix_angle_deg", [](const PyGear& g) { return deg_from_rad(g.gear().helix_angle_rad); },
          "At the reference circle, right hand positive.")
      .def_property_readonly("face_width_mm", [](const PyGear& g) { return g.face_width_mm; },
                             "From z = 0 upwards.")
      .def_property_readonly("rack", [](const PyGear& g) { return g.gear().rack; }, "The rack that cuts it.")
      .def("__repr__", [](const PyGear& g) {
        return "<trueflank.Gear: " + std::to_string(g.gear().teeth) + " teeth, module " +
               py::cast<std::string>(py::repr(py::float_(g.gear().normal_module_mm))) + (g.ring() ? ", ring>" : ">");
      });
  bind_diameters(type);
  bind_sizes(type);
  bind_shape(type);
}

void bind_pair(py::module_& module) {
  py::class_<PyPair>(module, "GearPair", "Two gears in mesh on parallel axes; gear2 may be a ring.")
      .def(py::init(&make_pair), py::arg("gear1"), py::arg("gear2"), py::arg("centre_distance_mm") = py::none(),
           "Centre distance: that without backlash of unthinned teeth, unless it is named.")
      .def_property_readonly("gear1", [](const PyPair& p) { return p.gear1; }, "The inner gear or pinion.")
      .def_property_readonly("gear2", [](const PyPair& p) { return p.gear2; }, "The wheel or ring.")
      .def_property_readonly("centre_distance_mm", [](const PyPair& p) { return p.centre_distance_mm; },
                             "Distance of the axes.")
      .def_property_readonly(
          "working_pressure_angle_deg",
          [](const PyPair& p) { return deg_from_rad(working_pressure_angle_rad(p.pair())); },
          "In the transverse section.")
      .def_property_readonly(
          "pitch_diameters_mm",
          [](const PyPair& p) { return py::make_tuple(2.0 * pitch_radius1_mm(p.pair()), 2.0 * pitch_radius2_mm(p.pair())); },
          "Working pitch circles of both gears.")
      .def_property_readonly(
          "backlash_mm", [](const PyPair& p) { return circumferential_backlash_mm(p.pair()); },
          "At the working pitch circle; below 0 the teeth overlap.")
      .def_property_readonly(
          "contact_ratio", [](const PyPair& p) { return number(contact_ratios(p.pair()).total); },
          "From the tip circles.")
      .def_property_readonly(
          "effective_contact_ratio", [](const PyPair& p) { return number(contact_ratios(p.pair()).effective); },
          "What undercut and root form leave of it.")
      .def_property_readonly(
          "start_of_active_profile_diameters_mm",
          [](const PyPair& p) {
            return py::make_tuple(2.0 * start_of_active_profile1_mm(p.pair()),
                                  2.0 * start_of_active_profile2_mm(p.pair()));
          },
          "Where contact starts at the root side of both gears.")
      .def_property_readonly(
          "tip_clearances_mm",
          [](const PyPair& p) {
            return py::make_tuple(tip_clearance_of_gear1_mm(p.pair()), tip_clearance_of_gear2_mm(p.pair()));
          },
          "Tip circle to the mate's root circle, both ways.")
      .def("clearance_um",
           [](const PyPair& p) {
             py::gil_scoped_release unlocked;
             return um_from_mm(mesh_clearance(p.pair()).clearance_mm);
           },
           "Smallest distance of the real profiles over a whole engagement, backlash centred; below 0 they\n"
           "run into each other.")
      .def("__repr__", [](const PyPair& p) {
        return "<trueflank.GearPair: " + std::to_string(p.gear1.gear().teeth) + " and " +
               std::to_string(p.gear2.gear().teeth) + " teeth>";
      });
}

}  // namespace

void bind_gear(py::module_& module) {
  bind_rack(module);
  bind_one_gear(module);
  bind_pair(module);
}

}  // namespace trueflank::python
