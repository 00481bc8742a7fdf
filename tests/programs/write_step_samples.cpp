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

#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/export/step_writer.h"

namespace trueflank {
namespace {

bool write_part(const std::filesystem::path& folder, std::ostream& list, const PartShape& part) {
  auto solid = brep_of(part);
  if (!solid) {
    std::cerr << solid.error().message << '\n';
    return false;
  }
  std::ofstream(folder / (part.name + ".step"))
      << io::step_text({.name = part.name, .solid = std::move(*solid)});
  list << part.name << ".step\t" << std::setprecision(17) << test::exact_volume_mm3(part) << '\n';
  return true;
}

/// Teeth that turn: a helical planet with its bore, a herringbone, a ring.
bool write_helical(const std::filesystem::path& folder, std::ostream& list) {
  const auto planet = ToothProfile::make(test::helical_gear(39, 0.3, 0.26));
  const auto pinion = ToothProfile::make(test::helical_gear(13, 0.2, -0.4));
  const auto ring = ToothProfile::make(test::helical_ring(60, 0.3, 0.26));
  if (!planet || !pinion || !ring) return false;
  const BoreOutline bore{{.diameter_mm = 8.0}};
  bool ok = write_part(folder, list, test::helical_part("helical planet", *planet, 8.0, false, {bore}));
  ok &= write_part(folder, list, test::helical_part("herringbone pinion", *pinion, 12.0, true));
  ok &= write_part(folder, list, test::helical_part("helical ring", *ring, 6.0));
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
