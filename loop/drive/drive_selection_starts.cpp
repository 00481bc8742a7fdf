// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"
#include "trueflank/loop/drive/one_form.h"

// A loss that starts at rows of the run and dies away, told as one form: a scan finds the rows.
namespace trueflank::loop {
namespace {

namespace forms = drive_effects;

struct FoundStarts {
  double gain = 0.0;  ///< chi-square in the noise's units
  DriveShape shape = {};
};

/// Sums of what starts at a row: of its square, and with what is left.
struct StartSums {
  double square = 0.0, product = 0.0;
};

/// The likeliest starts of one size that die away within so many rows: the best, and others about
/// as large that lie well apart, each as sure by itself.
FoundStarts likeliest_starts(const std::vector<StartSums>& start, double of, double within) {
  constexpr double kEachGain = 25.0, kAlike = 1.7, kApart = 2.0;
  constexpr std::size_t kMost = 6;
  const auto size = [](const StartSums& s) { return s.product / s.square; };
  const auto gain = [](const StartSums& s) {
    return s.square > 0.0 ? s.product * s.product / s.square : 0.0;
  };
  std::vector<std::size_t> rows;
  StartSums all;
  while (rows.size() < kMost) {
    std::size_t best = start.size();
    for (std::size_t row = 0; row < start.size(); ++row) {
      if (gain(start[row]) < kEachGain ||
          (best < start.size() && gain(start[row]) <= gain(start[best])))
        continue;
      const bool apart = std::all_of(rows.begin(), rows.end(), [&](std::size_t other) {
        return std::abs(static_cast<double>(row) - static_cast<double>(other)) > kApart * within;
      });
      if (!apart) continue;
      if (!rows.empty()) {
        const double share = size(start[row]) / size(all);
        if (share < 1.0 / kAlike || share > kAlike) continue;
      }
      best = row;
    }
    if (best == start.size()) break;
    rows.push_back(best);
    all.square += start[best].square;
    all.product += start[best].product;
  }
  if (rows.empty()) return {};
  std::sort(rows.begin(), rows.end());
  FoundStarts found{gain(all), {of, within}};
  for (const std::size_t row : rows) found.shape.push_back(static_cast<double>(row));
  return found;
}

}  // namespace

void DriveSelection::let_held_out_rows_settle_starts(std::vector<DriveEffect>& effects) const {
  constexpr double kAsWell = 4.0;  // chi-square
  const auto asked = [&](const DriveShape& shape) {
    OneForm set{.effects = effects, .from = std::vector<int>(effects.size(), -1)};
    set.effects.back().shape = shape;
    if (!fits(set)) set.square = 1e300;
    return set;
  };
  OneForm now = asked(effects.back().shape);
  const double noise = now.square / std::max(1.0, rows_of_training() - now.size);
  for (std::size_t k = forms::kFirstStart; k < effects.back().shape.size(); ++k)
    for (const double by : {-1.0, 1.0, -2.0, 2.0}) {
      DriveShape shape = now.effects.back().shape;
      shape[k] = std::max(0.0, shape[k] + by);
      OneForm other = asked(shape);
      if (other.square < now.square + kAsWell * noise &&
          square_of_all(other) < square_of_all(now) - kAsWell * noise)
        now = std::move(other);
    }
  effects = now.effects;
}

void DriveSelection::tell_as_starts(DriveOutcome& outcome) {
  constexpr std::size_t kFewestRows = 60;
  constexpr double kLeastGain = 0.1, kFewestTimes = 4.0;
  if (table_.points.size() < kFewestRows || !forms::has_one_course(context()) ||
      (gains_power() && !losses_beside_gains_))
    return;
  const DriveFamily& family = *family_with(&DriveFamily::starts_in_run);
  const OneForm now = as_it_is(outcome);
  const OneForm base = names_beside_what_comes_again(outcome);
  const DriveContext here = context();
  const std::size_t rows = static_cast<std::size_t>(table_.every_row().back().row) + 1;
  std::vector<PricedForm> found;
  // (what is plain may have taken some of it, or be there beside it)
  for (const std::vector<DriveEffect>& beside : {base.effects, with_plain_losses(base.effects)}) {
    const DriveFit fit(here, value_, beside, FitRows::kTraining);
    const Eigen::VectorXd left = value_ - fit.explained_nm();
    const double square = fit.residual_square();
    for (const double of : {double(forms::kDrag), double(forms::kFlanks), forms::kBySpeed}) {
      FoundStarts best;
      double looks = 0.0;
      for (const double within : {1.5, 3.0, 6.0, 10.0, 16.0, 25.0, 40.0, 65.0, 100.0}) {
        if (kFewestTimes * within > static_cast<double>(rows)) break;
        std::vector<StartSums> start(rows);
        for (std::size_t i = 0; i < table_.points.size(); ++i) {
          const BenchPoint& p = table_.points[i];
          if (p.fold == 0) continue;
          const double x = forms::sized_loss_nm(here, p, of) / p.sigma_nm;
          start[static_cast<std::size_t>(p.row)] = {
              x * x, x * left[static_cast<Eigen::Index>(i)] / p.sigma_nm};
        }
        const double stays = std::exp(-1.0 / within);
        for (std::size_t row = rows - 1; row-- > 0;) {
          start[row].square += stays * stays * start[row + 1].square;
          start[row].product += stays * start[row + 1].product;
        }
        looks += 1.0;
        if (FoundStarts starts = likeliest_starts(start, of, within); starts.gain > best.gain)
          best = std::move(starts);
      }
      // (the first row alone, at any speed, is a settling that is told elsewhere)
      const bool at_first = best.shape.size() == forms::kFirstStart + 1 &&
                            best.shape[forms::kFirstStart] < 0.01 * static_cast<double>(rows);
      if (best.gain < kLeastGain * square || (at_first && of != forms::kBySpeed)) continue;
      const double starts = static_cast<double>(best.shape.size() - forms::kFirstStart);
      std::vector<DriveEffect> effects = beside;
      effects.push_back({&family, best.shape});
      refine_drive_shapes(here, value_, FitRows::kTraining, effects);
      const BesideEffects others(here, value_, beside, FitRows::kTraining);
      effects.back() = nearest_best(here, others, effects.back());
      // (what stands still at levels is no start)
      if (DriveFit(here, value_, effects, FitRows::kTraining).residual_square() > now.square)
        continue;
      let_held_out_rows_settle_starts(effects);
      OneForm set = base;
      set.effects.push_back(effects.back());
      set.from.push_back(-1);
      found.push_back({std::move(set), 0.0,
                       starts * cost_of_looks(4 * rows) +
                           cost_of_looks(static_cast<std::size_t>(4.0 * 3.0 * looks)) +
                           family.dearer});
    }
  }
  if (!found.empty()) tell_if_clearly(outcome, found);
}

}  // namespace trueflank::loop
