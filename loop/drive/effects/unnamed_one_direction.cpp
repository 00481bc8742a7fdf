// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that one direction alone has: flanks that are rough or dry on the side that is loaded
// then. Beside it the other direction is as designed. Names that differ between the directions move
// both.
namespace trueflank::loop::drive_effects {

namespace {

/// Which direction (1 forward, 2 backward), what makes the loss larger, and the speed [of the
/// largest] by which it fades to a third; the family of what does not fade has no such speed.
enum OneDirectionValue : std::size_t { kOdDirection, kOdOf, kOdFades };

std::vector<DriveShape> od_shapes(const DriveContext& context, bool fades) {
  std::vector<DriveShape> shapes;
  if (!context.table.has(true) || !context.table.has(false)) return shapes;
  for (const double direction : {1.0, 2.0}) {
    if (!fades) {
      shapes.push_back({direction, double(kFlanks)});
      if (context.table.levels[1] > 2) shapes.push_back({direction, kBySpeed});
      continue;
    }
    if (context.table.levels[1] < 5) continue;
    for (const double of : {double(kFlanks), double(kDrag)})
      for (const double speed : {0.03, 0.05, 0.08, 0.13, 0.2, 0.3})
        shapes.push_back({direction, of, speed});
  }
  return shapes;
}

std::string od_told(const DriveContext&, const DriveShape& s, double amount,
                    const std::vector<Parameter>& figures) {
  const bool fades = s.size() > kOdFades;
  return "a loss at the input" + in_proportion(s[kOdOf]) + direction_in_words(s[kOdDirection]) +
         ", and not while the " + (s[kOdDirection] == 1.0 ? "output" : "input") +
         " drives: " + with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
         at_the_largest(s[kOdOf]) +
         (fades ? " from rest, to a third of it at " + with_interval(figures[1], " rpm") : "") +
         " (flanks that are rough or dry on the side that carries then, a seal or a part that "
         "works one way" +
         (s[kOdOf] == double(kFlanks) && !fades
              ? "; or a torque sensor whose gain is another under this sign of torque?)"
              : "?)");
}

DriveFamily one_direction(bool fades) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"direction", "of"};
  f.preference = 6;
  f.stands_alone = true;
  f.shape_values = {{}, {}};
  if (fades) {
    f.shape_names.emplace_back("fades");
    f.shape_values.push_back(
        {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.01, 0.6); }});
  }
  f.shapes = no_shapes;
  f.whole_shapes = [fades](const DriveContext& context) { return od_shapes(context, fades); };
  f.kind = [](const DriveShape& s) {
    return static_cast<int>((1.0 + kBySpeed) * s[kOdDirection] + s[kOdOf]);
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    if (about->size() <= kOdFades) return std::vector<DriveShape>{*about};
    for (const double by : growing_steps(context, 0.01, 0.7)) {
      shapes.push_back(*about);
      shapes.back()[kOdFades] *= 1.0 + by;
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double fading = s.size() > kOdFades
                              ? std::exp(-p.speed_rpm / context.table.most_speed_rpm / s[kOdFades])
                              : 1.0;
    c[0] = is_of_direction(p, s[kOdDirection]) ? fading * sized_loss_nm(context, p, s[kOdOf]) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
    if (s.size() > kOdFades)
      figures.push_back(figure_of("fades_rpm", s[kOdFades] * context.table.most_speed_rpm));
    return figures;
  };
  f.told = od_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that is there") + direction_in_words(s[kOdDirection]) + " alone";
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{{s[kOdOf] == double(kFlanks) ? 1.0 : 0.0,
                                    s[kOdOf] == double(kFlanks) ? 0.0 : 1.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace

DriveFamily unnamed_one_direction() { return one_direction(false); }
DriveFamily unnamed_fading_one_direction() { return one_direction(true); }

}  // namespace trueflank::loop::drive_effects
