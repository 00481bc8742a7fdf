// SPDX-License-Identifier: GPL-3.0-or-later
// What rises evenly once around: what waves around the gear are made of.
#include "trueflank/loop/gear/part/drifts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/drift_of_traces.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/drifts_of_traces.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {
namespace {

bool has_course(const Effect& effect, std::size_t k, const CourseOverFlanks& course) {
  return effect.shape[k] == course.profile && effect.shape[k + 1] == course.face;
}

/// A wave around the gear of the course, or where that is none one that has a name.
bool is_wave_of(const Effect& effect, const CourseOverFlanks& course) {
  if (!(effect.order() > 0.0) || effect.family->tells_order_along_profile ||
      effect.family->displacement_mm)
    return false;
  if (effect.family == find_family("unnamed")) return has_course(effect, 0, course);
  const NeedsToBeSeen needs = effect.needs();
  return course.profile == 0.0 && course.face == 0.0 && effect.family->doubt_share > 0.0 &&
         !needs.along_profile && !needs.along_face;
}

/// The same on every tooth and of that course, alike on the flanks or opposite on them: the mean of
/// what so drifts to nothing. What one flank has is a part of either.
bool is_level_of(const FlankGeometry& geometry, const Effect& effect,
                 const CourseOverFlanks& course, double opposite) {
  constexpr double kAlike = 0.99;
  if (effect.columns() != 1 || effect.order() != 0.0 || effect.family->local ||
      runs_of(geometry, effect, Flanks::kOfEither) == Runs::kOtherwise)
    return false;
  const Effect form{
      find_family("unnamed"), effect.flank, {course.profile, course.face, 0.0, opposite}};
  const Eigen::VectorXd own = over_a_tooth(geometry, effect).col(0),
                        level = over_a_tooth(geometry, form).col(0);
  return std::abs(own.dot(level)) > kAlike * own.norm() * level.norm();
}

/// Of these the levels that a drift on such flanks has; one flank's may be a part of any.
std::vector<std::size_t> levels_of(const PartModel& model, const std::vector<std::size_t>& levels,
                                   const CourseOverFlanks& course, FlankChoice flank,
                                   double opposite) {
  std::vector<std::size_t> own;
  for (const std::size_t e : levels)
    if (flank != FlankChoice::kBoth ||
        is_level_of(model.geometry, model.effects[e], course, opposite))
      own.push_back(e);
  return own;
}

/// Some neighbours that stand out or aside are the beginning of what levels off.
bool is_sector_of(const Effect& effect, const CourseOverFlanks& course) {
  return (effect.family == find_family("unnamed_sector") && has_course(effect, 2, course)) ||
         (effect.family == find_family("unnamed_moved_sector") && course.profile == 0.0 &&
          course.face == 0.0);
}

/// Single teeth of it are its beginning, too.
bool is_tooth_of(const Effect& effect, const CourseOverFlanks& course) {
  return effect.family == find_family("unnamed_tooth_form") && has_course(effect, 1, course);
}

/// (An even one from nothing is whole.)
bool is_ramp_of(const Effect& effect, const CourseOverFlanks& course) {
  constexpr std::size_t kZeroOfRamp = 4;
  return ((effect.family == find_family("unnamed_ramp") &&
           effect.shape[kZeroOfRamp] == gear_effects::kMeanOfDrift) ||
          effect.family == find_family("unnamed_levelling")) &&
         has_course(effect, 1, course);
}

/// Where the shape of a ramp or a levelling says whether it is opposite on the flanks.
constexpr std::size_t kOppositeOfDrift = 3;

/// How a drift goes on: evenly, or most of it within some teeth of its beginning or end.
struct Pace {
  bool grows = false;
  double within_teeth = 0.0;  ///< 0: evenly
};

/// Where drifts of a pace begin that follow these values best, the best few first; none where none
/// follows most of them.
std::vector<std::pair<double, int>> likeliest_beginnings(const Eigen::VectorXd& values,
                                                         const Pace& pace) {
  constexpr std::size_t kFew = 3;
  constexpr double kMost = 0.6;  // of their squares: a ramp's first wave alone
  const Eigen::Index z = values.size();
  const Eigen::VectorXd about_mean = values.array() - values.mean();
  Eigen::VectorXd drift = Eigen::VectorXd::LinSpaced(z, 0.0, static_cast<double>(z - 1));
  if (pace.within_teeth > 0.0) drift = (-drift / pace.within_teeth).array().exp();
  if (pace.grows) drift.reverseInPlace();
  drift.array() -= drift.mean();
  const double squares = drift.squaredNorm() * about_mean.squaredNorm();
  std::vector<std::pair<double, int>> products;
  for (Eigen::Index first = 0; first < z; ++first) {
    double product = 0.0;
    for (Eigen::Index k = 0; k < z; ++k) product += about_mean[(first + k) % z] * drift[k];
    if (product * product > kMost * squares)
      products.emplace_back(-product * product / squares, static_cast<int>(first) + 1);
  }
  std::sort(products.begin(), products.end());
  if (products.size() > kFew) products.resize(kFew);
  return products;
}

/// Drifts that are no even ramp and follow these values best, the best few first.
std::vector<std::pair<Pace, int>> likeliest_uneven(const Eigen::VectorXd& values) {
  constexpr std::size_t kFew = 4;
  std::vector<std::pair<std::pair<double, int>, Pace>> found;
  for (const double share : {0.06, 0.12, 0.25, 0.5})
    for (const bool grows : {false, true}) {
      const Pace pace{grows, share * static_cast<double>(values.size())};
      for (const std::pair<double, int>& one : likeliest_beginnings(values, pace))
        found.emplace_back(one, pace);
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (found.size() > kFew) found.resize(kFew);
  std::vector<std::pair<Pace, int>> best;
  for (const auto& [at, pace] : found) best.emplace_back(pace, at.second);
  return best;
}

/// The drifts that follow best what these effects say together of every tooth; of one flank, or of
/// both. Even ones, or uneven ones that are nothing at one of these.
std::vector<std::vector<Effect>> drifts_in_place_of(PartModel& model,
                                                    const std::vector<std::size_t>& these,
                                                    double profile, double face,
                                                    const std::vector<double>& zeros) {
  constexpr double kNearTheEnd = 0.9;
  const auto fit = fit_of(model, model.effects);
  const double low = model.geometry.root_form_roll_mm(), high = model.geometry.tip_form_roll_mm();
  const double roll =
      0.5 * (low + high) + (profile != 0.0 ? kNearTheEnd * 0.5 * (high - low) : 0.0);
  const double z_mm =
      0.5 * (1.0 + (face != 0.0 ? kNearTheEnd : 0.0)) * model.geometry.face_width_mm();
  std::array<Eigen::VectorXd, 2> of_side;  // right, left
  for (const std::size_t side : {0U, 1U}) {
    of_side[side] = Eigen::VectorXd::Zero(model.geometry.teeth());
    for (int tooth = 1; tooth <= model.geometry.teeth(); ++tooth) {
      const Place place = model.geometry.on_flank(tooth, side == 0 ? -1 : 1, roll, z_mm);
      for (const std::size_t e : these) {
        std::array<double, 2> columns{};
        model.effects[e].evaluate(model.geometry, place, columns.data());
        for (int k = 0; k < model.effects[e].columns(); ++k)
          of_side[side][tooth - 1] +=
              columns[static_cast<std::size_t>(k)] *
              fit->coefficients()[fit->first_column(static_cast<int>(e)) + k];
      }
    }
  }
  const auto drifts = [&](FlankChoice flank, double opposite, const Eigen::VectorXd& values) {
    std::vector<Effect> forms;
    if (zeros.empty())
      for (const auto& [square, first] : likeliest_beginnings(values, {}))
        forms.push_back({find_family("unnamed_ramp"),
                         flank,
                         {double(first), profile, face, opposite, gear_effects::kMeanOfDrift}});
    else
      for (const auto& [pace, first] : likeliest_uneven(values))
        for (const double zero : zeros)
          forms.push_back({find_family("unnamed_levelling"),
                           flank,
                           {double(first), profile, face, opposite, pace.grows ? 1.0 : 0.0,
                            pace.within_teeth, zero}});
    return forms;
  };
  const FlankChoice right = flank_choice(model.geometry, 0), left = flank_choice(model.geometry, 1);
  return {drifts(FlankChoice::kBoth, 0.0, of_side[1] + of_side[0]),
          drifts(FlankChoice::kBoth, 1.0, of_side[1] - of_side[0]), drifts(left, 0.0, of_side[1]),
          drifts(right, 0.0, of_side[0])};
}

/// An uneven drift beside a level of its course: one that begins or ends with nothing where that
/// says both, else about its mean, so that the level is the mean of all teeth. True where that
/// changed it.
bool tell_mean_and_drift(PartModel& model, const CourseOverFlanks& course,
                         const std::vector<std::size_t>& all_levels) {
  constexpr double kNothing = 9.0;  // chi-square
  constexpr std::size_t kZero = 6;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    if (model.effects[e].family != find_family("unnamed_levelling") ||
        !has_course(model.effects[e], 1, course))
      continue;
    const std::vector<std::size_t> levels =
        levels_of(model, all_levels, course, model.effects[e].flank,
                  model.effects[e].shape[kOppositeOfDrift]);
    for (const std::size_t level : levels) {
      if (level < first_told_here(model)) continue;
      std::vector<Effect> others, forms;
      for (std::size_t k = 0; k < model.effects.size(); ++k)
        if (k != e && k != level) others.push_back(model.effects[k]);
      for (const double zero : {gear_effects::kFirstOfDrift, gear_effects::kLastOfDrift}) {
        forms.push_back(model.effects[e]);
        forms.back().shape[kZero] = zero;
      }
      const std::vector<Effect> with = with_best_form(model, others, forms, {});
      if (with.empty() || fit_of(model, with)->residual_square() >
                              fit_of(model, model.effects)->residual_square() + kNothing)
        continue;
      put_in_place_of(model, {std::min(e, level), std::max(e, level)}, with);
      return true;
    }
    if (levels.empty() || model.effects[e].shape[kZero] == gear_effects::kMeanOfDrift) continue;
    model.effects[e].shape[kZero] = gear_effects::kMeanOfDrift;
    if (e < model.options.given.size()) model.options.given[e] = model.effects[e];
    return true;
  }
  return false;
}

/// A form about its mean, and the same from nothing at either end.
struct Drifting {
  std::vector<Effect> forms;
  CourseOverFlanks course;
  double opposite = 0.0;
};
Drifting from_nothing(const Effect& effect) {
  const bool ramp = effect.family == find_family("unnamed_ramp"),
             saw = effect.family == find_family("unnamed_saw"),
             alternation = effect.family == find_family("unnamed_alternation");
  if (!(ramp || saw || alternation)) return {};
  const std::size_t course = ramp ? 1 : saw ? 2 : 0, zero = course + 3;
  Drifting drifting{.forms = {},
                    .course = {effect.shape[course], effect.shape[course + 1]},
                    .opposite = effect.shape[course + 2]};
  for (const bool first : {true, false}) {
    Effect form = effect;
    if (alternation) {
      constexpr double kEvery = 2.0;
      form.family = find_family("unnamed_comb");
      form.shape.insert(form.shape.begin(), {kEvery, first ? 1.0 : 2.0});
    } else if (form.shape[zero] == gear_effects::kMeanOfDrift) {
      form.shape[zero] = first ? gear_effects::kFirstOfDrift : gear_effects::kLastOfDrift;
    } else {
      return {};
    }
    drifting.forms.push_back(std::move(form));
  }
  return drifting;
}

}  // namespace

std::optional<RemainderFinding> drift_over_traces(const PartModel& model) {
  constexpr double kAsWell = 1.5;
  if (model.options.joined || !model.options.given.empty()) return {};
  const std::optional<DriftOfTraces> drift =
      drift_of_traces(model.geometry, model.table, *plain_fit(model)->residuals_um());
  if (!drift) return {};
  const EffectShape& shape = drift->shape;
  const bool by_turn = shape[gear_effects::kFlanksInTurn] == double(gear_effects::kAlike) &&
                       shape[gear_effects::kDriftWithin] == 0.0 &&
                       drift->left_by_turn < kAsWell * drift->left;
  RemainderFinding finding;
  finding.p_value = drift->p_value;
  finding.effect = by_turn
                       ? Effect{find_family("unnamed_ramp"),
                                FlankChoice::kBoth,
                                {shape[gear_effects::kTeethInTurn], 0.0, 0.0, 0.0,
                                 shape[gear_effects::kZeroOfTraces]}}
                       : Effect{find_family("unnamed_drift_of_traces"), FlankChoice::kBoth, shape};
  return finding;
}

bool tell_from_nothing(PartModel& model) {
  constexpr double kNothing = 9.0, kClearly = 36.0;  // chi-square
  const auto loss_without = [](const PartModel& part, std::size_t e) {
    std::vector<Effect> others = part.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    return fit_of(part, others)->residual_square() - fit_of(part, part.effects)->residual_square();
  };
  const double now = fit_of(model, model.effects)->residual_square();
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& about_mean = model.effects[e];
    // One that hardly levels off is even.
    constexpr std::size_t kZeroOfLevelling = 6;
    if (about_mean.family == find_family("unnamed_levelling") &&
        about_mean.shape[kZeroOfLevelling] != gear_effects::kMeanOfDrift) {
      const EffectShape& shape = about_mean.shape;
      std::vector<Effect> with = model.effects;
      with[e] = {find_family("unnamed_ramp"),
                 about_mean.flank,
                 {shape[0], shape[1], shape[2], shape[kOppositeOfDrift], shape[kZeroOfLevelling]}};
      std::rotate(with.begin() + static_cast<std::ptrdiff_t>(e),
                  with.begin() + static_cast<std::ptrdiff_t>(e) + 1, with.end());
      if (fit_of(model, with)->residual_square() > now + kNothing) continue;
      put_in_place_of(model, {e}, with);
      return true;
    }
    const Drifting drifting = from_nothing(about_mean);
    for (std::size_t level = first_told_here(model);
         !drifting.forms.empty() && level < model.effects.size(); ++level) {
      if (level == e || model.effects[level].flank != about_mean.flank ||
          !is_level_of(model.geometry, model.effects[level], drifting.course, drifting.opposite) ||
          loss_without(model, level) < kClearly)
        continue;
      std::vector<Effect> best;
      double least = now + kNothing;
      for (const Effect& form : drifting.forms) {
        std::vector<Effect> with;
        for (std::size_t k = 0; k < model.effects.size(); ++k)
          if (k != e && k != level) with.push_back(model.effects[k]);
        with.push_back(form);
        const double left = fit_of(model, with)->residual_square();
        if (left > least) continue;
        least = left;
        best = std::move(with);
      }
      if (best.empty()) continue;
      put_in_place_of(model, {std::min(e, level), std::max(e, level)}, best);
      return true;
    }
  }
  return false;
}

bool tell_as_form_that_grows_anew(PartModel& model) {
  using gear_effects::AroundCourse;
  using gear_effects::FlankCourse;
  constexpr std::size_t kCourse = 2, kOpposite = 4;  // of a saw
  const EffectFamily* const saws = find_family("unnamed_saw");
  const double z = model.geometry.teeth();
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect saw = model.effects[e];
    if (saw.family != saws || (saw.shape[kCourse] == 0.0) == (saw.shape[kCourse + 1] == 0.0))
      continue;
    const int face = saw.shape[kCourse] == 0.0 ? 1 : 0;
    std::vector<std::size_t> all, names;
    for (std::size_t k = first_told_here(model); k < model.effects.size(); ++k) {
      const Effect& other = model.effects[k];
      const bool alike = other.family == saws && other.shape[0] == saw.shape[0] &&
                         (other.shape[kCourse] == 0.0 ? 1 : 0) == face &&
                         other.shape[kCourse + (face == 0 ? 1 : 0)] == 0.0;
      const bool along = runs_of(model.geometry, other, Flanks::kOfEither) ==
                         (face == 0 ? Runs::kOverProfile : Runs::kOverFace);
      // (what the saws leave of it, as often around the gear)
      const NeedsToBeSeen needs = other.needs();
      const bool wave = !other.family->named && other.order() > 0.0 &&
                        (face == 0 ? needs.along_profile : needs.along_face) &&
                        std::remainder(other.order() * saw.shape[0], z) == 0.0;
      if (!(alike || along || wave) || other.flank != saw.flank) continue;
      all.push_back(k);
      if (other.family->named) names.push_back(k);
    }
    if (all.size() < 2) continue;
    const AroundCourse around = AroundCourse::saw(model.geometry, static_cast<int>(saw.shape[0]),
                                                  static_cast<int>(saw.shape[1]));
    std::vector<Effect> forms;
    for (const FlankCourse& course : gear_effects::courses_over(model.geometry, face)) {
      EffectShape shape(2 * FlankCourse::kValues + 1 + AroundCourse::kValues, 0.0);
      course.put_in(shape, face == 0 ? 0 : FlankCourse::kValues);
      shape[2 * FlankCourse::kValues] = saw.shape[kOpposite];
      around.put_in(shape, 2 * FlankCourse::kValues + 1);
      forms.push_back({find_family("unnamed_crossed_around"), saw.flank, std::move(shape)});
    }
    for (const std::vector<std::size_t>& these : with_and_without(all, names))
      if (these.size() > 1 && put_one_form_for(model, these, forms)) return true;
  }
  return false;
}

bool tell_as_drift_aside(PartModel& model) {
  const CourseOverFlanks level;
  const CourseOverFlanks slope{1.0, 0.0};
  std::vector<std::size_t> these, moved, sloping;
  std::set<double> orders;
  bool begins = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool odd = is_ramp_of(effect, level) || is_sector_of(effect, level) ||
                     (effect.family == find_family("unnamed_saw") && has_course(effect, 2, level));
    const bool tooth = effect.family->local && effect.columns() == 1;
    const bool wave = is_wave_of(effect, level);
    begins = begins || odd || tooth;
    if (odd || tooth || wave) these.push_back(e);
    if (wave) orders.insert(effect.order());
    if (is_wave_of(effect, slope)) sloping.push_back(e);
    if (moves_the_teeth(effect)) moved.push_back(e);
  }
  // Neighbouring orders are what does not close, too.
  for (const double order : orders) begins = begins || orders.count(order + 1.0) > 0;
  if (!begins || these.size() + moved.size() < 2) return false;
  std::vector<Effect> forms, aside;
  for (int first = 1; first <= model.geometry.teeth(); ++first) {
    aside.push_back({find_family("unnamed_drift_aside"), FlankChoice::kBoth, {double(first)}});
    for (const double opposite : {0.0, 1.0})
      for (const double periods : {0.5, 1.5, 2.5, 3.5})
        forms.push_back({find_family("unnamed_broken_wave"),
                         FlankChoice::kBoth,
                         {periods, double(first), opposite}});
  }
  forms.insert(forms.end(), aside.begin(), aside.end());
  if (put_one_form_for(model, these, forms)) return true;
  // What lies off the axis on the whole moves with it.
  std::vector<Effect> off_axis;
  for (const std::size_t e : moved) off_axis.push_back(model.effects[e]);
  for (std::size_t c = 0; off_axis.empty() && c < model.candidates.size(); ++c)
    if (moves_the_teeth(model.candidates[c]) && model.candidates[c].shape.empty() &&
        !model.unseen[c])
      off_axis.push_back(model.candidates[c]);
  these.insert(these.end(), moved.begin(), moved.end());
  std::sort(these.begin(), these.end());
  for (const Effect& effect : off_axis)
    if (put_one_form_for(model, these, aside, {effect})) return true;
  // (flanks lean against the direction: it slopes over the profile)
  if (sloping.empty()) return false;
  these.insert(these.end(), sloping.begin(), sloping.end());
  std::sort(these.begin(), these.end());
  for (const Effect& effect : off_axis)
    if (put_one_form_for(model, these, aside, {effect})) return true;
  return false;
}

bool tell_as_drift(PartModel& model) {
  for (const CourseOverFlanks& course :
       {CourseOverFlanks{}, CourseOverFlanks{1.0, 0.0}, CourseOverFlanks{0.0, 1.0},
        CourseOverFlanks{2.0, 0.0}, CourseOverFlanks{0.0, 2.0}}) {
    std::vector<std::size_t> waves, teeth, levels, moved;
    std::set<double> orders;
    bool drifts = false;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const bool ramp = is_ramp_of(model.effects[e], course),
                 sector = is_sector_of(model.effects[e], course),
                 tooth = is_tooth_of(model.effects[e], course);
      if (ramp || sector || tooth || is_wave_of(model.effects[e], course)) {
        constexpr double kSector = -1.0, kTooth = -2.0;  // kinds beside orders
        waves.push_back(e);
        orders.insert(ramp ? 0.0 : sector ? kSector : tooth ? kTooth : model.effects[e].order());
        drifts = drifts || ramp;
      } else if (model.effects[e].family->local && model.effects[e].columns() == 1) {
        teeth.push_back(e);
      } else if (is_level_of(model.geometry, model.effects[e], course, 0.0) ||
                 is_level_of(model.geometry, model.effects[e], course, 1.0)) {
        levels.push_back(e);
      } else if (moves_the_teeth(model.effects[e])) {
        moved.push_back(e);
      }
    }
    const bool several = orders.size() > 1;
    if (!several && !drifts) continue;
    if (tell_mean_and_drift(model, course, levels)) return true;
    // An even drift; one about its mean; one that begins or ends with nothing, which has the mean
    // in it. (That last: values on a zero of their own do not tell these apart, and beside a mean
    // it is told of the pair.)
    const std::vector<double> none, mean{gear_effects::kMeanOfDrift},
        ends{gear_effects::kFirstOfDrift, gear_effects::kLastOfDrift};
    for (const std::vector<double>& zeros : {none, mean, ends}) {
      const bool has_mean = zeros.size() > 1, is_bent = !several && zeros.size() == 1;
      if (!several && zeros.empty()) continue;
      const std::vector<std::vector<Effect>> forms =
          drifts_in_place_of(model, waves, course.profile, course.face, zeros);
      // (an eccentricity beside an even drift may be what that leaves of an uneven one)
      std::vector<std::size_t> nothing;
      for (const auto* more : {&moved, &teeth, &nothing}) {
        if ((more->empty() && more != &nothing) || (more == &moved && !is_bent)) continue;
        for (const std::vector<Effect>& drifts_of : forms) {
          if (drifts_of.empty()) continue;
          std::vector<std::size_t> these = waves;
          these.insert(these.end(), more->begin(), more->end());
          if (has_mean) {
            const std::vector<std::size_t> own =
                levels_of(model, levels, course, drifts_of.front().flank,
                          drifts_of.front().shape[kOppositeOfDrift]);
            these.insert(these.end(), own.begin(), own.end());
          }
          std::sort(these.begin(), these.end());
          if (put_one_form_for(model, these, drifts_of, {}, is_bent ? 1 : 0)) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace trueflank::loop
