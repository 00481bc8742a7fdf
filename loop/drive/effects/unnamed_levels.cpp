// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// Levels between which a run jumps, each new: a zero that was set anew between series, a preload or
// a seal that was changed more than once. A scan of the run says when.
namespace trueflank::loop::drive_effects {

namespace {

/// What stands at levels; then the changes, then the level after each, of the largest.
constexpr std::size_t kFirstOfLevels = 1;

std::size_t levels_in(const DriveShape& s) { return (s.size() - kFirstOfLevels) / 2; }
auto changes_end(const DriveShape& s) {
  return s.begin() + static_cast<std::ptrdiff_t>(kFirstOfLevels + levels_in(s));
}

/// Level of a row: of the largest; 0 before the first change.
double level_at(const DriveShape& s, double taken) {
  const auto first = s.begin() + kFirstOfLevels;
  const auto passed = std::upper_bound(first, changes_end(s), taken) - first;
  return passed == 0 ? 0.0 : *(changes_end(s) + passed - 1);
}

int line_of_change(const BenchTable& table, double change) {
  for (const BenchPoint& p : table.points)
    if (p.taken > change) return p.line;
  return table.points.back().line;
}

bool level_is_read(const DriveShape& s) { return s[0] == double(kOutputReads); }

std::string levels_told(const DriveContext& context, const DriveShape& s,
                        const std::vector<Parameter>& figures) {
  constexpr std::size_t kFirstFigure = 2;
  const std::size_t count = levels_in(s);
  std::string lines, levels;
  for (std::size_t k = 0; k < count; ++k) {
    const Parameter &line = figures[kFirstFigure + 2 * k],
                    &level = figures[kFirstFigure + 2 * k + 1];
    const std::string between = k == 0 ? "" : k + 1 == count ? " and " : ", ";
    lines += between + with_interval(line, "");
    levels +=
        (k == 0 ? "" : ", ") + std::string(level.value < 0.0 ? "" : "+") + with_interval(level, "");
  }
  const bool both = context.table.has(true) && context.table.has(false);
  return (level_is_read(s)
              ? "the zero of the output's torque was set anew from lines " + lines +
                    " on: it reads " + levels + " N m there, nothing before" +
                    (both ? kNoLoss : " (or a loss that jumps so: one direction does not tell)")
              : "a loss at the input that jumps from lines " + lines + " on: " + levels +
                    " N m there, nothing before (a seal, a preload or an oil "
                    "that was changed more than once?)");
}

DriveFamily levels_of_run_family(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what"};
  f.preference = 7;
  f.stands_alone = true;
  f.asked_of_one_direction = true;
  f.shapes = no_shapes;
  f.shape_of_levels = [](double what, const std::vector<double>& changes,
                         const std::vector<double>& levels) {
    double most = 1e-300;
    for (const double level : levels)
      if (std::abs(level) > std::abs(most)) most = level;
    DriveShape shape{what};
    shape.insert(shape.end(), changes.begin(), changes.end());
    for (const double level : levels) shape.push_back(level / most);
    return shape;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    constexpr int kRowsAbout = 4;
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const double row = 1.0 / static_cast<double>(context.table.points.size() - 1);
    for (std::size_t k = kFirstOfLevels; k < about->size(); ++k) {
      const bool is_change = k < kFirstOfLevels + levels_in(*about);
      std::vector<double> steps = growing_steps(context, 0.004, 0.6);
      if (is_change) {
        steps.clear();
        for (int rows = -kRowsAbout; rows <= kRowsAbout; ++rows) steps.push_back(rows * row);
      }
      for (const double step : steps) {
        shapes.push_back(*about);
        shapes.back()[k] += step;
      }
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) { c[0] = level_at(s, p.taken) * changed_nm(context, p, s[0]); };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("changes", static_cast<double>(levels_in(s)))};
    const double at_output = level_is_read(s) ? context.model.ratio : 1.0;
    for (std::size_t k = 0; k < levels_in(s); ++k) {
      const std::string number = std::to_string(k + 1);
      figures.push_back(
          figure_of("from_line_" + number, line_of_change(context.table, s[kFirstOfLevels + k])));
      figures.push_back(
          figure_of((level_is_read(s) ? "reads_more_" : "loses_more_") + number + "_nm",
                    amount * at_output * s[kFirstOfLevels + levels_in(s) + k]));
    }
    return figures;
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double,
              const std::vector<Parameter>& figures) { return levels_told(context, s, figures); };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string(
        "that jumps more than once in the course of the run, each time to a new level");
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[0]); };
  return f;
}

}  // namespace

DriveFamily unnamed_levels() { return levels_of_run_family(false); }
DriveFamily unnamed_reading_levels() { return levels_of_run_family(true); }

}  // namespace trueflank::loop::drive_effects
