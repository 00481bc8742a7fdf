// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// A loss that comes and goes over the run, as much as the speed or the load makes of it, or in
// waves whose period grows or shrinks: a room that warms and cools, a pump that slows down.
namespace trueflank::loop::drive_effects {

double periods_of_run(double share, double times, double stretch) {
  constexpr double kStraight = 1e-4;
  if (std::abs(stretch) < kStraight) return times * (share - 0.5);
  const double longer = std::expm1(stretch);
  return times / stretch * (std::log1p(longer * share) - std::log1p(0.5 * longer));
}

double share_of_run(const BenchTable& table, const BenchPoint& p) {
  return p.row / std::max(1.0, static_cast<double>(table.every_row().back().row));
}

namespace {

double run_wave_stretch(const DriveShape& s) { return s.size() > kRwStretch ? s[kRwStretch] : 0.0; }

/// Rows to a period at the start of the run, and at its end.
double rows_to_a_period(const BenchTable& table, const DriveShape& s, bool at_end) {
  const double stretch = run_wave_stretch(s),
               all = static_cast<double>(table.every_row().back().row) / s[kRwTimes];
  if (std::abs(stretch) < 1e-4) return all;
  return all * stretch / std::expm1(stretch) * (at_end ? std::exp(stretch) : 1.0);
}

/// The first line at which most of it stands.
int line_of_most(const DriveContext& context, const DriveShape& s, double amount) {
  const bool least = amount < 0.0 && s[kRwFrom] == double(kRwToEitherSide);
  double before = kNaN;
  for (const BenchPoint& p : context.table.every_row()) {
    const double periods = periods_of_run(share_of_run(context.table, p), s[kRwTimes],
                                          run_wave_stretch(s)) -
                           s[kRwPhase] - (least ? 0.5 : 0.0),
                 whole = std::floor(periods);
    if (!std::isnan(before) && whole > before) return p.line;
    before = whole;
  }
  return context.table.points.back().line;
}

std::string run_wave_told(const DriveContext& context, const DriveShape& s, double amount,
                          const std::vector<Parameter>& figures) {
  const std::string every =
      s.size() > kRwStretch
          ? "in waves whose period changes evenly from " + with_interval(figures[1], " rows") +
                " at the start of the run to " + with_interval(figures[2], " rows") + " at its end"
          : "in a wave every " + with_interval(figures[1], " rows");
  const std::string size = s[kRwFrom] == double(kRwFromNothing)
                               ? "from nothing to " + with_interval(figures[0], " N m") +
                                     (amount > 0.0 ? " more" : " less")
                               : with_interval(figures[0], " N m") + " to either side";
  constexpr double kQuick = 12.0;  // rows to a period
  const bool quick = s.size() <= kRwStretch && rows_to_a_period(context.table, s, false) < kQuick;
  return "a loss at the input" + in_proportion(s[kRwOf]) + " that comes and goes over the run, " +
         every + ": " + size + at_the_largest(s[kRwOf]) + ", most first at line " +
         std::to_string(line_of_most(context, s, amount)) +
         (quick ? " (a controller that hunts, or what is faster than the rows: hum of the mains?)"
                : " (a room that warms and cools, a pump or a fan that comes and goes?)");
}

std::vector<DriveShape> run_waves_about(const DriveContext& context, const DriveShape* about) {
  constexpr double kPhaseOfStretch = 1.0 / 24.0;  // of times: what keeps the mean of all rows
  std::vector<DriveShape> shapes;
  if (about == nullptr) return shapes;
  if (about->size() <= kRwStretch) {
    for (const double more : growing_steps(context, 0.006, 0.3))
      for (const double phase : growing_steps(context, 0.004, 0.08)) {
        shapes.push_back(*about);
        shapes.back()[kRwTimes] += more;
        shapes.back()[kRwPhase] += phase;
      }
    return shapes;
  }
  for (const double longer : coarse_steps(0.003, 0.15))
    for (const double more : coarse_steps(0.004, 0.25))
      for (const double phase : coarse_steps(0.003, 0.06)) {
        shapes.push_back(*about);
        shapes.back()[kRwStretch] += longer;
        shapes.back()[kRwTimes] += more;
        shapes.back()[kRwPhase] += phase - kPhaseOfStretch * longer * (*about)[kRwTimes];
      }
  return shapes;
}

DriveFamily waves_of_the_run(bool stretches) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"times", "phase", "of", "from"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.comes_again_over_the_run = true;
  f.shape_values = {{.continuous = true, .is_place = true, .reach = 0.3},
                    {.continuous = true, .is_place = true, .reach = 0.12},
                    {},
                    {}};
  if (stretches) {
    f.shape_names.emplace_back("stretch");
    f.shape_values.push_back({.continuous = true, .is_place = true, .reach = 0.1});
  }
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kRwOf]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return run_waves_about(context, about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double wave = std::cos(
        kTwoPi * (periods_of_run(share_of_run(context.table, p), s[kRwTimes], run_wave_stretch(s)) -
                  s[kRwPhase]));
    c[0] = (s[kRwFrom] == double(kRwFromNothing) ? 0.5 + 0.5 * wave : wave) *
           sized_loss_nm(context, p, s[kRwOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of(s.size() > kRwStretch ? "first_period_rows" : "period_rows",
                  rows_to_a_period(context.table, s, false))};
    if (s.size() > kRwStretch)
      figures.push_back(figure_of("last_period_rows", rows_to_a_period(context.table, s, true)));
    return figures;
  };
  f.told = run_wave_told;
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that comes and goes over the run in waves");
  };
  return f;
}

}  // namespace

DriveFamily unnamed_waves_of_the_run() { return waves_of_the_run(false); }
DriveFamily unnamed_changing_waves_of_the_run() { return waves_of_the_run(true); }

}  // namespace trueflank::loop::drive_effects
