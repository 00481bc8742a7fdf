// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A jump in the course of the run: an oil, a seal or a sensor's zero that was changed. Who changed what is
// not in the data, so it has no name; that it jumps, and where, is.
namespace trueflank::loop::drive_effects {

namespace {

enum What { kFlanks, kDrag, kOutputReads };

/// Change of the driven torque for 1 N m of loss at the input, which the flanks lose at the largest load.
double of_flanks(const DriveContext& context, const BenchPoint& p) {
  BenchPoint most = p;
  most.load_nm = context.table.most_load_nm;
  most.driving_nm = p.forward ? most.load_nm : most.load_nm * context.model.ratio;
  const double slope = context.friction_slope(most);
  return slope != 0.0 ? -context.lever(most) * context.friction_slope(p) / slope : 0.0;
}

/// The first row after the jump.
const BenchPoint* row_after(const BenchTable& table, double place) {
  const auto at = std::find_if(table.points.begin(), table.points.end(), [&](const BenchPoint& p) {
    return 2.0 * p.taken - 1.0 > place;
  });
  return at == table.points.end() ? nullptr : &*at;
}

}  // namespace

DriveFamily unnamed_change() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "place"};
  f.shape_values = {{},
                    {.continuous = true,
                     .is_place = true,
                     .limits = [](const DriveContext&) { return std::pair(-0.95, 0.95); }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    const auto& points = context.table.points;
    // The course of several files is not known.
    const bool one_file = std::all_of(points.begin(), points.end(), [&](const BenchPoint& p) {
      return p.file == points.front().file;
    });
    if (!one_file || where_rows_follow_each_other(context).empty()) return shapes;
    for (const double what : {double(kFlanks), double(kDrag), double(kOutputReads)})
      for (const double place : {-0.75, -0.5, -0.25, 0.05, 0.25, 0.5, 0.75})
        shapes.push_back({what, place});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    const double after = 2.0 * p.taken - 1.0 > shape[1] ? 1.0 : 0.0;
    const auto what = static_cast<What>(static_cast<int>(shape[0]));
    c[0] = after * (what == kFlanks ? of_flanks(context, p)
                    : what == kDrag ? -context.lever(p)
                    : p.forward     ? context.model.ratio
                                    : -context.efficiency(p));
  };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext* context) {
    const auto what = static_cast<What>(static_cast<int>(shape[0]));
    std::string text = "that jumps in the course of the run";
    if (const BenchPoint* row = context ? row_after(context->table, shape[1]) : nullptr)
      text += " at line " + std::to_string(row->line);
    return text + (what == kFlanks ? ", by the friction of the flanks (an oil that was changed?)"
                   : what == kDrag ? ", by the same torque at every load (a seal or grease that was changed?)"
                                   : ", as a zero of the output's torque that was moved");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
