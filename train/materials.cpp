// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/materials.h"

#include <algorithm>
#include <utility>

namespace trueflank {

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
          {"pom", 35, 60, 2800, 0.35, 1410, "assumed: values in common use with VDI 2736, 23 C, oiled"},
          {"pa6", 27, 50, 1800, 0.4, 1140, "assumed: cautious, moist"},
          {"pla-printed", 15, 25, 2600, 0.35, 1240, "assumed: cautious, printed solid"},
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
