// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// A loss in proportion to the speed that stands in the row after: a column that is logged a row
// late.
namespace trueflank::loop::drive_effects {

namespace {

/// Of every row the speed in the row after; its own where none follows [rpm].
std::vector<double> speeds_of_rows_after(const BenchTable& table) {
  const auto& rows = table.every_row();
  std::vector<double> next;
  for (const BenchPoint& row : rows) next.push_back(row.speed_rpm);
  for (const BenchPoint& row : rows)
    if (row.before >= 0) next[static_cast<std::size_t>(row.before)] = row.speed_rpm;
  return next;
}

/// Most rows follow the one before, whose speed is another.
bool speeds_change(const DriveContext& context) {
  constexpr std::size_t kFewestRows = 40;
  constexpr double kFewestFollow = 0.8, kFewestChange = 0.2, kOther = 0.05;  // of the largest
  const auto n = static_cast<double>(context.table.points.size());
  double follow = 0.0, change = 0.0;
  for (const BenchPoint& p : context.table.points) {
    const BenchPoint* before = context.table.row_before(p);
    if (before == nullptr) continue;
    follow += 1.0;
    change += std::abs(p.speed_rpm - before->speed_rpm) > kOther * context.table.most_speed_rpm;
  }
  return context.table.points.size() >= kFewestRows && follow >= kFewestFollow * n &&
         change >= kFewestChange * n;
}

}  // namespace

DriveFamily unnamed_late_column() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.correction = "put the column right: move its values up by a row, and close the loop again";
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    return has_one_course(context) && has_parts_over(context, 1.0) && speeds_change(context)
               ? std::vector<DriveShape>{{}}
               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    constexpr std::array<double, 3> kRowAfter{-1.0, 1.0, 0.0};
    const std::vector<double>& next =
        context.last_memories.of(kRowAfter, [&] { return speeds_of_rows_after(context.table); });
    const auto at = static_cast<std::size_t>(p.place);  // (of no row of the table: beyond them)
    c[0] = at < next.size() ? -context.lever(p) * next[at] / context.table.most_speed_rpm : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape&, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("nm_per_rpm", amount / context.table.most_speed_rpm)};
  };
  f.told = [](const DriveContext& context, const DriveShape&, double amount,
              const std::vector<Parameter>& figures) {
    return "a loss that grows with the speed that stands in the row after: " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
           printed(" at %.4g rpm", context.table.most_speed_rpm) +
           " (the column of the speed is logged a row late?)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that follows the speed of the row after");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 1.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
