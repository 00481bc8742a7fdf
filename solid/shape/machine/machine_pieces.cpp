// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/machine/machine_pieces.h"

#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// A journal ends this much below its bearing's upper face: the bearing is clamped, not the
/// journal.
constexpr double kClamp_mm = 0.05;
/// A hub's bore is this much wider where the shaft is round, on the radius.
constexpr double kRoundRoom_mm = 0.1;
/// Out of any body, on either side.
constexpr double kBeyond_mm = 1e4;

}  // namespace

std::optional<ToothedOutline> straight_teeth(const PartShape& part, double at_mm) {
  const auto plain = [&](const Outline& outline) -> std::optional<ToothedOutline> {
    const auto* teeth = std::get_if<ToothedOutline>(&outline);
    if (!teeth || !is_plain_prism(*teeth)) return std::nullopt;
    ToothedOutline moved = *teeth;
    moved.z_lower_mm += at_mm;
    return moved;
  };
  if (part.slabs.size() != 1) return std::nullopt;
  const Slab& slab = part.slabs.front();
  if (auto outer = plain(slab.outer)) return outer;
  return slab.holes.empty() ? std::nullopt : plain(slab.holes.front());
}

HeightRange MachinePieces::z(double from, double to) const {
  return m_.z({std::min(from, to), std::max(from, to)});
}

void MachinePieces::drill(StackedBody& body, const ScrewGroup& group, const Point2& axis) const {
  const Screw& screw = group.screw;
  const double insert = std::isnan(group.insert_mm) ? group.far_mm : group.insert_mm;
  for (const Point2& place : group.at) {
    const Point2 at = place + group.axis - axis;
    body.drill(z(group.head_mm - group.way * kBeyond_mm, group.head_mm),
               circle(0.5 * screw.head_diameter_mm + kHeadRoom_mm, at));
    body.drill(z(group.head_mm, insert), circle(0.5 * screw.hole_mm, at));
    if (!std::isnan(group.insert_mm))
      body.drill(z(insert, group.far_mm), circle(0.5 * screw.insert_hole_mm, at));
  }
}

void MachinePieces::drill_insert_ends(StackedBody& body, const ScrewGroup& group) const {
  for (const Point2& at : group.at) {
    body.drill(z(m_.disc.upper_mm, group.insert_mm), circle(0.5 * group.screw.hole_mm, at));
    body.drill(z(group.insert_mm, group.far_mm), circle(0.5 * group.screw.insert_hole_mm, at));
  }
}

void MachinePieces::drill_floor(StackedBody& body, const Point2& axis) const {
  body.drill(z(m_.floor.lower_mm, m_.floor.upper_mm), circle(m_.floor_hole_radius_mm, -axis));
}

void MachinePieces::add_hub(StackedBody& body, const BoreDesign& bore, const PartShape& gear,
                            double at_mm) const {
  const auto& s = m_.set_screw;
  if (!s.is_there()) {
    body.add(z(m_.hub.lower_mm, m_.hub.upper_mm), circle(m_.hub_radius_mm));
    return drill_shaft(body, bore);
  }
  if (s.nut)
    body.add(z(s.foot.lower_mm, s.foot.upper_mm),
             BoreOutline{{.diameter_mm = 2.0 * s.foot_radius_mm,
                          .kind = BoreKind::kDFlat,
                          .d_flat_mm = s.foot_radius_mm + s.flat_mm}});
  else
    body.add(z(s.foot.lower_mm, s.foot.upper_mm), circle(s.foot_radius_mm));
  const auto teeth = m_.toothed_hub ? straight_teeth(gear, at_mm) : std::nullopt;
  body.add(z(s.foot.upper_mm, m_.hub.upper_mm),
           teeth ? Outline{*teeth} : Outline{circle(m_.hub_radius_mm)});
  if (s.nut)
    body.drill(z(s.pocket.lower_mm, s.pocket.upper_mm),
               BoreOutline{{.diameter_mm = s.pocket_bore_mm,
                            .kind = BoreKind::kKeyway,
                            .keyway_width_mm = s.pocket_width_mm,
                            .keyway_depth_mm = s.pocket_end_mm - 0.5 * s.pocket_bore_mm}});
  if (!s.nut) return drill_shaft(body, bore);
  body.drill(z(s.pocket.upper_mm, kBeyond_mm), BoreOutline{bore});
}

void MachinePieces::drill_shaft(StackedBody& body, const BoreDesign& bore) const {
  if (!(bore.diameter_mm > 0.0)) return;
  const bool flat = bore.kind == BoreKind::kDFlat;
  const double from = flat ? std::max(m_.flat_from_mm, m_.hub.lower_mm) : -kBeyond_mm;
  if (flat) body.drill(z(-kBeyond_mm, from), circle(0.5 * bore.diameter_mm + kRoundRoom_mm));
  body.drill(z(from, m_.driven_gear < 0 ? m_.near.upper_mm : kBeyond_mm), BoreOutline{bore});
}

void MachinePieces::add_cup(StackedBody& body, const PartShape& part, double at_mm) const {
  double end = m_.way > 0.0 ? body.heights().upper_mm : -body.heights().lower_mm;
  // straight teeth go on a little: what is in mesh stays clear of the cup
  if (const auto teeth = straight_teeth(part, at_mm)) {
    const double to = std::max(end, m_.cup_over_mm) + m_.clearance_mm;
    body.add(z(end, to), circle(m_.cup_radius_mm));
    body.drill(z(end, to), *teeth);
    end = to;
  }
  body.add(z(end, m_.disc.upper_mm), circle(m_.cup_radius_mm));
  body.drill(z(end, m_.disc.lower_mm), circle(m_.cup_inner_radius_mm));
  drill_insert_ends(body, m_.output_screws);
}

PartShape& MachinePieces::add_part(std::string name, const StackedBody& body, int member,
                                   PartRole role, double rotation_rad, const Point2& axis) {
  shapes_.parts.push_back(
      {.name = std::move(name), .slabs = body.slabs(), .member = member, .role = role});
  shapes_.assembly.push_back({.part = static_cast<int>(shapes_.parts.size()) - 1,
                              .name = shapes_.parts.back().name,
                              .rotation_rad = rotation_rad,
                              .translation_mm = {axis.x(), axis.y(), body.heights().lower_mm}});
  return shapes_.parts.back();
}

void MachinePieces::add_retainer(double rotation_rad) {
  StackedBody ring;
  ring.add(z(m_.retainer.lower_mm, m_.retainer.upper_mm), circle(m_.retainer_radius_mm));
  ring.drill(z(m_.retainer.lower_mm, m_.retainer.upper_mm), circle(m_.outer_shoulder_mm));
  drill(ring, m_.retainer_screws, m_.output_axis);
  add_part("retainer", ring, kNoMember, PartRole::kCasing, rotation_rad, m_.output_axis)
      .upside_down = m_.way > 0.0;
}

void MachinePieces::drill_seat(StackedBody& lid, const Point2& axis) const {
  const Point2 at = m_.output_axis - axis;
  lid.drill(z(m_.roof.lower_mm, m_.bearings.upper_mm),
            circle(0.5 * m_.fits.output.hole_mm(machine_.bearings.output.outer_mm), at));
  lid.drill(z(m_.bearings.upper_mm, m_.roof.upper_mm), circle(m_.outer_shoulder_mm, at));
}

void MachinePieces::add_output(int member, double rotation_rad) {
  StackedBody journal, plate;
  journal.add(z(m_.disc.upper_mm, m_.bearings.lower_mm), circle(m_.inner_shoulder_mm));
  journal.add(z(m_.bearings.lower_mm, m_.bearings.upper_mm - kClamp_mm),
              circle(m_.journal_radius_mm));
  plate.add(z(m_.bearings.upper_mm, m_.plate.lower_mm), circle(m_.inner_shoulder_mm));
  plate.add(z(m_.plate.lower_mm, m_.plate.upper_mm), circle(m_.plate_radius_mm));
  drill(journal, m_.output_screws, m_.output_axis);
  drill(plate, m_.output_screws, m_.output_axis);
  const Screw& load = machine_.fasteners.output;
  const double insert = std::min(m_.bearings.upper_mm + load.insert_length_mm, m_.plate.upper_mm);
  for (const Point2& at : m_.load_inserts) {
    plate.drill(z(m_.bearings.upper_mm, insert), circle(0.5 * load.insert_hole_mm, at));
    plate.drill(z(insert, m_.plate.upper_mm), circle(0.5 * load.hole_mm, at));
  }
  add_part("journal", journal, member, PartRole::kOutput, rotation_rad, m_.output_axis)
      .upside_down = m_.way < 0.0;
  add_part("output", plate, member, PartRole::kOutput, rotation_rad, m_.output_axis).upside_down =
      m_.way > 0.0;
}

void MachinePieces::add_bought(BoughtParts& bought, int output_member, double held_turn_rad,
                               double output_turn_rad, double shaft_turn_rad) const {
  bought.add_motor(machine_.motor, held_turn_rad, shaft_turn_rad);
  bought.add_screws(m_.motor_screws, kNoMember, held_turn_rad);
  bought.add_screws(m_.housing_screws, kNoMember, held_turn_rad);
  bought.add_screws(m_.retainer_screws, kNoMember, held_turn_rad);
  bought.add_screws(m_.output_screws, output_member, output_turn_rad);
  bought.add_inserts(machine_.fasteners.output, "load", m_.load_inserts, m_.bearings.upper_mm,
                     output_member, output_turn_rad, m_.output_axis);
  const Bearing& bearing = machine_.bearings.output;
  for (int i = 0; i < machine_.bearings.outputs; ++i)
    bought.add_bearing(bearing, {m_.output_axis}, m_.bearings.lower_mm + i * bearing.width_mm,
                       kNoMember);
}

}  // namespace trueflank
