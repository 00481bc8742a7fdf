// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes sample parts as STEP files into a folder, with a list of what is in them: file, volume by
// quadrature of the exact curves. Usage: write_step_samples FOLDER
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>

#include "tests/support/flank_distance.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/export/step/step_writer.h"

namespace trueflank {
namespace {

bool write_part(const std::filesystem::path& folder, std::ostream& list, const PartShape& part,
                std::optional<double> volume_mm3 = std::nullopt) {
  auto solid = brep_of(part);
  if (!solid) {
    std::cerr << solid.error().message << '\n';
    return false;
  }
  std::ofstream(folder / (part.name + ".step"))
      << io::step_text({.name = part.name, .solid = std::move(*solid)});
  list << part.name << ".step\t" << std::setprecision(17) << volume_mm3.value_or(test::exact_volume_mm3(part)) << '\n';
  return true;
}

/// Teeth that turn: a helical planet with its bore, a herringbone, a ring; modified, chamfered and
/// displaced ones.
bool write_helical(const std::filesystem::path& folder, std::ostream& list) {
  const auto planet = ToothProfile::make(test::helical_gear(39, 0.3, 0.26));
  const auto pinion = ToothProfile::make(test::helical_gear(13, 0.2, -0.4));
  const auto ring = ToothProfile::make(test::helical_ring(60, 0.3, 0.26));
  if (!planet || !pinion || !ring) return false;
  const BoreOutline bore{{.diameter_mm = 8.0}};
  bool ok = write_part(folder, list, test::helical_part("helical planet", *planet, 8.0, false, {bore}));
  ok &= write_part(folder, list, test::helical_part("herringbone pinion", *pinion, 12.0, true));
  ok &= write_part(folder, list, test::helical_part("helical ring", *ring, 6.0));
  const double middle_mm =
      0.5 * (pinion->tip_form_roll_length_mm() + pinion->root_form_roll_length_mm());
  const FlankDeviation field = test::sample_modifications(pinion->gear(), 8.0, middle_mm);
  const Toothing modified{.profile = &*pinion, .twist = face_twist(pinion->gear(), 8.0, false),
                          .deviation = &field};
  ok &= write_part(folder, list, test::toothed_part("modified pinion", modified),
                   test::toothing_volume_mm3(modified, field.z_breaks_mm));
  const Toothing chamfered{.profile = &*pinion, .twist = face_twist(pinion->gear(), 9.0, true),
                           .edge_chamfer_mm = 0.15};
  ok &= write_part(folder, list, test::toothed_part("chamfered herringbone", chamfered),
                   test::toothing_volume_mm3(chamfered, {0.15, 4.5, 8.85}));
  const Displacement bent = [](const std::array<double, 3>& p) -> std::array<double, 3> {
    return {0.01 * std::sin(0.3 * p[1] + 0.1 * p[2]), 0.0, 0.0};  // keeps areas
  };
  ok &= write_part(folder, list,
                   test::toothed_part("displaced pinion",
                                      {.profile = &*pinion,
                                       .twist = face_twist(pinion->gear(), 8.0, false),
                                       .displacement = &bent}),
                   8.0 * test::area_mm2(ToothedOutline{.profile = &*pinion}));
  return ok;
}

bool write_all(const std::filesystem::path& folder) {
  std::ofstream list(folder / "samples.tsv");
  bool ok = true;
  for (const auto& [name, gear] : test::sample_gears()) {
    const auto profile = ToothProfile::make(gear);
    if (!profile) return false;
    const BoreOutline bore{{.diameter_mm = 0.8 * profile->root_radius_mm()}};
    ok &= write_part(folder, list,
                     gear.kind == GearKind::kExternal
                         ? test::gear_part(name, *profile, 7.5 * gear.normal_module_mm, {bore})
                         : test::ring_part(name, *profile, 7.5));
  }
  const auto lower = ToothProfile::make(test::external_gear(39, 0.3));
  const auto upper = ToothProfile::make(test::external_gear(32, 0.4));
  if (!lower || !upper) return false;
  ok &= write_part(folder, list, test::planet_part(*lower, *upper));
  const BoreOutline keyway{{.diameter_mm = 8.0,
                            .kind = BoreKind::kKeyway,
                            .keyway_width_mm = 2.0,
                            .keyway_depth_mm = 1.0}};
  ok &= write_part(folder, list, test::gear_part("keyway", *upper, 8.0, {keyway}));
  ok &= write_helical(folder, list);
  return ok && list.good();
}

}  // namespace
}  // namespace trueflank

int main(int argc, char** argv) { return argc == 2 && trueflank::write_all(argv[1]) ? 0 : 1; }
