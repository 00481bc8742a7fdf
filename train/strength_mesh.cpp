// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_mesh.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/mesh_face.h"

namespace trueflank {

Result<const Material*> material_of(const StrengthOptions& options, const std::string& gear) {
  const auto it = options.material_of.find(gear);
  const std::string& name = it == options.material_of.end() ? options.material : it->second;
  const Material* material = options.materials.find(name);
  if (material) return material;
  std::string known;
  for (const Material& m : options.materials.all()) known += (known.empty() ? "" : ", ") + m.name;
  return fail({.code = ErrorCode::kInconsistent,
               .message = "no material of this name in the table",
               .key = gear + ".material",
               .value = name,
               .remedy = "one of " + known});
}

MeshGeometry mesh_geometry(const GearTrain& train, const TrainMesh& mesh) {
  MeshGeometry g{.pair = train.pair(mesh)};
  g.face_width_mm = common_face(train, mesh).carrying_mm;
  g.contact_ratio = std::max(1.0, contact_ratios(g.pair).effective);
  g.overlap_ratio = overlap_ratio(train, mesh);
  g.count = std::max(train.copies_of(train.topology().gears[static_cast<std::size_t>(mesh.gear1)].member),
                     train.copies_of(train.topology().gears[static_cast<std::size_t>(mesh.gear2)].member));
  return g;
}

double zone_factor(const MeshGeometry& g) {
  const double alpha_t = transverse_pressure_angle_rad(g.pair.gear1());
  const double alpha_wt = working_pressure_angle_rad(g.pair);
  return std::sqrt(2.0 * std::cos(base_helix_angle_rad(g.pair.gear1())) / std::tan(alpha_wt)) /
         std::cos(alpha_t);
}

double elasticity_factor(const Material& m1, const Material& m2) {
  const auto compliance = [](const Material& m) {
    return (1.0 - m.poisson_ratio * m.poisson_ratio) / m.elastic_modulus_mpa;
  };
  return std::sqrt(1.0 / (kPi * (compliance(m1) + compliance(m2))));
}

bool passes_power_on(const GearTrain& train, const DirectionEfficiency& drive, int gear) {
  bool drives = false, driven = false;
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const TrainMesh& mesh = train.meshes[k];
    if (mesh.gear1 != gear && mesh.gear2 != gear) continue;
    if (drive.meshes[k].driving_gear.empty()) continue;  // it idles
    (drive.meshes[k].driving_gear == train.gears[static_cast<std::size_t>(gear)].name ? drives
                                                                                      : driven) = true;
  }
  return drives && driven;
}

double output_per_input(const GearTrain& train, const DirectionEfficiency& drive) {
  return std::abs(drive.members[static_cast<std::size_t>(train.topology().output)].torque);
}

}  // namespace trueflank
