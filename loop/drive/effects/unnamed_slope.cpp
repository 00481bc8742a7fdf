// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What grows or falls evenly over the speed or the temperature: flanks that rub less when they are
// warm, a torque sensor whose zero follows the warmth of the box beside it.
namespace trueflank::loop::drive_effects {

namespace {

/// Over which quantity, at which share of its range it is nothing, and how it bends: evenly (0), or
/// as what grows (above 0) or fades by the same part in every degree.
enum SlopeValue : std::size_t { kSlopeOver, kSlopeFrom, kSlopeBend };
constexpr double kBend = 0.6;  // a factor of 1.8 over the range
constexpr double kLeastFrom = -0.6, kMostFrom = 1.6;

double along(const DriveShape& s, double share) {
  const double way = share - s[kSlopeFrom], bend = s[kSlopeBend];
  return bend == 0.0 ? way : std::expm1(bend * way) / bend;
}

bool changes_enough(const DriveContext& context, double over) {
  const BenchTable& table = context.table;
  return over == 1.0 ? table.most_speed_rpm > 1.5 * table.least_speed_rpm && table.levels[1] >= 3
                     : table.has_temperature && table.temperature_span_c >= 3.0;
}

std::vector<DriveShape> slopes_over(std::initializer_list<double> quantities,
                                    const DriveContext& context) {
  std::vector<DriveShape> shapes;
  for (const double over : quantities)
    if (changes_enough(context, over))
      for (const double from : {0.5, 0.0}) shapes.push_back({over, from, 0.0});
  return shapes;
}

/// About one, for its interval.
std::vector<DriveShape> slopes_about(const DriveContext& context, const DriveShape& about) {
  std::vector<DriveShape> shapes;
  for (const double step : growing_steps(context, 0.005, 1.5))
    if (const double from = about[kSlopeFrom] + step; from >= kLeastFrom && from <= kMostFrom)
      shapes.push_back({about[kSlopeOver], from, about[kSlopeBend]});
  return shapes;
}

std::string at_end(const DriveContext& context, const DriveShape& s, bool high) {
  return printed("%.4g", context.quantity_at_share(s[kSlopeOver], high ? 1.0 : 0.0)) +
         unit_alone(s[kSlopeOver]);
}

const char* the_more(const DriveShape& s) {
  return s[kSlopeOver] == 1.0 ? "the faster it turns" : "the warmer it is";
}

std::string flanks_told(const DriveContext& context, const DriveShape& s, double amount,
                        const std::vector<Parameter>& figures) {
  const double found = context.model.friction + context.state.shift;
  const auto value = [&](double share) {
    return printed("%.3g", found + amount * along(s, share));
  };
  return std::string("the flanks rub ") + (amount > 0.0 ? "more " : "less ") + the_more(s) +
         ": their coefficient is " + value(0.0) + " at " + at_end(context, s, false) + " and " +
         value(1.0) + " at " + at_end(context, s, true) + ", " +
         with_interval(figures[1], amount > 0.0 ? " more" : " less");
}

std::string reading_told(const DriveContext& context, const DriveShape& s, double amount,
                         const std::vector<Parameter>& figures) {
  return std::string("the output's torque reads ") + (amount > 0.0 ? "more " : "less ") +
         the_more(s) + ": " + with_interval(figures[0], " N m per" + unit_alone(s[kSlopeOver])) +
         ", " + with_interval(figures[1], amount > 0.0 ? " N m more" : " N m less") + " at " +
         at_end(context, s, true) + " than at " + at_end(context, s, false) + ", right at " +
         with_interval(figures[2], unit_alone(s[kSlopeOver])) +
         " (a torque sensor whose zero follows the temperature?)";
}

DriveFamily slope() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "from", "bend"};
  f.preference = 7;
  f.stands_alone = true;
  f.over = first_value;
  f.holds_a_constant = true;
  f.shape_values = {{}, {.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                           return std::pair(kLeastFrom, kMostFrom);
                         }}};
  return f;
}

}  // namespace

DriveFamily unnamed_flanks_slope() {
  DriveFamily f = slope();
  f.beside_load = first_value;
  f.is_odd = [](const DriveShape& s) { return s[kSlopeBend] != 0.0; };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> shapes;
    for (const double bend : {0.0, kBend, -kBend})
      shapes.push_back({s[kSlopeOver], s[kSlopeFrom], bend});
    return shapes;
  };
  // Over the speed it is tried in place of several forms; alone a product of load and speed does as
  // well.
  f.shapes = [](const DriveContext& context) { return slopes_over({2.0}, context); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about != nullptr ? slopes_about(context, *about) : slopes_over({1.0, 2.0}, context);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = context.friction_slope(p) * along(s, context.share_of_range(p, s[kSlopeOver]));
  };
  f.plausible = [](const DriveModel& model, const DriveShape&, double amount) {
    return std::abs(amount) < 2.0 * model.friction || std::abs(amount) < 0.5 * kMostFriction;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double change = amount * (along(s, 1.0) - along(s, 0.0)), size = std::abs(change);
    return std::vector<Parameter>{
        figure_of("amplitude_nm", size * nm_of_coefficient(context)),
        figure_of("coefficient_change", size),
        figure_of("coefficient_per_" + key_of_quantity(s[kSlopeOver]),
                  change / (context.quantity_at_share(s[kSlopeOver], 1.0) -
                            context.quantity_at_share(s[kSlopeOver], 0.0)))};
  };
  f.told = flanks_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("by flanks whose friction changes with the ") +
           name_of_quantity(s[kSlopeOver]);
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{
        {1.0, s[kSlopeOver] == 1.0 ? 1.0 : 0.0, s[kSlopeOver] == 2.0 ? 1.0 : 0.0, 0.0, 0.0}};
  };
  return f;
}

DriveFamily unnamed_viscous_slope() {
  DriveFamily f = slope();
  f.holds_a_constant = false;
  f.shapes = no_shapes;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about != nullptr ? slopes_about(context, *about) : slopes_over({2.0}, context);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = -context.lever(p) * p.speed_rpm / context.table.most_speed_rpm *
           along(s, context.share_of_range(p, s[kSlopeOver]));
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount * (along(s, 1.0) - along(s, 0.0)))),
        figure_of("nothing_at_" + key_of_quantity(s[kSlopeOver]),
                  context.quantity_at_share(s[kSlopeOver], s[kSlopeFrom]))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return "a loss at the input in proportion to the speed that " +
           std::string(amount > 0.0 ? "grows" : "falls") + " evenly " + the_more(s) + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
           " at the largest speed at " + at_end(context, s, true) + " than at " +
           at_end(context, s, false) + ", nothing at " +
           with_interval(figures[1], unit_alone(s[kSlopeOver])) +
           (amount > 0.0 ? " (a preload that grows with the heat?)" : " (a lubricant that thins?)");
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("in proportion to the speed, that changes evenly with the ") +
           name_of_quantity(s[kSlopeOver]);
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 1.0, 1.0, 0.0, 0.0}};
  };
  return f;
}

DriveFamily unnamed_reading_slope() {
  DriveFamily f = slope();
  f.is_loss = false;
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false) ? slopes_over({2.0}, context)
                                                               : std::vector<DriveShape>{};
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    if (about != nullptr) return slopes_about(context, *about);
    return context.table.has(true) && context.table.has(false) ? slopes_over({2.0}, context)
                                                               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = changed_nm(context, p, double(kOutputReads)) *
           along(s, context.share_of_range(p, s[kSlopeOver]));
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double size = std::abs(amount) * context.model.ratio;
    return std::vector<Parameter>{
        figure_of("reads_more_nm_per_" + key_of_quantity(s[kSlopeOver]),
                  amount * context.model.ratio /
                      (context.quantity_at_share(s[kSlopeOver], 1.0) -
                       context.quantity_at_share(s[kSlopeOver], 0.0))),
        figure_of("reading_changes_nm", size),
        figure_of("right_at_" + key_of_quantity(s[kSlopeOver]),
                  context.quantity_at_share(s[kSlopeOver], s[kSlopeFrom]))};
  };
  f.told = reading_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("by a zero of the output's torque that follows the ") +
           name_of_quantity(s[kSlopeOver]);
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 1.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
