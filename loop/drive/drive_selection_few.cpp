// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/one_form.h"

// What few rows show: a name in a bench of few rows.
namespace trueflank::loop {
namespace {

/// Sums of what an effect moves and of what is left, row by row.
struct FewRows {
  double square = 0.0, product = 0.0, left = 0.0, rows = 0.0;
  void add(double x, double y, double times) {
    square += times * x * x;
    product += times * x * y;
    left += times * y * y;
    rows += times;
  }
  /// That as much is taken off by chance, of independent normal errors.
  [[nodiscard]] double p_value() const {
    if (!(square > 0.0) || rows < 4.0) return 1.0;
    const double taken = product * product / square, below = left - taken;
    if (!(taken > 0.0)) return 1.0;
    return below > 0.0 ? f_tail(taken * (rows - 1.0) / below, 1.0, rows - 1.0) : 0.0;
  }
};

/// The rows that an effect says most about are left out one after the other: the p-values with all,
/// without one and without two.
std::vector<double> p_values_without_the_most(const DriveContext& context,
                                              const Eigen::VectorXd& value,
                                              const DriveEffect& effect) {
  std::vector<std::pair<double, double>> rows;
  FewRows all;
  for (std::size_t i = 0; i < context.table.points.size(); ++i) {
    const BenchPoint& p = context.table.points[i];
    if (p.fold == 0) continue;
    double column = 0.0;
    effect.family->evaluate(context, p, effect.shape, &column);
    const double x = column / p.sigma_nm, y = value[static_cast<Eigen::Index>(i)] / p.sigma_nm;
    rows.emplace_back(x, y);
    all.add(x, y, 1.0);
  }
  const double sign = all.product < 0.0 ? -1.0 : 1.0;
  std::sort(rows.begin(), rows.end(), [sign](const auto& a, const auto& b) {
    return sign * a.first * a.second > sign * b.first * b.second;
  });
  std::vector<double> p_values{all.p_value()};
  for (std::size_t k = 0; k < 2 && k < rows.size(); ++k) {
    all.add(rows[k].first, rows[k].second, -1.0);
    p_values.push_back(all.p_value());
  }
  return p_values;
}

}  // namespace

/// The engine flips the signs of rows, of which an effect that few rows show has too few: by a
/// normal law it may be as good as certain. It must be so without the rows that speak for it most.
/// It also takes the place of one name that leaves surely more.
bool DriveSelection::take_what_few_rows_show(DriveOutcome& outcome) {
  constexpr double kFewRows = 64.0, kSure = 1e-5, kSurest = 1e-300;
  constexpr double kSurelyMore = 20.0;                       // chi-square
  constexpr std::array<double, 2> kSureWithout{1e-3, 1e-2};  // one row, two rows
  const bool has_one_name = outcome.effects.size() == 1 && outcome.effects.front().family->named;
  if ((!outcome.effects.empty() && !has_one_name) || outcome.rows > kFewRows) return false;
  const OneForm now = as_it_is(outcome);
  std::set<const DriveFamily*> families;
  OneForm best;
  double least = kSure;
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const DriveEffect& c = candidates_[g];
    if (banned_[g] || !c.family->named || c.columns() != 1 || !may_be_there(*c.family)) continue;
    families.insert(c.family);
    const std::vector<double> p = p_values_without_the_most(context(), value_, c);
    if (!(p[0] < least) || !(p[1] < kSureWithout[0]) || !(p[2] < kSureWithout[1])) continue;
    OneForm set;
    set.effects = {c};
    set.from = {-1};
    if (!fits(set)) continue;
    const double noise = set.square / std::max(1.0, outcome.rows - set.size);
    if (has_one_name && now.square - set.square <= kSurelyMore * noise) continue;
    least = p[0];
    best = std::move(set);
  }
  const double p_value = static_cast<double>(families.size()) * least;
  if (best.effects.empty() || !(p_value < kSure)) return false;
  return exchange_unless_denied(outcome, best, -2.0 * std::log(std::max(kSurest, p_value)));
}

}  // namespace trueflank::loop
