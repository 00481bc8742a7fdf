// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that are a form, the same on every tooth, times a factor of each tooth: with sums of the
// form over every tooth a trial takes as many products as there are teeth, not values.
#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/fit/trial_fit.h"

namespace trueflank::loop {

/// A form on every tooth: a row a tooth, the first one of none.
struct TrialFit::FormOnTeeth {
  std::vector<double> values;  ///< at places_of_kinds_
  Eigen::MatrixXd with_all;    ///< products with the columns that stand
  Eigen::MatrixXd own;         ///< of the form on two teeth, zeros of traces taken out
  Eigen::VectorXd whole;       ///< of the form on a tooth, before they were
};

/// The places of kinds, and where each of them stands among the rows.
void TrialFit::find_places_on_flanks() {
  const std::size_t kinds = alike_->first.size();
  for (const std::uint32_t first : alike_->first)
    places_of_kinds_.push_back(table_.rows[first].first_place);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Observation& row = table_.rows[rows_[i].row];
    for (std::uint32_t p = 0; p < row.places; ++p) {
      const Place& place = table_.places[row.first_place + p];
      if (place.surface != Surface::kFlank) continue;
      const std::uint32_t kind =
          row.places == 1 ? alike_->kind[i] : static_cast<std::uint32_t>(places_of_kinds_.size());
      if (kind >= kinds) places_of_kinds_.push_back(row.first_place + p);
      on_flanks_.push_back({static_cast<std::uint32_t>(i), kind, place.tooth});
    }
  }
}

bool TrialFit::is_form_times_tooth(const Effect& effect) const {
  return has_exact_kinds() && effect.family->form_times_tooth;
}

std::vector<double> TrialFit::form_of(const Effect& effect) const {
  std::vector<double> values(places_of_kinds_.size(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Place& place = table_.places[places_of_kinds_[k]];
    if (place.surface == Surface::kFlank && effect.acts_on_flank_of(geometry_, place))
      values[k] = effect.family->form_times_tooth->form(geometry_, place, effect.shape);
  }
  return values;
}

/// Sums over every tooth of what a form adds to it times neighbouring columns, beside each other:
/// each waits for itself alone.
template <int count>
void TrialFit::add_over_teeth(const std::vector<double>& rooted, Eigen::Index first,
                              Eigen::MatrixXd& sums) const {
  const double* columns[count];
  for (int c = 0; c < count; ++c) columns[c] = columns_.col(first + c).data();
  for (std::size_t k = 0; k < on_flanks_.size();) {  // a tooth's rows mostly follow each other
    const int tooth = on_flanks_[k].tooth;
    double sum[count] = {};
    for (; k < on_flanks_.size() && on_flanks_[k].tooth == tooth; ++k)
      for (int c = 0; c < count; ++c) sum[c] += rooted[k] * columns[c][on_flanks_[k].row];
    for (int c = 0; c < count; ++c) sums(tooth, first + c) += sum[c];
  }
}

void TrialFit::sum_up(FormOnTeeth& form) const {
  constexpr int kBeside = 6;
  const Eigen::Index teeth = geometry_.teeth() + 1;
  form.with_all = Eigen::MatrixXd::Zero(teeth, columns_.cols());
  form.own = Eigen::MatrixXd::Zero(teeth, teeth);
  form.whole = Eigen::VectorXd::Zero(teeth);
  // Of a value: what the form adds to it on each tooth, times the root of its weight.
  std::vector<double> rooted(on_flanks_.size());
  for (std::size_t k = 0; k < on_flanks_.size(); ++k) {
    const Row& row = rows_[on_flanks_[k].row];
    rooted[k] = row.root * table_.rows[row.row].weight * form.values[on_flanks_[k].kind];
  }
  Eigen::Index column = 0;
  for (; column + kBeside <= columns_.cols(); column += kBeside)
    add_over_teeth<kBeside>(rooted, column, form.with_all);
  for (; column < columns_.cols(); ++column) add_over_teeth<1>(rooted, column, form.with_all);
  // Weighted sums of every trace, by tooth: its zero takes its share of them.
  std::vector<std::vector<std::pair<int, double>>> of_traces(trace_weight_.size());
  for (std::size_t k = 0; k < on_flanks_.size();) {
    const Row& row = rows_[on_flanks_[k].row];
    const std::size_t first = k;
    for (; k < on_flanks_.size() && on_flanks_[k].row == on_flanks_[first].row; ++k) {
      const int tooth = on_flanks_[k].tooth;
      form.whole[tooth] += rooted[k] * rooted[k];
      for (std::size_t other = first; other <= k; ++other) {
        const double product = rooted[k] * rooted[other];
        form.own(tooth, on_flanks_[other].tooth) += product;
        if (other != k) form.own(on_flanks_[other].tooth, tooth) += product;
      }
      if (row.trace < 0) continue;
      auto& sums = of_traces[static_cast<std::size_t>(row.trace)];
      if (sums.empty() || sums.back().first != tooth) sums.emplace_back(tooth, 0.0);
      sums.back().second += row.root * rooted[k];
    }
  }
  for (std::size_t t = 0; t < of_traces.size(); ++t)
    for (const auto& [a, sum_a] : of_traces[t])
      for (const auto& [b, sum_b] : of_traces[t])
        form.own(a, b) -= sum_a * sum_b / trace_weight_[t];
}

void TrialFit::for_forms_times_teeth(
    const Effect& effect, const std::vector<EffectShape>& shapes,
    const std::function<void(std::size_t, const Eigen::MatrixXd&, Eigen::MatrixXd)>& take) const {
  struct ShapesOfForm {
    std::vector<double> values;
    std::vector<std::size_t> shapes;
  };
  std::vector<ShapesOfForm> forms;
  const auto with = [&](std::size_t i) { return Effect{effect.family, effect.flank, shapes[i]}; };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::vector<double> values = form_of(with(i));
    const auto same = std::find_if(forms.rbegin(), forms.rend(),
                                   [&](const ShapesOfForm& form) { return form.values == values; });
    if (same == forms.rend())
      forms.push_back({std::move(values), {i}});
    else
      same->shapes.push_back(i);
  }
  for_each_piece(forms.size(), [&](std::size_t f) {
    FormOnTeeth form;
    form.values = std::move(forms[f].values);
    sum_up(form);
    for (const std::size_t i : forms[f].shapes) {
      auto [products, own] = products_of_teeth(with(i), form);
      take(i, products, std::move(own));
    }
  });
}

/// With all columns, and with each other.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> TrialFit::products_of_teeth(
    const Effect& effect, const FormOnTeeth& form) const {
  const Eigen::Index count = effect.columns();
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(form.own.rows(), count);
  double of_tooth[8];
  for (int tooth = 1; tooth < factors.rows(); ++tooth) {
    effect.family->form_times_tooth->tooth(geometry_, tooth, effect.shape, of_tooth);
    for (Eigen::Index k = 0; k < count; ++k) factors(tooth, k) = of_tooth[k];
  }
  Eigen::MatrixXd products = form.with_all.transpose() * factors;
  Eigen::MatrixXd own = factors.transpose() * (form.own * factors);
  // What zeros take up but for rounding was not measured.
  constexpr double kRounding = 1e-12;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double whole = factors.col(k).cwiseAbs2().dot(form.whole);
    if (own(k, k) > kRounding * whole) continue;
    products.col(k).setZero();
    own.row(k).setZero();
    own.col(k).setZero();
  }
  return {std::move(products), std::move(own)};
}

}  // namespace trueflank::loop
