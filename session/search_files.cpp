// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/search_files.h"

#include <algorithm>
#include <map>

#include "trueflank/base/number_text.h"
#include "trueflank/design/toml_document.h"
#include "trueflank/export/number_text.h"

namespace trueflank {
namespace {

std::string decimal(double value) {
  std::string text;
  io::append_decimal(text, value);
  return text;
}

std::string json_number(double value) { return value == value ? decimal(value) : "null"; }

/// JSON takes the escapes TOML's basic strings use.
std::string json_string(const std::string& text) { return toml_string(text); }

std::string classes_json(const std::vector<SetClass>& classes) {
  std::string text;
  for (const SetClass& c : classes)
    text += (text.empty() ? "\n    " : ",\n    ") + std::string("{\"id\": ") + json_string(c.id) +
            ", \"count\": " + std::to_string(c.count) +
            ", \"description\": " + json_string(c.description) + "}";
  return "[" + text + "]";
}

std::string design_json(const FoundDesign& found, std::size_t rank) {
  const ToothSet& set = found.set;
  std::string text = "{\"file\": " + json_string(design_stem(rank) + ".toml");
  text += ", \"teeth\": {\"sun\": " + std::to_string(set.sun) +
          ", \"planet1\": " + std::to_string(set.planet1) +
          ", \"ring1\": " + std::to_string(set.ring1) +
          ", \"planet2\": " + std::to_string(set.planet2) +
          ", \"ring2\": " + std::to_string(set.ring2) + "}";
  text += ", \"output\": " + json_string(to_text(set.output));
  text += ", \"ratio\": " + json_number(std::abs(signed_ratio(set)));
  text += std::string(", \"direction\": ") + (signed_ratio(set) > 0 ? "\"same\"" : "\"opposite\"");
  text += ", \"centre_distance_mm\": " +
          json_number(found.design.centre_distance_mm.value_or(kNaN)) + ", \"shifts\": {";
  for (std::size_t i = 0; i < found.design.gears.size(); ++i)
    text += (i ? ", " : "") + json_string(found.design.gears[i].name) + ": " +
            json_number(found.design.gears[i].shift.value_or(kNaN));
  text += "}, \"forward\": " + json_number(found.candidate.forward) +
          ", \"backward\": " + json_number(found.candidate.backward) +
          ", \"forward_path_integral\": " + json_number(found.exact_forward) +
          ", \"backward_path_integral\": " + json_number(found.exact_backward) +
          ", \"forward_by_formula\": " + json_number(found.by_formula.forward) +
          ", \"backward_by_formula\": " + json_number(found.by_formula.backward) +
          ", \"formula_applies\": " + (found.by_formula.applies ? "true" : "false") +
          ", \"output_torque_nm\": " + json_number(found.candidate.torque_nm) +
          ", \"outer_diameter_mm\": " + json_number(found.candidate.size_mm) +
          ", \"tightened\": " + json_number(found.tightened) + ", \"warnings\": [";
  for (std::size_t i = 0; i < found.verdict.warned.size(); ++i)
    text += (i ? ", " : "") + json_string(found.verdict.warned[i]);
  return text + "]}";
}

}  // namespace

std::string design_stem(std::size_t rank) { return printed("design-%03zu", rank + 1); }

std::string search_csv(const SearchTask& task, const SearchReport& report) {
  std::string text =
      "rank,sun,planet1,ring1,planet2,ring2,output,layer2_module_ratio,ratio,forward,backward,"
      "output_torque_nm,outer_diameter_mm,centre_distance_modules,ring1_shift,ring2_shift,on_front,"
      "file\n";
  std::map<std::pair<std::size_t, double>, std::string> files;
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& found = report.designs[i];
    const auto it = std::find(task.enumeration.sets.begin(), task.enumeration.sets.end(), found.set);
    files[{static_cast<std::size_t>(it - task.enumeration.sets.begin()),
           found.candidate.free.centre_distance}] = design_stem(i) + ".toml";
  }
  for (std::size_t i = 0; i < report.ranking.size(); ++i) {
    const RankedCandidate& ranked = report.ranking[i];
    const ToothSet& set = task.enumeration.sets[ranked.set_index];
    const SearchCandidate& c = ranked.candidate;
    text += std::to_string(i + 1);
    for (const int teeth : {set.sun, set.planet1, set.ring1, set.planet2, set.ring2})
      text += "," + std::to_string(teeth);
    text += "," + std::string(to_text(set.output));
    for (const double value : {set.layer2_module_ratio, signed_ratio(set), c.forward, c.backward,
                               c.torque_nm, c.size_mm, c.free.centre_distance, c.free.ring1_shift,
                               c.free.ring2_shift})
      text += "," + (value == value ? decimal(value) : std::string());
    const auto file = files.find({ranked.set_index, c.free.centre_distance});
    text += std::string(ranked.on_front ? ",1," : ",0,") +
            (file == files.end() ? std::string() : file->second) + "\n";
  }
  return text;
}

std::string search_json(const SearchTask& task, const SearchReport& report) {
  std::string text = "{\"format\": \"trueflank-search\", \"version\": 1, \"name\": " +
                     json_string(task.requirements.name) +
                     ", \"material\": " + json_string(task.requirements.strength.material);
  text += ",\n  \"considered\": " + std::to_string(report.considered);
  text += ",\n  \"rejected\": " + classes_json(report.classes);
  text += ",\n  \"optimised\": " + std::to_string(report.optimised) +
          ", \"to_optimise\": " + std::to_string(report.sets) +
          ", \"feasible\": " + std::to_string(report.feasible) +
          ", \"evaluations\": " + std::to_string(report.evaluations) +
          ", \"judged\": " + std::to_string(report.judged);
  text += ",\n  \"fell_in_checks\": " + classes_json(report.fell_in_checks);
  text += std::string(",\n  \"complete\": ") + (report.optimised == report.sets ? "true" : "false");
  text += ",\n  \"designs\": [";
  for (std::size_t i = 0; i < report.designs.size(); ++i)
    text += (i ? ",\n    " : "\n    ") + design_json(report.designs[i], i);
  return text + "]}\n";
}

std::string search_summary(const SearchReport& report) {
  std::string text = printed("%lld tooth sets considered\n", report.considered);
  for (const SetClass& c : report.classes)
    if (c.count > 0) text += printed("  %14lld  %s: %s\n", c.count, c.id.c_str(),
                                       c.description.c_str());
  text += printed("%zu of %zu sets optimised, %zu with shifts that keep every limit; %zu judged by "
                    "the checks\n",
                    report.optimised, report.sets, report.feasible, report.judged);
  for (const SetClass& c : report.fell_in_checks)
    text += printed("  %14lld  fell: %s\n", c.count, c.id.c_str());
  if (report.designs.empty()) return text + "no design found\n";
  text += "\nfile             s  p1  r1  p2  r2     ratio  forward backward  torque   size\n";
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& f = report.designs[i];
    text += printed("%s.toml %3d %3d %3d %3d %3d %9.3f %7.2f%% %7.2f%% %7.4g %6.4g%s\n",
                      design_stem(i).c_str(), f.set.sun, f.set.planet1, f.set.ring1, f.set.planet2,
                      f.set.ring2, signed_ratio(f.set), 100 * f.candidate.forward,
                      100 * f.candidate.backward, f.candidate.torque_nm, f.candidate.size_mm,
                      f.verdict.warned.empty() ? "" : ("  warns: " + joined(f.verdict.warned, " ")).c_str());
  }
  text += "torque: allowable at the output [N m]; size: outer diameter [mm]; ratio < 0: output turns "
          "against the input\n";
  return text;
}

}  // namespace trueflank
