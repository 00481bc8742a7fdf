// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/design/design_keys.h"
#include "trueflank/design/key_values.h"

namespace trueflank {
namespace {

using namespace key_values;

using M = ModificationsDesign;

ReliefShape shape_of(const KeyValue& value) {
  return std::get<std::string>(value) == "linear" ? ReliefShape::kLinear : ReliefShape::kParabola;
}
Value unless_parabola(ReliefShape shape) {
  return shape == ReliefShape::kLinear ? Value(std::string("linear")) : Value();
}

/// An amount is said, be it 0, where its place or shape is: neither reads without it.
Value with_its_place(double amount_um, double place_mm, ReliefShape shape) {
  return amount_um == 0.0 && place_mm == 0.0 && shape == ReliefShape::kParabola ? Value()
                                                                                : Value(amount_um);
}

std::vector<DesignKey<M>> relief_keys() {
  return {
      {{.name = "tip_relief_um", .unit = "um", .lower = 0, .upper = 10000, .by_default = "0",
        .meaning = "tip relief: what is removed at the tip form circle, normal to the flank"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.tip_relief_um = number(v); },
       [](const M& m) {
         return with_its_place(m.tip_relief_um, m.tip_relief_start_diameter_mm, m.tip_relief_shape);
       }},
      {{.name = "tip_relief_start_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 200000,
        .by_default = "needed with tip_relief_um",
        .meaning = "diameter at which the tip relief starts"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.tip_relief_start_diameter_mm = number(v); },
       [](const M& m) { return unless_zero(m.tip_relief_start_diameter_mm); }},
      {{.name = "tip_relief_shape", .type = KeyType::kChoice, .choices = {"parabola", "linear"},
        .by_default = "\"parabola\"", .meaning = "how the tip relief grows with roll length"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.tip_relief_shape = shape_of(v); },
       [](const M& m) { return unless_parabola(m.tip_relief_shape); }},
      {{.name = "root_relief_um", .unit = "um", .lower = 0, .upper = 10000, .by_default = "0",
        .meaning = "root relief: what is removed at the root form circle, normal to the flank"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.root_relief_um = number(v); },
       [](const M& m) {
         return with_its_place(m.root_relief_um, m.root_relief_start_diameter_mm, m.root_relief_shape);
       }},
      {{.name = "root_relief_start_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 200000,
        .by_default = "needed with root_relief_um",
        .meaning = "diameter at which the root relief starts"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.root_relief_start_diameter_mm = number(v); },
       [](const M& m) { return unless_zero(m.root_relief_start_diameter_mm); }},
      {{.name = "root_relief_shape", .type = KeyType::kChoice, .choices = {"parabola", "linear"},
        .by_default = "\"parabola\"", .meaning = "how the root relief grows with roll length"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.root_relief_shape = shape_of(v); },
       [](const M& m) { return unless_parabola(m.root_relief_shape); }},
  };
}

std::vector<DesignKey<M>> profile_keys() {
  return {
      {{.name = "profile_crowning_um", .unit = "um", .lower = 0, .upper = 10000, .by_default = "0",
        .meaning = "profile crowning: what is removed at root form and tip form circle, a parabola "
                   "in roll length"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.profile_crowning_um = number(v); },
       [](const M& m) { return unless_zero(m.profile_crowning_um); }},
      {{.name = "profile_slope_um", .unit = "um", .lower = -10000, .upper = 10000,
        .by_default = "0",
        .meaning = "profile slope correction from root form to tip form circle, zero at mid roll; "
                   "positive: material towards the tip"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.profile_slope_um = number(v); },
       [](const M& m) { return unless_zero(m.profile_slope_um); }},
  };
}

std::vector<DesignKey<M>> face_keys() {
  return {
      {{.name = "crowning_um", .unit = "um", .lower = 0, .upper = 10000, .by_default = "0",
        .meaning = "lead crowning: what is removed at both ends of the face (herringbone: of each "
                   "half), a parabola in z"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.crowning_um = number(v); },
       [](const M& m) { return unless_zero(m.crowning_um); }},
      {{.name = "end_relief_um", .unit = "um", .lower = 0, .upper = 10000, .by_default = "0",
        .meaning = "end relief: what is removed at both end faces"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.end_relief_um = number(v); },
       [](const M& m) {
         return with_its_place(m.end_relief_um, m.end_relief_length_mm, m.end_relief_shape);
       }},
      {{.name = "end_relief_length_mm", .unit = "mm", .lower = 0.001, .upper = 1000,
        .by_default = "needed with end_relief_um",
        .meaning = "how far the end relief reaches in from the end faces"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.end_relief_length_mm = number(v); },
       [](const M& m) { return unless_zero(m.end_relief_length_mm); }},
      {{.name = "end_relief_shape", .type = KeyType::kChoice, .choices = {"parabola", "linear"},
        .by_default = "\"parabola\"", .meaning = "how the end relief grows towards the end face"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.end_relief_shape = shape_of(v); },
       [](const M& m) { return unless_parabola(m.end_relief_shape); }},
      {{.name = "helix_slope_um", .unit = "um", .lower = -10000, .upper = 10000, .by_default = "0",
        .meaning = "helix slope correction over the face, zero at mid face; positive: the section "
                   "turns counter-clockwise with z (herringbone: in the lower half, mirrored in the "
                   "upper)"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.helix_slope_um = number(v); },
       [](const M& m) { return unless_zero(m.helix_slope_um); }},
      {{.name = "edge_chamfer_mm", .unit = "mm", .lower = 0, .upper = 100, .by_default = "0",
        .meaning = "chamfer of the edges at both faces; less than half the face width"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.edge_chamfer_mm = number(v); },
       [](const M& m) { return unless_zero(m.edge_chamfer_mm); }},
      {{.name = "tip_rounding_mm", .unit = "mm", .lower = 0, .upper = 100, .by_default = "0",
        .meaning = "radius between tip circle and flank, in the transverse section"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.tip_rounding_mm = number(v); },
       [](const M& m) { return unless_zero(m.tip_rounding_mm); }},
  };
}

}  // namespace

const std::vector<DesignKey<ModificationsDesign>>& modification_keys() {
  static const std::vector<DesignKey<M>> keys = [] {
    std::vector<DesignKey<M>> all = relief_keys();
    for (const auto& group : {profile_keys(), face_keys()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return keys;
}

}  // namespace trueflank
