// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/legendre.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A jump in the course of the run: an oil, a seal or a sensor's zero that was changed. A spell of
// the run, or a part of every turn of a shaft: a door that stood open, a chip in a ring. Who
// changed what is not in the data, so it has no name; that it changes, and where, is.
namespace trueflank::loop::drive_effects {

namespace {

BenchPoint at_largest_load(const DriveContext& context, const BenchPoint& p) {
  BenchPoint most = p;
  most.load_nm = context.table.most_load_nm;
  most.driving_nm = p.forward ? most.load_nm : most.load_nm * context.model.ratio;
  return most;
}

/// Change of the driven torque for 1 N m of loss at the input, which the flanks lose at the largest
/// load.
double of_flanks(const DriveContext& context, const BenchPoint& p) {
  const BenchPoint most = at_largest_load(context, p);
  const double slope = context.friction_slope(most);
  return slope != 0.0 ? -context.lever(most) * context.friction_slope(p) / slope : 0.0;
}

/// The first row after the jump.
const BenchPoint* row_after(const BenchTable& table, double place) {
  const auto at = std::find_if(table.points.begin(), table.points.end(),
                               [&](const BenchPoint& p) { return 2.0 * p.taken - 1.0 > place; });
  return at == table.points.end() ? nullptr : &*at;
}

/// Of the lines from the first row to the last in a part of the run; empty: no row lies there.
std::string lines_between(const BenchTable& table, double begin, double end) {
  int first = 0, last = 0;
  for (const BenchPoint& p : table.points)
    if (p.taken >= begin && p.taken <= end) {
      if (first == 0) first = p.line;
      last = p.line;
    }
  return first == 0 ? "" : ", lines " + std::to_string(first) + " to " + std::to_string(last);
}

constexpr int kDriftDegrees = 3;  ///< of the load

std::string of_what(double number) {
  const auto what = static_cast<What>(static_cast<int>(number));
  return what == kFlanks ? ", by the friction of the flanks (an oil that was changed?)"
         : what == kDrag ? ", by the same torque at every load (a seal or grease that was changed?)"
                         : ", as a zero of the output's torque that was moved";
}

}  // namespace

std::string turn_in_words(const DriveModel& model, double order) {
  std::string member;
  for (const MemberOrder& one : model.orders)
    if (std::abs(one.order - order) < 1e-6 * std::max(1.0, order)) member = one.member;
  return order == 1.0
             ? "of the input"
             : "of order " + short_text(order) + (member.empty() ? "" : " (" + member + ")");
}

double nm_of_coefficient(const DriveContext& context) {
  const BenchPoint most = at_largest_load(context, context.table.points.front());
  return std::abs(context.friction_slope(most) / context.lever(most));
}

double changed_nm(const DriveContext& context, const BenchPoint& p, double number) {
  const auto what = static_cast<What>(static_cast<int>(number));
  return what == kFlanks ? of_flanks(context, p)
         : what == kDrag ? -context.lever(p)
                         : context.model.ratio * context.misread(p, false);
}

double place_of_spell(const BenchPoint& p, double order) {
  if (order == 0.0) return p.taken;
  const double turns = order * p.angle_rad / kTwoPi;
  return turns - std::floor(turns);
}

bool has_one_course(const DriveContext& context) {
  const auto& points = context.table.points;
  return !where_rows_follow_each_other(context).empty() &&
         std::all_of(points.begin(), points.end(),
                     [&](const BenchPoint& p) { return p.file == points.front().file; });
}

DriveFamily unnamed_spell() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "order", "begin", "length"};
  f.preference = 8;
  // Its places are too many to try: a scan of what is left proposes them.
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{}; };
  f.shape_of_spell = [](double what, double order, double begin, double length) {
    return DriveShape{what, order, begin, length};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double after = place_of_spell(p, s[1]) - s[2];
    if (s[1] != 0.0) after -= std::floor(after);
    c[0] = after >= 0.0 && after <= s[3] ? changed_nm(context, p, s[0]) : 0.0;
  };
  f.stands_alone = true;
  f.turns_per_turn = [](const DriveShape& s) { return s[1]; };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr || (*about)[1] == 0.0) return shapes;
    const std::vector<double> steps = growing_steps(context, 0.0007, 0.05);
    for (const double begin : steps)
      for (const double end : steps)
        if (const double length = (*about)[3] - begin + end; length > 0.0 && length < 1.0)
          shapes.push_back({(*about)[0], (*about)[1], (*about)[2] + begin, length});
    return shapes;
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
    if (s[1] == 0.0) return figures;
    figures.push_back(figure_of("order", s[1]));
    figures.push_back(figure_of("from_deg", 360.0 * s[2]));
    figures.push_back(figure_of("width_deg", 360.0 * s[3]));
    return figures;
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const std::string size = with_interval(figures[0], " N m") + (amount > 0.0 ? " more" : " less");
    if (s[1] == 0.0)
      return "a loss at the input over a part of the run" +
             lines_between(context.table, s[2], s[2] + s[3]) + of_what(s[0]) + ": " + size;
    return "a loss over a part of every turn " + turn_in_words(context.model, s[1]) + ": " + size +
           ", from " + with_interval(figures[2], " degrees") + " on, for " +
           with_interval(figures[3], " degrees") + " (a chip, a damaged tooth, a tight place?)";
  };
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext* context) {
    if (s[1] != 0.0)
      return "over a part of every turn " + turn_in_words(model, s[1]) +
             printed(
                 ": from %.0f degrees on, for %.0f degrees (a chip, a damaged tooth, a tight "
                 "place?)",
                 360.0 * (s[2] - std::floor(s[2])), 360.0 * s[3]);
    return "over a part of the run" +
           (context ? lines_between(context->table, s[2], s[2] + s[3]) : std::string()) +
           of_what(s[0]);
  };
  return f;
}

DriveFamily unnamed_change() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "place"};
  f.shape_values = {{}, {.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                           return std::pair(-0.95, 0.95);
                         }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    for (const double what : {double(kFlanks), double(kDrag), double(kOutputReads)})
      for (const double place : {-0.75, -0.5, -0.25, 0.05, 0.25, 0.5, 0.75})
        shapes.push_back({what, place});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    c[0] = 2.0 * p.taken - 1.0 > shape[1] ? changed_nm(context, p, shape[0]) : 0.0;
  };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext* context) {
    std::string text = "that jumps in the course of the run";
    if (const BenchPoint* row = context ? row_after(context->table, shape[1]) : nullptr)
      text += " at line " + std::to_string(row->line);
    return text + of_what(shape[0]);
  };
  return f;
}

// A reading of the output that drifts otherwise at every load: a gain that drifts, a lever that
// creeps once it is loaded. A zero that drifts is the same at all of them, and has a name.
DriveFamily unnamed_drift() {
  DriveFamily f = without_a_name();
  f.parameters = {"degree_0", "degree_1", "degree_2"};
  f.preference = 8;
  f.differs_by_direction = true;
  f.shapes = [](const DriveContext& context) {
    return has_one_course(context) && context.table.levels[0] >= kDriftDegrees
               ? std::vector<DriveShape>{{}}
               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    const double drifted = p.taken * changed_nm(context, p, kOutputReads);
    for (int k = 0; k < kDriftDegrees; ++k) c[k] = drifted * legendre(k, context.load_coordinate(p));
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that grows in the course of the run, as the output's torque that drifts otherwise at "
                       "every load (a gain that drifts, a lever that creeps?)");
  };
  f.term_shapes = [](const DriveShape&) {
    std::vector<DriveShape> terms;
    for (int k = 0; k < kDriftDegrees; ++k) terms.push_back({double(k), 0.0, 0.0, 0.0, 0.0});
    return terms;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
