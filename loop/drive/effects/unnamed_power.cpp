// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that grows by a power of the speed and begins nowhere: air and oil that are moved.
namespace trueflank::loop::drive_effects {

namespace {
constexpr double kLeastOfPowers = 1.6, kMostOfPowers = 3.0;
}

DriveFamily unnamed_power() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"power"};
  f.preference = 7;
  f.stands_alone = true;
  // A power at the end of its range is that of something else.
  f.begins_nowhere = [](const DriveShape& s) {
    constexpr double kInside = 0.02;
    return s[0] > kLeastOfPowers + kInside && s[0] < kMostOfPowers - kInside;
  };
  f.over = [](const DriveShape&) { return 1.0; };
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastOfPowers, kMostOfPowers);
                     }}};
  // Found alone it is drag that grows with the speed, which has names: it is tried in place of
  // pieces.
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{}; };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> powers;
    if (context.table.levels[1] < 4) return powers;
    if (about == nullptr) {
      for (const double power : {1.75, 2.0, 2.5, 3.0}) powers.push_back({power});
      return powers;
    }
    for (const double step : growing_steps(context, 0.005, 1.0))
      if (const double power = about->front() * std::exp(step);
          power >= kLeastOfPowers && power <= kMostOfPowers)
        powers.push_back({power});
    return powers;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = -context.lever(p) *
           std::pow(std::max(0.0, p.speed_rpm) / context.table.most_speed_rpm, s[0]);
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("power", s[0])};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return std::string("a loss that ") + (amount > 0.0 ? "grows" : "falls") +
           " ever faster with the speed, by its power " + with_interval(figures[1], "") + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") + " at " +
           printed("%.4g rpm", context.table.most_speed_rpm) + " than at rest" +
           (amount > 0.0 ? " (air or oil that is moved?)" : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that grows ever faster with the speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 2.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
