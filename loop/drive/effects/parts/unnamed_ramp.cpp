// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What is nothing up to a place and grows evenly from there: with the logarithm of the speed, or
// over the run (or falls to nothing at its foot); and a resonance whose speed follows the
// temperature or the load.
namespace trueflank::loop::drive_effects {

namespace {

enum RampValue : std::size_t { kRampPlace, kRampBelow, kRampOf };
constexpr double kNearestRamp = 0.08, kFarthestRamp = 0.92;

double lowest_speed(const DriveContext& context) {
  return std::max(context.table.least_speed_rpm, 1e-3 * context.table.most_speed_rpm);
}
/// 0 ... 1 over the logarithm of the speed.
double log_speed_share(const DriveContext& context, const BenchPoint& p) {
  const double least = lowest_speed(context);
  return std::log(std::max(p.speed_rpm, least) / least) /
         std::log(std::max(1.001, context.table.most_speed_rpm / least));
}
double speed_at_share(const DriveContext& context, double share) {
  const double least = lowest_speed(context);
  return least * std::pow(context.table.most_speed_rpm / least, share);
}
bool has_wide_speeds(const DriveContext& context) {
  constexpr double kWide = 5.0;
  constexpr int kFewestLevels = 6;
  return context.table.levels[1] >= kFewestLevels &&
         context.table.most_speed_rpm > kWide * lowest_speed(context);
}

int line_from(const BenchTable& table, double place) {
  for (const BenchPoint& p : table.points)
    if (p.taken > place) return p.line;
  return table.points.back().line;
}

/// What both have in common: a place, and from it on to which end it grows.
DriveFamily ramp(bool over_run) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"place", "below", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {
      {.continuous = true,
       .is_place = true,
       .reach = 0.1,
       .limits = [](const DriveContext&) { return std::pair(kNearestRamp, kFarthestRamp); }},
      {},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [over_run](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (over_run ? !has_one_course(context) : !has_wide_speeds(context)) return shapes;
    for (const double what : {double(kDrag), double(kFlanks)})
      for (const double below : {0.0, 1.0})
        for (double place = kNearestRamp; place <= kFarthestRamp; place += 0.02)
          shapes.push_back({place, below, what});
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(2.0 * s[kRampOf] + s[kRampBelow]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.001, 0.3, kNearestRamp, kFarthestRamp});
  };
  f.evaluate = [over_run](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                          double* c) {
    const double share = over_run ? p.taken : log_speed_share(context, p), place = s[kRampPlace],
                 beyond = s[kRampBelow] != 0.0 ? (place - share) / place
                                               : (share - place) / (1.0 - place);
    c[0] = beyond > 0.0 ? beyond * changed_nm(context, p, s[kRampOf]) : 0.0;
  };
  f.figures = [over_run](const DriveContext& context, const DriveShape& s, double amount) {
    const std::string key = s[kRampBelow] != 0.0 ? "ends_at_" : "begins_at_";
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        over_run ? figure_of(key + "line", line_from(context.table, s[kRampPlace]))
                 : figure_of(key + "rpm", speed_at_share(context, s[kRampPlace]))};
  };
  f.words = [over_run](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string(over_run ? "that grows or falls evenly over a part of the run"
                                : "that begins or ends at a speed, by the logarithm of it");
  };
  return f;
}

std::string of_ramp(const std::vector<Parameter>& figures, const DriveShape& s, double amount) {
  return with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
         (s[kRampOf] == double(kFlanks) ? " at the largest load, in proportion to it" : "");
}

enum MovingValue : std::size_t { kMovingPlace, kMovingHalf, kMovingBy, kMovingOver };

/// Where in the range of what moves it, -0.5 ... 0.5.
double mover(const DriveContext& context, const BenchPoint& p, double over) {
  const double least = over == 0.0 ? context.least_share(0.0) : 0.0;
  return (context.share_of_range(p, over) - least) / std::max(1e-9, 1.0 - least) - 0.5;
}

double peak_speed(const DriveContext& context, const DriveShape& s, double at) {
  return speed_at_share(context, s[kMovingPlace] + s[kMovingBy] * at);
}

}  // namespace

DriveFamily unnamed_fade() {
  DriveFamily f = ramp(true);
  f.follows_the_run = true;
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const std::string line = with_interval(figures[1], "");
    return s[kRampBelow] != 0.0
               ? "a loss at the input at the start of the run, " + of_ramp(figures, s, amount) +
                     " in its first row, that goes evenly and is nothing from line " + line +
                     " on (warmth, running in?)"
               : "a loss at the input that begins at line " + line +
                     " of the run and grows evenly: " + of_ramp(figures, s, amount) + " at its end";
  };
  return f;
}

DriveFamily unnamed_log_onset() {
  DriveFamily f = ramp(false);
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const bool below = s[kRampBelow] != 0.0;
    return std::string("a loss at the input that ") + (below ? "ends" : "begins") +
           " at a speed of " + with_interval(figures[1], " rpm") + " and grows evenly with the " +
           "logarithm of the speed " + (below ? "below" : "above") + ": " +
           of_ramp(figures, s, amount) + " at " +
           printed("%.4g rpm", below ? lowest_speed(context) : context.table.most_speed_rpm);
  };
  return f;
}

DriveFamily unnamed_moving_hump() {
  constexpr double kLeastHalf = 0.015, kMostHalf = 0.3;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"place", "half_width", "moves_by", "over"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {
      {.continuous = true,
       .is_place = true,
       .reach = 0.05,
       .limits = [](const DriveContext&) { return std::pair(-0.2, 1.2); }},
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.015, 0.3); }},
      {.continuous = true,
       .is_place = true,
       .reach = 0.1,
       .limits = [](const DriveContext&) { return std::pair(-1.5, 1.5); }},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr double kLeastSpan = 8.0;
    constexpr int kFewestLoads = 4;
    std::vector<DriveShape> shapes;
    if (!has_wide_speeds(context)) return shapes;
    for (const double over : {0.0, 2.0}) {
      if (over == 0.0 ? context.table.levels[0] < kFewestLoads
                      : !(context.table.temperature_span_c > kLeastSpan))
        continue;
      for (const double half : {0.03, 0.06, 0.12})
        for (double place = 0.04; place < 1.0; place += 0.8 * half)
          for (double by = -1.05; by < 1.1; by += 0.15)
            if (std::abs(by) > 0.2) shapes.push_back({place, half, by, over});
    }
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kMovingOver]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double place : growing_steps(context, 0.003, 0.05))
      for (const double wider : growing_steps(context, 0.05, 0.5))
        for (const double by : growing_steps(context, 0.02, 0.3)) {
          const double half = (*about)[kMovingHalf] * std::exp(wider);
          if (half > kLeastHalf && half < kMostHalf)
            shapes.push_back({(*about)[kMovingPlace] + place, half, (*about)[kMovingBy] + by,
                              (*about)[kMovingOver]});
        }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double x = (log_speed_share(context, p) - s[kMovingPlace] -
                      s[kMovingBy] * mover(context, p, s[kMovingOver])) /
                     s[kMovingHalf];
    c[0] = x * x < 40.0 ? -context.lever(p) * std::exp2(-x * x) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const bool load = s[kMovingOver] == 0.0;
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of(load ? "at_rpm_at_least_load" : "at_rpm_at_lowest_c",
                  peak_speed(context, s, -0.5)),
        figure_of(load ? "at_rpm_at_largest_load" : "at_rpm_at_highest_c",
                  peak_speed(context, s, 0.5)),
        figure_of("half_width_times",
                  std::pow(context.table.most_speed_rpm / lowest_speed(context), s[kMovingHalf]))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const bool load = s[kMovingOver] == 0.0;
    const double least = context.table.least_temperature_c;
    return "a loss that is " + std::string(amount > 0.0 ? "largest" : "least") +
           " at a speed that moves with the " + name_of_quantity(s[kMovingOver]) + ", from " +
           with_interval(figures[1], " rpm") +
           (load ? std::string(" at the least load") : printed(" at %.3g C", least)) + " to " +
           with_interval(figures[2], " rpm") +
           (load ? std::string(" at the largest")
                 : printed(" at %.3g C", least + context.table.temperature_span_c)) +
           ": " + with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
           ", half of that at " + with_interval(figures[3], " times the speed") +
           " to either side (a resonance?)";
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("with a hump over the speed that moves with the ") +
           name_of_quantity(s[kMovingOver]);
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
