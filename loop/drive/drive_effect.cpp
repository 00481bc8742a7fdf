// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_effect.h"

namespace trueflank::loop {

const DriveFamily* find_drive_family(const std::string& id) {
  for (const DriveFamily& family : drive_library())
    if (family.id == id) return &family;
  return nullptr;
}

std::vector<DriveEffect> drive_candidates(const DriveContext& context) {
  std::vector<DriveEffect> effects;
  for (const DriveFamily& family : drive_library()) {
    if (!family.shapes) {
      effects.push_back({&family, {}});
      continue;
    }
    for (const auto& shape : family.shapes(context)) effects.push_back({&family, shape});
  }
  return effects;
}

}  // namespace trueflank::loop
