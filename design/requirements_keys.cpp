// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_keys.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/search/search_figures.h"

namespace trueflank {
namespace {

using R = SearchRequirements;
using V = KeyValue;

double number(const V& v) { return std::get<double>(v); }
int whole(const V& v) { return static_cast<int>(std::get<std::int64_t>(v)); }
bool flag(const V& v) { return std::get<bool>(v); }
const std::string& text(const V& v) { return std::get<std::string>(v); }

/// The words of "a, b, c".
std::vector<std::string> words(const std::string& list) {
  std::vector<std::string> result(1);
  for (const char c : list) {
    if (c == ',')
      result.emplace_back();
    else if (c != ' ')
      result.back() += c;
  }
  return result;
}

/// "forward, mass", or with weights: "forward: 1, mass: 0.2".
std::string set_objectives(R& r, const V& v) {
  r.objectives.clear();
  r.weights.clear();
  for (const std::string& word : words(text(v))) {
    const std::string name = word.substr(0, word.find(':'));
    const auto& all = objective_entries();
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const ObjectiveEntry& entry) { return name == entry.name; });
    if (it == all.end()) {
      std::string names;
      for (const ObjectiveEntry& entry : all) names += (names.empty() ? "" : ", ") + std::string(entry.name);
      return names + ": one, or several by commas";
    }
    if (std::find(r.objectives.begin(), r.objectives.end(), it->objective) != r.objectives.end())
      return "each objective once";
    r.objectives.push_back(it->objective);
    if (name == word) continue;
    double weight = 0.0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + name.size() + 1, end, weight);
    if (error != std::errc() || stop != end || !(weight > 0.0 && weight <= 1000.0))
      return "weights above 0, at most 1000: \"forward: 1, mass: 0.2\"";
    r.weights.push_back({it->objective, weight});
  }
  if (!r.weights.empty() && r.weights.size() != r.objectives.size())
    return "a weight for each objective, or for none";
  if (!r.weights.empty()) r.objectives = {SearchObjective::kWeighted};
  return "";
}

template <SearchObjective kFigure>
std::string set_figure_limit(R& r, const V& v) {
  r.figure_limits.push_back({kFigure, number(v)});
  return "";
}

SearchTolerance& tolerance_of(R& r) {
  if (!r.tolerance) r.tolerance.emplace();
  return *r.tolerance;
}

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

RequirementsSection top() {
  return {"",
          {{{.name = "format",
             .type = KeyType::kWhole,
             .lower = 1,
             .upper = 1,
             .required = true,
             .meaning = "of this file"},
            [](R&, const V&) { return std::string(); }},
           {{.name = "name",
             .type = KeyType::kText,
             .by_default = "the file's name",
             .meaning = "of the designs found"},
            [](R& r, const V& v) { return r.name = text(v), std::string(); }}}};
}

RequirementsSection gearbox() {
  return {
      "gearbox",
      {{{.name = "kind",
         .type = KeyType::kText,
         .required = true,
         .meaning =
             "what is searched: 3k, stepped, simple, pair; several by commas are ranked together"},
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

KeyRule teeth_rule(const char* name, double least, const char* by_default,
                   const char* meaning = "") {
  return {.name = name,
          .type = KeyType::kWhole,
          .lower = least,
          .upper = 1000,
          .by_default = by_default,
          .meaning = meaning};
}

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

KeyRule figure_rule(const char* name, const char* unit, double upper, const char* meaning) {
  return {.name = name, .unit = unit, .lower = 0, .upper = upper, .by_default = "none", .meaning = meaning};
}

RequirementsSection limits() {
  return {"limits",
          {{{.name = "contact_ratio_min",
             .lower = 1,
             .upper = 5,
             .by_default = "1",
             .meaning = "of every mesh, of its tip circles and of what its roots leave"},
            [](R& r, const V& v) { return r.contact_ratio_min = number(v), std::string(); }},
           {{.name = "contact_ratio_max",
             .lower = 1,
             .upper = 10,
             .by_default = "2",
             .meaning = "of every mesh, of its tip circles"},
            [](R& r, const V& v) { return r.contact_ratio_max = number(v), std::string(); }},
           {{.name = "clearance_um",
             .unit = "um",
             .lower = 0,
             .upper = 1000,
             .by_default = "2",
             .meaning = "least, of tip corners to the mate's root and flank"},
            [](R& r, const V& v) { return r.clearance_um = number(v), std::string(); }},
           {{.name = "tip_clearance",
             .unit = "module",
             .lower = 0,
             .upper = 1,
             .by_default = "0.1",
             .meaning = "least, tip to root"},
            [](R& r, const V& v) { return r.tip_clearance = number(v), std::string(); }},
           {{.name = "tip_thickness",
             .unit = "module",
             .lower = 0,
             .upper = 1,
             .by_default = "0.2",
             .meaning = "least"},
            [](R& r, const V& v) { return r.tip_thickness = number(v), std::string(); }},
           {{.name = "planet_clearance_mm",
             .unit = "mm",
             .lower = 0,
             .upper = 1000,
             .by_default = "0.5",
             .meaning = "least, between tip circles of neighbours"},
            [](R& r, const V& v) { return r.planet_clearance_mm = number(v), std::string(); }},
           {figure_rule("forward_min", "", 1, "forward efficiency, with `[losses]` where there are"),
            set_figure_limit<SearchObjective::kForward>},
           {figure_rule("backward_min", "", 1, "backward efficiency"),
            set_figure_limit<SearchObjective::kBackward>},
           {figure_rule("outer_diameter_max_mm", "mm", 20000, "of the smallest circle around everything"),
            set_figure_limit<SearchObjective::kSize>},
           {figure_rule("mass_max_kg", "kg", 1e6, "of all gears, solid, with the rings' rims"),
            set_figure_limit<SearchObjective::kMass>},
           {figure_rule("length_max_mm", "mm", 1e5, "of the gears along the axis"),
            set_figure_limit<SearchObjective::kLength>},
           {figure_rule("torque_density_min_nm_per_kg", "N m/kg", 1e9, "allowable torque over mass"),
            set_figure_limit<SearchObjective::kTorqueDensity>},
           {figure_rule("starting_torque_max_nm", "N m", 1e9,
                        "that starts the train at the output against the drag of `[losses]`"),
            set_figure_limit<SearchObjective::kStartingTorque>},
           {figure_rule("input_inertia_max_kg_m2", "kg m2", 1e9,
                        "of gears, rotor and load, as the input feels it"),
            set_figure_limit<SearchObjective::kInputInertia>},
           {figure_rule("output_inertia_max_kg_m2", "kg m2", 1e9,
                        "the same as the output feels it, driving backwards"),
            set_figure_limit<SearchObjective::kOutputInertia>},
           {figure_rule("sliding_max", "", 1e6, "specific sliding of any tooth"),
            set_figure_limit<SearchObjective::kSliding>},
           {figure_rule("backlash_max_arcmin", "arcmin", 1e6, "of the output, the input held"),
            set_figure_limit<SearchObjective::kBacklash>},
           {figure_rule("acceleration_min_rad_s2", "rad/s2", 1e9, "of the load by the motor"),
            set_figure_limit<SearchObjective::kAcceleration>},
           {figure_rule("settling_max_s", "s", 1e6, "of a move of the load from rest to rest"),
            set_figure_limit<SearchObjective::kSettling>},
           {{.name = "hunting",
             .type = KeyType::kFlag,
             .by_default = "false",
             .meaning = "tooth numbers of a mesh have no common divisor"},
            [](R& r, const V& v) { return r.hunting = flag(v), std::string(); }},
           {{.name = "phasing",
             .type = KeyType::kChoice,
             .choices = {"any", "sequential"},
             .by_default = "any",
             .meaning = "sequential: in no mesh all planets engage at once"},
            [](R& r, const V& v) { return r.sequential = text(v) == "sequential", std::string(); }},
           {{.name = "assembling_share_min",
             .lower = 0,
             .upper = 1,
             .by_default = "none",
             .meaning = "least share of sets within the tolerances that assemble and turn"},
            [](R& r, const V& v) { return r.assembling_share_min = number(v), std::string(); }},
           {{.name = "tolerance_class",
             .type = KeyType::kWhole,
             .lower = 1,
             .upper = 11,
             .by_default = "none",
             .meaning = "ISO 1328-1: runout and pitch of every gear"},
            [](R& r, const V& v) { return tolerance_of(r).tolerance_class = whole(v), std::string(); }},
           {{.name = "axis_tolerance_um",
             .unit = "um",
             .lower = 0,
             .upper = 1e4,
             .by_default = "0",
             .meaning = "+-, of the centre distance"},
            [](R& r, const V& v) { return tolerance_of(r).centre_distance_um = number(v), std::string(); }},
           {{.name = "thickness_tolerance_um",
             .unit = "um",
             .lower = 0,
             .upper = 1e4,
             .by_default = "0",
             .meaning = "+-, of every tooth on its reference circle"},
            [](R& r, const V& v) {
              return tolerance_of(r).tooth_thickness_um = number(v), std::string();
            }}}};
}

KeyRule drive_rule(const char* name, const char* unit, double upper, const char* by_default,
                   const char* meaning) {
  return {.name = name, .unit = unit, .lower = 0, .upper = upper, .by_default = by_default, .meaning = meaning};
}

RequirementsSection motor() {
  return {"motor",
          {{drive_rule("torque_nm", "N m", 1e9, "none", "at the input, either way"),
            [](R& r, const V& v) { return r.motor.torque_nm = number(v), std::string(); }},
           {drive_rule("speed_rpm", "rpm", 1e7, "none", "the motor turns no faster"),
            [](R& r, const V& v) { return r.motor.speed_rpm = number(v), std::string(); }},
           {drive_rule("rotor_inertia_kg_m2", "kg m2", 1e6, "0", "of the motor, on the input"),
            [](R& r, const V& v) { return r.motor.rotor_kg_m2 = number(v), std::string(); }},
           {drive_rule("load_inertia_kg_m2", "kg m2", 1e9, "0", "on the output"),
            [](R& r, const V& v) { return r.motor.load_kg_m2 = number(v), std::string(); }},
           {drive_rule("load_torque_nm", "N m", 1e9, "0", "on the output, against its motion"),
            [](R& r, const V& v) { return r.motor.load_nm = number(v), std::string(); }},
           {drive_rule("move_deg", "deg", 1e6, "90", "of the output from rest to rest, for `settling`"),
            [](R& r, const V& v) { return r.motor.move_rad = rad_from_deg(number(v)), std::string(); }}}};
}

KeyRule factor_rule(const char* name, const char* by_default, const char* meaning) {
  return {.name = name, .lower = 0.01, .upper = 100, .by_default = by_default, .meaning = meaning};
}

RequirementsSection strength() {
  return {
      "strength",
      {{{.name = "output_torque_nm",
         .unit = "N m",
         .lower = 0,
         .upper = 1e9,
         .by_default = "none",
         .meaning = "to be carried by every design"},
        [](R& r, const V& v) { return r.output_torque_nm = number(v), std::string(); }},
       {{.name = "material",
         .type = KeyType::kText,
         .by_default = kDefaultMaterial,
         .meaning = "of every gear (docs/strength.md)"},
        [](R& r, const V& v) { return r.strength.material = text(v), std::string(); }},
       {{.name = "reversing",
         .type = KeyType::kFlag,
         .by_default = "true",
         .meaning = "loaded in both directions"},
        [](R& r, const V& v) { return r.strength.reversing = flag(v), std::string(); }},
       {factor_rule("overload_factor", "1", "K_O"),
        [](R& r, const V& v) { return r.strength.overload_factor = number(v), std::string(); }},
       {factor_rule("dynamic_factor", "1", "K_V"),
        [](R& r, const V& v) { return r.strength.dynamic_factor = number(v), std::string(); }},
       {factor_rule("face_load_factor", "1", "K_Hbeta"),
        [](R& r, const V& v) { return r.strength.face_load_factor = number(v), std::string(); }},
       {factor_rule("planet_load_factor", "1", "worst planet's share over the mean"),
        [](R& r, const V& v) { return r.strength.planet_load_factor = number(v), std::string(); }},
       {factor_rule("bending_life_factor", "1", "K_L"),
        [](R& r, const V& v) { return r.strength.bending_life_factor = number(v), std::string(); }},
       {factor_rule("contact_life_factor", "1", "K_HL"),
        [](R& r, const V& v) { return r.strength.contact_life_factor = number(v), std::string(); }},
       {factor_rule("bending_safety", "1.2", "S_F"),
        [](R& r, const V& v) { return r.strength.bending_safety = number(v), std::string(); }},
       {factor_rule("contact_safety", "1.15", "S_H"),
        [](R& r, const V& v) { return r.strength.contact_safety = number(v), std::string(); }}}};
}

RequirementsSection search() {
  return {
      "search",
      {{{.name = "objectives",
         .type = KeyType::kText,
         .by_default = "\"forward\"",
         .meaning = "one figure of the list above, or several for their Pareto front, or with weights: "
                    "\"forward: 1, mass: 0.2\""},
        set_objectives},
       {{.name = "loss_model",
         .type = KeyType::kChoice,
         .choices = {"contact_ratios", "path_integral"},
         .by_default = "path_integral",
         .meaning = "how a mesh's basic efficiency is computed: by the sliding itself, or by the "
                    "paper's formula"},
        [](R& r, const V& v) {
          r.loss_model =
              text(v) == "path_integral" ? LossModel::kPathIntegral : LossModel::kContactRatios;
          return std::string();
        }},
       {{.name = "results",
         .type = KeyType::kWhole,
         .lower = 1,
         .upper = 1000,
         .by_default = "20",
         .meaning = "design files written at most"},
        [](R& r, const V& v) { return r.results = whole(v), std::string(); }},
       {{.name = "listed",
         .type = KeyType::kWhole,
         .lower = 0,
         .upper = 1000000,
         .by_default = "200",
         .meaning = "tooth sets in search.csv, the best; sets of which a bound says that they "
                    "cannot be among them are not optimised; 0: all"},
        [](R& r, const V& v) { return r.listed = whole(v), std::string(); }}}};
}

}  // namespace

namespace {

template <std::size_t I>
std::string set_loss(R& r, const V& v) {
  if (!r.losses) r.losses.emplace();
  losses_keys()[I].set(*r.losses, v);
  return {};
}

constexpr std::size_t kLossKeys = 18;

/// The keys of the design file's `[losses]`.
template <std::size_t... I>
RequirementsSection losses(std::index_sequence<I...>) {
  TRUEFLANK_EXPECTS(losses_keys().size() == kLossKeys);
  RequirementsSection section{"losses", {}};
  (section.keys.push_back({losses_keys()[I].rule, set_loss<I>}), ...);
  // The table may be left out; a load it needs is 1 N m then, a speed 0.
  for (auto& key : section.keys)
    if (key.rule.required) {
      key.rule.required = false;
      key.rule.by_default = key.rule.name == std::string_view("load_nm") ? "1" : "0";
    }
  return section;
}

}  // namespace

const std::vector<RequirementsSection>& requirements_sections() {
  static const std::vector<RequirementsSection> kSections{
      top(),   gearbox(), rack(),     ratio(),  teeth(),
      shift(), limits(),  strength(), motor(), search(), losses(std::make_index_sequence<kLossKeys>{})};
  return kSections;
}

const std::vector<RequirementsKey<Material>>& material_keys() {
  using M = Material;
  static const std::vector<RequirementsKey<Material>> kKeys{
      {{.name = "bending_limit_mpa",
        .unit = "MPa",
        .lower = 0.1,
        .upper = 1e4,
        .required = true,
        .meaning = "sigma_Flim, pulsating"},
       [](M& m, const V& v) { return m.bending_limit_mpa = number(v), std::string(); }},
      {{.name = "contact_limit_mpa",
        .unit = "MPa",
        .lower = 0.1,
        .upper = 1e4,
        .required = true,
        .meaning = "sigma_Hlim"},
       [](M& m, const V& v) { return m.contact_limit_mpa = number(v), std::string(); }},
      {{.name = "elastic_modulus_mpa", .unit = "MPa", .lower = 1, .upper = 1e7, .required = true},
       [](M& m, const V& v) { return m.elastic_modulus_mpa = number(v), std::string(); }},
      {{.name = "poisson_ratio", .lower = 0, .upper = 0.5, .required = true},
       [](M& m, const V& v) { return m.poisson_ratio = number(v), std::string(); }},
      {{.name = "density_kg_m3", .unit = "kg/m3", .lower = 1, .upper = 1e5, .required = true},
       [](M& m, const V& v) { return m.density_kg_m3 = number(v), std::string(); }},
      {{.name = "source",
        .type = KeyType::kText,
        .by_default = "empty",
        .meaning = "where the limits come from"},
       [](M& m, const V& v) { return m.source = text(v), std::string(); }}};
  return kKeys;
}

}  // namespace trueflank
