// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/solid/measure/mesh_section.h"

namespace trueflank {

/// The teeth that an outline turns out to have, whoever made it.
struct SectionTeeth {
  int count = 0;
  bool internal = false;
  std::size_t loop = 0;  ///< of the section
  double tip_radius_mm = 0.0, root_radius_mm = 0.0;
  double first_centre_rad = 0.0;  ///< of the tooth nearest +x; within half a pitch of it
};

/// Finds evenly spaced teeth about the origin: at least three, in the outer outline or around the bore.
/// None where no outline has them (a carrier, a housing, a bore with a key or a hexagon).
[[nodiscard]] std::optional<SectionTeeth> find_teeth(const MeshSection& section);

enum class ToothRegion { kLeftFlank, kRightFlank, kTip, kRoot };

/// Where a point of the toothed outline is. Tooth 1 is the one nearest +x in this section, numbers
/// grow counter-clockwise seen from +z; a root is that after its tooth.
/// The root region is the lowest 15 % of the height, the tip region the highest 5 %.
struct SectionPlace {
  int tooth = 0;
  ToothRegion region = ToothRegion::kTip;
};
[[nodiscard]] SectionPlace section_place(const SectionTeeth& teeth, const Point2& point);

/// "left flank of tooth 3", "root between teeth 12 and 1".
[[nodiscard]] std::string place_text(const SectionTeeth& teeth, const SectionPlace& place);
[[nodiscard]] const char* to_text(ToothRegion region);

}  // namespace trueflank
