// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_sections.h"

namespace trueflank::requirements {
namespace {

template <SearchObjective kFigure>
std::string set_figure_limit(R& r, const V& v) {
  r.figure_limits.push_back({kFigure, number(v)});
  return "";
}

SearchTolerance& tolerance_of(R& r) {
  if (!r.tolerance) r.tolerance.emplace();
  return *r.tolerance;
}

KeyRule figure_rule(const char* name, const char* unit, double upper, const char* meaning) {
  return {.name = name, .unit = unit, .lower = 0, .upper = upper, .by_default = "none", .meaning = meaning};
}

}  // namespace

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

}  // namespace trueflank::requirements
