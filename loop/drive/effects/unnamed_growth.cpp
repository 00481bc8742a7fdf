// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that grows ever faster over the run from nothing at its start: a bearing that dies, a
// filling that dries out. One that grows evenly is a drift, which has names.
namespace trueflank::loop::drive_effects {

DriveFamily unnamed_growth() {
  constexpr std::pair kPowers{1.5, 6.0};
  enum GrowthValue : std::size_t { kGrowthPower, kGrowthOf };
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"power", "of"};
  f.preference = 7;
  f.stands_alone = true;
  f.follows_the_run = true;
  f.shape_values = {
      {.continuous = true, .limits = [limits = kPowers](const DriveContext&) { return limits; }},
      {}};
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kGrowthOf]); };
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    for (const double of : {double(kDrag), double(kFlanks)})
      for (const double power : {1.75, 2.0, 2.5, 3.0, 4.0, 5.5}) shapes.push_back({power, of});
    return shapes;
  };
  f.all_shapes = [limits = kPowers](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.005, 0.9, limits.first, limits.second, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = sized_loss_nm(context, p, s[kGrowthOf]) * std::pow(p.taken, s[kGrowthPower]);
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("power", s[kGrowthPower])};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const BenchTable& table = context.table;
    const std::string at = at_the_largest(s[kGrowthOf]);
    return "a loss at the input" + in_proportion(s[kGrowthOf]) + " that " +
           (amount > 0.0 ? "grows" : "falls") + " ever faster over the run, by the power " +
           with_interval(figures[1], " of the rows") + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") + " at its end" +
           (at.empty() ? "" : "," + at + ",") + " than at its start" +
           (table.has(true) && table.has(false)
                ? ""
                : ", or a zero that drifts so: one direction does not tell") +
           (amount > 0.0 ? " (a bearing that dies, a filling that dries out?)" : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that grows ever faster over the run");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
