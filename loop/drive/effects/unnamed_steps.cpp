// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A torque on the driven side that is read in steps far wider than its noise (a coarse converter
// before a filter, a worn scale): over the torque the error is a sawtooth, nothing in the middle of
// a step. Readings that stand on a lattice are known before (docs/decisions/0222).
namespace trueflank::loop::drive_effects {

namespace {

constexpr double kFewestSteps = 3.0, kMostSteps = 60.0;  // over the largest torque
enum StepsValue : std::size_t { kStepsNumber, kStepsPlace, kStepsForward };

/// Torque of the driven side by the model, of the largest.
double driven_share(const DriveContext& context, const BenchPoint& p) {
  return context.load_nm(p) * context.efficiency(p) / context.table.most_load_nm;
}
/// N m at the driven side for a share of 1.
double driven_at_most(const DriveContext& context, bool forward) {
  return context.table.most_load_nm * (forward ? context.model.ratio : 1.0);
}

double from_a_step(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const double steps = s[kStepsNumber] * driven_share(context, p) - s[kStepsPlace];
  return std::round(steps) - steps;
}

/// Loads without levels: between few levels a step has no place, and about each of them steps as
/// narrow as its scatter follow what the driving torque is misread by.
bool fills_its_range(const DriveContext& context) {
  constexpr std::size_t kParts = 40;
  constexpr double kFilled = 0.7;
  std::array<bool, kParts + 1> has_row{};
  const double least = context.table.least_load_nm,
               span = std::max(context.table.most_load_nm - least, 1e-300);
  for (const BenchPoint& p : context.table.points)
    has_row[static_cast<std::size_t>(kParts * std::clamp((p.load_nm - least) / span, 0.0, 1.0))] =
        true;
  return static_cast<double>(std::count(has_row.begin(), has_row.end(), true)) > kFilled * kParts;
}

std::vector<double> directions_run(const DriveContext& context) {
  std::vector<double> forward;
  for (const bool which : {true, false})
    if (context.table.has(which)) forward.push_back(which ? 1.0 : 0.0);
  return forward;
}

}  // namespace

DriveFamily unnamed_reading_in_steps() {
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"steps", "place", "forward"};
  f.asked_of_one_direction = true;
  f.dearer = kDearerForms;
  f.correction =
      "hang growing weights on a lever at the driven side: the reading must follow each of them";
  f.shape_values = {
      {.continuous = true,
       .limits =
           [](const DriveContext&) { return std::pair(0.9 * kFewestSteps, 1.2 * kMostSteps); }},
      {.continuous = true, .is_place = true, .reach = 0.1},
      {}};
  f.falls_in_steps = true;
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr int kPlacesOfStep = 10;
    constexpr double kRowsEach = 5.0, kEach = 0.25;
    std::vector<DriveShape> shapes;
    if (!fills_its_range(context)) return shapes;
    const double n = static_cast<double>(context.table.points.size()),
                 span = 1.0 - context.table.least_load_nm / context.table.most_load_nm;
    for (const double forward : directions_run(context))
      for (double steps = kFewestSteps; steps <= std::min(kMostSteps, n / kRowsEach / span);
           steps += kEach / span)
        for (int place = 0; place < kPlacesOfStep; ++place)
          shapes.push_back({steps, static_cast<double>(place) / kPlacesOfStep, forward});
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kStepsForward]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const double middle =
        0.5 * (1.0 + context.table.least_load_nm / std::max(context.table.most_load_nm, 1e-300));
    for (const double by : growing_steps(context, 0.01, 0.3))
      // (about the middle of the range, where their number does not move them)
      for (const double place : growing_steps(context, 0.005, 0.12))
        shapes.push_back({(*about)[kStepsNumber] + by, (*about)[kStepsPlace] + middle * by + place,
                          (*about)[kStepsForward]});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = p.forward == (s[kStepsForward] != 0.0)
               ? from_a_step(context, p, s) * (p.forward ? context.model.ratio : 1.0)
               : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const bool forward = s[kStepsForward] != 0.0;
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of(forward ? "step_output_nm" : "step_input_nm",
                  driven_at_most(context, forward) / s[kStepsNumber]),
        figure_of("reads_between_nm", std::abs(amount) * (forward ? context.model.ratio : 1.0))};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return std::string("the torque of the ") + (s[kStepsForward] != 0.0 ? "output" : "input") +
           " is read in steps of " + with_interval(figures[1], " N m") +
           ": between two of them it " +
           (amount > 0.0 ? "stands, and jumps by " : "runs ahead, and falls back by ") +
           with_interval(figures[2], " N m") + " (a coarse converter, a scale that sticks?)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a torque of the driven side that is read in steps");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
