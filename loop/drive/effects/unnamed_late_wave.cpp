// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/parts/moved_wave.h"
#include "trueflank/loop/drive/effects/registry.h"

// A wave over the angle of the input whose phase goes with the speed or the load: a reading that a
// filter or a cable delays by a fixed time, a coupling or a shaft that winds up.
namespace trueflank::loop::drive_effects {

namespace {

/// What moves it is the load that drives (0) or the speed (1), of the largest.
bool is_late_by_speed(const DriveShape& s) { return s[kMovedWhat] == 1.0; }

double share_of_lateness(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  return share_for_wave(context, p, s[kMovedWhat]);
}

std::vector<DriveShape> late_at_order(const DriveContext& context, double order, double direction) {
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
}

/// About the middle of the rows, where no phase moves.
MovedWave::Move move_lateness(const DriveContext& context, const DriveShape& about) {
  double middle = 0.0;
  for (const BenchPoint& p : context.table.points) middle += share_of_lateness(context, p, about);
  middle /= static_cast<double>(context.table.points.size());
  return [middle](DriveShape& shape, double phase, double by) {
    shape[kWavePhase] += phase - by * middle;
    shape[kMovedBy] += by;
  };
}

Parameter late_figure(const DriveContext& context, const DriveShape& s) {
  const double later_deg = 360.0 / s[kWaveOrder] * s[kMovedBy];
  return is_late_by_speed(s)
             ? figure_of("later_ms", 1e3 * later_deg / (6.0 * context.table.most_speed_rpm))
             : figure_of("later_deg_per_nm", later_deg / context.table.most_load_nm);
}

std::string late_places(const DriveContext& context, const DriveShape& s, double amount,
                        const Parameter& later) {
  const BenchTable& t = context.table;
  const bool by_speed = is_late_by_speed(s), is_late = later.value > 0.0;
  const double least = by_speed ? t.least_speed_rpm : t.least_load_nm,
               most = by_speed ? t.most_speed_rpm : t.most_load_nm;
  const auto at = [&](double quantity) {
    return printed("%.3g degrees of the input", moved_most_at_deg(s, amount, quantity / most)) +
           printed(" at %.4g", quantity) + unit_of_quantity(s[kMovedWhat]);
  };
  const Parameter by =
      is_late
          ? later
          : Parameter{
                .name = later.name, .value = -later.value, .low = -later.high, .high = -later.low};
  return at(least) + " and at " + at(most) + ", " +
         (by_speed ? with_interval(by, " ms") + (is_late ? " late at every speed" : " early")
                   : with_interval(by, " degrees") + (is_late ? " later" : " earlier") +
                         " for every N m at the input");
}

}  // namespace

DriveFamily unnamed_late_wave() {
  return moved_by(
      {.what = "over",
       .by = "late",
       .share = share_of_lateness,
       .at_order = late_at_order,
       .move = move_lateness,
       .most_by = 0.4,
       .figure = late_figure,
       .words =
           [](const DriveShape& s) {
             return std::string(", whose phase goes with the ") + name_of_quantity(s[kMovedWhat]);
           },
       .places = late_places,
       .cause =
           [](const DriveShape& s) {
             return std::string(is_late_by_speed(s) ? " (a filter, or a sensor that reads late?)"
                                                    : " (a coupling or a shaft that winds up?)");
           }});
}

}  // namespace trueflank::loop::drive_effects
