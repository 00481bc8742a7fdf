// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/solid/shape/machine/bought_parts.h"
#include "trueflank/solid/shape/machine/stacked_body.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

[[nodiscard]] inline CircleOutline circle(double radius_mm, const Point2& centre = Point2::Zero()) {
  return {.centre = centre, .radius_mm = radius_mm};
}

/// The teeth of a gear's part, in the assembly where its lower face stands at a height: nothing where they
/// are not straight, or not all in one.
[[nodiscard]] std::optional<ToothedOutline> straight_teeth(const PartShape& part, double at_mm);

/// What the gearboxes of all kinds are made of. Heights are the layout's.
class MachinePieces {
 public:
  MachinePieces(const MachineDesign& machine, const MachineLayout& layout, PartShapes& shapes)
      : machine_(machine), m_(layout), shapes_(shapes) {}

  /// In the assembly.
  [[nodiscard]] HeightRange z(double from, double to) const;

  /// Holes for screws in a body that stands at an axis: over the head, along the shank, and for the
  /// insert from the far face.
  void drill(StackedBody& body, const ScrewGroup& group, const Point2& axis = Point2::Zero()) const;
  /// The same of screws whose insert alone is in the body: it carries the output.
  void drill_insert_ends(StackedBody& body, const ScrewGroup& group) const;
  /// The hole that the motor's collar and the hub go through, in a floor that stands at an axis.
  void drill_floor(StackedBody& body, const Point2& axis) const;
  /// The hub of the gear on the motor's shaft, with the foot of its set screw; and the bore. `gear` are its
  /// teeth, whose lower face stands at a height.
  void add_hub(StackedBody& body, const BoreDesign& bore, const PartShape& gear, double at_mm) const;
  /// Wall and floor of the cup that a ring makes which drives out; its teeth are `part`, whose lower
  /// face stands at a height.
  void add_cup(StackedBody& body, const PartShape& part, double at_mm) const;
  /// The bore on the motor's shaft; round where the shaft is.
  void drill_shaft(StackedBody& body, const BoreDesign& bore) const;

  /// Adds a part and places it.
  PartShape& add_part(std::string name, const StackedBody& body, int member, PartRole role,
                      double rotation_rad, const Point2& axis = Point2::Zero());
  /// Holds the outer ring of the output's bearing in the lid.
  void add_retainer(double rotation_rad);
  /// The bearing's seat in the lid, open to the motor's side.
  void drill_seat(StackedBody& lid, const Point2& axis) const;
  /// `journal` and `output`.
  void add_output(int member, double rotation_rad);
  /// Motor, screws of housing, motor, retainer and output, inserts for the load, the output's bearings.
  void add_bought(BoughtParts& bought, int output_member, double held_turn_rad,
                  double output_turn_rad, double shaft_turn_rad) const;

 private:
  const MachineDesign& machine_;
  const MachineLayout& m_;
  PartShapes& shapes_;
};

/// Makes a gearbox of a pair's parts: hub and stub are added to pinion and wheel; then come
/// `housing`, `lid`, `retainer`, `journal`, `output`, and what is bought.
[[nodiscard]] Errors add_pair_machine(const GearTrain& train, const MachineLayout& layout,
                                      PartShapes& shapes);

}  // namespace trueflank
