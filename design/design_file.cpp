// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_file.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/design/contradictions.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/inch_keys.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/design/reading.h"
#include "trueflank/design/toml_document.h"
#include "trueflank/train/machine/bed.h"

namespace trueflank {
namespace {

std::vector<std::string> all_gear_names() {
  std::vector<std::string> names;
  for (const TrainKind& kind : train_kinds())
    for (const TopologyGear& gear : train_topology(kind.name).gears)
      if (std::find(names.begin(), names.end(), gear.name) == names.end()) names.push_back(gear.name);
  return names;
}

template <class Target>
std::vector<std::string> key_names(const std::vector<DesignKey<Target>>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.emplace_back(key.rule.name);
  return names;
}

/// Where else a key is known: "[gearbox]", "a gear's table", ...; empty where nowhere.
std::string place_of(std::string_view name) {
  const auto in = [&](const auto& keys) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const auto& key) { return name == key.rule.name; });
  };
  if (in(file_keys())) return "the top of the file";
  if (in(gearbox_keys())) return "[gearbox]";
  if (in(rack_keys())) return "[rack]";
  if (in(stage_keys())) return "[stage2]";
  if (in(carrier_keys())) return "[carrier]";
  if (in(shafts_keys())) return "[shafts]";
  if (in(housing_keys())) return "[housing]";
  if (in(bearings_keys())) return "[bearings]";
  if (in(made_keys())) return "[made]";
  if (in(losses_keys())) return "[losses]";
  if (in(strength_keys())) return "[strength]";
  if (in(gear_keys()) || name == "modifications") return "a gear's table";
  if (in(modification_keys())) return "a gear's [modifications]";
  if (in(cutter_keys()) || name == "cutter") return "a ring's [cutter]";
  return "";
}

/// Of all kinds.
constexpr int kMostStages = 2;

class DesignReader {
 public:
  explicit DesignReader(TomlDocument& document)
      : inches_(to_metric(document.root)), root_(document.root), syntax_errors_(document.errors) {}

  ResultAll<DesignFile> read(const std::string& file) {
    reading_.add_all(root_);
    for (const InchKey& key : inches_) reading_.add_inches(key);
    for (const Error& error : syntax_errors_) reading_.report(error);
    read_tool_tables(file);
    read_top();
    if (const TomlTable* table = section("gearbox")) read_gearbox(*table);
    read_stages();
    if (const TomlTable* table = section("rack")) read_rack(*table);
    read_gears();
    read_carrier();
    read_machine();
    if (const TomlTable* table = section("shafts"))
      read_keys("shafts", *table, shafts_keys(), file_.design.shafts);
    if (const TomlTable* table = section("made")) read_made(*table);
    read_losses();
    if (const TomlTable* table = section("strength"))
      read_strength(*table);
    settle_module();
    settle_tools();
    settle_bores();
    report_contradictions(file_.design, kind_known_, reading_);
    if (!reading_.clean() || !tools_errors_.empty()) {
      Errors errors = reading_.clean() ? Errors{} : reading_.errors(file);
      errors.insert(errors.end(), tools_errors_.begin(), tools_errors_.end());
      return fail_all(std::move(errors));
    }
    file_.file = file;
    for (const auto& [key, found] : reading_.found()) file_.lines[key] = found.line;
    if (file_.design.name.empty())
      file_.design.name = design_name_from(std::filesystem::path(file).stem().string());
    return std::move(file_);
  }

 private:
  void read_top() {
    std::vector<std::string> known = all_gear_names();
    known.insert(known.end(), {"gearbox", "stage2", "rack", "carrier", "shafts", "made", "losses", "strength", "motor", "housing",
                              "output", "bearings", "fasteners"});
    for (const TomlEntry& entry : root_.entries) {
      const auto is = [&](const std::string& name) { return name == entry.key; };
      if (std::any_of(known.begin(), known.end(), is)) {
        if (!std::holds_alternative<TomlTable>(entry.value)) report_no_table(entry.key);
      } else {
        read_entry("", entry, file_keys(), file_.design, known);
      }
    }
    report_missing("", file_keys(), [](KeyPlace) { return true; });
    if (!root_.find("gearbox"))
      reading_.missing("gearbox", "the table is missing",
                       "[gearbox] with kind, module_mm, ...");
  }

  void report_no_table(const std::string& key) {
    if (!reading_.good(key)) return;  // unreadable: reported already
    reading_.report({.code = ErrorCode::kWrongType,
                     .message = "not a table",
                     .key = key,
                     .remedy = "a table: the line [" + key + "] and its keys below"});
  }

  const TomlTable* section(const std::string& name) const {
    const TomlEntry* entry = root_.find(name);
    return entry ? std::get_if<TomlTable>(&entry->value) : nullptr;
  }

  void read_gearbox(const TomlTable& table) {
    GearboxDesign& design = file_.design;
    read_keys("gearbox", table, gearbox_keys(), design);
    kind_known_ = reading_.good("gearbox.kind");
    const TrainKind* kind = kind_known_ ? find_train_kind(*name_in(table, "kind")) : nullptr;
    if (kind) design.topology = topology_of(*kind, table);
    report_missing("gearbox", gearbox_keys(), [&](KeyPlace place) {
      if (place == KeyPlace::kPlanetary) return kind_known_ && design.topology.has_planets();
      if (place == KeyPlace::kOutput) return kind && kind->output_required;
      return place != KeyPlace::kUnlessEveryGear;
    });
  }

  /// [stage2] and so on, as many as the kind has.
  void read_stages() {
    const int stages = kind_known_ ? file_.design.topology.stage_count() : kMostStages;
    for (int number = 2; number <= kMostStages; ++number) {
      const std::string name = "stage" + std::to_string(number);
      const TomlTable* table = section(name);
      if (number > stages) {
        if (root_.find(name))
          reading_.contradiction(name, "kind \"" + file_.design.topology.kind + "\" has one stage", "no such table");
        continue;
      }
      if (!table && !kind_known_) continue;
      StageDesign& stage = file_.design.later_stages.emplace_back();
      if (table) {
        read_keys(name, *table, stage_keys(), stage);
        report_missing(name, stage_keys(), [](KeyPlace) { return true; });
      } else if (!root_.find(name)) {
        reading_.report({.code = ErrorCode::kMissingKey,
                         .message = "the table is missing",
                         .key = name,
                         .remedy = "[" + name + "] with planets = 3 and, where it is not the gearbox's, module_mm",
                         .line = reading_.line("gearbox.kind")});
      }
    }
  }

  /// The topology of a kind with the output the file names; with the usual one where that does not fit.
  Topology topology_of(const TrainKind& kind, const TomlTable& table) {
    const auto asked = [&](const char* name, const std::vector<std::string>& choices) -> std::string_view {
      const std::string key = std::string("gearbox.") + name;
      const std::string* text = reading_.good(key) ? name_in(table, name) : nullptr;
      if (!text) return {};
      if (std::find(choices.begin(), choices.end(), *text) != choices.end()) return *text;
      std::string list;
      for (const std::string& choice : choices)
        list += (list.empty() ? "\"" : " or \"") + choice + '"';
      reading_.contradiction(key, "does not fit kind \"" + std::string(kind.name) + "\"",
                             list.empty() ? std::string("no such key: a single gear has no ") + name : list);
      return {};
    };
    Topology topology = train_topology(kind.name, asked("output", kind.outputs), asked("input", kind.inputs));
    for (int gear = static_cast<int>(topology.gears.size()) - 1; gear >= 0; --gear)
      if (const TopologyGear& own = topology.gears[static_cast<std::size_t>(gear)];
          own.optional && !root_.find(own.name))
        topology = without_gear(topology, gear);
    return topology;
  }

  /// The user's own tools; a relative path starts at the design file.
  void read_tool_tables(const std::string& file) {
    const TomlEntry* entry = root_.find("tools");
    const auto* name = entry ? std::get_if<std::string>(&entry->value) : nullptr;
    if (!name || name->empty()) return;
    auto tools = read_tools((std::filesystem::path(file).parent_path() / *name).string());
    if (tools)
      file_.tools = std::move(*tools);
    else
      tools_errors_ = std::move(tools.error());
  }

  /// The text of a key that names something; nothing where it is no text.
  static const std::string* name_in(const TomlTable& table, const char* key) {
    const TomlEntry* entry = table.find(key);
    return entry ? std::get_if<std::string>(&entry->value) : nullptr;
  }

  void report_unknown_name(const std::string& key, const std::string& name, const char* what,
                           const std::vector<std::string>& known) {
    if (!tools_errors_.empty()) return;  // it may be in the file that could not be read
    const std::string near = nearest_name(name, known);
    reading_.report({.code = ErrorCode::kOutOfRange,
                     .message = std::string("no ") + what + " of this name" +
                                (near.empty() ? "" : "; did you mean " + near + "?"),
                     .key = key,
                     .remedy = joined(known)});
  }

  void read_rack(const TomlTable& table) {
    if (const std::string* name = name_in(table, "profile")) {
      rack_tool_ = find_rack(file_.tools, *name);
      if (rack_tool_)
        file_.design.rack = rack_tool_->rack;
      else
        report_unknown_name("rack.profile", *name, "rack", names_of(file_.tools.racks));
    }
    read_keys("rack", table, rack_keys(), file_.design.rack);
  }

  void read_strength(const TomlTable& table) {
    StrengthDesign& strength = file_.design.strength;
    read_keys("strength", table, strength_keys(), strength);
    double shares = 0.0;
    bool good = true;
    for (const LoadStep& step : strength.spectrum) {
      good = good && step.torque > 0.0 && step.torque <= 100.0 && step.share > 0.0;
      shares += step.share;
    }
    if (strength.spectrum.empty() || (good && std::abs(shares - 1.0) < 1e-6)) return;
    reading_.report({.code = ErrorCode::kOutOfRange,
                     .message = good ? "the shares do not add up to 1" : "no load spectrum",
                     .key = "strength.spectrum",
                     .remedy = "torque:share pairs, torques above 0 as parts of the rated one, shares that add up to 1: "
                               "\"1:0.2, 0.5:0.8\""});
  }

  void read_made(const TomlTable& table) {
    MadeDesign& made = file_.design.made;
    read_keys("made", table, made_keys(), made);
    if (!made.bed.empty() && !find_bed(made.bed))
      report_unknown_name("made.bed", made.bed, "bed", known_beds());
    if (!made.process) return;
    if (const Process* process = file_.tools.processes.find(made.process->name))
      made.process = *process;
    else
      report_unknown_name("made.process", made.process->name, "process",
                          names_of(file_.tools.processes));
  }

  /// Tools that depend on the module: it is known only now.
  void settle_tools() {
    GearboxDesign& design = file_.design;
    if (rack_tool_ && rack_tool_->dedendum_plus_mm != 0.0 && !reading_.has("rack.dedendum")) {
      const double m = design.gears.empty() ? design.module_mm : module_of(design, design.gears[0]);
      design.rack.dedendum = rack_tool_->at_module(m).dedendum;
      for (const GearDesign& gear : design.gears)
        if (module_of(design, gear) != m)
          return reading_.contradiction(
              "rack.profile", "its depth depends on the module, and the gears have several",
              "another rack, or a dedendum");
    }
    for (GearDesign& gear : design.gears) {
      const auto named = cutter_tools_.find(gear.name);
      if (named == cutter_tools_.end() || !gear.cutter) continue;
      const ShaperCutter cutter = named->second->at_module(module_of(design, gear));
      const std::string key = gear.name + ".cutter.";
      if (!reading_.has(key + "teeth")) gear.cutter->teeth = cutter.teeth;
      if (!reading_.has(key + "shift")) gear.cutter->shift = cutter.shift;
      if (!reading_.has(key + "tip_radius")) gear.cutter->tip_radius = cutter.tip_radius;
    }
  }

  /// The gearbox's module may be missing where every gear has its own.
  void settle_module() {
    const std::vector<GearDesign>& gears = file_.design.gears;
    if (!section("gearbox") || reading_.has("gearbox.module_mm")) return;
    const auto has_own = [&](const GearDesign& g) { return reading_.has(g.name + ".module_mm"); };
    if (gears.empty() || !std::all_of(gears.begin(), gears.end(), has_own))
      reading_.missing("gearbox.module_mm", "missing",
                       "the module of the gears that do not set their own");
    else
      file_.design.module_mm = gears.front().module_mm.value_or(1.0);
  }

  /// Gears of the kind; of any kind where the kind is not known.
  void read_gears() {
    const std::vector<std::string> all = all_gear_names();
    std::vector<std::string> own;
    for (const TopologyGear& gear : file_.design.topology.gears) own.push_back(gear.name);
    if (!kind_known_) own = all;
    for (const std::string& name : own) {
      if (const TomlTable* table = section(name)) {
        file_.design.gears.push_back(read_gear(name, *table));
      } else if (kind_known_ && !root_.find(name)) {
        const std::string& kind = file_.design.topology.kind;
        reading_.report({.code = ErrorCode::kMissingKey,
                         .message = "the table is missing",
                         .key = name,
                         .remedy = "kind \"" + kind + "\" has the gears " + joined(own),
                         .line = reading_.line("gearbox.kind")});
      }
    }
    for (const std::string& name : all)
      if (root_.find(name) && std::find(own.begin(), own.end(), name) == own.end())
        reading_.contradiction(
            name, "kind \"" + file_.design.topology.kind + "\" has no such gear",
            "the gears " + joined(own));
  }

  void read_carrier() {
    const TomlTable* table = section("carrier");
    if (!table) return;
    read_keys("carrier", *table, carrier_keys(), file_.design.carrier.emplace());
    report_missing("carrier", carrier_keys(), [](KeyPlace) { return true; });
  }

  /// What [housing] makes of the gears.
  void read_machine() {
    const TomlTable* housing = section("housing");
    for (const char* name : {"motor", "output", "bearings", "fasteners"})
      if (!housing && root_.find(name))
        reading_.contradiction(name, "belongs to a gearbox, and the table [housing] is missing",
                               "a line [housing]; it may stand alone");
    if (!housing) return;
    MachineDesign& machine = file_.design.machine.emplace();
    read_keys("housing", *housing, housing_keys(), machine.housing);
    if (const TomlTable* table = section("motor")) read_motor(*table, machine.motor);
    if (const TomlTable* table = section("output"))
      read_keys("output", *table, output_keys(), machine.output);
    if (const TomlTable* table = section("bearings"))
      read_keys("bearings", *table, bearings_keys(), machine.bearings);
    report_missing("bearings", bearings_keys(), [](KeyPlace) { return true; });
    FastenersDesign& fasteners = machine.fasteners;
    fasteners.housing.name = fasteners.carrier.name = fasteners.output.name = "M3";
    if (const TomlTable* table = section("fasteners"))
      read_keys("fasteners", *table, fasteners_keys(), fasteners);
    const MachineElements& elements = file_.tools.elements;
    fasteners.motor.name = machine.motor.screw;
    take_element("motor.screw", "screw", elements.screws, fasteners.motor);
    take_element("fasteners.housing", "screw", elements.screws, fasteners.housing);
    take_element("fasteners.carrier", "screw", elements.screws, fasteners.carrier);
    take_element("fasteners.output", "screw", elements.screws, fasteners.output);
    if (!machine.bearings.output.name.empty())
      take_element("bearings.output", "bearing", elements.bearings, machine.bearings.output);
    if (machine.bearings.planet)
      take_element("bearings.planet", "bearing", elements.bearings, *machine.bearings.planet);
    if (machine.bearings.wheel)
      take_element("bearings.wheel", "bearing", elements.bearings, *machine.bearings.wheel);
  }

  void read_motor(const TomlTable& table, Motor& motor) {
    if (const std::string* name = name_in(table, "name")) {
      motor.name = *name;
      take_element("motor.name", "motor", file_.tools.elements.motors, motor);
    }
    read_keys("motor", table, motor_keys(), motor);
  }

  /// Puts the element of its name in its place.
  template <class Element>
  void take_element(const std::string& key, const char* what, const std::vector<Element>& known,
                    Element& element) {
    if (const Element* found = find_element(known, element.name)) {
      element = *found;
      return;
    }
    std::vector<std::string> names;
    for (const Element& other : known) names.push_back(other.name);
    report_unknown_name(key, element.name, what, names);
  }

  /// Bores that follow from what is bought: the shaft's in what it drives, the bearing's in the planets.
  void settle_bores() {
    GearboxDesign& design = file_.design;
    if (!design.machine || !kind_known_) return;
    const MachineDesign& machine = *design.machine;
    for (std::size_t i = 0; i < design.gears.size(); ++i) {
      GearDesign& gear = design.gears[i];
      if (gear.bore.diameter_mm > 0.0 || reading_.has(gear.name + ".bore_mm")) continue;
      if (gear.name == design.topology.name_of(design.topology.input))
        gear.bore = shaft_bore(machine);
      else if (machine.bearings.planet && planet_with_bore(design) == &gear)
        gear.bore.diameter_mm = bore_between(*machine.bearings.planet);
    }
  }

  void read_losses() {
    const TomlTable* table = section("losses");
    if (!table) return;
    read_keys("losses", *table, losses_keys(), file_.design.losses.emplace());
    report_missing("losses", losses_keys(), [](KeyPlace) { return true; });
  }

  GearDesign read_gear(const std::string& name, const TomlTable& table) {
    GearDesign gear{.name = name, .kind = usual_kind(name)};
    if (const TomlEntry* internal = table.find("internal"); internal && may_be_ring(name))
      if (const bool* ring = std::get_if<bool>(&internal->value); ring && *ring)
        gear.kind = GearKind::kInternal;
    const GearKind kind = gear.kind;
    for (const TomlEntry& entry : table.entries) {
      if (entry.key == "cutter")
        read_cutter(gear, entry);
      else if (entry.key == "modifications")
        read_modifications(gear, entry);
      else
        read_entry(name, entry, gear_keys(), gear, {"cutter", "modifications"}, kind);
    }
    report_missing(name, gear_keys(), [&](KeyPlace place) { return stands_in(place, name, kind); });
    return gear;
  }

  void read_cutter(GearDesign& gear, const TomlEntry& entry) {
    const std::string key = gear.name + ".cutter";
    if (gear.kind == GearKind::kExternal) {
      reading_.contradiction(key, gear.name + " is an external gear: no pinion cutter shapes it",
                             "no such table");
    } else if (const auto* table = std::get_if<TomlTable>(&entry.value)) {
      gear.cutter = ShaperCutter{};
      read_keys(key, *table, cutter_keys(), *gear.cutter);
      name_cutter(key, *table, gear.name);
    } else {
      report_no_table(key);
    }
  }

  void name_cutter(const std::string& key, const TomlTable& table, const std::string& gear) {
    if (const std::string* name = name_in(table, "name")) {
      const CutterTool* tool = find_cutter(file_.tools, *name);
      if (tool)
        cutter_tools_[gear] = tool;
      else
        report_unknown_name(key + ".name", *name, "cutter", names_of(file_.tools.cutters));
    } else if (!reading_.has(key + ".teeth") && !reading_.has(key + ".name")) {
      for (const auto& cutter_key : cutter_keys())
        if (std::string_view(cutter_key.rule.name) == "teeth")
          reading_.missing(key + ".teeth", "missing", wanted(cutter_key.rule) + ", or name");
    }
  }

  void read_modifications(GearDesign& gear, const TomlEntry& entry) {
    const std::string key = gear.name + ".modifications";
    if (const auto* table = std::get_if<TomlTable>(&entry.value))
      read_keys(key, *table, modification_keys(), gear.modifications);
    else
      report_no_table(key);
  }

  template <class Target>
  void read_keys(const std::string& section, const TomlTable& table,
                 const std::vector<DesignKey<Target>>& keys, Target& target) {
    for (const TomlEntry& entry : table.entries) read_entry(section, entry, keys, target, {});
  }

  template <class Target>
  void read_entry(const std::string& section, const TomlEntry& entry,
                  const std::vector<DesignKey<Target>>& keys, Target& target,
                  const std::vector<std::string>& also_known,
                  GearKind kind = GearKind::kExternal) {
    const std::string dotted = section.empty() ? entry.key : section + "." + entry.key;
    const DesignKey<Target>* misplaced = nullptr;
    for (const DesignKey<Target>& key : keys) {
      if (entry.key != key.rule.name) continue;
      if (!fits_gear(key, section, kind)) {
        misplaced = &key;
        continue;
      }
      if (!reading_.good(dotted)) return;  // unreadable: reported already
      if (const auto value = take_value(key.rule, dotted, entry.value))
        key.set(target, *value);
      else
        reading_.report(value.error());
      return;
    }
    if (misplaced)
      report_misplaced(dotted, section, misplaced->place);
    else
      report_unknown(dotted, entry.key, key_names(keys), also_known);
  }

  template <class Target>
  static bool fits_gear(const DesignKey<Target>& key, const std::string& section, GearKind kind) {
    if constexpr (std::is_same_v<Target, GearDesign>) return stands_in(key.place, section, kind);
    return true;
  }

  void report_misplaced(const std::string& dotted, const std::string& gear, KeyPlace place) {
    if (place == KeyPlace::kMaybeRing)
      reading_.contradiction(dotted, "not for " + gear,
                             "nothing here: only a wheel or a single gear may be internal");
    else if (place == KeyPlace::kRing)
      reading_.contradiction(dotted, "for rings only, and " + gear + " is an external gear",
                             may_be_ring(gear) ? "internal = true, or no such key"
                                               : "no such key here");
    else
      reading_.contradiction(dotted, "for external gears only, and " + gear + " is a ring",
                             "no such key here");
  }

  void report_unknown(const std::string& dotted, const std::string& name,
                      std::vector<std::string> known, const std::vector<std::string>& also_known) {
    if (reading_.full()) return reading_.unknown(dotted, "", "");
    known.insert(known.end(), also_known.begin(), also_known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());  // a key that differs between gears and rings
    const std::string place = place_of(name), near = nearest_name(name, known);
    if (!place.empty())
      reading_.unknown(dotted, "unknown key here; it belongs to " + place, "");
    else if (!near.empty())
      reading_.unknown(dotted, "unknown key; did you mean " + near + "?", "");
    else
      reading_.unknown(dotted, "unknown key", joined(known));
  }

  template <class Target, class Applies>
  void report_missing(const std::string& section, const std::vector<DesignKey<Target>>& keys,
                      Applies applies) {
    const std::string prefix = section.empty() ? "" : section + ".";
    for (const DesignKey<Target>& key : keys)
      if (key.rule.required && applies(key.place) && !reading_.has(prefix + key.rule.name))
        reading_.missing(prefix + key.rule.name, "missing",
                         wanted(key.rule));
  }

  std::vector<InchKey> inches_;
  const TomlTable& root_;
  const Errors& syntax_errors_;
  Reading reading_;
  DesignFile file_;
  Errors tools_errors_;  ///< of the tools file
  const RackTool* rack_tool_ = nullptr;
  std::map<std::string, const CutterTool*> cutter_tools_;  ///< by the ring's name
  bool kind_known_ = false;
};

}  // namespace

ResultAll<DesignFile> read_design_file_text(std::string_view text, const std::string& file) {
  TomlDocument document = parse_toml(text);
  if (document.whole) return DesignReader(document).read(file);
  for (Error& error : document.errors) error.file = file;
  return fail_all(std::move(document.errors));
}

ResultAll<DesignFile> read_design_file(const std::string& path) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  return read_design_file_text(*text, path);
}

ResultAll<GearboxDesign> read_design_text(std::string_view text, const std::string& file) {
  return read_design_file_text(text, file).map([](DesignFile f) { return std::move(f.design); });
}

ResultAll<GearboxDesign> read_design(const std::string& path) {
  return read_design_file(path).map([](DesignFile f) { return std::move(f.design); });
}

Errors located(Errors errors, const DesignFile& file) {
  for (Error& error : errors) {
    if (error.file.empty()) error.file = file.file;
    for (std::string key = error.key; error.line == 0 && !key.empty();) {
      if (const auto it = file.lines.find(key); it != file.lines.end()) error.line = it->second;
      const auto dot = key.rfind('.');
      key.resize(dot == std::string::npos ? 0 : dot);
    }
  }
  return errors;
}

}  // namespace trueflank
