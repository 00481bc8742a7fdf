// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/gear_table.h"

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "trueflank/export/number_text.h"
#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// Of a column. Inches have a place more: a hundred-thousandth is a quarter of a micrometre.
enum class Unit { kMillimetre, kInch };

/// The value of one gear in one row; empty: the row says nothing of it.
using Cell = std::function<std::string(const TrainGear&, const Json&)>;
/// The same of a length.
using LengthCell = std::function<std::string(const TrainGear&, const Json&, Unit)>;

std::string length_text(double value_mm, int decimals, Unit unit) {
  return unit == Unit::kInch ? drawing_number(value_mm / 25.4, decimals + 1)
                             : drawing_number(value_mm, decimals);
}

std::string length_of(const Json& gear, const char* key, int decimals, Unit unit) {
  const Json& value = gear.at(key);
  return value.is_number() ? length_text(value.get<double>(), decimals, unit) : std::string();
}

Cell number(const char* key, int decimals) {
  return [key, decimals](const TrainGear&, const Json& gear) {
    return length_of(gear, key, decimals, Unit::kMillimetre);
  };
}

LengthCell length(const char* key, int decimals) {
  return [key, decimals](const TrainGear&, const Json& gear, Unit unit) {
    return length_of(gear, key, decimals, unit);
  };
}

/// Limits of a gear's thickness: the design's allowance, else what the process holds; null: none
/// are known.
Json thickness_limits(const Json& report, const std::string& gear) {
  const Json& allowance = report.at("gears").at(gear).at("thickness_allowance");
  if (!allowance.is_null() || !report.contains("parts")) return allowance;
  for (const Json& part : report.at("parts"))
    if (part.at("flanks").contains(gear)) return part.at("flanks").at(gear);
  return nullptr;
}

/// A size with its limits where they are known.
LengthCell with_limits(const Json& report, const char* key, const char* least, const char* most) {
  return [=, &report](const TrainGear& g, const Json& gear, Unit unit) {
    std::string text = length_of(gear, key, 3, unit);
    if (text.empty()) return text;
    const Json limits = thickness_limits(report, g.name);
    if (limits.is_null() || !limits.at(least).is_number()) return text;
    return length_of(limits, least, 3, unit) + " .. " + length_of(limits, most, 3, unit);
  };
}

std::string helix(const TrainGear&, const Json& gear) {
  const double angle = gear.at("helix_angle_deg").get<double>();
  if (angle == 0.0) return "0";
  return drawing_number(std::abs(angle), 4) + " " + gear.at("hand").get<std::string>();
}

std::string rack_text(const TrainGear& gear, const Json&) {
  const BasicRack& rack = gear.profile.gear().rack;
  return drawing_number(rack.addendum, 3) + " / " + drawing_number(rack.dedendum, 3) + " / " +
         drawing_number(gear.profile.root_radius_coefficient(), 3);
}

std::string diametral_pitch(const TrainGear&, const Json& gear) {
  return drawing_number(25.4 / gear.at("normal_module_mm").get<double>(), 4);
}

Result<FlankTolerances> flank_limits(const TrainGear& gear, int tolerance_class) {
  return flank_tolerances(tolerance_size(gear.profile.gear(), gear.face_width_mm), tolerance_class);
}

/// Flank tolerances, or nothing.
LengthCell tolerance(int tolerance_class, double FlankTolerances::*value) {
  return [=](const TrainGear& gear, const Json&, Unit unit) {
    const auto tolerances = flank_limits(gear, tolerance_class);
    return tolerances ? length_text(1e-3 * (*tolerances).*value, 4, unit) : std::string();
  };
}

/// What a process holds of the teeth, of those without a class the runout too.
void add_held(const std::function<void(const char*, const char*, const LengthCell&)>& add_length,
              const Workmanship& made) {
  const auto held = [](double value_mm) {
    return [value_mm](const TrainGear&, const Json&, Unit unit) {
      return std::isnan(value_mm) ? std::string() : length_text(value_mm, 4, unit);
    };
  };
  add_length("Tooth thickness on d holds", "±", held(made.thickness_mm));
  if (made.flank_class == 0) add_length("Runout", "F_r", held(made.runout_mm));
}

/// The meshes of a gear, in the order of the train.
std::vector<const TrainMesh*> meshes_of(const GearTrain& train, const TrainGear& gear) {
  std::vector<const TrainMesh*> meshes;
  for (const TrainMesh& mesh : train.meshes)
    if (&train.gears[static_cast<std::size_t>(mesh.gear1)] == &gear ||
        &train.gears[static_cast<std::size_t>(mesh.gear2)] == &gear)
      meshes.push_back(&mesh);
  return meshes;
}

std::string mate_text(const GearTrain& train, const TrainMesh& mesh, const TrainGear& gear) {
  const TrainGear& gear1 = train.gears[static_cast<std::size_t>(mesh.gear1)];
  const TrainGear& mate =
      &gear1 == &gear ? train.gears[static_cast<std::size_t>(mesh.gear2)] : gear1;
  return mate.name + ", z " + std::to_string(mate.profile.gear().teeth);
}

}  // namespace

std::vector<GearTableRow> gear_table(const GearTrain& train,
                                     const std::vector<const TrainGear*>& gears,
                                     const Json& report) {
  std::vector<GearTableRow> rows;
  const Workmanship made = workmanship(train);
  const int tolerance_class = made.flank_class;
  // the form of AGMA: a design in inches has a column of them beside each of millimetres
  std::vector<Unit> units = {Unit::kMillimetre};
  if (report.contains("inches")) units.push_back(Unit::kInch);
  const auto add_length = [&](const char* name, const char* symbol, const LengthCell& cell) {
    GearTableRow row{name, symbol, {}};
    bool says = false;
    for (const TrainGear* gear : gears)
      for (Unit unit : units) {
        row.values.push_back(cell(*gear, report.at("gears").at(gear->name), unit));
        says = says || !row.values.back().empty();
      }
    if (says) rows.push_back(std::move(row));
  };
  const auto add = [&](const char* name, const char* symbol, const Cell& cell) {
    add_length(name, symbol, [&](const TrainGear& gear, const Json& json, Unit unit) {
      return unit == Unit::kInch ? std::string() : cell(gear, json);
    });
  };
  add_length("Gear", "", [&](const TrainGear& g, const Json&, Unit unit) {
    return g.name + (units.size() == 1 ? "" : unit == Unit::kInch ? ", in" : ", mm");
  });
  add("Number of teeth", "z", number("teeth", 0));
  add("Normal module", "m_n", number("normal_module_mm", 6));
  add("Normal diametral pitch", "P_nd", diametral_pitch);
  add("Normal pressure angle, deg", "α_n", number("normal_pressure_angle_deg", 4));
  add("Helix angle, deg", "β", helix);
  add("Rack addendum/dedendum/radius", "of m_n", rack_text);
  add("Profile shift coefficient", "x", number("shift", 5));
  add_length("Reference diameter", "d", length("reference_diameter_mm", 4));
  add_length("Base diameter", "d_b", length("base_diameter_mm", 4));
  add_length("Tip diameter", "d_a", length("tip_diameter_mm", 4));
  add_length("Root diameter", "d_f", length("root_diameter_mm", 4));
  add_length("Root form diameter", "d_Ff", length("root_form_diameter_mm", 4));
  add_length("Start of active profile", "d_Nf", length("start_active_profile_diameter_mm", 4));
  add_length("Thickness on d, transverse", "s_t", length("reference_thickness_mm", 4));
  add("Teeth spanned", "k", number("span_teeth", 0));
  add_length("Base tangent length", "W_k",
             with_limits(report, "span_mm", "span_min_mm", "span_max_mm"));
  add_length("Pin or ball diameter", "D_M", length("pin_diameter_mm", 3));
  add_length("Over or between pins", "M_d",
             with_limits(report, "over_pins_mm", "over_pins_min_mm", "over_pins_max_mm"));
  add_length("Face width", "b", length("face_width_mm", 3));
  add_length("Lead", "p_z", length("lead_mm", 4));
  add_length("Centre distance", "a", [&](const TrainGear& g, const Json&, Unit unit) {
    const auto meshes = meshes_of(train, g);
    return meshes.empty() ? std::string() : length_text(meshes.front()->centre_distance_mm, 4, unit);
  });
  for (std::size_t i = 0;; ++i) {
    const std::size_t before = rows.size();
    add("Mating gear", "", [&](const TrainGear& g, const Json&) {
      const auto meshes = meshes_of(train, g);
      return i < meshes.size() ? mate_text(train, *meshes[i], g) : std::string();
    });
    add_length("Circumferential backlash with it", "j_wt",
               [&](const TrainGear& g, const Json&, Unit unit) {
                 const auto meshes = meshes_of(train, g);
                 return i < meshes.size() ? length_of(report.at("meshes").at(meshes[i]->name),
                                                      "backlash_mm", 4, unit)
                                          : std::string();
               });
    if (rows.size() == before) break;
  }
  add("Flank tolerance class", "ISO 1328-1", [&](const TrainGear& g, const Json&) {
    if (tolerance_class == 0) return "none, " + made.process;
    return flank_limits(g, tolerance_class) ? std::to_string(tolerance_class)
                                            : std::string("outside its scope");
  });
  add_length("Single pitch", "±f_pT",
             tolerance(tolerance_class, &FlankTolerances::single_pitch_um));
  add_length("Cumulative pitch", "F_pT",
             tolerance(tolerance_class, &FlankTolerances::total_cumulative_pitch_um));
  add_length("Profile slope", "±f_HαT",
             tolerance(tolerance_class, &FlankTolerances::profile_slope_um));
  add_length("Profile form", "f_fαT",
             tolerance(tolerance_class, &FlankTolerances::profile_form_um));
  add_length("Total profile", "F_αT",
             tolerance(tolerance_class, &FlankTolerances::total_profile_um));
  add_length("Helix slope", "±f_HβT", tolerance(tolerance_class, &FlankTolerances::helix_slope_um));
  add_length("Helix form", "f_fβT", tolerance(tolerance_class, &FlankTolerances::helix_form_um));
  add_length("Total helix", "F_βT", tolerance(tolerance_class, &FlankTolerances::total_helix_um));
  add_length("Runout", "F_rT", tolerance(tolerance_class, &FlankTolerances::runout_um));
  add_held(add_length, made);
  add("Flank surface, Ra in µm", "ISO 21920",
      [&](const TrainGear& g, const Json&) { return flank_surface_text(g, made); });
  return rows;
}

}  // namespace trueflank::io
