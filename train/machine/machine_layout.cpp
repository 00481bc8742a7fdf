// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/machine_layout.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/machine/layout_steps.h"

namespace trueflank {
namespace {

/// The lid's lip reaches this far over the fixed ring.
constexpr double kLidLip_mm = 2.0;

class Layout {
 public:
  Layout(const GearTrain& train, const MachineDesign& machine)
      : train_(train), machine_(machine) {}

  MachineLayout make() {
    settle_walls(train_.design, m_);
    place_gears();
    place_carrier();
    place_pillars();
    plan_set_screw(train_, room_of_hole_mm(machine_, m_), m_);
    place_floor(machine_, m_.near.lower_mm - m_.clearance_mm,
                floor_of_set_screw_mm(machine_.motor, m_), m_);
    place_disc();
    place_output(machine_, m_);
    place_walls();
    place_hub();
    m_.press_mm = press_mm(machine_, 2.0 * m_.ring_radius_mm);
    return std::move(m_);
  }

 private:
  [[nodiscard]] const Topology& topology() const { return train_.topology(); }
  [[nodiscard]] HeightRange heights(const TrainGear& gear) const {
    return m_.z({gear.z_lower_mm, gear.z_lower_mm + gear.face_width_mm});
  }
  [[nodiscard]] static bool is_ring(const TrainGear& gear) {
    return gear.profile.gear().kind == GearKind::kInternal;
  }

  void place_gears() {
    for (std::size_t i = 0; i < train_.gears.size(); ++i) {
      const int member = topology().gears[i].member;
      const bool fixed = std::count(topology().fixed.begin(), topology().fixed.end(), member) > 0;
      if (is_ring(train_.gears[i]) && fixed) m_.fixed_gear = static_cast<int>(i);
      if (is_ring(train_.gears[i]) && member == topology().output)
        m_.output_gear = static_cast<int>(i);
      if (member == topology().input)
        m_.driven_gear = static_cast<int>(i);
      else if (!is_ring(train_.gears[i]) && !topology().is_planet_gear(i))
        m_.idle_gear = static_cast<int>(i);
    }
    // the motor stands on the side of the ring that is held
    if (m_.output_gear >= 0 && m_.fixed_gear >= 0 &&
        train_.gear(m_.output_gear).z_lower_mm < train_.gear(m_.fixed_gear).z_lower_mm)
      m_.way = -1.0;
    if (m_.fixed_gear >= 0) m_.ring = heights(train_.gear(m_.fixed_gear));
  }

  void place_carrier() {
    m_.carrier = *carrier_layout(train_);
    const HeightRange lower = m_.z(m_.carrier.lower_plate), upper = m_.z(m_.carrier.upper_plate);
    m_.near = m_.way > 0.0 ? lower : upper;
    m_.far = m_.way > 0.0 ? upper : lower;
    if (m_.fixed_gear < 0) m_.ring = m_.near;
    // dowel pins in blind holes: the longest stocked one that leaves a web in either plate
    const double span = m_.far.lower_mm - m_.near.upper_mm;
    const double deepest = m_.near.upper_mm - m_.near.lower_mm - m_.wall_mm;
    m_.pin_length_mm = span + 2.0 * deepest - kHeadCover_mm;
    for (const double length : dowel_lengths_mm())
      if (length >= span + m_.carrier.pin_diameter_mm &&
          length <= span + 2.0 * deepest - kHeadCover_mm) {
        m_.pin_length_mm = length;
        m_.pin_is_standard = true;
      }
    m_.pin_depth_mm = 0.5 * (m_.pin_length_mm + kHeadCover_mm - span);
  }

  /// Gap that a pillar at a place leaves beyond the clearance.
  [[nodiscard]] double room_of_pillar(const Point2& at) const {
    double room = 0.5 * m_.carrier.outer_diameter_mm - at.norm() - m_.pillar_radius_mm;
    for (std::size_t i = 0; i < train_.gears.size(); ++i) {
      const TrainGear& gear = train_.gears[i];
      const double tip = gear.profile.tip_radius_mm();
      if (is_ring(gear))
        room = std::min(room, tip - at.norm() - m_.pillar_radius_mm - m_.clearance_mm);
      else if (!topology().is_planet_gear(i))
        room = std::min(room, at.norm() - tip - m_.pillar_radius_mm - m_.clearance_mm);
      if (!topology().is_planet_gear(i)) continue;
      for (const double angle : train_.phases.positions_rad(train_.topology().first_planet()))
        room = std::min(room, (at - train_.centre_distance_mm * unit_vector(angle)).norm() - tip -
                                  m_.pillar_radius_mm - m_.clearance_mm);
    }
    return room;
  }

  void place_pillars() {
    const Screw& screw = machine_.fasteners.carrier;
    m_.pillar_radius_mm = 0.5 * screw.hole_mm + m_.wall_mm;
    std::vector<double> angles = train_.phases.positions_rad(train_.topology().first_planet());
    std::sort(angles.begin(), angles.end());
    m_.pillar_room_mm = 1e300;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + kTwoPi;
      const Point2 direction = unit_vector(0.5 * (angles[i] + next));
      Point2 best = Point2::Zero();
      double room = -1e300;
      for (double r = m_.pillar_radius_mm; r < 0.5 * m_.carrier.outer_diameter_mm; r += 0.05)
        if (const double here = room_of_pillar(r * direction); here > room) {
          room = here;
          best = r * direction;
        }
      m_.pillars.push_back(best);
      m_.pillar_room_mm = std::min(m_.pillar_room_mm, room);
    }
    const double under = under_head_mm(screw, m_.wall_mm);
    const double head = m_.near.lower_mm + head_depth_mm(screw);
    m_.carrier_screws = with_length({.what = "carrier",
                                     .screw = screw,
                                     .at = m_.pillars,
                                     .head_mm = head,
                                     .way = 1.0,
                                     .far_mm = m_.far.upper_mm},
                                    m_.far.lower_mm - head,
                                    std::max(0.0, m_.near.upper_mm - under - head));
  }

  // ------------------------------------------------------------------------------- motor's side

  void place_hub() {
    place_shaft(machine_.motor, m_);
    HeightRange driven = m_.near;
    if (m_.driven_gear >= 0) {
      const TrainGear& gear = train_.gear(m_.driven_gear);
      driven = heights(gear);
      widen_hub(gear, machine_, m_);
      narrow_hub_beside_planets();
      place_stop(gear, driven);
    } else if (m_.idle_gear >= 0) {
      place_stop(train_.gear(m_.idle_gear), heights(train_.gear(m_.idle_gear)));
    }
    const double collar = m_.floor.lower_mm + machine_.motor.pilot_height_mm;
    m_.hub = {std::min(collar + kHubGap_mm, driven.lower_mm), driven.lower_mm};
    place_set_screw(train_, m_);
    for (std::size_t i = 0; i < train_.gears.size(); ++i)
      if (m_.driven_gear >= 0 && topology().is_planet_gear(i) &&
          heights(train_.gears[i]).lower_mm < driven.lower_mm)
        m_.hub_room_mm = std::min(m_.hub_room_mm, train_.centre_distance_mm -
                                                      train_.gears[i].profile.tip_radius_mm() -
                                                      m_.hub_radius_mm - m_.clearance_mm);
    m_.gripped = {m_.hub.lower_mm, std::min(driven.upper_mm, m_.shaft_end_mm)};
    if (m_.toothed_hub)
      m_.toothed_hub = m_.hub_room_mm == kNoPlanet_mm &&
                       0.5 * m_.carrier.opening_diameter_mm >=
                           train_.gear(m_.driven_gear).profile.tip_radius_mm() + 0.5 * m_.clearance_mm;
  }

  /// A planet in mesh turns right over the end of the hub: the hub stays half the clearance off its
  /// tips.
  void narrow_hub_beside_planets() {
    for (const TrainMesh& mesh : train_.meshes) {
      if (mesh.gear1 != m_.driven_gear && mesh.gear2 != m_.driven_gear) continue;
      const TrainGear& planet = train_.gear(mesh.gear1 == m_.driven_gear ? mesh.gear2 : mesh.gear1);
      m_.hub_radius_mm =
          std::min(m_.hub_radius_mm, train_.centre_distance_mm - planet.profile.tip_radius_mm() -
                                         0.5 * m_.clearance_mm);
    }
  }

  /// Over a sun that ends far below the far plate stands a stop: it keeps the sun on the shaft.
  /// The shaft's end has a hole of its own in it.
  void place_stop(const TrainGear& gear, const HeightRange& sun) {
    m_.stop = {std::min(sun.upper_mm + kHubGap_mm, m_.far.lower_mm), m_.far.lower_mm};
    m_.stop_radius_mm = gear.profile.tip_radius_mm();
    if (m_.shaft_end_mm + m_.clearance_mm > m_.stop.lower_mm)
      m_.stop_hole_radius_mm = 0.5 * machine_.motor.shaft_diameter_mm + m_.clearance_mm;
    for (std::size_t i = 0; i < train_.gears.size(); ++i)
      if (topology().is_planet_gear(i) && heights(train_.gears[i]).upper_mm > m_.stop.lower_mm)
        m_.stop_radius_mm =
            std::min(m_.stop_radius_mm, train_.centre_distance_mm - m_.clearance_mm -
                                            train_.gears[i].profile.tip_radius_mm());
    if (m_.output_gear < 0)  // the carrier's inserts are pressed in through the face that it stands on
      m_.stop_radius_mm =
          std::min(m_.stop_radius_mm, m_.output_screws.at.front().norm() -
                                          0.5 * machine_.fasteners.output.insert_hole_mm - m_.clearance_mm);
    if (m_.stop_radius_mm < m_.stop_hole_radius_mm + m_.wall_mm ||
        m_.stop.upper_mm - m_.stop.lower_mm < m_.wall_mm)
      m_.stop.lower_mm = m_.stop.upper_mm;
  }

  // ------------------------------------------------------------------------------- output's side

  /// What carries the output: the floor of a ring's cup, or the carrier's far plate.
  void place_disc() {
    const Screw& screw = machine_.fasteners.output;
    m_.disc = m_.far;
    if (m_.output_gear >= 0) {
      const TrainGear& ring = train_.gear(m_.output_gear);
      m_.cup_inner_radius_mm = 0.5 * m_.carrier.outer_diameter_mm + m_.clearance_mm;
      place_cup(ring, screw, m_.far.upper_mm + m_.clearance_mm, m_);
    }
  }

  // ------------------------------------------------------------------------------- walls

  /// What turns inside the lid.
  [[nodiscard]] double turning_radius_mm() const {
    double radius = std::max(m_.cup_radius_mm, m_.retainer_radius_mm);
    if (m_.output_gear < 0) radius = std::max(radius, 0.5 * m_.carrier.outer_diameter_mm);
    return radius + m_.clearance_mm;
  }

  void place_walls() {
    const Screw& screw = machine_.fasteners.housing;
    m_.cavity_radius_mm = 0.5 * m_.carrier.outer_diameter_mm + m_.clearance_mm;
    m_.lid_radius_mm = turning_radius_mm();
    for (std::size_t i = 0; i < train_.gears.size(); ++i) {
      if (!topology().is_planet_gear(i)) continue;
      const HeightRange at = heights(train_.gears[i]);
      const double reach =
          train_.centre_distance_mm + train_.gears[i].profile.tip_radius_mm() + m_.clearance_mm;
      if (at.lower_mm < m_.ring.lower_mm + m_.clearance_mm)
        m_.cavity_radius_mm = std::max(m_.cavity_radius_mm, reach);
      if (at.upper_mm > m_.ring.upper_mm - m_.clearance_mm)
        m_.lid_radius_mm = std::max(m_.lid_radius_mm, reach);
    }
    const double root =
        m_.fixed_gear < 0 ? 0.0 : train_.gear(m_.fixed_gear).profile.root_radius_mm();
    const double hole = 0.5 * screw.hole_mm, insert = 0.5 * screw.insert_hole_mm;
    const double circle =
        m_.wall_mm + std::max({root + hole, m_.cavity_radius_mm + insert, m_.lid_radius_mm + hole});
    const double lip = m_.wall_mm + 0.5 * m_.fit_mm;
    m_.least_outer_radius_mm =
        std::max(circle + hole + m_.wall_mm + lip,
                 circle + 0.5 * screw.head_diameter_mm + kHeadCover_mm + m_.wall_mm);
    m_.asked_radius_mm = machine_.housing.outer_diameter_mm
                             ? 0.5 * *machine_.housing.outer_diameter_mm
                             : m_.least_outer_radius_mm;
    m_.outer_radius_mm = std::max(m_.asked_radius_mm, m_.least_outer_radius_mm);
    m_.ring_radius_mm = m_.outer_radius_mm - lip;
    m_.seat_top_mm =
        std::max(m_.ring.upper_mm - kLidLip_mm, 0.5 * (m_.ring.lower_mm + m_.ring.upper_mm));
    m_.screw_circle_mm = circle;
    const double head = m_.roof.upper_mm - head_depth_mm(screw);
    m_.housing_screws = with_length({.what = "housing",
                                     .screw = screw,
                                     .at = on_circle(circle, machine_.housing.screws, 0.0),
                                     .head_mm = head,
                                     .way = -1.0,
                                     .far_mm = m_.floor.lower_mm},
                                    head - m_.ring.lower_mm + m_.wall_mm,
                                    head - m_.ring.upper_mm - screw.diameter_mm);
  }

  const GearTrain& train_;
  const MachineDesign& machine_;
  MachineLayout m_;
};

}  // namespace

bool has_housing(const Topology& topology) {
  return topology.has_planets() || topology.gears.size() == 2;
}

std::optional<MachineLayout> machine_layout(const GearTrain& train) {
  if (!train.design.machine) return std::nullopt;
  const MachineDesign& machine = *train.design.machine;
  return train.topology().has_planets() ? Layout(train, machine).make() : pair_layout(train, machine);
}

}  // namespace trueflank
