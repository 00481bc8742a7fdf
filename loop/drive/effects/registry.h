// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/drive/drive_effect.h"

// The effects of a drive: a source each. A new one is a source, a line here and one in registry.cpp.
namespace trueflank::loop::drive_effects {

/// @name Take power
/// @{
[[nodiscard]] DriveFamily friction_coefficient();
[[nodiscard]] DriveFamily drag_torque();
[[nodiscard]] DriveFamily viscous_drag();
[[nodiscard]] DriveFamily bearing_friction();
[[nodiscard]] DriveFamily bearing_load_friction();
[[nodiscard]] DriveFamily stribeck_friction();
[[nodiscard]] DriveFamily mixed_friction();
[[nodiscard]] DriveFamily load_dependent_friction();
[[nodiscard]] DriveFamily load_loss();
[[nodiscard]] DriveFamily temperature_viscosity();
[[nodiscard]] DriveFamily temperature_drag();
[[nodiscard]] DriveFamily direction_dependent_friction();
[[nodiscard]] DriveFamily mesh_friction();
[[nodiscard]] DriveFamily angle_periodic_friction();
/// @}

/// @name Are the bench's, or look like it
/// @{
[[nodiscard]] DriveFamily torque_scale();
[[nodiscard]] DriveFamily input_torque_offset();
[[nodiscard]] DriveFamily output_torque_offset();
[[nodiscard]] DriveFamily input_torque_wave();
[[nodiscard]] DriveFamily output_torque_wave();
[[nodiscard]] DriveFamily direction_dependent_drag();
[[nodiscard]] DriveFamily input_torque_drift();
[[nodiscard]] DriveFamily output_torque_drift();
[[nodiscard]] DriveFamily drag_drift();
[[nodiscard]] DriveFamily friction_drift();
/// @}

/// @name Described, not explained
/// @{
[[nodiscard]] DriveFamily unnamed_form();
[[nodiscard]] DriveFamily unnamed_course();
[[nodiscard]] DriveFamily unnamed_step();
[[nodiscard]] DriveFamily unnamed_hump();
[[nodiscard]] DriveFamily unnamed_onset();
[[nodiscard]] DriveFamily unnamed_reading_step();
[[nodiscard]] DriveFamily unnamed_reading_hump();
[[nodiscard]] DriveFamily unnamed_reading_onset();
[[nodiscard]] DriveFamily unnamed_change();
[[nodiscard]] DriveFamily unnamed_reading_change();
[[nodiscard]] DriveFamily unnamed_gain_drift();
[[nodiscard]] DriveFamily unnamed_drift();
[[nodiscard]] DriveFamily unnamed_spell();
[[nodiscard]] DriveFamily unnamed_bump();
[[nodiscard]] DriveFamily unnamed_hysteresis();
[[nodiscard]] DriveFamily unnamed_play();
[[nodiscard]] DriveFamily unnamed_way();
[[nodiscard]] DriveFamily unnamed_after_rest();
[[nodiscard]] DriveFamily unnamed_wander();
[[nodiscard]] DriveFamily unnamed_product();
[[nodiscard]] DriveFamily unnamed_flanks_slope();
[[nodiscard]] DriveFamily unnamed_reading_slope();
[[nodiscard]] DriveFamily unnamed_settling();
[[nodiscard]] DriveFamily unnamed_bend();
[[nodiscard]] DriveFamily unnamed_reading_of_load();
[[nodiscard]] DriveFamily unnamed_reading_bow_of_load();
[[nodiscard]] DriveFamily unnamed_reading_by_direction();
[[nodiscard]] DriveFamily unnamed_viscous_slope();
[[nodiscard]] DriveFamily unnamed_growth();
[[nodiscard]] DriveFamily unnamed_cap();
[[nodiscard]] DriveFamily unnamed_floor();
[[nodiscard]] DriveFamily unnamed_friction_by_speed();
[[nodiscard]] DriveFamily unnamed_warm_growth();
[[nodiscard]] DriveFamily unnamed_backlash();
[[nodiscard]] DriveFamily unnamed_one_direction();
[[nodiscard]] DriveFamily unnamed_fading_one_direction();
[[nodiscard]] DriveFamily unnamed_reading_power();
[[nodiscard]] DriveFamily unnamed_reading_near_zero();
[[nodiscard]] DriveFamily unnamed_gain_slope();
[[nodiscard]] DriveFamily unnamed_angle_course();
[[nodiscard]] DriveFamily unnamed_power();
[[nodiscard]] DriveFamily unnamed_root();
[[nodiscard]] DriveFamily unnamed_power_onset();
[[nodiscard]] DriveFamily unnamed_wave();
[[nodiscard]] DriveFamily unnamed_part_wave();
[[nodiscard]] DriveFamily unnamed_resonant_wave();
[[nodiscard]] DriveFamily unnamed_states();
[[nodiscard]] DriveFamily unnamed_coordinate_wave();
[[nodiscard]] DriveFamily unnamed_reading_coordinate_wave();
[[nodiscard]] DriveFamily unnamed_sawtooth();
[[nodiscard]] DriveFamily unnamed_reading_sawtooth();
[[nodiscard]] DriveFamily unnamed_valley();
[[nodiscard]] DriveFamily unnamed_saturating();
[[nodiscard]] DriveFamily unnamed_gain_of_range();
[[nodiscard]] DriveFamily unnamed_rows_by_turns();
[[nodiscard]] DriveFamily unnamed_reading_by_turns();
[[nodiscard]] DriveFamily unnamed_block();
[[nodiscard]] DriveFamily unnamed_reading_block();
[[nodiscard]] DriveFamily unnamed_row_sawtooth();
[[nodiscard]] DriveFamily unnamed_reading_row_sawtooth();
[[nodiscard]] DriveFamily unnamed_levels();
[[nodiscard]] DriveFamily unnamed_reading_levels();
[[nodiscard]] DriveFamily unnamed_corner();
[[nodiscard]] DriveFamily unnamed_reading_corner();
[[nodiscard]] DriveFamily unnamed_reading_in_steps();
[[nodiscard]] DriveFamily unnamed_fade();
[[nodiscard]] DriveFamily unnamed_log_onset();
[[nodiscard]] DriveFamily unnamed_moving_hump();
[[nodiscard]] DriveFamily unnamed_cusps();
[[nodiscard]] DriveFamily unnamed_plateau();
[[nodiscard]] DriveFamily unnamed_two_steps();
[[nodiscard]] DriveFamily unnamed_bow();
[[nodiscard]] DriveFamily unnamed_reading_bow();
[[nodiscard]] DriveFamily unnamed_band();
[[nodiscard]] DriveFamily unnamed_reading_band();
[[nodiscard]] DriveFamily unnamed_switched();
[[nodiscard]] DriveFamily unnamed_reading_switched();
[[nodiscard]] DriveFamily unnamed_lag();
[[nodiscard]] DriveFamily unnamed_hersey();
[[nodiscard]] DriveFamily unnamed_by_file();
[[nodiscard]] DriveFamily unnamed_less_by_file();
[[nodiscard]] DriveFamily unnamed_reading_by_file();
[[nodiscard]] DriveFamily unnamed_pits();
[[nodiscard]] DriveFamily unnamed_waves_of_the_run();
[[nodiscard]] DriveFamily unnamed_changing_waves_of_the_run();
[[nodiscard]] DriveFamily unnamed_first_rows();
[[nodiscard]] DriveFamily unnamed_left_behind();
[[nodiscard]] DriveFamily unnamed_late_wave();
[[nodiscard]] DriveFamily unnamed_turned_wave();
[[nodiscard]] DriveFamily unnamed_starts();
[[nodiscard]] DriveFamily unnamed_late_column();
[[nodiscard]] DriveFamily unnamed_memory();
[[nodiscard]] DriveFamily unnamed_reading_memory();
/// @}

}  // namespace trueflank::loop::drive_effects
