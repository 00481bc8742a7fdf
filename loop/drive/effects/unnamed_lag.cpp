// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A torque that is read before it has settled: every row still holds a share of the row before.
namespace trueflank::loop::drive_effects {

namespace {

/// Whose torque it is, and whether the row before is held as it read or as it was (a filter of two
/// rows).
enum LagValue : std::size_t { kLagOf, kLagAsItWas };
enum class Lags { kOutput, kInput, kDriven, kDriving };

Lags who_lags(const DriveShape& s) { return static_cast<Lags>(static_cast<int>(s[kLagOf])); }

double output_of(const BenchPoint& p) { return p.forward ? p.driven_nm : p.driving_nm; }
double input_of(const BenchPoint& p) { return p.forward ? p.driving_nm : p.driven_nm; }

/// What is driven, without what is read wrong there.
double driven_as_it_was(const DriveContext& context, const BenchPoint& p) {
  return context.gain(p) * context.efficiency(p) * p.driving_nm;
}

/// Change of the driven torque where the side's reading goes all the way back to the row before.
double all_of_the_row_before(const DriveContext& context, const BenchPoint& p,
                             const DriveShape& s) {
  const BenchPoint* const taken_before = context.table.row_before(p);
  if (taken_before == nullptr) return 0.0;
  const Lags who = who_lags(s);
  BenchPoint before = *taken_before;
  if (s[kLagAsItWas] != 0.0) before.driven_nm = driven_as_it_was(context, before);
  const bool of_driven = who == Lags::kDriven || (who == Lags::kOutput && p.forward) ||
                         (who == Lags::kInput && !p.forward);
  const double then = who == Lags::kOutput   ? output_of(before)
                      : who == Lags::kInput  ? input_of(before)
                      : who == Lags::kDriven ? before.driven_nm
                                             : before.driving_nm,
               now = of_driven ? driven_as_it_was(context, p) : p.driving_nm;
  const bool of_input = of_driven != p.forward;
  return context.misread(p, of_input) * (then - now);
}

std::string whose_torque(Lags who, bool both) {
  switch (who) {
    case Lags::kOutput:
      return "the output's torque";
    case Lags::kInput:
      return "the input's torque";
    case Lags::kDriven:
      return both ? "the torque of whichever side is driven" : "the driven torque";
    default:
      return both ? "the torque of whichever side drives" : "the driving torque";
  }
}

}  // namespace

DriveFamily unnamed_lag() {
  DriveFamily f = reading_without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"whose", "as_it_was"};
  f.preference = 7;
  f.stands_alone = true;
  f.only_positive = true;
  f.asked_of_one_direction = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    const bool both = context.table.has(true) && context.table.has(false);
    for (const Lags who : {Lags::kOutput, Lags::kInput, Lags::kDriven, Lags::kDriving})
      for (const double as_it_was : {0.0, 1.0})
        if (both || who == Lags::kOutput || who == Lags::kInput)
          shapes.push_back({static_cast<double>(static_cast<int>(who)), as_it_was});
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kLagOf]); };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = all_of_the_row_before(context, p, s) / context.table.most_load_nm;
  };
  f.figures = [](const DriveContext& context, const DriveShape&, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("share_percent", 100.0 * amount / context.table.most_load_nm)};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double,
              const std::vector<Parameter>& figures) {
    const bool both = context.table.has(true) && context.table.has(false);
    return whose_torque(who_lags(s), both) + " is read before it has settled: every row still " +
           "holds " + with_interval(figures[1], " %") + " of the step from the row before, " +
           with_interval(figures[0], " N m") +
           " at the input where it steps by the largest load (a filter or a sensor that lags: wait "
           "longer at every set point)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that still holds a share of the row before");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
