// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/known_wishes.h"

#include "trueflank/base/number_text.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/train/machine/bed.h"

namespace trueflank {
namespace {

Error unknown(const char* key, const std::string& value, std::string known) {
  return {.code = ErrorCode::kUsage,
          .message = "not known",
          .key = key,
          .value = value,
          .remedy = std::move(known)};
}

template <class Element>
std::string names_of_all(const std::vector<Element>& elements) {
  std::string names;
  for (const Element& element : elements) names += (names.empty() ? "" : ", ") + element.name;
  return names;
}

/// The material of a name, or the only one whose name goes on after it: "pla" for "pla-printed".
/// Empty: none, or several.
std::string material_named(const std::string& text) {
  const MaterialTable table;
  if (table.find(text)) return text;
  std::string found;
  for (const Material& material : table.all()) {
    if (!material.name.starts_with(text + "-")) continue;
    if (!found.empty()) return "";
    found = material.name;
  }
  return found;
}

/// Of the option that names what there is not.
Error no_such_set(const DesignWishes& wishes) {
  std::string kinds, members;
  for (const WishedSets& sets : all_wished_sets()) {
    if (kinds.find(sets.kind) == std::string::npos)
      kinds += (kinds.empty() ? "" : ", ") + sets.kind;
    if (sets.kind == wishes.kind)
      members +=
          (members.empty() ? "--input " : "; --input ") + sets.input + " --output " + sets.output;
  }
  const auto named = [](const char* option, const std::string& value, const std::string& known) {
    return Error{.code = ErrorCode::kUsage,
                 .message = "no such set is searched for a ratio",
                 .key = option,
                 .value = value,
                 .remedy = known + ", or no --ratio"};
  };
  if (members.empty()) return named("--kind", wishes.kind, kinds);
  if (!find_wished_sets(wishes.kind, wishes.input, "")) return named("--input", wishes.input, members);
  return named("--output", wishes.output, members);
}

/// The kinds that have the ratio, as the end of a remedy.
std::string other_kinds(const DesignWishes& wishes) {
  std::string names;
  for (const WishedSets& sets : all_wished_sets())
    if (sets.kind != wishes.kind && wishes.ratio >= sets.ratio_min &&
        wishes.ratio <= sets.ratio_max && names.find(sets.kind) == std::string::npos)
      names += (names.empty() ? "" : " or ") + sets.kind;
  return names.empty() ? "" : ", or --kind " + names;
}

}  // namespace

Errors KnownWishes::read(const DesignWishes& wishes) {
  Errors errors;
  sets = find_wished_sets(wishes.kind, wishes.input, wishes.output);
  if (!sets) errors.push_back(no_such_set(wishes));
  if (sets && !(wishes.ratio >= sets->ratio_min && wishes.ratio <= sets->ratio_max))
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no ratio of a " + sets->kind + " set driven at the " +
                                 sets->input + " with the " + sets->output + " as output",
                      .key = "--ratio",
                      .value = fixed_text(wishes.ratio, 3),
                      .remedy = printed_number(sets->ratio_min, "%g") + " to " +
                                printed_number(sets->ratio_max, "%g") + other_kinds(wishes)});
  if (!(wishes.outer_diameter_mm >= 40.0 && wishes.outer_diameter_mm <= kLargestWish_mm))
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no diameter of a gearbox",
                      .key = "--outer-diameter",
                      .value = fixed_text(wishes.outer_diameter_mm, 3),
                      .remedy = "40 to " + printed_number(kLargestWish_mm, "%g")});
  if (!wishes.tools.empty()) {
    auto read = read_tools(wishes.tools);
    if (!read) return read.error();
    tools = *std::move(read);
  }
  process = tools.processes.find(wishes.process);
  if (!process)
    errors.push_back(unknown("--process", wishes.process, joined(names_of(tools.processes))));
  material = material_named(wishes.material);
  if (material.empty())
    errors.push_back(
        unknown("--material", wishes.material, names_of_all(MaterialTable().all())));
  motor = find_element(tools.elements.motors, wishes.motor);
  if (!motor && !wishes.motor.empty())
    errors.push_back(unknown("--motor", wishes.motor, names_of_all(tools.elements.motors)));
  if (!wishes.bed.empty() && !find_bed(wishes.bed))
    errors.push_back(unknown("--bed", wishes.bed, joined(known_beds())));
  if (sets && sets->kind == "two-stage" && !wishes.motor.empty())
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no housing is made around two stages",
                      .key = "--motor",
                      .value = wishes.motor,
                      .remedy = "no --motor: the gears alone; or another kind"});
  return errors;
}

}  // namespace trueflank
