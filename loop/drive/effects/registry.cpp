// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop {

const std::vector<DriveFamily>& drive_library() {
  using namespace drive_effects;
  // In this order candidates are tried: of two that do the same the earlier one wins.
  static const std::vector<DriveFamily> library = [] {
    std::vector<DriveFamily> all{
        friction_coefficient(),
        drag_torque(),
        viscous_drag(),
        bearing_friction(),
        bearing_load_friction(),
        stribeck_friction(),
        mixed_friction(),
        load_dependent_friction(),
        load_loss(),
        temperature_viscosity(),
        temperature_drag(),
        direction_dependent_friction(),
        mesh_friction(),
        angle_periodic_friction(),
        torque_scale(),
        input_torque_offset(),
        output_torque_offset(),
        input_torque_wave(),
        output_torque_wave(),
        direction_dependent_drag(),
        input_torque_drift(),
        output_torque_drift(),
        drag_drift(),
        friction_drift(),
        unnamed_form(),
        unnamed_course(),
        unnamed_step(),
        unnamed_hump(),
        unnamed_onset(),
        unnamed_change(),
        unnamed_reading_change(),
        unnamed_gain_drift(),
        unnamed_drift(),
        unnamed_spell(),
        unnamed_bump(),
        unnamed_hysteresis(),
        unnamed_play(),
        unnamed_way(),
        unnamed_after_rest(),
        unnamed_wander(),
        unnamed_product(),
        unnamed_flanks_slope(),
        unnamed_reading_slope(),
        unnamed_settling(),
        unnamed_bend(),
        unnamed_reading_power(),
        unnamed_reading_near_zero(),
        unnamed_gain_slope(),
        unnamed_angle_course(),
        unnamed_power(),
        unnamed_root(),
        unnamed_states(),
        unnamed_reading_of_load(),
        unnamed_reading_by_direction(),
        unnamed_reading_step(),
        unnamed_reading_hump(),
        unnamed_reading_onset(),
        unnamed_power_onset(),
        unnamed_wave(),
        unnamed_part_wave(),
        unnamed_resonant_wave(),
        unnamed_coordinate_wave(),
        unnamed_reading_coordinate_wave(),
        unnamed_sawtooth(),
        unnamed_reading_sawtooth(),
        unnamed_valley(),
        unnamed_saturating(),
        unnamed_gain_of_range(),
        unnamed_rows_by_turns(),
        unnamed_reading_by_turns(),
        unnamed_block(),
        unnamed_reading_block(),
        unnamed_row_sawtooth(),
        unnamed_reading_row_sawtooth(),
        unnamed_levels(),
        unnamed_reading_levels(),
        unnamed_corner(),
        unnamed_reading_corner(),
        unnamed_reading_in_steps(),
        unnamed_fade(),
        unnamed_log_onset(),
        unnamed_moving_hump(),
        unnamed_cusps(),
        unnamed_plateau(),
        unnamed_two_steps(),
        unnamed_bow(),
        unnamed_reading_bow(),
        unnamed_band(),
        unnamed_reading_band(),
        unnamed_switched(),
        unnamed_reading_switched(),
        unnamed_lag(),
        unnamed_hersey(),
    };
    for (DriveFamily& family : all) {
      family.shape_values.resize(family.shape_names.size());
      if (family.columns) continue;
      const int columns = static_cast<int>(family.parameters.size());
      family.columns = [columns](const DriveShape&) { return columns; };
    }
    return all;
  }();
  return library;
}

}  // namespace trueflank::loop
