// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_requirements.h"

#include <algorithm>
#include <charconv>

#include "trueflank/base/number_text.h"
#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_figures.h"
#include "trueflank/search/search_stages.h"

namespace trueflank {
namespace {

class Text {
 public:
  void add(const char* key, double value) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    text_ += std::string(key) + "=" + std::string(buffer, end) + "\n";
  }
  void add(const char* key, const std::string& value) {
    text_ += std::string(key) + "=" + value + "\n";
  }
  void add(const char* key, const ToothRange& range) {
    add(key, std::to_string(range.min) + ".." + std::to_string(range.max));
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_strength(const StrengthOptions& s, Text& text) {
  text.add("material", s.material);
  for (const auto& [gear, material] : s.material_of) text.add("material_of", gear + ":" + material);
  for (const Material& m : s.materials.all()) {
    text.add("table", m.name);
    for (const double v :
         {m.bending_limit_mpa, m.contact_limit_mpa, m.elastic_modulus_mpa, m.poisson_ratio,
          m.density_kg_m3})
      text.add("value", v);
  }
  for (const double v :
       {s.reversing ? 1.0 : 0.0, s.overload_factor, s.dynamic_factor, s.face_load_factor,
        s.planet_load_factor, s.bending_life_factor, s.contact_life_factor, s.lubrication_factor,
        s.bending_safety, s.contact_safety})
    text.add("factor", v);
}

void check_range(const std::string& name, const ToothRange& range, int least, Errors& errors) {
  if (range.min >= least && range.max >= range.min && range.max <= 1000) return;
  const bool low = range.min < least;
  errors.push_back({.code = ErrorCode::kOutOfRange,
                    .message = "no tooth numbers in this range",
                    .key = "teeth." + name + (low ? "_min" : "_max"),
                    .value = std::to_string(range.min) + " to " + std::to_string(range.max),
                    .remedy = "least " + std::to_string(least) + ", most 1000, in this order"});
}

/// The names of a key that is a list: each known, none twice.
void check_names(const char* key, const std::vector<std::string>& names,
                 const std::vector<std::string>& known, Errors& errors) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool twice = std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                 names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i);
    const bool unknown = std::find(known.begin(), known.end(), names[i]) == known.end();
    if (!twice && !unknown) continue;
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = twice ? "named twice" : "not one of those the kinds have",
                      .key = key,
                      .value = '"' + names[i] + '"',
                      .remedy = "one of " + list + ", or several by commas"});
    return;
  }
}

void check_trains(const SearchRequirements& r, Errors& errors) {
  std::vector<std::string> kinds, outputs, inputs;
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const SearchTrain& train : search_trains()) {
    add(kinds, train.kind());
    if (std::find(r.kinds.begin(), r.kinds.end(), train.kind()) == r.kinds.end()) continue;
    add(outputs, train.output);
    add(inputs, train.input);
  }
  const std::size_t before = errors.size();
  check_names("gearbox.kind", r.kinds, kinds, errors);
  if (errors.size() > before) return;  // what else there is depends on the kinds
  outputs.emplace_back("any");
  inputs.emplace_back("any");
  check_names("gearbox.output", r.outputs, outputs, errors);
  check_names("gearbox.input", r.inputs, inputs, errors);
  for (const SearchTrain* train : searched_trains(r))
    for (const TrainPlace place : train->places()) {
      const std::string& name = train->name_at(place);
      const bool ring = place == TrainPlace::kRing1 || place == TrainPlace::kRing2;
      const bool own = name == "planet" || name == "ring" || name == "pinion" || name == "wheel";
      if (own) check_range(name, tooth_range(r, *train, place), ring ? 6 : 4, errors);
    }
}

void require(bool good, const char* key, double value, const char* message, const char* remedy,
             Errors& errors) {
  if (!good)
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = message,
                      .key = key,
                      .value = trimmed_number(value),
                      .remedy = remedy});
}

}  // namespace

namespace {

/// Figures that need more than the teeth.
void check_figures(const SearchRequirements& r, Errors& errors) {
  const auto asked = [&](SearchObjective figure) {
    return std::count(r.objectives.begin(), r.objectives.end(), figure) > 0 ||
           std::any_of(r.figure_limits.begin(), r.figure_limits.end(),
                       [&](const FigureLimit& limit) { return limit.figure == figure; }) ||
           std::any_of(r.weights.begin(), r.weights.end(),
                       [&](const ObjectiveWeight& w) { return w.objective == figure; });
  };
  const auto missing = [&](const char* key, const char* message, const char* remedy) {
    errors.push_back({.code = ErrorCode::kInconsistent, .message = message, .key = key, .remedy = remedy});
  };
  for (const SearchObjective figure : {SearchObjective::kAcceleration, SearchObjective::kSettling})
    if (asked(figure) && !(r.motor.torque_nm > 0.0))
      return missing("motor.torque_nm", "how the load moves depends on the motor",
                     "the motor's torque above 0, or other objectives and limits");
  if (asked(SearchObjective::kStartingTorque) && !(drag_at_rest_nm(r) > 0.0))
    missing("losses.drag_torque_nm", "without a drag at rest nothing has to be overcome",
            "the torque that turns the input, or other objectives and limits");
  if (r.assembling_share_min > 0.0 && !r.tolerance)
    missing("limits.tolerance_class", "what the parts may be off by is not said",
            "tolerance_class, axis_tolerance_um, thickness_tolerance_um: one or more of them");
  if ((r.face_width_max_mm || r.module_max_mm) && !r.output_torque_nm)
    missing("strength.output_torque_nm", "what width and module have to carry is not said",
            "the torque at the output, or no face_width_max_mm and module_max_mm");
  if (r.module_max_mm && r.outer_diameter_mm)
    missing("gearbox.module_max_mm", "the module follows from outer_diameter_mm",
            "one of both; limits.outer_diameter_max_mm holds a growing module");
}

/// What the teeth's form asks for.
void check_teeth(const SearchRequirements& r, Errors& errors) {
  if (r.helix_angle_rad != 0.0 && r.loss_model == LossModel::kContactRatios)
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = "the formula by contact ratios is one of spur teeth",
                      .key = "search.loss_model",
                      .value = "contact_ratios",
                      .remedy = "path_integral, or no gearbox.helix_angle_deg"});
  if (!r.cutter) return;
  for (const SearchTrain* train : searched_trains(r))
    for (const TrainPlace place : train->places()) {
      if (place != TrainPlace::kRing1 && place != TrainPlace::kRing2) continue;
      const ToothRange range = tooth_range(r, *train, place);
      if (range.max > r.cutter->teeth) continue;
      errors.push_back({.code = ErrorCode::kInconsistent,
                        .message = "no ring of up to " + std::to_string(range.max) +
                                   " teeth can be shaped by it",
                        .key = "cutter.teeth",
                        .value = std::to_string(r.cutter->teeth),
                        .remedy = "fewer teeth than the rings have, or no [cutter]"});
      return;
    }
}

/// Stages in series are optimised each by itself, so the whole is ranked by what they add up to.
void check_stages(const SearchRequirements& r, Errors& errors) {
  const auto& trains = searched_trains(r);
  const auto stage = std::find_if(trains.begin(), trains.end(),
                                  [](const SearchTrain* train) { return train->stage > 0; });
  if (stage == trains.end()) return;
  std::vector<SearchObjective> all = r.objectives;
  for (const ObjectiveWeight& w : r.weights) all.push_back(w.objective);
  const auto refused = std::find_if_not(all.begin(), all.end(), is_of_stages);
  if (refused == all.end()) return;
  errors.push_back({.code = ErrorCode::kInconsistent,
                    .message = "trains of kind " + (*stage)->kind() +
                               " are not ranked by this figure: it is not made of their stages' own",
                    .key = "search.objectives",
                    .value = to_text(*refused),
                    .remedy = "forward, backward, torque, size, mass, length, torque_density, "
                              "contact_ratio or sliding, with [limits] on other figures; or other "
                              "kinds"});
}

}  // namespace

Errors validate(const SearchRequirements& r) {
  Errors errors;
  check_figures(r, errors);
  check_teeth(r, errors);
  require(r.ratio_min > 1.0, "ratio.min", r.ratio_min, "a reducer's ratio is above 1",
          "input speed over output speed, above 1", errors);
  require(r.ratio_max >= r.ratio_min, "ratio.max", r.ratio_max, "the ratio range is empty",
          "not below ratio.min", errors);
  check_trains(r, errors);
  check_stages(r, errors);
  for (auto it = r.planets.begin(); it != r.planets.end(); ++it) {
    if (*it >= 1 && *it <= 20 && std::find(r.planets.begin(), it, *it) == it) continue;
    const bool twice = std::find(r.planets.begin(), it, *it) != it;
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = twice ? "named twice" : "no such planet carrier",
                      .key = "gearbox.planets",
                      .value = std::to_string(*it),
                      .remedy = "1 to 20, each number once"});
    break;
  }
  check_range("sun", r.sun, 4, errors);
  check_range("planet1", r.planet1, 4, errors);
  check_range("ring1", r.ring1, 6, errors);
  check_range("planet2", r.planet2, 4, errors);
  check_range("ring2", r.ring2, 6, errors);
  require(r.shift_max > r.shift_min, "shift.max", r.shift_max, "the shift range is empty",
          "above shift.min", errors);
  require(r.contact_ratio_min >= 1.0, "limits.contact_ratio_min", r.contact_ratio_min,
          "contact would be interrupted", "1 or more", errors);
  require(r.contact_ratio_max > r.contact_ratio_min, "limits.contact_ratio_max",
          r.contact_ratio_max, "the contact ratio range is empty", "above limits.contact_ratio_min",
          errors);
  if (r.output_torque_nm)
    require(*r.output_torque_nm > 0.0, "strength.output_torque_nm", *r.output_torque_nm,
            "no torque to carry", "above 0, or leave it out", errors);
  if (!r.strength.materials.find(r.strength.material))
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = "no material of this name in the table",
                      .key = "strength.material",
                      .value = r.strength.material,
                      .remedy = "a built-in material (docs/strength.md) or one of [materials]"});
  return errors;
}

std::string fingerprint(const SearchRequirements& r) {
  Text text;
  for (const SearchTrain* train : searched_trains(r)) {
    text.add("output", train->output);
    if (train == &usual_search_train() || (train->kind() == "3k" && train->input == "sun"))
      continue;
    text.add("kind", train->kind() + (train->internal_wheel ? "-internal" : ""));
    text.add("input", train->input);
    for (const TrainPlace place : train->places()) text.add("teeth", tooth_range(r, *train, place));
  }
  for (const int planets : r.planets) text.add("planets", planets);
  text.add("friction", r.friction);
  text.add("face_width_mm", r.face_width_mm);
  text.add("backlash_mm", r.backlash_mm.value_or(kNaN));
  text.add("pressure_angle_rad", r.rack.pressure_angle_rad);
  text.add("addendum", r.rack.addendum);
  text.add("dedendum", r.rack.dedendum);
  text.add("root_radius", r.rack.root_radius);
  if (r.helix_angle_rad != 0.0) text.add("helix_angle_rad", r.helix_angle_rad);
  if (r.cutter) {
    text.add("cutter", r.cutter->teeth);
    text.add("cutter", r.cutter->shift);
    text.add("cutter", r.cutter->tip_radius);
  }
  text.add("module_mm", r.module_mm);
  text.add("outer_diameter_mm", r.outer_diameter_mm.value_or(kNaN));
  text.add("rim", r.rim);
  for (const double ratio : r.layer2_module_ratios) text.add("layer2_module_ratio", ratio);
  text.add("ratio_min", r.ratio_min);
  text.add("ratio_max", r.ratio_max);
  text.add("direction", static_cast<int>(r.direction));
  text.add("sun", r.sun);
  text.add("planet1", r.planet1);
  text.add("ring1", r.ring1);
  text.add("planet2", r.planet2);
  text.add("ring2", r.ring2);
  text.add("identical_planets", r.identical_planets ? 1.0 : 0.0);
  text.add("shift_min", r.shift_min);
  text.add("shift_max", r.shift_max);
  text.add("contact_ratio_min", r.contact_ratio_min);
  text.add("contact_ratio_max", r.contact_ratio_max);
  text.add("clearance_um", r.clearance_um);
  text.add("tip_clearance", r.tip_clearance);
  text.add("tip_thickness", r.tip_thickness);
  text.add("planet_clearance_mm", r.planet_clearance_mm);
  text.add("output_torque_nm", r.output_torque_nm.value_or(kNaN));
  text.add("face_width_max_mm", r.face_width_max_mm.value_or(kNaN));
  text.add("module_max_mm", r.module_max_mm.value_or(kNaN));
  for (const FigureLimit& limit : r.figure_limits) text.add(to_text(limit.figure), limit.value);
  for (const ObjectiveWeight& w : r.weights)
    text.add("weight", to_text(w.objective) + (":" + printed_number(w.weight, "%f")));
  text.add("hunting", r.hunting ? 1.0 : 0.0);
  text.add("sequential", r.sequential ? 1.0 : 0.0);
  text.add("assembling_share_min", r.assembling_share_min);
  if (r.tolerance) {
    text.add("tolerance_class", r.tolerance->tolerance_class.value_or(0));
    text.add("tolerance", r.tolerance->centre_distance_um);
    text.add("tolerance", r.tolerance->tooth_thickness_um);
  }
  for (const double value : {r.motor.torque_nm, r.motor.speed_rpm, r.motor.rotor_kg_m2,
                             r.motor.load_kg_m2, r.motor.load_nm, r.motor.move_rad})
    text.add("motor", value);
  text.add("loss_model", static_cast<int>(r.loss_model));
  if (r.losses) {
    const LossesDesign& l = *r.losses;
    for (const double value :
         {l.load_nm, l.input_speed_rpm, l.temperature_c.value_or(kNaN), l.reference_c,
          l.drag_torque_nm, l.drag_per_c, l.viscous_nm_per_rpm, l.viscous_per_c,
          l.bearing_nm_at_1000_rpm, l.bearing_load_share, l.stribeck_torque_nm,
          l.stribeck_speed_rpm, l.backward_friction.value_or(kNaN), l.load_friction,
          l.load_friction_exponent, l.load_friction_reference_nm, l.mixed_friction,
          l.mixed_friction_speed_rpm})
      text.add("loss", value);
  }
  for (const SearchObjective objective : r.objectives) text.add("objective", to_text(objective));
  text.add("listed", static_cast<double>(std::max(r.listed, r.listed > 0 ? r.results : 0)));
  add_strength(r.strength, text);
  return text.take();
}

}  // namespace trueflank
