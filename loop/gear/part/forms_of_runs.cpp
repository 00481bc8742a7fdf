// SPDX-License-Identifier: GPL-3.0-or-later
// What some neighbouring teeth have along their flanks and the others have not: found from every
// tooth's own course, before waves around the gear make of it one form of all teeth. It is taken
// up, and all else is chosen anew beside it (whole_forms.cpp).
#include "trueflank/loop/gear/part/forms_of_teeth.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/forms_on_teeth.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {
namespace {

/// True where an effect is another at another place along the profile (0) or the face (1) of some
/// tooth.
bool varies_along(const FlankGeometry& geometry, const Effect& effect, int face) {
  constexpr int kAlong = 24, kAcross = 3;
  constexpr double kNothing = 1e-6;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  std::vector<double> values(static_cast<std::size_t>(effect.columns())), first(values);
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {1, -1})
      for (int across = 0; across < kAcross; ++across)
        for (int i = 0; i < kAlong; ++i) {
          const double along = (i + 0.5) / kAlong, beside = (across + 0.5) / kAcross;
          const double u = face != 0 ? beside : along, v = face != 0 ? along : beside;
          effect.evaluate(
              geometry,
              geometry.on_flank(tooth, side, low + u * (high - low), v * geometry.face_width_mm()),
              values.data());
          if (i == 0) first = values;
          for (std::size_t k = 0; k < values.size(); ++k)
            if (std::abs(values[k] - first[k]) > kNothing) return true;
        }
  return false;
}

/// A form that moved away from its teeth says something else: a bow of all teeth but a few.
bool is_about_run(const Effect& form, const FormOnTeeth& found) {
  constexpr double kFew = 2.0, kShare = 0.3;
  return std::abs(form.shape[1] - found.count) <= std::max(kFew, kShare * found.count);
}

/// Swellings about the middle of a run, at a height or over the whole face.
std::vector<Effect> dents_about(const FlankGeometry& geometry, const FormOnTeeth& found) {
  constexpr int kHeightsOfRun = 9;
  std::vector<Effect> dents;
  const double face_mm = geometry.face_width_mm();
  for (const double off : {-0.5, 0.0, 0.5})
    for (const double half : {0.4, 0.6, 0.9}) {
      const double middle = found.first + 0.5 * (found.count - 1.0) + off;
      const auto add = [&](double height_mm, double half_mm) {
        dents.push_back({find_family("unnamed_dent"),
                         found.flank,
                         {middle, half * found.count, height_mm, half_mm}});
      };
      add(0.0, 0.0);
      for (int i = 0; i < kHeightsOfRun; ++i)
        for (const double share : {0.1, 0.2, 0.35})
          add((i + 0.5) / kHeightsOfRun * face_mm, share * face_mm);
    }
  return dents;
}

/// Of how many teeth a form of a run is.
double teeth_of(const FlankGeometry& geometry, const Effect& run) {
  return run.family == find_family("unnamed_crossed_around")
             ? run.shape.back() / 180.0 * geometry.teeth()  // half a width [deg]
             : run.shape[1];
}

/// How a form runs along a flank, of a run of teeth or of the others; over an even grid.
Eigen::VectorXd course_of_run(const FlankGeometry& geometry, const Effect& run,
                              const Effect& other) {
  const Eigen::VectorXd tooth =
      (over_a_tooth(geometry, run) + over_a_tooth(geometry, other)).col(0);
  const Eigen::Index flank = tooth.size() / 2;
  return tooth.head(flank).norm() > 0.0 ? tooth.head(flank) : tooth.tail(flank);
}

/// True of one column that runs in this way along the flanks of all teeth, on one side or on both.
bool has_course_on_all(const FlankGeometry& geometry, const Effect& effect,
                       const Eigen::VectorXd& course) {
  constexpr double kAlike = 0.99;
  if (effect.columns() != 1 || effect.order() != 0.0 || effect.family->local ||
      runs_of(geometry, effect, Flanks::kOfEither) == Runs::kOtherwise)
    return false;
  const Eigen::VectorXd own = over_a_tooth(geometry, effect).col(0);
  const Eigen::Index flank = own.size() / 2;
  for (const Eigen::Index first : {Eigen::Index{0}, flank}) {
    const Eigen::VectorXd here = own.segment(first, flank);
    if (std::abs(here.dot(course)) < kAlike * here.norm() * course.norm()) return false;
  }
  return true;
}

}  // namespace

std::vector<double> left_with(const PartModel& model, const std::vector<std::size_t>& these) {
  const auto fit = fit_of(model, model.effects);
  const auto row_um = fit->residuals_um();
  std::vector<double> left(row_um->begin(), row_um->end());
  if (these.empty()) return left;
  std::vector<double> columns;
  for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
    const Observation& row = model.table->rows[i];
    if (row.places != 1 || model.patches.patch_of_row[i] < 0) continue;
    const Place& place = model.table->place(row);
    for (const std::size_t e : these) {
      columns.resize(static_cast<std::size_t>(model.effects[e].columns()));
      model.effects[e].evaluate(model.geometry, place, columns.data());
      const int first = fit->first_column(static_cast<int>(e));
      for (std::size_t k = 0; k < columns.size(); ++k)
        left[i] += columns[k] * fit->coefficients()[first + static_cast<int>(k)];
    }
  }
  return left;
}

std::vector<Effect> with_form_on_teeth(const PartModel& model, std::vector<std::size_t>& these,
                                       double& p_value) {
  constexpr double kClearly = 25.0, kEnds = 16.0, kEdge = 8.0;  // chi-square
  std::vector<Effect> best;
  std::vector<Effect> rest;
  std::optional<FormOnTeeth> run;
  double least = cost_of(model, model.effects) - kClearly;
  for (const int face : {1, 0}) {
    std::vector<std::size_t> pieces;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
      if (!model.effects[e].family->named && !gear_effects::is_of_teeth(model.effects[e]) &&
          varies_along(model.geometry, model.effects[e], face))
        pieces.push_back(e);
    const std::optional<FormOnTeeth> found =
        form_on_teeth(model.geometry, model.table, model.patches, left_with(model, pieces), face);
    if (!found) continue;
    std::vector<std::vector<std::size_t>> sets{pieces};
    std::vector<std::size_t> uneven;  // from tooth to tooth
    for (const std::size_t e : pieces)
      if (runs_of(model.geometry, model.effects[e], Flanks::kOfEither) == Runs::kOtherwise)
        uneven.push_back(e);
    if (!uneven.empty() && uneven.size() < pieces.size()) sets.push_back(uneven);
    if (!pieces.empty()) sets.emplace_back();
    for (const std::vector<std::size_t>& set : sets) {
      std::vector<Effect> others;
      for (std::size_t e = 0; e < model.effects.size(); ++e)
        if (std::find(set.begin(), set.end(), e) == set.end()) others.push_back(model.effects[e]);
      for (const double edge : {0.0, 2.0, 4.0, 8.0}) {
        if (edge > found->count) continue;
        std::vector<Effect> forms = found->forms;
        for (Effect& form : forms) form.shape[2] = edge;
        for (const Effect& form : forms) {
          std::vector<Effect> with = with_best_form(model, others, {form}, {});
          if (with.empty() || !is_about_run(with.back(), *found)) continue;
          const double cost = cost_of(model, with) + kEnds + (edge > 0.0 ? kEdge : 0.0);
          if (!(cost < least)) continue;
          least = cost;
          run = *found;
          rest = others;
          best = std::move(with);
          these = set;
          p_value = found->p_value;
        }
      }
    }
  }
  if (best.empty()) return best;
  // A swelling about a tooth is told as that (look_at_neighbours).
  const std::vector<Effect> dent =
      with_best_form(model, rest, dents_about(model.geometry, *run), {});
  if (!dent.empty() && cost_of(model, dent) < least) return {};
  return best;
}

bool tell_of_the_other_teeth(PartModel& model) {
  constexpr double kNothing = 9.0, kNearly = 0.003;  // chi-square of a value; of what they take out
  constexpr double kFewest = 0.2;                    // of the teeth: fewer are the odd ones
  constexpr double kMoved = 2.0;                     // teeth
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& run = model.effects[e];
    const std::optional<Effect> other = gear_effects::on_the_other_teeth(model.geometry, run);
    if (!other || teeth_of(model.geometry, run) < kFewest * model.geometry.teeth()) continue;
    const Eigen::VectorXd course = course_of_run(model.geometry, run, *other);
    std::vector<std::size_t> of_all;
    for (std::size_t k = first_told_here(model); k < model.effects.size(); ++k)
      if (has_course_on_all(model.geometry, model.effects[k], course)) of_all.push_back(k);
    const double now = fit_of(model, model.effects)->residual_square();
    for (const std::vector<std::size_t>& some : all_pairs_and_each(of_all)) {
      std::vector<std::size_t> these = some;
      these.push_back(e);
      std::sort(these.begin(), these.end());
      std::vector<Effect> others;
      for (std::size_t k = 0; k < model.effects.size(); ++k)
        if (!std::binary_search(these.begin(), these.end(), k)) others.push_back(model.effects[k]);
      const std::vector<Effect> with = with_best_form(model, others, {*other}, {});
      // (one that moved away follows something else)
      if (with.empty() || std::abs(teeth_of(model.geometry, with.back()) -
                                   teeth_of(model.geometry, *other)) > kMoved)
        continue;
      const double loss = fit_of(model, with)->residual_square() - now,
                   none = fit_of(model, others)->residual_square() - now;
      if (loss > std::max(kNothing * static_cast<double>(some.size()), kNearly * none)) continue;
      put_in_place_of(model, these, with);
      return true;
    }
  }
  return false;
}

}  // namespace trueflank::loop
