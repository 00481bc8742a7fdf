// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/body_layers.h"

#include <algorithm>

#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {

std::vector<BodyLayer> body_layers(const PartShape& part, const Placement& placement) {
  const Point2 move(placement.translation_mm[0], placement.translation_mm[1]);
  const auto disc = [&](const OutlineExtent& e, double radius_mm) {
    return Disc{rotated(e.centre, placement.rotation_rad) + move, radius_mm};
  };
  std::vector<BodyLayer> layers;
  for (const Slab& slab : part.slabs) {
    const OutlineExtent outer = extent(slab.outer);
    BodyLayer layer{{slab.z_lower_mm + placement.translation_mm[2],
                     slab.z_upper_mm + placement.translation_mm[2]},
                    disc(outer, outer.outer_radius_mm),
                    {},
                    std::get_if<ToothedOutline>(&slab.outer)};
    for (const Outline& hole : slab.holes) {
      const OutlineExtent e = extent(hole);
      layer.holes.push_back(disc(e, e.inner_radius_mm));
      if (!layer.teeth) layer.teeth = std::get_if<ToothedOutline>(&hole);
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

double gap_at_rest_mm(const BodyLayer& a, const BodyLayer& b) {
  double gap = (a.outer.centre - b.outer.centre).norm() - a.outer.radius_mm - b.outer.radius_mm;
  const auto inside = [&](const BodyLayer& in, const BodyLayer& out) {
    for (const Disc& hole : out.holes)
      gap = std::max(gap,
                     hole.radius_mm - in.outer.radius_mm - (in.outer.centre - hole.centre).norm());
  };
  inside(a, b);
  inside(b, a);
  return gap;
}

}  // namespace trueflank
