// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/strength_form_factor.h"
#include "trueflank/train/strength_mesh.h"

namespace trueflank {
namespace {

/// JGMA 401-01: a tooth bent both ways carries two thirds.
constexpr double kBothWays = 2.0 / 3.0;

double helix_angle_factor(const Gear& gear) {
  const double beta_deg = deg_from_rad(std::abs(gear.helix_angle_rad));
  return beta_deg < 30.0 ? 1.0 - beta_deg / 120.0 : 0.75;
}

void set_bending(const MeshGeometry& g, const ToothProfile& profile, const Material& material,
                 const StrengthOptions& options, MeshStrength::Tooth& tooth) {
  const Gear& gear = profile.gear();
  const double limit = material.bending_limit_mpa * (tooth.bends_both_ways ? kBothWays : 1.0);
  tooth.material = material.name;
  tooth.form_factor = form_factor(profile);
  const double y_epsilon = 1.0 / g.contact_ratio;
  tooth.bending_force_n = limit * gear.normal_module_mm * g.face_width_mm /
                          (tooth.form_factor * y_epsilon * helix_angle_factor(gear)) *
                          options.bending_life_factor /
                          (options.dynamic_factor * options.overload_factor) /
                          options.bending_safety;
  tooth.bending_torque_nm = tooth.bending_force_n * reference_radius_mm(gear) * 1e-3 * g.count /
                            options.planet_load_factor;
}

/// JGMA 402-01: 1 for spur gears, the effect of overlap for helical ones.
double contact_ratio_factor(const MeshGeometry& g) {
  if (g.overlap_ratio == 0.0) return 1.0;
  const double overlap = std::min(1.0, g.overlap_ratio);
  return std::sqrt(1.0 - overlap + overlap / g.contact_ratio);
}

void set_contact(const MeshGeometry& g, const Material& m1, const Material& m2,
                 const StrengthOptions& options, MeshStrength& result) {
  const double d1 = 2.0 * reference_radius_mm(g.pair.gear1());
  const double i = static_cast<double>(g.pair.gear2().teeth) / g.pair.gear1().teeth;
  const double curvature = g.pair.internal() ? i / (i - 1.0) : i / (i + 1.0);
  const double z_h = zone_factor(g), z_e = elasticity_factor(m1, m2), z_eps = contact_ratio_factor(g);
  const double limit = std::min(m1.contact_limit_mpa, m2.contact_limit_mpa);
  const double root =
      options.contact_life_factor * options.lubrication_factor / (z_h * z_e * z_eps);
  result.contact_force_n = limit * limit * d1 * g.face_width_mm * curvature * root * root /
                           (options.face_load_factor * options.dynamic_factor *
                            options.overload_factor) /
                           (options.contact_safety * options.contact_safety);
  result.contact_torque1_nm =
      result.contact_force_n * 0.5 * d1 * 1e-3 * g.count / options.planet_load_factor;
  result.factors.insert(result.factors.end(), {{"Z_H", z_h, true},
                                               {"Z_M", z_e, true},
                                               {"Z_epsilon", z_eps, true}});
}

std::vector<StrengthFactor> assumed_factors(const StrengthOptions& options) {
  return {{"K_O", options.overload_factor, false},
          {"K_V", options.dynamic_factor, false},
          {"K_Hbeta", options.face_load_factor, false},
          {"K_gamma", options.planet_load_factor, false},
          {"K_L", options.bending_life_factor, false},
          {"K_HL", options.contact_life_factor, false},
          {"Z_L Z_R Z_V Z_W", options.lubrication_factor, false},
          {"S_F", options.bending_safety, false},
          {"S_H", options.contact_safety, false}};
}

void take_smaller(double output_nm, const MeshStrength& mesh, const std::string& gear,
                  const char* mode, StrengthResult& result) {
  if (!(output_nm < result.output_torque_nm) && !std::isnan(result.output_torque_nm)) return;
  result.output_torque_nm = output_nm;
  result.limiting_mesh = mesh.name;
  result.limiting_gear = gear;
  result.limiting_mode = mode;
}

}  // namespace

StrengthOptions with_factors_of(const GearboxDesign& design, StrengthOptions options) {
  const StrengthDesign& s = design.strength;
  options.reversing = s.reversing.value_or(design.topology.has_planets());
  options.overload_factor = s.overload_factor;
  options.dynamic_factor = s.dynamic_factor;
  options.face_load_factor = s.face_load_factor;
  options.planet_load_factor = s.planet_load_factor;
  options.bending_life_factor = s.bending_life_factor;
  options.contact_life_factor = s.contact_life_factor;
  options.lubrication_factor = s.lubrication_factor;
  options.bending_safety = s.bending_safety;
  options.contact_safety = s.contact_safety;
  options.input_speed_rpm = s.input_speed_rpm;
  options.life_h = s.life_h;
  options.ambient_c = s.ambient_c;
  options.lubrication = s.lubrication;
  options.spectrum = s.spectrum;
  return options;
}

Result<StrengthResult> strength(const GearTrain& train, const StrengthOptions& options) {
  StrengthResult result;
  if (train.meshes.empty()) return result;
  const DirectionEfficiency drive = efficiency(train).forward_drive;
  const double output = output_per_input(train, drive);
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const TrainMesh& mesh = train.meshes[k];
    const TrainGear &gear1 = train.gears[mesh.gear1], &gear2 = train.gears[mesh.gear2];
    const auto m1 = material_of(options, gear1.name), m2 = material_of(options, gear2.name);
    if (!m1) return fail(m1.error());
    if (!m2) return fail(m2.error());
    const MeshGeometry g = mesh_geometry(train, mesh);
    MeshStrength entry;
    entry.name = mesh.name;
    entry.tooth1.gear = gear1.name;
    entry.tooth2.gear = gear2.name;
    entry.tooth1.bends_both_ways = options.reversing || passes_power_on(train, drive, mesh.gear1);
    entry.tooth2.bends_both_ways = options.reversing || passes_power_on(train, drive, mesh.gear2);
    set_bending(g, gear1.profile, **m1, options, entry.tooth1);
    set_bending(g, gear2.profile, **m2, options, entry.tooth2);
    entry.factors = {{"Y_F1", entry.tooth1.form_factor, true},
                     {"Y_F2", entry.tooth2.form_factor, true},
                     {"Y_epsilon", 1.0 / g.contact_ratio, true},
                     {"Y_beta", helix_angle_factor(g.pair.gear1()), true}};
    set_contact(g, **m1, **m2, options, entry);
    const auto assumed = assumed_factors(options);
    entry.factors.insert(entry.factors.end(), assumed.begin(), assumed.end());

    if (drive.meshes[k].torque1 == 0.0) {  // an idle mesh carries whatever the others do
      result.meshes.push_back(std::move(entry));
      continue;
    }
    const double output_per_torque1 = output / std::abs(drive.meshes[k].torque1);
    const double output_per_torque2 = output / std::abs(drive.meshes[k].torque2);
    const double by_tooth1 = entry.tooth1.bending_torque_nm * output_per_torque1;
    const double by_tooth2 = entry.tooth2.bending_torque_nm * output_per_torque2;
    entry.bending_output_nm = std::min(by_tooth1, by_tooth2);
    entry.contact_output_nm = entry.contact_torque1_nm * output_per_torque1;
    take_smaller(by_tooth1, entry, gear1.name, "bending", result);
    take_smaller(by_tooth2, entry, gear2.name, "bending", result);
    take_smaller(entry.contact_output_nm, entry, gear1.name + ", " + gear2.name, "contact", result);
    result.meshes.push_back(std::move(entry));
  }
  result.input_torque_nm = result.output_torque_nm / output;
  return result;
}

}  // namespace trueflank
