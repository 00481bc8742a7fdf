// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What comes and goes over the load, the speed, its logarithm, the temperature or the run: a
// rattle, a pump that cycles, a controller that hunts slowly.
namespace trueflank::loop::drive_effects {

namespace {

enum CoordinateWave : std::size_t {
  kCwOver,
  kCwCycles,  ///< over the range
  kCwPhase,   ///< of the most, in cycles from the start of the range on
  kCwReads,   ///< as the output's torque reads, or a loss
  kCwBased    ///< between nothing and the most, or as much to either side
};
enum CwOver { kCwLoad, kCwSpeed, kCwTemperature, kCwLogSpeed, kCwRun, kCwDrivingLoad };

bool is_cw_load(double over) { return over == double(kCwLoad) || over == double(kCwDrivingLoad); }

double cw_least_speed(const DriveContext& context) {
  return std::max(context.table.least_speed_rpm, 1e-3 * context.table.most_speed_rpm);
}

double cw_rows(const DriveContext& context) {
  return std::max(1.0, static_cast<double>(context.table.points.size()) - 1.0);
}

/// 0 ... 1 over the range.
double cw_share(const DriveContext& context, const BenchPoint& p, double over) {
  if (over == double(kCwRun)) return p.taken;
  if (over == double(kCwDrivingLoad)) return p.load_nm / context.table.most_load_nm;
  if (over != double(kCwLogSpeed)) return context.share_of_range(p, over);
  const double least = cw_least_speed(context);
  return std::log(std::max(p.speed_rpm, least) / least) /
         std::log(context.table.most_speed_rpm / least);
}

double cw_quantity(const DriveContext& context, double over, double share) {
  if (over == double(kCwLogSpeed)) {
    const double least = cw_least_speed(context);
    return least * std::pow(context.table.most_speed_rpm / least, share);
  }
  if (over == double(kCwDrivingLoad)) return share * context.table.most_load_nm;
  return context.quantity_at_share(over, share);
}

/// Over what this bench can show a wave, and how many of them.
double most_cycles(const DriveContext& context, double over) {
  constexpr double kRowsEach = 6.0, kMost = 24.0, kWide = 3.0;
  const double n = static_cast<double>(context.table.points.size());
  const BenchTable& t = context.table;
  if (over == double(kCwRun)) return has_one_course(context) ? std::min(kMost, n / kRowsEach) : 0.0;
  if (over == double(kCwTemperature) && !(t.has_temperature && t.temperature_span_c > 3.0))
    return 0.0;
  if (over == double(kCwLogSpeed) && !(t.most_speed_rpm > kWide * cw_least_speed(context)))
    return 0.0;
  std::vector<double> values;
  for (const BenchPoint& p : t.points) values.push_back(cw_share(context, p, over));
  std::sort(values.begin(), values.end());
  double levels = 1.0;
  for (std::size_t i = 1; i < values.size(); ++i)
    levels += values[i] - values[i - 1] > 0.004 ? 1.0 : 0.0;
  return std::min({0.5 * kMost, n / kRowsEach, (levels - 1.0) / 3.0});
}

std::string cw_unit(double over) {
  return is_cw_load(over) ? " N m at the input" : over == double(kCwTemperature) ? " C" : " rpm";
}

/// The first place from the start of the range on at which most of it stands.
double cw_first_most(const DriveShape& s, double amount) {
  const double phase = s[kCwPhase] + (amount < 0.0 && s[kCwBased] == 0.0 ? 0.5 : 0.0);
  return (phase - std::floor(phase)) / s[kCwCycles];
}

std::vector<Parameter> cw_figures(const DriveContext& context, const DriveShape& s, double amount) {
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
  const double over = s[kCwOver], cycles = s[kCwCycles];
  if (over == double(kCwRun))
    figures.push_back(figure_of("period_rows", cw_rows(context) / cycles));
  else if (over == double(kCwLogSpeed))
    figures.push_back(
        figure_of("period_times",
                  std::pow(context.table.most_speed_rpm / cw_least_speed(context), 1.0 / cycles)));
  else
    figures.push_back(
        figure_of(is_cw_load(over)           ? "period_nm"
                  : over == double(kCwSpeed) ? "period_rpm"
                                             : "period_c",
                  cw_quantity(context, over, 1.0 / cycles) - cw_quantity(context, over, 0.0)));
  figures.push_back(figure_of("periods", cycles));
  if (s[kCwReads] != 0.0)
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  return figures;
}

std::string cw_told(const DriveContext& context, const DriveShape& s, double amount,
                    const std::vector<Parameter>& figures) {
  const bool reads = s[kCwReads] != 0.0, based = s[kCwBased] != 0.0;
  const double over = s[kCwOver], first = cw_first_most(s, amount);
  std::string period, most;
  if (over == double(kCwRun)) {
    for (const BenchPoint& p : context.table.points)
      if (most.empty() && p.taken >= first - 0.5 / cw_rows(context))
        most = "line " + std::to_string(p.line);
    if (most.empty()) most = "line " + std::to_string(context.table.points.back().line);
    period = "with a period of " + with_interval(figures[1], " rows");
  } else {
    const double turn = first > 1.0 ? first - 1.0 / s[kCwCycles] : first;
    most = printed("%.4g", cw_quantity(context, over, turn)) + cw_unit(over);
    period = over == double(kCwLogSpeed)
                 ? "again at every " + with_interval(figures[1], " times the speed")
                 : "again every " + with_interval(figures[1], cw_unit(over));
  }
  const std::string of = over == double(kCwRun) ? "course of the run"
                         : over == double(kCwLogSpeed)
                             ? "logarithm of the speed"
                             : name_of_quantity(is_cw_load(over) ? 0.0 : over);
  const Parameter& size = reads ? figures.back() : figures.front();
  const std::string amounts =
      based ? "between nothing and " +
                  with_interval(size, amount > 0.0 ? " N m more" : " N m less") + ", most of that"
            : with_interval(size, " N m to either side") + ", most";
  return (reads ? "a reading of the output's torque" : "a loss at the input") +
         std::string(" that comes and goes in a wave over the ") + of + ", " + period + ": " +
         amounts + " at " + most + (reads ? kNoLoss : "");
}

std::vector<DriveShape> cw_whole_shapes(const DriveContext& context, bool reads) {
  constexpr double kFewest = 1.25, kFewestOfRun = 2.25, kStep = 0.2;
  constexpr int kPhases = 8;
  std::vector<DriveShape> shapes;
  for (const double over : {double(kCwLoad), double(kCwSpeed), double(kCwTemperature),
                            double(kCwLogSpeed), double(kCwRun), double(kCwDrivingLoad)}) {
    const double most = most_cycles(context, over);
    // (slower over the run is a course of it)
    const double fewest = over == double(kCwRun) ? kFewestOfRun : kFewest;
    for (double cycles = fewest; cycles <= most; cycles += kStep)
      for (int phase = 0; phase < kPhases; ++phase)
        shapes.push_back(
            {over, cycles, static_cast<double>(phase) / kPhases, reads ? 1.0 : 0.0, 0.0});
  }
  return shapes;
}

DriveFamily coordinate_wave(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "cycles", "phase", "as_it_reads", "based"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {
      {},
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(1.0, 30.0); }},
      {.continuous = true, .is_place = true, .reach = 0.12},
      {},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return cw_whole_shapes(context, reads); };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kCwOver]); };
  f.kin_shapes = [](const DriveShape& s) {
    DriveShape based = s, lower = s;
    based[kCwBased] = lower[kCwBased] = 1.0;
    lower[kCwPhase] += 0.5;
    return std::vector<DriveShape>{s, based, lower};
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double by : growing_steps(context, 0.01, 0.6)) {
      DriveShape shape = *about;
      shape[kCwCycles] += by;
      if (!(shape[kCwCycles] > 0.5)) continue;
      // (about the middle of the range, where the number of cycles does not move it)
      for (const double phase : growing_steps(context, 0.004, 0.12)) {
        shape[kCwPhase] = (*about)[kCwPhase] + 0.5 * by + phase;
        shapes.push_back(shape);
      }
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double wave =
        std::cos(kTwoPi * (s[kCwCycles] * cw_share(context, p, s[kCwOver]) - s[kCwPhase]));
    c[0] = (s[kCwBased] != 0.0 ? 0.5 + 0.5 * wave : wave) *
           changed_nm(context, p, s[kCwReads] != 0.0 ? double(kOutputReads) : double(kDrag));
  };
  f.figures = cw_figures;
  f.told = cw_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that comes and goes in a wave over the ") +
           (s[kCwOver] == double(kCwRun) ? "run"
            : s[kCwOver] == double(kCwLogSpeed)
                ? "logarithm of the speed"
                : name_of_quantity(is_cw_load(s[kCwOver]) ? 0.0 : s[kCwOver]));
  };
  return f;
}

}  // namespace

DriveFamily unnamed_coordinate_wave() { return coordinate_wave(false); }
DriveFamily unnamed_reading_coordinate_wave() { return coordinate_wave(true); }

}  // namespace trueflank::loop::drive_effects
