// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/flank_limits.h"

#include <nlohmann/json.hpp>

#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank::io {

std::string flank_limits_json_text(const TrainGear& gear) {
  const ToleranceSize size = tolerance_size(gear.profile.gear(), gear.face_width_mm);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["scope"] = nullptr;
  json["classes"] = nlohmann::ordered_json::object();
  for (int k = kFinestToleranceClass; k <= kCoarsestToleranceClass; ++k) {
    const auto limits = flank_tolerances(size, k);
    if (!limits) {
      json["scope"] = limits.error().message + "; " + limits.error().remedy;
      break;
    }
    json["classes"][std::to_string(k)] = {
        {"f_p", limits->single_pitch_um},   {"F_p", limits->total_cumulative_pitch_um},
        {"f_Ha", limits->profile_slope_um}, {"f_fa", limits->profile_form_um},
        {"F_a", limits->total_profile_um},  {"f_Hb", limits->helix_slope_um},
        {"f_fb", limits->helix_form_um},    {"F_b", limits->total_helix_um},
        {"F_r", limits->runout_um}};
  }
  return json.dump();
}

}  // namespace trueflank::io
