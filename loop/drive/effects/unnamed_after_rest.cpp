// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/scans/rest_scan.h"

// What dies away after every rest: a seal that sticks, grease that is run in anew. The drive stands
// still where it changes its direction and where a file begins; other rests are seen by coming
// again after as many rows.
namespace trueflank::loop::drive_effects {

namespace {

enum RestValue : std::size_t { kRestOf, kRestPeriod, kRestPhase, kRestRows };
/// Of what is gone in the row after, the rows in which it dies away; below `kLeavesOne` it is said
/// so.
constexpr double kOneRow = 0.3, kLeavesOne = 0.42;

/// Runs from one change of direction to the next, of all files: how many, and their rows.
struct RunsBetweenTurns {
  double count = 0.0, rows = 0.0;
  [[nodiscard]] double mean() const { return rows / std::max(1.0, count); }
};
RunsBetweenTurns runs_of(const DriveContext& context) {
  RunsBetweenTurns runs;
  for (const BenchPoint& p : context.table.points) {
    runs.count += p.since_turn == 0 ? 1.0 : 0.0;
    runs.rows += 1.0;
  }
  return runs;
}

std::string lines_of_rests(const DriveContext& context, const DriveShape& s) {
  std::string text;
  int told = 0;
  const BenchPoint* before = nullptr;
  for (const BenchPoint& p : context.table.points) {
    const bool starts =
        before == nullptr
            ? rows_since_rest(p, s[kRestPeriod], s[kRestPhase]) < 1.0 || s[kRestPeriod] > 0.0
            : rows_since_rest(p, s[kRestPeriod], s[kRestPhase]) <
                  rows_since_rest(*before, s[kRestPeriod], s[kRestPhase]);
    before = &p;
    if (!starts) continue;
    if (++told > 3) return text + ", ...";
    text += (text.empty() ? "lines " : ", ") + std::to_string(p.line);
  }
  return text;
}

/// What dies away more slowly is a sawtooth; near to that it is odd. Of the rows to the next rest.
constexpr double kSlowest = 0.6, kOddlySlow = 0.5;

double rows_it_takes(const DriveShape& s) {
  return s[kRestPeriod] > 0.0 ? std::min(s[kRestRows], kSlowest * s[kRestPeriod]) : s[kRestRows];
}

}  // namespace

double rows_since_rest(const BenchPoint& p, double period, double phase) {
  constexpr double kLongAgo = 1e6;
  // (with a phase the run began long after the drive did)
  if (period == 0.0) return phase != 0.0 && p.since_turn == p.row ? kLongAgo : p.since_turn;
  const double turns = (p.row - phase) / period;
  return p.row - phase - period * std::floor(turns);
}

DriveFamily unnamed_after_rest() {
  constexpr double kFewestRuns = 4.0, kShortestRun = 4.0;
  constexpr double kFewestTurns = 8.0, kLeastMeanRun = 1.3;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"of", "period", "phase", "rows"};
  f.preference = 8;
  f.stands_alone = true;
  f.shape_values = {{}, {}, {}, {.continuous = true, .limits = [](const DriveContext& context) {
                                   return std::pair(
                                       0.3, 0.5 * static_cast<double>(context.table.points.size()));
                                 }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    const RunsBetweenTurns runs = runs_of(context);
    if (runs.count < kFewestRuns || runs.mean() < kShortestRun) return shapes;
    for (const double of : {double(kDrag), double(kFlanks)})
      for (const double share : {0.05, 0.12, 0.3})
        shapes.push_back({of, 0.0, 0.0, std::max(0.7, share * runs.mean())});
    return shapes;
  };
  // Every period that comes six times or more, what loads and speeds follow left out; and changes
  // of direction, however often they come.
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    const RunsBetweenTurns runs = runs_of(context);
    const bool turns = runs.count >= kFewestTurns && runs.mean() > kLeastMeanRun;
    if (has_one_course(context))
      for (const int period : periods_of_rests(context.table.points))
        for (int phase = 0; phase < period; ++phase)
          shapes.push_back({double(kDrag), double(period), double(phase), kOneRow});
    if (turns)
      for (const double of : {double(kDrag), double(kFlanks)})
        for (const double runs_before : {0.0, 1.0})
          for (const double rows : {kOneRow, 1.0, 2.5, 5.0})
            shapes.push_back({of, 0.0, runs_before, rows});
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return s[kRestPeriod] == 0.0 ? 1 : 0; };
  f.is_odd = [](const DriveShape& s) {
    return s[kRestPeriod] > 0.0 && s[kRestRows] > kOddlySlow * s[kRestPeriod];
  };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin{s};
    for (const double of : {double(kDrag), double(kFlanks)})
      for (const double phase : {0.0, 1.0}) {
        DriveShape other = s;
        other[kRestOf] = of;
        if (s[kRestPeriod] == 0.0) other[kRestPhase] = phase;
        if (other != s && std::find(kin.begin(), kin.end(), other) == kin.end() &&
            (of == double(kFlanks) || s[kRestOf] == double(kDrag)))
          kin.push_back(other);
      }
    return kin;
  };
  f.shape_of_rest = [](double of, double period, double phase, double rows) {
    return DriveShape{of, period, phase, rows};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double part = rows_since_rest(p, s[kRestPeriod], s[kRestPhase]) / rows_it_takes(s);
    c[0] = part < 30.0 ? changed_nm(context, p, s[kRestOf]) * std::exp(-part) : 0.0;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double longer : growing_steps(context, 0.005, 1.5))
      shapes.push_back({(*about)[kRestOf], (*about)[kRestPeriod], (*about)[kRestPhase],
                        (*about)[kRestRows] * std::exp(longer)});
    return shapes;
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("dies_within_rows", rows_it_takes(s))};
    if (s[kRestPeriod] > 0.0)
      figures.push_back(figure_of("comes_again_after_rows", s[kRestPeriod]));
    return figures;
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const bool turns = s[kRestPeriod] == 0.0;
    return std::string(amount > 0.0 ? "more loss" : "less loss") +
           (turns ? " after every change of direction: "
                  : " that comes again every " + short_text(s[kRestPeriod]) + " rows: ") +
           with_interval(figures[0], " N m") +
           (s[kRestRows] < kLeavesOne ? " in one row alone" : " in the first row") +
           (s[kRestOf] == double(kFlanks) ? " at full load" : "") +
           (s[kRestRows] < kLeavesOne
                ? std::string(" (")
                : ", gone to a third after " + with_interval(figures[1], " rows") + " (") +
           lines_of_rests(context, s) + "; " +
           (amount > 0.0 ? "a seal or grease that sticks after a rest?"
                         : "what settles after a rest?") +
           ")";
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return s[kRestPeriod] == 0.0
               ? std::string("that dies away after every change of direction")
               : "that dies away and comes again every " + short_text(s[kRestPeriod]) + " rows";
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
