// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/scans/states_scan.h"

namespace trueflank::loop {
namespace {

/// Columns may differ by many powers of ten: solved with unit diagonal.
Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right) {
  if (right.size() == 0) return right;
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd unit = scale.asDiagonal() * gram * scale.asDiagonal();
  unit.diagonal().array() += 1e-12;
  return scale.asDiagonal() * symmetric_solution(unit, scale.asDiagonal() * right);
}

/// Units as the engine flips them: of very many those of a fold are counted round, so that
/// neighbours stay apart. Sums of independent symmetric errors are such errors again, and a
/// thousand signs tell as much as all.
int unit_to_flip(const BenchTable& table, const BenchPoint& p) {
  constexpr int kOfAFold = 160;
  if (table.units <= kOfAFold * (kBenchFolds + 1)) return p.unit;
  return p.fold * kOfAFold + p.unit % kOfAFold;
}

}  // namespace

DriveFit::DriveFit(const DriveContext& context, const Eigen::VectorXd& value,
                   std::vector<DriveEffect> effects, FitRows rows)
    : DriveFit(context, value, std::move(effects), rows, nullptr) {}

DriveFit::DriveFit(const DriveFit& known, std::vector<DriveEffect> effects)
    : DriveFit(known.context_, known.value_, std::move(effects), known.rows_, &known) {}

DriveFit::DriveFit(const DriveContext& context, const Eigen::VectorXd& value,
                   std::vector<DriveEffect> effects, FitRows rows, const DriveFit* known)
    : context_(context), value_(value), effects_(std::move(effects)), rows_(rows) {
  int columns = 0;
  for (const DriveEffect& effect : effects_) {
    first_column_.push_back(columns);
    columns += effect.columns();
  }
  for (const DriveEffect& effect : effects_) {
    shape_column_.emplace_back();
    // (what has as many values as the data ask for has none that moves)
    const auto& values = effect.family->shape_values;
    for (std::size_t k = 0; k < effect.shape.size(); ++k)
      shape_column_.back().push_back(k < values.size() && values[k].continuous ? columns + shapes_++
                                                                               : -1);
  }
  columns_.resize(static_cast<Eigen::Index>(context_.table.points.size()), columns);
  fill_columns(known);
  coefficients_ = without(std::vector<bool>(effects_.size(), false));
  const Eigen::VectorXd left = value_ - columns_ * coefficients_;
  residual_square_ = (weight_.array() * left.array().square()).sum();
}

bool DriveFit::sees(int point) const {
  return rows_ == FitRows::kAll || context_.table.points[point].fold != 0;
}

void DriveFit::fill_columns(const DriveFit* known) {
  const auto& points = context_.table.points;
  std::vector<std::size_t> asked;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (known == nullptr || e >= known->effects_.size() ||
        known->effects_[e].family != effects_[e].family ||
        known->effects_[e].shape != effects_[e].shape) {
      asked.push_back(e);
      continue;
    }
    columns_.middleCols(first_column_[e], effects_[e].columns()) =
        known->columns_.middleCols(known->first_column_[e], effects_[e].columns());
  }
  weight_.resize(static_cast<Eigen::Index>(points.size()));
  std::vector<double> values(16);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    weight_[row] =
        sees(static_cast<int>(i)) ? 1.0 / (points[i].sigma_nm * points[i].sigma_nm) : 0.0;
    for (const std::size_t e : asked) {
      effects_[e].family->evaluate(context_, points[i], effects_[e].shape, values.data());
      for (int k = 0; k < effects_[e].columns(); ++k)
        columns_(row, first_column_[e] + k) = values[k];
    }
  }
}

Eigen::VectorXd DriveFit::explained_nm(int effect) const {
  const int first = first_column_[effect], count = effects_[effect].columns();
  return columns_.middleCols(first, count) * coefficients_.segment(first, count);
}

Eigen::VectorXd DriveFit::without(const std::vector<bool>& left_out) const {
  std::vector<int> kept;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    for (int k = 0; k < effects_[e].columns() && !left_out[e]; ++k)
      kept.push_back(first_column_[e] + k);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(columns_.cols());
  if (kept.empty()) return result;
  const Eigen::MatrixXd x = columns_(Eigen::all, kept);
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * x;
  result(kept) = solve_scaled(x.transpose() * weighted, weighted.transpose() * value_);
  return result;
}

Eigen::VectorXd DriveFit::fold_errors() const {
  const auto& points = context_.table.points;
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(kBenchFolds);
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * columns_;
  const Eigen::MatrixXd gram = columns_.transpose() * weighted;
  const Eigen::VectorXd right = weighted.transpose() * value_;
  for (int fold = 1; fold <= kBenchFolds; ++fold) {
    Eigen::MatrixXd g = gram;
    Eigen::VectorXd r = right;
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].fold != fold) continue;
      const auto row = static_cast<Eigen::Index>(i);
      rows.push_back(row);
      g -= weighted.row(row).transpose() * columns_.row(row);
      r -= weighted.row(row).transpose() * value_[row];
    }
    const Eigen::VectorXd b = solve_scaled(g, r);
    for (const Eigen::Index row : rows) {
      const double left = value_[row] - (b.size() > 0 ? columns_.row(row).dot(b) : 0.0);
      errors[fold - 1] += weight_[row] * left * left;
    }
  }
  return errors;
}

/// Change of the explained torque per unit of every continuous shape value.
Eigen::MatrixXd DriveFit::shape_slopes() const {
  const auto& points = context_.table.points;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), shapes_);
  std::vector<double> low(16), high(16);
  for (std::size_t e = 0; e < effects_.size(); ++e)
    for (std::size_t k = 0; k < effects_[e].shape.size(); ++k) {
      const int column = shape_column_[e][k];
      if (column < 0) continue;
      std::vector<double> below = effects_[e].shape, above = below;
      const double step = 1e-4 * std::abs(below[k]) + 1e-12;
      below[k] -= step;
      above[k] += step;
      for (std::size_t i = 0; i < points.size(); ++i) {
        effects_[e].family->evaluate(context_, points[i], below, low.data());
        effects_[e].family->evaluate(context_, points[i], above, high.data());
        double slope = 0.0;
        for (int c = 0; c < effects_[e].columns(); ++c)
          slope += coefficients_[first_column_[e] + c] * (high[c] - low[c]) / (2.0 * step);
        slopes(static_cast<Eigen::Index>(i), column - columns_.cols()) = slope;
      }
    }
  return slopes;
}

DriveState DriveFit::state_at(const Eigen::VectorXd& coefficients) const {
  DriveState state;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (effects_[e].family->into_state)
      effects_[e].family->into_state(state, effects_[e].shape, coefficients[first_column_[e]]);
  return state;
}

Eigen::MatrixXd DriveFit::coefficient_slopes() const {
  constexpr double kStep = 0.01;  // of the coefficient
  const auto& points = context_.table.points;
  std::vector<double> values(16);
  const auto explained_at = [&](const Eigen::VectorXd& b) {
    const DriveContext there = context_.in_state(state_at(b));
    Eigen::VectorXd explained = Eigen::VectorXd::Zero(columns_.rows());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t e = 0; e < effects_.size(); ++e) {
        effects_[e].family->evaluate(there, points[i], effects_[e].shape, values.data());
        for (int k = 0; k < effects_[e].columns(); ++k)
          explained[static_cast<Eigen::Index>(i)] +=
              values[static_cast<std::size_t>(k)] * b[first_column_[e] + k];
      }
    return explained;
  };
  Eigen::MatrixXd slopes = columns_;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const int column = first_column_[e];
    const double step = kStep * std::abs(coefficients_[column]);
    if (!effects_[e].family->into_state || !(step > 0.0)) continue;
    Eigen::VectorXd low = coefficients_, high = coefficients_;
    low[column] -= step;
    high[column] += step;
    slopes.col(column) = (explained_at(high) - explained_at(low)) / (2.0 * step);
  }
  return slopes;
}

Eigen::MatrixXd DriveFit::covariance() const {
  const auto& points = context_.table.points;
  Eigen::MatrixXd x(columns_.rows(), columns_.cols() + shapes_);
  x << coefficient_slopes(), shape_slopes();
  const auto p = x.cols();
  const Eigen::VectorXd left = value_ - columns_ * coefficients_;
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * x;
  const Eigen::MatrixXd gram = x.transpose() * weighted;
  std::map<int, std::vector<Eigen::Index>> units;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (sees(static_cast<int>(i))) units[points[i].unit].push_back(static_cast<Eigen::Index>(i));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p, p);
  for (const auto& [unit, rows] : units) {
    const Eigen::MatrixXd part = x(rows, Eigen::all), part_weighted = weighted(rows, Eigen::all);
    const Eigen::VectorXd change = solve_scaled(gram - part.transpose() * part_weighted,
                                                part_weighted.transpose() * left(rows));
    covariance += change * change.transpose();
  }
  const double n = static_cast<double>(units.size());
  return covariance * ((n - 1.0) / n);
}

double DriveFit::degrees() const {
  std::map<int, int> units;
  const auto& points = context_.table.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (sees(static_cast<int>(i))) units[points[i].unit] = 1;
  return std::max(
      1.0, static_cast<double>(units.size()) - static_cast<double>(columns_.cols() + shapes_));
}

namespace {

/// Both ends of a part of a run or a turn, by degrees and by tenths: the sum of squares falls there
/// in steps, one for every row.
void refine_ends(const DriveContext& context, const Eigen::VectorXd& value, FitRows rows,
                 std::vector<DriveEffect>& effects, std::size_t effect) {
  constexpr std::size_t kBegin = 2, kLength = 3;
  constexpr int kFar = 10;
  const DriveFit begun(context, value, effects, rows);
  DriveShape& shape = effects[effect].shape;
  for (const double step : {1.0 / 360.0, 1.0 / 3600.0})
    for (const bool begin : {true, false}) {
      const DriveShape from = shape;
      DriveShape best = from;
      double least = 1e300;
      // from where it is outwards: of ends that do the same the nearest
      for (int k = 0; k <= 2 * kFar; ++k) {
        const double by = step * (k % 2 == 0 ? k / 2 : -(k + 1) / 2);
        shape = from;
        if (begin) shape[kBegin] += by;
        shape[kLength] += begin ? -by : by;
        if (shape[kLength] < step || shape[kLength] > 1.0) continue;
        const double square = DriveFit(begun, effects).residual_square();
        if (square >= least * (1.0 - 1e-9)) continue;
        least = square;
        best = shape;
      }
      shape = best;
    }
}

/// When it is there and when not, by these rows, beside the other effects as the fit has them.
DriveShape states_beside(const DriveContext& context, const Eigen::VectorXd& value,
                         const DriveFit& fit, std::size_t effect, FitRows rows) {
  const DriveEffect& states = fit.effects()[effect];
  const Eigen::VectorXd left =
      value - fit.explained_nm() + fit.explained_nm(static_cast<int>(effect));
  const DriveShape& shape = states.shape;
  return states.family->shape_of_states(
      shape[0], changes_of_states(context, left, shape[0], rows, {shape.begin() + 1, shape.end()}));
}

/// The levels of the run by the fit's rows, and the changes where these rows say, beside the other
/// effects as the fit has them.
DriveShape levels_beside_fit(const DriveContext& context, const Eigen::VectorXd& value,
                             const DriveFit& fit, std::size_t effect, FitRows rows_of_changes,
                             FitRows rows_of_levels) {
  const DriveEffect& levels = fit.effects()[effect];
  const Eigen::VectorXd left =
      value - fit.explained_nm() + fit.explained_nm(static_cast<int>(effect));
  const auto first = levels.shape.begin() + 1;
  const auto count = static_cast<std::ptrdiff_t>((levels.shape.size() - 1) / 2);
  const LevelsOfRun moved =
      levels_beside(context, left, levels.shape[0], rows_of_changes, {first, first + count});
  if (moved.changes.empty()) return levels.shape;
  const LevelsOfRun seen =
      rows_of_levels == rows_of_changes
          ? moved
          : levels_as_cut(context, left, levels.shape[0], rows_of_levels, moved.changes);
  if (seen.changes.empty()) return levels.shape;
  return levels.family->shape_of_levels(levels.shape[0], moved.changes, seen.levels);
}

/// A jump between two rows that the fit saw may be anywhere between them: where those that are
/// locked away say. The fit is the same.
DriveShape jump_beside_all(const DriveContext& context, const Eigen::VectorXd& value,
                           const std::vector<DriveEffect>& effects, std::size_t effect) {
  const auto& points = context.table.points;
  const DriveFit fit(context, value, effects, FitRows::kTraining);
  const Eigen::VectorXd left =
      value - fit.explained_nm() + fit.explained_nm(static_cast<int>(effect));
  const double amount = fit.coefficients()[fit.first_column(static_cast<int>(effect))];
  const auto after = std::find_if(points.begin(), points.end(), [&](const BenchPoint& p) {
    return 2.0 * p.taken - 1.0 > effects[effect].shape[1];
  });
  auto first = after, last = after;  // of the rows about it that were locked away
  while (first != points.begin() && std::prev(first)->fold == 0) --first;
  while (last != points.end() && last->fold == 0) ++last;
  DriveShape best = effects[effect].shape, shape = best;
  if (first == last) return best;
  double least = 1e300;
  for (auto at = first;; ++at) {
    if (at != points.begin() && at != points.end()) {
      shape[1] = std::prev(at)->taken + at->taken - 1.0;
      double square = 0.0, one = 0.0;
      for (auto p = first; p != last; ++p) {
        effects[effect].family->evaluate(context, *p, shape, &one);
        const double off = (left[p - points.begin()] - amount * one) / p->sigma_nm;
        square += off * off;
      }
      if (square < least) {
        least = square;
        best = shape;
      }
    }
    if (at == last) break;
  }
  return best;
}

/// A step over a quantity between two rows that the fit saw may be anywhere between them: where
/// those that are locked away say. The fit is the same.
DriveShape step_beside_all(const DriveContext& context, const Eigen::VectorXd& value,
                           const std::vector<DriveEffect>& effects, std::size_t effect) {
  const auto& points = context.table.points;
  const DriveFamily& family = *effects[effect].family;
  const DriveFit fit(context, value, effects, FitRows::kTraining);
  const Eigen::VectorXd left =
      value - fit.explained_nm() + fit.explained_nm(static_cast<int>(effect));
  const double amount = fit.coefficients()[fit.first_column(static_cast<int>(effect))];
  DriveShape best = effects[effect].shape;
  double least = 1e300;
  std::vector<DriveShape> shapes{best};
  for (DriveShape& shape : family.all_shapes(context, &best)) shapes.push_back(std::move(shape));
  for (const DriveShape& shape : shapes) {
    double square = 0.0, here = 0.0, there = 0.0;
    bool same = true;
    for (std::size_t i = 0; i < points.size() && same; ++i) {
      family.evaluate(context, points[i], shape, &here);
      family.evaluate(context, points[i], shapes.front(), &there);
      if (points[i].fold != 0) {
        same = here == there;
        continue;
      }
      const double off = (left[static_cast<Eigen::Index>(i)] - amount * here) / points[i].sigma_nm;
      square += off * off;
    }
    if (!same || square >= least) continue;
    least = square;
    best = shape;
  }
  return best;
}

}  // namespace

void refine_drive_shapes(const DriveContext& context, const Eigen::VectorXd& value, FitRows rows,
                         std::vector<DriveEffect>& effects) {
  // One shape value after the other, by golden section about where it is: few, and never far.
  constexpr double kGolden = 0.3819660112501051;
  for (int round = 0; round < 3; ++round)
    for (std::size_t e = 0; e < effects.size(); ++e) {
      if (effects[e].family->shape_of_spell) {
        if (round == 0) refine_ends(context, value, rows, effects, e);
        continue;
      }
      if (effects[e].family->shape_of_states) {
        if (round == 0)
          effects[e].shape =
              states_beside(context, value, DriveFit(context, value, effects, rows), e, rows);
        continue;
      }
      if (effects[e].family->shape_of_levels) {
        if (round == 0)
          effects[e].shape = levels_beside_fit(
              context, value, DriveFit(context, value, effects, rows), e, rows, rows);
        continue;
      }
      // (rows of the run may follow the values that are known)
      const std::vector<DriveShapeValue>& values = effects[e].family->shape_values;
      for (std::size_t k = 0; k < std::min(effects[e].shape.size(), values.size()); ++k) {
        const DriveShapeValue& value_of_shape = values[k];
        if (!value_of_shape.continuous) continue;
        const double here = effects[e].shape[k];
        const DriveFit begun(context, value, effects, rows);
        const auto square = [&](double shape) {
          effects[e].shape[k] = shape;
          return DriveFit(begun, effects).residual_square();
        };
        const double square_here = begun.residual_square();
        const double spread = round == 0 ? 1.7 : 1.25;
        double low = here / spread, high = here * spread;
        if (value_of_shape.is_place) {
          low = here - value_of_shape.reach * (spread - 1.0);
          high = here + value_of_shape.reach * (spread - 1.0);
        }
        if (value_of_shape.limits) {
          const auto [least, most] = value_of_shape.limits(context);
          low = std::clamp(low, least, most);
          high = std::clamp(high, low, most);
        }
        double a = low + kGolden * (high - low), b = high - kGolden * (high - low);
        double at_a = square(a), at_b = square(b);
        for (int i = 0; i < 16; ++i) {
          if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            at_a = square(a = low + kGolden * (high - low));
          } else {
            low = a;
            a = b;
            at_a = at_b;
            at_b = square(b = high - kGolden * (high - low));
          }
        }
        // Of a sum that falls in steps it may end beside the lowest; of one that is flat, as what
        // is nothing at a place beside a constant makes it, anywhere.
        constexpr double kFlat = 1e-8;
        if (const double at_end = square(0.5 * (low + high)); at_end > square_here * (1.0 - kFlat))
          effects[e].shape[k] = here;
      }
    }
}

std::vector<DriveEffect> with_states_of_all_rows(const DriveContext& context,
                                                 const Eigen::VectorXd& value,
                                                 std::vector<DriveEffect> effects) {
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (effects[e].family->shape_of_states)
      effects[e].shape = states_beside(
          context, value, DriveFit(context, value, effects, FitRows::kTraining), e, FitRows::kAll);
    if (effects[e].family->shape_of_levels)
      effects[e].shape =
          levels_beside_fit(context, value, DriveFit(context, value, effects, FitRows::kTraining),
                            e, FitRows::kAll, FitRows::kTraining);
    if (effects[e].family->jumps_in_run)
      effects[e].shape = jump_beside_all(context, value, effects, e);
    else if (effects[e].family->falls_in_steps && effects[e].family->all_shapes)
      effects[e].shape = step_beside_all(context, value, effects, e);
  }
  return effects;
}

const DiscoveryProblem& DriveProblem::made_for(const DriveContext& context,
                                               const Eigen::VectorXd& value,
                                               const std::vector<DriveEffect>& candidates) {
  const std::vector<std::size_t> groups = changed(context.state, candidates);
  const bool laid_out = candidates_.size() == candidates.size();
  candidates_ = candidates;
  state_ = context.state;
  if (!laid_out) lay_out(context, value);
  fill(context, groups);
  return problem_;
}

std::vector<std::size_t> DriveProblem::changed(const DriveState& state,
                                               const std::vector<DriveEffect>& candidates) const {
  const bool all = candidates_.size() != candidates.size() || !(state == state_);
  std::vector<std::size_t> groups;
  for (std::size_t g = 0; g < candidates.size(); ++g)
    if (all || candidates[g].family != candidates_[g].family ||
        candidates[g].shape != candidates_[g].shape)
      groups.push_back(g);
  return groups;
}

void DriveProblem::lay_out(const DriveContext& context, const Eigen::VectorXd& value) {
  const auto& points = context.table.points;
  const auto n = static_cast<Eigen::Index>(points.size());
  problem_ = {};
  problem_.value = value;
  problem_.weight.resize(n);
  problem_.nuisance.resize(n, 0);
  problem_.zero.assign(points.size(), -1);
  std::map<const DriveFamily*, int> kin;
  int columns = 0;
  for (const DriveEffect& candidate : candidates_) {
    CandidateGroup group;
    group.first_column = columns;
    group.columns = candidate.columns();
    group.preference = candidate.family->preference;
    const bool shaped =
        std::any_of(candidate.family->shape_values.begin(), candidate.family->shape_values.end(),
                    [](const DriveShapeValue& shape) { return shape.continuous; });
    if (shaped) group.kin = kin.emplace(candidate.family, static_cast<int>(kin.size())).first->second;
    columns += group.columns;
    problem_.groups.push_back(group);
  }
  problem_.candidates.resize(n, columns);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BenchPoint& p = points[static_cast<std::size_t>(i)];
    problem_.weight[i] = 1.0 / (p.sigma_nm * p.sigma_nm);
    problem_.unit.push_back(unit_to_flip(context.table, p));
    problem_.fold.push_back(p.fold);
  }
}

void DriveProblem::fill(const DriveContext& context, const std::vector<std::size_t>& groups) {
  const auto& points = context.table.points;
  const auto n = static_cast<Eigen::Index>(points.size());
  std::vector<double> values(16);
  for (Eigen::Index i = 0; i < n; ++i)
    for (const std::size_t g : groups) {
      candidates_[g].family->evaluate(context, points[static_cast<std::size_t>(i)], candidates_[g].shape,
                                      values.data());
      for (int k = 0; k < problem_.groups[g].columns; ++k)
        problem_.candidates(i, problem_.groups[g].first_column + k) = static_cast<float>(values[k]);
    }
  // Columns of one size: the engine's small ridges are relative to none of ours.
  for (const std::size_t g : groups)
    for (int k = 0; k < problem_.groups[g].columns; ++k) {
      auto column = problem_.candidates.col(problem_.groups[g].first_column + k);
      const double size =
          std::sqrt((problem_.weight.array() * column.cast<double>().array().square()).sum() /
                    std::max<double>(1.0, static_cast<double>(n)));
      if (size > 0.0) column /= static_cast<float>(size);
    }
}

}  // namespace trueflank::loop
