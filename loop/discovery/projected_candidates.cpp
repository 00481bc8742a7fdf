// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/projected_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "trueflank/base/threads.h"

namespace trueflank::loop {
namespace {

/// Of a column's own square: with less left beside the earlier ones it is rounding.
constexpr double kNothingLeft = 1e-11;
/// Panels that a thread takes at a time.
constexpr std::size_t kPanelsAtOnce = 4;

}  // namespace

ProjectedCandidates::ProjectedCandidates(const DiscoveryProblem& problem,
                                         const BlockStatistics& statistics,
                                         const std::vector<bool>& banned)
    : problem_(problem), statistics_(statistics), panel_of_(problem.groups.size()) {
  const std::vector<PanelColumns>& panels = statistics.panels();
  asked_.assign(panels.size(), false);
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (int g = panels[p].first_group; g < panels[p].first_group + panels[p].groups; ++g) {
      const auto group = static_cast<std::size_t>(g);
      panel_of_[group] = p;
      if (problem.groups[group].local_family < 0 && (banned.empty() || !banned[group])) asked_[p] = true;
    }
  begin();
}

void ProjectedCandidates::begin() {
  const auto& all = statistics_.all();
  columns_.clear();
  own_columns_.clear();
  basis_.resize(0, 0);
  value_.resize(0);
  scores_ = all.candidate_value;
  unit_scores_.resize(scores_.size(), statistics_.units());
  for (int u = 0; u < statistics_.units(); ++u)
    unit_scores_.col(u) = statistics_.unit(u).candidate_value;
  panels_.assign(statistics_.panels().size(), {});
  for_each_run(panels_.size(), kPanelsAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t p = from; p < to; ++p) begin_panel(p);
  });
}

void ProjectedCandidates::begin_panel(std::size_t p) {
  const PanelColumns& panel = statistics_.panels()[p];
  OfPanel& own = panels_[p];
  own.asked = asked_[p];
  int widest = 1;
  for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g)
    widest = std::max(widest, problem_.groups[static_cast<std::size_t>(g)].columns);
  own.gram.assign(static_cast<std::size_t>(widest), PanelRow{});
  for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g) {
    const Eigen::MatrixXd& gram = statistics_.group_gram(g, 0);
    const auto at = static_cast<std::size_t>(problem_.groups[static_cast<std::size_t>(g)].first_column -
                                             panel.first_column);
    for (Eigen::Index a = 0; a < gram.rows(); ++a)
      for (Eigen::Index b = a; b < gram.cols(); ++b)
        own.gram[static_cast<std::size_t>(b - a)][at + static_cast<std::size_t>(a)] = gram(a, b);
  }
  if (!own.asked) return;
  own.lost.assign(own.gram.size(), PanelRow{});
  const auto& wholes = statistics_.wholes();
  if (wholes.size() < kFewestWholesAsked || wholes.size() > kMostWholesAsked) return;
  own.of_wholes.assign(wholes.size() * own.gram.size(), PanelRow{});
  const auto all = static_cast<std::size_t>(statistics_.candidates().cols());
  std::size_t row = 0;
  for (const auto& [number, whole] : wholes)
    for (std::size_t d = 0; d < own.gram.size(); ++d, ++row)
      std::copy_n(whole.products.data() + d * all + panel.first_column, panel.columns,
                  own.of_wholes[row].begin());
}

/// What is the same for all candidates when a column is added.
struct ProjectedCandidates::Added {
  std::vector<int> columns;  ///< raw ones, this one last
  Eigen::VectorXd own;              ///< coefficients of q on them
  double value = 0.0;               ///< b
  /// Of each unit: h; the coefficients on the columns of what the earlier q make of it; (q'q)_u, (q'r)_u.
  Eigen::MatrixXd beside, spread;
  Eigen::VectorXd square, left;
  Eigen::VectorXd mixed;       ///< what s takes of the earlier coefficients a
  double beside_square = 0.0;  ///< h'h of all units
};

void ProjectedCandidates::put_beside(const std::vector<int>& columns) {
  if (columns.size() < columns_.size() ||
      !std::equal(columns_.begin(), columns_.end(), columns.begin()))
    begin();
  std::vector<Added> all;
  while (columns_.size() < columns.size())
    if (auto added = add_column(columns[columns_.size()])) all.push_back(std::move(*added));
  if (all.empty()) return;
  for_each_run(panels_.size(), kPanelsAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t p = from; p < to; ++p)
      for (const Added& added : all) add_to_panel(p, added);
  });
}

/// Nothing where the column says nothing beside the earlier ones.
std::optional<ProjectedCandidates::Added> ProjectedCandidates::add_column(int column) {
  columns_.push_back(column);
  std::vector<int> columns = own_columns_;
  columns.push_back(column);
  const auto m = static_cast<Eigen::Index>(own_columns_.size());
  const Eigen::MatrixXd gram = statistics_.all().model_model(columns, columns);
  Eigen::VectorXd own = Eigen::VectorXd::Unit(m + 1, m);
  // Twice: what rounding left of the earlier ones goes, too.
  for (int round = 0; round < 2; ++round)
    own.head(m) -= basis_ * (basis_.transpose() * (gram * own).head(m));
  const double square = own.dot(gram * own);
  if (!(square > kNothingLeft * gram(m, m))) return std::nullopt;
  own /= std::sqrt(square);
  Added added = prepared(columns, own);
  own_columns_ = std::move(columns);
  basis_.conservativeResize(m + 1, m + 1);
  basis_.row(m).setZero();
  basis_.col(m) = own;
  value_.conservativeResize(m + 1);
  value_[m] = added.value;
  return added;
}

ProjectedCandidates::Added ProjectedCandidates::prepared(const std::vector<int>& columns,
                                                         const Eigen::VectorXd& own) const {
  const auto m = static_cast<Eigen::Index>(own_columns_.size());
  const int units = statistics_.units();
  Added added{columns, own};
  added.value = own.dot(statistics_.all().model_value(columns));
  added.beside.resize(m, units);
  added.spread = Eigen::MatrixXd::Zero(m + 1, units);
  added.square.resize(units);
  added.left.resize(units);
  added.mixed = Eigen::VectorXd::Zero(m);
  for (int u = 0; u < units; ++u) {
    const auto& sums = statistics_.unit(u);
    const Eigen::MatrixXd gram = sums.model_model(columns, columns);
    const Eigen::VectorXd products = gram * own;
    const Eigen::VectorXd beside = basis_.transpose() * products.head(m);
    added.beside.col(u) = beside;
    added.spread.col(u).head(m) = basis_ * beside;
    added.square[u] = own.dot(products);
    added.left[u] = own.dot(sums.model_value(columns)) - value_.dot(beside);
    added.mixed += basis_.transpose() * (gram.topLeftCorner(m, m) * added.spread.col(u).head(m));
    added.beside_square += beside.squaredNorm();
  }
  return added;
}

void ProjectedCandidates::add_to_panel(std::size_t p, const Added& added) {
  const PanelColumns& panel = statistics_.panels()[p];
  OfPanel& own = panels_[p];
  PanelRow taken{};
  if (own.asked) {
    add_to_units(p, added, taken);
  } else {
    for (std::size_t k = 0; k < added.columns.size(); ++k) {
      const double* const products =
          statistics_.all().model_candidate[static_cast<std::size_t>(added.columns[k])].data() +
          panel.first_column;
      for (int j = 0; j < panel.columns; ++j)
        taken[static_cast<std::size_t>(j)] += added.own[static_cast<Eigen::Index>(k)] * products[j];
    }
  }
  for (int j = 0; j < panel.columns; ++j)
    scores_[panel.first_column + j] -= added.value * taken[static_cast<std::size_t>(j)];
  subtract_products(own.gram, taken, taken);
  if (own.asked) own.taken.push_back(taken);
}

void ProjectedCandidates::add_to_units(std::size_t p, const Added& added, PanelRow& taken) {
  const PanelColumns& panel = statistics_.panels()[p];
  OfPanel& own = panels_[p];
  const auto units = static_cast<std::size_t>(statistics_.units());
  const std::size_t m = own.taken.size();
  // d of every unit, and s
  std::vector<PanelRow> of_unit(units, PanelRow{});
  PanelRow mixed{};
  subtract_rows(mixed, added.mixed.data(), own.taken.data(), m);
  std::vector<const PanelRow*> rows(m + 1);
  for (std::size_t u = 0; u < units; ++u) {
    const auto unit = static_cast<Eigen::Index>(u);
    for (std::size_t k = 0; k <= m; ++k)
      rows[k] = &statistics_.unit_candidates(added.columns[k], p, static_cast<int>(u));
    add_rows(of_unit[u], added.own.data(), mixed, added.spread.col(unit).data(), rows.data(), m + 1);
    subtract_rows(of_unit[u], added.beside.col(unit).data(), own.taken.data(), m);
    for (std::size_t j = 0; j < kPanelColumns; ++j) taken[j] += of_unit[u][j];
  }
  PanelRow lost_mixed;
  for (std::size_t j = 0; j < kPanelColumns; ++j) lost_mixed[j] = -mixed[j];
  add_mixed_products(own.lost.data(), own.lost.size(), taken, lost_mixed, added.beside_square);
  for (std::size_t u = 0; u < units; ++u) {
    const auto unit = static_cast<Eigen::Index>(u);
    const double square = added.square[unit], left = added.left[unit];
    double* const score = unit_scores_.col(unit).data() + panel.first_column;
    PanelRow beside;
    for (std::size_t j = 0; j < kPanelColumns; ++j) beside[j] = of_unit[u][j] - square * taken[j];
    for (int j = 0; j < panel.columns; ++j) {
      const auto at = static_cast<std::size_t>(j);
      score[j] -= added.value * beside[at] + left * taken[at];
    }
    add_products(own.lost, 1.0, beside);
  }
  if (own.of_wholes.empty()) return;
  std::size_t row = 0;
  for (const auto& [number, whole] : statistics_.wholes()) {
    PanelRow of_whole{};
    double square = 0.0;
    for (const int u : whole.units) {
      square += added.square[u];
      for (std::size_t j = 0; j < kPanelColumns; ++j)
        of_whole[j] -= of_unit[static_cast<std::size_t>(u)][j];
    }
    add_mixed_products(own.of_wholes.data() + row, own.gram.size(), taken, of_whole, square);
    row += own.gram.size();
  }
}

Eigen::MatrixXd ProjectedCandidates::of_group(int group, std::vector<PanelRow> OfPanel::*rows) const {
  const std::size_t p = panel_of_[static_cast<std::size_t>(group)];
  const CandidateGroup& own = problem_.groups[static_cast<std::size_t>(group)];
  const int at = own.first_column - statistics_.panels()[p].first_column;
  const std::vector<PanelRow>& products = panels_[p].*rows;
  Eigen::MatrixXd result(own.columns, own.columns);
  for (int a = 0; a < own.columns; ++a)
    for (int b = 0; b < own.columns; ++b)
      result(a, b) =
          products[static_cast<std::size_t>(std::abs(a - b))][static_cast<std::size_t>(at + std::min(a, b))];
  return result;
}

Eigen::MatrixXd ProjectedCandidates::gram(int group) const { return of_group(group, &OfPanel::gram); }

Eigen::MatrixXd ProjectedCandidates::lost_by_flips(int group) const {
  return of_group(group, &OfPanel::lost);
}

}  // namespace trueflank::loop
