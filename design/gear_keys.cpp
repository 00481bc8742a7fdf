// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/file_units.h"
#include "trueflank/design/key_values.h"

namespace trueflank {
namespace {

using namespace key_values;

using G = GearDesign;

void set_teeth(G& gear, const KeyValue& value) { gear.teeth = whole(value); }
Value get_teeth(const G& gear) { return whole_value(gear.teeth); }

ThicknessAllowance& allowance(G& gear) {
  if (!gear.thickness) gear.thickness = ThicknessAllowance{};
  return *gear.thickness;
}
bool by_numbers(const G& gear) { return gear.thickness && gear.thickness->series.empty(); }

std::vector<DesignKey<G>> toothing_keys() {
  return {
      {{.name = "internal", .type = KeyType::kFlag, .by_default = "false",
        .meaning = "makes the wheel of a pair or a single gear a ring"},
       KeyPlace::kMaybeRing,
       [](G& g, const KeyValue& v) {
         g.kind = std::get<bool>(v) ? GearKind::kInternal : GearKind::kExternal;
       },
       [](const G& g) { return g.kind == GearKind::kInternal ? Value(true) : Value(); }},
      {{.name = "teeth", .type = KeyType::kWhole, .lower = 5, .upper = 500, .required = true,
        .meaning = "number of teeth"},
       KeyPlace::kExternalGear, set_teeth, get_teeth},
      {{.name = "teeth", .type = KeyType::kWhole, .lower = 5, .upper = 1500, .required = true,
        .meaning = "number of teeth, positive for a ring too; more than its mate's"},
       KeyPlace::kRing, set_teeth, get_teeth},
      {{.name = "shift", .unit = "module", .lower = -10, .upper = 10,
        .by_default = "solved from the centre distance; 0 where nothing determines it",
        .meaning = "profile shift; a ring's positive shift moves its teeth outwards"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.shift = number(v); },
       [](const G& g) { return if_given(g.shift); }},
      {{.name = "module_mm", .unit = "mm", .lower = 0.01, .upper = 100,
        .by_default = "the gearbox's",
        .meaning = "module of this gear; the same for all gears that mesh"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.module_mm = number(v); },
       [](const G& g) { return if_given(g.module_mm); }},
      {{.name = "material", .type = KeyType::kText, .by_default = "the gearbox's",
        .meaning = "material of this gear; a compound planet is made of planet1's"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.material = text(v); },
       [](const G& g) { return g.material.empty() ? Value() : Value(g.material); }},
      {{.name = "face_width_mm", .unit = "mm", .lower = 0.05, .upper = 2000, .required = true,
        .meaning = "width of the teeth along the axis"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.face_width_mm = number(v); },
       [](const G& g) { return Value(g.face_width_mm); }},
      {{.name = "tip_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 200000,
        .by_default = "from shifts and centre distance",
        .meaning = "diameter of the tip circle"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.tip_diameter_mm = number(v); },
       [](const G& g) { return if_given(g.tip_diameter_mm); }},
      {{.name = "thinning_um", .unit = "um", .lower = 0, .upper = 100000,
        .by_default = "this gear's share of backlash_mm",
        .meaning = "thins the teeth by this arc on the reference circle; at most one module"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { g.thinning_mm = mm_from_um(number(v)); },
       [](const G& g) { return g.thinning_mm ? Value(file_um(*g.thinning_mm)) : Value(); }},
      {{.name = "thickness_allowance", .type = KeyType::kText, .by_default = "none",
        .meaning = "tooth thickness by a series of DIN 3967, like \"cd25\"; the teeth are made in "
                   "the middle of their tolerance, instead of thinning_um and backlash_mm"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { allowance(g).series = std::get<std::string>(v); },
       [](const G& g) {
         return g.thickness && !g.thickness->series.empty() ? Value(g.thickness->series) : Value();
       }},
      {{.name = "thickness_upper_um", .unit = "um", .lower = -100000, .upper = 100000,
        .by_default = "none",
        .meaning = "upper allowance of the tooth thickness in numbers: of the arc on the reference "
                   "circle, normal section, negative for thinner teeth"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { allowance(g).upper_mm = mm_from_um(number(v)); },
       [](const G& g) { return by_numbers(g) ? Value(file_um(g.thickness->upper_mm)) : Value(); }},
      {{.name = "thickness_lower_um", .unit = "um", .lower = -100000, .upper = 100000,
        .by_default = "none", .meaning = "lower allowance; not above the upper one"},
       KeyPlace::kAnywhere,
       [](G& g, const KeyValue& v) { allowance(g).lower_mm = mm_from_um(number(v)); },
       [](const G& g) { return by_numbers(g) ? Value(file_um(g.thickness->lower_mm)) : Value(); }},
  };
}

std::vector<DesignKey<G>> bore_keys() {
  return {
      {{.name = "bore_mm", .unit = "mm", .lower = 0.01, .upper = 50000, .by_default = "no bore",
        .meaning = "diameter of the bore; planet1's goes through the whole compound planet"},
       KeyPlace::kExternalGear,
       [](G& g, const KeyValue& v) { g.bore.diameter_mm = number(v); },
       [](const G& g) {
         return g.bore.kind == BoreKind::kHex ? Value() : unless_zero(g.bore.diameter_mm);
       }},
      {{.name = "bore_keyway_width_mm", .unit = "mm", .lower = 0.01, .upper = 50000,
        .by_default = "no keyway", .meaning = "width of a keyway in the bore"},
       KeyPlace::kExternalGear,
       [](G& g, const KeyValue& v) {
         g.bore.kind = BoreKind::kKeyway;
         g.bore.keyway_width_mm = number(v);
       },
       [](const G& g) { return unless_zero(g.bore.keyway_width_mm); }},
      {{.name = "bore_keyway_depth_mm", .unit = "mm", .lower = 0.01, .upper = 50000,
        .by_default = "no keyway",
        .meaning = "depth of the keyway in its middle, from the bore's circle (t2 of ISO 773); "
                   "keyway, flat and hexagon face +x, where tooth 1 is"},
       KeyPlace::kExternalGear,
       [](G& g, const KeyValue& v) {
         g.bore.kind = BoreKind::kKeyway;
         g.bore.keyway_depth_mm = number(v);
       },
       [](const G& g) { return unless_zero(g.bore.keyway_depth_mm); }},
      {{.name = "bore_d_flat_mm", .unit = "mm", .lower = 0.01, .upper = 50000,
        .by_default = "no flat",
        .meaning = "D bore: distance of the flat from the opposite side of the bore, as a caliper "
                   "measures the shaft"},
       KeyPlace::kExternalGear,
       [](G& g, const KeyValue& v) {
         g.bore.kind = BoreKind::kDFlat;
         g.bore.d_flat_mm = number(v);
       },
       [](const G& g) { return unless_zero(g.bore.d_flat_mm); }},
      {{.name = "bore_hex_mm", .unit = "mm", .lower = 0.01, .upper = 50000,
        .by_default = "no hexagon",
        .meaning = "hexagonal bore, width across flats; instead of bore_mm"},
       KeyPlace::kExternalGear,
       [](G& g, const KeyValue& v) {
         g.bore.kind = BoreKind::kHex;
         g.bore.diameter_mm = number(v);
       },
       [](const G& g) {
         return g.bore.kind == BoreKind::kHex ? unless_zero(g.bore.diameter_mm) : Value();
       }},
  };
}

std::vector<DesignKey<G>> ring_keys() {
  return {
      {{.name = "outer_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 200000,
        .by_default = "a rim of 2.5 modules, at least 2 mm",
        .meaning = "outer diameter of the ring"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) { g.outer_diameter_mm = number(v); },
       [](const G& g) { return if_given(g.outer_diameter_mm); }},
      {{.name = "bolt_circle_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 200000,
        .by_default = "no bolts",
        .meaning = "diameter of the circle of through holes in the rim, the first of them on +x"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) { g.bolt_circle.circle_diameter_mm = number(v); },
       [](const G& g) { return unless_zero(g.bolt_circle.circle_diameter_mm); }},
      {{.name = "bolt_count", .type = KeyType::kWhole, .lower = 1, .upper = 360,
        .by_default = "no bolts", .meaning = "number of those holes"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) { g.bolt_circle.count = whole(v); },
       [](const G& g) {
         return g.bolt_circle.count == 0 ? Value() : whole_value(g.bolt_circle.count);
       }},
      {{.name = "bolt_hole_diameter_mm", .unit = "mm", .lower = 0.01, .upper = 10000,
        .by_default = "no bolts", .meaning = "diameter of those holes"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) { g.bolt_circle.hole_diameter_mm = number(v); },
       [](const G& g) { return unless_zero(g.bolt_circle.hole_diameter_mm); }},
      {{.name = "halves", .type = KeyType::kFlag, .by_default = "true in a [housing], else false",
        .meaning = "herringbone rings: made as two parts, split at the apex, that close over the planets "
                   "from either side"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) { g.halves = std::get<bool>(v); },
       [](const G& g) { return g.halves ? Value(*g.halves) : Value(); }},
      {{.name = "root", .type = KeyType::kChoice, .choices = {"fillet", "shaper"},
        .by_default = "\"fillet\"",
        .meaning = "fillet: the involute to the root circle, filleted with root_radius, full round "
                   "where that does not fit; shaper: what the cutter below cuts"},
       KeyPlace::kRing,
       [](G& g, const KeyValue& v) {
         g.root = std::get<std::string>(v) == "shaper" ? RingRoot::kShaper : RingRoot::kFillet;
       },
       [](const G& g) {
         if (g.root == RingRoot::kShaper) return Value(std::string("shaper"));
         return g.cutter ? Value(std::string("fillet")) : Value();
       }},
  };
}

}  // namespace

const std::vector<DesignKey<GearDesign>>& gear_keys() {
  static const std::vector<DesignKey<G>> keys = [] {
    std::vector<DesignKey<G>> all = toothing_keys();
    for (const auto& group : {bore_keys(), ring_keys()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return keys;
}

const std::vector<DesignKey<ShaperCutter>>& cutter_keys() {
  using Cutter = ShaperCutter;
  static const std::vector<DesignKey<Cutter>> keys{
      {{.name = "name",
        .type = KeyType::kText,
        .by_default = "none",
        .meaning = "a cutter by its name ([made](made.md)); the keys below change single values of "
                   "it"},
       KeyPlace::kAnywhere,
       [](Cutter&, const KeyValue&) {},  // the reader fills in what the other keys do not say
       [](const Cutter&) { return Value(); }},
      {{.name = "teeth",
        .type = KeyType::kWhole,
        .lower = 5,
        .upper = 500,
        .by_default = "needed without name",
        .meaning = "number of teeth of the cutter; fewer than the ring's"},
       KeyPlace::kAnywhere,
       [](Cutter& c, const KeyValue& v) { c.teeth = whole(v); },
       [](const Cutter& c) { return whole_value(c.teeth); }},
      {{.name = "shift",
        .unit = "module",
        .lower = -10,
        .upper = 10,
        .by_default = "0",
        .meaning = "profile shift of the cutter"},
       KeyPlace::kAnywhere,
       [](Cutter& c, const KeyValue& v) { c.shift = number(v); },
       [](const Cutter& c) { return Value(c.shift); }},
      {{.name = "tip_radius",
        .unit = "module",
        .lower = 0,
        .upper = 3,
        .by_default = "0",
        .meaning = "rounding of the corners of the cutter's teeth, in its transverse section"},
       KeyPlace::kAnywhere,
       [](Cutter& c, const KeyValue& v) { c.tip_radius = number(v); },
       [](const Cutter& c) { return Value(c.tip_radius); }},
  };
  return keys;
}

}  // namespace trueflank
