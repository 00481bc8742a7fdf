// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_plastic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/train/strength_iso6336.h"
#include "trueflank/train/strength_mesh.h"

namespace trueflank {
namespace {

constexpr double kCyclesWithoutLife = 1e8;
constexpr double kTestTemperature_c = 23.0;
constexpr double kReferenceGearNotch = 2.0;  // Y_St: limits are those of a notched gear, counted without it

/// Heat into the tooth per power lost, K (m/s)^0.75 mm^1.75 / W: Hachmann and Strickle's, as handbooks print them from
/// VDI 2545 for dry and greased pairs. Oil carries the heat away.
struct HeatFactors {
  double root, flank;
};
constexpr HeatFactors kAgainstMetal{1.0e3, 7.0e3}, kAgainstPlastic{2.4e3, 10.0e3};
constexpr double kGreasedFriction = 0.09, kOiledFriction = 0.04;  // assumed, as handbooks give them

/// What does not change with the torque, of one gear in one mesh.
struct Rated {
  const TrainGear* gear;
  const Material* material;
  const Material* mate;
  MeshGeometry mesh;
  Iso6336Mesh factors;               ///< with its stresses per force
  const Iso6336Mesh::Tooth* tooth;   ///< of the gear, in `factors` of the result it came from
  double force_per_output = 0.0;     ///< tangential force of one mesh per N m at the output
  double loss_per_output_w = 0.0;    ///< W per N m at the output: friction coefficient of the plastic
  double speed_m_s = 0.0;            ///< of the pitch line
  double cycles = kCyclesWithoutLife;
  bool both_ways = false;
};

double friction_of(const Rated& r, const StrengthOptions& options) {
  if (options.lubrication == "oil") return kOiledFriction;
  if (options.lubrication == "grease") return kGreasedFriction;
  return r.material->plastic->dry_friction;
}

double modulus_at(const Material& material, double temperature_c) {
  if (!material.plastic) return material.elastic_modulus_mpa;
  const double warmer = std::max(0.0, temperature_c - kTestTemperature_c);
  return material.elastic_modulus_mpa * std::max(0.1, 1.0 - material.plastic->modulus_falls_per_c * warmer);
}

/// Mean over the spectrum heats; its equivalent load tires.
double mean_load(const StrengthOptions& options) { return equivalent_load(options.spectrum, 1.0); }

PlasticTooth at_torque(const Rated& r, double output_nm, const StrengthOptions& o) {
  const Gear& gear = r.gear->profile.gear();
  const PlasticProperties& plastic = *r.material->plastic;
  const double m = gear.normal_module_mm, b = r.mesh.face_width_mm;
  PlasticTooth t{.mesh = r.factors.name, .gear = r.gear->name, .material = r.material->name, .cycles = r.cycles};
  const HeatFactors heat = r.mate->plastic ? kAgainstPlastic : kAgainstMetal;
  const double cooled = b * gear.teeth * std::pow(std::max(r.speed_m_s, 1e-9) * m, 0.75);
  const double loss_w = o.lubrication == "oil" ? 0.0 : r.loss_per_output_w * output_nm * mean_load(o);
  t.root_c = o.ambient_c + heat.root * loss_w / cooled;
  t.flank_c = o.ambient_c + heat.flank * loss_w / cooled;
  const double force = r.force_per_output * output_nm * o.overload_factor * o.dynamic_factor * o.planet_load_factor *
                       o.face_load_factor;
  const double tiring = force * equivalent_load(o.spectrum, 5.0);
  t.root_stress_mpa = r.tooth->stress_per_n * tiring;
  t.root_limit_mpa = kReferenceGearNotch * plastic.root.at(t.root_c, r.cycles) * (r.both_ways ? 2.0 / 3.0 : 1.0);
  // with the modulus at room temperature: that a warm flank spreads the load more is left out
  t.flank_stress_mpa = r.factors.contact_stress_per_root_n * std::sqrt(tiring);
  t.flank_limit_mpa = plastic.flank.at(t.flank_c, r.cycles);
  // 7.5 for the tip of a tooth of usual form: VDI 2736
  t.bent_um = um_from_mm(7.5 * force / (b * std::cos(gear.helix_angle_rad)) *
                         (1.0 / modulus_at(*r.material, t.root_c) + 1.0 / modulus_at(*r.mate, t.root_c)));
  if (o.lubrication == "dry" && !std::isnan(plastic.wear_mm3_per_nm) && o.life_h) {
    const LineOfAction line = line_of_action(r.mesh.pair);
    const double flank_mm = line.effective_end_mm - line.effective_start_mm;  // rolled off, about as long
    const double friction_work_nm = r.loss_per_output_w / friction_of(r, o) * output_nm * mean_load(o) * *o.life_h * 3600.0;
    t.wear_um = um_from_mm(plastic.wear_mm3_per_nm * friction_work_nm / (b * gear.teeth * flank_mm));
  }
  return t;
}

/// Largest share of a limit, and which.
std::pair<double, const char*> used(const PlasticTooth& t, const Rated& r, const StrengthOptions& o) {
  const double root = o.bending_safety * t.root_stress_mpa / t.root_limit_mpa;
  const double flank = o.contact_safety * t.flank_stress_mpa / t.flank_limit_mpa;
  const double room = r.material->plastic->highest_c - o.ambient_c;
  const double heat = room > 0.0 ? (t.flank_c - o.ambient_c) / room : std::numeric_limits<double>::infinity();
  if (heat > root && heat > flank) return {heat, "temperature"};
  return root > flank ? std::pair{root, "root"} : std::pair{flank, "flank"};
}

/// Every plastic gear in every mesh that carries.
Result<std::vector<Rated>> rated_teeth(const GearTrain& train, const StrengthOptions& options,
                                       const Iso6336Result& iso) {
  std::vector<Rated> all;
  const EfficiencyResult whole = efficiency(train);
  const DirectionEfficiency& drive = whole.forward_drive;
  const double output = output_per_input(train, drive);
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const TrainMesh& mesh = train.meshes[k];
    if (drive.meshes[k].torque1 == 0.0) continue;
    for (const int gear : {mesh.gear1, mesh.gear2}) {
      const int other = gear == mesh.gear1 ? mesh.gear2 : mesh.gear1;
      const auto own = material_of(options, train.gear(gear).name), mate = material_of(options, train.gear(other).name);
      if (!own) return fail(own.error());
      if (!mate) return fail(mate.error());
      if (!(*own)->plastic) continue;
      Rated r{.gear = &train.gear(gear), .material = *own, .mate = *mate, .mesh = mesh_geometry(train, mesh),
              .factors = iso.meshes[k],
              .tooth = gear == mesh.gear1 ? &iso.meshes[k].tooth1 : &iso.meshes[k].tooth2};
      const double radius1_m = reference_radius_mm(train.pair(mesh).gear1()) * 1e-3;
      r.force_per_output = std::abs(drive.meshes[k].torque1) / (output * radius1_m * r.mesh.count);
      r.both_ways = options.reversing || passes_power_on(train, drive, gear);
      if (!std::isnan(r.tooth->cycles)) r.cycles = r.tooth->cycles;
      if (options.input_speed_rpm) {
        const double input_rad_s = kTwoPi * *options.input_speed_rpm / 60.0;
        const double rolling_w = std::abs(drive.meshes[k].rolling_power) * input_rad_s / output / r.mesh.count;
        const double loss_at_1 = train.design.friction > 0.0
                                     ? (1.0 - whole.meshes[k].basic_efficiency) / train.design.friction
                                     : 0.0;
        r.loss_per_output_w = rolling_w * loss_at_1 * friction_of(r, options);
        const double power_per_force = rolling_w / r.force_per_output;  // the pitch line's speed
        r.speed_m_s = power_per_force;
      }
      all.push_back(r);
    }
  }
  return all;
}

}  // namespace

Result<PlasticResult> strength_plastic(const GearTrain& train, const StrengthOptions& options) {
  PlasticResult result;
  const auto iso = strength_iso6336(train, options);
  if (!iso) return fail(iso.error());
  const auto rated = rated_teeth(train, options, *iso);
  if (!rated) return fail(rated.error());
  if (rated->empty()) return result;
  const auto most_used = [&](double output_nm) {
    std::pair<double, const char*> most{0.0, ""};
    for (const Rated& r : *rated) {
      const auto share = used(at_torque(r, output_nm, options), r, options);
      if (!(share.first <= most.first)) {
        most = share;
        result.limiting_gear = r.gear->name;
      }
    }
    return most;
  };
  double low = 0.0, high = 1e-6;
  while (high < 1e9 && most_used(high).first < 1.0) high *= 2.0;
  for (int i = 0; i < 100 && high - low > 1e-9 * high; ++i) {
    const double mid = 0.5 * (low + high);
    (most_used(mid).first < 1.0 ? low : high) = mid;
  }
  result.output_torque_nm = low;
  result.limiting_mode = most_used(low).second;
  for (const Rated& r : *rated) result.teeth.push_back(at_torque(r, low, options));
  return result;
}

}  // namespace trueflank
