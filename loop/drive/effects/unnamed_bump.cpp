// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A short loss once in every turn of a shaft that swells and dies away: a tooth that is damaged, a
// chip, a place that rubs.
namespace trueflank::loop::drive_effects {

namespace {

enum BumpValue : std::size_t { kBumpOrder, kBumpCentre, kBumpHalf };

}  // namespace

DriveFamily unnamed_bump() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "centre", "half_width"};  // the two in turns
  f.preference = 8;
  f.stands_alone = true;
  f.shape_values = {
      {},
      {.continuous = true, .is_place = true, .reach = 0.03},
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.004, 0.2); }}};
  // Waves and parts of a turn that were found say where to look.
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{}; };
  f.turns_per_turn = first_value;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double by : growing_steps(context, 0.01, 1.0))
      for (const double wider : growing_steps(context, 0.02, 0.7))
        shapes.push_back({(*about)[kBumpOrder], (*about)[kBumpCentre] + by * (*about)[kBumpHalf],
                          (*about)[kBumpHalf] * std::exp(wider)});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double off = place_of_spell(p, s[kBumpOrder]) - s[kBumpCentre];
    off -= std::round(off);
    const double x = off / s[kBumpHalf];
    c[0] = x * x < 40.0 ? -context.lever(p) * std::exp2(-x * x) : 0.0;
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("order", s[kBumpOrder]),
                                  figure_of("at_deg", 360.0 * s[kBumpCentre]),
                                  figure_of("half_width_deg", 360.0 * s[kBumpHalf]),
                                  figure_of("amplitude_nm", std::abs(amount))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return "a short loss once in every turn " + turn_in_words(context.model, s[kBumpOrder]) + ": " +
           with_interval(figures[3], " N m") + (amount > 0.0 ? " more" : " less") + " at " +
           with_interval(figures[1], " degrees") + " of it, half of that " +
           with_interval(figures[2], " degrees") +
           " to either side (a chip, a damaged tooth, a tight place?)";
  };
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return "short, once in every turn " + turn_in_words(model, s[kBumpOrder]);
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
