// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pair in a box: the pinion on the motor's shaft, the wheel beside it between a bearing in the
// floor and the output's bearings in the lid. A wheel that is a ring stands around the pinion: it is
// a cup over it, held by the bearings in the lid. The box is round: the smallest circle round the
// wheel and round what stands on the motor's axis.
#include <algorithm>
#include <cmath>

#include "trueflank/train/machine/layout_steps.h"

namespace trueflank {
namespace {

/// The lid reaches this far into the housing.
constexpr double kSpigot_mm = 2.0;
/// Under the inner ring of the bearing in the floor it is this much deeper.
constexpr double kRelief_mm = 0.5;
/// Of the module: a cup is this much wider than the roots of the ring before it, and a spacer on a
/// pinion this much narrower than the pinion's.
constexpr double kBeyondRoots = 0.1, kInsideRoots = 0.5;

class PairLayout {
 public:
  PairLayout(const GearTrain& train, const MachineDesign& machine)
      : train_(train), machine_(machine), pinion_(train.gear(0)), wheel_(train.gear(1)) {
    m_.driven_gear = 0;
    m_.wheel_gear = 1;
    m_.output_axis = axis_centre_mm(train, train.phases, train.topology().output);
    settle_walls(train.design, m_);
  }

  MachineLayout make() {
    place_under_the_wheel();
    place_pinion();
    if (is_ring())
      place_cup_over_the_pinion();
    else
      m_.disc = heights(wheel_);
    place_output(machine_, m_);
    place_box();
    place_lid();
    m_.press_mm = press_mm(machine_, 2.0 * m_.cavity_radius_mm);
    return std::move(m_);
  }

 private:
  [[nodiscard]] static HeightRange heights(const TrainGear& gear) {
    return {gear.z_lower_mm, gear.z_lower_mm + gear.face_width_mm};
  }

  [[nodiscard]] bool is_ring() const { return wheel_.profile.gear().kind == GearKind::kInternal; }

  void place_under_the_wheel() {
    const double cavity = std::min(heights(pinion_).lower_mm, heights(wheel_).lower_mm) - m_.clearance_mm;
    const auto& bearing = machine_.bearings.wheel;
    double room = room_of_hole_mm(machine_, m_);
    if (bearing)
      room = std::min(room, m_.output_axis.norm() - m_.wall_mm -
                                0.5 * m_.fits.wheel.hole_mm(bearing->outer_mm));
    plan_set_screw(train_, room, m_);
    place_floor(machine_, cavity,
                std::max(bearing ? bearing->width_mm + kRelief_mm + m_.wall_mm : 0.0,
                         floor_of_set_screw_mm(machine_.motor, m_)),
                m_);
    if (!bearing) return;
    const Shoulders shoulders = shoulders_of(*bearing);
    m_.stub = {.bearing = {cavity - bearing->width_mm, cavity},
               .relief_mm = cavity - bearing->width_mm - kRelief_mm,
               .journal_radius_mm = 0.5 * m_.fits.wheel.shaft_mm(bearing->bore_mm),
               .inner_shoulder_mm = shoulders.inner_mm,
               .outer_shoulder_mm = shoulders.outer_mm};
  }

  void place_pinion() {
    place_shaft(machine_.motor, m_);
    widen_hub(pinion_, machine_, m_);
    // clear of the wheel's tips, as everything that turns against something else
    if (!is_ring())
      m_.hub_radius_mm = std::min(m_.hub_radius_mm, m_.output_axis.norm() - m_.clearance_mm -
                                                        wheel_.profile.tip_radius_mm());
    const HeightRange driven = heights(pinion_);
    m_.hub = {std::min(m_.floor.lower_mm + machine_.motor.pilot_height_mm + kHubGap_mm, driven.lower_mm),
              driven.lower_mm};
    place_set_screw(train_, m_);
    m_.gripped = {m_.hub.lower_mm, std::min(driven.upper_mm, m_.shaft_end_mm)};
  }

  /// The disc of the cup stays clear of the shaft's end, which goes round under it; a spacer on the
  /// pinion fills what is left between them.
  void place_cup_over_the_pinion() {
    const double tops = std::max({heights(pinion_).upper_mm, heights(wheel_).upper_mm, m_.shaft_end_mm});
    place_cup(wheel_, machine_.fasteners.output, tops + m_.clearance_mm, m_);
    // straight teeth go on to the cup, whose wall is printed under them
    const double module = wheel_.profile.gear().normal_module_mm;
    const double inside_tips = wheel_.profile.tip_radius_mm() - kHubInset * module;
    const bool straight = wheel_.twist.turn_rad_per_mm == 0.0;
    m_.cup_inner_radius_mm =
        straight ? inside_tips : wheel_.profile.root_radius_mm() + kBeyondRoots * module;
    const double from = heights(pinion_).upper_mm;
    m_.spacer_radius_mm = std::min(pinion_.profile.root_radius_mm() - kInsideRoots * module,
                                   inside_tips - m_.output_axis.norm() - m_.clearance_mm);
    const bool room = m_.spacer_radius_mm >= 0.5 * machine_.motor.shaft_diameter_mm + m_.wall_mm;
    m_.spacer = {from, room || straight ? std::max(from, tops) : from};
    m_.cup_over_mm = straight ? m_.spacer.upper_mm : from;
    m_.gripped.upper_mm = std::min(m_.spacer.upper_mm, m_.shaft_end_mm);
  }

  /// The smallest circle round the pinion with the motor's screws and the wheel with the retainer of its
  /// bearing; round that walls and screws.
  void place_box() {
    const double screws = 0.5 * (machine_.motor.bolt_circle_diameter_mm +
                                 machine_.fasteners.motor.head_diameter_mm) + kHeadRoom_mm;
    const double at_motor = std::max(screws, pinion_.profile.tip_radius_mm()) + m_.clearance_mm;
    const double at_wheel = std::max(is_ring() ? m_.cup_radius_mm : wheel_.profile.tip_radius_mm(),
                                     m_.retainer_radius_mm + m_.wall_mm + m_.fit_mm) + m_.clearance_mm;
    const double apart = m_.output_axis.norm();
    m_.cavity_radius_mm = std::max({0.5 * (apart + at_motor + at_wheel), at_motor, at_wheel});
    const double from_motor = std::clamp(0.5 * (apart + at_wheel - at_motor), 0.0, apart);
    m_.housing_axis = from_motor * m_.output_axis.normalized();
    const Screw& screw = machine_.fasteners.housing;
    const double hole = 0.5 * std::max(screw.hole_mm, screw.insert_hole_mm);
    m_.screw_circle_mm = m_.cavity_radius_mm + m_.wall_mm + hole;
    m_.least_outer_radius_mm =
        m_.screw_circle_mm + m_.wall_mm + std::max(hole, 0.5 * screw.head_diameter_mm + kHeadRoom_mm);
    m_.asked_radius_mm = machine_.housing.outer_diameter_mm ? 0.5 * *machine_.housing.outer_diameter_mm
                                                            : m_.least_outer_radius_mm;
    m_.outer_radius_mm = std::max(m_.asked_radius_mm, m_.least_outer_radius_mm);
  }

  /// Its underside keeps the pinion on the shaft.
  void place_lid() {
    const double tops = std::max(heights(pinion_).upper_mm, m_.disc.upper_mm);
    m_.lid_lower_mm = tops + m_.clearance_mm;
    m_.seat_top_mm = m_.lid_lower_mm + kSpigot_mm;
    m_.lid_radius_mm = m_.retainer_radius_mm + m_.clearance_mm;
    if (m_.shaft_end_mm + m_.clearance_mm > m_.lid_lower_mm)
      m_.stop_hole_radius_mm = 0.5 * machine_.motor.shaft_diameter_mm + m_.clearance_mm;
    const Screw& screw = machine_.fasteners.housing;
    const double head = m_.roof.upper_mm - head_depth_mm(screw);
    m_.housing_screws = with_length(
        {.what = "housing",
         .screw = screw,
         .at = on_circle(m_.screw_circle_mm, machine_.housing.screws, 0.0),
         .axis = m_.housing_axis,
         .head_mm = head,
         .way = -1.0,
         .far_mm = m_.floor.lower_mm},
        head - m_.seat_top_mm + m_.wall_mm,
        std::max(0.0, head - m_.seat_top_mm - under_head_mm(screw, m_.wall_mm)));
  }

  const GearTrain& train_;
  const MachineDesign& machine_;
  const TrainGear &pinion_, &wheel_;
  MachineLayout m_;
};

}  // namespace

MachineLayout pair_layout(const GearTrain& train, const MachineDesign& machine) {
  return PairLayout(train, machine).make();
}

}  // namespace trueflank
