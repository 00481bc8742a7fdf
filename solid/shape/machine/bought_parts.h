// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// Adds what is bought to a gearbox: bodies of the room that it takes, named for their designation.
/// Heights are the layout's.
class BoughtParts {
 public:
  BoughtParts(PartShapes& shapes, const MachineLayout& layout) : shapes_(shapes), m_(layout) {}

  /// Its screws stand as what is held is turned, the flat of its shaft as the bore on it.
  void add_motor(const Motor& motor, double rotation_rad, double shaft_turn_rad);
  /// Screws with their inserts, where they have some.
  void add_screws(const ScrewGroup& group, int member, double rotation_rad);
  void add_inserts(const Screw& screw, const std::string& what, const std::vector<Point2>& at,
                   double from_mm, int member, double rotation_rad,
                   const Point2& axis = Point2::Zero());
  void add_bearing(const Bearing& bearing, const std::vector<Point2>& at, double from_mm,
                   int member);
  void add_pins(double diameter_mm, double length_mm, bool standard, const std::vector<Point2>& at,
                double from_mm, int member);

 private:
  /// A layer of a bought part.
  struct Layer {
    double from_mm = 0.0, to_mm = 0.0;
    Outline outer;
    std::vector<Outline> holes = {};
  };
  /// The part of a name, made where it is not there yet; placed at each of these points about an
  /// axis, which are turned.
  void place(const std::string& name, const std::string& designation, std::vector<Layer> layers,
             const std::vector<Point2>& at, int member, double rotation_rad,
             const Point2& axis = Point2::Zero());

  PartShapes& shapes_;
  const MachineLayout& m_;
};

}  // namespace trueflank
