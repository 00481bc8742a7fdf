// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A wave whose size is not the same all over: in proportion to the load or the speed, with the
// temperature, or growing over the run as what works loose does; and a wave by the clock, which the
// angle only imitates.
namespace trueflank::loop::drive_effects {

namespace {

enum WaveValue : std::size_t { kWaveOrder, kWaveHow, kWaveReads, kWavePhase };

/// What grows or shrinks it: the load, the speed, the temperature, the run, or nothing, over the
/// rows in place of the angle.
double size_of_wave(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  if (s[kWaveHow] == double(kWaveWithLoad)) return p.load_nm / context.table.most_load_nm;
  if (s[kWaveHow] == double(kWaveWithSpeed)) return p.speed_rpm / context.table.most_speed_rpm;
  if (s[kWaveHow] == double(kWaveWithWarmth)) return context.share_of_range(p, 2.0);
  if (s[kWaveHow] == double(kWaveWithCold)) return 1.0 - context.share_of_range(p, 2.0);
  if (s[kWaveHow] == double(kWaveForward)) return p.forward ? 1.0 : 0.0;
  if (s[kWaveHow] == double(kWaveBackward)) return p.forward ? 0.0 : 1.0;
  return s[kWaveHow] == double(kWaveGrows) ? p.taken : 1.0;
}

double rows_of_run(const DriveContext& context) {
  return std::max(1.0, static_cast<double>(context.table.points.size()) - 1.0);
}

std::vector<Parameter> wave_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
  if (s[kWaveHow] == double(kWaveByRows))
    figures.push_back(figure_of("period_rows", rows_of_run(context) / s[kWaveOrder]));
  else
    figures.push_back(figure_of("order", s[kWaveOrder]));
  if (s[kWaveReads] != 0.0)
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  return figures;
}

/// The first line of the run at which it is most.
std::string most_at_line(const DriveContext& context, double cycles, double phase) {
  const auto& points = context.table.points;
  const double taken = (phase - std::floor(phase)) / cycles;
  for (const BenchPoint& p : points)
    if (p.taken >= taken - 0.5 / rows_of_run(context)) return std::to_string(p.line);
  return std::to_string(points.back().line);
}

/// What its size follows, and where it is that size.
struct WaveWords {
  std::string follows, at;
};
WaveWords words_of_size(const DriveShape& s) {
  if (s[kWaveHow] == double(kWaveWithLoad))
    return {", in proportion to the load", " at the largest load"};
  if (s[kWaveHow] == double(kWaveWithSpeed))
    return {", in proportion to the speed", " at the highest speed"};
  if (s[kWaveHow] == double(kWaveWithWarmth))
    return {", that grows with the temperature from nothing at the lowest", " at the highest"};
  if (s[kWaveHow] == double(kWaveWithCold))
    return {", that dies away with the temperature to nothing at the highest", " at the lowest"};
  if (s[kWaveHow] == double(kWaveForward))
    return {" while the input drives", ", and nothing while the output drives"};
  if (s[kWaveHow] == double(kWaveBackward))
    return {" while the output drives", ", and nothing while the input drives"};
  return {", that grows over the run from nothing", " at its end"};
}

std::string wave_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const bool reads = s[kWaveReads] != 0.0;
  const std::string size = reads ? with_interval(figures[2], " N m more and less of it")
                                 : with_interval(figures[0], " N m to either side");
  const std::string what = reads ? "a reading of the output's torque" : "a loss at the input";
  const double phase = s[kWavePhase] + (amount < 0.0 ? 0.5 : 0.0);
  if (s[kWaveHow] == double(kWaveByRows))
    return what + " that comes and goes with the time, with a period of " +
           with_interval(figures[1], " rows") + ": " + size + ", most at line " +
           most_at_line(context, s[kWaveOrder], phase) +
           (reads ? " (a room's temperature, a supply that swings?)" : "") + (reads ? kNoLoss : "");
  const double every = 360.0 / s[kWaveOrder], most = every * (phase - std::floor(phase));
  const std::string where =
      every > 361.0 ? printed(", most %.3g turns of the input", most / 360.0) +
                          printed(" after its angle is 0 and every %.4g turns on", every / 360.0)
                    : printed(", most at %.3g degrees of the input", most) +
                          (every < 359.0 ? printed(" and every %.4g degrees on", every) : "");
  return what + " " + wave_in_words(context.model, s[kWaveOrder]) + words_of_size(s).follows +
         where + ": " + size + words_of_size(s).at + (reads ? kNoLoss : "");
}

}  // namespace

DriveFamily unnamed_wave() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "how", "as_it_reads", "phase"};
  f.preference = 7;
  f.stands_alone = true;
  f.is_wave_of_sizes = true;
  f.shape_values = {{}, {}, {}, {.continuous = true, .is_place = true}};
  // Waves of one size that were found say where to look.
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{}; };
  f.order = [](const DriveShape& s) {
    return s[kWaveHow] == double(kWaveByRows) ? 0.0 : s[kWaveOrder];
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const bool rows = (*about)[kWaveHow] == double(kWaveByRows);
    constexpr double kApart = 0.5;  // cycles over the run
    const double apart = rows ? kApart : kApart / std::max(1.0, context.table.turns);
    for (const double by : growing_steps(context, 0.01, 1.0)) {
      const double order = (*about)[kWaveOrder] + by * apart;
      if (!(order > 0.0)) continue;
      // (about the middle of the run, where the order does not move it)
      const double moved = 0.5 * by * kApart;
      for (const double phase : growing_steps(context, 0.003, 0.12))
        shapes.push_back({order, (*about)[kWaveHow], (*about)[kWaveReads],
                          (*about)[kWavePhase] + moved + phase});
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double cycles = s[kWaveHow] == double(kWaveByRows) ? s[kWaveOrder] * p.taken
                                                             : s[kWaveOrder] * p.angle_rad / kTwoPi;
    c[0] = size_of_wave(context, p, s) * std::cos(kTwoPi * (cycles - s[kWavePhase])) *
           in_direction(context, p, s[kWaveReads] != 0.0 ? kAsItReads : 0.0);
  };
  f.figures = wave_figures;
  f.told = wave_told;
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return s[kWaveHow] == double(kWaveByRows)
               ? std::string("that comes and goes with the time")
               : wave_in_words(model, s[kWaveOrder]) + words_of_size(s).follows;
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{
        {s[kWaveHow] == double(kWaveWithLoad) ? 1.0 : 0.0, 0.0, 0.0, 0.0, s[kWaveReads]}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
