// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A straight course over an output's angle that goes to and fro and never comes round: a hose or a
// cable that winds up, a spring, a weight on a short swing.
namespace trueflank::loop::drive_effects {

namespace {

enum AngleValue : std::size_t { kAngleWhat, kAngleRight };
constexpr double kLeastAngle = -0.6, kMostAngle = 1.6;  // of the range

double share_of_swing(const DriveContext& context, const BenchPoint& p) {
  return (p.angle_rad - context.table.least_angle_rad) / context.table.swing_rad;
}

double output_deg(const DriveContext& context, double share) {
  return deg_from_rad(context.table.least_angle_rad + share * context.table.swing_rad) /
         context.model.ratio;
}

}  // namespace

DriveFamily unnamed_angle_course() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "right_at"};
  f.preference = 7;
  f.is_loss = false;
  f.stands_alone = true;
  f.correction =
      "hold the output at either end of its way with nothing loaded and read its torque: a hose, a "
      "cable or a spring pulls there, a loss does not";
  f.shape_values = {{}, {.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                           return std::pair(kLeastAngle, kMostAngle);
                         }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!(context.table.swing_rad > 0.0)) return shapes;
    if (context.table.has(true) && context.table.has(false))
      shapes.push_back({double(kOutputReads), 0.5});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double step : growing_steps(context, 0.002, 1.5))
      if (const double right = (*about)[kAngleRight] + step;
          right >= kLeastAngle && right <= kMostAngle)
        shapes.push_back({(*about)[kAngleWhat], right});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = changed_nm(context, p, s[kAngleWhat]) * (share_of_swing(context, p) - s[kAngleRight]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double change = amount * context.model.ratio;
    return std::vector<Parameter>{
        figure_of("reads_more_nm_per_output_deg",
                  change / (output_deg(context, 1.0) - output_deg(context, 0.0))),
        figure_of("reading_changes_nm", std::abs(change)),
        figure_of("right_at_output_deg", output_deg(context, s[kAngleRight]))};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    const double low = output_deg(context, 0.0), high = output_deg(context, 1.0);
    return "the output's torque goes in a line over the output's angle: " +
           with_interval(figures[0], " N m per degree") + ", " +
           with_interval(figures[1], " N m in all") + printed(" from %.4g", low) +
           printed(" to %.4g degrees of the output", high) + ", nothing at " +
           with_interval(figures[2], " degrees") +
           " (the same sign in both directions, so no loss: a hose or a cable that winds up, a "
           "spring, or a sensor that feels the angle)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a torque of the output in a line over the output's angle");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
