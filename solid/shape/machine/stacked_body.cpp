// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/machine/stacked_body.h"

#include <algorithm>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// A toothed outline knows the height of its gear.
Outline moved_up(Outline outline, double by_mm) {
  if (auto* toothed = std::get_if<ToothedOutline>(&outline)) toothed->z_lower_mm += by_mm;
  return outline;
}

/// Whether a hole lies in another, wider one.
bool is_swallowed(const OutlineExtent& hole, const OutlineExtent& wider) {
  return hole.outer_radius_mm < wider.inner_radius_mm &&
         (hole.centre - wider.centre).norm() + hole.outer_radius_mm <= wider.inner_radius_mm;
}

/// Whether a hole lies beside what it is drilled in.
bool is_beside(const OutlineExtent& hole, const OutlineExtent& outer) {
  return (hole.centre - outer.centre).norm() >= hole.outer_radius_mm + outer.outer_radius_mm;
}

}  // namespace

void StackedBody::add(const HeightRange& z, const Outline& outer) {
  if (z.upper_mm - z.lower_mm > tolerance::kTouch_mm) pieces_.push_back({z, outer});
}

void StackedBody::drill(const HeightRange& z, const Outline& hole) {
  if (z.upper_mm - z.lower_mm > tolerance::kTouch_mm) holes_.push_back({z, hole});
}

void StackedBody::add(const std::vector<Slab>& slabs, double z_mm) {
  for (const Slab& slab : slabs) {
    const HeightRange z{slab.z_lower_mm + z_mm, slab.z_upper_mm + z_mm};
    add(z, moved_up(slab.outer, z_mm));
    for (const Outline& hole : slab.holes) drill(z, moved_up(hole, z_mm));
  }
}

StackedBody StackedBody::between(const HeightRange& z) const {
  const auto cut = [&](const HeightRange& all) {
    return HeightRange{std::max(all.lower_mm, z.lower_mm), std::min(all.upper_mm, z.upper_mm)};
  };
  StackedBody body;
  for (const Piece& piece : pieces_) body.add(cut(piece.z), piece.outline);
  for (const Piece& hole : holes_) body.drill(cut(hole.z), hole.outline);
  return body;
}

HeightRange StackedBody::heights() const {
  HeightRange all{1e300, -1e300};
  for (const Piece& piece : pieces_)
    all = {std::min(all.lower_mm, piece.z.lower_mm), std::max(all.upper_mm, piece.z.upper_mm)};
  return all;
}

std::vector<Slab> StackedBody::slabs() const {
  const HeightRange all = heights();
  std::vector<double> steps;
  for (const auto* list : {&pieces_, &holes_})
    for (const Piece& piece : *list)
      for (const double z : {piece.z.lower_mm, piece.z.upper_mm})
        steps.push_back(std::clamp(z, all.lower_mm, all.upper_mm));
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end(),
                          [](double a, double b) { return b - a < tolerance::kTouch_mm; }),
              steps.end());
  std::vector<Slab> slabs;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const double middle = 0.5 * (steps[i] + steps[i + 1]);
    const auto here = [&](const Piece& piece) {
      return piece.z.lower_mm < middle && middle < piece.z.upper_mm;
    };
    const auto piece = std::find_if(pieces_.begin(), pieces_.end(), here);
    if (piece == pieces_.end()) continue;
    Slab slab{.z_lower_mm = steps[i] - all.lower_mm,
              .z_upper_mm = steps[i + 1] - all.lower_mm,
              .outer = moved_up(piece->outline, -all.lower_mm),
              .holes = {}};
    for (const Piece& hole : holes_) {
      if (!here(hole)) continue;
      const OutlineExtent own = extent(hole.outline);
      if (is_beside(own, extent(piece->outline))) continue;
      const bool seen = std::none_of(holes_.begin(), holes_.end(), [&](const Piece& other) {
        return here(other) && is_swallowed(own, extent(other.outline));
      });
      if (seen) slab.holes.push_back(moved_up(hole.outline, -all.lower_mm));
    }
    slabs.push_back(std::move(slab));
  }
  return slabs;
}

}  // namespace trueflank
