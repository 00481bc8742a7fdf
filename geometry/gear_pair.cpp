// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/gear_pair.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

/// z1 + z2 or z2 - z1.
double tooth_sum(const MeshTeeth& mesh) {
  return mesh.internal ? mesh.teeth2 - mesh.teeth1 : mesh.teeth1 + mesh.teeth2;
}

}  // namespace

double transverse_pressure_angle_rad(const MeshTeeth& mesh) {
  return std::atan(std::tan(mesh.pressure_angle_rad) / std::cos(mesh.helix_angle_rad));
}

double reference_centre_distance_mm(const MeshTeeth& mesh) {
  return 0.5 * tooth_sum(mesh) * mesh.normal_module_mm / std::cos(mesh.helix_angle_rad);
}

Result<double> working_pressure_angle_rad(const MeshTeeth& mesh, double centre_distance_mm) {
  const double cosine = reference_centre_distance_mm(mesh) *
                        std::cos(transverse_pressure_angle_rad(mesh)) / centre_distance_mm;
  if (!(cosine > 0.0 && cosine < 1.0))
    return fail({.code = ErrorCode::kInfeasible,
                 .message = "teeth " + std::to_string(mesh.teeth1) + " and " +
                            std::to_string(mesh.teeth2) + " cannot mesh at centre distance " +
                            trimmed_number(centre_distance_mm) + " mm",
                 .key = "gearbox.centre_distance_mm",
                 .value = trimmed_number(centre_distance_mm),
                 .remedy = "above " + trimmed_number(reference_centre_distance_mm(mesh) *
                                                     std::cos(transverse_pressure_angle_rad(mesh))) +
                           " mm (unshifted: " +
                           trimmed_number(reference_centre_distance_mm(mesh)) + " mm)"});
  return std::acos(cosine);
}

double shift_sum(const MeshTeeth& mesh, double working_pressure_angle_rad) {
  return tooth_sum(mesh) / (2.0 * std::tan(mesh.pressure_angle_rad)) *
         (involute_function(working_pressure_angle_rad) -
          involute_function(transverse_pressure_angle_rad(mesh)));
}

Result<double> zero_backlash_centre_distance_mm(const MeshTeeth& mesh, double shift_sum) {
  const double alpha = transverse_pressure_angle_rad(mesh);
  const double inv = involute_function(alpha) +
                     2.0 * std::tan(mesh.pressure_angle_rad) * shift_sum / tooth_sum(mesh);
  if (!(tooth_sum(mesh) > 0.0) || !(inv > 0.0))
    return fail({.code = ErrorCode::kInfeasible,
                 .message = "profile shifts that add up to " + trimmed_number(shift_sum) +
                            " leave no centre distance without backlash",
                 .key = "shift",
                 .value = trimmed_number(shift_sum),
                 .remedy = "larger shifts (internal pair: a larger shift of the ring)"});
  return reference_centre_distance_mm(mesh) * std::cos(alpha) / std::cos(inverse_involute_rad(inv));
}

MeshTeeth mesh_teeth(const Gear& gear1, const Gear& gear2) {
  return {.teeth1 = gear1.teeth,
          .teeth2 = gear2.teeth,
          .internal = gear2.kind == GearKind::kInternal,
          .normal_module_mm = gear1.normal_module_mm,
          .helix_angle_rad = std::abs(gear1.helix_angle_rad),
          .pressure_angle_rad = gear1.rack.pressure_angle_rad};
}
MeshTeeth mesh_teeth(const GearPair& pair) { return mesh_teeth(pair.gear1(), pair.gear2()); }

double working_pressure_angle_rad(const GearPair& pair) {
  return working_pressure_angle_rad(mesh_teeth(pair), pair.centre_distance_mm).value_or(kNaN);
}

double pitch_radius1_mm(const GearPair& pair) {
  return pair.centre_distance_mm * pair.gear1().teeth / tooth_sum(mesh_teeth(pair));
}
double pitch_radius2_mm(const GearPair& pair) {
  return pair.centre_distance_mm * pair.gear2().teeth / tooth_sum(mesh_teeth(pair));
}

double circumferential_backlash_mm(const GearPair& pair) {
  const double r1 = pitch_radius1_mm(pair);
  const double inv = involute_function(working_pressure_angle_rad(pair));
  const double half1 = base_half_angle_rad(pair.gear1()) - inv;
  const double half2 = base_half_angle_rad(pair.gear2()) + (pair.internal() ? inv : -inv);
  return kTwoPi * r1 / pair.gear1().teeth - 2.0 * r1 * half1 - 2.0 * pitch_radius2_mm(pair) * half2;
}

LineOfAction line_of_action(const GearPair& pair) {
  const ToothProfile &p1 = *pair.profile1, &p2 = *pair.profile2;
  const double alpha_w = working_pressure_angle_rad(pair);
  const double span = pair.centre_distance_mm * std::sin(alpha_w);
  const double r_b1 = base_radius_mm(pair.gear1());
  const double r_b2 = base_radius_mm(pair.gear2());
  LineOfAction line;
  line.base_pitch_mm = kTwoPi * r_b1 / pair.gear1().teeth;
  line.pitch_point_mm = r_b1 * std::tan(alpha_w);
  // roll length of gear 1 from that of gear 2: external L1 = T - L2, internal L1 = L2 - T
  const auto from2 = [&](double roll2) { return pair.internal() ? roll2 - span : span - roll2; };
  line.start_mm = from2(roll_length_mm(p2.tip_form_radius_mm(), r_b2));
  line.end_mm = roll_length_mm(p1.tip_form_radius_mm(), r_b1);
  line.effective_start_mm =
      std::max({line.start_mm, p1.root_form_roll_length_mm(), 0.0});
  line.effective_end_mm = std::min(line.end_mm, from2(p2.root_form_roll_length_mm()));
  return line;
}

ContactRatios contact_ratios(const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  ContactRatios ratios;
  ratios.approach = (line.pitch_point_mm - line.start_mm) / line.base_pitch_mm;
  ratios.recess = (line.end_mm - line.pitch_point_mm) / line.base_pitch_mm;
  ratios.total = ratios.approach + ratios.recess;
  ratios.effective =
      std::max(0.0, (line.effective_end_mm - line.effective_start_mm) / line.base_pitch_mm);
  return ratios;
}

double start_of_active_profile1_mm(const GearPair& pair) {
  const double r_b = base_radius_mm(pair.gear1());
  return std::hypot(r_b, std::max(0.0, line_of_action(pair).start_mm));
}

double start_of_active_profile2_mm(const GearPair& pair) {
  const double r_b = base_radius_mm(pair.gear2());
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  const double roll1 = line_of_action(pair).end_mm;
  const double roll2 = pair.internal() ? roll1 + span : span - roll1;
  return std::hypot(r_b, std::max(0.0, roll2));
}

double tip_clearance_of_gear1_mm(const GearPair& pair) {
  const double r_a1 = pair.profile1->tip_radius_mm(), r_f2 = pair.profile2->root_radius_mm();
  const double a = pair.centre_distance_mm;
  return pair.internal() ? r_f2 - a - r_a1 : a - r_a1 - r_f2;
}

double tip_clearance_of_gear2_mm(const GearPair& pair) {
  const double r_a2 = pair.profile2->tip_radius_mm(), r_f1 = pair.profile1->root_radius_mm();
  const double a = pair.centre_distance_mm;
  return pair.internal() ? r_a2 - a - r_f1 : a - r_a2 - r_f1;
}

}  // namespace trueflank
