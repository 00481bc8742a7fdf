// SPDX-License-Identifier: GPL-3.0-or-later
// One gear: its exact tooth, the sizes to measure, and a polygon within a tolerance.
#include <cstdio>

#include "trueflank/geometry/polyline.h"
#include "trueflank/geometry/tooth_profile.h"
#include "trueflank/geometry/tooth_span.h"

int main() {
  using namespace trueflank;
  Gear gear{.teeth = 17, .normal_module_mm = 2.0, .shift = 0.2};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  if (!profile) {
    std::fprintf(stderr, "%s\n", profile.error().message.c_str());
    return 1;
  }
  const int teeth = recommended_span_teeth(gear);
  std::printf("tip %.3f mm, root %.3f mm, involute from diameter %.4f mm%s\n",
              2.0 * profile->tip_radius_mm(), 2.0 * profile->root_radius_mm(),
              2.0 * profile->root_form_radius_mm(), profile->notes().undercut ? ", undercut" : "");
  std::printf("span over %d teeth %.4f mm\n", teeth, base_tangent_length_mm(gear, teeth));
  const SectionPolygon section = section_polygon(*profile, 0.001);
  std::printf("%zu points keep it within %.2f um\n", section.points.size(),
              1000.0 * section.chord_error_mm);
}
