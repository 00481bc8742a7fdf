// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/units.h"
#include "trueflank/export/section/kerf_path.h"

namespace trueflank::io {

Result<KerfSections> kerf_sections(const PartShape& part, double kerf_mm, double tolerance_mm) {
  KerfSections result;
  const std::string suffix = "_KERF_" + std::to_string(std::lround(um_from_mm(kerf_mm))) + "UM";
  for (const Slab& slab : part.slabs) {
    Section section{"section " + std::to_string(result.sections.size() + 1), slab.z_lower_mm,
                    slab.z_upper_mm, {}};
    SectionBody path{part.name + suffix, part.role, {}, {}};
    SectionBody as_cut{part.name + "_AS_CUT", part.role, {}, {}};
    as_cut.frozen = true;
    std::size_t unreached = 0;
    const auto add = [&](const Outline& outline, bool hole) -> Status {
      auto made = kerf_path(outline, hole, kerf_mm, tolerance_mm);
      if (!made) return fail(std::move(made.error()));
      unreached += made->corners.size();
      result.deviation_mm = std::max(result.deviation_mm, made->deviation_mm);
      for (const UnreachedCorner& corner : made->corners)
        result.left_mm = std::max(result.left_mm, corner.left_mm);
      if (hole) {
        path.holes.push_back(std::move(made->path));
        as_cut.holes.push_back(std::move(made->as_cut));
      } else {
        path.outer = std::move(made->path);
        as_cut.outer = std::move(made->as_cut);
      }
      return {};
    };
    if (auto ok = add(slab.outer, false); !ok) return fail(std::move(ok.error()));
    for (const Outline& hole : slab.holes)
      if (auto ok = add(hole, true); !ok) return fail(std::move(ok.error()));
    section.bodies.push_back(std::move(path));
    if (unreached > 0) section.bodies.push_back(std::move(as_cut));
    result.unreached += unreached;
    result.sections.push_back(std::move(section));
  }
  return result;
}

}  // namespace trueflank::io
