// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/solid/shape/machine/machine_pieces.h"

namespace trueflank {
namespace {

/// The wheel's stub ends this far before its bearing does.
constexpr double kStubShorter_mm = 0.1;

class PairBuilder {
 public:
  PairBuilder(const GearTrain& train, const MachineLayout& layout, PartShapes& shapes)
      : train_(train),
        machine_(*train.design.machine),
        m_(layout),
        shapes_(shapes),
        pieces_(machine_, layout, shapes) {}

  Errors build() {
    const int output = train_.topology().output;
    const double turn = train_.phases.rotation_rad(output, 0);
    add_hub(part_of(train_.topology().input));
    if (m_.cup_radius_mm > 0.0)
      add_cup(part_of(output));
    else
      add_stub(part_of(output));
    add_housing();
    add_lid();
    pieces_.add_retainer(0.0);
    pieces_.add_output(output, turn);
    BoughtParts bought(shapes_, m_);
    pieces_.add_bought(bought, output, 0.0, turn,
                       train_.phases.rotation_rad(train_.topology().input, 0));
    if (machine_.bearings.wheel)
      bought.add_bearing(*machine_.bearings.wheel, {m_.output_axis}, m_.stub.bearing.lower_mm,
                         kNoMember);
    return {};
  }

 private:
  [[nodiscard]] HeightRange z(double from, double to) const { return pieces_.z(from, to); }
  [[nodiscard]] std::size_t part_of(int member) const {
    std::size_t i = 0;
    while (shapes_.parts[i].member != member) ++i;
    return i;
  }
  /// A gear's part becomes this body; it stood with its lower face at a height.
  void replace(std::size_t part, const StackedBody& body, double stood_mm) {
    shapes_.parts[part].slabs = body.slabs();
    for (Placement& placement : shapes_.assembly)
      if (placement.part == static_cast<int>(part))
        placement.translation_mm[2] += body.heights().lower_mm - stood_mm;
  }

  /// The pinion's hub on the motor's shaft.
  void add_hub(std::size_t part) {
    const TrainGear& gear = train_.gear(m_.driven_gear);
    StackedBody body;
    for (Slab slab : shapes_.parts[part].slabs) {
      std::erase_if(slab.holes,
                    [](const Outline& hole) { return std::holds_alternative<BoreOutline>(hole); });
      body.add({slab}, gear.z_lower_mm);
    }
    const auto teeth = straight_teeth(shapes_.parts[part], gear.z_lower_mm);
    const double wall = m_.spacer_radius_mm - 0.5 * machine_.motor.shaft_diameter_mm;
    if (teeth || wall >= m_.wall_mm)
      body.add(z(m_.spacer.lower_mm, m_.spacer.upper_mm),
               teeth ? Outline{*teeth} : Outline{circle(m_.spacer_radius_mm)});
    pieces_.add_hub(body, find_gear(train_.design, gear.name)->bore, shapes_.parts[part], gear.z_lower_mm);
    replace(part, body, gear.z_lower_mm);
    // a large pinion hangs over its hub
    shapes_.parts[part].upside_down =
        m_.hub_radius_mm <
        gear.profile.root_radius_mm() - gear.profile.gear().normal_module_mm;
  }

  /// The wheel's inserts for the output's screws, and its stub in the bearing in the floor.
  void add_stub(std::size_t part) {
    const TrainGear& gear = train_.gear(m_.wheel_gear);
    const auto& stub = m_.stub;
    StackedBody body;
    body.add(shapes_.parts[part].slabs, gear.z_lower_mm);
    body.add(z(stub.bearing.upper_mm, gear.z_lower_mm), circle(stub.inner_shoulder_mm));
    body.add(z(stub.bearing.lower_mm + kStubShorter_mm, stub.bearing.upper_mm),
             circle(stub.journal_radius_mm));
    pieces_.drill_insert_ends(body, m_.output_screws);
    replace(part, body, gear.z_lower_mm);
    shapes_.parts[part].upside_down = machine_.bearings.wheel.has_value();
  }

  /// A wheel with inner teeth is a cup over the pinion.
  void add_cup(std::size_t part) {
    const TrainGear& gear = train_.gear(m_.wheel_gear);
    StackedBody body;
    body.add(shapes_.parts[part].slabs, gear.z_lower_mm);
    pieces_.add_cup(body, shapes_.parts[part], gear.z_lower_mm);
    replace(part, body, gear.z_lower_mm);
    shapes_.parts[part].upside_down = true;
  }

  void add_housing() {
    const Point2& axis = m_.housing_axis;
    StackedBody body;
    body.add(z(m_.floor.lower_mm, m_.seat_top_mm), circle(m_.outer_radius_mm));
    const SeatFit& rim = m_.fits.rim;
    body.drill(z(m_.floor.upper_mm, m_.seat_top_mm),
               circle(rim.hole.empty() ? m_.cavity_radius_mm : 0.5 * rim.hole_mm(2.0 * m_.cavity_radius_mm)));
    pieces_.drill_floor(body, axis);
    if (machine_.bearings.wheel) {
      const Point2 at = m_.output_axis - axis;
      body.drill(z(m_.stub.bearing.lower_mm, m_.floor.upper_mm),
                 circle(0.5 * m_.fits.wheel.hole_mm(machine_.bearings.wheel->outer_mm), at));
      body.drill(z(m_.stub.relief_mm, m_.stub.bearing.lower_mm), circle(m_.stub.outer_shoulder_mm, at));
    }
    pieces_.drill(body, m_.motor_screws, axis);
    pieces_.drill(body, m_.housing_screws, axis);
    pieces_.add_part("housing", body, kNoMember, PartRole::kCasing, 0.0, axis);
  }

  void add_lid() {
    const Point2& axis = m_.housing_axis;
    StackedBody body;
    body.add(z(m_.lid_lower_mm, m_.seat_top_mm), circle(0.5 * m_.fits.rim.shaft_mm(2.0 * m_.cavity_radius_mm)));
    body.add(z(m_.seat_top_mm, m_.roof.upper_mm), circle(m_.outer_radius_mm));
    body.drill(z(m_.lid_lower_mm, m_.roof.lower_mm),
               circle(m_.lid_radius_mm, m_.output_axis - axis));
    pieces_.drill_seat(body, axis);
    if (m_.stop_hole_radius_mm > 0.0)
      body.drill(z(m_.lid_lower_mm, m_.shaft_end_mm + m_.clearance_mm),
                 circle(m_.stop_hole_radius_mm, -axis));
    pieces_.drill(body, m_.housing_screws, axis);
    pieces_.drill(body, m_.retainer_screws, axis);
    pieces_.add_part("lid", body, kNoMember, PartRole::kCasing, 0.0, axis).upside_down = true;
  }

  const GearTrain& train_;
  const MachineDesign& machine_;
  const MachineLayout& m_;
  PartShapes& shapes_;
  MachinePieces pieces_;
};

}  // namespace

Errors add_pair_machine(const GearTrain& train, const MachineLayout& layout, PartShapes& shapes) {
  return PairBuilder(train, layout, shapes).build();
}

}  // namespace trueflank
