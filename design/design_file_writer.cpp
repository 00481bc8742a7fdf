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
void write_keys(std::string& text, const std::vector<DesignKey<Target>>& keys,
                const Target& target) {
  for (const DesignKey<Target>& key : keys) {
    if constexpr (std::is_same_v<Target, GearDesign>)
      if (!stands_in(key.place, target.name, target.kind)) continue;
    if (const auto value = key.get(target))
      text += std::string(key.rule.name) + " = " + toml_text(*value) + "\n";
  }
}

void write_gear(std::string& text, const GearDesign& gear) {
  text += "\n[" + gear.name + "]\n";
  write_keys(text, gear_keys(), gear);
  if (gear.cutter) {
    text += "[" + gear.name + ".cutter]\n";
    write_keys(text, cutter_keys(), *gear.cutter);
  }
  if (gear.modifications != ModificationsDesign{}) {
    text += "[" + gear.name + ".modifications]\n";
    write_keys(text, modification_keys(), gear.modifications);
  }
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

std::string design_file_text(const GearboxDesign& design, std::string_view comment) {
  std::string text = commented(comment);
  write_keys(text, file_keys(), design);
  text += "\n[gearbox]\n";
  write_keys(text, gearbox_keys(), design);
  text += "\n[rack]\n";
  write_keys(text, rack_keys(), design.rack);
  for (const GearDesign& gear : design.gears) write_gear(text, gear);
  if (design.carrier) {
    text += "\n[carrier]\n";
    write_keys(text, carrier_keys(), *design.carrier);
  }
  if (design.shafts != ShaftsDesign{}) {
    text += "\n[shafts]\n";
    write_keys(text, shafts_keys(), design.shafts);
  }
  if (design.made != MadeDesign{}) {
    text += "\n[made]\n";
    write_keys(text, made_keys(), design.made);
  }
  if (design.losses) {
    text += "\n[losses]\n";
    write_keys(text, losses_keys(), *design.losses);
  }
  return text;
}

}  // namespace trueflank
