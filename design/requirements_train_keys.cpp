// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_sections.h"

#include <charconv>
#include <system_error>

#include "trueflank/base/units.h"

namespace trueflank::requirements {
namespace {

std::string set_module_ratios(R& r, const V& v) {
  r.layer2_module_ratios.clear();
  for (const std::string& word : words(text(v))) {
    double ratio = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), ratio);
    if (error != std::errc() || end != word.data() + word.size() || !(ratio >= 0.2 && ratio <= 5.0))
      return "numbers from 0.2 to 5, by commas";
    r.layer2_module_ratios.push_back(ratio);
  }
  return "";
}

/// Whole numbers by commas.
std::string set_planets(R& r, const V& v) {
  r.planets.clear();
  for (const std::string& word : words(text(v))) {
    double number = 0.0;
    std::from_chars(word.data(), word.data() + word.size(), number);
    r.planets.push_back(static_cast<int>(number));
  }
  return "";
}

std::string set_wheel(R& r, const V& v) {
  r.external_wheels = text(v) != "internal";
  r.internal_wheels = text(v) != "external";
  return "";
}

std::string set_direction(R& r, const V& v) {
  r.direction = text(v) == "same"       ? OutputDirection::kSame
                : text(v) == "opposite" ? OutputDirection::kOpposite
                                        : OutputDirection::kAny;
  return "";
}

}  // namespace

RequirementsSection gearbox() {
  return {
      "gearbox",
      {{{.name = "kind",
         .type = KeyType::kText,
         .required = true,
         .meaning =
             "what is searched: 3k, stepped, simple, two-stage, pair; several by commas are ranked together"},
        [](R& r, const V& v) { return r.kinds = words(text(v)), std::string(); }},
       {{.name = "output",
         .type = KeyType::kText,
         .by_default = "the usual one of each kind",
         .meaning = "what drives out. 3k: ring2 (type I) or ring1 (type II); simple, stepped: "
                    "carrier or ring; "
                    "any: each; several by commas"},
        [](R& r, const V& v) { return r.outputs = words(text(v)), std::string(); }},
       {{.name = "input",
         .type = KeyType::kText,
         .by_default = "the usual one of each kind",
         .meaning = "what drives in. 3k: sun, or carrier (the split-ring set, searched without a "
                    "sun); any: "
                    "each; several by commas"},
        [](R& r, const V& v) { return r.inputs = words(text(v)), std::string(); }},
       {{.name = "wheel",
         .type = KeyType::kChoice,
         .choices = {"external", "internal", "any"},
         .by_default = "external",
         .meaning = "of pairs"},
        set_wheel},
       {{.name = "planets",
         .type = KeyType::kWholeList,
         .lower = 1,
         .upper = 20,
         .by_default = "3",
         .meaning = "number of planet bodies; \"3, 4\" tries both"},
        set_planets},
       {{.name = "friction",
         .lower = 0,
         .upper = 1,
         .by_default = "0.1",
         .meaning = "mesh friction coefficient"},
        [](R& r, const V& v) { return r.friction = number(v), std::string(); }},
       {{.name = "module_mm",
         .unit = "mm",
         .lower = 0.05,
         .upper = 100,
         .by_default = "1",
         .meaning = "of layer 1, of all gears where there is one layer"},
        [](R& r, const V& v) { return r.module_mm = number(v), std::string(); }},
       {{.name = "helix_angle_deg",
         .unit = "deg",
         .lower = -45,
         .upper = 45,
         .by_default = "0",
         .meaning = "of every gear, right-hand positive on the sun or pinion; modules are then "
                    "normal modules"},
        [](R& r, const V& v) { return r.helix_angle_rad = rad_from_deg(number(v)), std::string(); }},
       {{.name = "outer_diameter_mm",
         .unit = "mm",
         .lower = 1,
         .upper = 20000,
         .by_default = "none",
         .meaning = "of the smallest circle around all gears, rims and planets on their way round: "
                    "the module "
                    "follows from it"},
        [](R& r, const V& v) { return r.outer_diameter_mm = number(v), std::string(); }},
       {{.name = "rim",
         .unit = "module",
         .lower = 0,
         .upper = 20,
         .by_default = "2.5",
         .meaning = "of the rings outside their root circles"},
        [](R& r, const V& v) { return r.rim = number(v), std::string(); }},
       {{.name = "layer2_module_ratios",
         .type = KeyType::kText,
         .by_default = "\"1\"",
         .meaning = "module of layer 2 over that of layer 1: every value tried, \"1, 0.8\""},
        set_module_ratios},
       {{.name = "face_width_mm",
         .unit = "mm",
         .lower = 0.1,
         .upper = 10000,
         .by_default = "10",
         .meaning = "of every gear"},
        [](R& r, const V& v) { return r.face_width_mm = number(v), std::string(); }},
       {{.name = "face_width_max_mm",
         .unit = "mm",
         .lower = 0.1,
         .upper = 10000,
         .by_default = "none",
         .meaning = "a design gets wider up to this where it must to carry output_torque_nm"},
        [](R& r, const V& v) { return r.face_width_max_mm = number(v), std::string(); }},
       {{.name = "module_max_mm",
         .unit = "mm",
         .lower = 0.05,
         .upper = 100,
         .by_default = "none",
         .meaning = "then its module grows up to this"},
        [](R& r, const V& v) { return r.module_max_mm = number(v), std::string(); }},
       {{.name = "backlash_mm",
         .unit = "mm",
         .lower = 0,
         .upper = 100,
         .by_default = "0.04 modules",
         .meaning = "of every mesh, written into the designs"},
        [](R& r, const V& v) { return r.backlash_mm = number(v), std::string(); }}}};
}

RequirementsSection rack() {
  return {"rack",
          {{{.name = "pressure_angle_deg",
             .unit = "deg",
             .lower = 5,
             .upper = 44,
             .by_default = "20",
             .meaning = "basic rack, as in a design file"},
            [](R& r, const V& v) {
              return r.rack.pressure_angle_rad = rad_from_deg(number(v)), std::string();
            }},
           {{.name = "addendum", .unit = "module", .lower = 0.1, .upper = 3, .by_default = "1"},
            [](R& r, const V& v) { return r.rack.addendum = number(v), std::string(); }},
           {{.name = "dedendum", .unit = "module", .lower = 0.1, .upper = 3, .by_default = "1.25"},
            [](R& r, const V& v) { return r.rack.dedendum = number(v), std::string(); }},
           {{.name = "root_radius", .unit = "module", .lower = 0, .upper = 2, .by_default = "0.38"},
            [](R& r, const V& v) { return r.rack.root_radius = number(v), std::string(); }}}};
}

RequirementsSection cutter() {
  return {"cutter",
          {{{.name = "teeth",
             .type = KeyType::kWhole,
             .lower = 5,
             .upper = 500,
             .by_default = "25",
             .meaning = "of the pinion cutter that shapes every ring; without a table [cutter] the "
                        "rings' roots are fillets"},
            [](R& r, const V& v) { return r.cutter->teeth = whole(v), std::string(); }},
           {{.name = "shift", .unit = "module", .lower = -10, .upper = 10, .by_default = "0"},
            [](R& r, const V& v) { return r.cutter->shift = number(v), std::string(); }},
           {{.name = "tip_radius",
             .unit = "module",
             .lower = 0,
             .upper = 3,
             .by_default = "0",
             .meaning = "rounding of the cutter's tip corner"},
            [](R& r, const V& v) { return r.cutter->tip_radius = number(v), std::string(); }}},
          [](R& r) { r.cutter.emplace(); }};
}

RequirementsSection ratio() {
  return {"ratio",
          {{{.name = "min",
             .lower = 1,
             .upper = 1e6,
             .required = true,
             .meaning = "least input speed over output speed"},
            [](R& r, const V& v) { return r.ratio_min = number(v), std::string(); }},
           {{.name = "max", .lower = 1, .upper = 1e6, .required = true, .meaning = "greatest"},
            [](R& r, const V& v) { return r.ratio_max = number(v), std::string(); }},
           {{.name = "direction",
             .type = KeyType::kChoice,
             .choices = {"any", "same", "opposite"},
             .by_default = "any",
             .meaning = "of the output against the input"},
            set_direction}}};
}

namespace {

KeyRule teeth_rule(const char* name, double least, const char* by_default,
                   const char* meaning = "") {
  return {.name = name,
          .type = KeyType::kWhole,
          .lower = least,
          .upper = 1000,
          .by_default = by_default,
          .meaning = meaning};
}

}  // namespace

RequirementsSection teeth() {
  return {"teeth",
          {{teeth_rule("sun_min", 4, "6"),
            [](R& r, const V& v) { return r.sun.min = whole(v), std::string(); }},
           {teeth_rule("sun_max", 4, "60"),
            [](R& r, const V& v) { return r.sun.max = whole(v), std::string(); }},
           {teeth_rule("planet1_min", 4, "6"),
            [](R& r, const V& v) { return r.planet1.min = whole(v), std::string(); }},
           {teeth_rule("planet1_max", 4, "60"),
            [](R& r, const V& v) { return r.planet1.max = whole(v), std::string(); }},
           {teeth_rule("ring1_min", 6, "12"),
            [](R& r, const V& v) { return r.ring1.min = whole(v), std::string(); }},
           {teeth_rule("ring1_max", 6, "120"),
            [](R& r, const V& v) { return r.ring1.max = whole(v), std::string(); }},
           {teeth_rule("planet2_min", 4, "6"),
            [](R& r, const V& v) { return r.planet2.min = whole(v), std::string(); }},
           {teeth_rule("planet2_max", 4, "60"),
            [](R& r, const V& v) { return r.planet2.max = whole(v), std::string(); }},
           {teeth_rule("ring2_min", 6, "12"),
            [](R& r, const V& v) { return r.ring2.min = whole(v), std::string(); }},
           {teeth_rule("ring2_max", 6, "120"),
            [](R& r, const V& v) { return r.ring2.max = whole(v), std::string(); }},
           {teeth_rule("planet_min", 4, "planet1's", "of simple sets"),
            [](R& r, const V& v) { return r.planet.min = whole(v), std::string(); }},
           {teeth_rule("planet_max", 4, "planet1's", "of simple sets"),
            [](R& r, const V& v) { return r.planet.max = whole(v), std::string(); }},
           {teeth_rule("ring_min", 6, "ring1's; stepped: ring2's", "of simple and stepped sets"),
            [](R& r, const V& v) { return r.ring.min = whole(v), std::string(); }},
           {teeth_rule("ring_max", 6, "ring1's; stepped: ring2's", "of simple and stepped sets"),
            [](R& r, const V& v) { return r.ring.max = whole(v), std::string(); }},
           {teeth_rule("pinion_min", 4, "sun's", "of pairs"),
            [](R& r, const V& v) { return r.pinion.min = whole(v), std::string(); }},
           {teeth_rule("pinion_max", 4, "sun's", "of pairs"),
            [](R& r, const V& v) { return r.pinion.max = whole(v), std::string(); }},
           {teeth_rule("wheel_min", 4, "planet1's; internal: ring1's", "of pairs"),
            [](R& r, const V& v) { return r.wheel.min = whole(v), std::string(); }},
           {teeth_rule("wheel_max", 4, "planet1's; internal: ring1's", "of pairs"),
            [](R& r, const V& v) { return r.wheel.max = whole(v), std::string(); }},
           {{.name = "identical_planets",
             .type = KeyType::kFlag,
             .by_default = "true",
             .meaning = "all planet bodies alike at equal spacing"},
            [](R& r, const V& v) { return r.identical_planets = flag(v), std::string(); }}}};
}

RequirementsSection shift() {
  return {"shift",
          {{{.name = "min",
             .unit = "module",
             .lower = -5,
             .upper = 5,
             .by_default = "-2",
             .meaning = "least profile shift of every gear"},
            [](R& r, const V& v) { return r.shift_min = number(v), std::string(); }},
           {{.name = "max",
             .unit = "module",
             .lower = -5,
             .upper = 5,
             .by_default = "2",
             .meaning = "greatest"},
            [](R& r, const V& v) { return r.shift_max = number(v), std::string(); }}}};
}

}  // namespace trueflank::requirements
