// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/scans/states_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/bench_visits.h"
#include "trueflank/loop/drive/effects/columns.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestRowsOfStates = 48;
constexpr int kFewestChanges = 3;        ///< fewer are a jump or a spell, which are asked elsewhere
constexpr double kMostOften = 0.2;       ///< changes for a row: more of them cut noise by its sign
constexpr double kApartOfStates = 3.2;   ///< levels, in the scatter about them
constexpr double kAlikeInStates = 0.25;  ///< of neighbours beside the levels
constexpr int kRoundsOfStates = 12;

/// Rows in the noise's units: what a state adds to each, and what is left of it.
struct Series {
  std::vector<std::size_t> row;
  std::vector<double> column, value;
};

Series series_of(const DriveContext& context, const Eigen::VectorXd& left, double what,
                 FitRows rows) {
  Series s;
  const auto& points = context.table.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (rows == FitRows::kTraining && points[i].fold == 0) continue;
    s.row.push_back(i);
    s.column.push_back(drive_effects::changed_nm(context, points[i], what) / points[i].sigma_nm);
    s.value.push_back(left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm);
  }
  return s;
}

/// Levels of the two states and the state of every row.
struct States {
  std::array<double, 2> level{};
  std::vector<int> state;
  double square = 0.0;  ///< about the levels
  int changes = 0;
};

/// Levels of the states as they are, by least squares.
void fit_levels(const Series& s, States& states) {
  std::array<double, 2> product{}, square{};
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    const auto k = static_cast<std::size_t>(states.state[i]);
    product[k] += s.column[i] * s.value[i];
    square[k] += s.column[i] * s.column[i];
  }
  for (const std::size_t k : {0U, 1U})
    if (square[k] > 0.0) states.level[k] = product[k] / square[k];
  states.square = 0.0;
  states.changes = 0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    const double off =
        s.value[i] - s.column[i] * states.level[static_cast<std::size_t>(states.state[i])];
    states.square += off * off;
    if (i > 0 && states.state[i] != states.state[i - 1]) ++states.changes;
  }
}

/// The likeliest course between two levels (Viterbi's), each change at the same cost.
void follow(const Series& s, double noise, double cost, States& states) {
  const std::size_t n = s.value.size();
  std::vector<std::array<int, 2>> from(n);
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 2> next{};
    for (const int k : {0, 1}) {
      const auto to = static_cast<std::size_t>(k);
      const bool stays = i == 0 || sum[to] <= sum[1 - to] + cost;
      from[i][to] = stays ? k : 1 - k;
      const double off = s.value[i] - s.column[i] * states.level[to];
      next[to] = (stays ? sum[to] : sum[1 - to] + cost) + off * off / noise;
    }
    sum = next;
  }
  int k = sum[1] < sum[0] ? 1 : 0;
  for (std::size_t i = n; i-- > 0;) {
    states.state[i] = k;
    k = from[i][static_cast<std::size_t>(k)];
  }
}

/// From levels at two shares of the rows' own values on until nothing changes.
States settled_states(const Series& s, States states) {
  const double n = static_cast<double>(s.value.size());
  for (int round = 0; round < kRoundsOfStates; ++round) {
    const double often = std::clamp((states.changes + 1.0) / n, 1.0 / n, kMostOften);
    const States before = states;
    follow(s, std::max(states.square / n, 1e-12), 2.0 * std::log((1.0 - often) / often), states);
    fit_levels(s, states);
    if (states.state == before.state) break;
  }
  return states;
}

States likeliest_course(const Series& s) {
  std::vector<double> own;
  for (std::size_t i = 0; i < s.value.size(); ++i)
    if (s.column[i] != 0.0) own.push_back(s.value[i] / s.column[i]);
  States best;
  best.square = 1e300;
  if (own.size() < 2) return best;
  const auto at = [&](double share) {
    return nth_smallest(own, static_cast<std::size_t>(share * static_cast<double>(own.size() - 1)));
  };
  for (const auto& [low, high] :
       {std::pair(0.25, 0.75), std::pair(0.1, 0.6), std::pair(0.4, 0.9)}) {
    States states;
    const double one = at(low), other = at(high);
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      const double mine = s.value[i] - s.column[i] * one, its = s.value[i] - s.column[i] * other;
      states.state.push_back(std::abs(its) < std::abs(mine) ? 1 : 0);
    }
    fit_levels(s, states);
    states = settled_states(s, states);
    if (states.changes > 0 && states.square < best.square) best = states;
  }
  return best;
}

/// Where the state with the larger loss, or reading, begins and ends.
std::vector<double> changes_of(const DriveContext& context, const Series& s, const States& states) {
  const auto& points = context.table.points;
  const int on = states.level[1] > states.level[0] ? 1 : 0;
  std::vector<double> changes;
  if (!states.state.empty() && states.state.front() == on) changes.push_back(-1.0);
  for (std::size_t i = 1; i < states.state.size(); ++i)
    if (states.state[i] != states.state[i - 1])
      changes.push_back(0.5 * (points[s.row[i - 1]].taken + points[s.row[i]].taken));
  return changes;
}

/// The split of single values into two levels that leaves least about them.
States split_in_two(const Series& s) {
  const std::size_t n = s.value.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto own = [&](std::size_t i) { return s.value[i] / s.column[i]; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return own(a) < own(b); });
  double all_product = 0.0, all_square = 0.0, product = 0.0, square = 0.0, most = -1.0;
  for (std::size_t i = 0; i < n; ++i) {
    all_product += s.column[i] * s.value[i];
    all_square += s.column[i] * s.column[i];
  }
  std::size_t below = 1;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    product += s.column[order[k]] * s.value[order[k]];
    square += s.column[order[k]] * s.column[order[k]];
    const double rest = all_product - product,
                 taken = product * product / square + rest * rest / (all_square - square);
    if (taken <= most) continue;
    most = taken;
    below = k + 1;
  }
  States states;
  states.state.assign(n, 1);
  for (std::size_t k = 0; k < below; ++k) states.state[order[k]] = 0;
  fit_levels(s, states);
  return states;
}

/// True where rows that are neighbours in a quantity, or nearest in load and speed, have the same
/// state more often than chance would have it.
bool follows_what_was_recorded(const DriveContext& context, const Series& s, const States& states) {
  constexpr double kSure = 4.0, kNear = 1e-9;
  const auto& points = context.table.points;
  const double n = static_cast<double>(s.row.size());
  double on = 0.0;
  for (const int state : states.state) on += state;
  const double alike = (on * on + (n - on) * (n - on)) / (n * n);
  const auto is_sure = [&](double agree, double pairs) {
    return pairs > 0.0 && agree - alike * pairs > kSure * std::sqrt(pairs * alike * (1.0 - alike));
  };
  std::vector<std::vector<double>> ranks;
  const auto ask = [&](const auto& quantity) {
    std::vector<std::size_t> order(s.row.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return quantity(points[s.row[a]]) < quantity(points[s.row[b]]);
    });
    std::vector<double> rank(order.size());
    double agree = 0.0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool same = k > 0 && quantity(points[s.row[order[k]]]) <
                                     quantity(points[s.row[order[k - 1]]]) + kNear;
      rank[order[k]] = same ? rank[order[k - 1]] : static_cast<double>(k) / n;
      if (k > 0) agree += states.state[order[k]] == states.state[order[k - 1]] ? 1.0 : 0.0;
    }
    ranks.push_back(std::move(rank));
    return is_sure(agree, n - 1.0);
  };
  const auto& t = context.table;
  bool follows = ask([](const BenchPoint& p) { return p.load_nm; });
  follows = ask([](const BenchPoint& p) { return p.speed_rpm; }) || follows;
  follows = ask([](const BenchPoint& p) { return p.forward ? 1.0 : 0.0; }) || follows;
  double agree = 0.0;
  for (std::size_t i = 0; i < s.row.size(); ++i) {
    double nearest = 1e300;
    std::size_t at = i;
    for (std::size_t j = 0; j < s.row.size(); ++j) {
      double away = 0.0;
      for (const std::vector<double>& rank : ranks) away += std::abs(rank[i] - rank[j]);
      if (j == i || away >= nearest) continue;
      nearest = away;
      at = j;
    }
    agree += states.state[i] == states.state[at] ? 1.0 : 0.0;
  }
  follows = is_sure(agree, n) || follows;
  if (t.has_temperature)
    follows = ask([](const BenchPoint& p) { return p.temperature_c; }) || follows;
  if (t.has_angle)
    for (const MemberOrder& member : context.model.orders)
      follows = ask([&](const BenchPoint& p) {
                  return drive_effects::place_of_spell(p, member.order);
                }) ||
                follows;
  return follows;
}

}  // namespace

LikeliestStates scattered_states(const DriveContext& context, const Eigen::VectorXd& left) {
  constexpr double kApart = 4.5, kFewestOfEither = 0.12, kMostBetween = 0.04, kLow = 0.3,
                   kHigh = 0.7;
  constexpr std::size_t kFewestRows = 30;
  LikeliestStates best;
  best.square = 1e300;
  if (!drive_effects::has_one_course(context)) return best;
  for (const auto what :
       {drive_effects::kDrag, drive_effects::kOutputReads, drive_effects::kFlanks}) {
    if (what == drive_effects::kOutputReads &&
        !(context.table.has(true) && context.table.has(false)))
      continue;
    const Series s = series_of(context, left, what, FitRows::kTraining);
    const double n = static_cast<double>(s.value.size());
    if (s.value.size() < kFewestRows ||
        std::any_of(s.column.begin(), s.column.end(), [](double c) { return c == 0.0; }))
      continue;
    const States states = split_in_two(s);
    double on = 0.0, apart = 0.0, between = 0.0;
    const double step = states.level[1] - states.level[0];
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      on += states.state[i];
      apart += std::pow(s.column[i] * step, 2);
      const double way = (s.value[i] / s.column[i] - states.level[0]) / step;
      between += way > kLow && way < kHigh ? 1.0 : 0.0;
    }
    if (std::min(on, n - on) < kFewestOfEither * n || between > kMostBetween * n ||
        std::sqrt(apart / std::max(states.square, 1e-300)) < kApart ||
        states.changes < kFewestChanges || states.square >= best.square ||
        follows_what_was_recorded(context, s, states))
      continue;
    best = {.p_value = 1.0,
            .what = static_cast<double>(what),
            .changes = changes_of(context, s, states),
            .square = states.square};
  }
  return best;
}

LikeliestStates likeliest_states(const DriveContext& context, const Eigen::VectorXd& left) {
  LikeliestStates best, likely;
  likely.square = 1e300;
  if (!drive_effects::has_one_course(context)) return best;
  constexpr std::array kKinds{drive_effects::kDrag, drive_effects::kOutputReads,
                              drive_effects::kFlanks};
  for (const double what : kKinds) {
    const Series s = series_of(context, left, what, FitRows::kTraining);
    const auto n = static_cast<double>(s.value.size());
    if (s.value.size() < kFewestRowsOfStates) return best;
    States constant;
    constant.state.assign(s.value.size(), 0);
    fit_levels(s, constant);
    const States states = likeliest_course(s);
    if (states.changes < kFewestChanges || states.changes > kMostOften * n ||
        !(constant.square > 0.0))
      continue;
    if (states.square < likely.square)
      likely = {.what = what, .changes = changes_of(context, s, states), .square = states.square};
    // How far the levels are apart in the scatter about them, and whether this hangs together.
    double apart = 0.0, product = 0.0, last = 0.0;
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      const double by = s.column[i] * (states.level[1] - states.level[0]);
      const double off =
          s.value[i] - s.column[i] * states.level[static_cast<std::size_t>(states.state[i])];
      apart += by * by;
      if (i > 0) product += off * last;
      last = off;
    }
    if (std::sqrt(apart / std::max(states.square, 1e-300)) < kApartOfStates ||
        product > kAlikeInStates * states.square)
      continue;
    // All ways to cut the run so often, and two levels.
    const double ways = std::lgamma(n) - std::lgamma(states.changes + 1.0) -
                        std::lgamma(n - states.changes) +
                        std::log(static_cast<double>(kKinds.size()));
    const double p_value = std::exp(std::min(
        0.0, ways + 0.5 * (n - 3.0) * std::log(std::max(states.square / constant.square, 1e-300))));
    if (p_value >= best.p_value) continue;
    best = {.p_value = p_value,
            .what = what,
            .changes = changes_of(context, s, states),
            .square = states.square};
  }
  return best.changes.empty() ? likely : best;
}

std::vector<double> changes_of_states(const DriveContext& context, const Eigen::VectorXd& left,
                                      double what, FitRows rows,
                                      const std::vector<double>& changes) {
  const Series s = series_of(context, left, what, rows);
  States states;
  for (const std::size_t row : s.row) {
    const double taken = context.table.points[row].taken;
    states.state.push_back(
        (std::upper_bound(changes.begin(), changes.end(), taken) - changes.begin()) % 2 == 1 ? 1
                                                                                             : 0);
  }
  fit_levels(s, states);
  states = settled_states(s, states);
  return states.changes < kFewestChanges ? changes : changes_of(context, s, states);
}

namespace {

PartsOfRun parts_of(const Series& s) { return {s.column, s.value, FirstLevel::kNothing}; }

/// First rows of the levels, from places of the run; and back.
std::vector<std::size_t> cuts_at(const DriveContext& context, const Series& s,
                                 const std::vector<double>& changes) {
  std::vector<std::size_t> cuts;
  for (const double change : changes)
    cuts.push_back(
        static_cast<std::size_t>(std::count_if(s.row.begin(), s.row.end(), [&](std::size_t row) {
          return context.table.points[row].taken <= change;
        })));
  return cuts;
}
/// True where every level, and what is before the first, has rows.
bool are_cuts(const std::vector<std::size_t>& cuts, std::size_t rows) {
  return !cuts.empty() && cuts.front() > 0 && cuts.back() < rows &&
         std::adjacent_find(cuts.begin(), cuts.end(), std::greater_equal<>()) == cuts.end();
}
LevelsOfRun levels_at(const DriveContext& context, const Series& s, const PartsOfRun& parts,
                      const std::vector<std::size_t>& cuts) {
  const auto& points = context.table.points;
  LevelsOfRun found;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const std::size_t next = k + 1 < cuts.size() ? cuts[k + 1] : parts.rows();
    found.changes.push_back(0.5 *
                            (points[s.row[cuts[k] - 1]].taken + points[s.row[cuts[k]]].taken));
    found.levels.push_back(parts.level(cuts[k], next));
  }
  return found;
}

}  // namespace

LevelsOfRun likeliest_levels(const DriveContext& context, const Eigen::VectorXd& left,
                             double what) {
  const auto& points = context.table.points;
  const Series s = series_of(context, left, what, FitRows::kTraining);
  if (s.value.size() < kFewestRowsOfStates || points.front().file != points.back().file) return {};
  const PartsOfRun parts = parts_of(s);
  const std::vector<std::size_t> cuts = parts.likeliest_cuts();
  return levels_at(context, s, parts, cuts);
}

LevelsOfRun levels_beside(const DriveContext& context, const Eigen::VectorXd& left, double what,
                          FitRows rows, std::vector<double> changes) {
  const Series s = series_of(context, left, what, rows);
  const PartsOfRun parts = parts_of(s);
  std::vector<std::size_t> cuts = cuts_at(context, s, changes);
  for (int round = 0; round < 3; ++round)
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const std::size_t before = k == 0 ? 0 : cuts[k - 1],
                        after = k + 1 < cuts.size() ? cuts[k + 1] : parts.rows();
      double least = parts.left(before, cuts[k]) + parts.left(cuts[k], after);
      for (std::size_t cut = before + 1; cut < after; ++cut)
        if (const double here = parts.left(before, cut) + parts.left(cut, after); here < least) {
          least = here;
          cuts[k] = cut;
        }
    }
  if (!are_cuts(cuts, parts.rows())) return {};
  return levels_at(context, s, parts, cuts);
}

LevelsOfRun levels_as_cut(const DriveContext& context, const Eigen::VectorXd& left, double what,
                          FitRows rows, const std::vector<double>& changes) {
  const Series s = series_of(context, left, what, rows);
  const std::vector<std::size_t> cuts = cuts_at(context, s, changes);
  if (!are_cuts(cuts, s.row.size())) return {};
  return levels_at(context, s, parts_of(s), cuts);
}

}  // namespace trueflank::loop
