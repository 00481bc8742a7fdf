// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// Flanks whose friction falls by a power of the speed, as oil films of gears have it (Schlenk;
// ISO/TR 14179-2: n^-0.2 to n^-0.25): the less the faster they slide, and without an end.
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kLeastBend = 0.04, kMostBend = 1.2;

double coefficient_at(const DriveContext& context, const DriveShape& s, double share,
                      double speed_rpm) {
  return (context.model.friction + context.state.shift) *
         (1.0 + share * context.course_of_speed(speed_rpm, s[0]));
}

}  // namespace

DriveFamily unnamed_friction_by_speed() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount"};
  f.shape_names = {"bend"};
  f.preference = 7;
  f.stands_alone = true;
  f.follows = "speed";
  f.over = [](const DriveShape&) { return 1.0; };
  f.beside_load = f.over;
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastBend, kMostBend);
                     }}};
  f.shapes = [](const DriveContext& context) {
    constexpr double kWide = 3.0;
    std::vector<DriveShape> shapes;
    if (context.table.levels[1] >= 4 && context.table.levels[0] >= 3 &&
        context.table.most_speed_rpm > kWide * context.table.least_speed_rpm)
      for (const double bend : {0.05, 0.12, 0.25, 0.5, 1.0}) shapes.push_back({bend});
    return shapes;
  };
  f.whole_shapes = f.shapes;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.02, 1.5, kLeastBend, kMostBend, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = context.friction_slope(p) * (context.designed_friction(p) + context.state.shift) *
           context.course_of_speed(p.speed_rpm, s[0]);
  };
  f.into_state = [](DriveState& state, const DriveShape& s, double share) {
    state.speed_share = share;
    state.speed_bend = s[0];
  };
  f.plausible = [](const DriveModel&, const DriveShape&, double share) {
    return std::abs(share) < 1.2;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double share) {
    const double slow = coefficient_at(context, s, share, context.table.least_speed_rpm),
                 fast = coefficient_at(context, s, share, context.table.most_speed_rpm);
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(slow - fast) * nm_of_coefficient(context)),
        figure_of("exponent", share), figure_of("friction_slowest", slow),
        figure_of("friction_fastest", fast)};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double share,
              const std::vector<Parameter>& figures) {
    Parameter exponent = figures[1];
    if (share < 0.0) exponent = {exponent.name, -exponent.value, -exponent.high, -exponent.low};
    return std::string("the flanks rub ") + (share > 0.0 ? "less" : "more") +
           " the faster they slide, by a power of the speed: their coefficient is " +
           with_interval(figures[2], "") + printed(" at %.4g rpm", context.table.least_speed_rpm) +
           " and " + with_interval(figures[3], "") +
           printed(" at %.4g rpm", context.table.most_speed_rpm) + "; in the middle it goes by n^" +
           (share > 0.0 ? "-" : "") + with_interval(exponent, "") +
           (share > 0.0 ? " (an oil film, as of gears that run in oil?)" : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("by the friction of the flanks, that follows a power of the speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 1.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
