// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_iso6336.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/train/ring_rim.h"
#include "trueflank/train/strength_mesh.h"

namespace trueflank {
namespace {

constexpr double kIdlerLoad = 0.7;       // Y_M of ISO 6336-3 annex B for idlers and planets
constexpr double kStressCorrection = 2.0;  // Y_ST of the reference test gear
constexpr double kMinutesAnHour = 60.0;

/// Life factor of structural and through-hardened steel: from its static value down to 1 at the endurance limit,
/// and on to 0.85 at 1e10 cycles.
struct LifeCurve {
  double static_cycles, endurance_cycles, exponent, long_exponent;

  [[nodiscard]] double at(double cycles) const {
    if (std::isnan(cycles)) return 1.0;
    const double n = std::clamp(cycles, static_cycles, 1e10);
    return std::pow(endurance_cycles / n, n < endurance_cycles ? exponent : long_exponent);
  }
};
constexpr LifeCurve kRootLife{1e4, 3e6, 0.16, 0.02};
constexpr LifeCurve kFlankLife{1e5, 5e7, 0.0756, 0.0306};

/// Loads of a tooth of one mesh in the asked life; NaN where none is asked. A central gear's teeth meet every planet.
double cycles_of(const GearTrain& train, const StrengthOptions& options, std::size_t mesh, int gear, int count) {
  if (!options.input_speed_rpm || !options.life_h) return kNaN;
  const Topology& topology = train.topology();
  const int member = topology.gears[static_cast<std::size_t>(gear)].member;
  const double speed = train.speeds.of[static_cast<std::size_t>(member)] -
                       train.speeds.of_arm(topology.arm_of(topology.meshes[mesh]));
  const double turns = std::abs(speed) * *options.input_speed_rpm * kMinutesAnHour * *options.life_h;
  return turns * (topology.is_planet(member) ? 1 : count);
}

/// From the root circle to the bore's farthest point, or to the rim's outside; infinite for solid bodies.
double rim_mm(const GearTrain& train, const TrainGear& gear) {
  const auto index = static_cast<std::size_t>(&gear - train.gears.data());
  const double root = gear.profile.root_radius_mm();
  if (gear.profile.gear().kind == GearKind::kInternal) {
    const auto& outer = train.design.gears[index].outer_diameter_mm;
    return outer ? 0.5 * *outer - root : usual_rim_mm(gear.profile.gear().normal_module_mm);
  }
  const BoreDesign& bore = first_of_body(train.design, index).bore;
  return bore.diameter_mm > 0.0 ? root - 0.5 * bore.diameter_mm - bore.keyway_depth_mm
                                : std::numeric_limits<double>::infinity();
}

/// Y_X: 1 up to module 5, then the cautious line of surface-hardened steel.
double size_factor(double module_mm) { return module_mm <= 5.0 ? 1.0 : std::max(0.8, 1.05 - 0.01 * module_mm); }

double worst_load(const StrengthOptions& options) {
  double worst = options.spectrum.empty() ? 1.0 : 0.0;
  for (const LoadStep& step : options.spectrum) worst = std::max(worst, step.torque);
  return worst;
}

/// The rated force that a limit allows: the equivalent load at the life's limit, the worst at the static one.
double allowable_force(double at_life_n, double at_static_n, double slope, const StrengthOptions& options) {
  const double equivalent = equivalent_load(options.spectrum, slope);
  return std::min(at_life_n / equivalent, at_static_n / worst_load(options));
}

struct ToothSide {
  const TrainGear* gear;
  const Material* material;
  bool both_ways;
};

void rate_root(const GearTrain& train, const MeshGeometry& g, const ToothSide& side,
               Iso6336Mesh::Tooth& tooth) {
  const Gear& gear = side.gear->profile.gear();
  const CriticalSection section = normal_section(side.gear->profile);
  tooth.gear = side.gear->name;
  tooth.form_factor = section.form_factor;
  tooth.notch_factor = notch_factor(section);
  tooth.rim_factor = rim_factor(gear.kind == GearKind::kInternal, rim_mm(train, *side.gear),
                                std::abs(side.gear->profile.tip_radius_mm() - side.gear->profile.root_radius_mm()),
                                gear.normal_module_mm);
  tooth.sensitivity_factor = section.thickness_mm >= 3.0 * section.fillet_radius_mm ? 1.0 : 0.95;
  tooth.size_factor = size_factor(gear.normal_module_mm);
  tooth.life_factor = kRootLife.at(tooth.cycles);
  const double cos_b = std::cos(base_helix_angle_rad(gear));
  const double y_epsilon = 0.25 + 0.75 * cos_b * cos_b / g.contact_ratio;
  const double y_beta = 1.0 - std::min(1.0, g.overlap_ratio) *
                                  std::min(30.0, deg_from_rad(std::abs(gear.helix_angle_rad))) / 120.0;
  tooth.stress_per_n = tooth.form_factor * tooth.notch_factor * y_epsilon * y_beta * tooth.rim_factor /
                       (g.face_width_mm * gear.normal_module_mm);
  tooth.limit_mpa = side.material->bending_limit_mpa * kStressCorrection * (side.both_ways ? kIdlerLoad : 1.0) *
                    tooth.sensitivity_factor * tooth.size_factor * tooth.life_factor;
}

void set_single_contact(const MeshGeometry& g, Iso6336Mesh& mesh) {
  if (g.pair.internal() || g.overlap_ratio >= 1.0) return;
  const auto over_base = [](const ToothProfile& profile) {
    return std::sqrt(std::pow(profile.tip_form_radius_mm() / base_radius_mm(profile.gear()), 2) - 1.0);
  };
  const double t1 = over_base(*g.pair.profile1), t2 = over_base(*g.pair.profile2);
  const double p1 = kTwoPi / g.pair.gear1().teeth, p2 = kTwoPi / g.pair.gear2().teeth;
  const double tan_w = std::tan(working_pressure_angle_rad(g.pair));
  const double m1 = tan_w / std::sqrt((t1 - p1) * (t2 - (g.contact_ratio - 1.0) * p2));
  const double m2 = tan_w / std::sqrt((t2 - p2) * (t1 - (g.contact_ratio - 1.0) * p1));
  const auto blended = [&](double m) { return std::max(1.0, m - g.overlap_ratio * (m - 1.0)); };
  mesh.single_contact_factor1 = blended(m1);
  mesh.single_contact_factor2 = blended(m2);
}

double contact_ratio_factor_iso(const MeshGeometry& g) {
  const double e = g.contact_ratio, b = g.overlap_ratio;
  return b >= 1.0 ? std::sqrt(1.0 / e) : std::sqrt((4.0 - e) / 3.0 * (1.0 - b) + b / e);
}

void rate_flanks(const MeshGeometry& g, const Material& m1, const Material& m2, const StrengthOptions& options,
                 Iso6336Mesh& mesh) {
  const double u = static_cast<double>(g.pair.gear2().teeth) / g.pair.gear1().teeth;
  const double d1 = 2.0 * reference_radius_mm(g.pair.gear1());
  const double curvature = (g.pair.internal() ? u - 1.0 : u + 1.0) / u;
  mesh.zone_factor = zone_factor(g);
  mesh.elasticity_factor = elasticity_factor(m1, m2);
  mesh.contact_ratio_factor = contact_ratio_factor_iso(g);
  mesh.helix_factor = 1.0 / std::sqrt(std::cos(g.pair.gear1().helix_angle_rad));
  set_single_contact(g, mesh);
  mesh.contact_stress_per_root_n = mesh.zone_factor * mesh.elasticity_factor * mesh.contact_ratio_factor *
                                   mesh.helix_factor * std::sqrt(curvature / (d1 * g.face_width_mm));
  mesh.contact_limit1_mpa = m1.contact_limit_mpa * options.lubrication_factor * kFlankLife.at(mesh.tooth1.cycles);
  mesh.contact_limit2_mpa = m2.contact_limit_mpa * options.lubrication_factor * kFlankLife.at(mesh.tooth2.cycles);
}

/// Tangential force at which a root reaches its limit, safety and load factors included.
double root_force_n(const Iso6336Mesh::Tooth& tooth, const StrengthOptions& o) {
  const double k = o.overload_factor * o.dynamic_factor * o.face_load_factor * o.planet_load_factor;
  const double at_life = tooth.limit_mpa * o.bending_life_factor / (o.bending_safety * tooth.stress_per_n * k);
  const double static_n = at_life * kRootLife.at(0.0) / tooth.life_factor;
  return allowable_force(at_life, static_n, 1.0 / kRootLife.exponent, o);
}

double flank_force_n(const Iso6336Mesh& mesh, const StrengthOptions& o) {
  const double k = o.overload_factor * o.dynamic_factor * o.face_load_factor * o.planet_load_factor;
  const auto force = [&](double limit, double single_contact, double cycles) {
    const double stress = limit * o.contact_life_factor / (o.contact_safety * single_contact * mesh.contact_stress_per_root_n);
    const double at_life = stress * stress / k;
    const double to_static = kFlankLife.at(0.0) / kFlankLife.at(cycles);
    return allowable_force(at_life, at_life * to_static * to_static, 0.5 / kFlankLife.exponent, o);
  };
  return std::min(force(mesh.contact_limit1_mpa, mesh.single_contact_factor1, mesh.tooth1.cycles),
                  force(mesh.contact_limit2_mpa, mesh.single_contact_factor2, mesh.tooth2.cycles));
}

void take_smaller(double output_nm, const Iso6336Mesh& mesh, const std::string& gear, const char* mode,
                  Iso6336Result& result) {
  if (!(output_nm < result.output_torque_nm) && !std::isnan(result.output_torque_nm)) return;
  result.output_torque_nm = output_nm;
  result.limiting_mesh = mesh.name;
  result.limiting_gear = gear;
  result.limiting_mode = mode;
}

}  // namespace

double notch_factor(const CriticalSection& section) {
  const double l = section.thickness_mm / section.lever_mm;
  const double q = section.thickness_mm / (2.0 * section.fillet_radius_mm);
  return (1.2 + 0.13 * l) * std::pow(q, 1.0 / (1.21 + 2.3 / l));
}

double rim_factor(bool internal, double rim_mm, double tooth_height_mm, double module_mm) {
  if (internal) {
    const double backup = rim_mm / module_mm;
    return backup >= 3.5 ? 1.0 : backup > 1.75 ? 1.15 * std::log(8.324 / backup) : kNaN;
  }
  const double backup = rim_mm / tooth_height_mm;
  return backup >= 1.2 ? 1.0 : backup > 0.5 ? 1.6 * std::log(2.242 / backup) : kNaN;
}

double equivalent_load(const std::vector<LoadStep>& spectrum, double exponent) {
  if (spectrum.empty()) return 1.0;
  double sum = 0.0;
  for (const LoadStep& step : spectrum) sum += step.share * std::pow(step.torque, exponent);
  return std::pow(sum, 1.0 / exponent);
}

Result<Iso6336Result> strength_iso6336(const GearTrain& train, const StrengthOptions& options) {
  Iso6336Result result;
  if (train.meshes.empty()) return result;
  const DirectionEfficiency drive = efficiency(train).forward_drive;
  const double output = output_per_input(train, drive);
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const TrainMesh& mesh = train.meshes[k];
    const TrainGear &gear1 = train.gear(mesh.gear1), &gear2 = train.gear(mesh.gear2);
    const auto m1 = material_of(options, gear1.name), m2 = material_of(options, gear2.name);
    if (!m1) return fail(m1.error());
    if (!m2) return fail(m2.error());
    const MeshGeometry g = mesh_geometry(train, mesh);
    Iso6336Mesh entry{.name = mesh.name};
    entry.tooth1.cycles = cycles_of(train, options, k, mesh.gear1, g.count);
    entry.tooth2.cycles = cycles_of(train, options, k, mesh.gear2, g.count);
    rate_root(train, g,
              {&gear1, *m1, options.reversing || passes_power_on(train, drive, mesh.gear1)},
              entry.tooth1);
    rate_root(train, g,
              {&gear2, *m2, options.reversing || passes_power_on(train, drive, mesh.gear2)},
              entry.tooth2);
    rate_flanks(g, **m1, **m2, options, entry);
    if (drive.meshes[k].torque1 != 0.0) {  // else it idles
      const double radius1_m = reference_radius_mm(g.pair.gear1()) * 1e-3;
      const auto output_of = [&](double force_n) {
        return force_n * radius1_m * g.count * output / std::abs(drive.meshes[k].torque1);
      };
      entry.tooth1.output_nm = output_of(root_force_n(entry.tooth1, options));
      entry.tooth2.output_nm = output_of(root_force_n(entry.tooth2, options));
      entry.contact_output_nm = output_of(flank_force_n(entry, options));
      take_smaller(entry.tooth1.output_nm, entry, gear1.name, "bending", result);
      take_smaller(entry.tooth2.output_nm, entry, gear2.name, "bending", result);
      take_smaller(entry.contact_output_nm, entry, gear1.name + ", " + gear2.name, "contact", result);
    }
    result.meshes.push_back(std::move(entry));
  }
  return result;
}

}  // namespace trueflank
