// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_keys.h"
#include "trueflank/design/key_values.h"

namespace trueflank {
namespace {

using namespace key_values;

using C = CarrierDesign;

}  // namespace

const std::vector<DesignKey<CarrierDesign>>& carrier_keys() {
  static const std::vector<DesignKey<C>> keys{
      {{.name = "plate_thickness_mm", .unit = "mm", .lower = 0.1, .upper = 1000, .required = true,
        .meaning = "thickness of either plate"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.plate_thickness_mm = number(v); },
       [](const C& c) { return Value(c.plate_thickness_mm); }},
      {{.name = "pin_diameter_mm", .unit = "mm", .lower = 0.1, .upper = 10000,
        .by_default = "the planet's bore less pin_clearance_mm",
        .meaning = "diameter of the pins on which the planets turn"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.pin_diameter_mm = number(v); },
       [](const C& c) { return if_given(c.pin_diameter_mm); }},
      {{.name = "pin_clearance_mm", .unit = "mm", .lower = 0.001, .upper = 100,
        .by_default = "0.1", .meaning = "diametral clearance of a planet on its pin"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.pin_clearance_mm = number(v); },
       [](const C& c) { return Value(c.pin_clearance_mm); }},
      {{.name = "pin_hole_clearance_mm", .unit = "mm", .lower = 0.001, .upper = 100,
        .by_default = "0.02", .meaning = "what the pins' holes in the plates are wider than the pins"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.pin_hole_clearance_mm = number(v); },
       [](const C& c) { return Value(c.pin_hole_clearance_mm); }},
      {{.name = "axial_clearance_mm", .unit = "mm", .lower = 0.01, .upper = 1000,
        .by_default = "0.3", .meaning = "gap between planets and plates"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.axial_clearance_mm = number(v); },
       [](const C& c) { return Value(c.axial_clearance_mm); }},
      {{.name = "outer_diameter_mm", .unit = "mm", .lower = 0.1, .upper = 200000,
        .by_default = "three quarters of a pin's diameter beyond the pins",
        .meaning = "outer diameter of the plates"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.outer_diameter_mm = number(v); },
       [](const C& c) { return if_given(c.outer_diameter_mm); }},
      {{.name = "opening_diameter_mm", .unit = "mm", .lower = 0.1, .upper = 200000,
        .by_default = "the sun passes with axial_clearance_mm around it",
        .meaning = "diameter of the opening of the plates about the axis"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.opening_diameter_mm = number(v); },
       [](const C& c) { return if_given(c.opening_diameter_mm); }},
      {{.name = "bearing_diameter_mm", .unit = "mm", .lower = 0.1, .upper = 200000,
        .by_default = "no seat",
        .meaning = "seat of a bearing in the outer face of either plate: the bearing's outer "
                   "diameter"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.bearing_diameter_mm = number(v); },
       [](const C& c) { return unless_zero(c.bearing_diameter_mm); }},
      {{.name = "bearing_width_mm", .unit = "mm", .lower = 0.1, .upper = 1000,
        .by_default = "needed with bearing_diameter_mm", .meaning = "depth of that seat"},
       KeyPlace::kAnywhere,
       [](C& c, const KeyValue& v) { c.bearing_width_mm = number(v); },
       [](const C& c) { return unless_zero(c.bearing_width_mm); }},
  };
  return keys;
}

const std::vector<DesignKey<ShaftsDesign>>& shafts_keys() {
  using S = ShaftsDesign;
  static const std::vector<DesignKey<S>> keys{
      {{.name = "rotor_inertia_kg_m2", .unit = "kg m2", .lower = 0, .upper = 1e6,
        .by_default = "0", .meaning = "inertia of the motor's rotor and what turns with it, on the "
                                      "input shaft"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.rotor_inertia_kg_m2 = number(v); },
       [](const S& s) { return unless_zero(s.rotor_inertia_kg_m2); }},
      {{.name = "load_inertia_kg_m2", .unit = "kg m2", .lower = 0, .upper = 1e9,
        .by_default = "0", .meaning = "inertia of the load, on the output shaft"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.load_inertia_kg_m2 = number(v); },
       [](const S& s) { return unless_zero(s.load_inertia_kg_m2); }},
  };
  return keys;
}

}  // namespace trueflank
