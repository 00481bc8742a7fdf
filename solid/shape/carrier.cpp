// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/carrier.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/train/carrier.h"

namespace trueflank {
namespace {

/// Least wall between two outlines of a plate: thinner it is no part of a carrier.
constexpr double kLeastWall_mm = 0.4;

class CarrierBuilder {
 public:
  /// `whole`: whose stage the train is, or the train itself.
  CarrierBuilder(const GearTrain& whole, const GearTrain& train, const CarrierLayout& layout, PartShapes& shapes)
      : whole_(whole), train_(train), layout_(layout), shapes_(shapes) {}

  Errors build() {
    check_pins();
    check_walls();
    if (errors_.empty()) add_parts();
    return std::move(errors_);
  }

 private:
  void infeasible(const char* key, std::string message, std::string remedy) {
    errors_.push_back({.code = ErrorCode::kInfeasible,
                       .message = std::move(message),
                       .key = std::string("carrier.") + key,
                       .remedy = std::move(remedy)});
  }

  void check_pins() {
    const GearDesign* planet = planet_with_bore(train_.design);
    const BoreDesign& bore = planet->bore;
    if (!(layout_.pin_diameter_mm > 0.0) || !(bore.diameter_mm > layout_.pin_diameter_mm))
      infeasible("pin_diameter_mm",
                 planet->name + " has a bore of " + fixed_mm(bore.diameter_mm) +
                     " mm: no pin of diameter " + fixed_mm(layout_.pin_diameter_mm) + " mm turns in it",
                 "a bore_mm of " + planet->name + " larger than the pin");
    else if (bore.kind != BoreKind::kRound)
      infeasible("pin_diameter_mm", planet->name + "'s bore is not round: it cannot turn on a pin",
                 "bore_mm alone in [" + planet->name + "]");
  }

  void check_walls() {
    const double circle = train_.centre_distance_mm, hole = 0.5 * layout_.pin_hole_diameter_mm;
    const double inner = circle - hole - kLeastWall_mm;
    if (!(0.5 * layout_.opening_diameter_mm <= inner))
      infeasible("opening_diameter_mm",
                 "the carrier's opening of diameter " + fixed_mm(layout_.opening_diameter_mm) +
                     " mm leaves no wall to the holes of its pins",
                 "at most " + fixed_mm(2.0 * inner) + " mm");
    if (!(0.5 * layout_.outer_diameter_mm >= circle + hole + kLeastWall_mm))
      infeasible("outer_diameter_mm",
                 "the carrier's plate of diameter " + fixed_mm(layout_.outer_diameter_mm) +
                     " mm leaves no wall around its pins",
                 "at least " + fixed_mm(2.0 * (circle + hole + kLeastWall_mm)) + " mm");
    const double apart = nearest_pins_mm();
    if (!(apart >= 2.0 * hole + kLeastWall_mm))
      infeasible("pin_diameter_mm",
                 "the carrier's pins stand " + fixed_mm(apart) + " mm apart, their holes measure " +
                     fixed_mm(2.0 * hole) + " mm",
                 "thinner pins");
    if (layout_.seat_diameter_mm > 0.0) check_seat(inner);
  }

  void check_seat(double inner_mm) {
    const double thickness = layout_.lower_plate.upper_mm - layout_.lower_plate.lower_mm;
    if (!(0.5 * layout_.seat_diameter_mm <= inner_mm))
      infeasible("bearing_diameter_mm",
                 "the seat of diameter " + fixed_mm(layout_.seat_diameter_mm) +
                     " mm leaves no wall to the holes of the pins",
                 "at most " + fixed_mm(2.0 * inner_mm) + " mm");
    if (!(layout_.seat_diameter_mm >= layout_.opening_diameter_mm + 2.0 * kLeastWall_mm))
      infeasible("bearing_diameter_mm",
                 "the seat of diameter " + fixed_mm(layout_.seat_diameter_mm) +
                     " mm has no shoulder around the opening of " +
                     fixed_mm(layout_.opening_diameter_mm) + " mm",
                 "a smaller opening_diameter_mm");
    if (!(layout_.seat_depth_mm + kLeastWall_mm <= thickness))
      infeasible("bearing_width_mm",
                 "the seat is " + fixed_mm(layout_.seat_depth_mm) + " mm deep in a plate of " +
                     fixed_mm(thickness) + " mm",
                 "a plate_thickness_mm of at least " + fixed_mm(layout_.seat_depth_mm + kLeastWall_mm) +
                     " mm");
  }

  [[nodiscard]] double nearest_pins_mm() const {
    const auto& angles = positions_rad();
    double apart = 1e300;
    for (std::size_t i = 0; i < angles.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        apart = std::min(apart, 2.0 * train_.centre_distance_mm *
                                    std::abs(std::sin(0.5 * (angles[i] - angles[j]))));
    return apart;
  }

  [[nodiscard]] const std::vector<double>& positions_rad() const {
    return train_.phases.positions_rad(train_.topology().first_planet());
  }

  // ------------------------------------------------------------------------------------- shapes

  void add_parts() {
    const double thickness = layout_.lower_plate.upper_mm - layout_.lower_plate.lower_mm;
    const double depth = layout_.seat_diameter_mm > 0.0 ? layout_.seat_depth_mm : 0.0;
    const double opening = layout_.opening_diameter_mm, seat = layout_.seat_diameter_mm;
    std::vector<Slab> lower, upper;
    if (depth > 0.0) lower.push_back(plate_slab(0.0, depth, seat));
    lower.push_back(plate_slab(depth, thickness, opening));
    upper.push_back(plate_slab(0.0, thickness - depth, opening));
    if (depth > 0.0) upper.push_back(plate_slab(thickness - depth, thickness, seat));
    add_plate("", std::move(lower), layout_.lower_plate);
    if (!bears_gear(whole_.topology(), member())) add_plate("_top", std::move(upper), layout_.upper_plate);
    add_pins();
  }

  [[nodiscard]] Slab plate_slab(double z_lower_mm, double z_upper_mm, double opening_mm) const {
    Slab slab{.z_lower_mm = z_lower_mm,
              .z_upper_mm = z_upper_mm,
              .outer = CircleOutline{Point2::Zero(), 0.5 * layout_.outer_diameter_mm},
              .holes = {}};
    if (opening_mm > 0.0) slab.holes.push_back(CircleOutline{Point2::Zero(), 0.5 * opening_mm});
    for (double angle : positions_rad())
      slab.holes.push_back(CircleOutline{train_.centre_distance_mm * unit_vector(angle),
                                         0.5 * layout_.pin_hole_diameter_mm});
    return slab;
  }

  /// In the whole.
  [[nodiscard]] int member() const {
    const Topology& topology = train_.topology();
    return whole_.topology().find_member(topology.name_of(topology.carrier_of(topology.first_planet())));
  }

  /// The carrier's parts are named after it.
  void add_part(const char* suffix, std::vector<Slab> slabs) {
    shapes_.parts.push_back({.name = whole_.topology().name_of(member()) + suffix,
                             .slabs = std::move(slabs),
                             .member = member(),
                             .role = PartRole::kCarrier});
  }

  void add_plate(const char* suffix, std::vector<Slab> slabs, const HeightRange& heights) {
    add_part(suffix, std::move(slabs));
    shapes_.assembly.push_back({.part = static_cast<int>(shapes_.parts.size()) - 1,
                                .name = shapes_.parts.back().name,
                                .translation_mm = {0.0, 0.0, heights.lower_mm}});
  }

  void add_pins() {
    const HeightRange heights = layout_.pins();
    add_part("_pin", {{.z_lower_mm = 0.0,
                       .z_upper_mm = heights.upper_mm - heights.lower_mm,
                       .outer = CircleOutline{Point2::Zero(), 0.5 * layout_.pin_diameter_mm},
                       .holes = {}}});
    int number = 0;
    for (double angle : positions_rad()) {
      const Point2 centre = train_.centre_distance_mm * unit_vector(angle);
      shapes_.assembly.push_back({.part = static_cast<int>(shapes_.parts.size()) - 1,
                                  .name = shapes_.parts.back().name + " " + std::to_string(++number),
                                  .translation_mm = {centre.x(), centre.y(), heights.lower_mm}});
    }
  }

  const GearTrain& whole_;
  const GearTrain& train_;
  const CarrierLayout& layout_;
  PartShapes& shapes_;
  Errors errors_;
};

}  // namespace

Errors add_carrier(const GearTrain& train, PartShapes& shapes) {
  Errors errors;
  for (const GearTrain* stage : train.each_stage())
    if (const auto layout = carrier_layout(*stage))
      for (Error& error : CarrierBuilder(train, *stage, *layout, shapes).build()) errors.push_back(std::move(error));
  return errors;
}

bool bears_gear(const Topology& topology, int carrier) { return !topology.gears_of(carrier).empty(); }

}  // namespace trueflank
