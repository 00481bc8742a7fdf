// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// An output's torque that is read otherwise from a load on: a sensor or an amplifier that
// saturates, a stop that a lever meets. Both directions tell it from a loss.
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kLeastBend = 0.15, kMostBend = 0.95;  // of the largest load

double beyond_bend(double share, const DriveShape& s) {
  return std::max(0.0, share - s[0]) / (1.0 - s[0]);
}

}  // namespace

DriveFamily unnamed_bend() {
  constexpr int kFewestLoads = 4;
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"from_share_of_load"};
  f.correction =
      "load the output by weights on a lever up to the largest torque: where its torque reads "
      "otherwise than they say is the error";
  f.over = [](const DriveShape&) { return 0.0; };
  f.shape_values = {{.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                       return std::pair(kLeastBend, kMostBend);
                     }}};
  const auto shapes = [](const DriveContext& context) {
    std::vector<DriveShape> all;
    if (!context.table.has(true) || !context.table.has(false) ||
        context.table.levels[0] < kFewestLoads)
      return all;
    for (const double place : {0.3, 0.45, 0.6, 0.7, 0.8, 0.9}) all.push_back({place});
    return all;
  };
  f.shapes = shapes;
  f.all_shapes = [shapes](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? shapes(context)
               : with_first_moved(context, *about, {0.001, 0.8, kLeastBend, kMostBend});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    const double beyond = beyond_bend(true_share(context, p), shape);
    c[0] = beyond > 0.0 ? beyond * context.model.ratio * context.misread(p, false) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double ratio = context.model.ratio, most_nm = context.table.most_load_nm,
                 at_most = amount * beyond_bend(context.table.most_carried_nm / most_nm, s);
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("begins_at_output_nm", s[0] * most_nm * ratio),
        figure_of("reads_more_nm", at_most * ratio),
        figure_of("percent_beyond", 100.0 * amount / ((1.0 - s[0]) * most_nm))};
  };
  f.told = [](const DriveContext&, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return "the output's torque is read otherwise from a load of " +
           with_interval(figures[1], " N m") + " at the output on: it " +
           reads_in_words(figures[2]) + " at the largest, " + percent_in_words(figures[3]) +
           " of what lies beyond" + kNoLoss + (amount < 0.0 ? ": a sensor that saturates?" : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string(
        "as the output's torque that is read otherwise from a load on (a sensor that saturates?)");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
