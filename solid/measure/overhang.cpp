// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/overhang.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Outlines of one gear continue each other, turned as they may be.
bool continues(const Outline& below, const Outline& above) {
  const auto *a = std::get_if<ToothedOutline>(&below), *b = std::get_if<ToothedOutline>(&above);
  return a && b ? a->profile == b->profile : same_outline(below, above);
}

/// How far a circle reaches beyond another that it does not lie in.
double beyond_mm(const OutlineExtent& circle, const OutlineExtent& other) {
  return (circle.centre - other.centre).norm() + circle.outer_radius_mm - other.inner_radius_mm;
}

double beyond_tips_mm(const OutlineExtent& circle, const OutlineExtent& other) {
  return (circle.centre - other.centre).norm() + circle.outer_radius_mm - other.outer_radius_mm;
}

bool lies_in(const OutlineExtent& inner, const OutlineExtent& outer) {
  return beyond_mm(inner, outer) <= tolerance::kTouch_mm;
}

bool lies_beside(const OutlineExtent& a, const OutlineExtent& b) {
  return (a.centre - b.centre).norm() >= a.outer_radius_mm + b.outer_radius_mm;
}

class Hanging {
 public:
  explicit Hanging(double height_mm) : height_mm_(height_mm) {}

  /// What of a slab does not lie on the one under it; `under`: a face near below that one, or none.
  void compare(const Slab& below, const Slab& above, const Slab* under) {
    if (!continues(below.outer, above.outer)) {
      double ledge = beyond_mm(extent(above.outer), extent(below.outer));
      if (under) ledge = std::min(ledge, beyond_tips_mm(extent(above.outer), extent(under->outer)));
      take_ledge(ledge);
    }
    for (const Outline& hole : below.holes) close(hole, above);
  }

  void to_height(double height_mm) { height_mm_ = height_mm; }
  Overhang result;

 private:
  /// A hole of the lower slab under the upper one: open, narrower, or closed.
  void close(const Outline& hole, const Slab& above) {
    const OutlineExtent wide = extent(hole);
    if (lies_beside(wide, extent(above.outer))) return;
    double span = 2.0 * wide.outer_radius_mm;
    int inside = 0;
    for (const Outline& other : above.holes) {
      const OutlineExtent narrow = extent(other);
      if (continues(hole, other) || lies_in(wide, narrow)) return;
      if (lies_beside(wide, narrow)) continue;
      ++inside;
      // lines laid past the narrower hole touch it
      const double off =
          std::max(0.0, narrow.inner_radius_mm - (wide.centre - narrow.centre).norm());
      if (inside == 1 && off < wide.outer_radius_mm)
        span = 2.0 * std::sqrt(wide.outer_radius_mm * wide.outer_radius_mm - off * off);
      else
        span = off >= wide.outer_radius_mm ? 0.0 : 2.0 * wide.outer_radius_mm;
    }
    if (span <= result.bridge_mm) return;
    result.bridge_mm = span;
    result.bridge_height_mm = height_mm_;
  }

  void take_ledge(double width_mm) {
    if (width_mm <= std::max(tolerance::kTouch_mm, result.ledge_mm)) return;
    result.ledge_mm = width_mm;
    result.ledge_height_mm = height_mm_;
  }

  double height_mm_;
};

/// Of the flanks of an outline, at its larger radius.
double lean_rad(const Outline& outline) {
  const auto* teeth = std::get_if<ToothedOutline>(&outline);
  if (!teeth || teeth->twist.turn_rad_per_mm == 0.0) return 0.0;
  return std::atan(extent(outline).outer_radius_mm * std::abs(teeth->twist.turn_rad_per_mm));
}

}  // namespace

Overhang overhang(const PartShape& part, bool upside_down, double carried_mm) {
  std::vector<const Slab*> slabs;
  for (const Slab& slab : part.slabs) slabs.push_back(&slab);
  if (upside_down) std::reverse(slabs.begin(), slabs.end());
  Hanging hanging(0.0);
  double height = 0.0;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const auto height_of = [&](std::size_t k) {
      return slabs[k]->z_upper_mm - slabs[k]->z_lower_mm;
    };
    const bool near = i > 1 && height_of(i - 1) <= carried_mm + tolerance::kTouch_mm;
    if (i > 0) hanging.compare(*slabs[i - 1], *slabs[i], near ? slabs[i - 2] : nullptr);
    height += slabs[i]->z_upper_mm - slabs[i]->z_lower_mm;
    hanging.to_height(height);
    double& lean = hanging.result.lean_rad;
    lean = std::max(lean, lean_rad(slabs[i]->outer));
    for (const Outline& hole : slabs[i]->holes) lean = std::max(lean, lean_rad(hole));
  }
  return hanging.result;
}

Overhang overhang(const PartShape& part, bool upside_down, const Process& process) {
  return overhang(part, upside_down, process.layer_mm);
}

double overhang_share(const Overhang& overhang, const Process& process) {
  double share = 0.0;
  if (process.ledge_mm > 0.0) share = std::max(share, overhang.ledge_mm / process.ledge_mm);
  if (process.bridge_mm > 0.0) share = std::max(share, overhang.bridge_mm / process.bridge_mm);
  if (process.overhang_rad > 0.0) share = std::max(share, overhang.lean_rad / process.overhang_rad);
  return share;
}

}  // namespace trueflank
