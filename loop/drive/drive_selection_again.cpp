// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"
#include "trueflank/loop/drive/wave_spectrum.h"

// What comes again and again, over the angle or over the run, told as one form: a scan finds where,
// as its shapes are too many to try.
namespace trueflank::loop {
namespace {

namespace forms = drive_effects;

/// What is left and what a form would move, of the rows seen, in their noise's units.
struct SeenRows {
  std::vector<double> left, column;
  std::vector<const BenchPoint*> row;
};

SeenRows seen_rows(const DriveContext& context, const Eigen::VectorXd& left, double of) {
  SeenRows seen;
  for (std::size_t i = 0; i < context.table.points.size(); ++i) {
    const BenchPoint& p = context.table.points[i];
    if (p.fold == 0) continue;
    seen.left.push_back(left[static_cast<Eigen::Index>(i)] / p.sigma_nm);
    seen.column.push_back(forms::sized_loss_nm(context, p, of) / p.sigma_nm);
    seen.row.push_back(&p);
  }
  return seen;
}

/// What neighbouring rows share of what is left.
double shared_by_neighbours(const SeenRows& seen, double figures) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < seen.left.size(); ++i) {
    if (i > 0) product += seen.left[i] * seen.left[i - 1];
    square += seen.left[i] * seen.left[i];
  }
  const double n = static_cast<double>(seen.left.size()),
               alike = square > 0.0 ? std::clamp(product / square + (1.0 + figures) / n, 0.0, 0.95)
                                    : 0.0;
  return (1.0 + alike) / (1.0 - alike);
}

/// A shape that a scan found, and what it takes off (chi-square in the noise's units).
struct Scanned {
  double gain = 0.0;
  DriveShape shape = {};
};

/// The likeliest part of a period of this order, of one size, beside what is the same everywhere.
Scanned likeliest_part(const BenchTable& table, const SeenRows& seen, double order) {
  constexpr int kParts = 180;
  constexpr double kFewestRows = 5.0;
  struct Sums {
    double rows = 0.0, square = 0.0, product = 0.0;
    void add(const Sums& other) {
      rows += other.rows;
      square += other.square;
      product += other.product;
    }
  };
  std::array<Sums, kParts> part{};
  Sums all;
  const DriveShape from_middle{order, 0.0, 0.0, 0.5, 1.0};
  for (std::size_t i = 0; i < seen.row.size(); ++i) {
    const double place = forms::place_of_pit(table, *seen.row[i], from_middle) + 0.5;
    const Sums one{1.0, seen.column[i] * seen.column[i], seen.column[i] * seen.left[i]};
    part[static_cast<std::size_t>(std::clamp(static_cast<int>(kParts * place), 0, kParts - 1))].add(
        one);
    all.add(one);
  }
  Scanned best;
  for (int begin = 0; begin < kParts; ++begin) {
    Sums inside;
    for (int length = 1; length <= 2 * kParts / 5; ++length) {
      inside.add(part[static_cast<std::size_t>((begin + length - 1) % kParts)]);
      if (inside.rows < kFewestRows || all.rows - inside.rows < kFewestRows) continue;
      const double beside = inside.square - inside.square * inside.square / all.square,
                   product = inside.product - inside.square / all.square * all.product;
      if (!(beside > 0.0) || product * product <= best.gain * beside) continue;
      const double half = 0.5 * length / kParts;
      best = {product * product / beside,
              {order, 0.0, static_cast<double>(begin) / kParts - 0.5 + half, half, 1.0}};
    }
  }
  return best;
}

/// True of a turn of a shaft, or of a whole order, as far as the angles tell: these have forms of
/// their own.
bool is_a_turn(const DriveModel& model, double order, double turns) {
  constexpr double kMostPerTurn = 6.5, kNear = 0.3;
  if (order < kMostPerTurn && std::abs(order - std::round(order)) * turns < kNear) return true;
  return std::any_of(model.orders.begin(), model.orders.end(), [&](const MemberOrder& member) {
    return std::abs(member.order - order) * turns < kNear;
  });
}

/// The likeliest wave over the run of every kind: even, with the load, with the speed.
struct ScannedWaves {
  std::array<Scanned, 3> plain, changing;
  double looks = 0.0;
};

constexpr std::array<double, 3> kWaveSizes{double(forms::kDrag), double(forms::kFlanks),
                                           forms::kBySpeed};

/// Even waves of so many periods at most, of so many rows each at least, are told elsewhere.
constexpr double kMostEvenTimes = 24.0, kRowsOfEven = 6.0;

ScannedWaves scan_waves(const DriveContext& context, const Eigen::VectorXd& left) {
  constexpr double kFewestTimes = 2.25, kMostTimes = 40.0, kRowsEach = 7.0, kStep = 0.3,
                   kMostStretch = 1.9, kFinestStretch = 0.04, kCoarsest = 0.3;
  ScannedWaves found;
  std::array<SeenRows, 3> seen;
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = seen_rows(context, left, kWaveSizes[k]);
  std::vector<double> share;
  for (const BenchPoint* p : seen[0].row) share.push_back(forms::share_of_run(context.table, *p));
  const double n = static_cast<double>(share.size());
  for (double times = kFewestTimes; times < std::min(kMostTimes, n / kRowsEach); times += kStep) {
    const double step = std::clamp(1.2 / times, kFinestStretch, kCoarsest);
    const int most = static_cast<int>(kMostStretch / step);
    for (int k = -most; k <= most; ++k) {
      const double stretch = k * step;
      // (the shortest waves keep rows enough)
      const double shortest = n / times * std::abs(stretch) / std::expm1(std::abs(stretch));
      if (k != 0 && shortest < kRowsEach) continue;
      std::array<WaveProducts, 3> products{};
      for (std::size_t i = 0; i < share.size(); ++i) {
        const double angle = kTwoPi * forms::periods_of_run(share[i], times, stretch),
                     c = std::cos(angle), s = std::sin(angle);
        for (std::size_t of = 0; of < seen.size(); ++of)
          products[of].add(seen[of].column[i] * c, seen[of].column[i] * s, seen[of].left[i]);
      }
      found.looks += 1.0;
      for (std::size_t of = 0; of < seen.size(); ++of) {
        const WaveAmounts wave = products[of].solved();
        Scanned& best = k == 0 ? found.plain[of] : found.changing[of];
        if (wave.gain <= best.gain) continue;
        best = {wave.gain, {times, wave.phase(), kWaveSizes[of], double(forms::kRwToEitherSide)}};
        if (k != 0) best.shape.push_back(stretch);
      }
    }
  }
  return found;
}

/// The likeliest even waves with fewer rows to a period, or more periods, than the others have: of
/// a controller that hunts, or of what is faster than the rows. `plain` alone. Only a line that
/// stands far above those beside it is a wave: errors that hang together fill many.
ScannedWaves scan_quick_waves(const DriveContext& context, const Eigen::VectorXd& left) {
  constexpr double kStep = 0.3, kRowsEach = 2.1, kAboveBeside = 25.0, kMostLines = 2e5;
  constexpr int kBeside = 60, kApart = 8;  // lines
  ScannedWaves found;
  const double rows = static_cast<double>(context.table.points.size()),
               first = std::min(kMostEvenTimes, rows / kRowsOfEven);
  const int lines =
      static_cast<int>(std::min(kMostLines, std::floor((rows / kRowsEach - first) / kStep)));
  if (lines < 2 * kBeside) return found;
  for (std::size_t of = 0; of < kWaveSizes.size(); ++of) {
    const SeenRows seen = seen_rows(context, left, kWaveSizes[of]);
    std::vector<double> angle, product, square;
    double weights = 0.0;
    for (std::size_t i = 0; i < seen.row.size(); ++i) {
      angle.push_back(kTwoPi * (forms::share_of_run(context.table, *seen.row[i]) - 0.5));
      product.push_back(seen.column[i] * seen.left[i]);
      square.push_back(seen.column[i] * seen.column[i]);
      weights += square.back();
    }
    const auto of_left = line_sums(angle, product, first, kStep, lines),
               of_squares = line_sums(angle, square, 2.0 * first, 2.0 * kStep, lines);
    std::vector<double> gain;
    for (std::size_t k = 0; k < of_left.size(); ++k) {
      const double cos_cos = 0.5 * (weights + of_squares[k].real());
      const WaveProducts products{cos_cos, 0.5 * of_squares[k].imag(), weights - cos_cos,
                                  of_left[k].real(), of_left[k].imag()};
      gain.push_back(products.solved(1e-3 * weights * weights).gain);
    }
    const auto highest =
        static_cast<int>(std::max_element(gain.begin(), gain.end()) - gain.begin());
    std::vector<double> beside;
    for (int k = std::max(0, highest - kBeside); k <= std::min(lines - 1, highest + kBeside); ++k)
      if (std::abs(k - highest) > kApart) beside.push_back(gain[static_cast<std::size_t>(k)]);
    const auto at = static_cast<std::size_t>(highest);
    found.looks += lines;
    if (gain[at] < kAboveBeside * nth_smallest(beside, beside.size() / 2)) continue;
    found.plain[of] = {gain[at],
                       {first + kStep * highest, std::arg(of_left[at]) / kTwoPi, kWaveSizes[of],
                        double(forms::kRwToEitherSide)}};
  }
  return found;
}

const DriveFamily& family_that(bool DriveFamily::*is, bool has_stretch) {
  const auto& library = drive_library();
  return *std::find_if(library.begin(), library.end(), [&](const DriveFamily& f) {
    return f.*is && (!has_stretch || f.shape_names.size() > forms::kRwStretch);
  });
}

}  // namespace

std::vector<DriveEffect> DriveSelection::plain_losses() const {
  std::vector<DriveEffect> plain;
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const DriveEffect& c = candidates_[g];
    const DriveFamily& f = *c.family;
    if (!banned_[g] && f.named && f.is_loss && c.columns() == 1 && c.shape.empty() && !f.drifts &&
        !f.differs_by_direction && !f.of_one_mesh && may_be_there(f) &&
        ((f.preference == 0 && (f.follows == "nothing" || f.follows == "load")) ||
         f.follows == "speed"))
      plain.push_back(c);
  }
  return plain;
}

std::vector<DriveEffect> DriveSelection::with_plain_losses(std::vector<DriveEffect> effects) const {
  for (const DriveEffect& plain : plain_losses()) effects.push_back(plain);
  return effects;
}

DriveSelection::OneForm DriveSelection::names_beside_what_comes_again(
    const DriveOutcome& outcome) const {
  OneForm set;
  const std::vector<DriveEffect> plain = plain_losses();
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveEffect& effect = outcome.effects[e];
    const DriveFamily& f = *effect.family;
    if (!f.named || f.drifts || f.follows_the_run || effect.order() > 0.0 ||
        std::any_of(plain.begin(), plain.end(),
                    [&](const DriveEffect& p) { return p.family == &f; }))
      continue;
    set.effects.push_back(effect);
    set.from.push_back(static_cast<int>(e));
  }
  return set;
}

bool DriveSelection::tell_if_clearly(DriveOutcome& outcome, const std::vector<PricedForm>& found) {
  constexpr double kClearly = 20.0, kInstead = 9.0, kAsOne = 4.0, kMostLeft = 0.85;
  const OneForm now = as_it_is(outcome);
  const std::vector<DriveEffect> plain = plain_losses();
  std::vector<PricedForm> sets;
  double noise = now.square / std::max(1.0, outcome.rows - now.size);
  for (const PricedForm& form : found)
    for (std::size_t which = 0; which < (std::size_t{1} << plain.size()); ++which) {
      OneForm set;
      set.effects.assign(form.set.effects.begin(), form.set.effects.end() - 1);
      set.from.assign(form.set.from.begin(), form.set.from.end() - 1);
      for (std::size_t k = 0; k < plain.size(); ++k) {
        if (((which >> k) & 1U) == 0) continue;
        const auto same =
            std::find_if(outcome.effects.begin(), outcome.effects.end(),
                         [&](const DriveEffect& e) { return e.family == plain[k].family; });
        set.effects.push_back(plain[k]);
        set.from.push_back(
            same == outcome.effects.end() ? -1 : static_cast<int>(same - outcome.effects.begin()));
      }
      set.effects.push_back(form.set.effects.back());
      set.from.push_back(-1);
      if (!fits(set)) continue;
      noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
      sets.push_back({std::move(set), 0.0, form.looks});
    }
  std::stable_sort(sets.begin(), sets.end(), [&](const PricedForm& a, const PricedForm& b) {
    return a.set.figure(noise) + looks_beyond(outcome, a) <
           b.set.figure(noise) + looks_beyond(outcome, b);
  });
  constexpr std::size_t kMostRefined = 6;
  if (sets.size() > kMostRefined) sets.resize(kMostRefined);
  const PricedForm* best = nullptr;
  double least = 1e300;
  for (PricedForm& priced : sets) {
    OneForm refined = priced.set;
    refine_drive_shapes(context(), value_, FitRows::kTraining, refined.effects);
    if (fits(refined) && refined.square <= priced.set.square) priced.set = std::move(refined);
    noise = std::min(noise, priced.set.square / std::max(1.0, outcome.rows - priced.set.size));
  }
  for (const PricedForm& priced : sets)
    if (const double figure = priced.set.figure(noise) + looks_beyond(outcome, priced);
        figure < least) {
      least = figure;
      best = &priced;
    }
  if (best == nullptr) return false;
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, best->set.effects, FitRows::kTraining).explained_nm();
  const double shared = shared_by_neighbours(seen_rows(here, left, double(forms::kDrag)),
                                             static_cast<double>(best->set.size));
  const bool fewer =
      best->set.effects.size() < outcome.effects.size() ||
      (best->set.size < now.size && best->set.effects.size() <= outcome.effects.size());
  // (what has no name gives way to another of no more figures)
  const bool instead =
      best->set.size <= now.size && best->set.effects.size() <= outcome.effects.size() &&
      std::none_of(outcome.effects.begin(), outcome.effects.end(), [&](const DriveEffect& e) {
        const auto at = static_cast<int>(&e - outcome.effects.data());
        return e.family->named &&
               std::find(best->set.from.begin(), best->set.from.end(), at) == best->set.from.end();
      });
  if (!fewer && !instead && best->set.square > kMostLeft * now.square) return false;
  // (errors that hang together come and go as well)
  const double gain = now.figure(noise) - least -
                      (1.0 - 1.0 / shared) * std::max(0.0, now.square - best->set.square) / noise;
  if (gain < (fewer ? kAsOne : instead ? kInstead : kClearly)) return false;
  return exchange_unless_denied(outcome, best->set, gain);
}

void DriveSelection::tell_as_pits(DriveOutcome& outcome) {
  constexpr double kLevel = 1e-4, kFewestTimes = 8.0, kNearLine = 0.05;
  constexpr int kMostTimesOfLine = 6, kSlips = 8;
  if (!table_.has_angle || table_.turns <= 1.01 || (gains_power() && !losses_beside_gains_)) return;
  const bool understood =
      std::all_of(outcome.effects.begin(), outcome.effects.end(),
                  [](const DriveEffect& e) { return e.family->named && e.order() == 0.0; }) &&
      !leaves_structure(outcome);
  if (understood) return;
  const OneForm base = names_beside_what_comes_again(outcome);
  const std::vector<DriveEffect> full = with_plain_losses(base.effects);
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, full, FitRows::kTraining).explained_nm();
  const LikeliestOrder line = spectra_.likeliest_order(table_, left);
  if (!(line.p_value < kLevel)) return;
  const SeenRows seen = seen_rows(here, left, double(forms::kDrag));
  Scanned best;
  for (int times = 1; times <= kMostTimesOfLine; ++times) {
    if (is_a_turn(model_, line.order / times, table_.turns)) continue;
    for (int slip = -kSlips; slip <= kSlips; ++slip) {
      const double order = line.order / times + kNearLine * slip / table_.turns;
      if (order * table_.turns < kFewestTimes || is_a_turn(model_, order, table_.turns)) continue;
      if (Scanned part = likeliest_part(table_, seen, order); part.gain > best.gain)
        best = std::move(part);
    }
  }
  if (best.shape.empty()) return;
  constexpr std::size_t kLooks = 200000;
  const DriveFamily& family = family_that(&DriveFamily::comes_again_over_the_angle, false);
  const BesideEffects beside(here, value_, full, FitRows::kTraining);
  std::vector<PricedForm> found;
  for (const double sharp : {1.0, 0.0}) {
    DriveShape shape = best.shape;
    shape[forms::kPitSharp] = sharp;
    OneForm set = base;
    set.effects.push_back(nearest_best(here, beside, {&family, shape}));
    if (is_a_turn(model_, forms::order_of_pits(table_, set.effects.back().shape), table_.turns))
      continue;
    set.from.push_back(-1);
    found.push_back({std::move(set), 0.0, cost_of_looks(kLooks) + family.dearer});
  }
  tell_if_clearly(outcome, found);
}

void DriveSelection::tell_as_waves_of_the_run(DriveOutcome& outcome) {
  constexpr std::size_t kFewestRows = 60;
  if (table_.points.size() < kFewestRows || !forms::has_one_course(context()) ||
      (gains_power() && !losses_beside_gains_))
    return;
  const OneForm base = names_beside_what_comes_again(outcome);
  const std::vector<DriveEffect> full = with_plain_losses(base.effects);
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, full, FitRows::kTraining).explained_nm();
  const ScannedWaves slow = scan_waves(here, left), quick = scan_quick_waves(here, left);
  const double looks = slow.looks + quick.looks;
  constexpr double kLeastGain = 0.1;
  const double square = BesideEffects(here, value_, full, FitRows::kTraining).square();
  std::vector<Scanned> waves(quick.plain.begin(), quick.plain.end());
  waves.insert(waves.end(), slow.changing.begin(), slow.changing.end());
  // (a slow even wave of one period and size is told elsewhere)
  waves.insert(waves.end(), slow.plain.begin() + 1, slow.plain.end());
  std::vector<PricedForm> found;
  for (const Scanned& wave : waves) {
    if (wave.gain < kLeastGain * square) continue;
    const bool changes = wave.shape.size() > forms::kRwStretch;
    const DriveFamily& family = family_that(&DriveFamily::comes_again_over_the_run, changes);
    std::vector<DriveEffect> effects = full;
    effects.push_back({&family, wave.shape});
    refine_drive_shapes(here, value_, FitRows::kTraining, effects);
    for (const bool from_nothing : {false, true})
      for (const double half : {0.0, 0.5}) {
        if (!from_nothing && half > 0.0) continue;
        DriveEffect form = effects.back();
        form.shape[forms::kRwFrom] =
            from_nothing ? double(forms::kRwFromNothing) : double(forms::kRwToEitherSide);
        form.shape[forms::kRwPhase] += half;
        OneForm set = base;
        set.effects.push_back(form);
        set.from.push_back(-1);
        found.push_back({std::move(set), 0.0,
                         cost_of_looks(static_cast<std::size_t>(4.0 * looks)) + family.dearer});
      }
  }
  if (!found.empty()) tell_if_clearly(outcome, found);
}

}  // namespace trueflank::loop
