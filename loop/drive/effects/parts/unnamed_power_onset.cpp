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

// A loss that begins at a power, load times speed: a belt or a clutch that slips, flanks that
// scuff.
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kAsPower = 3.0;  // beside load, speed, temperature
constexpr double kLeastOfPower = 0.05, kMostOfPower = 0.85;

/// Share of the largest load times the largest speed.
double share_of_power(const DriveContext& context, const BenchPoint& p) {
  return std::max(0.0, p.load_nm) / context.table.most_load_nm * p.speed_rpm /
         context.table.most_speed_rpm;
}

double most_watts(const DriveContext& context) {
  return context.table.most_load_nm * context.table.most_speed_rpm * kTwoPi / 60.0;
}

}  // namespace

DriveFamily unnamed_power_onset() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"place"};
  f.preference = 7;
  f.stands_alone = true;
  f.has_a_place = true;
  f.over = [](const DriveShape&) { return kAsPower; };
  f.shape_values = {{.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastOfPower, kMostOfPower);
                     }}};
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> all;
    const BenchTable& table = context.table;
    if (table.most_speed_rpm > 2.0 * table.least_speed_rpm && table.levels[0] >= 4 &&
        table.levels[1] >= 4)
      for (const double place : {0.15, 0.3, 0.5, 0.7}) all.push_back({place});
    return all;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about, {0.001, 0.8, kLeastOfPower, kMostOfPower});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double beyond = std::max(0.0, share_of_power(context, p) - s[0]) / (1.0 - s[0]);
    c[0] = beyond > 0.0 ? -context.lever(p) * beyond : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("begins_at_w", s[0] * most_watts(context)),
                                  figure_of("share_of_power_percent", 100.0 * s[0])};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return std::string(amount > 0.0 ? "a loss" : "a change of the loss") +
           " that begins at a power (load times speed at the input) of " +
           with_interval(figures[1], " W") + ", " + with_interval(figures[2], " %") +
           " of the largest, then " + (amount > 0.0 ? "rises" : "falls") + " to " +
           with_interval(figures[0], " N m") + (amount > 0.0 ? " more" : " less") +
           printed(" at %.4g W", most_watts(context)) +
           (amount > 0.0 ? " (a belt or a clutch that slips?)" : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that begins at a power, load times speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 1.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
