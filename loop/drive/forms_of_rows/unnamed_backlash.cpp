// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A reading of the output's torque that stays behind the load by play or friction: it stands still
// where the load turns until that has come back by twice as much (the play operator of
// hysteresis; Krasnosel'skii and Pokrovskii).
namespace trueflank::loop::drive_effects {

namespace {

/// By how much it stays behind, as a torque at the input [N m].
enum BacklashValue : std::size_t { kBehindNm };
constexpr double kLeastBehind = 0.002, kMostBehind = 0.2;  // of the largest load

/// By how much the reading of every row is above the load, in units of what it stays behind at
/// most.
const std::vector<double>& above_load(const DriveContext& context, double behind_nm) {
  constexpr double kOwn = -1.0;  // the figures of what else is remembered are three
  const std::array<double, 2> figures{kOwn, behind_nm};
  return context.last_memories.of(figures, [&] {
    std::vector<double> above;
    double read = 0.0;
    int file = -1;
    for (const BenchPoint& p : context.table.every_row()) {
      read = p.file == file ? std::clamp(read, p.load_nm - behind_nm, p.load_nm + behind_nm)
                            : p.load_nm;
      file = p.file;
      above.push_back((read - p.load_nm) / behind_nm);
    }
    return above;
  });
}

}  // namespace

DriveFamily unnamed_backlash() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"behind_nm"};
  f.preference = 7;
  f.stands_alone = true;
  f.follows_rows_before = true;
  f.asked_of_one_direction = true;
  f.correction =
      "load the output by weights on a lever, up and down: what its torque reads otherwise on the "
      "way down is the error";
  f.shape_values = {{.continuous = true, .limits = [](const DriveContext& context) {
                       const double most = context.table.most_load_nm;
                       return std::pair(kLeastBehind * most, kMostBehind * most);
                     }}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr double kFiner = 1.2;
    std::vector<DriveShape> shapes;
    const BenchTable& table = context.table;
    if (table.has(true) && table.has(false)) return shapes;  // (the load changes its sense)
    if (!goes_up_and_down(context, 0.0)) return shapes;
    for (double share = kLeastBehind; share < kMostBehind; share *= kFiner)
      shapes.push_back({share * table.most_load_nm});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    const double most = context.table.most_load_nm;
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about,
                                  {0.005, 0.5, kLeastBehind * most, kMostBehind * most, true});
  };
  // (the load's own scatter looks like a little of it)
  f.plausible = [](const DriveModel&, const DriveShape& s, double amount) {
    constexpr double kLeast = 0.6, kMost = 1.6;
    return amount > kLeast * s[kBehindNm] && amount < kMost * s[kBehindNm];
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const std::vector<double>& above = above_load(context, s[kBehindNm]);
    const auto at = static_cast<std::size_t>(p.place);
    c[0] = at < above.size() ? above[at] * changed_nm(context, p, kOutputReads) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape&, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("to_either_side_nm", std::abs(amount) * context.model.ratio),
        figure_of("between_nm", 2.0 * std::abs(amount) * context.model.ratio)};
  };
  f.told = [](const DriveContext&, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "the output's torque stays behind the load: it reads " +
           with_interval(figures[1], " N m") +
           " less while the load rises and as much more while it falls, " +
           with_interval(figures[2], " N m") +
           " between the two, and stands still where the load turns until that has come back by "
           "as much (play, friction or hysteresis of a torque sensor or its lever? or of a loss "
           "that differs with the way of the load: the other direction would tell)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a reading of the output's torque that stays behind the load");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
