// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A wave over the angle of the input whose phase goes with the speed or the load: a reading that a
// filter or a cable delays by a fixed time, a coupling or a shaft that winds up.
namespace trueflank::loop::drive_effects {

namespace {

/// After the values of a wave of sizes up to its phase, which is that at no speed or no load.
enum LateValue : std::size_t {
  kLateOver = kWavePhase + 1,  ///< 0: the load, 1: the speed
  kLateBy,                     ///< periods that it is later at the largest load or speed
};

bool late_reads(const DriveShape& s) { return s[kWaveDirection] == kAsItReads; }

/// The load that drives or the speed, of the largest.
double share_of_lateness(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  return share_for_wave(context, p, s[kLateOver]);
}

/// Degrees of the input, 0 ... one period, at which it is most at a load or a speed.
double most_at_deg(const DriveShape& s, double amount, double share) {
  const double periods = s[kWavePhase] + s[kLateBy] * share + (amount < 0.0 ? 0.5 : 0.0);
  return 360.0 / s[kWaveOrder] * (periods - std::floor(periods));
}

std::vector<Parameter> late_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  const BenchTable& t = context.table;
  const double later_deg = 360.0 / s[kWaveOrder] * s[kLateBy];
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                 figure_of("order", s[kWaveOrder])};
  if (s[kLateOver] == 1.0)
    figures.push_back(figure_of("later_ms", 1e3 * later_deg / (6.0 * t.most_speed_rpm)));
  else
    figures.push_back(figure_of("later_deg_per_nm", later_deg / t.most_load_nm));
  if (late_reads(s))
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  return figures;
}

std::string late_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const BenchTable& t = context.table;
  const bool reads = late_reads(s), by_speed = s[kLateOver] == 1.0;
  const double least = by_speed ? t.least_speed_rpm : t.least_load_nm,
               most = by_speed ? t.most_speed_rpm : t.most_load_nm;
  const std::string unit = unit_of_quantity(s[kLateOver]);
  const auto at = [&](double quantity) {
    return printed("%.3g degrees of the input", most_at_deg(s, amount, quantity / most)) +
           printed(" at %.4g", quantity) + unit;
  };
  const Parameter& later = figures[2];
  const bool is_late = later.value > 0.0;
  const Parameter by =
      is_late
          ? later
          : Parameter{
                .name = later.name, .value = -later.value, .low = -later.high, .high = -later.low};
  const std::string size = reads ? with_interval(figures[3], " N m more and less of it")
                                 : with_interval(figures[0], " N m to either side");
  return (reads ? "a reading of the output's torque " : "a loss at the input ") +
         wave_in_words(context.model, s[kWaveOrder]) +
         (s[kWaveHow] == double(kWaveWithLoad) ? ", in proportion to the load" : "") +
         ", whose phase goes with the " + name_of_quantity(s[kLateOver]) + ": " + size +
         (s[kWaveHow] == double(kWaveWithLoad) ? " at the largest load" : "") + ", most at " +
         at(least) + " and at " + at(most) + ", " +
         (by_speed ? with_interval(by, " ms") + (is_late ? " late at every speed" : " early")
                   : with_interval(by, " degrees") + (is_late ? " later" : " earlier") +
                         " for every N m at the input") +
         (reads ? kNoLoss : "") +
         (by_speed ? " (a filter, or a sensor that reads late?)"
                   : " (a coupling or a shaft that winds up?)");
}

/// Orders, phases and latenesses near by; about the middle of the rows, where no phase moves.
std::vector<DriveShape> late_near(const DriveContext& context, const DriveShape& about) {
  constexpr double kApart = 0.5;  // cycles over the run
  double middle = 0.0;
  for (const BenchPoint& p : context.table.points) middle += share_of_lateness(context, p, about);
  middle /= static_cast<double>(context.table.points.size());
  std::vector<DriveShape> shapes;
  for (const double phase : growing_steps(context, 0.003, 0.12)) {
    for (const double by : growing_steps(context, 0.01, 1.0)) {
      DriveShape shape = about;
      shape[kWaveOrder] += by * kApart / std::max(1.0, context.table.turns);
      if (!(shape[kWaveOrder] > 0.0)) continue;
      shape[kWavePhase] += phase + 0.5 * by * kApart;
      shapes.push_back(shape);
    }
    for (const double later : growing_steps(context, 0.004, 0.4)) {
      DriveShape shape = about;
      shape[kWavePhase] += phase - later * middle;
      shape[kLateBy] += later;
      shapes.push_back(shape);
    }
  }
  return shapes;
}

}  // namespace

DriveFamily unnamed_late_wave() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "how", "direction", "phase", "over", "late"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {},
                    {}, {.continuous = true, .is_place = true},
                    {}, {.continuous = true, .is_place = true, .reach = 0.1}};
  f.shapes = no_shapes;
  f.late_waves_at_order = [](const DriveContext& context, double order, double direction) {
    constexpr double kMost = 1.5, kStep = 1.0 / 8.0;
    constexpr int kFewest = 5;
    std::vector<DriveShape> shapes;
    for (const double over : {0.0, 1.0}) {
      if (context.table.levels[static_cast<std::size_t>(over)] < kFewest) continue;
      for (const double how : {double(kWaveEven), double(kWaveWithLoad)})
        for (double late = -kMost; late < kMost + 0.5 * kStep; late += kStep)
          if (std::abs(late) > 0.5 * kStep)
            shapes.push_back({order, how, direction, 0.0, over, late});
    }
    return shapes;
  };
  f.order = [](const DriveShape& s) { return s[kWaveOrder]; };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : late_near(context, *about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double periods = s[kWaveOrder] * p.angle_rad / kTwoPi - s[kWavePhase] -
                           s[kLateBy] * share_of_lateness(context, p, s);
    c[0] = size_of_wave(context, p, s[kWaveHow]) * std::cos(kTwoPi * periods) *
           in_direction(context, p, s[kWaveDirection]);
  };
  f.figures = late_figures;
  f.told = late_told;
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return wave_in_words(model, s[kWaveOrder]) + ", whose phase goes with the " +
           name_of_quantity(s[kLateOver]);
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{{s[kWaveHow] == double(kWaveWithLoad) ? 1.0 : 0.0, 0.0, 0.0, 0.0,
                                    late_reads(s) ? 1.0 : 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
