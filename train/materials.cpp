// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/materials.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueflank {
namespace {

constexpr const char* kAsReproduced =
    "limits as handbooks reproduce them from VDI 2736 part 2, not checked against the guideline; the rest assumed";

/// Limits at 23 C that fall along a line, without a slope over the cycles: nothing better is known.
PlasticProperties falling(double root, double flank, double root_per_c, double flank_per_c, double highest_c,
                          double friction, double modulus_per_c) {
  return {.root = {.base = root + 23.0 * root_per_c, .fall = root_per_c},
          .flank = {.base = flank + 23.0 * flank_per_c, .fall = flank_per_c},
          .highest_c = highest_c,
          .dry_friction = friction,
          .modulus_falls_per_c = modulus_per_c,
          .source = "assumed: cautious"};
}

}  // namespace

double PlasticLimit::at(double temperature_c, double cycles) const {
  const double warm = std::max(0.0, temperature_c);
  return std::max(0.0, base - fall * std::pow(warm, fall_exponent) +
                           (life - life_fall * std::pow(warm, life_fall_exponent)) * std::pow(cycles, -life_exponent));
}

// Bending limits of through-hardened steels: pulsating fatigue limit over notch factor 1.4 at the
// stated core hardness, as KHK's catalogue prints them; contact limits: JGMA 402-01 tables 17-12 and
// 17-13 as printed by SDP/SI in kgf/mm2 (x 9.80665). The rest is marked assumed.
MaterialTable::MaterialTable()
    : materials_{
          {"s45c-hb180", 206, 481, 206000, 0.3, 7850,
           "normalised carbon steel, HB 180: KHK catalogue; JGMA 402-01 (49 kgf/mm2)"},
          {"s45c-hb250", 245, 628, 206000, 0.3, 7850,
           "quenched and tempered carbon steel, HB 250: KHK catalogue; JGMA 402-01 (64 kgf/mm2)"},
          {"scm440-hb280", 314, 775, 206000, 0.3, 7850,
           "quenched and tempered alloy steel, HB 280: KHK catalogue; JGMA 402-01 (79 kgf/mm2)"},
          {"scm440-hb320", 358, 839, 206000, 0.3, 7850,
           "quenched and tempered alloy steel, HB 320: KHK catalogue; JGMA 402-01 (85.5 kgf/mm2)"},
          {"s45c-induction", 245, 941, 206000, 0.3, 7850,
           "induction hardened through the root, core HB 250, flank HV 600: KHK catalogue; "
           "JGMA 402-01 (96 kgf/mm2)"},
          {"16mncr5-carburised", 430, 1500, 206000, 0.3, 7850,
           "assumed: values in common use for ISO 6336-5 quality MQ"},
          {"pom", 35, 60, 2800, 0.35, 1410, "assumed: values in common use with VDI 2736, 23 C, oiled",
           PlasticProperties{.root = {26, 0.0025, 2, 400, 0, 1, 0.2}, .flank = {36, 0.0012, 2, 1000, 0.025, 2, 0.21},
                             .highest_c = 90, .dry_friction = 0.21, .wear_mm3_per_nm = 3.4e-6,
                             .modulus_falls_per_c = 0.009, .source = kAsReproduced}},
          {"pa66", 30, 50, 3000, 0.4, 1140, "assumed: values in common use with VDI 2736, 23 C, dry as moulded",
           PlasticProperties{.root = {30, 0.22, 1, 4600, 900, 0.3, 1.0 / 3.0},
                             .flank = {36, 0.36, 1, 54000, 4900, 0.5, 0.5},
                             .highest_c = 90, .dry_friction = 0.28, .wear_mm3_per_nm = 1.5e-6,
                             .modulus_falls_per_c = 0.01, .source = kAsReproduced}},
          {"pa6", 27, 50, 1800, 0.4, 1140, "assumed: cautious, moist", falling(27, 50, 0.2, 0.4, 80, 0.3, 0.01)},
          {"pa12", 20, 35, 1400, 0.4, 1010, "assumed: cautious", falling(20, 35, 0.15, 0.25, 70, 0.3, 0.01)},
          {"pla-printed", 15, 25, 2600, 0.35, 1240, "assumed: cautious, printed solid",
           falling(15, 25, 0.3, 0.5, 45, 0.35, 0.02)},
          {"petg-printed", 14, 25, 2000, 0.38, 1270, "assumed: cautious, printed solid",
           falling(14, 25, 0.22, 0.4, 60, 0.35, 0.012)},
          {"abs-printed", 12, 22, 2000, 0.35, 1040, "assumed: cautious, printed solid",
           falling(12, 22, 0.12, 0.22, 75, 0.35, 0.007)},
          {"resin-printed", 15, 30, 2500, 0.38, 1180, "assumed: cautious, tough resin, fully cured",
           falling(15, 30, 0.3, 0.6, 45, 0.4, 0.02)},
          {"brass", 60, 350, 103000, 0.35, 8500, "assumed: cautious"},
          {"aluminium-7075", 90, 300, 71000, 0.33, 2800, "assumed: cautious"},
      } {}

void MaterialTable::set(Material material) {
  const auto it = std::find_if(materials_.begin(), materials_.end(),
                               [&](const Material& m) { return m.name == material.name; });
  if (it != materials_.end())
    *it = std::move(material);
  else
    materials_.push_back(std::move(material));
}

const Material* MaterialTable::find(const std::string& name) const {
  const auto it = std::find_if(materials_.begin(), materials_.end(),
                               [&](const Material& m) { return m.name == name; });
  return it == materials_.end() ? nullptr : &*it;
}

}  // namespace trueflank
