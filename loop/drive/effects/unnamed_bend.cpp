// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// An output's torque that is read otherwise from a load on: a sensor or an amplifier that
// saturates, a stop that a lever meets. Both directions tell it from a loss.
namespace trueflank::loop::drive_effects {

namespace {

/// The output's torque over what the largest load makes of it in the lossless drive. Backward it
/// drives, and is read wrong itself: the input's torque says what it was.
double share_of_most(const DriveContext& context, const BenchPoint& p) {
  const double eta = context.efficiency(p);
  const double input_nm = p.forward ? context.load_nm(p) * eta : p.driven_nm / std::max(eta, 0.05);
  return input_nm / std::max(context.table.most_load_nm, 1e-300);
}

/// Between which loads the bend lies: no row stands between them.
std::string from_load_in_words(const DriveContext& context, double place) {
  double below = 0.0, above = 1e300;
  for (const BenchPoint& p : context.table.points) {
    const double share = share_of_most(context, p);
    if (share <= place)
      below = std::max(below, share);
    else
      above = std::min(above, share);
  }
  constexpr double kApart = 0.03;
  const double most = context.table.most_load_nm;
  if (!(above < 1e300) || above - below < kApart)
    return " from a load of about " + printed("%.3g", place * most) + " N m at the input on";
  return " from a load between " + printed("%.3g", below * most) + " and " +
         printed("%.3g", above * most) + " N m at the input on";
}

}  // namespace

DriveFamily unnamed_bend() {
  constexpr int kFewestLoads = 4;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"from_share_of_load"};
  f.preference = 7;
  f.is_loss = false;
  f.shape_values = {{.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                       return std::pair(0.15, 0.95);
                     }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!context.table.has(true) || !context.table.has(false) ||
        context.table.levels[0] < kFewestLoads)
      return shapes;
    for (const double place : {0.3, 0.45, 0.6, 0.7, 0.8, 0.9}) shapes.push_back({place});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    const double beyond = std::max(0.0, share_of_most(context, p) - shape[0]) / (1.0 - shape[0]);
    c[0] = beyond * context.model.ratio * context.misread(p, false);
  };
  f.piece_over = [](const DriveShape&) { return 0.0; };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext* context) {
    return "as the output's torque that is read otherwise" +
           (context ? from_load_in_words(*context, shape[0]) : " from a load on") +
           " (a sensor that saturates?)";
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
