// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// An output's torque that reads no more, or no less, than so much: an amplifier at its end, a limit
// of the logger. What lies beyond is missing whole, which no loss does.
namespace trueflank::loop::drive_effects {

namespace {

/// The output's torque as the drive gives it [N m].
double given_nm(const DriveContext& context, const BenchPoint& p) {
  return context.load_nm(p) * context.model.ratio * context.efficiency(p);
}

/// What the lossless drive gives at most.
double most_to_give_nm(const DriveContext& context) {
  double most = 0.0;
  for (const BenchPoint& p : context.table.every_row())
    if (p.forward) most = std::max(most, p.load_nm * context.model.ratio);
  return most;
}

/// The most that the drive gave, or the least.
double extreme_given_nm(const DriveContext& context, bool most) {
  double extreme = most ? 0.0 : most_to_give_nm(context);
  for (const BenchPoint& p : context.table.points)
    if (p.forward)
      extreme = most ? std::max(extreme, given_nm(context, p))
                     : std::min(extreme, given_nm(context, p));
  return std::max(0.0, extreme);
}

/// Both at the output: the most (or least) it reads, and the most (or least) the drive gave.
enum LimitValue : std::size_t { kLimitNm, kExtremeNm };

/// What is missing at most, as a torque at the input [N m]: the unit of the coefficient is its
/// share.
double missed_input_nm(const DriveModel& model, const DriveShape& s) {
  constexpr double kLeast = 1e-3;  // a limit closer to the extreme than that misses nothing
  return std::max(std::abs(s[kExtremeNm] - s[kLimitNm]),
                  kLeast * std::max(s[kExtremeNm], s[kLimitNm])) /
         model.ratio;
}

/// What the limit changes in a row [N m]: less above a most, more below a least.
double moved_nm(const DriveContext& context, const BenchPoint& p, double limit_nm, bool is_most) {
  if (!p.forward) return 0.0;
  const double beyond = limit_nm - given_nm(context, p);
  return is_most ? std::min(0.0, beyond) : std::max(0.0, beyond);
}

int rows_at_limit(const DriveContext& context, double limit_nm, bool is_most) {
  const auto& points = context.table.points;
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](const BenchPoint& p) {
    return moved_nm(context, p, limit_nm, is_most) != 0.0;
  }));
}

struct LimitRange {
  double least = 0.0, most = 0.0, first = 0.0, step = 0.0;  ///< shares of the largest torque
};

DriveFamily reading_with_a_limit(bool is_most) {
  const LimitRange range =
      is_most ? LimitRange{0.3, 0.99, 0.4, 0.02} : LimitRange{0.01, 0.6, 0.02, 0.01};
  const std::string than = is_most ? "no more than" : "no less than";
  DriveFamily f = reading_without_a_name();
  f.shape_names = {is_most ? "cap_nm" : "floor_nm", "of_nm"};
  f.preference = 6;
  f.stands_alone = true;
  f.may_stand_for = some_follows_the_load;
  f.asked_of_one_direction = true;
  f.correction =
      is_most ? "take an amplifier or a sensor with a larger range, and run the large loads again"
              : "look where the amplifier or the logger cuts small torques off, and run the small "
                "loads again";
  f.shape_values = {
      {.continuous = true,
       .limits =
           [range](const DriveContext& context) {
             const double most = most_to_give_nm(context);
             return std::pair(range.least * most, range.most * most);
           }},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [range, is_most](const DriveContext& context) {
    constexpr int kFewestLoads = 5;
    std::vector<DriveShape> shapes;
    if (!context.table.has(true) || context.table.levels[0] < kFewestLoads) return shapes;
    const double most = most_to_give_nm(context), of = extreme_given_nm(context, is_most);
    for (double share = range.first; share < range.most; share += range.step)
      if (is_most || share * most > of) shapes.push_back({share * most, of});
    return shapes;
  };
  f.all_shapes = [range](const DriveContext& context, const DriveShape* about) {
    if (about == nullptr) return std::vector<DriveShape>{};
    const double most = most_to_give_nm(context);
    return with_first_moved(context, *about,
                            {0.0005, 0.1, range.least * most, range.most * most, true});
  };
  // All that lies beyond is missing: a part of it is a gain that changes.
  f.plausible = [](const DriveModel& model, const DriveShape& s, double amount) {
    const double share = amount / missed_input_nm(model, s);
    return share > 0.8 && share < 1.25;
  };
  f.evaluate = [is_most](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                         double* c) {
    c[0] = moved_nm(context, p, s[kLimitNm], is_most) / missed_input_nm(context.model, s);
  };
  f.figures = [is_most](const DriveContext& context, const DriveShape& s, double amount) {
    const double missed =
                     std::max(0.0, (is_most ? 1.0 : -1.0) *
                                       (extreme_given_nm(context, is_most) - s[kLimitNm])),
                 share = amount / missed_input_nm(context.model, s);
    return std::vector<Parameter>{
        figure_of(is_most ? "most_it_reads_nm" : "least_it_reads_nm", s[kLimitNm]),
        figure_of("missed_nm", missed),
        figure_of("rows", static_cast<double>(rows_at_limit(context, s[kLimitNm], is_most))),
        figure_of("amplitude_nm", share * missed / context.model.ratio)};
  };
  f.told = [is_most, than](const DriveContext&, const DriveShape&, double,
                           const std::vector<Parameter>& figures) {
    return "the output's torque reads " + than + " " + with_interval(figures[0], " N m") + ": " +
           printed("%.0f rows", figures[2].value) + " whose torque is " +
           (is_most ? "larger" : "smaller") + ", by up to " +
           printed("%.3g N m", figures[1].value) + ", stand there (" +
           (is_most ? "an amplifier or a sensor at the end of its range, a limit of the logger?)"
                    : "an amplifier or a logger that cuts small torques off, a stop that is "
                      "preloaded?)");
  };
  f.words = [than](const DriveModel&, const DriveShape&, const DriveContext*) {
    return "as the output's torque that reads " + than + " so much";
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace

DriveFamily unnamed_cap() { return reading_with_a_limit(true); }
DriveFamily unnamed_floor() { return reading_with_a_limit(false); }

}  // namespace trueflank::loop::drive_effects
