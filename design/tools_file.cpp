// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/tools_file.h"

#include <algorithm>
#include <array>

#include "trueflank/base/units.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/reading.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

template <class Target>
struct ToolKey {
  KeyRule rule;
  void (*set)(Target&, const KeyValue&) = nullptr;
};

template <class Target>
void set_source(Target& target, const KeyValue& value) {
  target.source = std::get<std::string>(value);
}

constexpr const char* kSourceMeaning = "where the values come from";

/// Those of the design's [rack], and what only a tool has.
std::vector<ToolKey<RackTool>> rack_tool_keys() {
  std::vector<ToolKey<RackTool>> keys;
  keys.push_back({{.name = "dedendum_plus_mm", .unit = "mm", .lower = 0, .upper = 1,
                   .meaning = "added to the dedendum whatever the module"},
                  [](RackTool& t, const KeyValue& v) { t.dedendum_plus_mm = std::get<double>(v); }});
  keys.push_back({{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning},
                  set_source<RackTool>});
  return keys;
}

std::vector<ToolKey<CutterTool>> cutter_tool_keys() {
  using T = CutterTool;
  return {
      {{.name = "teeth", .type = KeyType::kWhole, .lower = 5, .upper = 500,
        .meaning = "number of teeth"},
       [](T& t, const KeyValue& v) { t.teeth = static_cast<int>(std::get<std::int64_t>(v)); }},
      {{.name = "pitch_diameter_mm", .unit = "mm", .lower = 1, .upper = 2000,
        .meaning = "instead of teeth: the nearest whole number of teeth is taken"},
       [](T& t, const KeyValue& v) { t.pitch_diameter_mm = std::get<double>(v); }},
      {{.name = "shift", .unit = "module", .lower = -10, .upper = 10, .meaning = "profile shift"},
       [](T& t, const KeyValue& v) { t.shift = std::get<double>(v); }},
      {{.name = "tip_radius", .unit = "module", .lower = 0, .upper = 3,
        .meaning = "rounding of the corners of its teeth"},
       [](T& t, const KeyValue& v) { t.tip_radius = std::get<double>(v); }},
      {{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning}, set_source<T>}};
}

template <double Process::*Member>
ToolKey<Process> process_key(const char* name, const char* meaning, double lower = 0.0) {
  return {{.name = name, .unit = "mm", .lower = lower, .upper = 100, .meaning = meaning},
          [](Process& p, const KeyValue& v) { p.*Member = std::get<double>(v); }};
}

std::vector<ToolKey<Process>> process_keys() {
  return {
      process_key<&Process::nozzle_mm>("nozzle_mm", "width of a bead, spot or pixel"),
      process_key<&Process::layer_mm>("layer_mm", "layer height"),
      process_key<&Process::least_wall_mm>("least_wall_mm", "thinnest wall: rims, bore to root"),
      process_key<&Process::least_tip_mm>("least_tip_mm", "thinnest tooth tip"),
      process_key<&Process::least_gap_mm>("least_gap_mm", "narrowest gap between two teeth"),
      process_key<&Process::least_root_radius_mm>("least_root_radius_mm",
                                                  "smallest radius of a concave corner"),
      process_key<&Process::backlash_mm>("backlash_mm", "least backlash of a mesh, circumferential"),
      process_key<&Process::horizontal_expansion_mm>(
          "horizontal_expansion_mm", "how far every wall comes out too far outwards", -10.0),
      process_key<&Process::elephant_foot_mm>("elephant_foot_mm",
                                              "how far the first layers spread at the bed"),
      process_key<&Process::elephant_foot_height_mm>("elephant_foot_height_mm",
                                                     "height over which they spread"),
      process_key<&Process::kerf_mm>("kerf_mm", "width of a wire's or beam's cut"),
      process_key<&Process::ledge_mm>("ledge_mm", "how far a flat underside stands out without support; 0: any"),
      process_key<&Process::bridge_mm>("bridge_mm", "how much it spans without support; 0: any"),
      {{.name = "overhang_deg", .unit = "deg", .lower = 0, .upper = 90,
        .meaning = "how far a slanted underside leans from the vertical without support; 0: any"},
       [](Process& p, const KeyValue& v) { p.overhang_rad = rad_from_deg(std::get<double>(v)); }},
      {{.name = "tolerance_class", .type = KeyType::kWhole, .lower = 0, .upper = 11,
        .meaning = "class of ISO 1328-1 that its gears keep; 0: none"},
       [](Process& p, const KeyValue& v) { p.tolerance_class = static_cast<int>(std::get<std::int64_t>(v)); }},
      process_key<&Process::axis_tolerance_mm>("axis_tolerance_mm", "plus or minus, of the distance of two axes"),
      process_key<&Process::thickness_tolerance_mm>("thickness_tolerance_mm",
                                                    "plus or minus, of teeth on the reference circle"),
      process_key<&Process::runout_mm>("runout_mm", "of every gear, where no class says it"),
      {{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning}, set_source<Process>}};
}

template <auto Member, class Element>
ToolKey<Element> element_key(const char* name, const char* meaning) {
  return {{.name = name, .unit = "mm", .lower = 0, .upper = 1e6, .meaning = meaning},
          [](Element& e, const KeyValue& v) { e.*Member = std::get<double>(v); }};
}

std::vector<ToolKey<Motor>> motor_tool_keys() {
  std::vector<ToolKey<Motor>> keys;
  for (const DesignKey<Motor>& key : motor_keys())
    if (std::string_view(key.rule.name) != "name") keys.push_back({key.rule, key.set});
  keys.push_back({{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning}, set_source<Motor>});
  return keys;
}

std::vector<ToolKey<Bearing>> bearing_tool_keys() {
  using B = Bearing;
  return {element_key<&B::bore_mm, B>("bore_mm", "bore"),
          element_key<&B::outer_mm, B>("outer_mm", "outer diameter"),
          element_key<&B::width_mm, B>("width_mm", "width"),
          element_key<&B::dynamic_n, B>("dynamic_n", "dynamic load rating C [N]"),
          element_key<&B::static_n, B>("static_n", "static load rating C0 [N]"),
          {{.name = "kind",
            .type = KeyType::kChoice,
            .choices = {"balls", "crossed-rollers"},
            .meaning = "what rolls in it"},
           [](B& b, const KeyValue& v) {
             b.kind = std::get<std::string>(v) == "balls" ? BearingKind::kBalls
                                                          : BearingKind::kCrossedRollers;
           }},
          {{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning}, set_source<B>}};
}

std::vector<ToolKey<Screw>> screw_tool_keys() {
  using S = Screw;
  return {element_key<&S::diameter_mm, S>("diameter_mm", "diameter of the thread"),
          element_key<&S::head_diameter_mm, S>("head_diameter_mm", "diameter of the head"),
          element_key<&S::head_height_mm, S>("head_height_mm", "height of the head"),
          element_key<&S::hex_mm, S>("hex_mm", "width of the key"),
          element_key<&S::hole_mm, S>("hole_mm", "clearance hole"),
          element_key<&S::insert_hole_mm, S>("insert_hole_mm", "hole for the insert"),
          element_key<&S::insert_length_mm, S>("insert_length_mm", "length of the insert"),
          element_key<&S::nut_height_mm, S>("nut_height_mm", "height of the nut"),
          element_key<&S::longest_mm, S>("longest_mm", "the longest that is stocked"),
          {{.name = "source", .type = KeyType::kText, .meaning = kSourceMeaning}, set_source<S>}};
}

constexpr std::array<const char*, 6> kTables{"rack", "cutter", "process", "motor", "bearing", "screw"};

class ToolsReader {
 public:
  explicit ToolsReader(const TomlDocument& document) : root_(document.root) {
    reading_.add_all(root_);
    for (const Error& error : document.errors) reading_.report(error);
  }

  ResultAll<ToolTables> read(const std::string& file, ToolTables tools) {
    for (const TomlEntry& kind : root_.entries) {
      const auto is = [&](const char* name) { return kind.key == name; };
      if (std::none_of(kTables.begin(), kTables.end(), is)) {
        reading_.unknown(kind.key, "unknown table",
                         "[rack.NAME], [cutter.NAME], [process.NAME], [motor.NAME], [bearing.NAME] or "
                         "[screw.NAME]");
        continue;
      }
      const TomlTable* named = table_of(kind, kind.key);
      if (!named) continue;
      for (const TomlEntry& entry : named->entries) read_tool(kind.key, entry, tools);
    }
    if (!reading_.clean()) return fail_all(reading_.errors(file));
    return tools;
  }

 private:
  const TomlTable* table_of(const TomlEntry& entry, const std::string& key) {
    const auto* table = std::get_if<TomlTable>(&entry.value);
    if (!table && reading_.good(key))
      reading_.report({.code = ErrorCode::kWrongType,
                       .message = "not a table",
                       .key = key,
                       .remedy = "a table: the line [" + key + "] and its keys below"});
    return table;
  }

  void read_tool(const std::string& kind, const TomlEntry& entry, ToolTables& tools) {
    const std::string key = kind + "." + entry.key;
    const TomlTable* table = table_of(entry, key);
    if (!table) return;
    if (kind == "rack") {
      RackTool tool{.name = entry.key, .rack = {}, .dedendum_plus_mm = 0.0};
      read_rack(key, *table, tool);
      replace(tools.racks, std::move(tool));
    } else if (kind == "cutter") {
      CutterTool tool{.name = entry.key};
      read_keys(key, *table, cutter_tool_keys(), tool);
      if (reading_.has(key + ".teeth") == reading_.has(key + ".pitch_diameter_mm"))
        reading_.contradiction(key, "a cutter has either teeth or a pitch diameter",
                               "teeth or pitch_diameter_mm");
      replace(tools.cutters, std::move(tool));
    } else if (kind == "motor") {
      read_element(key, entry.key, *table, motor_tool_keys(), tools.elements.motors);
    } else if (kind == "bearing") {
      read_element(key, entry.key, *table, bearing_tool_keys(), tools.elements.bearings);
    } else if (kind == "screw") {
      read_element(key, entry.key, *table, screw_tool_keys(), tools.elements.screws);
    } else {
      Process process{.name = entry.key};
      if (const Process* known = tools.processes.find(entry.key)) process = *known;
      read_keys(key, *table, process_keys(), process);
      tools.processes.set(std::move(process));
    }
  }

  /// An element of a name that is known keeps what the file does not say.
  template <class Element>
  void read_element(const std::string& section, const std::string& name, const TomlTable& table,
                    const std::vector<ToolKey<Element>>& keys, std::vector<Element>& elements) {
    const Element* known = find_element(elements, name);
    Element element = known ? *known : Element{.name = name};
    read_keys(section, table, keys, element);
    replace(elements, std::move(element));
  }

  void read_rack(const std::string& section, const TomlTable& table, RackTool& tool) {
    const auto& basic = rack_keys();
    for (const TomlEntry& entry : table.entries) {
      const auto it = std::find_if(basic.begin(), basic.end(), [&](const auto& key) {
        return entry.key == key.rule.name && key.get(BasicRack{.protuberance = 0.1,
                                                               .grinding_stock = 0.05});
      });
      if (it == basic.end()) {
        read_entry(section, entry, rack_tool_keys(), tool);
        continue;
      }
      if (const auto value = taken(it->rule, section + "." + entry.key, entry))
        it->set(tool.rack, *value);
    }
  }

  std::optional<KeyValue> taken(const KeyRule& rule, const std::string& key,
                                const TomlEntry& entry) {
    if (!reading_.good(key)) return std::nullopt;
    auto value = take_value(rule, key, entry.value);
    if (value) return *value;
    reading_.report(value.error());
    return std::nullopt;
  }

  template <class Target>
  void read_keys(const std::string& section, const TomlTable& table,
                 const std::vector<ToolKey<Target>>& keys, Target& target) {
    for (const TomlEntry& entry : table.entries) read_entry(section, entry, keys, target);
  }

  template <class Target>
  void read_entry(const std::string& section, const TomlEntry& entry,
                  const std::vector<ToolKey<Target>>& keys, Target& target) {
    const std::string dotted = section + "." + entry.key;
    std::vector<std::string> known;
    for (const ToolKey<Target>& key : keys) {
      if (entry.key == key.rule.name) {
        if (const auto value = taken(key.rule, dotted, entry)) key.set(target, *value);
        return;
      }
      known.emplace_back(key.rule.name);
    }
    const std::string near = nearest_name(entry.key, known);
    reading_.unknown(dotted, near.empty() ? "unknown key" : "unknown key; did you mean " + near + "?",
                     "the keys of docs/made.md and docs/gearbox.md");
  }

  template <class Tool>
  static void replace(std::vector<Tool>& tools, Tool tool) {
    const auto it = std::find_if(tools.begin(), tools.end(),
                                 [&](const Tool& t) { return t.name == tool.name; });
    if (it != tools.end())
      *it = std::move(tool);
    else
      tools.push_back(std::move(tool));
  }

  const TomlTable& root_;
  Reading reading_;
};

template <class Target>
std::vector<KeyRule> rules_of(const std::vector<ToolKey<Target>>& keys) {
  std::vector<KeyRule> rules;
  for (const auto& key : keys) rules.push_back(key.rule);
  return rules;
}

}  // namespace

ResultAll<ToolTables> read_tools_text(std::string_view text, const std::string& file,
                                      ToolTables tools) {
  TomlDocument document = parse_toml(text);
  if (document.whole) return ToolsReader(document).read(file, std::move(tools));
  for (Error& error : document.errors) error.file = file;
  return fail_all(std::move(document.errors));
}

ResultAll<ToolTables> read_tools(const std::string& path, ToolTables tools) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  return read_tools_text(*text, path, std::move(tools));
}

std::vector<KeyRule> tool_key_rules(std::string_view kind) {
  if (kind == "rack") return rules_of(rack_tool_keys());
  if (kind == "cutter") return rules_of(cutter_tool_keys());
  if (kind == "motor") return rules_of(motor_tool_keys());
  if (kind == "bearing") return rules_of(bearing_tool_keys());
  if (kind == "screw") return rules_of(screw_tool_keys());
  return rules_of(process_keys());
}

}  // namespace trueflank
