// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/effect.h"

// The effects of a gear: a source each. A new one is a source, a line here and one in registry.cpp.
namespace trueflank::loop::gear_effects {

/// @name Move the tooth system or all walls
/// @{
[[nodiscard]] EffectFamily eccentricity();
[[nodiscard]] EffectFamily axis_tilt();
[[nodiscard]] EffectFamily scale();
[[nodiscard]] EffectFamily scale_xy();
[[nodiscard]] EffectFamily skew();
[[nodiscard]] EffectFamily contour_offset();
[[nodiscard]] EffectFamily elephant_foot();
[[nodiscard]] EffectFamily layer_shift();
/// @}

/// @name Shape every flank alike
/// @{
[[nodiscard]] EffectFamily tooth_thickness();
[[nodiscard]] EffectFamily pressure_angle_error();
[[nodiscard]] EffectFamily profile_crowning();
[[nodiscard]] EffectFamily tip_relief();
[[nodiscard]] EffectFamily helix_error();
[[nodiscard]] EffectFamily taper();
[[nodiscard]] EffectFamily crowning();
[[nodiscard]] EffectFamily flank_twist();
[[nodiscard]] EffectFamily flank_wear();
/// @}

/// @name Vary around the gear
/// @{
[[nodiscard]] EffectFamily pitch_wave();
[[nodiscard]] EffectFamily lobing();
[[nodiscard]] EffectFamily ghost_order();
/// The highest order among the candidates.
[[nodiscard]] int most_ghost_order(const FlankGeometry& geometry);
/// The lowest order of which so many waves lie over the profile: of half a wave it shows a slope.
[[nodiscard]] double lowest_order_with(double waves, const FlankGeometry& geometry);
/// Length along the profile for a length of roll there, near a place of that roll [mm a mm].
[[nodiscard]] double along_profile(const FlankGeometry& geometry, double roll_mm);
[[nodiscard]] EffectFamily ghost_order_counted_backwards();
[[nodiscard]] EffectFamily single_tooth();
/// @}

/// @name Described, not explained
/// @{
[[nodiscard]] EffectFamily unnamed();
[[nodiscard]] EffectFamily unnamed_flank();
[[nodiscard]] EffectFamily unnamed_tooth_form();
/// Forms along the flanks, each on some neighbouring teeth only.
[[nodiscard]] std::vector<EffectFamily> forms_of_teeth();
/// The family of a form on some teeth; nullptr where there is none.
[[nodiscard]] const EffectFamily* of_teeth(const Effect& form);
/// The same form on the other teeth, for one that a run of neighbouring teeth has; none of other
/// forms, and where one tooth or none would be left.
[[nodiscard]] std::optional<Effect> on_the_other_teeth(const FlankGeometry& geometry,
                                                       const Effect& form);
/// True of such a form.
[[nodiscard]] bool is_of_teeth(const Effect& form);
[[nodiscard]] EffectFamily unnamed_step();
[[nodiscard]] EffectFamily unnamed_kink();
[[nodiscard]] EffectFamily unnamed_bend();
[[nodiscard]] EffectFamily unnamed_rise();
[[nodiscard]] EffectFamily unnamed_sag();
[[nodiscard]] EffectFamily unnamed_fading_jump();
[[nodiscard]] EffectFamily unnamed_skewed_band();
[[nodiscard]] EffectFamily unnamed_sawtooth();
[[nodiscard]] EffectFamily unnamed_arches();
[[nodiscard]] EffectFamily unnamed_bands();
[[nodiscard]] EffectFamily unnamed_flight();
[[nodiscard]] EffectFamily unnamed_dish();
[[nodiscard]] EffectFamily unnamed_patch();
[[nodiscard]] EffectFamily unnamed_corner();
[[nodiscard]] EffectFamily unnamed_product();
[[nodiscard]] EffectFamily unnamed_crossed();
/// True of a product of polynomials, or of what is near to them: it grows over profile and face.
[[nodiscard]] bool is_product_of_polynomials(const FlankGeometry& geometry, const Effect& form);
[[nodiscard]] EffectFamily unnamed_crossed_around();
/// True of one that one tooth in so many has.
[[nodiscard]] bool is_of_a_comb(const Effect& form);
/// A slope or a bow of one tooth in so many as unnamed_comb; others as they are.
[[nodiscard]] Effect as_plain_comb(const FlankGeometry& geometry, const Effect& form);
[[nodiscard]] EffectFamily unnamed_crossed_order();
[[nodiscard]] EffectFamily unnamed_crossed_waves();
[[nodiscard]] EffectFamily unnamed_band();
[[nodiscard]] EffectFamily unnamed_strip();
[[nodiscard]] EffectFamily unnamed_waviness();
[[nodiscard]] EffectFamily unnamed_waves_mirrored();
[[nodiscard]] EffectFamily unnamed_waves_from();
[[nodiscard]] EffectFamily unnamed_waves_dying();
[[nodiscard]] EffectFamily unnamed_waves_growing();
[[nodiscard]] EffectFamily unnamed_waves_burst();
[[nodiscard]] EffectFamily unnamed_waves_changing();
[[nodiscard]] EffectFamily unnamed_marks();
[[nodiscard]] EffectFamily unnamed_scallops();
[[nodiscard]] EffectFamily unnamed_walking_waves();
[[nodiscard]] EffectFamily unnamed_sector();
/// Teeth that stand out or aside, which begins and ends over some teeth: told in place of a sector
/// and of what stands at its edges, and no candidate of its own.
[[nodiscard]] EffectFamily unnamed_soft_sector();
[[nodiscard]] EffectFamily unnamed_bow();
[[nodiscard]] EffectFamily unnamed_axis_kink();
[[nodiscard]] EffectFamily unnamed_soft_shift();
[[nodiscard]] EffectFamily unnamed_clamping();
[[nodiscard]] EffectFamily unnamed_halves();
[[nodiscard]] EffectFamily unnamed_field();
[[nodiscard]] EffectFamily unnamed_cut_order();
[[nodiscard]] EffectFamily unnamed_slip();
[[nodiscard]] EffectFamily unnamed_slit();
[[nodiscard]] EffectFamily unnamed_arch_around();
/// True where steps of so many teeth come to every tooth before they come around.
[[nodiscard]] bool can_be_cut_in_steps(int teeth, int step);
[[nodiscard]] EffectFamily unnamed_changing_wave();
[[nodiscard]] EffectFamily unnamed_stretching_wave();
[[nodiscard]] EffectFamily unnamed_plane_wave();
[[nodiscard]] EffectFamily unnamed_plane_saw();
/// Waves of the plane in any direction, along the normals.
[[nodiscard]] EffectFamily unnamed_plane_stripes();
[[nodiscard]] EffectFamily unnamed_slanted_ridge();
[[nodiscard]] EffectFamily unnamed_facing();
[[nodiscard]] EffectFamily unnamed_facing_one_side();
[[nodiscard]] EffectFamily unnamed_wobble();
[[nodiscard]] EffectFamily unnamed_one_side();
[[nodiscard]] EffectFamily unnamed_body_wave();
[[nodiscard]] EffectFamily unnamed_body_facing();
[[nodiscard]] EffectFamily unnamed_body_place();
[[nodiscard]] EffectFamily unnamed_swellings_at_end();
[[nodiscard]] EffectFamily unnamed_reversal();
[[nodiscard]] EffectFamily unnamed_moved_sector();
[[nodiscard]] EffectFamily unnamed_moved_part();
[[nodiscard]] EffectFamily unnamed_views();
[[nodiscard]] EffectFamily unnamed_spiral();
[[nodiscard]] EffectFamily unnamed_alternation();
[[nodiscard]] EffectFamily unnamed_ramp();
[[nodiscard]] EffectFamily unnamed_levelling();
[[nodiscard]] EffectFamily unnamed_drift_of_traces();
[[nodiscard]] EffectFamily unnamed_drift_aside();
[[nodiscard]] EffectFamily unnamed_broken_wave();
[[nodiscard]] EffectFamily unnamed_saw();
[[nodiscard]] EffectFamily unnamed_sectors();
[[nodiscard]] EffectFamily unnamed_comb();
[[nodiscard]] EffectFamily unnamed_pattern();
[[nodiscard]] EffectFamily unnamed_stairs();
[[nodiscard]] EffectFamily unnamed_drift_of_some();
[[nodiscard]] EffectFamily unnamed_wave_of_some();
[[nodiscard]] EffectFamily unnamed_dent();
[[nodiscard]] EffectFamily unnamed_swellings();
[[nodiscard]] EffectFamily unnamed_spot();
[[nodiscard]] EffectFamily unnamed_pits();
/// @}

/// All of unnamed_product, to choose from.
[[nodiscard]] std::vector<Effect> products(FlankChoice flank);
/// Waves of about a length that do not run over the whole flank alike, to start from.
[[nodiscard]] std::vector<Effect> parts_of_waves(const FlankGeometry& geometry, double face,
                                                 FlankChoice flank, double wavelength_mm);

}  // namespace trueflank::loop::gear_effects
