// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that grows by a power of the speed and begins nowhere: air and oil that are moved, or a
// grease that hardly flows. Powers between have names: bearings, a viscous drag.
namespace trueflank::loop::drive_effects {

namespace {
constexpr std::pair kPowers{1.6, 3.0}, kRoots{0.25, 0.6}, kRootsShown{0.1, 1.0};

DriveFamily power_of_speed(bool root) {
  const auto [least, most] = root ? kRoots : kPowers;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"power"};
  f.preference = 7;
  f.stands_alone = true;
  // A power at the end of its range is that of something else.
  f.begins_nowhere = [least = least, most = most](const DriveShape& s) {
    constexpr double kInside = 0.02;
    return s[0] > least + kInside && s[0] < most - kInside;
  };
  f.over = [](const DriveShape&) { return 1.0; };
  // Beside a constant a root moves to where it is nearly straight: each is asked with one and
  // without.
  f.holds_a_constant = root;
  f.shape_values = {
      {.continuous = true,
       .limits = [limits = std::pair(least, most)](const DriveContext&) { return limits; }}};
  // Found alone it is drag that grows with the speed, which has names: it is tried in place of
  // pieces.
  f.shapes = no_shapes;
  f.all_shapes = [root](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> powers;
    if (context.table.levels[1] < 4) return powers;
    if (about == nullptr) {
      for (const double power : root ? std::vector{0.35, 0.5} : std::vector{1.75, 2.0, 2.5, 3.0})
        powers.push_back({power});
      return powers;
    }
    const auto [lowest, highest] = root ? kRootsShown : kPowers;
    return with_first_moved(context, *about, {0.005, 1.0, lowest, highest, true});
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
           (figures[1].value < 1.0 ? " ever slower with the speed, by its power "
                                   : " ever faster with the speed, by its power ") +
           with_interval(figures[1], "") + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") + " at " +
           printed("%.4g rpm", context.table.most_speed_rpm) + " than at rest" +
           (amount <= 0.0            ? ""
            : figures[1].value < 1.0 ? " (a grease that flows only under stress?)"
                                     : " (air or oil that is moved?)");
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string(s[0] < 1.0 ? "that grows ever slower with the speed"
                                  : "that grows ever faster with the speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 2.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace

DriveFamily unnamed_power() { return power_of_speed(false); }
DriveFamily unnamed_root() { return power_of_speed(true); }

}  // namespace trueflank::loop::drive_effects
