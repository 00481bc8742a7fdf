// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/wished_sentences.h"

#include <cmath>

#include "trueflank/session/fixed_text.h"

namespace trueflank {
namespace {

std::string teeth_text(const FoundDesign& found) {
  const ToothSet& set = found.set;
  std::string text;
  for (const GearDesign& gear : found.design.gears)
    text += (text.empty() ? "" : ", ") + gear.name + " " + std::to_string(gear.teeth);
  return text + " teeth, driven at the " + set.train->input + ", output " + set.train->output;
}

std::string second_module(const GearboxDesign& design) {
  if (design.later_stages.empty()) return "";
  return " and " + fixed_text(design.later_stages[0].module_mm.value_or(design.module_mm), 4);
}

std::string best_text(const FoundDesign& found, const WishedSets& sets) {
  const std::string forward = fixed_text(100.0 * found.exact_forward, 1) + " %";
  if (sets.objective == SearchObjective::kForward)
    return "the best forward efficiency (" + forward + ")";
  return "the largest allowable torque at the output (forward efficiency " + forward + ")";
}

}  // namespace

std::vector<std::string> wished_sentences(const WishedAnswer& answer) {
  const FoundDesign& found = answer.found;
  const SearchReport& report = answer.report;
  const GearboxDesign& design = answer.design;
  const Motor* const motor = answer.motor;
  const double ratio = found.stages ? signed_ratio(*found.stages) : signed_ratio(found.set);
  std::vector<std::string> told{
      "ratio " + fixed_text(std::abs(ratio), 3) + " for " + fixed_text(answer.wishes.ratio, 3) +
          " asked: " + teeth_text(found),
      best_text(found, *answer.known.sets) + " of " +
          std::to_string(found.stages ? report.pairs.size() : report.feasible) +
          " sets with shifts that keep every limit, of which no check fails" +
          (found.verdict.warned.empty() ? " or warns" : "") + "; " +
          std::to_string(report.judged) + " were judged",
      "module " + fixed_text(design.module_mm, 4) + second_module(design) +
          " mm: the largest that the outer diameter of " +
          fixed_text(answer.wishes.outer_diameter_mm, 1) + " mm leaves"};
  if (!found.verdict.warned.empty()) {
    std::string list;
    for (const std::string& id : found.verdict.warned) list += (list.empty() ? "" : ", ") + id;
    told.push_back("of the sets judged none is without a warning; this one warns: " + list);
  }
  if (!motor) return told;
  const int input = design.topology.input;
  const std::string driven = design.topology.name_of(input);
  told.push_back("motor " + motor->name + ": the bore of the " + driven +
                 " is that of its shaft");
  if (answer.filed)
    told.push_back(
        "its shaft is round, and no set screw has room or holds enough: file a flat on it, " +
        fixed_text(motor->flat_length_mm, 1) + " mm long from its end, " +
        fixed_text(motor->flat_mm, 1) +
        " mm from the flat to the far side (flat_mm and flat_length_mm in [motor])");
  const BearingsDesign& bearings = design.machine->bearings;
  if (!design.topology.has_planets()) {
    told.push_back(bearings.wheel
                       ? "the wheel stands between bearing " + bearings.wheel->name +
                             " in the floor and " + bearings.output.name + " in the lid"
                       : "no room for a bearing under the wheel: two bearings " +
                             bearings.output.name + " in the lid hold it");
    return told;
  }
  told.push_back(bearings.planet
                     ? "bearings " + bearings.planet->name + " in the planets and " +
                           bearings.output.name +
                           " at the output: the largest that leave the walls that " +
                           answer.known.process->name + " makes"
                     : "no bearings in the planets, which have no room for them: they turn "
                       "on pins; bearing " +
                           bearings.output.name + " at the output");
  return told;
}

}  // namespace trueflank
