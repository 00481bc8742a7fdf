// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/assembly_clearance.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/measure/body_layers.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/carrier.h"

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

/// The motor's shaft turns with what is on it.
bool is_shaft_in_bore(const GearTrain& train, const Body& a, const Body& b) {
  return a.part->bought.starts_with("motor ") && b.part->member == train.topology().input &&
         b.part->bought.empty();
}

class Judge {
 public:
  explicit Judge(const GearTrain& train) : train_(train) {}

  void compare(const Body& a, const Body& b) {
    if (is_shaft_in_bore(train_, a, b) || is_shaft_in_bore(train_, b, a)) return;
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
    if (least < -tolerance::kTouch_mm)
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
};

}  // namespace

AssemblyClearance assembly_clearance(const GearTrain& train, const PartShapes& shapes) {
  std::vector<Body> bodies;
  for (const Placement& placement : shapes.assembly)
    bodies.push_back(body_of(train, shapes, placement));
  Judge judge(train);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) judge.compare(bodies[j], bodies[i]);
  return std::move(judge.result);
}

ThinnestWall thinnest_wall(const PartShape& part) {
  ThinnestWall thinnest;
  const auto take = [&](double width_mm, const Slab& slab) {
    if (width_mm >= thinnest.width_mm) return;  // NaN: the first one
    thinnest = {width_mm, slab.z_lower_mm};
  };
  for (const Slab& slab : part.slabs) {
    const OutlineExtent outer = extent(slab.outer);
    for (std::size_t i = 0; i < slab.holes.size(); ++i) {
      const OutlineExtent hole = extent(slab.holes[i]);
      take(outer.inner_radius_mm - hole.outer_radius_mm - (outer.centre - hole.centre).norm(),
           slab);
      for (std::size_t j = 0; j < i; ++j) {
        const OutlineExtent other = extent(slab.holes[j]);
        take((other.centre - hole.centre).norm() - hole.outer_radius_mm - other.outer_radius_mm,
             slab);
      }
    }
  }
  return thinnest;
}

}  // namespace trueflank
