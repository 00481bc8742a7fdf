// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <string_view>

#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/key_values.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

using namespace key_values;

using S = StrengthDesign;

/// "1:0.2, 0.5:0.8"; one step of NaN where it is not that.
std::vector<LoadStep> read_spectrum(std::string_view text) {
  const std::vector<LoadStep> unreadable{{kNaN, kNaN}};
  std::vector<LoadStep> steps;
  const auto number_at = [&](double& value) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    while (text.starts_with(' ')) text.remove_prefix(1);
    return true;
  };
  while (true) {
    LoadStep step;
    if (!number_at(step.torque) || !text.starts_with(':')) return unreadable;
    text.remove_prefix(1);
    if (!number_at(step.share)) return unreadable;
    steps.push_back(step);
    if (text.empty()) return steps;
    if (!text.starts_with(',')) return unreadable;
    text.remove_prefix(1);
  }
}

std::string spectrum_text(const std::vector<LoadStep>& steps) {
  std::string text;
  for (const LoadStep& step : steps)
    text += (text.empty() ? "" : ", ") + toml_number(step.torque) + ":" + toml_number(step.share);
  return text;
}

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
      {{.name = "input_speed_rpm", .unit = "rpm", .lower = 0.001, .upper = 1e7, .by_default = "none",
        .meaning = "speed of the input at the rated torque: load cycles, and temperature of plastics"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.input_speed_rpm = number(v); },
       [](const S& s) { return if_given(s.input_speed_rpm); }},
      {{.name = "life_h", .unit = "h", .lower = 0.001, .upper = 1e7, .by_default = "endurance",
        .meaning = "hours at that speed: limits for so many cycles"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.life_h = number(v); },
       [](const S& s) { return if_given(s.life_h); }},
      {{.name = "ambient_c", .unit = "deg C", .lower = -60, .upper = 200, .by_default = "20",
        .meaning = "temperature round the gears, for plastics"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.ambient_c = number(v); },
       [](const S& s) { return unless(s.ambient_c, S{}.ambient_c); }},
      {{.name = "lubrication", .type = KeyType::kChoice, .choices = {"dry", "grease", "oil"}, .by_default = "grease",
        .meaning = "of plastics: friction, heat and wear follow from it"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.lubrication = std::get<std::string>(v); },
       [](const S& s) { return s.lubrication == S{}.lubrication ? Value() : Value(s.lubrication); }},
      {{.name = "spectrum", .type = KeyType::kText, .by_default = "the rated torque all the time",
        .meaning = "parts of the rated torque with their shares of all revolutions: \"1:0.2, 0.5:0.8\""},
       KeyPlace::kAnywhere,
       // the reader refuses what is no spectrum
       [](S& s, const KeyValue& v) { s.spectrum = read_spectrum(std::get<std::string>(v)); },
       [](const S& s) { return s.spectrum.empty() ? Value() : Value(spectrum_text(s.spectrum)); }},
  };
  return keys;
}

}  // namespace trueflank
