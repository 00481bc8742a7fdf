// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/search_files.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/base/number_text.h"
#include "trueflank/design/toml_document.h"
#include "trueflank/export/number_text.h"

namespace trueflank {
namespace {

std::string json_number(double value) { return std::isfinite(value) ? io::decimal_text(value) : "null"; }

/// Figures may be small: seven digits instead of six places.
std::string figure_number(double value) {
  return std::isfinite(value) ? printed("%.7g", value) : std::string();
}
std::string json_figure(double value) {
  return std::isfinite(value) ? figure_number(value) : "null";
}

/// Empty where there is none.
std::string csv_number(double value) {
  return std::isfinite(value) ? io::decimal_text(value) : std::string();
}

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

/// Figures that the named columns of search.csv do not have.
std::vector<SearchObjective> other_figures() {
  std::vector<SearchObjective> figures;
  for (const ObjectiveEntry& entry : objective_entries())
    if (entry.objective != SearchObjective::kForward &&
        entry.objective != SearchObjective::kBackward &&
        entry.objective != SearchObjective::kTorque && entry.objective != SearchObjective::kSize)
      figures.push_back(entry.objective);
  return figures;
}

std::string binding_json(const std::vector<BindingLimit>& binding) {
  std::string text;
  for (const BindingLimit& b : binding)
    text += (text.empty() ? "" : ", ") + std::string("{\"limit\": ") + json_string(b.limit) +
            ", \"where\": " + json_string(b.where) +
            ", \"key\": " + (b.key.empty() ? "null" : json_string(b.key)) +
            ", \"value\": " + json_figure(b.value) + ", \"relaxed\": " + json_figure(b.relaxed) +
            ", \"objective\": " + json_figure(b.objective) + "}";
  return "[" + text + "]";
}

/// What a reader would relax: each key once; what has no key, by the limit's name.
std::string binding_csv(const std::vector<BindingLimit>& binding) {
  std::vector<std::string> names;
  for (const BindingLimit& b : binding) {
    const std::string& name = b.key.empty() ? b.limit : b.key;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return joined(names, " ");
}

/// Of a train of several stages: what each has of its own.
std::string stages_json(const FoundDesign& found) {
  if (!found.stages) return "";
  std::string text;
  for (std::size_t i = 0; i < found.stages->sets.size(); ++i) {
    const bool first = i == 0;
    const GearboxDesign& d = found.design;
    const StageDesign own =
        first ? StageDesign{d.planets, d.module_mm, d.centre_distance_mm} : d.later_stages[i - 1];
    const SearchCandidate& candidate = found.stages->candidates[i];
    text += (first ? "" : ", ") + std::string("{\"planets\": ") + std::to_string(own.planets) +
            ", \"module_mm\": " + json_number(own.module_mm.value_or(d.module_mm)) +
            ", \"centre_distance_mm\": " + json_number(own.centre_distance_mm.value_or(kNaN)) +
            ", \"ratio\": " + json_number(signed_ratio(found.stages->sets[i])) +
            ", \"forward\": " + json_number(candidate.forward) +
            ", \"backward\": " + json_number(candidate.backward) + "}";
  }
  return ", \"stages\": [" + text + "]";
}

std::string design_json(const FoundDesign& found, std::size_t rank) {
  const TrainTeeth teeth = teeth_of(found);
  const ToothSet& set = found.set;
  std::string text = "{\"file\": " + json_string(design_stem(rank) + ".toml");
  text += ", \"kind\": " + json_string(set.train->kind()) + ", \"teeth\": {";
  for (std::size_t g = 0; g < found.design.gears.size(); ++g)
    text += (g ? ", " : "") + json_string(found.design.gears[g].name) + ": " +
            std::to_string(found.design.gears[g].teeth);
  text += "}, \"planets\": " + std::to_string(set.planets);
  text += ", \"input\": " + json_string(set.train->input) +
          ", \"output\": " + json_string(set.train->output);
  text += ", \"ratio\": " + json_number(std::abs(teeth.ratio));
  text += std::string(", \"direction\": ") + (teeth.ratio > 0 ? "\"same\"" : "\"opposite\"");
  text +=
      ", \"centre_distance_mm\": " + json_number(found.design.centre_distance_mm.value_or(kNaN)) +
      ", \"shifts\": {";
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
          ", \"gap\": " + json_number(found.candidate.gap) +
          ", \"certified_bound\": " + json_figure(found.certified_bound) +
          ", \"certified_gap\": " + json_figure(found.certified_gap) +
          ", \"tightened\": " + json_number(found.tightened());
  for (const SearchObjective figure : other_figures())
    text += ", " + json_string(objective_entry(figure).column) + ": " +
            json_figure(found.candidate.value(figure));
  if (found.candidate.score == found.candidate.score)
    text += ", \"score\": " + json_number(found.candidate.score);
  text += ", \"module_mm\": " + json_number(found.design.module_mm) +
          ", \"face_width_mm\": " + json_number(found.design.gears.front().face_width_mm) +
          ", \"hunting\": " + (teeth.hunting ? "true" : "false") +
          ", \"phasing\": " + (teeth.phasing.empty() ? "null" : json_string(teeth.phasing)) +
          ", \"assembling_share\": " + json_number(found.verdict.assembling_share) +
          stages_json(found) + ", \"binding\": " + binding_json(found.binding) +
          ", \"warnings\": [";
  for (std::size_t i = 0; i < found.verdict.warned.size(); ++i)
    text += (i ? ", " : "") + json_string(found.verdict.warned[i]);
  return text + "]}";
}

}  // namespace

TrainTeeth teeth_of(const ToothSet& set) {
  TrainTeeth teeth{.columns = set.teeth(),
                   .text = teeth_text(set),
                   .planets = set.planets,
                   .ratio = signed_ratio(set),
                   .module_ratio = set.layer2_module_ratio,
                   .hunting = has_hunting_teeth(set)};
  if (set.train->has_planets() && set.planets > 1)
    teeth.phasing = engages_in_sequence(set) ? "sequential" : "together";
  return teeth;
}

TrainTeeth teeth_of(const StagePair& pair) {
  TrainTeeth teeth = teeth_of(pair.sets[0]);
  const TrainTeeth second = teeth_of(pair.sets[1]);
  teeth.columns[3] = second.columns[1];
  teeth.columns[4] = second.columns[2];
  teeth.text += "/" + second.text;
  teeth.ratio *= second.ratio;
  teeth.module_ratio = second.module_ratio;
  teeth.hunting = teeth.hunting && second.hunting;
  if (second.phasing != teeth.phasing)
    teeth.phasing = teeth.phasing.empty() ? second.phasing : "together";
  return teeth;
}

TrainTeeth teeth_of(const FoundDesign& found) {
  return found.stages ? teeth_of(*found.stages) : teeth_of(found.set);
}

std::string teeth_text(const ToothSet& set) {
  std::string text;
  for (const TrainPlace place : set.train->places())
    text += (text.empty() ? "" : "/") + std::to_string(set.teeth_at(place));
  return text;
}

std::string design_stem(std::size_t rank) { return printed("design-%03zu", rank + 1); }

std::string search_csv(const SearchTask& task, const SearchReport& report) {
  std::string text =
      "rank,sun,planet1,ring1,planet2,ring2,output,layer2_module_ratio,ratio,forward,backward,"
      "output_torque_nm,outer_diameter_mm,centre_distance_modules,ring1_shift,ring2_shift,kind,"
      "input,"
      "planets,teeth,gap,face_width_mm,module_mm";
  for (const SearchObjective figure : other_figures())
    text += std::string(",") + objective_entry(figure).column;
  text += ",score,hunting,phasing,binding,on_front,file\n";
  std::map<std::pair<std::size_t, double>, std::size_t> designs;
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& found = report.designs[i];
    designs[{found.set_index, found.candidate.free.centre_distance}] = i;
  }
  for (std::size_t i = 0; i < report.ranking.size(); ++i) {
    const RankedCandidate& ranked = report.ranking[i];
    const std::size_t sets = task.enumeration.sets.size();
    const StagePair* pair =
        ranked.set_index < sets ? nullptr : &report.pairs[ranked.set_index - sets];
    const ToothSet set = pair ? pair->sets[0] : task.enumeration.sets[ranked.set_index];
    const TrainTeeth teeth = pair ? teeth_of(*pair) : teeth_of(set);
    const SearchCandidate& c = ranked.candidate;
    text += std::to_string(i + 1);
    for (const int number : teeth.columns)
      text += "," + (number ? std::to_string(number) : std::string());
    text += "," + set.train->output;
    for (const double value :
         {teeth.module_ratio, teeth.ratio, c.forward, c.backward, c.torque_nm, c.size_mm,
          c.free.centre_distance, set.ring1 ? c.free.layer1_shift : kNaN,
          pair        ? pair->candidates[1].free.layer1_shift
          : set.ring2 ? c.free.layer2_shift
                      : kNaN})
      text += "," + (value == value ? io::decimal_text(value) : std::string());
    text += "," + set.train->kind() + "," + set.train->input + "," + std::to_string(teeth.planets) +
            "," + teeth.text + "," + (c.gap == c.gap ? io::decimal_text(c.gap) : std::string());
    const DesignDimensions& d = c.dimensions;
    text += "," +
            csv_number(d.face_width_mm == d.face_width_mm ? d.face_width_mm
                                                          : task.requirements.face_width_mm) +
            "," +
            csv_number(d.module_mm == d.module_mm
                           ? d.module_mm
                           : SearchModel(task.requirements, set).module_mm(c.free));
    for (const SearchObjective figure : other_figures())
      text += "," + figure_number(c.value(figure));
    text += "," + csv_number(c.score) + (teeth.hunting ? ",1," : ",0,") + teeth.phasing;
    const auto design = designs.find({ranked.set_index, c.free.centre_distance});
    const bool written = design != designs.end();
    text += "," + (written ? binding_csv(report.designs[design->second].binding) : std::string()) +
            (ranked.on_front ? ",1," : ",0,") +
            (written ? design_stem(design->second) + ".toml" : std::string()) + "\n";
  }
  return text;
}

std::string search_json(const SearchTask& task, const SearchReport& report) {
  std::string text = "{\"format\": \"trueflank-search\", \"version\": 1, \"name\": " +
                     json_string(task.requirements.name) +
                     ", \"material\": " + json_string(task.requirements.strength.material);
  text += ",\n  \"objectives\": [";
  for (std::size_t i = 0; i < task.requirements.objectives.size(); ++i)
    text += (i ? ", " : "") + json_string(to_text(task.requirements.objectives[i]));
  text += "]";
  text += ",\n  \"considered\": " + std::to_string(report.considered);
  text += ",\n  \"rejected\": " + classes_json(report.classes);
  text += ",\n  \"optimised\": " + std::to_string(report.optimised - report.passed_over) +
          ", \"passed_over\": " + std::to_string(report.passed_over) +
          ", \"to_optimise\": " + std::to_string(report.sets) +
          ", \"feasible\": " + std::to_string(report.feasible) +
          ", \"evaluations\": " + std::to_string(report.evaluations) +
          ", \"judged\": " + std::to_string(report.judged);
  text += ",\n  \"fell_in_checks\": " + classes_json(report.fell_in_checks);
  text += std::string(",\n  \"complete\": ") + (report.complete() ? "true" : "false");
  text += ",\n  \"binding_ranges\": " + binding_json(report.binding_ranges);
  text += ",\n  \"designs\": [";
  for (std::size_t i = 0; i < report.designs.size(); ++i)
    text += (i ? ",\n    " : "\n    ") + design_json(report.designs[i], i);
  return text + "]}\n";
}

namespace {

std::string told(SearchObjective objective, double value) {
  if (value != value) return "-";
  const bool share =
      objective == SearchObjective::kForward || objective == SearchObjective::kBackward;
  return share ? printed("%.2f %%", 100.0 * value) : printed("%.5g", value);
}

/// What the best design stands on, and what each limit costs.
std::string binding_text(SearchObjective objective, const SearchReport& report) {
  std::vector<BindingLimit> all = report.designs.front().binding;
  all.insert(all.end(), report.binding_ranges.begin(), report.binding_ranges.end());
  std::string text;
  for (const BindingLimit& b : all) {
    text += "  " + b.limit + (b.where.empty() ? "" : " of " + b.where);
    if (b.key.empty())
      text += ": by the teeth's own shape\n";
    else
      text += printed(": %s %.6g, at %.6g %s would be ", b.key.c_str(), b.value, b.relaxed,
                      to_text(objective)) +
              told(objective, b.objective) + "\n";
  }
  if (text.empty()) return "no limit binds the best design\n";
  return printed("the best design (%s %s) stands on\n", to_text(objective),
                 told(objective, report.designs.front().candidate.value(objective)).c_str()) +
         text;
}

}  // namespace

std::string search_summary(const SearchTask& task, const SearchReport& report) {
  std::string text = printed("%lld tooth sets considered\n", report.considered);
  for (const SetClass& c : report.classes)
    if (c.count > 0)
      text += printed("  %14lld  %s: %s\n", c.count, c.id.c_str(), c.description.c_str());
  if (report.passed_over > 0)
    text += printed("the best %zu of %zu sets listed; %zu judged by the checks\n", report.feasible,
                    report.sets, report.judged);
  else if (report.sets == 0 && !task.enumeration.stages.empty())
    text += printed("%zu judged by the checks\n", report.judged);
  else
    text += printed(
        "%zu of %zu sets optimised, %zu with shifts that keep every limit; %zu judged by "
        "the checks\n",
        report.optimised, report.sets, report.feasible, report.judged);
  if (!task.enumeration.stages.empty())
    text += printed("%zu trains put together from %zu stages listed\n", report.pairs.size(),
                    task.enumeration.stages.size());
  for (const SetClass& c : report.fell_in_checks)
    text += printed("  %14lld  fell: %s\n", c.count, c.id.c_str());
  if (report.designs.empty()) return text + "no design found\n";
  const bool one_kind =
      std::all_of(report.designs.begin(), report.designs.end(), [](const FoundDesign& f) {
        return f.set.train->places().size() == kTrainPlaces && !f.stages;
      });
  text += one_kind
              ? "\nfile             s  p1  r1  p2  r2     ratio  forward backward  torque   size\n"
              : "\nfile            kind    N  teeth              ratio  forward backward  torque   "
                "size\n";
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& f = report.designs[i];
    const TrainTeeth own = teeth_of(f);
    const std::string teeth = one_kind ? printed("%3d %3d %3d %3d %3d", f.set.sun, f.set.planet1,
                                                 f.set.ring1, f.set.planet2, f.set.ring2)
                                       : printed("%-7s %d  %-15s", f.set.train->kind().c_str(),
                                                 f.set.planets, own.text.c_str());
    text += printed(
        "%s.toml %s %9.3f %7.2f%% %7.2f%% %7.4g %6.4g%s\n", design_stem(i).c_str(), teeth.c_str(),
        own.ratio, 100 * f.candidate.forward, 100 * f.candidate.backward, f.candidate.torque_nm,
        f.candidate.size_mm,
        f.verdict.warned.empty() ? "" : ("  warns: " + joined(f.verdict.warned, " ")).c_str());
  }
  if (!one_kind) text += "teeth: in the order of the design file's gears\n";
  text +=
      "torque: allowable at the output [N m]; size: outer diameter [mm]; ratio < 0: output turns "
      "against the input\n";
  return text + binding_text(task.requirements.objectives.front(), report);
}

}  // namespace trueflank
