// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/elements.h"

#include <cmath>

#include "trueflank/train/machine/crossed_rollers.h"

namespace trueflank {
namespace {

constexpr const char* kNema =
    "pilot and bolt circle: NEMA ICS 16 frame sizes; shaft, flat, thread depth and torque: typical "
    "of "
    "catalogues";
constexpr const char* kServo = "typical of catalogues: measure yours";
constexpr const char* kBearing = "sizes: ISO 15; ratings: catalogue values, typical";
constexpr const char* kScrew =
    "head: ISO 4762; hole: ISO 273 medium; nut: ISO 4032; insert: typical of catalogues of "
    "heat-set inserts";

/// Bolt circle of holes in the corners of a square.
double of_square(double side_mm) { return std::sqrt(2.0) * side_mm; }

std::vector<Motor> motors() {
  return {
      {.name = "nema14",
       .body_mm = 35.2,
       .body_length_mm = 28,
       .pilot_diameter_mm = 22,
       .pilot_height_mm = 2,
       .bolt_circle_diameter_mm = of_square(26),
       .thread_depth_mm = 4,
       .shaft_diameter_mm = 5,
       .shaft_length_mm = 22,
       .flat_mm = 4.5,
       .flat_length_mm = 15,
       .torque_nm = 0.15,
       .source = kNema},
      {.name = "nema17",
       .body_mm = 42.3,
       .body_length_mm = 40,
       .pilot_diameter_mm = 22,
       .pilot_height_mm = 2,
       .bolt_circle_diameter_mm = of_square(31),
       .thread_depth_mm = 4.5,
       .shaft_diameter_mm = 5,
       .shaft_length_mm = 24,
       .flat_mm = 4.5,
       .flat_length_mm = 15,
       .torque_nm = 0.45,
       .source = kNema},
      {.name = "nema23",
       .body_mm = 57,
       .body_length_mm = 56,
       .pilot_diameter_mm = 38.1,
       .pilot_height_mm = 1.6,
       .bolt_circle_diameter_mm = of_square(47.14),
       .screw = "M5",
       .flange_mm = 5,
       .shaft_diameter_mm = 6.35,
       .shaft_length_mm = 21,
       .flat_mm = 5.85,
       .flat_length_mm = 15,
       .torque_nm = 1.2,
       .source = kNema},
      {.name = "outrunner-2212",
       .body_mm = 28,
       .body_length_mm = 24,
       .bolt_circle_diameter_mm = 19,
       .thread_depth_mm = 4,
       .shaft_diameter_mm = 5,
       .shaft_length_mm = 14,
       .torque_nm = 0.1,
       .source = kServo},
      {.name = "outrunner-5010",
       .body_mm = 58,
       .body_length_mm = 26,
       .bolt_circle_diameter_mm = 25,
       .thread_depth_mm = 4,
       .shaft_diameter_mm = 6,
       .shaft_length_mm = 20,
       .torque_nm = 0.5,
       .source = kServo},
      {.name = "servo-25t-disc",
       .body_mm = 40,
       .body_length_mm = 38,
       .bolt_circle_diameter_mm = 48,
       .screw = "M4",
       .flange_mm = 3,
       .shaft_diameter_mm = 6,
       .shaft_length_mm = 10,
       .torque_nm = 2,
       .source = kServo},
  };
}

/// Bore, outer diameter, width, C and C0.
Bearing bearing(const char* name, double d, double D, double B, double C, double C0) {
  return {.name = name,
          .bore_mm = d,
          .outer_mm = D,
          .width_mm = B,
          .dynamic_n = C,
          .static_n = C0,
          .source = kBearing};
}

std::vector<Bearing> bearings() {
  std::vector<Bearing> all{
      bearing("623", 3, 10, 4, 540, 180),        bearing("624", 4, 13, 5, 1110, 380),
      bearing("625", 5, 16, 5, 1140, 380),       bearing("626", 6, 19, 6, 2340, 950),
      bearing("608", 8, 22, 7, 3450, 1370),      bearing("684", 4, 9, 4, 640, 220),
      bearing("685", 5, 11, 5, 720, 280),        bearing("686", 6, 13, 5, 1080, 440),
      bearing("688", 8, 16, 5, 1330, 570),       bearing("6800", 10, 19, 5, 1720, 830),
      bearing("6801", 12, 21, 5, 1920, 1040),    bearing("6802", 15, 24, 5, 2080, 1260),
      bearing("6803", 17, 26, 5, 2190, 1440),    bearing("6804", 20, 32, 7, 4020, 2460),
      bearing("6805", 25, 37, 7, 4360, 3000),    bearing("6806", 30, 42, 7, 4490, 3450),
      bearing("6807", 35, 47, 7, 4750, 3850),    bearing("6808", 40, 52, 7, 4940, 4150),
      bearing("6809", 45, 58, 7, 6630, 6100),    bearing("6810", 50, 65, 7, 6760, 6800),
      bearing("6812", 60, 78, 10, 11900, 11400), bearing("6815", 75, 95, 10, 12700, 14300),
      bearing("6700", 10, 15, 3, 855, 435),      bearing("6701", 12, 18, 4, 930, 530),
      bearing("6702", 15, 21, 4, 940, 585),      bearing("6703", 17, 23, 4, 1000, 660),
      bearing("6704", 20, 27, 4, 1040, 730),     bearing("6705", 25, 32, 4, 1100, 840),
      bearing("6706", 30, 37, 4, 1140, 950),     bearing("6707", 35, 44, 5, 1860, 1640),
      bearing("6708", 40, 50, 6, 2530, 2240),    bearing("6710", 50, 62, 6, 2950, 2930),
  };
  const auto& crossed = crossed_roller_bearings();
  all.insert(all.end(), crossed.begin(), crossed.end());
  return all;
}

std::vector<Screw> screws() {
  const auto screw = [](const char* name, double d, double head, double hex, double hole,
                        double insert_hole, double insert_length, double nut, double longest) {
    return Screw{.name = name,
                 .diameter_mm = d,
                 .head_diameter_mm = head,
                 .head_height_mm = d,
                 .hex_mm = hex,
                 .hole_mm = hole,
                 .insert_hole_mm = insert_hole,
                 .insert_length_mm = insert_length,
                 .nut_height_mm = nut,
                 .longest_mm = longest,
                 .source = kScrew};
  };
  return {
      screw("M2", 2, 3.8, 1.5, 2.4, 3.2, 4.0, 1.6, 20),
      screw("M2.5", 2.5, 4.5, 2, 2.9, 3.6, 4.0, 2.0, 25),
      screw("M3", 3, 5.5, 2.5, 3.4, 4.0, 5.7, 2.4, 60),
      screw("M3-short", 3, 5.5, 2.5, 3.4, 4.0, 4.0, 2.4, 60),
      screw("M4", 4, 7, 3, 4.5, 5.6, 8.1, 3.2, 80),
      screw("M5", 5, 8.5, 4, 5.5, 6.4, 9.5, 4.7, 100),
      screw("M6", 6, 10, 5, 6.6, 8.0, 12.7, 5.2, 120),
  };
}

}  // namespace

std::vector<double> Screw::lengths_mm() const {
  std::vector<double> lengths;
  for (const double length : {4.,  5.,  6.,  8.,  10., 12., 16., 20., 25.,  30.,  35., 40.,
                              45., 50., 55., 60., 65., 70., 80., 90., 100., 110., 120.})
    if (length >= 1.5 * diameter_mm && length <= longest_mm) lengths.push_back(length);
  return lengths;
}

const MachineElements& standard_elements() {
  static const MachineElements elements{motors(), bearings(), screws()};
  return elements;
}

const std::vector<double>& dowel_lengths_mm() {
  static const std::vector<double> lengths{4,  5,  6,  8,  10, 12, 14, 16, 18, 20,
                                           22, 24, 26, 28, 30, 32, 35, 40, 45, 50,
                                           55, 60, 65, 70, 75, 80, 85, 90, 95, 100};
  return lengths;
}

}  // namespace trueflank
