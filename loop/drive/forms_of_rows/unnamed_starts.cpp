// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// A loss that starts at rows of the run and dies away from each on: fresh grease that is churned, a
// cold start of a drive whose drag goes with the speed.
namespace trueflank::loop::drive_effects {

namespace {

int line_of_row(const BenchTable& table, double row) {
  for (const BenchPoint& p : table.every_row())
    if (p.row >= row - 0.5) return p.line;
  return table.every_row().back().line;
}

std::string starts_told(const DriveContext& context, const DriveShape& s, double amount,
                        const std::vector<Parameter>& figures) {
  std::string lines;
  for (std::size_t k = kFirstStart; k < s.size(); ++k)
    lines += (k == kFirstStart    ? ""
              : k + 1 == s.size() ? " and "
                                  : ", ") +
             std::to_string(line_of_row(context.table, s[k]));
  const bool several = s.size() > kFirstStart + 1,
             at_first = !several && s[kFirstStart] <= context.table.every_row().front().row;
  return "a loss at the input" + in_proportion(s[kStartsOf]) +
         (at_first ? " that dies away from the start of the run on: "
                   : " that starts at line" + std::string(several ? "s " : " ") + lines +
                         " and dies away: ") +
         with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
         at_the_largest(s[kStartsOf]) + (several ? " at each" : " at first") +
         ", gone to a third after " + with_interval(figures[1], " rows") +
         (at_first ? " (a cold start, grease that is run in?)"
                   : " (fresh grease or oil, a stop, a seal that was moved?)");
}

std::vector<DriveShape> starts_about(const DriveContext& context, const DriveShape& about) {
  std::vector<DriveShape> shapes;
  for (const double longer : growing_steps(context, 0.02, 0.9)) {
    shapes.push_back(about);
    shapes.back()[kStartsRows] *= std::exp(longer);
  }
  for (std::size_t k = kFirstStart; k < about.size(); ++k)
    for (const double by : {-3.0, -2.0, -1.0, 1.0, 2.0, 3.0})
      if (about[k] + by >= 0.0)
        for (const double longer : {-0.1, 0.0, 0.1}) {
          shapes.push_back(about);
          shapes.back()[k] += by;
          shapes.back()[kStartsRows] *= std::exp(longer);
        }
  return shapes;
}

}  // namespace

DriveFamily unnamed_starts() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"of", "rows"};
  f.preference = 7;
  f.stands_alone = true;
  f.follows_the_run = true;
  f.starts_in_run = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {.continuous = true, .limits = [](const DriveContext& context) {
                           return std::pair(0.7,
                                            0.4 * static_cast<double>(context.table.points.size()));
                         }}};
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kStartsOf]); };
  f.changes_in_run = [](const DriveShape& s) {
    return static_cast<double>(s.size() - kFirstStart);
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : starts_about(context, *about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double since = -1.0;
    for (std::size_t k = kFirstStart; k < s.size(); ++k)
      if (p.row >= s[k]) since = p.row - s[k];
    c[0] = since < 0.0
               ? 0.0
               : std::exp(-since / s[kStartsRows]) * sized_loss_nm(context, p, s[kStartsOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("dies_within_rows", s[kStartsRows])};
    for (std::size_t k = kFirstStart; k < s.size(); ++k)
      figures.push_back(figure_of("from_line_" + std::to_string(k - kFirstStart + 1),
                                  line_of_row(context.table, s[k])));
    return figures;
  };
  f.told = starts_told;
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that starts in the run and dies away");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
