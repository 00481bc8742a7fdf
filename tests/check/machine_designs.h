// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_file.h"
#include "trueflank/solid/shape/part_shape.h"

// Designs with a housing, as texts, and what is made of them.
namespace trueflank {

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("no " + what);
  return text.replace(at, what.size(), by);
}

inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The teeth of examples/printed_actuator.
inline const std::string k3k = R"(format = 1
name = "actuator"
[gearbox]
kind = "3k"
output = "ring2"
planets = 3
module_mm = 0.8
centre_distance_mm = 20.5461
backlash_mm = 0.15
[sun]
teeth = 12
face_width_mm = 10
[planet1]
teeth = 39
face_width_mm = 10
[ring1]
teeth = 90
shift = 0.5225
face_width_mm = 10
[planet2]
teeth = 32
face_width_mm = 10
[ring2]
teeth = 81
shift = 1.9967
face_width_mm = 10
)";
inline const std::string kMachine = R"([housing]
[motor]
name = "nema17"
[bearings]
output = "6806"
planet = "625"
[fasteners]
carrier = "M3-short"
[made]
process = "fdm-0.4"
)";
inline const std::string kSimple = R"(format = 1
[gearbox]
kind = "simple"
planets = 3
module_mm = 1
backlash_mm = 0.15
[sun]
teeth = 18
face_width_mm = 12
[planet]
teeth = 27
face_width_mm = 12
[ring]
teeth = 72
face_width_mm = 12
)";
inline const std::string kStepped = R"(format = 1
[gearbox]
kind = "stepped"
planets = 3
module_mm = 1
backlash_mm = 0.15
[sun]
teeth = 15
face_width_mm = 10
[planet1]
teeth = 39
face_width_mm = 10
[planet2]
teeth = 30
face_width_mm = 10
[ring]
teeth = 84
face_width_mm = 10
)";

inline const std::string kPair = R"(format = 1
[gearbox]
kind = "pair"
module_mm = 1
backlash_mm = 0.15
[pinion]
teeth = 18
face_width_mm = 12
[wheel]
teeth = 60
face_width_mm = 12
)";
/// Around a pair.
inline const std::string kBox = R"([housing]
[motor]
name = "nema17"
[bearings]
output = "6806"
wheel = "608"
[made]
process = "fdm-0.4"
)";

/// A pair whose wheel is a ring around the pinion, and what is around it.
inline const std::string kRingPair = R"(format = 1
[gearbox]
kind = "pair"
module_mm = 1
backlash_mm = 0.15
[pinion]
teeth = 20
face_width_mm = 14
[wheel]
internal = true
teeth = 60
face_width_mm = 14
)";
inline const std::string kRingBox = R"([housing]
[motor]
name = "nema17"
[bearings]
output = "6806"
outputs = 2
[made]
process = "fdm-0.4"
)";

/// A sun wider than the circle of the motor's screws, and small planets.
inline std::string large_sun() {
  return replaced(
      "format = 1\n[gearbox]\nkind = \"simple\"\nplanets = 3\nmodule_mm = 1\nbacklash_mm = 0.15\n"
      "[sun]\nteeth = 48\nface_width_mm = 14\n[planet]\nteeth = 24\nface_width_mm = 14\n"
      "[ring]\nteeth = 96\nface_width_mm = 14\n" +
          kMachine,
      "planet = \"625\"", "planet = \"624\"");
}

inline std::string type_two(const std::string& text) {
  return replaced(text, "output = \"ring2\"", "output = \"ring1\"");
}
inline std::string idle_sun(const std::string& text) {
  return replaced(text, "planets = 3", "planets = 3\ninput = \"carrier\"");
}
/// The hub is as long as the flat of the motor's shaft wants it.
inline std::string split_ring(const std::string& text) {
  return replaced(idle_sun(text), "[sun]\nteeth = 12\nface_width_mm = 10\n", "") +
         "[carrier]\nplate_thickness_mm = 10\npin_hole_clearance_mm = 0.1\n";
}
/// Simple and stepped sets whose ring drives out.
inline std::string held_carrier(const std::string& text) {
  return replaced(text, "planets = 3", "planets = 3\noutput = \"ring\"");
}

/// On a motor whose shaft has no flat.
inline std::string round_shaft(const std::string& text) {
  return replaced(text, "name = \"nema17\"",
                  "shaft_diameter_mm = 5\nshaft_length_mm = 24\nbolt_circle_diameter_mm = 43.8\n"
                  "pilot_diameter_mm = 22\npilot_height_mm = 2\nthread_depth_mm = 4.5\n"
                  "torque_nm = 0.4");
}
/// Of metal, with fits of ISO 286.
inline std::string machined(const std::string& text) {
  return replaced(replaced(text, "\"fdm-0.4\"", "\"hobbing\""), "[housing]", "[housing]\nfit_mm = 0");
}

inline GearboxDesign design_of(const std::string& text) {
  const auto design = read_design_text(text, "machine.toml");
  if (!design)
    throw std::runtime_error(design.error().front().key + ": " + design.error().front().message);
  return *design;
}

inline std::string first_key(const std::string& text) {
  const auto design = read_design_text(text, "machine.toml");
  return design ? "" : design.error().front().key;
}

struct Made {
  explicit Made(const std::string& text) : train(*lay_out(design_of(text))) {
    auto made = part_shapes(train);
    if (!made)
      throw std::runtime_error(made.error().front().key + ": " + made.error().front().message);
    shapes = std::move(*made);
    findings = check_machine(train, shapes);
  }
  [[nodiscard]] const PartShape& part(const std::string& name) const {
    for (const PartShape& shape : shapes.parts)
      if (shape.name == name) return shape;
    throw std::runtime_error("no part " + name);
  }
  [[nodiscard]] const Finding& finding(const std::string& id, const std::string& where) const {
    for (const Finding& f : findings)
      if (f.id == id && f.where == where) return f;
    throw std::runtime_error("no finding " + id + " of " + where);
  }
  GearTrain train;
  PartShapes shapes;
  Findings findings;
};

}  // namespace trueflank
