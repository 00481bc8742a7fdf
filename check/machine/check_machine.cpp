// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_machine.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/machine/check_access.h"
#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/machine/check_fits.h"
#include "trueflank/check/machine/check_overhang.h"
#include "trueflank/check/machine/check_shaft.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/assembly_order.h"

namespace trueflank {
namespace {

/// What turns and what does not stay this part of clearance_mm apart, or it is reported.
constexpr double kLeastGap = 0.5;

Finding housing_size(const MachineLayout& m) {
  const double needed = 2.0 * m.least_outer_radius_mm, value = 2.0 * m.asked_radius_mm;
  return judged(
      {.id = "housing_size",
       .where = "housing",
       .value = value,
       .limit = needed,
       .unit = "mm",
       .message =
           "outer diameter " + mm_text(value) + ", gears, screws and walls need " + mm_text(needed),
       .cure = "outer_diameter_mm in [housing] of " + mm_text(std::ceil(10.0 * needed) / 10.0) +
               " at least, or smaller fasteners.housing"},
      needed);
}

Findings walls(const GearTrain& train, const MachineLayout& m, const PartShapes& shapes) {
  Findings findings;
  const auto& process = train.design.made.process;
  const double least = process ? process->least_wall_mm : 0.5 * m.wall_mm;
  for (const PartShape& part : shapes.parts) {
    if (!part.bought.empty()) continue;
    const ThinnestWall wall = thinnest_wall(part);
    if (std::isnan(wall.width_mm)) continue;
    Finding finding =
        judged({.id = "wall",
                .where = part.name,
                .value = wall.width_mm,
                .limit = least,
                .unit = "mm",
                .message = part.name + ": the thinnest wall is " + mm_text(wall.width_mm) + ", " +
                           mm_text(wall.height_mm) + " above its lower face",
                .cure = "a larger outer_diameter_mm, smaller fasteners, or another bearing"},
               1e-3);
    if (finding.status != CheckStatus::kPass && m.idle_gear >= 0 &&
        part.name == train.topology().gears[static_cast<std::size_t>(m.idle_gear)].name)
      finding.cure = "no [" + part.name + "]: it idles; or a motor whose shaft ends below it";
    if (finding.status == CheckStatus::kFail)
      finding.message = part.name + ": two surfaces run into each other by " +
                        mm_text(-wall.width_mm) + ", " + mm_text(wall.height_mm) +
                        " above its lower face";
    findings.push_back(std::move(finding));
  }
  return findings;
}

Finding judge_screws(const ScrewGroup& group) {
  Finding finding{.id = "screws",
                  .where = group.what,
                  .value = group.length_mm,
                  .limit = group.shortest_mm,
                  .unit = "mm"};
  const std::string range = mm_text(group.shortest_mm) + " to " + mm_text(group.longest_mm);
  if (group.fits()) {
    finding.margin = group.length_mm - group.shortest_mm;
    finding.message = std::to_string(group.at.size()) + " screws " + group.screw.name + " of " +
                      mm_text(group.length_mm) + " hold; " + range + " would";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  finding.margin = -1.0;
  finding.message = "no stocked " + group.screw.name + " is " + range + " long";
  finding.cure = group.what == "motor" ? "another floor_mm in [housing]"
                 : group.what == "carrier"
                     ? "a thicker plate_thickness_mm in [carrier], or another screw for "
                       "fasteners.carrier"
                     : "another screw in [fasteners], or longer ones ([screw.NAME])";
  return finding;
}

/// Whether a key gets to every head: the heads of the motor's screws lie in the cavity.
Finding screw_access(const MachineLayout& m) {
  const ScrewGroup& group = m.motor_screws;
  double room = 1e300;
  for (const Point2& at : group.at)
    room = std::min(room, m.cavity_radius_mm - (at + group.axis - m.housing_axis).norm() -
                              0.5 * group.screw.head_diameter_mm);
  return judged(
      {.id = "screw_access",
       .where = "motor",
       .value = room,
       .limit = 0.0,
       .unit = "mm",
       .message =
           room < 0.0
               ? "the heads of the motor's screws run into the housing's wall by " + mm_text(-room)
               : "the heads of the motor's screws clear the housing's wall by " + mm_text(room),
       .cure = "a motor of a smaller screw circle, or larger gears"},
      0.0);
}

Finding collision(const GearTrain& train, const PartShapes& shapes) {
  const AssemblyClearance clearance = assembly_clearance(train, shapes);
  Finding finding{.id = "collision",
                  .where = "train",
                  .value = clearance.least_gap_mm,
                  .limit = 0.0,
                  .margin = clearance.least_gap_mm,
                  .unit = "mm"};
  if (clearance.collisions.empty()) {
    finding.message = "nothing runs into anything through a whole turn; " + clearance.body1 +
                      " and " + clearance.body2 + " come nearest, " +
                      mm_text(clearance.least_gap_mm);
    const double wanted = kLeastGap * train.design.machine->housing.clearance_mm;
    if (clearance.least_gap_mm >= wanted - tolerance::kTouch_mm) return finding;
    finding.status = CheckStatus::kWarn;
    finding.limit = wanted;
    finding.margin = clearance.least_gap_mm - wanted;
    finding.message += ": they may rub";
    finding.cure = "a gap of " + mm_text(wanted) + ": other sizes of the two";
    const auto is_planet = [](const std::string& body) { return body.starts_with("planet"); };
    if (is_planet(clearance.body1) || is_planet(clearance.body2))
      finding.cure = "a gap of " + mm_text(wanted) +
                     ": where a planet stands against a ring's cup, a face_width_mm of the ring that "
                     "is larger";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  const auto deepest = std::max_element(
      clearance.collisions.begin(), clearance.collisions.end(),
      [](const Collision& a, const Collision& b) { return a.depth_mm < b.depth_mm; });
  finding.value = finding.margin = -deepest->depth_mm;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, clearance.collisions.size()); ++i) {
    const Collision& c = clearance.collisions[i];
    finding.message +=
        (i > 0 ? "; " : "") + c.body1 + " runs into " + c.body2 + " by " + mm_text(c.depth_mm);
  }
  if (clearance.collisions.size() > 4)
    finding.message += "; and " + std::to_string(clearance.collisions.size() - 4) + " more";
  finding.cure = "other sizes of the two: see their tables";
  return finding;
}

std::string body_text(const PartShapes& shapes, std::size_t body) {
  return shapes.assembly[body].name;
}

/// Two of the bodies that hold each other: made ones with teeth say most.
std::pair<std::size_t, std::size_t> held_pair(const PartShapes& shapes,
                                              const std::vector<std::size_t>& stuck) {
  std::vector<std::size_t> gears;
  for (const std::size_t body : stuck)
    if (const PartRole role =
            shapes.parts[static_cast<std::size_t>(shapes.assembly[body].part)].role;
        role == PartRole::kSun || role == PartRole::kPlanet || role == PartRole::kRing ||
        role == PartRole::kUpperRing)
      gears.push_back(body);
  const std::vector<std::size_t>& from = gears.size() > 1 ? gears : stuck;
  return {from.front(), from[1]};
}

Finding order_of_assembly(const GearTrain& train, const PartShapes& shapes, const AssemblyOrder& order,
                          bool collides) {
  Finding finding{.id = "assembly_order",
                  .where = "train",
                  .value = static_cast<double>(order.stuck.size()),
                  .limit = 0.0,
                  .margin = -static_cast<double>(order.stuck.size())};
  if (order.exists()) {
    finding.margin = 0.0;
    finding.message = "all " + std::to_string(shapes.assembly.size()) +
                      " bodies go in along the axis one after the other, none meets another";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  const auto [one, other] = held_pair(shapes, order.stuck);
  finding.message = std::to_string(order.stuck.size()) +
                    " bodies hold each other and cannot be put together along the axis, " +
                    body_text(shapes, one) + " and " + body_text(shapes, other) + " among them";
  const auto any_gear = [&](const auto& is) {
    return std::any_of(train.gears.begin(), train.gears.end(), is);
  };
  const auto carrier = carrier_layout(train);
  if (any_gear([](const TrainGear& gear) { return gear.twist.herringbone; }))
    finding.cure =
        "herringbone = false in [gearbox]: such teeth go in only where every ring is made in halves";
  else if (carrier && any_gear([&](const TrainGear& gear) {
             return gear.profile.gear().kind == GearKind::kInternal &&
                    gear.profile.tip_radius_mm() < 0.5 * carrier->outer_diameter_mm;
           }))
    finding.cure = "a smaller outer_diameter_mm in [carrier], or none: it follows from the rings";
  else if (collides)
    finding.cure = "see collision: what runs into each other holds each other";
  else
    finding.cure = "other sizes of the two: see their tables";
  return finding;
}

}  // namespace

Finding judged(Finding finding, double least) {
  finding.margin = finding.value - finding.limit;
  if (std::abs(finding.margin) < tolerance::kTouch_mm) finding.margin = 0.0;
  finding.status = finding.margin >= 0.0    ? CheckStatus::kPass
                   : finding.value >= least ? CheckStatus::kWarn
                                            : CheckStatus::kFail;
  if (finding.status == CheckStatus::kPass) finding.cure.clear();
  return finding;
}

Findings check_machine(const GearTrain& train, const PartShapes& shapes) {
  const auto layout = machine_layout(train);
  if (!layout) return {};
  const MachineLayout& m = *layout;
  Findings all{housing_size(m)};
  const auto append = [&](Findings some) { all.insert(all.end(), some.begin(), some.end()); };
  append(walls(train, m, shapes));
  append(check_overhangs(train, shapes));
  for (const ScrewGroup* group : {&m.motor_screws, &m.housing_screws, &m.carrier_screws,
                                  &m.output_screws, &m.retainer_screws})
    if (!group->at.empty()) all.push_back(judge_screws(*group));
  all.push_back(screw_access(m));
  all.push_back(shaft_grip(train, m));
  append(check_bearings(train, m));
  append(check_fits(train));
  all.push_back(collision(train, shapes));
  const bool collides = all.back().status == CheckStatus::kFail;
  const AssemblyOrder order = assembly_order(train, shapes);
  all.push_back(order_of_assembly(train, shapes, order, collides));
  append(check_access(train, m, shapes, order));
  return all;
}

}  // namespace trueflank
