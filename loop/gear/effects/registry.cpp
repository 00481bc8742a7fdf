// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/registry.h"

#include <utility>

#include "trueflank/loop/gear/effects/one_tooth.h"

namespace trueflank::loop {

const std::vector<EffectFamily>& effect_library() {
  using namespace gear_effects;
  // In this order candidates are tried: of two that do the same the earlier one wins.
  static const std::vector<EffectFamily> library = [] {
    std::vector<EffectFamily> all{
        eccentricity(),
        axis_tilt(),
        scale(),
        scale_xy(),
        skew(),
        contour_offset(),
        elephant_foot(),
        layer_shift(),
        tooth_thickness(),
        pressure_angle_error(),
        profile_crowning(),
        tip_relief(),
        helix_error(),
        taper(),
        crowning(),
        flank_twist(),
        flank_wear(),
        pitch_wave(),
        lobing(),
        ghost_order(),
        ghost_order_counted_backwards(),
        single_tooth(),
        unnamed(),
        unnamed_flank(),
        unnamed_tooth_aside(),
        unnamed_step(),
        unnamed_kink(),
        unnamed_bend(),
        unnamed_rise(),
        unnamed_sag(),
        unnamed_fading_jump(),
        unnamed_skewed_band(),
        unnamed_sawtooth(),
        unnamed_arches(),
        unnamed_dish(),
        unnamed_patch(),
        unnamed_corner(),
        unnamed_product(),
        unnamed_band(),
        unnamed_strip(),
        unnamed_waviness(),
        unnamed_waves_mirrored(),
        unnamed_waves_from(),
        unnamed_waves_dying(),
        unnamed_waves_growing(),
        unnamed_waves_burst(),
        unnamed_waves_changing(),
        unnamed_marks(),
        unnamed_scallops(),
        unnamed_walking_waves(),
        unnamed_tooth_form(),
        unnamed_bent_tooth(),
        unnamed_gap(),
        unnamed_swelling_over_teeth(),
        unnamed_sector(),
        unnamed_soft_sector(),
        unnamed_bow(),
        unnamed_axis_kink(),
        unnamed_soft_shift(),
        unnamed_clamping(),
        unnamed_halves(),
        unnamed_field(),
        unnamed_cut_order(),
        unnamed_slip(),
        unnamed_slit(),
        unnamed_arch_around(),
        unnamed_changing_wave(),
        unnamed_stretching_wave(),
        unnamed_plane_wave(),
        unnamed_plane_saw(),
        unnamed_plane_stripes(),
        unnamed_slanted_ridge(),
        unnamed_facing(),
        unnamed_facing_one_side(),
        unnamed_wobble(),
        unnamed_one_side(),
        unnamed_crossed(),
        unnamed_crossed_around(),
        unnamed_crossed_order(),
        unnamed_crossed_waves(),
        unnamed_body_wave(),
        unnamed_body_facing(),
        unnamed_body_place(),
        unnamed_swellings_at_end(),
        unnamed_reversal(),
        unnamed_moved_sector(),
        unnamed_moved_part(),
        unnamed_views(),
        unnamed_spiral(),
        unnamed_alternation(),
        unnamed_ramp(),
        unnamed_levelling(),
        unnamed_drift_of_traces(),
        unnamed_drift_aside(),
        unnamed_broken_wave(),
        unnamed_saw(),
        unnamed_comb(),
        unnamed_sectors(),
        unnamed_pattern(),
        unnamed_stairs(),
        unnamed_drift_of_some(),
        unnamed_wave_of_some(),
        unnamed_dent(),
        unnamed_swellings(),
        unnamed_spot(),
        unnamed_pits(),
        unnamed_bands(),
        unnamed_flight(),
    };
    for (EffectFamily& family : forms_of_teeth()) all.push_back(std::move(family));
    for (EffectFamily& family : all) {
      family.cause = causes_text(family.causes, kAnyMaking);
      if (family.columns) continue;
      const int columns = static_cast<int>(family.parameters.size());
      family.columns = [columns](const EffectShape&) { return columns; };
    }
    return all;
  }();
  return library;
}

}  // namespace trueflank::loop
