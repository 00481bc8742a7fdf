// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"

// One form in place of all that was chosen, or beside what has a name: asked by what it leaves,
// once the others are chosen.
namespace trueflank::loop {
namespace {

/// What nearly every bench has, or, where power is gained, its sensors.
bool is_plain_beside_forms(const DriveEffect& effect, bool gains) {
  const DriveFamily& f = *effect.family;
  if (!f.named || effect.columns() != 1 || !effect.shape.empty() || !f.shape_values.empty())
    return false;
  if (gains) return !f.is_loss && !f.drifts && f.into_state && f.side != "input";
  return f.is_loss && f.preference == 0 && (f.follows == "nothing" || f.follows == "load");
}

/// True where most of the rows that the form moves most are moved so: not few of them far off.
bool most_rows_follow(const DriveContext& context, const Eigen::VectorXd& value,
                      const std::vector<DriveEffect>& effects, std::size_t form) {
  constexpr double kMuch = 0.5, kSome = 0.15, kLeast = 0.45, kMost = 1.8;
  constexpr std::size_t kFewest = 5;
  const DriveFit fit(context, value, effects, FitRows::kTraining);
  const Eigen::VectorXd moved = fit.explained_nm(static_cast<int>(form)),
                        left = value - fit.explained_nm() + moved;
  const auto& points = context.table.points;
  struct MovedRow {
    double errors = 0.0, size = 0.0, share = 0.0;  // how far it is moved, and the share of that
  };
  std::vector<MovedRow> rows;
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (points[i].fold == 0 || moved[row] == 0.0) continue;
    const double size = std::abs(moved[row]);
    rows.push_back({size / points[i].sigma_nm, size, left[row] / moved[row]});
    largest = std::max(largest, size);
  }
  std::sort(rows.begin(), rows.end(),
            [](const MovedRow& a, const MovedRow& b) { return a.errors > b.errors; });
  // (what grows from a place on moves few rows much; what comes again should not, whatever their
  // errors are)
  const bool comes_again = static_cast<bool>(effects[form].family->shape_of_rest);
  std::vector<double> share;
  for (const MovedRow& row : rows)
    if (row.errors > kMuch * rows.front().errors ||
        (comes_again ? row.size > kMuch * largest
                     : share.size() < kFewest && row.errors > kSome * rows.front().errors))
      share.push_back(row.share);
  if (share.size() < kFewest) return false;
  const double middle = nth_smallest(share, share.size() / 2);
  return middle > kLeast && middle < kMost;
}

/// Times as much as of independent rows that a form's amount scatters, by what neighbouring rows
/// share of what is left.
double shared_along(const DriveContext& context, const Eigen::VectorXd& value,
                    const std::vector<DriveEffect>& effects, std::size_t form) {
  const DriveFit fit(context, value, effects, FitRows::kTraining);
  const Eigen::VectorXd left = value - fit.explained_nm(),
                        moved = fit.explained_nm(static_cast<int>(form));
  const auto& points = context.table.points;
  double product = 0.0, square = 0.0, last = 0.0, weight = 0.0, n = 0.0;
  std::vector<double> column, off;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].fold == 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    off.push_back(left[row] / points[i].sigma_nm);
    column.push_back(moved[row] / points[i].sigma_nm);
    n += 1.0;
  }
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (i > 0) product += off[i] * last;
    square += off[i] * off[i];
    last = off[i];
  }
  if (!(square > 0.0)) return 1.0;
  // (what was fitted makes neighbours look opposite)
  const double figures = static_cast<double>(size_of(effects));
  const double alike = std::clamp(product / square + (1.0 + figures) / n, 0.0, 0.95);
  double sum = 0.0, together = 0.0;
  for (const double c : column) {
    together += c * (c + 2.0 * sum);
    sum = alike * (sum + c);
    weight += c * c;
  }
  return weight > 0.0 ? std::max(1.0, together / weight) : 1.0;
}

}  // namespace

DriveSelection::OneForm DriveSelection::without_second_form(const OneForm& set) {
  const auto is_form = [&](std::size_t e) {
    return set.from[e] < 0 && !set.effects[e].family->named;
  };
  std::size_t first = 0;
  while (first + 1 < set.effects.size() && !is_form(first)) ++first;
  if (first + 1 >= set.effects.size()) return {};
  // (that form is the last again)
  OneForm alone;
  for (std::size_t e = 0; e + 1 < set.effects.size(); ++e) {
    if (e == first) continue;
    alone.effects.push_back(set.effects[e]);
    alone.from.push_back(set.from[e]);
  }
  alone.effects.push_back(set.effects[first]);
  alone.from.push_back(-1);
  return alone;
}

void DriveSelection::tell_as_whole_forms(DriveOutcome& outcome) {
  constexpr std::size_t kFewestRows = 30;
  if (table_.points.size() < kFewestRows) return;
  // Where readings in steps share their rounding this looks like a form, and where both directions
  // gain power the sensors are asked with more care.
  const bool in_steps = std::any_of(table_.points.begin(), table_.points.end(),
                                    [](const BenchPoint& p) { return p.reading >= 0; });
  if (in_steps || (gains_power() && table_.has(true) && table_.has(false))) return;
  tell_as_pits(outcome);
  for (int round = 0; round < 2; ++round)
    if (!tell_as_one_whole(outcome, round == 0)) break;
  tell_as_waves_of_the_run(outcome);
  tell_as_scattered_states(outcome);
  tell_as_levels_of_the_run(outcome);
  tell_as_starts(outcome);
}

DriveSelection::OneForm DriveSelection::as_it_is(const DriveOutcome& outcome) const {
  OneForm now{.effects = outcome.effects, .from = {}, .size = size_with_changes(outcome.effects)};
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) now.from.push_back(static_cast<int>(e));
  const DriveContext here = context();
  now.square = DriveFit(here, value_, now.effects, FitRows::kTraining).residual_square();
  return now;
}

bool DriveSelection::tell_as_one_whole(DriveOutcome& outcome, bool pieces_too) {
  constexpr double kClearly = 20.0, kForBoth = 9.0, kAsOne = 4.0;  // chi-square
  constexpr int kFarFewer = 2;
  const bool sensors_alone = gains_power() && !losses_beside_gains_;
  const OneForm now = as_it_is(outcome);
  const auto covers = [&](const std::vector<DriveEffect>& effects) {
    constexpr double kOwn = 0.02;  // of its column, beside the others
    const DriveContext here = context();
    std::vector<DriveEffect> others = effects;
    others.pop_back();
    return effects.back().columns() > 1 ||
           BesideEffects(here, value_, others, FitRows::kTraining).own_share(effects.back()) > kOwn;
  };
  const auto can_show = [&](const DriveEffect& e) {
    return !e.family->shows || e.family->shows(context(), e.shape);
  };
  std::vector<DriveEffect> plain;
  std::vector<int> plain_from;
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const DriveEffect& c = candidates_[g];
    if (banned_[g] || !may_be_there(*c.family) || !is_plain_beside_forms(c, sensors_alone))
      continue;
    plain.push_back(c);
    plain_from.push_back(-1);
    for (std::size_t e = 0; e < outcome.effects.size(); ++e)
      if (outcome.effects[e].family == c.family) plain_from.back() = static_cast<int>(e);
  }
  const auto is_of_plain = [&](const DriveEffect& e) {
    return std::any_of(plain.begin(), plain.end(),
                       [&](const DriveEffect& p) { return p.family == e.family; });
  };
  fill_whole_columns();
  std::vector<int> all, names;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    if (is_of_plain(outcome.effects[e])) continue;
    all.push_back(static_cast<int>(e));
    if (outcome.effects[e].family->named) names.push_back(static_cast<int>(e));
  }
  const std::set<std::vector<int>> first_bases{{}, all, names};
  std::set<std::vector<int>> without_each;
  for (std::size_t k = 0; k < all.size() && all.size() > 1; ++k) {
    std::vector<int> without = all;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
    if (!first_bases.contains(without)) without_each.insert(without);
  }
  // Levels that come and go, or several descriptions, may be two forms.
  constexpr std::ptrdiff_t kPieces = 2;
  const bool in_pieces =
      pieces_too &&
      (std::count_if(outcome.effects.begin(), outcome.effects.end(),
                     [](const DriveEffect& e) { return !e.family->named; }) >= kPieces ||
       std::any_of(outcome.effects.begin(), outcome.effects.end(),
                   [](const DriveEffect& e) { return bool(e.family->shape_of_states); }));
  std::map<std::vector<int>, std::vector<PricedForm>> sets_of;  // by what is kept
  double noise = now.square / std::max(1.0, outcome.rows - now.size);
  // What is plain may do most of what one form does: then it is seen without (`alone_too`).
  const auto ask_beside = [&](const OneForm& base, bool alone_too,
                              std::vector<AskedBeside>& asked) {
    std::vector<DriveEffect> full = base.effects;
    full.insert(full.end(), plain.begin(), plain.end());
    asked.push_back({std::move(full), true});
    if (alone_too) asked.push_back({base.effects, false});
  };
  const auto try_beside = [&](const OneForm& base, double looks_before,
                              const std::vector<WholeForm>& forms, std::vector<PricedForm>& sets) {
    for (const auto& [effect, gain, looks] : forms)
      for (std::size_t which = 0; which < (std::size_t{1} << plain.size()); ++which) {
        OneForm set = base;
        for (std::size_t k = 0; k < plain.size(); ++k)
          if ((which >> k) & 1U) {
            set.effects.push_back(plain[k]);
            set.from.push_back(plain_from[k]);
          }
        set.effects.push_back(effect);
        set.from.push_back(-1);
        if (!fits(set) || !covers(set.effects) || !can_show(set.effects.back())) continue;
        noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
        sets.push_back({std::move(set), looks_before, looks});
      }
  };
  std::vector<WholeForm> beside_names;
  const auto try_bases = [&](const std::set<std::vector<int>>& bases) {
    std::vector<OneForm> begun;
    std::vector<AskedBeside> to_ask;
    for (const std::vector<int>& kept : bases) {
      OneForm& base = begun.emplace_back();
      for (const int e : kept) {
        base.effects.push_back(outcome.effects[static_cast<std::size_t>(e)]);
        base.from.push_back(e);
      }
      ask_beside(base, kept.empty() || kept == names, to_ask);
    }
    std::vector<std::vector<WholeForm>> found = whole_forms(to_ask);
    auto next = found.begin();
    for (const OneForm& base : begun) {
      const std::vector<int>& kept = base.from;
      std::vector<WholeForm> forms = std::move(*next++);
      if (kept.empty() || kept == names) {
        forms.insert(forms.end(), next->begin(), next->end());
        ++next;
      }
      try_beside(base, 0.0, forms, sets_of[kept]);
      if (kept == names) beside_names = std::move(forms);
    }
  };
  // Several pieces may be two forms.
  const auto try_two_beside_names = [&] {
    constexpr std::size_t kMostFirst = 4;
    std::stable_sort(beside_names.begin(), beside_names.end(),
                     [](const WholeForm& a, const WholeForm& b) { return a.gain > b.gain; });
    std::set<std::pair<const DriveFamily*, int>> tried;
    std::vector<std::pair<OneForm, double>> firsts;
    std::vector<AskedBeside> to_ask;
    for (const WholeForm& first : beside_names) {
      const DriveFamily& family = *first.effect.family;
      if (tried.size() == kMostFirst) break;
      if (!tried.insert({&family, family.kind ? family.kind(first.effect.shape) : 0}).second)
        continue;
      OneForm with;
      for (const int e : names)
        with.effects.push_back(outcome.effects[static_cast<std::size_t>(e)]);
      with.from = names;
      with.effects.push_back(first.effect);
      with.from.push_back(-1);
      ask_beside(with, false, to_ask);
      firsts.emplace_back(std::move(with), first.looks);
    }
    const std::vector<std::vector<WholeForm>> seconds = whole_forms(to_ask);
    for (std::size_t k = 0; k < firsts.size(); ++k)
      try_beside(firsts[k].first, firsts[k].second, seconds[k], sets_of[names]);
  };
  try_bases(first_bases);
  // Where one form beside few does as much as many effects, what it leaves is asked again.
  constexpr std::size_t kMany = 5, kFew = 3;
  const bool one_does_all =
      all.size() >= kMany && std::any_of(sets_of.begin(), sets_of.end(), [&](const auto& of_base) {
        return std::any_of(of_base.second.begin(), of_base.second.end(), [&](const PricedForm& f) {
          return f.set.square <= now.square && f.set.effects.size() <= kFew;
        });
      });
  if (!one_does_all) {
    if (in_pieces) try_two_beside_names();
    try_bases(without_each);
  }
  std::vector<PricedForm> sets;
  for (auto& [kept, of_base] : sets_of)
    for (PricedForm& priced : of_base) sets.push_back(std::move(priced));
  // The likeliest with their shapes free: each was sought beside all that is plain.
  constexpr std::size_t kMostRefined = 14;
  std::stable_sort(sets.begin(), sets.end(), [&](const auto& a, const auto& b) {
    return a.set.figure(noise) + a.looks_before + a.looks <
           b.set.figure(noise) + b.looks_before + b.looks;
  });
  if (sets.size() > kMostRefined) sets.resize(kMostRefined);
  for (auto& [set, looks_before, looks] : sets) {
    OneForm refined = set;
    refine_drive_shapes(context(), value_, FitRows::kTraining, refined.effects);
    if (!fits(refined) || refined.square > set.square || !can_show(refined.effects.back()))
      continue;
    noise = std::min(noise, refined.square / std::max(1.0, outcome.rows - refined.size));
    set = std::move(refined);
  }
  std::vector<std::pair<double, const OneForm*>> likeliest;
  for (const PricedForm& priced : sets)
    if (const double figure = priced.set.figure(noise) + looks_beyond(outcome, priced);
        figure < now.figure(noise))
      likeliest.emplace_back(figure, &priced.set);
  std::stable_sort(likeliest.begin(), likeliest.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  // Where few rows follow the likeliest, or the hold-out denies it, that of another family may
  // stand.
  constexpr std::size_t kMostAsked = 3;
  std::set<const DriveFamily*> asked;
  const auto rows_follow = [&](const OneForm& set) {
    const DriveContext here = context();
    for (std::size_t e = 0; e < set.effects.size(); ++e)
      if ((e + 1 == set.effects.size() || (set.from[e] < 0 && !set.effects[e].family->named)) &&
          !most_rows_follow(here, value_, set.effects, e))
        return false;
    return true;
  };
  for (const auto& [figure_of_set, set] : likeliest) {
    if (asked.size() == kMostAsked) break;
    if (!asked.insert(set->effects.back().family).second) continue;
    OneForm best = *set;
    double figure = figure_of_set;
    let_held_out_rows_settle_sides(best);
    if (!rows_follow(best)) {
      // (of two forms the one that few rows follow is left out)
      best = without_second_form(*set);
      if (best.effects.empty() || !fits(best)) continue;
      figure = best.figure(noise) + cost_of_looks(whole_.effects.size());
      let_held_out_rows_settle_sides(best);
      if (!rows_follow(best)) continue;
    }
    bool drops_a_name = false, drops_any = false, drops_a_piece = false;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      if (std::find(best.from.begin(), best.from.end(), static_cast<int>(e)) != best.from.end())
        continue;
      drops_any = true;
      drops_a_piece = drops_a_piece || !outcome.effects[e].family->named;
      const bool only_mends =
          is_of_plain(outcome.effects[e]) &&
          (best.size < now.size ||
           (best.size == now.size && best.effects.size() < outcome.effects.size()));
      drops_a_name = drops_a_name || (outcome.effects[e].family->named && !only_mends);
    }
    // (names of which one takes back what the other does stand for no cause)
    const bool cancel = best.size < now.size && drop_names_that_cancel(outcome, best);
    if (cancel) drops_a_name = false;
    const DriveContext here = context();
    double shared = 1.0;
    for (std::size_t e = 0; e < best.effects.size(); ++e)
      if (best.from[e] < 0) shared = std::max(shared, shared_along(here, value_, best.effects, e));
    const double gain = now.figure(noise) - figure -
                        (1.0 - 1.0 / shared) * std::max(0.0, now.square - best.square) / noise;
    // (a name that only mends a piece goes with it where far fewer figures do as much)
    const bool fewer = best.size <= now.size && best.effects.size() < outcome.effects.size();
    const bool mends = drops_a_piece && (best.size + kFarFewer <= now.size || fewer);
    // (one that leaves less than three names do, with far fewer figures)
    const bool of_many = best.size + kFarFewer <= now.size && best.square <= now.square &&
                         best.effects.size() + kFarFewer <= outcome.effects.size();
    const double as_one = fewer && (cancel || drops_a_piece) ? 0.0 : kAsOne;
    if (gain < (drops_any && !drops_a_name ? as_one : mends || of_many ? kForBoth : kClearly))
      continue;
    if (exchange_unless_denied(outcome, best, gain)) return true;
  }
  return false;
}

bool DriveSelection::exchange_unless_denied(DriveOutcome& outcome, const OneForm& set,
                                            double gain) {
  const DriveOutcome before = outcome;
  const DriveState state = state_;
  exchange_as_sure(outcome, set, gain);
  if (!is_denied(outcome) || is_denied(before)) return true;
  most_denied_ = std::max(most_denied_, gain);
  outcome = before;
  state_ = state;
  return false;
}

double DriveSelection::looks_beyond(const DriveOutcome& outcome, const PricedForm& priced) const {
  // What it stands for was looked for as well, and is no better where it is more effects; of a wave
  // that was found the order is known.
  constexpr double kOfAPiece = 12.0, kOfAnEffect = 6.0;  // chi-square
  constexpr std::size_t kOfKnownOrder = 30;
  const OneForm& set = priced.set;
  double looks = priced.looks;
  const double order = set.effects.back().order();
  double of_pieces = 0.0;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    if (std::find(set.from.begin(), set.from.end(), static_cast<int>(e)) != set.from.end())
      continue;
    if (set.effects.size() < outcome.effects.size() && !outcome.effects[e].family->named)
      of_pieces += kOfAPiece;
    if (order > 0.0 &&
        std::abs(outcome.effects[e].order() - order) < 0.5 / std::max(1.0, table_.turns))
      looks = std::min(looks, cost_of_looks(kOfKnownOrder));
  }
  // (names of which one takes back what the other does are pieces too)
  if (set.size < size_with_changes(outcome.effects) && drop_names_that_cancel(outcome, set))
    of_pieces += kOfAPiece;
  const double fewer =
      static_cast<double>(outcome.effects.size()) - static_cast<double>(set.effects.size());
  return std::max(-kOfAnEffect * std::max(0.0, fewer), priced.looks_before + looks - of_pieces);
}

bool DriveSelection::drop_names_that_cancel(const DriveOutcome& outcome, const OneForm& set) const {
  constexpr double kLittle = 0.2;  // of their squares
  const DriveContext here = context();
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(value_.size()), squares = sum;
  int names = 0;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    if (!outcome.effects[e].family->named ||
        std::find(set.from.begin(), set.from.end(), static_cast<int>(e)) != set.from.end())
      continue;
    const Eigen::VectorXd moved = fit.explained_nm(static_cast<int>(e));
    sum += moved;
    squares += moved.cwiseAbs2();
    ++names;
  }
  if (names < 2) return false;
  for (const bool forward : {true, false}) {
    double together = 0.0, each = 0.0;
    for (std::size_t i = 0; i < table_.points.size(); ++i) {
      if (table_.points[i].forward != forward) continue;
      const auto row = static_cast<Eigen::Index>(i);
      together += sum[row] * sum[row];
      each += squares[row];
    }
    if (each > 0.0 && together < kLittle * each) return true;
  }
  return false;
}

void DriveSelection::let_held_out_rows_settle_sides(OneForm& set) const {
  constexpr double kAlike = 1e-6;  // of what is left
  const DriveContext here = context();
  for (std::size_t e = 0; e < set.effects.size(); ++e) {
    const DriveFamily& family = *set.effects[e].family;
    if (set.from[e] >= 0 || !family.falls_in_steps || !family.whole_shapes) continue;
    std::vector<DriveEffect> others = set.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    const BesideEffects seen(here, value_, others, FitRows::kTraining),
        all(here, value_, others, FitRows::kAll);
    const double least = seen.with(set.effects[e]).gain - kAlike * seen.square();
    double most = all.with(set.effects[e]).gain;
    for (DriveShape& shape : family.all_shapes(here, &set.effects[e].shape)) {
      const DriveEffect other{&family, shape};
      if (seen.with(other).gain < least) continue;
      if (const double gain = all.with(other).gain; gain > most) {
        most = gain;
        set.effects[e].shape = std::move(shape);
      }
    }
  }
}

void DriveSelection::let_held_out_rows_settle_kin(DriveOutcome& outcome) {
  constexpr double kAsWell = 4.0, kSurely = 20.0;  // chi-square
  const DriveContext here = context();
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveFamily& family = *outcome.effects[e].family;
    if (!family.shape_of_rest || !family.kin_shapes) continue;
    std::vector<DriveEffect> others = outcome.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    const BesideEffects seen(here, value_, others, FitRows::kTraining),
        all(here, value_, others, FitRows::kAll);
    const double seen_now = seen.with(outcome.effects[e]).gain,
                 noise = (seen.square() - seen_now) / std::max(1.0, outcome.rows - outcome.size());
    double most = all.with(outcome.effects[e]).gain + kSurely * noise;
    for (DriveShape& shape : family.kin_shapes(outcome.effects[e].shape)) {
      const DriveEffect kin{&family, shape};
      if (seen.with(kin).gain < seen_now - kAsWell * noise) continue;
      if (const double gain = all.with(kin).gain; gain > most) {
        most = gain;
        outcome.effects[e].shape = std::move(shape);
      }
    }
  }
}

bool DriveSelection::is_denied(DriveOutcome outcome) {
  const bool vetoed = vetoed_;
  const DriveState state = state_;
  const std::size_t effects = outcome.effects.size();
  veto(outcome);
  vetoed_ = vetoed;
  state_ = state;
  return outcome.effects.size() < effects;
}

void DriveSelection::exchange_as_sure(DriveOutcome& outcome, const OneForm& set, double gain) {
  constexpr double kSurest = 1e-9;
  exchange_effects(outcome, set, false);
  const double p_value = std::max(kSurest, std::exp(-0.5 * gain));
  ChosenGroup& record = outcome.discovery.chosen.back();
  record.p_value = std::min(record.p_value, p_value);
  record.bic_gain = std::max(record.bic_gain, gain);
  outcome.discovery.first_p_value = std::min(outcome.discovery.first_p_value, p_value);
  outcome.discovery.p_left = 1.0;
  outcome.discovery.most_likely_left = -1;
}

}  // namespace trueflank::loop
