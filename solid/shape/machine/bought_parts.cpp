// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/machine/bought_parts.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/number_text.h"
#include "trueflank/solid/shape/machine/machine_pieces.h"

namespace trueflank {
namespace {

/// Outlines of layers that touch have no arc in common.
constexpr double kApart_mm = 0.02;

/// "m3x12", fit for a file's name.
std::string file_text(std::string text) {
  text = lowered(text);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

std::string thread_text(const Screw& screw) { return "M" + trimmed_number(screw.diameter_mm, 2); }

}  // namespace

void BoughtParts::place(const std::string& name, const std::string& designation,
                        std::vector<Layer> layers, const std::vector<Point2>& at, int member,
                        double rotation_rad, const Point2& axis) {
  double lower = 1e300;
  for (Layer& layer : layers) {
    const HeightRange z =
        m_.z({std::min(layer.from_mm, layer.to_mm), std::max(layer.from_mm, layer.to_mm)});
    layer.from_mm = z.lower_mm;
    layer.to_mm = z.upper_mm;
    lower = std::min(lower, z.lower_mm);
  }
  std::sort(layers.begin(), layers.end(),
            [](const Layer& a, const Layer& b) { return a.from_mm < b.from_mm; });
  const auto is_it = [&](const PartShape& part) {
    return part.name == name && part.member == member;
  };
  auto part = std::find_if(shapes_.parts.begin(), shapes_.parts.end(), is_it);
  if (part == shapes_.parts.end()) {
    PartShape made{.name = name,
                   .slabs = {},
                   .member = member,
                   .role = PartRole::kBought,
                   .bought = designation};
    for (const Layer& layer : layers)
      made.slabs.push_back({layer.from_mm - lower, layer.to_mm - lower, layer.outer, layer.holes});
    part = shapes_.parts.insert(shapes_.parts.end(), std::move(made));
  }
  const int index = static_cast<int>(part - shapes_.parts.begin());
  int number = static_cast<int>(std::count_if(shapes_.assembly.begin(), shapes_.assembly.end(),
                                              [&](const Placement& p) { return p.part == index; }));
  for (const Point2& p : at) {
    const Point2 there = rotated(p, rotation_rad) + axis;
    shapes_.assembly.push_back({.part = index,
                                .name = name + " " + std::to_string(++number),
                                .rotation_rad = rotation_rad,
                                .translation_mm = {there.x(), there.y(), lower}});
  }
}

void BoughtParts::add_motor(const Motor& motor, double rotation_rad, double shaft_turn_rad) {
  const double face = m_.floor.lower_mm, shaft = 0.5 * motor.shaft_diameter_mm;
  // its can is drawn round; the holes of its screws are as deep as they reach
  const double body = std::max(
      0.5 * motor.body_mm, 0.5 * motor.bolt_circle_diameter_mm + m_.motor_screws.screw.diameter_mm);
  const double deep = std::min(face, m_.motor_screws.fits() ? m_.motor_screws.tip_mm() : face);
  std::vector<Outline> threads;
  for (const Point2& at : m_.motor_screws.at)
    threads.push_back(CircleOutline{rotated(at, rotation_rad - shaft_turn_rad),
                                    0.5 * m_.motor_screws.screw.diameter_mm});
  std::vector<Layer> layers{{face - motor.body_length_mm, deep, circle(body)}};
  if (deep < face) layers.push_back({deep, face, circle(body), threads});
  const double collar = motor.pilot_diameter_mm > 0.0 ? motor.pilot_height_mm : 0.0;
  if (collar > 0.0) layers.push_back({face, face + collar, circle(0.5 * motor.pilot_diameter_mm)});
  const double flat =
      motor.flat_mm > 0.0 ? std::max(m_.flat_from_mm, face + collar) : m_.shaft_end_mm;
  if (flat > face + collar) layers.push_back({face + collar, flat, circle(shaft)});
  if (flat < m_.shaft_end_mm)
    layers.push_back({flat, m_.shaft_end_mm,
                      BoreOutline{{.diameter_mm = motor.shaft_diameter_mm - kApart_mm,
                                   .kind = BoreKind::kDFlat,
                                   .d_flat_mm = motor.flat_mm}}});
  const std::string name = motor.name.empty() ? "own" : motor.name;
  place("motor_" + file_text(name), "motor " + name, std::move(layers), {Point2::Zero()}, kNoMember,
        shaft_turn_rad);
}

void BoughtParts::add_screws(const ScrewGroup& group, int member, double rotation_rad) {
  if (!group.fits()) return;
  const Screw& screw = group.screw;
  const double socket = group.head_mm - group.way * 0.5 * screw.head_height_mm;
  const Outline head = circle(0.5 * screw.head_diameter_mm);
  const std::string size = thread_text(screw) + "x" + trimmed_number(group.length_mm, 2);
  place("screw_" + file_text(size) + "_" + group.what, "ISO 4762 " + size,
        {{group.head_mm, group.tip_mm(), circle(0.5 * screw.diameter_mm)},
         {group.head_mm, socket, head},
         {socket,
          group.head_top_mm(),
          head,
          {BoreOutline{{.diameter_mm = screw.hex_mm, .kind = BoreKind::kHex}}}}},
        group.at, member, rotation_rad, group.axis);
  if (!std::isnan(group.insert_mm)) {
    const double from =
        group.way > 0.0 ? group.insert_mm : group.insert_mm - screw.insert_length_mm;
    add_inserts(screw, group.what, group.at, from, member, rotation_rad, group.axis);
  }
}

void BoughtParts::add_inserts(const Screw& screw, const std::string& what,
                              const std::vector<Point2>& at, double from_mm, int member, double rotation_rad,
                              const Point2& axis) {
  const std::string size = thread_text(screw) + "x" + trimmed_number(screw.insert_length_mm, 2);
  place("insert_" + file_text(size) + "_" + what, "heat-set insert " + size,
        {{from_mm,
          from_mm + screw.insert_length_mm,
          circle(0.5 * screw.insert_hole_mm),
          {circle(0.5 * screw.diameter_mm)}}},
        at, member, rotation_rad, axis);
}

void BoughtParts::add_bearing(const Bearing& bearing, const std::vector<Point2>& at, double from_mm,
                              int member) {
  place("bearing_" + file_text(bearing.name),
        (bearing.kind == BearingKind::kCrossedRollers ? "crossed-roller bearing " : "ball bearing ") + bearing.name +
            " (" + trimmed_number(bearing.bore_mm, 2) + "x" + trimmed_number(bearing.outer_mm, 2) + "x" +
            trimmed_number(bearing.width_mm, 2) + ")",
        {{from_mm,
          from_mm + bearing.width_mm,
          circle(0.5 * bearing.outer_mm),
          {circle(0.5 * bearing.bore_mm)}}},
        at, member, 0.0);
}

void BoughtParts::add_pins(double diameter_mm, double length_mm, bool standard,
                           const std::vector<Point2>& at, double from_mm, int member) {
  const std::string size = trimmed_number(diameter_mm, 2) + "x" + trimmed_number(length_mm, 2);
  place("pin_" + file_text(size),
        standard ? "dowel pin ISO 2338 " + size : "round bar " + size + ", cut to length",
        {{from_mm, from_mm + length_mm, circle(0.5 * diameter_mm)}}, at, member, 0.0);
}

}  // namespace trueflank
