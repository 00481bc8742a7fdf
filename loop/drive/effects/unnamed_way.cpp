// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What differs between a load or a speed that rises and one that falls: a sensor with hysteresis,
// oil or grease that follows late.
namespace trueflank::loop::drive_effects {

namespace {

enum WayValue : std::size_t { kWayOver, kWayOf, kWayForm };
/// As much everywhere; most in the middle of the range, nothing at its ends.
enum WayForm { kEven, kMiddle };

double way_of(const BenchPoint& p, const DriveShape& s) {
  return s[kWayOver] == 0.0 ? p.way : p.speed_way;
}

double form_at(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  if (s[kWayForm] == double(kEven)) return 1.0;
  const double x = s[kWayOver] == 0.0 ? p.load_nm / context.table.most_load_nm
                                      : context.share_at(1.0, p.speed_rpm);
  return std::max(0.0, 4.0 * x * (1.0 - x));
}

/// True where it went up and down often enough that this is no drift, and both have rows enough.
bool goes_up_and_down(const DriveContext& context, double over) {
  constexpr int kFewestTurns = 4, kFewestRows = 8;
  int turns = 0, before = 0;
  std::array<int, 2> rows{};
  for (const BenchPoint& p : context.table.points) {
    const int way = over == 0.0 ? p.way : p.speed_way;
    if (way == 0) continue;
    ++rows[way > 0 ? 1 : 0];
    turns += before != 0 && way != before ? 1 : 0;
    before = way;
  }
  return turns >= kFewestTurns && rows[0] >= kFewestRows && rows[1] >= kFewestRows;
}

std::string way_told(const DriveContext& context, const DriveShape& s, double amount,
                     const std::vector<Parameter>& figures) {
  const std::string over = name_of_quantity(s[kWayOver]);
  const std::string where = s[kWayForm] == double(kEven) ? "" : ", most in the middle of the range";
  const bool more = amount > 0.0;
  if (s[kWayOf] == double(kOutputReads)) {
    const std::string half = with_interval(figures[0], " N m");
    return "the output's torque reads " + half + (more ? " more" : " less") + " while the " + over +
           " rises and as much " + (more ? "less" : "more") + " while it falls" + where + ": " +
           with_interval(figures[1], " N m") +
           " between the two (a torque sensor with hysteresis? one at the input " +
           printed("that reads %.3g N m ", figures[0].value / context.model.ratio) +
           (more ? "less" : "more") + " while it rises looks the same)";
  }
  const bool both = context.table.has(true) && context.table.has(false);
  return "a loss that differs with the way of the " + over + ": " +
         with_interval(figures[1], " N m") + (more ? " more" : " less") +
         " while it rises than while it falls" + where +
         (s[kWayOf] == double(kFlanks) ? ", in proportion to the load" : "") +
         (both ? "" : " (or a torque sensor with hysteresis: the other direction would tell)");
}

}  // namespace

DriveFamily unnamed_way() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "of", "form"};
  f.preference = 8;
  f.stands_alone = true;
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double over : {0.0, 1.0}) {
      if (!goes_up_and_down(context, over)) continue;
      for (const double of : {double(kOutputReads), double(kDrag), double(kFlanks)})
        for (const double form : {double(kEven), double(kMiddle)})
          shapes.push_back({over, of, form});
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double way = way_of(p, s);
    c[0] = way == 0.0 ? 0.0 : way * form_at(context, p, s) * changed_nm(context, p, s[kWayOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double size =
        std::abs(amount) * (s[kWayOf] == double(kOutputReads) ? context.model.ratio : 1.0);
    return std::vector<Parameter>{figure_of("to_either_side_nm", size),
                                  figure_of("between_nm", 2.0 * size)};
  };
  f.told = way_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that differs with the way of the ") + name_of_quantity(s[kWayOver]) +
           " (rising or falling)";
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
