// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// An output's torque that reads no more than so much: an amplifier at its end, a limit of the
// logger. What lies above is missing whole, which no loss does.
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kLeastCap = 0.3, kMostCap = 0.99;  // of the largest torque of the output

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

double most_given_nm(const DriveContext& context) {
  double most = 0.0;
  for (const BenchPoint& p : context.table.points)
    if (p.forward) most = std::max(most, given_nm(context, p));
  return most;
}

/// Both at the output: the most it reads, and the most the drive gave.
enum CapValue : std::size_t { kCapNm, kCapOfNm };

/// What is missing at most, as a torque at the input [N m]: the unit of the coefficient is its
/// share.
double missed_input_nm(const DriveModel& model, const DriveShape& s) {
  constexpr double kLeast = 1e-3;  // of the most it gave: a cap beyond that misses nothing
  return std::max(s[kCapOfNm] - s[kCapNm], kLeast * s[kCapOfNm]) / model.ratio;
}

int rows_at_cap(const DriveContext& context, double cap_nm) {
  const auto& points = context.table.points;
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](const BenchPoint& p) {
    return p.forward && given_nm(context, p) > cap_nm;
  }));
}

}  // namespace

DriveFamily unnamed_cap() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"cap_nm", "of_nm"};
  f.preference = 6;
  f.stands_alone = true;
  f.may_stand_for = some_follows_the_load;
  f.asked_of_one_direction = true;
  f.correction = "take an amplifier or a sensor with a larger range, and run the large loads again";
  f.shape_values = {{.continuous = true,
                     .limits =
                         [](const DriveContext& context) {
                           const double most = most_to_give_nm(context);
                           return std::pair(kLeastCap * most, kMostCap * most);
                         }},
                    {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr int kFewestLoads = 5;
    std::vector<DriveShape> shapes;
    if (!context.table.has(true) || context.table.levels[0] < kFewestLoads) return shapes;
    const double most = most_to_give_nm(context), of = most_given_nm(context);
    for (double cap = 0.4; cap < kMostCap; cap += 0.02) shapes.push_back({cap * most, of});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    if (about == nullptr) return std::vector<DriveShape>{};
    const double most = most_to_give_nm(context);
    return with_first_moved(context, *about,
                            {0.0005, 0.1, kLeastCap * most, kMostCap * most, true});
  };
  // All that lies above is missing: a part of it is a gain that changes.
  f.plausible = [](const DriveModel& model, const DriveShape& s, double amount) {
    const double share = amount / missed_input_nm(model, s);
    return share > 0.8 && share < 1.25;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = p.forward
               ? std::min(0.0, s[kCapNm] - given_nm(context, p)) / missed_input_nm(context.model, s)
               : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double missed = std::max(0.0, most_given_nm(context) - s[kCapNm]),
                 share = amount / missed_input_nm(context.model, s);
    return std::vector<Parameter>{
        figure_of("most_it_reads_nm", s[kCapNm]), figure_of("missed_nm", missed),
        figure_of("rows", static_cast<double>(rows_at_cap(context, s[kCapNm]))),
        figure_of("amplitude_nm", share * missed / context.model.ratio)};
  };
  f.told = [](const DriveContext&, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "the output's torque reads no more than " + with_interval(figures[0], " N m") + ": " +
           printed("%.0f rows", figures[2].value) + " whose torque is larger, by up to " +
           printed("%.3g N m", figures[1].value) +
           ", stand there (an amplifier or a sensor at the end of its range, a limit of the "
           "logger?)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as the output's torque that reads no more than so much");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
