// SPDX-License-Identifier: GPL-3.0-or-later
// Names that are the mean of an odd form around the gear, or its twist: they are told as forms.
#include "trueflank/loop/gear/part/odd_forms.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/fit/flank_fields.h"
#include "trueflank/loop/gear/paired_sums.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

/// What of a field is the same on all teeth, without the parts that are a course over the profile
/// or over the face alone: a twist, and all else that needs both.
Eigen::VectorXd crossed_part(const FlankField& field) {
  Eigen::VectorXd crossed = field.rowwise().mean();
  for (const Eigen::Index flank : {0, 1}) {
    Eigen::Map<Eigen::MatrixXd> over(crossed.data() + flank * kGridSide * kGridSide, kGridSide,
                                     kGridSide);
    const Eigen::VectorXd profile = over.rowwise().mean();
    over.colwise() -= profile;
    const Eigen::RowVectorXd face = over.colwise().mean();
    over.rowwise() -= face;
  }
  return crossed;
}

/// True for what bends or leans the flanks of every tooth alike, and does not only lift them.
bool shapes_every_tooth(const FlankField& field) {
  constexpr double kMostly = 0.5, kAlike = 1e-6;
  const Eigen::VectorXd mean = field.rowwise().mean();
  if ((field.colwise() - mean).squaredNorm() > kAlike * field.squaredNorm()) return false;
  double lifts = 0.0;
  for (const Eigen::Index flank : {0, 1}) {
    const double level = mean.segment(flank * kGridSide * kGridSide, kGridSide * kGridSide).mean();
    lifts += kGridSide * kGridSide * level * level;
  }
  return lifts < kMostly * mean.squaredNorm();
}

/// Forms without a name that differ from tooth to tooth, and the waves that they are made of.
struct AroundTheGear {
  FlankField sum;
  std::set<double> orders;
  bool is_no_wave = false;  ///< a sector, a drift, a comb
  [[nodiscard]] bool is_odd() const { return is_no_wave || orders.size() >= 2; }
};

/// How far forms around the gear change from tooth to tooth along what a name does: 1 as far as
/// that itself.
double change_along(const FlankField& forms, const Eigen::VectorXd& name) {
  const Eigen::VectorXd share = forms.transpose() * name / name.squaredNorm();
  return std::sqrt((share.array() - share.mean()).square().mean());
}

/// True where forms around the gear may have a mean along what a name does: with it they leave many
/// teeth nearly as designed there, or hardly change their sign. Waves that swing to both sides
/// have none, as an axis that wobbles.
bool may_have_a_mean(const FlankField& forms, const Eigen::VectorXd& name) {
  constexpr double kNearly = 0.12, kMany = 0.4, kHardly = 0.1;
  const Eigen::ArrayXd along = 1.0 + (forms.transpose() * name / name.squaredNorm()).array();
  const double low = along.minCoeff(), high = along.maxCoeff();
  if (std::min(-low, high) < kHardly * std::max(-low, high)) return true;
  return static_cast<double>((along.abs() < kNearly * (high - low)).count()) >=
         kMany * static_cast<double>(along.size());
}

/// What a field is mostly: a course over the flanks that comes and goes around the gear.
struct MainCourse {
  Eigen::VectorXd over_flanks;  ///< of unit norm
  double amplitude = 0.0, share = 0.0;
};

MainCourse main_course(const FlankField& field, const Eigen::VectorXd& start) {
  constexpr int kStepsAround = 30;
  MainCourse main{start.normalized()};
  for (int i = 0; i < kStepsAround; ++i) {
    const Eigen::VectorXd next = field * (field.transpose() * main.over_flanks);
    if (!(next.norm() > 0.0)) return main;
    main.over_flanks = next.normalized();
  }
  const double square = (field.transpose() * main.over_flanks).squaredNorm();
  main.amplitude = std::sqrt(2.0 * square / static_cast<double>(field.cols()));
  main.share = square / field.squaredNorm();
  return main;
}

/// What is the same on every tooth beside waves without a name, and how much of each is the mean of
/// these where they never change their sign.
struct MeanOfWaves {
  std::vector<std::size_t> effects;
  Eigen::VectorXd shares;  ///< of each: 1 where all of it is
  double level_um = 0.0;   ///< how far they lift the flanks in the mean, at most
};

bool is_wave_without_name(const Effect& e) {
  return e.is_term() && e.family->form_word.empty() && e.order() > 0.0;
}

/// A side that cools later bends the flanks once around by a course that names make up together.
/// Its mean is as large as its wave: without it one of these at least is nothing.
std::optional<MeanOfWaves> mean_of_waves(const FlankGeometry& geometry, const PointFit& fit) {
  constexpr double kCounts = 0.2, kMostly = 0.8, kInTheSpan = 0.25, kGone = 0.25, kAlike = 1e-6;
  const std::vector<Effect>& effects = fit.effects();
  if (std::none_of(effects.begin(), effects.end(), is_wave_without_name)) return {};
  MeanOfWaves mean;
  FlankField around = FlankField::Zero(2 * kGridSide * kGridSide, geometry.teeth());
  Eigen::MatrixXd courses(2 * kGridSide * kGridSide, 0);
  double heights = 0.0;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const bool wave = is_wave_without_name(effects[e]);
    if (!wave &&
        (effects[e].family->local || effects[e].columns() != 1 || effects[e].order() != 0.0))
      continue;
    FlankField field = field_of(geometry, fit, e);
    if (wave) around += field;
    if (wave) continue;
    take_off_heights(field);
    const Eigen::VectorXd course = field.rowwise().mean();
    const double square = field.squaredNorm();
    if (!(square > 0.0) || (field.colwise() - course).squaredNorm() > kAlike * square) continue;
    courses.conservativeResize(Eigen::NoChange, courses.cols() + 1);
    courses.rightCols(1) = course;
    mean.effects.push_back(e);
  }
  for (const Eigen::Index flank : {0, 1})
    heights =
        std::max(heights, around.middleRows(flank * kGridSide * kGridSide, kGridSide * kGridSide)
                              .colwise()
                              .mean()
                              .cwiseAbs()
                              .maxCoeff());
  mean.level_um = heights;
  take_off_heights(around);
  if (courses.cols() < 2 || !(around.squaredNorm() > 0.0)) return {};
  const Eigen::VectorXd sizes = courses.colwise().norm();
  const Eigen::MatrixXd unit = courses * sizes.cwiseInverse().asDiagonal();
  const MainCourse main = main_course(around, around.col(0));
  if (main.share < kMostly) return {};
  Eigen::MatrixXd normal = unit.transpose() * unit;
  normal.diagonal().array() += 1e-9;
  const Eigen::VectorXd right = unit.transpose() * main.over_flanks;
  const Eigen::VectorXd parts = symmetric_solution(normal, right);
  if ((main.over_flanks - unit * parts).norm() > kInTheSpan) return {};
  if ((parts.cwiseAbs().array() > kCounts).count() < 2) return {};
  const Eigen::VectorXd shares = main.amplitude * parts.cwiseQuotient(sizes);
  const auto gone = [&](const Eigen::VectorXd& of) {
    int count = 0;
    for (Eigen::Index i = 0; i < of.size(); ++i)
      count += std::abs(parts[i]) > kCounts && std::abs(1.0 - of[i]) < kGone ? 1 : 0;
    return count;
  };
  const int up = gone(shares), down = gone(-shares);
  if (up == 0 && down == 0) return {};
  mean.shares = up >= down ? shares : Eigen::VectorXd(-shares);
  return mean;
}

/// How an effect's size differs from flank to flank, beside what errors do to each, over its size.
double spread_over_flanks(const FlankGeometry& geometry, const Observations& table,
                          const Patches& patches, const PointFit& fit, std::size_t e) {
  constexpr double kFewest = 6.0, kBeyondErrors = 9.0, kShows = 0.1;
  const Effect& effect = fit.effects()[e];
  const auto row_um = fit.residuals_um();
  // The effect and what is there, of one flank of a tooth or one trace: source, trace, tooth, side.
  std::map<std::array<int, 4>, PairedSums> units;
  const auto add = [&](std::size_t i, const Place& place, PairedSums& unit) {
    double c = 0.0;
    effect.evaluate(geometry, place, &c);
    unit.add(c, (*row_um)[i]);
  };
  const auto is_asked = [&](std::size_t i) {
    const Observation& row = table.rows[i];
    return row.places == 1 && patches.patch_of_row[i] >= 0 && std::isfinite((*row_um)[i]) &&
           table.place(row).surface == Surface::kFlank;
  };
  // Flanks of scans do not ask each other: the same sums on any number of processors.
  const std::size_t scanned = table.points_mm.size(),
                    teeth = static_cast<std::size_t>(geometry.teeth());
  const RowsByClass flanks(scanned, 2 * teeth * table.poses.size(), [&](std::size_t i) {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank || !is_asked(i)) return -1;
    const Place& place = table.place(row);
    return 2 * (row.source * geometry.teeth() + place.tooth - 1) + (place.side > 0 ? 1 : 0);
  });
  std::vector<PairedSums> of_flank(2 * teeth * table.poses.size());
  for_each_piece(of_flank.size(), [&](std::size_t k) {
    flanks.for_each(k, table,
                    [&](std::size_t i) { add(i, table.place(table.rows[i]), of_flank[k]); });
  });
  for (std::size_t k = 0; k < of_flank.size(); ++k)
    if (of_flank[k].n > 0.0)
      units[{static_cast<int>(k / 2 / teeth), -1, static_cast<int>(k / 2 % teeth) + 1,
             k % 2 == 1 ? 1 : -1}] = of_flank[k];
  for (std::size_t i = scanned; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const bool traced =
        row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
    if (!traced || !is_asked(i)) continue;
    const Place& place = table.place(row);
    add(i, place, units[{row.source, row.trace, place.tooth, place.side}]);
  }
  // About its mean: levels differ for reasons of their own.
  double most = 0.0;
  for (const auto& [key, unit] : units) most = std::max(most, unit.square_of_x());
  double n = 0.0, sum = 0.0, squares = 0.0, errors = 0.0;
  for (const auto& [key, unit] : units) {
    const double square = unit.square_of_x(), product = unit.product();
    if (!(square > kShows * most)) continue;
    const double off = product / square;
    n += 1.0;
    sum += off;
    squares += off * off;
    errors +=
        std::max(0.0, unit.square_of_y() - off * product) / std::max(1.0, unit.n - 2.0) / square;
  }
  if (n < kFewest) return 0.0;
  const double variance = (squares - sum * sum / n) / (n - 1.0), error = errors / n;
  if (variance < kBeyondErrors * error) return 0.0;
  const double size = fit.coefficients()[fit.first_column(static_cast<int>(e))];
  return std::sqrt(variance - error) / std::abs(size);
}

}  // namespace

void tell_parts_in_the_mean_of_waves(PartModel& model) {
  constexpr double kGone = 0.25, kAsHigh = 1.25;
  const auto mean = mean_of_waves(model.geometry, *fit_of(model, model.effects));
  if (!mean) return;
  for (std::size_t i = 0; i < mean->effects.size(); ++i) {
    if (std::abs(1.0 - mean->shares[static_cast<Eigen::Index>(i)]) > kGone) continue;
    const std::size_t e = mean->effects[i];
    if (const EffectFamily* form = form_instead(model, e)) model.effects[e].family = form;
  }
  const auto fit = fit_of(model, model.effects);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    if (!model.effects[e].family->named || model.effects[e].family->local ||
        model.effects[e].columns() != 1 || model.effects[e].order() != 0.0 ||
        form_of_level(model, e) == nullptr)
      continue;
    FlankField field = field_of(model.geometry, *fit, e);
    const double all = field.norm();
    take_off_heights(field);
    if (field.norm() < 0.5 * all &&
        all < kAsHigh * mean->level_um * std::sqrt(static_cast<double>(field.size())))
      model.effects[e].family = form_of_level(model, e);
  }
}

Eigen::VectorXd without_means_of_waves(const PartModel& model, const PointFit& fit) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(fit.coefficients().size());
  const auto mean = mean_of_waves(model.geometry, fit);
  for (std::size_t i = 0; mean && i < mean->effects.size(); ++i) {
    const int column = fit.first_column(static_cast<int>(mean->effects[i]));
    change[column] = -mean->shares[static_cast<Eigen::Index>(i)] * fit.coefficients()[column];
  }
  return change;
}

void tell_means_of_one_wave(PartModel& model) {
  constexpr double kCounts = 0.2, kAlike = 0.95, kMostly = 0.8, kLeast = 0.5, kMost = 2.0;
  const auto is_form = [](const Effect& e) {
    return e.is_term() && e.family->form_word.empty() && e.order() > 0.0;
  };
  if (std::none_of(model.effects.begin(), model.effects.end(), is_form)) return;
  const auto fit = fit_of(model, model.effects);
  FlankField around = FlankField::Zero(2 * kGridSide * kGridSide, model.geometry.teeth());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * kGridSide * kGridSide);
  std::vector<std::pair<std::size_t, Eigen::VectorXd>> names;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool named = effect.family->named && !effect.family->local && effect.columns() == 1 &&
                       effect.order() == 0.0 && e >= first_told_here(model);
    if (!named && !is_form(effect)) continue;
    FlankField field = field_of(model.geometry, *fit, e);
    take_off_heights(field);
    if (!named) {
      around += field;
      continue;
    }
    names.emplace_back(e, field.rowwise().mean());
    sum += names.back().second;
  }
  const auto counted = std::count_if(names.begin(), names.end(), [&](const auto& name) {
    return name.second.norm() > kCounts * sum.norm();
  });
  if (counted < 2 || !(around.squaredNorm() > 0.0)) return;
  const MainCourse main = main_course(around, sum);
  const double size = sum.norm() / main.amplitude;
  if (main.share < kMostly || std::abs(main.over_flanks.dot(sum)) < kAlike * sum.norm() ||
      !(size > kLeast && size < kMost))
    return;
  for (const auto& [e, course] : names)
    if (const EffectFamily* form =
            form_instead(model, e) != nullptr ? form_instead(model, e) : form_of_level(model, e))
      model.effects[e].family = form;
}

void tell_means_across_flanks(PartModel& model) {
  if (std::none_of(model.effects.begin(), model.effects.end(),
                   [](const Effect& e) { return e.is_term(); }))
    return;
  const auto fit = fit_of(model, model.effects);
  // Short waves change nothing from one end to the other.
  FlankField forms = FlankField::Zero(2 * kGridSide * kGridSide, model.geometry.teeth());
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (model.effects[e].is_term() && model.effects[e].order() == 0.0 &&
        model.effects[e].columns() == 1 &&
        model.effects[e].family != find_family("unnamed_scallops"))
      forms += field_of(model.geometry, *fit, e);
  const std::array<MeanOfFlank, 2> mean = mean_of_flanks(forms);
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (!model.effects[e].family->named || model.effects[e].family->local ||
        model.effects[e].columns() != 1 || model.effects[e].order() != 0.0 ||
        e < first_told_here(model))
      continue;
    const EffectFamily* form =
        form_instead(model, e) != nullptr ? form_instead(model, e) : form_of_level(model, e);
    if (form != nullptr &&
        is_mean_across(mean_of_flanks(field_of(model.geometry, *fit, e)), mean) &&
        !is_shown_beside(model, e,
                         {{0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 1.0}}))
      model.effects[e].family = form;
  }
}

void tell_what_teeth_do_not_share(PartModel& model) {
  constexpr double kAsMuch = 1.0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const EffectFamily* form = form_instead(model, e);
    if (form == nullptr || model.effects[e].family->local || model.effects[e].columns() != 1 ||
        model.effects[e].order() != 0.0)
      continue;
    if (spread_over_flanks(model.geometry, model.table, model.patches,
                           *fit_of(model, model.effects), e) > kAsMuch)
      model.effects[e].family = form;
  }
}

void tell_means_of_odd_forms(PartModel& model) {
  constexpr double kChanges = 0.5, kShare = 0.3, kCounts = 0.1;
  const auto is_form = [](const Effect& e) {
    return e.is_term() && e.family->form_word.empty() && !e.family->faces_a_direction;
  };
  const auto asked = [&](std::size_t e) {
    return form_instead(model, e) != nullptr && !model.effects[e].family->local &&
           model.effects[e].columns() == 1 && model.effects[e].order() == 0.0;
  };
  bool any_form = false, any_name = false;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    any_form = any_form || is_form(model.effects[e]);
    any_name = any_name || asked(e);
  }
  if (!any_form || !any_name) return;
  const auto fit = fit_of(model, model.effects);
  AroundTheGear around{.sum = FlankField::Zero(2 * kGridSide * kGridSide, model.geometry.teeth()),
                       .orders = {}};
  Eigen::VectorXd crossed = Eigen::VectorXd::Zero(2 * kGridSide * kGridSide);
  std::vector<std::pair<std::size_t, FlankField>> names;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    FlankField field = field_of(model.geometry, *fit, e);
    if (is_form(model.effects[e])) {
      crossed += crossed_part(field);
      const FlankField off = field.colwise() - field.rowwise().mean();
      around.sum += off;
    } else if (asked(e) && shapes_every_tooth(field)) {
      names.emplace_back(e, std::move(field));
    }
  }
  for (const auto& [e, field] : names) {
    // Its course: how high the teeth stand says nothing of it.
    FlankField course = field.col(0);
    take_off_heights(course);
    const Eigen::VectorXd name = course;
    around.orders.clear();
    around.is_no_wave = false;
    for (std::size_t other = 0; other < model.effects.size(); ++other) {
      if (!is_form(model.effects[other])) continue;
      if (change_along(field_of(model.geometry, *fit, other), name) < kCounts) continue;
      if (model.effects[other].order() > 0.0)
        around.orders.insert(model.effects[other].order());
      else
        around.is_no_wave = true;
    }
    const double twist = crossed_part(field).norm();
    const bool is_twist = twist * twist > 0.5 * name.squaredNorm();
    const bool odd = around.is_odd() && change_along(around.sum, name) > kChanges &&
                     (around.is_no_wave || may_have_a_mean(around.sum, name));
    if (odd || (is_twist && crossed.norm() > kShare * twist))
      model.effects[e].family = form_instead(model, e);
  }
}

}  // namespace trueflank::loop
