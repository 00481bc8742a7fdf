// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that grows by the same factor with every degree: bearings whose preload grows with the
// warmth, a fit that closes. One that falls so has a name.
namespace trueflank::loop::drive_effects {

namespace {

enum WarmValue : std::size_t { kWarmSpan, kWarmOf };
/// Of the range of temperatures, that it grows by a factor of e within.
constexpr double kLeastSpan = 0.08, kMostSpan = 0.9;

}  // namespace

DriveFamily unnamed_warm_growth() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"span", "of"};
  f.preference = 7;
  f.stands_alone = true;
  f.over = [](const DriveShape&) { return 2.0; };
  f.shape_values = {
      {.continuous = true,
       .limits = [](const DriveContext&) { return std::pair(kLeastSpan, kMostSpan); }},
      {}};
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kWarmOf]); };
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!context.table.has_temperature || context.table.temperature_span_c < 3.0 ||
        context.table.levels[2] < 5)
      return shapes;
    for (const double of : {double(kDrag), double(kFlanks)})
      for (double span = kLeastSpan; span < kMostSpan; span *= 1.25) shapes.push_back({span, of});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.01, 1.5, kLeastSpan, kMostSpan, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = sized_loss_nm(context, p, s[kWarmOf]) *
           std::exp((context.share_of_range(p, 2.0) - 1.0) / s[kWarmSpan]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("doubles_within_c",
                  std::log(2.0) * s[kWarmSpan] * context.table.temperature_span_c)};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return "a loss at the input" + in_proportion(s[kWarmOf]) + " that " +
           (amount > 0.0 ? "grows" : "falls") +
           " ever faster with the temperature, twice as much every " +
           with_interval(figures[1], " C") + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
           at_the_largest(s[kWarmOf]) + printed(" at %.4g C", context.quantity_at_share(2.0, 1.0)) +
           (amount > 0.0 ? " (bearings whose preload grows with the warmth, a fit that closes?)"
                         : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that grows ever faster with the temperature");
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{
        {s[kWarmOf] == double(kFlanks) ? 1.0 : 0.0, 0.0, 2.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
