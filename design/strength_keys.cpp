// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace {

using S = StrengthDesign;
using Value = std::optional<KeyValue>;

double number(const KeyValue& value) { return std::get<double>(value); }
Value unless(double value, double by_default) { return value == by_default ? Value() : Value(value); }

}  // namespace

const std::vector<DesignKey<StrengthDesign>>& strength_keys() {
  static const std::vector<DesignKey<S>> keys{
      {{.name = "reversing", .type = KeyType::kFlag, .by_default = "false for a pair, else true",
        .meaning = "the drive is loaded both ways: every tooth bends both ways and is rated at two thirds. "
                   "Otherwise only gears that are driven in one mesh and drive in another"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.reversing = std::get<bool>(v); },
       [](const S& s) { return s.reversing ? Value(*s.reversing) : Value(); }},
      {{.name = "overload_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "overload by motor and load, K_O"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.overload_factor = number(v); },
       [](const S& s) { return unless(s.overload_factor, S{}.overload_factor); }},
      {{.name = "dynamic_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "dynamic load of the teeth, K_V"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.dynamic_factor = number(v); },
       [](const S& s) { return unless(s.dynamic_factor, S{}.dynamic_factor); }},
      {{.name = "face_load_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "uneven load along the face, K_Hbeta"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.face_load_factor = number(v); },
       [](const S& s) { return unless(s.face_load_factor, S{}.face_load_factor); }},
      {{.name = "planet_load_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "the most loaded planet's share over the mean, K_gamma"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.planet_load_factor = number(v); },
       [](const S& s) { return unless(s.planet_load_factor, S{}.planet_load_factor); }},
      {{.name = "bending_life_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "of the bending limit for a life other than 1e7 cycles, K_L"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.bending_life_factor = number(v); },
       [](const S& s) { return unless(s.bending_life_factor, S{}.bending_life_factor); }},
      {{.name = "contact_life_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "of the contact limit for a life other than 1e7 cycles, K_HL"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.contact_life_factor = number(v); },
       [](const S& s) { return unless(s.contact_life_factor, S{}.contact_life_factor); }},
      {{.name = "lubrication_factor", .lower = 0.01, .upper = 100, .by_default = "1",
        .meaning = "lubricant, roughness, speed and hardness together, Z_L Z_R Z_V Z_W"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.lubrication_factor = number(v); },
       [](const S& s) { return unless(s.lubrication_factor, S{}.lubrication_factor); }},
      {{.name = "bending_safety", .lower = 0.01, .upper = 100, .by_default = "1.2",
        .meaning = "S_F"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.bending_safety = number(v); },
       [](const S& s) { return unless(s.bending_safety, S{}.bending_safety); }},
      {{.name = "contact_safety", .lower = 0.01, .upper = 100, .by_default = "1.15",
        .meaning = "S_H"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.contact_safety = number(v); },
       [](const S& s) { return unless(s.contact_safety, S{}.contact_safety); }},
  };
  return keys;
}

}  // namespace trueflank
