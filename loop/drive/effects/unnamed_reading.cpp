// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What a sensor of the output reads wrong: by a power of the speed, near no load alone, by a gain
// that follows the temperature. It has the same sign in both directions, where a loss takes from
// either: both directions tell the two apart.
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kLeastPower = 0.6, kMostPower = 4.0;
constexpr double kLeastShare = 0.008, kMostShare = 0.35;  // of the largest load
constexpr double kLeastRight = -0.6, kMostRight = 1.6;    // of the range of temperatures

bool has_both(const DriveContext& context) {
  return context.table.has(true) && context.table.has(false);
}

/// Change of the driven torque for a reading of the output that is 1 N m, as a torque at the input,
/// too much.
double read_too_much(const DriveContext& context, const BenchPoint& p) {
  return context.model.ratio * context.misread(p, false);
}

/// The least share of the largest load within which what is there under load alone may come: a part
/// of it must be missing where the least load was run, or it is a zero that is wrong at every load,
/// which has a name.
double least_share(const DriveContext& context, double gone) {
  constexpr double kOfLeast = 0.7;  // a quarter is missing there
  return gone != 0.0 ? kLeastShare
                     : std::max(kLeastShare, kOfLeast * context.table.least_load_nm /
                                                 context.table.most_load_nm);
}

std::string speed_text(const DriveContext& context) {
  return printed("%.4g rpm", context.table.most_speed_rpm);
}

}  // namespace

DriveFamily unnamed_reading_power() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"power"};
  f.correction =
      "turn the output at these speeds with nothing coupled to it: what its torque reads then is "
      "the error";
  f.over = [](const DriveShape&) { return 1.0; };
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastPower, kMostPower);
                     }}};
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> powers;
    if (has_both(context) && context.table.levels[1] >= 3 &&
        context.table.most_speed_rpm > 1.5 * context.table.least_speed_rpm)
      for (const double power : {1.0, 2.0, 3.0}) powers.push_back({power});
    return powers;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about, {0.01, 1.0, kLeastPower, kMostPower, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double share = std::max(0.0, p.speed_rpm) / context.table.most_speed_rpm;
    c[0] = read_too_much(context, p) * std::pow(share, s[0]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("reads_more_nm", amount * context.model.ratio),
                                  figure_of("power", s[0])};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "the output's torque " + reads_in_words(figures[0]) + " at " + speed_text(context) +
           ", by the power " + with_interval(figures[1], " of the speed") +
           kNoLoss;
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading of the output's torque that follows the speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 2.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

DriveFamily unnamed_reading_near_zero() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"share_of_load", "gone_there"};
  f.correction =
      "load the output by small weights on a lever, up and down: what its torque reads otherwise "
      "than they say is the error";
  f.over = [](const DriveShape&) { return 0.0; };
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastShare, kMostShare);
                     }}};
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[1]); };
  f.shows = [](const DriveContext& context, const DriveShape& s) {
    return s[0] >= least_share(context, s[1]);
  };
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> all;
    if (has_both(context) && context.table.levels[0] >= 4)
      for (const double gone : {0.0, 1.0})
        for (const double share : {0.03, 0.1, 0.25})
          if (share >= least_share(context, gone)) all.push_back({share, gone});
    return all;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about,
                                  {0.01, 1.5, least_share(context, (*about)[1]), kMostShare, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double gone = std::exp(-true_share(context, p) / s[0]);
    c[0] = read_too_much(context, p) * (s[1] != 0.0 ? gone : 1.0 - gone);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{
        figure_of("reads_more_nm", amount * context.model.ratio),
        figure_of("within_output_nm", s[0] * context.table.most_load_nm * context.model.ratio)};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double,
              const std::vector<Parameter>& figures) {
    const std::string within = with_interval(figures[1], " N m");
    return "the output's torque " + reads_in_words(figures[0]) +
           (s[1] != 0.0 ? " near no load; all but a third of that is gone within " + within
                        : " under load and not at none; all but a third of that is reached "
                          "within " +
                              within) +
           " at the output" + kNoLoss +
           (s[1] != 0.0 ? "" : ": a dead zone, a spline or a cell that sticks?");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading of the output's torque that differs near no load");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{2.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

DriveFamily unnamed_gain_slope() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"right_at"};
  f.correction =
      "hang the same weight on a lever at the output, cold and warm: the gain is what changes";
  f.over = [](const DriveShape&) { return 2.0; };
  f.beside_load = f.over;
  f.holds_a_constant = true;
  // A place moves little: it starts inside the range and beside it.
  f.kin_shapes = [](const DriveShape&) { return std::vector<DriveShape>{{0.5}, {-0.1}, {1.1}}; };
  f.shape_values = {{.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastRight, kMostRight);
                     }}};
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> all;
    if (has_both(context) && context.table.levels[0] >= 3 && context.table.has_temperature &&
        context.table.temperature_span_c >= 3.0)
      for (const double right : {0.5, 0.0}) all.push_back({right});
    return all;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about, {0.005, 1.5, kLeastRight, kMostRight});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = read_too_much(context, p) * true_share(context, p) * context.table.most_load_nm *
           (context.share_of_range(p, 2.0) - s[0]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{
        figure_of("gain_percent_per_c",
                  100.0 * amount / std::max(context.table.temperature_span_c, 1e-9)),
        figure_of("gain_changes_percent", 100.0 * std::abs(amount)),
        figure_of("right_at_c", context.quantity_at_share(2.0, s[0]))};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return std::string("the output's torque reads ") + (amount > 0.0 ? "more" : "less") +
           " the warmer it is, in proportion to the load: its gain changes by " +
           with_interval(figures[0], " % per C") + ", " + with_interval(figures[1], " %") +
           printed(" from %.3g", context.quantity_at_share(2.0, 0.0)) +
           printed(" to %.3g C", context.quantity_at_share(2.0, 1.0)) + ", right at " +
           with_interval(figures[2], " C") + kNoLoss;
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a gain of the output's torque that follows the temperature");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 1.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
