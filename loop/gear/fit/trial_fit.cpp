// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/trial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/fit/column_products.h"

namespace trueflank::loop {
namespace {

SymmetricSolver decomposed(Eigen::MatrixXd normal) {
  normal.diagonal() *= 1.0 + 1e-12;
  normal.diagonal().array() += 1e-30;
  return SymmetricSolver(normal);
}

/// Of normal equations whose last row and column are the value's.
double square_of(const Eigen::MatrixXd& gram, const Eigen::VectorXd& b) {
  const auto n = b.size();
  return gram(n, n) - 2.0 * b.dot(gram.col(n).head(n)) + b.dot(gram.topLeftCorner(n, n) * b);
}

}  // namespace

TrialFit::TrialFit(const FlankGeometry& geometry, const SharedTable& shared, const Patches& patches,
                   std::vector<Effect> effects, std::size_t stride, FlankCells cells)
    : geometry_(geometry),
      shared_(shared),
      table_(shared_),
      effects_(std::move(effects)),
      cells_(cells) {
  const Observations& table = table_;
  trace_weight_.assign(static_cast<std::size_t>(table.traces), 0.0);
  std::vector<std::uint32_t> rows_asked;
  for (std::size_t i = 0; i < table.rows.size(); i += stride) {
    if (patches.patch_of_row[i] < 0) continue;
    const auto& patch = patches.patches[static_cast<std::size_t>(patches.patch_of_row[i])];
    const double weight = patch.weight / patch.count;
    const int trace = table.rows[i].trace;
    rows_asked.push_back(static_cast<std::uint32_t>(i));
    rows_.push_back({static_cast<std::uint32_t>(i), trace, std::sqrt(weight)});
    if (trace >= 0) trace_weight_[static_cast<std::size_t>(trace)] += weight;
  }
  all_rows_ = row_set(std::move(rows_asked));
  find_runs();
  find_alike(cells);
  const NuisanceColumns nuisance(geometry, table);
  Eigen::Index columns = nuisance.count();
  for (const Effect& effect : effects_) {
    first_column_.push_back(columns);
    columns += effect.columns();
  }
  columns_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), columns + 1);
  Eigen::MatrixXd own =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), nuisance.count() + 1);
  constexpr std::size_t kRowsOfWork = 4096;
  for_each_run(rows_.size(), kRowsOfWork, [&](std::size_t from, std::size_t to) {
    std::vector<double> values(static_cast<std::size_t>(nuisance.count()) + 1);
    for (std::size_t i = from; i < to; ++i) {
      const Observation& row = table.rows[rows_[i].row];
      std::fill(values.begin(), values.end(), 0.0);
      for (std::uint32_t k = 0; k < row.places; ++k) {
        const Place& place = table.places[row.first_place + k];
        nuisance.add(place, row.kind, row.source, row.weight, values.data());
      }
      values.back() = row.deviation_um;
      for (std::size_t k = 0; k < values.size(); ++k)
        own(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[k];
    }
  });
  centre(own);
  columns_.leftCols(nuisance.count()) = own.leftCols(nuisance.count());
  columns_.col(columns) = own.col(nuisance.count());
  std::vector<std::size_t> all(effects_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  put_columns(all);
  if (has_exact_kinds()) {
    gram_ = Eigen::MatrixXd::Zero(columns + 1, columns + 1);
    gram_(columns, columns) = columns_.col(columns).squaredNorm();
    // (nuisance columns are of scans, whose rows are not alike)
    put_products(all);
  } else {
    gram_ = columns_.transpose() * columns_;
  }
  solve();
}

TrialFit::RowSet TrialFit::row_set(std::vector<std::uint32_t> rows) const {
  RowSet set{.rows = std::move(rows), .key = 0, .places = {}, .of_scan = !table_.points_mm.empty()};
  set.key = EffectValues::key_of(set.rows);
  set.places.resize(set.rows.size());
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    const Observation& row = table_.rows[set.rows[i]];
    PlaceOfRow& of_row = set.places[i];
    of_row.is_one = row.places == 1 && row.weight == 1.0;
    set.of_scan = set.of_scan && of_row.is_one;
    if (!of_row.is_one) continue;
    of_row.place = row.first_place;
    const Place& place = table_.places[row.first_place];
    if (place.surface != Surface::kFlank) continue;
    of_row.tooth = place.tooth;
    of_row.flank = flank_of(geometry_, place);
    of_row.side = place.side;
  }
  return set;
}

/// Where it is worth it: of traces, and of scans in cells.
void TrialFit::find_alike(FlankCells cells) {
  constexpr std::size_t kFewestOfAKind = 4;
  const bool scan = !table_.points_mm.empty();
  if (scan && cells.profile == 0) return;
  AlikeRows alike = scan ? rows_of_cells(geometry_, table_, all_rows_.rows, cells)
                         : *shared_.values().alike(table_, all_rows_.rows, all_rows_.key);
  if (alike.first.size() * kFewestOfAKind > rows_.size()) return;
  kind_weight_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(alike.first.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    kind_weight_[static_cast<Eigen::Index>(alike.kind[i])] += rows_[i].root * rows_[i].root;
  first_of_kinds_ = row_set(alike.first);
  alike_ = std::move(alike);
  if (has_exact_kinds()) find_places_on_flanks();
  // Where kinds are few, their products less zeros are one matrix.
  constexpr std::size_t kWorthIt = 8;
  const std::size_t kinds = alike_->first.size();
  if (scan || kinds * kinds > kWorthIt * rows_.size()) return;
  const Eigen::Index n = kind_weight_.size();
  Eigen::MatrixXd of_traces = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(trace_weight_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].trace >= 0)
      of_traces(static_cast<Eigen::Index>(alike_->kind[i]), rows_[i].trace) +=
          rows_[i].root * rows_[i].root;
  Eigen::MatrixXd share = of_traces;
  for (Eigen::Index t = 0; t < share.cols(); ++t)
    if (const double weight = trace_weight_[static_cast<std::size_t>(t)]; weight > 0.0)
      share.col(t) /= weight;
  kind_products_ = -(of_traces * share.transpose());
  kind_products_.diagonal() += kind_weight_;
}

/// Rows of one trace that follow each other, trace by trace.
void TrialFit::find_runs() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int trace = rows_[i].trace;
    root_.push_back(rows_[i].root);
    weight_.push_back(rows_[i].root * rows_[i].root);
    if (trace < 0) continue;
    if (runs_.empty() || runs_.back().trace != trace || runs_.back().end != i)
      runs_.push_back({trace, i, i});
    ++runs_.back().end;
  }
}

/// Weighted means over every trace of value(i) of its rows. Each sum in the order of the rows; it
/// waits for itself alone, and so four traces are summed beside each other.
template <class Value>
void TrialFit::means_of_traces(const Value& value, double* means) const {
  constexpr std::size_t kBeside = 4;
  const auto add = [&](const Run& run, std::size_t from) {
    double sum = means[run.trace];
    for (std::size_t i = run.first + from; i < run.end; ++i) sum += weight_[i] * value(i);
    means[run.trace] = sum;
  };
  std::fill_n(means, trace_weight_.size(), 0.0);
  std::size_t r = 0;
  for (; r + kBeside <= runs_.size(); r += kBeside) {
    const Run* const run = &runs_[r];
    const bool apart = run[0].trace != run[2].trace && run[0].trace != run[3].trace &&
                       run[1].trace != run[3].trace && run[0].trace != run[1].trace &&
                       run[1].trace != run[2].trace && run[2].trace != run[3].trace;
    std::size_t both = 0;
    if (apart) {
      both = std::min({run[0].end - run[0].first, run[1].end - run[1].first,
                       run[2].end - run[2].first, run[3].end - run[3].first});
      double sum[kBeside];
      for (std::size_t j = 0; j < kBeside; ++j) sum[j] = means[run[j].trace];
      for (std::size_t k = 0; k < both; ++k)
        for (std::size_t j = 0; j < kBeside; ++j)
          sum[j] += weight_[run[j].first + k] * value(run[j].first + k);
      for (std::size_t j = 0; j < kBeside; ++j) means[run[j].trace] = sum[j];
    }
    for (std::size_t j = 0; j < kBeside; ++j) add(run[j], both);
  }
  for (; r < runs_.size(); ++r) add(runs_[r], 0);
  for (std::size_t t = 0; t < trace_weight_.size(); ++t)
    if (trace_weight_[t] > 0.0) means[t] /= trace_weight_[t];
}

/// Takes the weighted mean of every trace out and puts the roots of the weights on.
void TrialFit::centre(Eigen::MatrixXd& columns) const {
  std::vector<double> means(trace_weight_.size());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    double* const column = columns.col(k).data();
    if (!runs_.empty()) means_of_traces([&](std::size_t i) { return column[i]; }, means.data());
    for (const Run& run : runs_) {
      const double mean = means[static_cast<std::size_t>(run.trace)];
      for (std::size_t i = run.first; i < run.end; ++i) column[i] -= mean;
    }
    for (std::size_t i = 0; i < root_.size(); ++i) column[i] *= root_[i];
  }
}

/// As they are, at some rows of the table.
EffectValues::Values TrialFit::values_at(const Effect& effect, const RowSet& at) const {
  if (EffectValues::Values known = shared_.values().find(effect, at.key)) return known;
  const auto values = std::make_shared<Eigen::MatrixXd>(
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(at.rows.size()), effect.columns()));
  if (effect.family->product_of_courses.values > 0 && at.of_scan)
    put_product_of_courses(effect, at, *values);
  else if (effect.family->parts) {
    put_product_of_parts(effect, at, *values);
    return values;  // (quickly made of its parts, which are kept)
  } else
    put_values(effect, at, *values);
  shared_.values().keep(effect, at.key, values);
  return values;
}

/// `columns` are zeros: most forms of some teeth or of one flank leave most rows alone.
void TrialFit::put_values(const Effect& effect, const RowSet& at, Eigen::MatrixXd& columns) const {
  const PreparedEffect prepared(geometry_, effect);
  const int count = prepared.columns();
  double one[8];
  for (std::size_t i = 0; i < at.places.size(); ++i) {
    const PlaceOfRow& of_row = at.places[i];
    const auto r = static_cast<Eigen::Index>(i);
    if (of_row.is_one) {
      if (!prepared.acts_on(of_row.tooth, of_row.flank)) continue;
      prepared.evaluate_where_it_acts(table_.places[of_row.place], one);
      for (int k = 0; k < count; ++k) columns(r, k) += one[k];
      continue;
    }
    const Observation& row = table_.rows[at.rows[i]];
    for (std::uint32_t p = 0; p < row.places; ++p) {
      prepared.evaluate(table_.places[row.first_place + p], one);
      for (int k = 0; k < count; ++k) columns(r, k) += row.weight * one[k];
    }
  }
}

/// Courses are kept: most shapes that are tried differ from others in one of them, or in neither.
void TrialFit::put_product_of_courses(const Effect& effect, const RowSet& at,
                                      Eigen::MatrixXd& columns) const {
  const auto& [profile_family, face_family, count] = effect.family->product_of_courses;
  const auto first = effect.shape.begin(), second = first + static_cast<std::ptrdiff_t>(count),
             end = second + static_cast<std::ptrdiff_t>(count);
  const auto profile = values_at({profile_family, FlankChoice::kBoth, {first, second}}, at);
  const auto face = values_at({face_family, FlankChoice::kBoth, {second, end}}, at);
  const bool opposite = *end != 0.0;
  const auto& of_teeth = effect.family->form_times_tooth;
  Eigen::MatrixXd factors = Eigen::MatrixXd::Ones(columns.cols(), geometry_.teeth() + 1);
  for (int tooth = 1; of_teeth && tooth <= geometry_.teeth(); ++tooth)
    of_teeth->tooth(geometry_, tooth, effect.shape, factors.col(tooth).data());
  for (std::size_t i = 0; i < at.places.size(); ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    const PlaceOfRow& place = at.places[i];
    if (place.side == 0 || (*profile)(r) == 0.0) continue;
    if (effect.flank != FlankChoice::kBoth && effect.flank != place.flank) continue;
    const double form = (opposite ? place.side : 1) * (*profile)(r) * (*face)(r);
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      if (const double factor = factors(k, place.tooth); factor != 0.0)
        columns(r, k) = factor * form;
  }
}

/// Parts that are the same on every tooth are asked once for all rows that differ by it alone.
void TrialFit::put_product_of_parts(const Effect& effect, const RowSet& at,
                                    Eigen::MatrixXd& columns) const {
  struct Part {
    EffectValues::Values values;
    const std::uint32_t* kinds = nullptr;  ///< of rows; none: it has a value for each
    [[nodiscard]] double at(std::size_t i) const {
      return (*values)(static_cast<Eigen::Index>(kinds == nullptr ? i : kinds[i]));
    }
  };
  std::vector<Part> parts;
  for (const Effect& part : effect.family->parts(effect.shape)) {
    const bool by_kind = &at == &all_rows_ && has_exact_kinds() && is_of_kinds(part);
    parts.push_back(
        {values_at(part, by_kind ? first_of_kinds_ : at), by_kind ? alike_->kind.data() : nullptr});
  }
  const bool of_values = std::all_of(parts.begin(), parts.end(),
                                     [](const Part& part) { return part.kinds == nullptr; });
  if (at.of_scan && of_values && effect.flank == FlankChoice::kBoth) {
    columns = *parts.front().values;
    for (std::size_t k = 1; k < parts.size(); ++k) columns.array() *= parts[k].values->array();
    columns.array() += 0.0;  // (no zero has a sign)
    return;
  }
  const PreparedEffect prepared(geometry_, effect);
  for (std::size_t i = 0; i < at.places.size(); ++i) {
    double& value = columns(static_cast<Eigen::Index>(i));
    const PlaceOfRow& of_row = at.places[i];
    if (of_row.is_one) {
      double product = parts.front().at(i);
      if (product == 0.0 || !prepared.acts_on(of_row.tooth, of_row.flank)) continue;
      for (std::size_t k = 1; k < parts.size(); ++k) product *= parts[k].at(i);
      value += product;
      continue;
    }
    const Observation& row = table_.rows[at.rows[i]];
    for (std::uint32_t p = 0; p < row.places; ++p) {
      double one = 0.0;
      prepared.evaluate(table_.places[row.first_place + p], &one);
      value += row.weight * one;
    }
  }
}

bool TrialFit::is_of_kinds(const Effect& effect) const {
  return alike_ && effect.family->same_on_every_tooth &&
         effect.family->same_on_every_tooth(effect.shape);
}

TrialFit::Columns TrialFit::short_columns_of(const Effect& effect) const {
  if (is_of_kinds(effect)) return {*values_at(effect, first_of_kinds_), true};
  Eigen::MatrixXd columns;
  if (effect.family->parts) {  // (nobody keeps them: no copy)
    columns = Eigen::MatrixXd::Zero(columns_.rows(), 1);
    put_product_of_parts(effect, all_rows_, columns);
  } else
    columns = *values_at(effect, all_rows_);
  centre(columns);
  return {std::move(columns), false};
}

Eigen::MatrixXd TrialFit::columns_of(const Effect& effect) const {
  if (has_exact_kinds()) return full(short_columns_of(effect));
  Eigen::MatrixXd columns = *values_at(effect, all_rows_);
  centre(columns);
  return columns;
}

/// Means over every trace of columns of kinds of rows: a row a trace.
Eigen::MatrixXd TrialFit::zeros_of_kinds(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd zeros =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(trace_weight_.size()), values.cols());
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const double* const value = values.col(k).data();
    means_of_traces([&](std::size_t i) { return value[alike_->kind[i]]; }, zeros.col(k).data());
  }
  return zeros;
}

/// A row for each value.
Eigen::MatrixXd TrialFit::full(const Columns& columns) const {
  if (!columns.of_kinds) return columns.values;
  const Eigen::MatrixXd zeros = zeros_of_kinds(columns.values);
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows_.size()), columns.values.cols());
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double value = columns.values(static_cast<Eigen::Index>(alike_->kind[i]), k);
      if (rows_[i].trace >= 0) value -= zeros(rows_[i].trace, k);
      all(static_cast<Eigen::Index>(i), k) = rows_[i].root * value;
    }
  return all;
}

/// With all columns that stand, whose zeros are taken out already.
Eigen::MatrixXd TrialFit::products_with_all(const Columns& columns) const {
  Eigen::MatrixXd products(columns_.cols(), columns.values.cols());
  // (of few columns: a product of matrices would copy all the others first)
  for (Eigen::Index k = 0; k < products.cols(); ++k)
    products.col(k).noalias() =
        (columns.of_kinds ? of_kinds_ : columns_).transpose() * columns.values.col(k);
  return products;
}

/// The same of each of several, which have rows for each value.
std::vector<Eigen::MatrixXd> TrialFit::products_of_several(
    const std::vector<Columns>& several) const {
  std::vector<Eigen::MatrixXd> products;
  if (std::any_of(several.begin(), several.end(), [](const Columns& c) { return c.of_kinds; })) {
    for (const Columns& columns : several) products.push_back(products_with_all(columns));
    return products;
  }
  std::vector<const double*> all;
  for (const Columns& columns : several)
    for (Eigen::Index k = 0; k < columns.values.cols(); ++k)
      all.push_back(columns.values.col(k).data());
  const Eigen::MatrixXd of_all = column_products(columns_, all);
  Eigen::Index first = 0;
  for (const Columns& columns : several) {
    products.emplace_back(of_all.middleCols(first, columns.values.cols()));
    first += columns.values.cols();
  }
  return products;
}

/// With each other.
Eigen::MatrixXd TrialFit::own_products(const Columns& columns) const {
  const Eigen::MatrixXd& values = columns.values;
  if (!columns.of_kinds) return values.transpose() * values;
  if (kind_products_.size() > 0) {
    Eigen::MatrixXd crossed(values.rows(), values.cols());
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      crossed.col(k).noalias() = kind_products_ * values.col(k);
    return values.transpose() * crossed;
  }
  const Eigen::MatrixXd zeros = zeros_of_kinds(values);
  const Eigen::Map<const Eigen::VectorXd> weight(trace_weight_.data(), zeros.rows());
  return values.transpose() * kind_weight_.asDiagonal() * values -
         zeros.transpose() * weight.asDiagonal() * zeros;
}

void TrialFit::solve() {
  const Eigen::Index n = gram_.rows() - 1;
  coefficients_ = decomposed(gram_.topLeftCorner(n, n)).solve(gram_.col(n).head(n));
  square_ = square_of(gram_, coefficients_);
}

Eigen::VectorXd TrialFit::coefficients(std::size_t effect) const {
  return coefficients_.segment(first_column_[effect], effects_[effect].columns());
}

/// Normal equations of all columns but an effect's. What its own columns add follows from their products with
/// these alone.
struct TrialFit::Others {
  Others(const Eigen::MatrixXd& gram, Eigen::Index first, Eigen::Index columns) {
    const Eigen::Index n = gram.rows() - 1;
    for (Eigen::Index k = 0; k < n; ++k)
      if (k < first || k >= first + columns) places.push_back(k);
    const Eigen::VectorXd right = gram(places, n);
    solver.emplace(decomposed(gram(places, places)));
    coefficients = solver->solve(right);
    square = gram(n, n) - right.dot(coefficients);
  }
  /// With columns of these products with all, and with each other.
  [[nodiscard]] Trial with(const Eigen::MatrixXd& products, Eigen::MatrixXd own, double below) const {
    const Eigen::MatrixXd crossed = products(places, Eigen::all);
    const Eigen::MatrixXd absorbed = solver->solve_columns(crossed);
    const Eigen::VectorXd right =
        products.bottomRows(1).transpose() - crossed.transpose() * coefficients;
    const Eigen::VectorXd whole = own.diagonal();
    own.diagonal() *= 1.0 + 1e-12;
    own.diagonal().array() += 1e-30;
    own -= crossed.transpose() * absorbed;
    const SymmetricSolver left(own);
    Trial result{square - right.dot(left.solve(right)), 0.0};
    if (!(result.square < below)) return result;
    result.retained = 1.0;
    const Eigen::MatrixXd inverse =
        left.solve_columns(Eigen::MatrixXd::Identity(own.rows(), own.rows()));
    for (Eigen::Index k = 0; k < own.rows(); ++k)
      result.retained =
          whole[k] > 0.0 ? std::min(result.retained, 1.0 / (inverse(k, k) * whole[k])) : 0.0;
    return result;
  }

  std::vector<Eigen::Index> places;
  std::optional<SymmetricSolver> solver;
  Eigen::VectorXd coefficients;
  double square = 0.0;
};

TrialFit::Trial TrialFit::as_is(std::size_t effect) const {
  const Eigen::Index first = first_column_[effect], count = effects_[effect].columns();
  return Others(gram_, first, count)
      .with(gram_.middleCols(first, count), gram_.block(first, first, count, count),
            std::numeric_limits<double>::infinity());
}

/// Puts the columns of effects where they belong.
void TrialFit::put_columns(const std::vector<std::size_t>& effects) {
  for_each_piece(effects.size(), [&](std::size_t i) {
    const std::size_t e = effects[i];
    columns_.middleCols(first_column_[e], effects_[e].columns()) = columns_of(effects_[e]);
  });
  if (!alike_) return;
  if (of_kinds_.size() == 0) {
    of_kinds_.resize(kind_weight_.size(), columns_.cols());
    sum_over_kinds(0, columns_.cols());
    return;
  }
  for (const std::size_t e : effects) sum_over_kinds(first_column_[e], effects_[e].columns());
}

void TrialFit::sum_over_kinds(Eigen::Index first, Eigen::Index count) {
  for (Eigen::Index k = first; k < first + count; ++k) {
    auto sums = of_kinds_.col(k);
    sums.setZero();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      sums[static_cast<Eigen::Index>(alike_->kind[i])] +=
          rows_[i].root * columns_(static_cast<Eigen::Index>(i), k);
  }
}

/// Products of effects' columns as they stand.
void TrialFit::put_products(const std::vector<std::size_t>& effects) {
  for (const std::size_t e : effects) {
    const Eigen::Index first = first_column_[e], count = effects_[e].columns();
    if (has_exact_kinds() && is_of_kinds(effects_[e]))
      gram_.middleCols(first, count) =
          products_with_all({*values_at(effects_[e], first_of_kinds_), true});
    else
      gram_.middleCols(first, count) = columns_.transpose() * columns_.middleCols(first, count);
    // (a copy: a first effect's rows and columns begin at the same place)
    gram_.middleRows(first, count) = gram_.middleCols(first, count).transpose().eval();
  }
}

std::vector<TrialFit::Trial> TrialFit::with_shapes(std::size_t effect,
                                                   const std::vector<EffectShape>& shapes,
                                                   double below) const {
  std::vector<Trial> trials(shapes.size());
  const Others others(gram_, first_column_[effect], effects_[effect].columns());
  if (is_form_times_tooth(effects_[effect])) {
    for_forms_times_teeth(effects_[effect], shapes,
                          [&](std::size_t i, const Eigen::MatrixXd& products, Eigen::MatrixXd own) {
                            trials[i] = others.with(products, std::move(own), below);
                          });
    return trials;
  }
  const auto moved_to = [&](const EffectShape& shape) {
    return Effect{effects_[effect].family, effects_[effect].flank, shape};
  };
  // Of kinds of rows they take less than a thread does to begin.
  if (is_of_kinds(effects_[effect])) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Columns columns = short_columns_of(moved_to(shapes[i]));
      trials[i] = others.with(products_with_all(columns), own_products(columns), below);
    }
    return trials;
  }
  // Some together, as the columns that stand are read once for them.
  constexpr std::size_t kMostTogether = 8;
  const std::size_t together =
      std::clamp<std::size_t>(shapes.size() / (2 * processors()), 1, kMostTogether);
  for_each_run(shapes.size(), together, [&](std::size_t from, std::size_t to) {
    std::vector<Columns> columns;
    for (std::size_t i = from; i < to; ++i)
      columns.push_back(short_columns_of(moved_to(shapes[i])));
    std::vector<Eigen::MatrixXd> products = products_of_several(columns);
    for (std::size_t i = from; i < to; ++i)
      trials[i] = others.with(products[i - from], own_products(columns[i - from]), below);
  });
  return trials;
}

void TrialFit::set_shapes(const std::vector<Effect>& effects) {
  std::vector<std::size_t> moved;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (effects[e].shape == effects_[e].shape) continue;
    effects_[e].shape = effects[e].shape;
    moved.push_back(e);
  }
  if (moved.empty()) return;
  put_columns(moved);
  put_products(moved);
  solve();
}

bool TrialFit::put_effect(std::size_t effect, const Effect& other, FlankCells cells) {
  const bool in_cells = table_.points_mm.empty() || cells == cells_;
  if (effects_[effect] == other && in_cells) return true;
  if (!in_cells || effect + 1 != effects_.size() || effects_[effect].columns() != other.columns())
    return false;
  effects_[effect] = other;
  put_columns({effect});
  if (has_exact_kinds())
    put_products({effect});
  else
    gram_ = columns_.transpose() * columns_;
  solve();
  return true;
}

Eigen::VectorXd TrialFit::joint_coefficients(const std::vector<Change>& more) const {
  const Eigen::Index n = gram_.rows() - 1, m = static_cast<Eigen::Index>(more.size());
  Columns columns{
      {}, has_exact_kinds() && std::all_of(more.begin(), more.end(), [&](const Change& change) {
            return is_of_kinds(change.from) && is_of_kinds(change.to);
          })};
  columns.values.resize(columns.of_kinds ? kind_weight_.size() : columns_.rows(), m);
  for_each_piece(more.size(), [&](std::size_t i) {
    const Change& change = more[i];
    const auto of = [&](const Effect& effect) {
      return columns.of_kinds ? *values_at(effect, first_of_kinds_) : columns_of(effect);
    };
    columns.values.col(static_cast<Eigen::Index>(i)) =
        of(change.to) * change.coefficients - of(change.from) * change.coefficients;
  });
  const Eigen::MatrixXd cross = products_with_all(columns);  // the value's row last
  Eigen::MatrixXd normal(n + m, n + m);
  normal.topLeftCorner(n, n) = gram_.topLeftCorner(n, n);
  normal.topRightCorner(n, m) = cross.topRows(n);
  normal.bottomLeftCorner(m, n) = cross.topRows(n).transpose();
  normal.bottomRightCorner(m, m) = own_products(columns);
  Eigen::VectorXd right(n + m);
  right << gram_.col(n).head(n), cross.row(n).transpose();
  return decomposed(std::move(normal)).solve(right).tail(m);
}

}  // namespace trueflank::loop
