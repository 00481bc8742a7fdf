// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_file_writer.h"

#include <algorithm>
#include <type_traits>

#include "trueflank/design/design_keys.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

std::string toml_text(const KeyValue& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using V = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<V, bool>) return v ? "true" : "false";
        if constexpr (std::is_same_v<V, std::int64_t>) return std::to_string(v);
        if constexpr (std::is_same_v<V, double>) return toml_number(v);
        if constexpr (std::is_same_v<V, std::string>) return toml_string(v);
      },
      value);
}

template <class Target>
void write_keys(std::vector<WrittenKey>& all, const std::string& table,
                const std::vector<DesignKey<Target>>& keys, const Target& target) {
  for (const DesignKey<Target>& key : keys) {
    if constexpr (std::is_same_v<Target, GearDesign>)
      if (!stands_in(key.place, target.name, target.kind)) continue;
    if (const auto value = key.get(target)) all.push_back({table, key.rule.name, toml_text(*value)});
  }
}

void write_gear(std::vector<WrittenKey>& all, const GearDesign& gear) {
  write_keys(all, gear.name, gear_keys(), gear);
  if (gear.cutter) write_keys(all, gear.name + ".cutter", cutter_keys(), *gear.cutter);
  if (gear.modifications != ModificationsDesign{})
    write_keys(all, gear.name + ".modifications", modification_keys(), gear.modifications);
}

std::string commented(std::string_view comment) {
  std::string text;
  while (!comment.empty()) {
    const auto end = std::min(comment.find('\n'), comment.size());
    const std::string_view line = comment.substr(0, end);
    text += line.empty() ? "#\n" : "# " + std::string(line) + "\n";
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return text;
}

}  // namespace

std::vector<WrittenKey> written_keys(const GearboxDesign& design) {
  std::vector<WrittenKey> all;
  write_keys(all, "", file_keys(), design);
  write_keys(all, "gearbox", gearbox_keys(), design);
  for (std::size_t i = 0; i < design.later_stages.size(); ++i)
    write_keys(all, "stage" + std::to_string(i + 2), stage_keys(), design.later_stages[i]);
  write_keys(all, "rack", rack_keys(), design.rack);
  for (const GearDesign& gear : design.gears) write_gear(all, gear);
  if (design.carrier) write_keys(all, "carrier", carrier_keys(), *design.carrier);
  if (design.machine) {
    const MachineDesign& machine = *design.machine;
    write_keys(all, "motor", motor_keys(), machine.motor);
    write_keys(all, "housing", housing_keys(), machine.housing);
    write_keys(all, "output", output_keys(), machine.output);
    write_keys(all, "bearings", bearings_keys(), machine.bearings);
    write_keys(all, "fasteners", fasteners_keys(), machine.fasteners);
  }
  if (design.shafts != ShaftsDesign{}) write_keys(all, "shafts", shafts_keys(), design.shafts);
  if (design.made != MadeDesign{}) write_keys(all, "made", made_keys(), design.made);
  if (design.losses) write_keys(all, "losses", losses_keys(), *design.losses);
  if (design.strength != StrengthDesign{})
    write_keys(all, "strength", strength_keys(), design.strength);
  return all;
}

std::string design_file_text(const GearboxDesign& design, std::string_view comment) {
  std::string text = commented(comment), table;
  for (const WrittenKey& key : written_keys(design)) {
    if (key.table != table) {
      table = key.table;
      // a gear's own tables follow it closely
      text += (table.find('.') == std::string::npos ? "\n[" : "[") + table + "]\n";
    }
    text += key.key + " = " + key.value + "\n";
  }
  return text;
}

}  // namespace trueflank
