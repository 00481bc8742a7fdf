// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/train/carrier.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/machine/screw_group.h"
#include "trueflank/train/machine/seat_fits.h"

namespace trueflank {

/// Radii of the shoulders that touch a bearing's rings and no more.
struct Shoulders {
  double inner_mm = 0.0, outer_mm = 0.0;
};
[[nodiscard]] Shoulders shoulders_of(const Bearing& bearing);

/// A gearbox sized: every radius and height of the parts around the gears, of a train with a
/// machine. Heights grow from the motor to the output: they are the assembly's z where the motor
/// stands below the gears (`way` +1), its negative where it stands above (3k type II).
struct MachineLayout {
  double way = 1.0;
  double wall_mm = 1.2, clearance_mm = 0.5;
  SeatFits fits;
  double fit_mm = 0.1;    ///< diametral clearance that walls leave room for; 0: seats have classes
  double press_mm = 0.0;  ///< by so much, on the radius, one part may be in another: it is pressed in
  int fixed_gear = -1;   ///< the ring that is held; -1: the carrier is, by its near plate
  int output_gear = -1;  ///< the ring that drives out; -1: the carrier does
  int driven_gear = -1;  ///< on the motor's shaft; -1: the carrier is
  int idle_gear = -1;    ///< a sun that nothing drives; -1: none
  int wheel_gear = -1;   ///< of a pair: it drives out, on an axis of its own; -1: no pair
  Point2 output_axis = Point2::Zero();   ///< of output, its bearings and the wheel
  Point2 housing_axis = Point2::Zero();  ///< the middle of housing and lid; the motor's is the origin

  // housing and lid
  double outer_radius_mm = 0.0;
  double least_outer_radius_mm = 0.0;  ///< that holds everything
  double asked_radius_mm = 0.0;        ///< by the design; the parts have the larger of both
  HeightRange floor;                   ///< from the motor's face to the cavity
  double cavity_radius_mm = 0.0;
  HeightRange ring;  ///< what the lips of housing and lid hold: the fixed ring, or the plate
  double ring_radius_mm = 0.0;
  double seat_top_mm = 0.0;    ///< where the lips of housing and lid meet, around the ring
  double lid_radius_mm = 0.0;  ///< inside the lid
  HeightRange roof;            ///< of the lid; its underside holds the bearing
  double screw_circle_mm = 0.0;  ///< of the housing's screws, radius
  ScrewGroup housing_screws, motor_screws;

  // pair
  double lid_lower_mm = 0.0;  ///< where the lid reaches into the housing: over the gears
  struct Stub {               ///< of the wheel, in its bearing in the floor
    HeightRange bearing;      ///< empty: none
    double relief_mm = 0.0;   ///< the floor is this deep round the journal's end
    double journal_radius_mm = 0.0;
    double inner_shoulder_mm = 0.0, outer_shoulder_mm = 0.0;  ///< radii
  } stub;

  // carrier
  CarrierLayout carrier;
  HeightRange near, far;  ///< plates, towards the motor and towards the output
  double pin_length_mm = 0.0, pin_depth_mm = 0.0;
  bool pin_is_standard = false;
  std::vector<Point2> pillars;
  double pillar_radius_mm = 0.0;
  double pillar_room_mm = 0.0;  ///< least gap of a pillar to planets and rings beyond the clearance
  ScrewGroup carrier_screws;
  HeightRange stop;  ///< of the far plate, over the sun, driven or idle; empty: none
  double stop_radius_mm = 0.0;
  double stop_hole_radius_mm =
      0.0;  ///< for the end of the motor's shaft; 0: it does not reach there

  // motor's shaft and hub
  HeightRange hub;  ///< of sun or carrier towards the motor; empty: none
  double hub_radius_mm = 0.0;
  double hub_room_mm = 0.0;  ///< beyond the clearance, to planets that it passes
  double flat_from_mm = 0.0, shaft_end_mm = 0.0;
  HeightRange gripped;  ///< of the shaft, in hub and gear
  HeightRange spacer;  ///< on a pinion inside its wheel: keeps it on the shaft; empty: none
  double spacer_radius_mm = 0.0;  ///< of one without teeth: straight teeth go on
  bool toothed_hub = false;  ///< over the foot of a set screw straight teeth go on: they would hang over a hub
  /// Across the hub of the driven gear; it turns in the floor's hole.
  struct SetScrew {
    Screw screw = {};            ///< of its thread; no name: none
    bool nut = false;            ///< it turns in a square nut in a pocket open to the motor; else in the hub
    double length_mm = 0.0;
    double bears_mm = 0.0;       ///< on the shaft, this far from the axis: its radius, or its flat
    bool on_flat = false;
    HeightRange foot;            ///< what it is in
    double foot_radius_mm = 0.0;
    double flat_mm = 0.0;         ///< of the foot, from the axis: the drill starts there; 0: none
    HeightRange pocket;
    double axis_mm = 0.0;        ///< height of the screw's axis
    double pocket_width_mm = 0.0, pocket_end_mm = 0.0;  ///< its floor, from the axis
    double pocket_bore_mm = 0.0;  ///< diameter of the bore there: wider than the nut
    double drill_mm = 0.0, through_mm = 0.0;  ///< diameter, and how much there is to drill through
    std::string missing = {};    ///< why a shaft that is to have one has none
    [[nodiscard]] bool is_there() const { return !screw.name.empty(); }
  } set_screw;
  double floor_hole_radius_mm = 0.0;  ///< collar and hub go through it

  // output
  double cup_radius_mm = 0.0;  ///< outside, of a ring that drives out; 0: none
  double cup_inner_radius_mm = 0.0;
  double cup_over_mm = -1e300;  ///< top of what the ring has in it, where that may be higher than the ring
  HeightRange disc;  ///< holds the inserts of the output's screws
  HeightRange retainer, bearings, plate;
  double retainer_radius_mm = 0.0;
  double inner_shoulder_mm = 0.0, outer_shoulder_mm = 0.0;  ///< radii, of the bearing's rings
  double plate_radius_mm = 0.0;
  double journal_radius_mm = 0.0;
  ScrewGroup output_screws, retainer_screws;
  std::vector<Point2> load_inserts;

  [[nodiscard]] HeightRange z(const HeightRange& heights) const {
    return way > 0.0 ? heights : HeightRange{-heights.upper_mm, -heights.lower_mm};
  }
};

/// Whether a housing is made for such a train: one with planets, of which a ring or the carrier is
/// held, or a pair of gears.
[[nodiscard]] bool has_housing(const Topology& topology);

/// Sizes the gearbox of a design with [housing]; nothing of another. What does not fit is in its
/// numbers: the checks tell.
[[nodiscard]] std::optional<MachineLayout> machine_layout(const GearTrain& train);

}  // namespace trueflank
