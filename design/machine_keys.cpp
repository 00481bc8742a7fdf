// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "trueflank/design/design_keys.h"
#include "trueflank/design/key_values.h"

namespace trueflank {
namespace {

using namespace key_values;

Value if_named(const std::string& name) { return name.empty() ? Value() : Value(name); }

/// Nothing where the value is that of the motor of this name in the built-in table.
template <auto Motor::*Member>
Value unless_of_table(const Motor& motor) {
  const Motor* known = find_element(standard_elements().motors, motor.name);
  const Motor& usual = known ? *known : Motor{};
  if (motor.*Member == usual.*Member) return {};
  if constexpr (std::is_same_v<std::remove_cvref_t<decltype(motor.*Member)>, int>)
    return whole_value(motor.*Member);
  else
    return Value(motor.*Member);
}

template <double Motor::*Member>
DesignKey<Motor> motor_length(const char* name, const char* meaning) {
  return {{.name = name,
           .unit = "mm",
           .lower = 0,
           .upper = 1000,
           .by_default = "of the named motor",
           .meaning = meaning},
          KeyPlace::kAnywhere,
          [](Motor& m, const KeyValue& v) { m.*Member = number(v); },
          unless_of_table<Member>};
}

template <double OutputDesign::*Member>
DesignKey<OutputDesign> output_load(const char* name, const char* unit, const char* by_default,
                                    const char* meaning) {
  return {{.name = name,
           .unit = unit,
           .lower = 0,
           .upper = 1e6,
           .by_default = by_default,
           .meaning = meaning},
          KeyPlace::kAnywhere,
          [](OutputDesign& o, const KeyValue& v) { o.*Member = number(v); },
          [](const OutputDesign& o) { return Value(o.*Member); }};
}

template <std::optional<double> HousingDesign::*Member>
DesignKey<HousingDesign> housing_length(const char* name, const char* by_default,
                                        const char* meaning) {
  return {{.name = name,
           .unit = "mm",
           .lower = 0.1,
           .upper = 2000,
           .by_default = by_default,
           .meaning = meaning},
          KeyPlace::kAnywhere,
          [](HousingDesign& h, const KeyValue& v) { h.*Member = number(v); },
          [](const HousingDesign& h) { return if_given(h.*Member); }};
}

template <Screw FastenersDesign::*Member>
DesignKey<FastenersDesign> fastener(const char* name, const char* meaning) {
  return {{.name = name, .type = KeyType::kText, .by_default = "\"M3\"", .meaning = meaning},
          KeyPlace::kAnywhere,
          [](FastenersDesign& f, const KeyValue& v) { (f.*Member).name = text(v); },
          [](const FastenersDesign& f) { return if_named((f.*Member).name); }};
}

/// A text that names no classes is kept as it is: report_contradictions tells.
template <class Table, std::optional<FitClasses> Table::*Member>
DesignKey<Table> fit_key(const char* name, const char* by_default, const char* meaning) {
  return {{.name = name, .type = KeyType::kText, .by_default = by_default, .meaning = meaning},
          KeyPlace::kAnywhere,
          [](Table& t, const KeyValue& v) {
            t.*Member = fit_classes(text(v)).value_or(FitClasses{.hole = text(v), .shaft = {}});
          },
          [](const Table& t) { return t.*Member ? Value((t.*Member)->text()) : Value(); }};
}

/// In the order of SetScrewUse.
constexpr std::array<const char*, 3> kSetScrewUses{"round", "always", "never"};

}  // namespace

const std::vector<DesignKey<Motor>>& motor_keys() {
  static const std::vector<DesignKey<Motor>> keys{
      {{.name = "name",
        .type = KeyType::kText,
        .by_default = "none: the numbers below",
        .meaning = "motor of the table ([gearbox](gearbox.md)); the keys below change single "
                   "values of it"},
       KeyPlace::kAnywhere,
       [](Motor& m, const KeyValue& v) { m.name = text(v); },
       [](const Motor& m) { return if_named(m.name); }},
      motor_length<&Motor::shaft_diameter_mm>("shaft_diameter_mm", "diameter of the shaft"),
      motor_length<&Motor::shaft_length_mm>("shaft_length_mm",
                                            "how far the shaft stands out of the face"),
      motor_length<&Motor::flat_mm>("flat_mm",
                                    "from the shaft's flat to its opposite side; 0: round"),
      motor_length<&Motor::flat_length_mm>("flat_length_mm",
                                           "length of the flat, from the shaft's end"),
      motor_length<&Motor::pilot_diameter_mm>("pilot_diameter_mm",
                                              "diameter of the centring collar; 0: none"),
      motor_length<&Motor::pilot_height_mm>("pilot_height_mm", "height of that collar"),
      motor_length<&Motor::bolt_circle_diameter_mm>("bolt_circle_diameter_mm",
                                                    "circle of the motor's screw holes"),
      {{.name = "bolt_count",
        .type = KeyType::kWhole,
        .lower = 2,
        .upper = 24,
        .by_default = "of the named motor",
        .meaning = "number of those holes, evenly spaced"},
       KeyPlace::kAnywhere,
       [](Motor& m, const KeyValue& v) { m.bolt_count = whole(v); },
       unless_of_table<&Motor::bolt_count>},
      {{.name = "screw",
        .type = KeyType::kText,
        .by_default = "of the named motor",
        .meaning = "screw of the table for those holes"},
       KeyPlace::kAnywhere,
       [](Motor& m, const KeyValue& v) { m.screw = text(v); },
       unless_of_table<&Motor::screw>},
      motor_length<&Motor::thread_depth_mm>("thread_depth_mm",
                                            "depth of their threads; 0: they go through, for nuts"),
      motor_length<&Motor::flange_mm>("flange_mm", "thickness of the flange that they go through"),
      motor_length<&Motor::body_mm>("body_mm", "width or diameter of the body"),
      motor_length<&Motor::body_length_mm>("body_length_mm", "length of the body"),
      {{.name = "torque_nm",
        .unit = "N m",
        .lower = 0,
        .upper = 1e6,
        .by_default = "of the named motor",
        .meaning = "torque of the motor, for the life of the bearings"},
       KeyPlace::kAnywhere,
       [](Motor& m, const KeyValue& v) { m.torque_nm = number(v); },
       unless_of_table<&Motor::torque_nm>},
  };
  return keys;
}

const std::vector<DesignKey<HousingDesign>>& housing_keys() {
  using H = HousingDesign;
  static const std::vector<DesignKey<H>> keys{
      housing_length<&H::outer_diameter_mm>("outer_diameter_mm",
                                            "the smallest that holds everything",
                                            "outer diameter of housing and lid"),
      housing_length<&H::wall_mm>("wall_mm", "one and a half of the process's least, 1.2 at least",
                                  "least wall between any two surfaces of the housing's parts"),
      housing_length<&H::floor_mm>("floor_mm", "as the motor's screws want it",
                                   "thickness of the floor that the motor is screwed to"),
      {{.name = "clearance_mm",
        .unit = "mm",
        .lower = 0.05,
        .upper = 100,
        .by_default = "0.5",
        .meaning = "between what turns and what does not"},
       KeyPlace::kAnywhere,
       [](H& h, const KeyValue& v) { h.clearance_mm = number(v); },
       [](const H& h) { return Value(h.clearance_mm); }},
      {{.name = "fit_mm",
        .unit = "mm",
        .lower = 0,
        .upper = 2,
        .by_default = "0.1",
        .meaning = "diametral clearance of every seat: bearings, ring, pins, the motor's collar "
                   "and shaft; 0: classes of ISO 286, H7 holes and g6 journals"},
       KeyPlace::kAnywhere,
       [](H& h, const KeyValue& v) { h.fit_mm = number(v); },
       [](const H& h) { return Value(h.fit_mm); }},
      fit_key<H, &H::fit>(
          "fit", "none: fit_mm",
          "classes of ISO 286 instead of fit_mm, as \"H7/k6\": of every hole, and of "
          "what is made to go into one; or one of both alone"),
      fit_key<H, &H::shaft_fit>("shaft_fit", "fit", "of the bore on the motor's shaft, as \"H7\""),
      fit_key<H, &H::pilot_fit>("pilot_fit", "fit",
                                "of the hole for the motor's collar, as \"H8\""),
      fit_key<H, &H::ring_fit>(
          "ring_fit", "fit",
          "of the fixed ring, or the held plate, in housing and lid; of a pair: of "
          "the lid in the housing"),
      fit_key<H, &H::pin_fit>("pin_fit", "pin_hole_clearance_mm of [carrier]",
                              "of the holes for the planets' pins in the plates, as \"N7\""),
      {{.name = "screws",
        .type = KeyType::kWhole,
        .lower = 3,
        .upper = 48,
        .by_default = "6",
        .meaning = "number of screws through lid and ring into the housing"},
       KeyPlace::kAnywhere,
       [](H& h, const KeyValue& v) { h.screws = whole(v); },
       [](const H& h) { return whole_value(h.screws); }},
  };
  return keys;
}

const std::vector<DesignKey<OutputDesign>>& output_keys() {
  using O = OutputDesign;
  static const std::vector<DesignKey<O>> keys{
      {{.name = "bolt_circle_diameter_mm",
        .unit = "mm",
        .lower = 1,
        .upper = 2000,
        .by_default = "inside the bearing's bore",
        .meaning =
            "circle of the inserts for the load, and of the output's own screws between them"},
       KeyPlace::kAnywhere,
       [](O& o, const KeyValue& v) { o.bolt_circle_diameter_mm = number(v); },
       [](const O& o) { return if_given(o.bolt_circle_diameter_mm); }},
      {{.name = "bolts",
        .type = KeyType::kWhole,
        .lower = 3,
        .upper = 24,
        .by_default = "4",
        .meaning = "number of those inserts, and of those screws"},
       KeyPlace::kAnywhere,
       [](O& o, const KeyValue& v) { o.bolts = whole(v); },
       [](const O& o) { return whole_value(o.bolts); }},
      {{.name = "torque_nm",
        .unit = "N m",
        .lower = 0,
        .upper = 1e6,
        .by_default = "the motor's through the gears",
        .meaning = "torque at the output"},
       KeyPlace::kAnywhere,
       [](O& o, const KeyValue& v) { o.torque_nm = number(v); },
       [](const O& o) { return if_given(o.torque_nm); }},
      output_load<&O::speed_rpm>("speed_rpm", "rpm", "10",
                                 "speed of the output, for the life of the bearings"),
      output_load<&O::radial_load_n>("radial_load_n", "N", "0",
                                     "load across the axis, at the output's face"),
      output_load<&O::axial_load_n>("axial_load_n", "N", "0", "load along the axis"),
  };
  return keys;
}

const std::vector<DesignKey<BearingsDesign>>& bearings_keys() {
  using B = BearingsDesign;
  static const std::vector<DesignKey<B>> keys{
      {{.name = "output",
        .type = KeyType::kText,
        .required = true,
        .meaning =
            "bearing of the table ([gearbox](gearbox.md)) that carries the output in the lid"},
       KeyPlace::kAnywhere,
       [](B& b, const KeyValue& v) { b.output.name = text(v); },
       [](const B& b) { return Value(b.output.name); }},
      {{.name = "outputs",
        .type = KeyType::kWhole,
        .lower = 1,
        .upper = 4,
        .by_default = "1",
        .meaning = "how many of them, side by side: two and more hold a tilting load"},
       KeyPlace::kAnywhere,
       [](B& b, const KeyValue& v) { b.outputs = whole(v); },
       [](const B& b) { return whole_value(b.outputs); }},
      {{.name = "planet",
        .type = KeyType::kText,
        .by_default = "none: planets turn on their pins",
        .meaning = "bearing of the table, two in every planet; its bore is the pin"},
       KeyPlace::kAnywhere,
       [](B& b, const KeyValue& v) { b.planet.emplace().name = text(v); },
       [](const B& b) { return b.planet ? Value(b.planet->name) : Value(); }},
      {{.name = "wheel",
        .type = KeyType::kText,
        .by_default = "none: the output's bearings alone hold the wheel",
        .meaning = "kind `pair`: bearing of the table in the floor, under the wheel"},
       KeyPlace::kAnywhere,
       [](B& b, const KeyValue& v) { b.wheel.emplace().name = text(v); },
       [](const B& b) { return b.wheel ? Value(b.wheel->name) : Value(); }},
      fit_key<B, &B::output_fit>("output_fit", "fit of [housing]",
                                 "classes of its seat and its journal, as \"H7/k6\""),
      fit_key<B, &B::planet_fit>("planet_fit", "fit of [housing]", "class of its seats, as \"N7\""),
      fit_key<B, &B::wheel_fit>("wheel_fit", "fit of [housing]",
                                "classes of its seat and its journal, as \"H7/k6\""),
      {{.name = "life_h",
        .unit = "h",
        .lower = 0,
        .upper = 1e7,
        .by_default = "1000",
        .meaning = "wanted life of every bearing"},
       KeyPlace::kAnywhere,
       [](B& b, const KeyValue& v) { b.life_h = number(v); },
       [](const B& b) { return Value(b.life_h); }},
  };
  return keys;
}

const std::vector<DesignKey<FastenersDesign>>& fasteners_keys() {
  using F = FastenersDesign;
  static const std::vector<DesignKey<F>> keys{
      fastener<&F::housing>("housing", "screw of the table, through lid and ring into the housing"),
      fastener<&F::carrier>("carrier", "screw of the table, through the carrier's pillars"),
      fastener<&F::output>("output",
                           "screw of the table: output, load, retainer of the output's bearing"),
      {{.name = "set_screw",
        .type = KeyType::kChoice,
        .choices = {kSetScrewUses.begin(), kSetScrewUses.end()},
        .by_default = "\"round\"",
        .meaning =
            "which motor's shafts get a set screw in the gear on them: round ones alone, those "
            "with a flat too (it bears on the flat), or none"},
       KeyPlace::kAnywhere,
       [](F& f, const KeyValue& v) {
         const auto found = std::find(kSetScrewUses.begin(), kSetScrewUses.end(), text(v));
         f.set_screw = static_cast<SetScrewUse>(found - kSetScrewUses.begin());
       },
       [](const F& f) {
         const bool usual = f.set_screw == SetScrewUse::kRoundShafts;
         return usual ? Value() : Value(kSetScrewUses[static_cast<std::size_t>(f.set_screw)]);
       }},
  };
  return keys;
}

}  // namespace trueflank
