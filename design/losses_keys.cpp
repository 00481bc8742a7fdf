// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace {

using L = LossesDesign;
using Value = std::optional<KeyValue>;

double number(const KeyValue& value) { return std::get<double>(value); }
Value if_given(const std::optional<double>& value) { return value ? Value(*value) : Value(); }
Value unless(double value, double by_default) { return value == by_default ? Value() : Value(value); }

}  // namespace

const std::vector<DesignKey<LossesDesign>>& losses_keys() {
  static const std::vector<DesignKey<L>> keys{
      {{.name = "load_nm", .unit = "N m", .lower = 1e-9, .upper = 1e9, .required = true,
        .meaning = "output torque at which the efficiencies are reported"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.load_nm = number(v); },
       [](const L& l) { return Value(l.load_nm); }},
      {{.name = "input_speed_rpm", .unit = "rpm", .lower = 0, .upper = 1e7, .required = true,
        .meaning = "input speed at which the efficiencies are reported"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.input_speed_rpm = number(v); },
       [](const L& l) { return Value(l.input_speed_rpm); }},
      {{.name = "temperature_c", .unit = "deg C", .lower = -273, .upper = 2000,
        .by_default = "reference_c", .meaning = "temperature at which the efficiencies are reported"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.temperature_c = number(v); },
       [](const L& l) { return if_given(l.temperature_c); }},
      {{.name = "reference_c", .unit = "deg C", .lower = -273, .upper = 2000, .by_default = "25",
        .meaning = "temperature of the drag and viscous values below"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.reference_c = number(v); },
       [](const L& l) { return unless(l.reference_c, L{}.reference_c); }},
      {{.name = "drag_torque_nm", .unit = "N m", .lower = 0, .upper = 1e6, .by_default = "0",
        .meaning = "torque lost at the input whatever the load and speed"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.drag_torque_nm = number(v); },
       [](const L& l) { return unless(l.drag_torque_nm, 0.0); }},
      {{.name = "drag_per_c", .unit = "1/deg C", .lower = -1, .upper = 1, .by_default = "0",
        .meaning = "the drag falls by this power of e a degree"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.drag_per_c = number(v); },
       [](const L& l) { return unless(l.drag_per_c, 0.0); }},
      {{.name = "viscous_nm_per_rpm", .unit = "N m/rpm", .lower = 0, .upper = 1e3, .by_default = "0",
        .meaning = "torque lost at the input per input speed"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.viscous_nm_per_rpm = number(v); },
       [](const L& l) { return unless(l.viscous_nm_per_rpm, 0.0); }},
      {{.name = "viscous_per_c", .unit = "1/deg C", .lower = -1, .upper = 1, .by_default = "0",
        .meaning = "the viscous loss falls by this power of e a degree"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.viscous_per_c = number(v); },
       [](const L& l) { return unless(l.viscous_per_c, 0.0); }},
      {{.name = "bearing_nm_at_1000_rpm", .unit = "N m", .lower = 0, .upper = 1e6, .by_default = "0",
        .meaning = "torque lost at the input that grows with the 2/3 power of speed, at 1000 rpm"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.bearing_nm_at_1000_rpm = number(v); },
       [](const L& l) { return unless(l.bearing_nm_at_1000_rpm, 0.0); }},
      {{.name = "bearing_load_share", .lower = 0, .upper = 1, .by_default = "0",
        .meaning = "share of the carried torque that bearings lose, at the input"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.bearing_load_share = number(v); },
       [](const L& l) { return unless(l.bearing_load_share, 0.0); }},
      {{.name = "stribeck_torque_nm", .unit = "N m", .lower = 0, .upper = 1e6, .by_default = "0",
        .meaning = "torque lost at the input that fades with speed: T exp(-(n/n0)^2)"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.stribeck_torque_nm = number(v); },
       [](const L& l) { return unless(l.stribeck_torque_nm, 0.0); }},
      {{.name = "stribeck_speed_rpm", .unit = "rpm", .lower = 1e-6, .upper = 1e7,
        .by_default = "100", .meaning = "n0 of it"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.stribeck_speed_rpm = number(v); },
       [](const L& l) { return unless(l.stribeck_speed_rpm, L{}.stribeck_speed_rpm); }},
      {{.name = "backward_friction", .lower = 0, .upper = 1, .by_default = "gearbox.friction",
        .meaning = "friction coefficient of the flanks where the output drives"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.backward_friction = number(v); },
       [](const L& l) { return if_given(l.backward_friction); }},
      {{.name = "load_friction", .lower = -1, .upper = 1, .by_default = "0",
        .meaning = "added to the friction coefficient: v (T/T_ref)^p, T at the input"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.load_friction = number(v); },
       [](const L& l) { return unless(l.load_friction, 0.0); }},
      {{.name = "load_friction_exponent", .lower = 0, .upper = 10, .by_default = "1",
        .meaning = "p of it"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.load_friction_exponent = number(v); },
       [](const L& l) { return unless(l.load_friction_exponent, 1.0); }},
      {{.name = "load_friction_reference_nm", .unit = "N m", .lower = 1e-9, .upper = 1e9,
        .by_default = "1", .meaning = "T_ref of it"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.load_friction_reference_nm = number(v); },
       [](const L& l) { return unless(l.load_friction_reference_nm, 1.0); }},
      {{.name = "mixed_friction", .lower = 0, .upper = 1, .by_default = "0",
        .meaning = "added to the friction coefficient at low speed: v exp(-(n/n0)^2)"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.mixed_friction = number(v); },
       [](const L& l) { return unless(l.mixed_friction, 0.0); }},
      {{.name = "mixed_friction_speed_rpm", .unit = "rpm", .lower = 1e-6, .upper = 1e7,
        .by_default = "100", .meaning = "n0 of it"},
       KeyPlace::kAnywhere,
       [](L& l, const KeyValue& v) { l.mixed_friction_speed_rpm = number(v); },
       [](const L& l) { return unless(l.mixed_friction_speed_rpm, L{}.mixed_friction_speed_rpm); }},
  };
  return keys;
}

}  // namespace trueflank
