// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/close_loop.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/iso_1328.h"
#include "trueflank/loop/gear/local/far_values.h"
#include "trueflank/loop/gear/local/loud_places.h"
#include "trueflank/loop/gear/measure_next.h"
#include "trueflank/loop/gear/orders_alike.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/clampings/two_clampings.h"
#include "trueflank/loop/gear/part/odd_forms.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/records.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/pose/part_frame.h"
#include "trueflank/loop/gear/random_error.h"
#include "trueflank/loop/gear/several_parts.h"
#include "trueflank/loop/gear/shape_refinement.h"
#include "trueflank/loop/gear/table/canonical_order.h"

namespace trueflank::loop {
namespace {

/// Share of the variance before that is gone after.
double explained_by(const ErrorFigures& before, const ErrorFigures& after) {
  const double left = after.rms / before.rms;
  return before.rms > 0.0 ? std::max(0.0, 1.0 - left * left) : 0.0;
}

/// What data and design say of how the part was made: the data, where both do.
struct KnownProcess {
  std::string name;
  Makings makings = kAnyMaking;
  std::vector<std::string> notes;
};

KnownProcess process_of(const MeasuredData& data, const LoopOptions& options) {
  KnownProcess known;
  const auto unknown = [&](const std::string& name) {
    known.notes.push_back("the process \"" + name +
                          "\" does not say how the part was made: causes of every process are named; write "
                          "grinding, hobbing, shaping, milling, wire-edm, laser, fdm, sla, sls, moulding or "
                          "sintering");
  };
  if (data.processes.empty()) {
    if (!options.process) return known;
    known.name = options.process->name;
    if (const auto makings = making_of(*options.process)) known.makings = *makings;
    else unknown(known.name);
    return known;
  }
  Makings open = 0;
  for (const std::string& name : data.processes) {
    known.name += (known.name.empty() ? "" : ", ") + name;
    const auto makings = making_named(name);
    if (!makings) unknown(name);
    open |= makings.value_or(kAnyMaking);
  }
  known.makings = open;
  if (options.process && (making_of(*options.process).value_or(kAnyMaking) & open) == 0)
    known.notes.push_back("the data say " + known.name + ", the design says " + options.process->name +
                          ": the data are believed");
  return known;
}

/// True where the error on held-out data is larger than noise of the size found there allows.
bool is_more_than_noise(const LoopResult& result, const RandomError& noise) {
  constexpr double kAllowed = 1.15, kSure = 4.0;
  const bool any_held_out = result.held_out > 0;
  const double known = any_held_out ? std::min<double>(result.held_out, noise.held_out_degrees)
                                    : result.observations;
  const double allowed = std::max(kAllowed, 1.0 + kSure / std::sqrt(2.0 * known));
  return any_held_out ? result.after.held_out_rms > allowed * noise.held_out_um
                      : result.after.rms > allowed * noise.um;
}

/// How likely noise of the size found makes so large an error by chance: of independent values.
double p_of_more_than_noise(const LoopResult& result, const RandomError& noise) {
  const bool any_held_out = result.held_out > 0;
  const double times =
      any_held_out ? result.after.held_out_rms / noise.held_out_um : result.after.rms / noise.um;
  return f_tail(times * times,
                any_held_out ? std::min<double>(result.held_out, noise.held_out_degrees)
                             : result.observations,
                result.observations);
}

LoopResult result_of(const FlankGeometry& geometry, const PartModel& model, const PointFit& fit,
                     const std::vector<float>& left_um, Makings makings) {
  LoopResult result;
  result.observations = fit.observations();
  result.held_out = fit.held_out();
  result.outliers = model.table->outliers;
  RandomError noise =
      random_error(geometry, model.table, model.patches, left_um, what_is_left(model));
  for (const RemainderFinding& finding : model.remainder)
    if (!std::isnan(finding.noise_um)) noise.um = noise.held_out_um = finding.noise_um;
  result.noise = noise.um;
  result.notes = model.table->notes;
  for (std::string& note : notes_on(still_louder(geometry, model.table, model.patches, left_um)))
    result.notes.push_back(std::move(note));
  for (std::string& note :
       notes_on_rough_traces(geometry, *model.table.operator->(), model.patches, left_um))
    result.notes.push_back(std::move(note));
  const auto told_um = [&](const Place& place) {
    double sum = 0.0, columns[8];
    for (std::size_t e = 0; e < fit.effects().size(); ++e) {
      fit.effects()[e].evaluate(geometry, place, columns);
      for (int k = 0; k < fit.effects()[e].columns(); ++k)
        sum += fit.coefficients()[fit.first_column(static_cast<int>(e)) + k] * columns[k];
    }
    return sum;
  };
  for (std::string& note :
       notes_on_far_values(geometry, *model.table.operator->(), left_um, told_um))
    result.notes.push_back(std::move(note));
  const auto none = plain_fit(model)->errors({});
  const auto all = fit.errors(std::vector<bool>(model.effects.size(), true));
  result.before = {none.rms_um, none.held_out_rms_um, 0.0};
  const PointFit::HeldOutBesideLocal held_out = fit.held_out_beside_local();
  const bool fitted_there = !shown_by_held_out_alone(model, held_out).empty();
  result.after = {all.rms_um, fitted_there ? held_out.rms_um : all.held_out_rms_um, 0.0};
  if (fitted_there)
    result.notes.push_back(
        "the error on held-out data is counted beside what held-out values alone show, such as a "
        "form of one held-out tooth: no other value can foretell it");
  result.not_observable = not_observable(model);
  result.structure_p_value = model.discovery.first_p_value;
  result.structure_left_p_value = structure_left_p_value(model);
  result.structure_left = structure_left(model);
  ShapeUncertainty uncertainty =
      shape_uncertainty(geometry, model.table, model.patches, fit, FreeShapes::kAll);
  uncertainty.otherwise = without_means_of_waves(model, fit);
  result.effects = describe_effects({geometry,
                                     fit,
                                     model.discovery,
                                     model.candidates,
                                     uncertainty,
                                     result.not_observable,
                                     makings,
                                     model.unseen,
                                     explained_by(result.before, result.after),
                                     {},
                                     model.table.operator->()});
  say_two_clampings(geometry, *model.table.operator->(), fit, result.effects);
  say_where_records_differ(model.alone, result);
  result.measure_next =
      measurements_that_separate(result.effects, result.not_observable, *model.table.operator->());
  for (int e = 0; e < static_cast<int>(model.effects.size()); ++e)
    if (!orders_alike(geometry, model.table, fit, e).empty()) {
      result.measure_next.emplace_back(
          "trace more teeth, best all of them: those traced do not show whether what is found is "
          "alike on all teeth or comes in waves around the gear");
      break;
    }
  if (structure_is_left(model))
    result.verdict = Verdict::kPartlyExplained;
  else
    result.verdict = model.effects.empty() ? Verdict::kNoEffect : Verdict::kExplained;
  if (result.verdict != Verdict::kPartlyExplained && is_more_than_noise(result, noise)) {
    result.verdict = Verdict::kPartlyExplained;
    const bool any_held_out = result.held_out > 0;
    result.structure_left = printed(
        "what is left, %.3g um%s, is more than the measurement's own noise of %.3g um: the verdict "
        "rests on that, and no form of it is sure",
        any_held_out ? result.after.held_out_rms : result.after.rms,
        any_held_out ? " on held-out data" : "", any_held_out ? noise.held_out_um : noise.um);
    result.structure_left_p_value = p_of_more_than_noise(result, noise);
  }
  return result;
}

GearLoop close_one(const FlankGeometry& geometry, const std::string& gear_name, SharedTable table,
                   const LoopOptions& options) {
  PartModel model(geometry, std::move(table),
                  {.declared = options.declared, .makings = options.makings});
  explain_measured_part(model);
  const auto fit = fit_of(model, model.effects);
  std::vector<float> before_um = plain_fit(model)->residuals_without_effects_um();
  std::vector<float> after_um = *fit->residuals_um();
  GearLoop done{result_of(geometry, model, *fit, after_um, options.makings), geometry, {}, {}, {}};
  done.result.gear = gear_name;
  done.before_um = std::move(before_um);
  done.after_um = std::move(after_um);
  done.table = std::move(model.table).taken();
  find_largest_errors(done);
  const Iso1328 iso = iso_1328(done);
  done.result.iso_1328 = inspection_figures(iso);
  if (!done.result.iso_1328.empty()) done.result.iso_1328_note = iso.note;
  return done;
}

/// Names of the parts in the order of the files; empty where all data are of one.
std::vector<std::string> parts_of(const MeasuredData& data) {
  std::vector<std::string> names;
  const auto add = [&](const auto& files) {
    for (const auto& file : files)
      if (std::find(names.begin(), names.end(), file.part) == names.end())
        names.push_back(file.part);
  };
  add(data.scans);
  add(data.inspections);
  add(data.sizes);
  if (names.size() < 2) names.clear();
  return names;
}

/// Takes out the files of one part.
template <class T>
std::vector<T> of_part(std::vector<T>& files, const std::string& part) {
  const auto of_others = [&](const T& file) { return file.part != part; };
  const auto first = std::stable_partition(files.begin(), files.end(), of_others);
  std::vector<T> taken(std::make_move_iterator(first), std::make_move_iterator(files.end()));
  files.erase(first, files.end());
  return taken;
}

/// Deviations that no gear of this design can have are another unit's or another gear's.
void doubt_unit_and_gear(const FlankGeometry& geometry, bool scanned, LoopResult& result) {
  constexpr double kFinest_um = 0.02, kLargeInModules = 0.08;
  const double rms = result.before.rms, module_um = 1e3 * geometry.gear().normal_module_mm;
  if (!scanned && rms > 1e-4 && rms < kFinest_um)
    result.notes.push_back(printed(
        "deviations of %.2g um rms are finer than any machine measures: are they in millimetres?",
        rms));
  else if (rms > kLargeInModules * module_um)
    result.notes.push_back(
        printed("deviations of %.3g um rms are large for a module of %.4g mm: is this the gear of "
                "the design?",
                rms, 1e-3 * module_um));
}

Errors too_few(const Observations& table, const std::string& part) {
  constexpr std::size_t kFewest = 3;
  if (table.rows.size() >= kFewest) return {};
  return {{.code = ErrorCode::kOutOfRange,
           .message = "the data" + (part.empty() ? "" : " of part " + part) + " hold " +
                      std::to_string(table.rows.size()) +
                      " usable values; the loop needs more than that"}};
}

}  // namespace

void find_largest_errors(GearLoop& done) {
  for (std::size_t i = 0; i < done.table.rows.size(); ++i) {
    if (!counts_as_error(done.table.rows[i].kind)) continue;
    const auto raise = [i](double& largest, const std::vector<float>& values) {
      largest = std::max(largest, static_cast<double>(std::abs(values[i])));
    };
    raise(done.result.before.max, done.before_um);
    raise(done.result.after.max, done.after_um);
  }
}

namespace {

ResultAll<GearLoop> close_with_process(const FlankGeometry& geometry, const std::string& gear_name,
                                       MeasuredData data, const LoopOptions& options) {
  const std::vector<std::string> names = parts_of(data);
  if (names.empty()) {
    auto table = make_observations(geometry, std::move(data), {.aligned = options.aligned});
    if (!table) return fail_all(std::move(table.error()));
    if (auto few = too_few(*table, {}); !few.empty()) return fail_all(std::move(few));
    return close_one(geometry, gear_name, std::move(*table), options);
  }
  std::vector<PartTable> parts;
  Errors errors;
  for (const std::string& name : names) {
    MeasuredData of_one{of_part(data.scans, name), of_part(data.inspections, name),
                        of_part(data.sizes, name), {}, {}};
    auto table = make_observations(geometry, std::move(of_one), {.aligned = options.aligned});
    Errors found = table ? too_few(*table, name) : table.error();
    errors.insert(errors.end(), found.begin(), found.end());
    if (table && found.empty())
      parts.push_back({name.empty() ? "(unnamed)" : name, std::move(*table)});
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  GearLoop done = close_loop_of_parts(geometry, std::move(parts), options);
  done.result.gear = gear_name;
  done.result.notes.insert(done.result.notes.begin(), data.notes.begin(), data.notes.end());
  return done;
}

}  // namespace

ResultAll<GearLoop> close_loop(const FlankGeometry& geometry, const std::string& gear_name,
                               MeasuredData data, const LoopOptions& options) {
  put_files_in_order(data);
  const KnownProcess known = process_of(data, options);
  LoopOptions open = options;
  open.makings = known.makings;
  auto closed = close_with_process(geometry, gear_name, std::move(data), open);
  if (!closed) return closed;
  LoopResult& result = closed->result;
  result.process = known.name;
  result.notes.insert(result.notes.end(), known.notes.begin(), known.notes.end());
  return closed;
}

ResultAll<GearLoop> close_loop(const GearTrain& train, const std::string& gear_name,
                               const std::vector<std::string>& files, const LoopOptions& options) {
  const TrainGear* gear = train.find(gear_name);
  if (gear == nullptr) {
    std::string names;
    for (const TrainGear& known : train.gears) names += (names.empty() ? "" : ", ") + known.name;
    return fail_all({{.code = ErrorCode::kUsage,
                      .message = "the design has no gear \"" + gear_name + "\"",
                      .key = "--gear",
                      .value = gear_name,
                      .remedy = "one of " + names}});
  }
  auto data = read_measured_files(files);
  if (!data) return fail_all(std::move(data.error()));
  double bore_radius = 0.0;
  if (const GearDesign* design = find_gear(train.design, gear_name))
    if (design->bore.kind == BoreKind::kRound) bore_radius = 0.5 * design->bore.diameter_mm;
  const FlankGeometry geometry(*gear, bore_radius);
  if (options.aligned) move_into_gear_frame(train, *gear, geometry, *data);
  LoopOptions of_design = options;
  if (!of_design.process) of_design.process = train.design.made.process;
  const bool scanned = !data->scans.empty();
  auto closed = close_loop(geometry, gear_name, std::move(*data), of_design);
  if (closed) doubt_unit_and_gear(geometry, scanned, closed->result);
  return closed;
}

}  // namespace trueflank::loop
