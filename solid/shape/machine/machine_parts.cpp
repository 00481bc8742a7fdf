// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/machine/machine_parts.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/measure/overhang.h"
#include "trueflank/solid/shape/machine/bought_parts.h"
#include "trueflank/solid/shape/machine/machine_pieces.h"
#include "trueflank/solid/shape/machine/stacked_body.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// The lips of housing and lid stay this far apart.
constexpr double kLipGap_mm = 0.2;
class MachineBuilder {
 public:
  MachineBuilder(const GearTrain& train, const MachineLayout& layout, PartShapes& shapes)
      : train_(train), machine_(*train.design.machine), m_(layout), shapes_(shapes),
        pieces_(machine_, layout, shapes) {}

  Errors build() {
    check_pins();
    if (!errors_.empty()) return std::move(errors_);
    const Topology& topology = train_.topology();
    carrier_ = topology.carrier_of(topology.first_planet());
    if (m_.fixed_gear >= 0)
      held_turn_ = train_.phases.rotation_rad(
          topology.gears[static_cast<std::size_t>(m_.fixed_gear)].member, 0);
    output_ = topology.output;
    output_turn_ = m_.output_gear < 0 ? 0.0 : train_.phases.rotation_rad(output_, 0);
    change_gears();
    add_carrier();
    add_housing();
    add_lid();
    pieces_.add_output(output_, output_turn_);
    add_bought();
    return {};
  }

 private:
  void check_pins() {
    const BoreDesign& bore = planet_with_bore(train_.design)->bore;
    if (bore.kind == BoreKind::kRound && bore.diameter_mm > m_.carrier.pin_diameter_mm &&
        m_.carrier.pin_diameter_mm > 0.0)
      return;
    errors_.push_back(
        {.code = ErrorCode::kInfeasible,
         .message = "the planets turn on no pin: they need a round bore that is wider than it",
         .key = planet_with_bore(train_.design)->name + ".bore_mm",
         .remedy = "bearings.planet, or a bore_mm above the pin's diameter"});
  }

  [[nodiscard]] HeightRange z(double from, double to) const { return pieces_.z(from, to); }

  // ------------------------------------------------------------------------------- gears

  void change_gears() {
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i) {
      PartShape& part = shapes_.parts[i];
      StackedBody body;
      const double at = height_of(i);
      body.add(part.slabs, at);
      if (train_.topology().is_planet(part.member))
        drill_seats(body);
      else if (m_.driven_gear >= 0 && part.member == train_.topology().input)
        add_hub(body, part);
      else if (m_.output_gear >= 0 && part.member == output_)
        pieces_.add_cup(body, part, at);
      else if (m_.idle_gear >= 0 &&
               part.member ==
                   train_.topology().gears[static_cast<std::size_t>(m_.idle_gear)].member)
        clear_shaft(body, part);
      else
        continue;
      part.slabs = body.slabs();
      const bool cup = m_.output_gear >= 0 && part.member == output_;
      part.upside_down = m_.way > 0.0 && (cup || has_narrow_hub(part));
      for (Placement& placement : shapes_.assembly)
        if (placement.part == static_cast<int>(i))
          placement.translation_mm[2] += body.heights().lower_mm - at;
    }
  }

  /// A large sun hangs over its hub.
  [[nodiscard]] bool has_narrow_hub(const PartShape& part) const {
    if (m_.driven_gear < 0 || part.member != train_.topology().input) return false;
    const TrainGear& gear = train_.gear(m_.driven_gear);
    return m_.hub_radius_mm <
           gear.profile.root_radius_mm() - gear.profile.gear().normal_module_mm;
  }

  [[nodiscard]] double height_of(std::size_t part) const {
    for (const Placement& placement : shapes_.assembly)
      if (placement.part == static_cast<int>(part)) return placement.translation_mm[2];
    return 0.0;
  }

  /// Seats of a planet's two bearings, one in either face.
  void drill_seats(StackedBody& body) const {
    if (!machine_.bearings.planet) return;
    const Bearing& bearing = *machine_.bearings.planet;
    const HeightRange all = body.heights();
    const CircleOutline seat = circle(0.5 * m_.fits.planet.hole_mm(bearing.outer_mm));
    body.drill({all.lower_mm, all.lower_mm + bearing.width_mm}, seat);
    body.drill({all.upper_mm - bearing.width_mm, all.upper_mm}, seat);
  }

  /// The sun's hub on the motor's shaft; round where the shaft is.
  void add_hub(StackedBody& body, const PartShape& part) const {
    const std::vector<Slab> gear = part.slabs;
    const double at = body.heights().lower_mm;
    StackedBody made;
    for (Slab slab : gear) {
      std::erase_if(slab.holes,
                    [](const Outline& hole) { return std::holds_alternative<BoreOutline>(hole); });
      made.add({slab}, at);
    }
    pieces_.add_hub(made, find_gear(train_.design, part.name)->bore, part, at);
    body = std::move(made);
  }

  /// The motor's shaft ends free in a sun that idles: a bore of its own that is narrower gives way.
  void clear_shaft(StackedBody& body, const PartShape& part) const {
    const double free = 0.5 * machine_.motor.shaft_diameter_mm + m_.clearance_mm;
    const double at = body.heights().lower_mm;
    body = StackedBody();
    for (Slab slab : part.slabs) {
      std::erase_if(slab.holes, [&](const Outline& hole) {
        return std::holds_alternative<BoreOutline>(hole) && extent(hole).inner_radius_mm < free;
      });
      body.add({slab}, at);
    }
    body.drill(z(m_.near.upper_mm, m_.shaft_end_mm + m_.clearance_mm), circle(free));
  }

  // ------------------------------------------------------------------------------- carrier

  void add_carrier() {
    const std::string name = train_.topology().name_of(carrier_);
    const double outer = 0.5 * m_.carrier.outer_diameter_mm;
    StackedBody near, far, pillar;
    near.add(z(m_.near.lower_mm, m_.near.upper_mm),
             circle(m_.fixed_gear < 0 ? held_radius_mm() : outer));
    far.add(z(m_.far.lower_mm, m_.far.upper_mm), circle(outer));
    for (const double angle : train_.phases.positions_rad(train_.topology().first_planet())) {
      const CircleOutline hole = circle(0.5 * m_.carrier.pin_hole_diameter_mm,
                                        train_.centre_distance_mm * unit_vector(angle));
      near.drill(z(m_.near.upper_mm - m_.pin_depth_mm, m_.near.upper_mm), hole);
      far.drill(z(m_.far.lower_mm, m_.far.lower_mm + m_.pin_depth_mm), hole);
    }
    if (m_.driven_gear < 0) {
      near.add(z(m_.hub.lower_mm, m_.hub.upper_mm), circle(m_.hub_radius_mm));
      pieces_.drill_shaft(near, shaft_bore(machine_));
    } else {
      near.drill(z(m_.near.lower_mm, m_.near.upper_mm),
                 circle(0.5 * m_.carrier.opening_diameter_mm));
    }
    if (m_.stop.upper_mm > m_.stop.lower_mm)
      far.add(z(m_.stop.lower_mm, m_.stop.upper_mm), circle(m_.stop_radius_mm));
    if (m_.stop_hole_radius_mm > 0.0)
      far.drill(z(m_.stop.lower_mm, m_.shaft_end_mm + m_.clearance_mm),
                circle(m_.stop_hole_radius_mm));
    pieces_.drill(near, m_.carrier_screws);
    if (m_.fixed_gear < 0) pieces_.drill(near, m_.housing_screws);
    pieces_.drill(far, m_.carrier_screws);
    if (m_.output_gear < 0) pieces_.drill_insert_ends(far, m_.output_screws);
    pieces_.add_part(name, near, carrier_, PartRole::kCarrier, 0.0).upside_down = m_.driven_gear < 0;
    pieces_.add_part(name + "_top", far, carrier_, PartRole::kCarrier, 0.0).upside_down = m_.way > 0.0;
    pillar.add(z(m_.near.upper_mm, m_.far.lower_mm), circle(m_.pillar_radius_mm));
    pillar.drill(z(m_.near.upper_mm, m_.far.lower_mm),
                 circle(0.5 * m_.carrier_screws.screw.hole_mm));
    pieces_.add_part(name + "_pillar", pillar, carrier_, PartRole::kCarrier, 0.0);
    place_copies(m_.pillars, name + "_pillar");
  }

  /// Of the plate that is held, in the lips of housing and lid.
  [[nodiscard]] double held_radius_mm() const {
    const SeatFit& fit = m_.fits.ring;
    return fit.shaft.empty() ? m_.ring_radius_mm : 0.5 * fit.shaft_mm(2.0 * m_.ring_radius_mm);
  }

  /// The last part stands at each of these places.
  void place_copies(const std::vector<Point2>& at, const std::string& name) {
    const Placement first = shapes_.assembly.back();
    shapes_.assembly.pop_back();
    int number = 0;
    for (const Point2& p : at) {
      Placement copy = first;
      const Point2 place = rotated(p, first.rotation_rad);
      copy.name = name + " " + std::to_string(++number);
      copy.translation_mm = {place.x(), place.y(), first.translation_mm[2]};
      shapes_.assembly.push_back(std::move(copy));
    }
  }

  // ------------------------------------------------------------------------------- housing

  void add_housing() {
    StackedBody body;
    const double seat = 0.5 * m_.fits.ring.hole_mm(2.0 * m_.ring_radius_mm);
    body.add(z(m_.floor.lower_mm, m_.seat_top_mm), circle(m_.outer_radius_mm));
    body.drill(z(m_.floor.upper_mm, m_.ring.lower_mm), circle(m_.cavity_radius_mm));
    body.drill(z(m_.ring.lower_mm, m_.seat_top_mm), circle(seat));
    pieces_.drill_floor(body, Point2::Zero());
    pieces_.drill(body, m_.motor_screws);
    pieces_.drill(body, m_.housing_screws);
    pieces_.add_part("housing", body, kNoMember, PartRole::kCasing, held_turn_).upside_down = m_.way < 0.0;
  }

  void add_lid() {
    StackedBody body;
    const double seat = 0.5 * m_.fits.ring.hole_mm(2.0 * m_.ring_radius_mm);
    body.add(z(m_.seat_top_mm + kLipGap_mm, m_.roof.upper_mm), circle(m_.outer_radius_mm));
    body.drill(z(m_.seat_top_mm, m_.ring.upper_mm), circle(seat));
    body.drill(z(m_.ring.upper_mm, m_.roof.lower_mm), circle(m_.lid_radius_mm));
    pieces_.drill_seat(body, Point2::Zero());
    pieces_.drill(body, m_.housing_screws);
    pieces_.drill(body, m_.retainer_screws);
    pieces_.add_part("lid", body, kNoMember, PartRole::kCasing, held_turn_).upside_down = m_.way > 0.0;
    pieces_.add_retainer(held_turn_);
  }

  // ------------------------------------------------------------------------------- bought

  void add_bought() {
    BoughtParts bought(shapes_, m_);
    const double shaft_turn =
        m_.driven_gear < 0 ? 0.0 : train_.phases.rotation_rad(train_.topology().input, 0);
    pieces_.add_bought(bought, output_, held_turn_, output_turn_, shaft_turn);
    bought.add_screws(m_.carrier_screws, carrier_, 0.0);
    std::vector<Point2> planets;
    for (const double angle : train_.phases.positions_rad(train_.topology().first_planet()))
      planets.push_back(train_.centre_distance_mm * unit_vector(angle));
    const double pin = m_.near.upper_mm - m_.pin_depth_mm + 0.1;
    bought.add_pins(m_.carrier.pin_diameter_mm, m_.pin_length_mm, m_.pin_is_standard, planets, pin,
                    carrier_);
    if (!machine_.bearings.planet) return;
    const HeightRange body = planet_heights();
    bought.add_bearing(*machine_.bearings.planet, planets, body.lower_mm, carrier_);
    bought.add_bearing(*machine_.bearings.planet, planets,
                       body.upper_mm - machine_.bearings.planet->width_mm, carrier_);
  }

  [[nodiscard]] HeightRange planet_heights() const {
    HeightRange all{1e300, -1e300};
    for (std::size_t i = 0; i < train_.gears.size(); ++i) {
      if (!train_.topology().is_planet_gear(i)) continue;
      const TrainGear& gear = train_.gears[i];
      const HeightRange here = m_.z({gear.z_lower_mm, gear.z_lower_mm + gear.face_width_mm});
      all = {std::min(all.lower_mm, here.lower_mm), std::max(all.upper_mm, here.upper_mm)};
    }
    return all;
  }

  const GearTrain& train_;
  const MachineDesign& machine_;
  const MachineLayout& m_;
  PartShapes& shapes_;
  MachinePieces pieces_;
  Errors errors_;
  int carrier_ = kNoMember, output_ = kNoMember;
  double held_turn_ = 0.0, output_turn_ = 0.0;
};

/// What the process cannot print as it lies is turned over, where that is better.
void turn_over(const Process& process, PartShapes& shapes) {
  for (PartShape& part : shapes.parts) {
    if (!part.bought.empty()) continue;
    const double share = overhang_share(overhang(part, part.upside_down, process), process);
    if (share > 1.0 && overhang_share(overhang(part, !part.upside_down, process), process) < share)
      part.upside_down = !part.upside_down;
  }
}

}  // namespace

GearDesign machine_gear(const MachineLayout& layout, const GearTrain& train, int gear) {
  GearDesign design = *find_gear(train.design, train.gear(gear).name);
  if (gear == layout.fixed_gear) {
    const double size = 2.0 * layout.ring_radius_mm;
    design.outer_diameter_mm = layout.fits.ring.shaft.empty() ? size : layout.fits.ring.shaft_mm(size);
    const ScrewGroup& screws = layout.housing_screws;
    design.bolt_circle = {.count = static_cast<int>(screws.at.size()),
                          .circle_diameter_mm = 2.0 * screws.at.front().norm(),
                          .hole_diameter_mm = screws.screw.hole_mm};
  } else if (gear == layout.output_gear ||
             (gear == layout.wheel_gear && layout.cup_radius_mm > 0.0)) {
    design.outer_diameter_mm = 2.0 * layout.cup_radius_mm;
  }
  return design;
}

Errors add_machine(const GearTrain& train, const MachineLayout& layout, PartShapes& shapes) {
  Errors errors = layout.wheel_gear >= 0 ? add_pair_machine(train, layout, shapes)
                                         : MachineBuilder(train, layout, shapes).build();
  if (errors.empty() && train.design.made.process) turn_over(*train.design.made.process, shapes);
  return errors;
}

}  // namespace trueflank
