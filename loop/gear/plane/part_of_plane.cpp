// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/part_of_plane.h"

#include <algorithm>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"

namespace trueflank::loop {
namespace {

/// An axis that a direction is that of, within what a bound tells; "" where there is none.
std::string axis_towards(double direction_deg, bool& backwards) {
  constexpr double kNearly_deg = 1.0;
  for (const auto& [axis, axis_deg] : {std::pair("x", 0.0), std::pair("y", 90.0)})
    for (const double turned_deg : {0.0, 180.0})
      if (std::abs(std::remainder(direction_deg - axis_deg - turned_deg, 360.0)) < kNearly_deg) {
        backwards = turned_deg != 0.0;
        return axis;
      }
  return "";
}

}  // namespace

double PartOfPlane::value_at(double along) const {
  using gear_effects::beyond_edge;
  if (kind == kDisc) return beyond_edge(radius_mm - along, edge_mm);
  const double beyond = beyond_edge(along - from_mm, edge_mm);
  return kind == kBeyond ? beyond : beyond * beyond_edge(to_mm - along, edge_mm);
}

bool PartOfPlane::is_distinct(double radius_of_gear_mm) const {
  constexpr double kNarrowest = 0.04, kSmallest = 0.1, kNearest = 0.5;  // of the radius
  constexpr double kSoftest = 0.15, kSoftestBound = 0.06;
  switch (kind) {
    case kStrip:
      return to_mm - from_mm >= kNarrowest * radius_of_gear_mm &&
             edge_mm <= kSoftest * (to_mm - from_mm);
    case kDisc:
      // (about the axis it is what all teeth have alike)
      return radius_mm >= kSmallest * radius_of_gear_mm && edge_mm <= kSoftest * radius_mm &&
             std::hypot(x_mm, y_mm) >= kNearest * radius_of_gear_mm;
    default:
      return edge_mm <= kSoftestBound * radius_of_gear_mm;
  }
}

std::vector<PartOfPlane> PartOfPlane::beside(double radius_of_gear_mm) const {
  std::vector<PartOfPlane> parts;
  const auto add = [&](const auto& change) {
    PartOfPlane part = *this;
    change(part);
    if (part.is_distinct(radius_of_gear_mm)) parts.push_back(part);
  };
  for (const double share : {0.03, 0.01, 0.003, 0.001, 0.0003})
    for (const double off : {-share * radius_of_gear_mm, share * radius_of_gear_mm}) {
      if (kind == kDisc) {
        add([&](PartOfPlane& p) { p.x_mm += off; });
        add([&](PartOfPlane& p) { p.y_mm += off; });
        add([&](PartOfPlane& p) { p.radius_mm += off; });
        // (the edge that faces the axis stays, or the two places where it leaves the gear do)
        const double from_axis = std::hypot(x_mm, y_mm);
        for (const double wider : {-1.0, 0.0, 1.0})
          if (from_axis > 0.0)
            add([&](PartOfPlane& p) {
              p.x_mm += off * x_mm / from_axis;
              p.y_mm += off * y_mm / from_axis;
              p.radius_mm += wider * off;
            });
        continue;
      }
      add([&](PartOfPlane& p) { p.from_mm += off; });
      if (kind == kStrip) {
        add([&](PartOfPlane& p) { p.to_mm += off; });
        add([&](PartOfPlane& p) {
          p.from_mm += off;
          p.to_mm += off;
        });
      }
      for (const double bound : {-0.5, 0.0, 0.5})
        add([&](PartOfPlane& p) {
          p.direction_deg += deg_from_rad(off / radius_of_gear_mm);
          p.from_mm += bound * off;
          p.to_mm += kind == kStrip ? bound * off : 0.0;
        });
    }
  constexpr double kFirstEdge = 0.03, kLeastEdge = 0.004;  // of the radius
  if (edge_mm == 0.0) {
    add([&](PartOfPlane& p) { p.edge_mm = kFirstEdge * radius_of_gear_mm; });
  } else {
    for (const double times : {0.6, 0.85, 0.95, 1.05, 1.2, 1.6})
      add([&](PartOfPlane& p) {
        p.edge_mm *= times;
        if (p.edge_mm < kLeastEdge * radius_of_gear_mm) p.edge_mm = 0.0;
      });
  }
  return parts;
}

std::string PartOfPlane::words() const {
  const std::string soft = edge_mm > 0.0 ? printed(", its edges %.2g mm wide", edge_mm) : "";
  if (kind == kDisc)
    return "in a disc of the plane" + printed(" about x = %.3g mm", x_mm) +
           printed(", y = %.3g mm", y_mm) + printed(", %.3g mm in radius", radius_mm) + soft;
  bool backwards = false;
  const std::string axis = axis_towards(direction_deg, backwards);
  if (axis.empty()) {
    const std::string towards =
        printed(" of the axis, towards %.3g deg", std::fmod(direction_deg + 720.0, 360.0));
    return kind == kStrip ? "in a strip of the plane between" + printed(" %.3g mm", from_mm) +
                                printed(" and %.3g mm", to_mm) + towards + soft
                          : "in the plane beyond" + printed(" %.3g mm", from_mm) + towards + soft;
  }
  const double from = backwards ? -(kind == kStrip ? to_mm : from_mm) : from_mm,
               to = backwards ? -from_mm : to_mm;
  return "where " + axis +
         (kind == kStrip ? " lies between" + printed(" %.3g mm", from) + printed(" and %.3g mm", to)
                         : (backwards ? " is below" : " is above") + printed(" %.3g mm", from)) +
         soft;
}

}  // namespace trueflank::loop
