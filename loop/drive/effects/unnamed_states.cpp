// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/scans/states_scan.h"

// A loss that is there at times and at times not: a cap or a seal that is loose, a brake that
// drags now and then. A scan of the run says when.
namespace trueflank::loop::drive_effects {

namespace {

/// What changes; the others are where in the run it begins and ends, in turn.
constexpr std::size_t kFirstChange = 1;

bool is_there(const DriveShape& s, double taken) {
  const auto first = s.begin() + kFirstChange;
  return (std::upper_bound(first, s.end(), taken) - first) % 2 == 1;
}

/// "lines 30 to 33, 41 to 47"; of very many the first ones.
std::string spells_in_words(const BenchTable& table, const DriveShape& s) {
  constexpr int kTold = 10;
  std::string text;
  int spells = 0, begins = 0, ends = 0;
  const auto tell = [&] {
    if (begins == 0) return;
    ++spells;
    if (spells <= kTold)
      text += (spells > 1 ? ", " : "") + std::to_string(begins) +
              (ends > begins ? " to " + std::to_string(ends) : "");
    begins = 0;
  };
  for (const BenchPoint& p : table.points) {
    if (!is_there(s, p.taken)) {
      tell();
      continue;
    }
    if (begins == 0) begins = p.line;
    ends = p.line;
  }
  tell();
  if (spells > kTold) text += ", and in " + std::to_string(spells - kTold) + " more spells";
  return text;
}

}  // namespace

DriveFamily unnamed_states() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what"};
  f.preference = 7;
  f.stands_alone = true;
  f.shapes = no_shapes;
  f.shape_of_states = [](double what, const std::vector<double>& changes) {
    DriveShape shape{what};
    shape.insert(shape.end(), changes.begin(), changes.end());
    return shape;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) { c[0] = is_there(s, p.taken) ? changed_nm(context, p, s[0]) : 0.0; };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    double there = 0.0;
    for (const BenchPoint& p : context.table.points) there += is_there(s, p.taken) ? 1.0 : 0.0;
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("rows_percent", 100.0 * there / static_cast<double>(context.table.points.size())),
        figure_of("changes", static_cast<double>(s.size() - kFirstChange))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const auto what = static_cast<What>(static_cast<int>(s[0]));
    const std::string size = with_interval(figures[0], " N m ") + (amount > 0.0 ? "more" : "less");
    return (what == kOutputReads
                ? "a reading of the output's torque that jumps to and fro between two values: " +
                      size + ", as a torque at the input,"
            : what == kFlanks
                ? "a loss in proportion to the load that is there at times and at times not: " +
                      size + " at the largest load"
                : "a loss that is there at times and at times not, the same at every load and "
                  "speed: " +
                      size) +
           printed(" in %.0f %% of the rows, lines ", figures[1].value) +
           spells_in_words(context.table, s) +
           "; it follows nothing that was recorded but the time (" +
           (what == kOutputReads ? "a loose plug, a cell that slips?)"
                                 : "a loose part, a seal or a brake that catches?)");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that is there at times and at times not");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
