// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/assembly_clearance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/measure/body_layers.h"
#include "trueflank/solid/shape/crossing_outlines.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

struct Body {
  const Placement* placement = nullptr;
  const PartShape* part = nullptr;
  int frame =
      kNoMember;  ///< bodies of one frame do not turn against each other about the train's axis
  std::vector<BodyLayer> layers;
  std::vector<BodyLayer> turning;  ///< what they sweep about an axis of their own; empty: the train's
};

/// What a layer sweeps about the train's axis.
struct Sweep {
  double inner_mm = 0.0, outer_mm = 0.0;
};

Sweep sweep_of(const BodyLayer& layer) {
  const double off = layer.outer.centre.norm(), r = layer.outer.radius_mm;
  Sweep sweep{std::max(0.0, off - r), off + r};
  if (off >= r) return sweep;
  for (const Disc& hole : layer.holes)
    sweep.inner_mm = std::max(sweep.inner_mm, hole.radius_mm - hole.centre.norm());
  return sweep;
}

/// A layer of a body that turns about an axis beside the train's, as the ring that it sweeps.
BodyLayer swept(const BodyLayer& layer, const Point2& axis) {
  BodyLayer moved = layer;
  moved.outer.centre -= axis;
  for (Disc& hole : moved.holes) hole.centre -= axis;
  const Sweep sweep = sweep_of(moved);
  moved.outer = {axis, sweep.outer_mm};
  moved.holes = {{axis, sweep.inner_mm}};
  return moved;
}

double gap_in_turning_mm(const BodyLayer& a, const BodyLayer& b) {
  const Sweep s = sweep_of(a), t = sweep_of(b);
  return std::max(s.inner_mm - t.outer_mm, t.inner_mm - s.outer_mm);
}

Body body_of(const GearTrain& train, const PartShapes& shapes, const Placement& placement) {
  const PartShape& part = shapes.parts[static_cast<std::size_t>(placement.part)];
  const Topology& topology = train.topology();
  Body body{.placement = &placement, .part = &part, .frame = part.member};
  if (part.member != kNoMember) {
    if (topology.is_planet(part.member)) body.frame = topology.carrier_of(part.member);
    const auto& fixed = topology.fixed;
    if (std::find(fixed.begin(), fixed.end(), body.frame) != fixed.end()) body.frame = kNoMember;
  }
  body.layers = body_layers(part, placement);
  if (topology.has_planets()) return body;
  for (const BodyLayer& layer : body.layers)
    body.turning.push_back(body.frame == kNoMember
                               ? layer
                               : swept(layer, axis_centre_mm(train, train.phases, body.frame)));
  return body;
}

/// A set screw with its nut, across the hub of what is driven: rings that they sweep.
struct AcrossTheHub {
  PartShape part;
  Placement placement;

  AcrossTheHub(const GearTrain& train, const MachineLayout& m) {
    const auto& s = m.set_screw;
    placement.name = "set screw " + s.screw.name;
    part.name = placement.name;
    part.member = train.topology().input;
    part.bought = placement.name;
  }
  [[nodiscard]] Body body(const GearTrain& train, const MachineLayout& m) const {
    const auto& s = m.set_screw;
    const double shaft = 0.5 * train.design.machine->motor.shaft_diameter_mm;
    const auto ring = [&](double half_height_mm, double outer_mm, double inner_mm) {
      return BodyLayer{m.z({s.axis_mm - half_height_mm, s.axis_mm + half_height_mm}),
                       {Point2::Zero(), outer_mm},
                       {{Point2::Zero(), inner_mm}}};
    };
    Body body{.placement = &placement, .part = &part, .frame = part.member};
    body.layers.push_back(ring(0.5 * s.screw.diameter_mm, s.bears_mm + s.length_mm, shaft));
    if (s.nut) body.layers.push_back(ring(0.5 * s.pocket_width_mm, s.pocket_end_mm, shaft));
    if (!train.topology().has_planets()) body.turning = body.layers;  // the motor's axis is the origin
    return body;
  }
};

/// The motor's shaft turns with what is on it.
bool is_shaft_in_bore(const GearTrain& train, const Body& a, const Body& b) {
  return a.part->bought.starts_with("motor ") && b.part->member == train.topology().input &&
         b.part->bought.empty();
}

/// A set screw is in the hub that it holds.
bool is_in_hub(const Body& a, const Body& b) {
  return a.part->bought.starts_with("set screw ") && b.part->bought.empty() && a.part->member == b.part->member;
}

class Judge {
 public:
  Judge(const GearTrain& train, double pressed_mm)
      : train_(train), meant_mm_(pressed_mm + tolerance::kTouch_mm) {}

  void compare(const Body& a, const Body& b) {
    if (is_shaft_in_bore(train_, a, b) || is_shaft_in_bore(train_, b, a)) return;
    if (is_in_hub(a, b) || is_in_hub(b, a)) return;
    const bool turning = a.frame != b.frame;
    const bool own_axes = turning && !a.turning.empty();
    double least = 1e300;
    for (const BodyLayer& s : own_axes ? a.turning : a.layers)
      for (const BodyLayer& t : own_axes ? b.turning : b.layers) {
        if (s.teeth && t.teeth) continue;
        const double along = std::max(s.z.lower_mm - t.z.upper_mm, t.z.lower_mm - s.z.upper_mm);
        const double across = turning && !own_axes ? gap_in_turning_mm(s, t) : gap_at_rest_mm(s, t);
        least = std::min(least, std::max(along, across));
      }
    if (least < -meant_mm_)
      result.collisions.push_back({a.placement->name, b.placement->name, -least});
    const bool made = a.part->bought.empty() && b.part->bought.empty();
    if (!turning || !made || least >= result.least_gap_mm) return;
    result.least_gap_mm = least;
    result.body1 = a.placement->name;
    result.body2 = b.placement->name;
  }

  AssemblyClearance result;

 private:
  const GearTrain& train_;
  double meant_mm_;  ///< so deep one part is pressed into another
};

}  // namespace

AssemblyClearance assembly_clearance(const GearTrain& train, const PartShapes& shapes) {
  std::vector<Body> bodies;
  for (const Placement& placement : shapes.assembly)
    bodies.push_back(body_of(train, shapes, placement));
  const auto layout = machine_layout(train);
  std::optional<AcrossTheHub> across;
  if (layout && layout->set_screw.is_there()) {
    across.emplace(train, *layout);
    bodies.push_back(across->body(train, *layout));
  }
  Judge judge(train, layout ? layout->press_mm : 0.0);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) judge.compare(bodies[j], bodies[i]);
  return std::move(judge.result);
}

ThinnestWall thinnest_wall(const PartShape& part) {
  ThinnestWall thinnest;
  const auto take = [&](double width_mm, double height_mm) {
    if (width_mm >= thinnest.width_mm) return;  // NaN: the first one
    thinnest = {width_mm, height_mm};
  };
  for (const Slab& slab : part.slabs) {
    const OutlineExtent outer = extent(slab.outer);
    for (std::size_t i = 0; i < slab.holes.size(); ++i) {
      const OutlineExtent hole = extent(slab.holes[i]);
      take(outer.inner_radius_mm - hole.outer_radius_mm - (outer.centre - hole.centre).norm(),
           slab.z_lower_mm);
      for (std::size_t j = 0; j < i; ++j) {
        const OutlineExtent other = extent(slab.holes[j]);
        take((other.centre - hole.centre).norm() - hole.outer_radius_mm - other.outer_radius_mm,
             slab.z_lower_mm);
      }
    }
  }
  // a hole that runs out of the layer below or above it
  for (const OutlineCrossing& crossing : outline_crossings(part)) take(-crossing.depth_mm, crossing.height_mm);
  return thinnest;
}

}  // namespace trueflank
