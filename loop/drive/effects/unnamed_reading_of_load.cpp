// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What a sensor of the output reads wrong by a power of its own load, as one that is bent or feels
// a thrust does; and what rubs beside it, so that it reads more driven and less driving.
namespace trueflank::loop::drive_effects {

namespace {
constexpr double kLeastOfLoad = 1.3, kMostOfLoad = 5.0;    // powers
constexpr double kRightSoonest = 0.5, kRightLatest = 1.6;  // of the largest load

std::string weights_up_to_the_largest() {
  return "load the output by weights on a lever up to the largest torque: what its torque reads "
         "otherwise than they say is the error";
}
}  // namespace

DriveFamily unnamed_reading_of_load() {
  constexpr int kFewestLoads = 4;
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"power"};
  f.correction = weights_up_to_the_largest();
  f.over = [](const DriveShape&) { return 0.0; };
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastOfLoad, kMostOfLoad);
                     }}};
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> powers;
    if (context.table.has(true) && context.table.has(false) &&
        context.table.levels[0] >= kFewestLoads)
      for (const double power : {2.0, 3.0, 4.0}) powers.push_back({power});
    return powers;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about, {0.005, 1.5, kLeastOfLoad, kMostOfLoad, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = context.model.ratio * context.misread(p, false) * std::pow(true_share(context, p), s[0]);
  };
  // (what it is at the largest load that the output carried)
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double most_nm = context.table.most_carried_nm,
                 at_most = amount * std::pow(most_nm / context.table.most_load_nm, s[0]);
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("reads_more_nm", at_most * context.model.ratio),
                                  figure_of("percent_at_most", 100.0 * at_most / most_nm),
                                  figure_of("power", s[0])};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return "the output's torque " + reads_in_words(figures[1]) + ", " +
           percent_in_words(figures[2]) +
           printed(", at its largest load of %.4g N m,",
                   context.table.most_carried_nm * context.model.ratio) +
           " by the power " + with_interval(figures[3], " of the load") + kNoLoss +
           (amount < 0.0 ? ": a sensor that saturates?" : ": a sensor that is bent?");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading of the output's torque by a power of its load");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{2.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

DriveFamily unnamed_reading_bow_of_load() {
  constexpr int kFewestLoads = 5;
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"right_again_at"};
  f.correction = weights_up_to_the_largest();
  f.over = [](const DriveShape&) { return 0.0; };
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext&) {
                       return std::pair(kRightSoonest, kRightLatest);
                     }}};
  // A zero and a gain, which have names, do it beside a curve: it is tried in their place.
  f.shapes = no_shapes;
  f.may_stand_for = some_follows_the_load;
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> places;
    if (context.table.has(true) && context.table.has(false) &&
        context.table.levels[0] >= kFewestLoads)
      for (const double right : {0.6, 0.75, 0.9, 1.0, 1.15, 1.4}) places.push_back({right});
    return places;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.005, 1.0, kRightSoonest, kRightLatest, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double x = true_share(context, p) / s[0];
    c[0] = context.model.ratio * context.misread(p, false) * 4.0 * x * (1.0 - x);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double right_nm = s[0] * context.table.most_load_nm * context.model.ratio;
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("reads_more_nm", amount * context.model.ratio),
                                  figure_of("most_at_output_nm", 0.5 * right_nm),
                                  figure_of("right_again_at_output_nm", right_nm)};
  };
  f.told = [](const DriveContext&, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "the output's torque is read in a bow over its load: right at none, it " +
           reads_in_words(figures[1]) + " at " + with_interval(figures[2], " N m") +
           " and is right again at " + with_interval(figures[3], " N m") + kNoLoss + ": a sensor that is not straight?";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading of the output's torque in a bow over its load");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{2.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

DriveFamily unnamed_reading_by_direction() {
  DriveFamily f = reading_without_a_name();
  f.only_positive = true;  // less than nothing is lost: it is a drag
  f.correction =
      "load the output by weights on a lever, and pull it both ways: what its torque reads "
      "otherwise is the error";
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false) ? std::vector<DriveShape>{{}}
                                                               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = (p.forward ? 1.0 : -1.0) * context.model.ratio * context.misread(p, false);
  };
  f.figures = [](const DriveContext& context, const DriveShape&, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("reads_more_nm", amount * context.model.ratio)};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "the output's torque " + reads_in_words(figures[1]) +
           " while the input drives and as much less while the output drives (a torque arm or its "
           "bearing that rubs?), or the input's torque " +
           printed("%.3g N m less and more", figures[1].value / context.model.ratio) +
           ": torque that no drive can gain, a reading";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading that is more in the one direction and less in the other");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
