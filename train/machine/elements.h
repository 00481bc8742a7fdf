// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

// What is bought for a gearbox: motors, ball bearings, screws with their inserts. Plain data by name;
// users extend it (docs/gearbox.md).
namespace trueflank {

/// A motor from the gearbox's side. Heights are along the shaft from the face that is screwed on.
struct Motor {
  std::string name;
  double body_mm = 42.0;  ///< width of a square body, diameter of a round one
  double body_length_mm = 40.0;
  double pilot_diameter_mm = 0.0, pilot_height_mm = 0.0;  ///< centring collar; 0: none
  double bolt_circle_diameter_mm = 0.0;
  int bolt_count = 4;
  std::string screw = "M3";
  double thread_depth_mm = 0.0;  ///< 0: holes that go through its flange, for nuts
  double flange_mm = 0.0;        ///< thickness of that flange
  double shaft_diameter_mm = 0.0, shaft_length_mm = 0.0;
  double flat_mm = 0.0;         ///< from the flat to the opposite side; 0: a round shaft
  double flat_length_mm = 0.0;  ///< from the shaft's end
  double torque_nm = 0.0;       ///< it can hold; 0: not known
  std::string source = {};

  bool operator==(const Motor&) const = default;
};

/// Deep-groove balls in one row; or crossed rollers: one such bearing alone holds loads in every
/// direction and tilting moments.
enum class BearingKind { kBalls, kCrossedRollers };

struct Bearing {
  std::string name;
  double bore_mm = 0.0, outer_mm = 0.0, width_mm = 0.0;
  double dynamic_n = 0.0, static_n = 0.0;  ///< load ratings C and C0; 0: not known
  BearingKind kind = BearingKind::kBalls;
  std::string source = {};

  bool operator==(const Bearing&) const = default;
};

/// A socket head cap screw, its hole, and the heat-set insert that holds it in plastic.
struct Screw {
  std::string name;
  double diameter_mm = 3.0;
  double head_diameter_mm = 5.5, head_height_mm = 3.0, hex_mm = 2.5;
  double hole_mm = 3.4;
  double insert_hole_mm = 4.0, insert_length_mm = 5.7;
  double nut_height_mm = 2.4;
  double longest_mm = 60.0;  ///< of the lengths that are stocked
  std::string source = {};

  bool operator==(const Screw&) const = default;
  /// Stocked lengths, rising.
  [[nodiscard]] std::vector<double> lengths_mm() const;
};

struct MachineElements {
  std::vector<Motor> motors;
  std::vector<Bearing> bearings;
  std::vector<Screw> screws;
};
/// The built-in ones.
[[nodiscard]] const MachineElements& standard_elements();

/// nullptr where there is none of this name.
template <class Element>
[[nodiscard]] const Element* find_element(const std::vector<Element>& elements, const std::string& name) {
  for (const Element& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

/// Standard lengths of dowel pins, ISO 2338, rising.
[[nodiscard]] const std::vector<double>& dowel_lengths_mm();

}  // namespace trueflank
