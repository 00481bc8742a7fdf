// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// Flanks that rub more at low speed, up to higher speeds the higher the load: the film of oil
// follows the speed over the load (Hersey's number).
namespace trueflank::loop::drive_effects {

namespace {

/// The speed over the load, of the largest load 1, at which it has fallen, and by which law.
enum HerseyValue : std::size_t { kHerseyKnee, kHerseyLaw };
enum HerseyLaw { kRational, kHerseyGauss, kHerseyExponential };

double load_of_largest(const DriveContext& context, const BenchPoint& p) {
  return std::max(1e-6, p.load_nm / context.table.most_load_nm);
}

/// 1 where the flanks touch, 0 where the film carries.
double touch_of(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const double x = p.speed_rpm / (s[kHerseyKnee] * load_of_largest(context, p));
  return s[kHerseyLaw] == double(kRational)      ? 1.0 / (1.0 + x * x)
         : s[kHerseyLaw] == double(kHerseyGauss) ? std::exp(-x * x)
                                                 : std::exp(-x);
}

/// The speed over the load, of the largest load 1, at which half of it is left.
double half_of(const DriveShape& s) {
  const double of_knee = s[kHerseyLaw] == double(kRational)      ? 1.0
                         : s[kHerseyLaw] == double(kHerseyGauss) ? std::sqrt(std::log(2.0))
                                                                 : std::log(2.0);
  return s[kHerseyKnee] * of_knee;
}

std::pair<double, double> knee_limits(const DriveContext& context) {
  return {std::max(1e-3 * context.table.most_speed_rpm, 0.5 * context.table.least_speed_rpm),
          2.0 * context.table.most_speed_rpm};
}

/// Rows in which the flanks touch and rows in which they do not, and loads that differ.
bool shows_hersey(const DriveContext& context, const DriveShape& s) {
  constexpr double kTouch = 0.6, kFilm = 0.3, kLeastOfRows = 0.04, kLoads = 1.5;
  double touch = 0.0, film = 0.0, n = 0.0;
  for (const BenchPoint& p : context.table.points) {
    const double part = touch_of(context, p, s);
    touch += part > kTouch ? 1.0 : 0.0;
    film += part < kFilm ? 1.0 : 0.0;
    n += 1.0;
  }
  return std::min(touch, film) > kLeastOfRows * n &&
         context.table.most_load_nm > kLoads * context.table.least_load_nm;
}

}  // namespace

DriveFamily unnamed_hersey() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"knee_rpm", "law"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {{.continuous = true, .limits = knee_limits}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr double kStep = 1.4;
    constexpr int kFewestLevels = 4;
    std::vector<DriveShape> shapes;
    if (context.table.levels[0] < kFewestLevels || context.table.levels[1] < kFewestLevels)
      return shapes;
    const auto [least, most] = knee_limits(context);
    for (double knee = least; knee < most; knee *= kStep)
      for (const int law : {kRational, kHerseyGauss, kHerseyExponential})
        shapes.push_back({knee, double(law)});
    return shapes;
  };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin;
    for (const int law : {kRational, kHerseyGauss, kHerseyExponential})
      kin.push_back({s[kHerseyKnee], double(law)});
    return kin;
  };
  f.shows = shows_hersey;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    if (about == nullptr) return std::vector<DriveShape>{};
    const auto [least, most] = knee_limits(context);
    std::vector<DriveShape> shapes;
    // (laws that explain as much have halves that differ: the interval holds them all)
    for (const int law : {kRational, kHerseyGauss, kHerseyExponential}) {
      DriveShape other{1.0, double(law)};
      other[kHerseyKnee] = half_of(*about) / half_of(other);
      for (DriveShape& shape : with_first_moved(
               context, other,
               {.first = 0.005, .last = 0.5, .least = least, .most = most, .as_shares = true}))
        shapes.push_back(std::move(shape));
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = touch_of(context, p, s) * changed_nm(context, p, double(kFlanks));
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double least = context.table.least_load_nm / context.table.most_load_nm;
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("half_at_rpm_at_largest_load", half_of(s)),
        figure_of("half_at_rpm_at_least_load", half_of(s) * std::max(0.0, least))};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const char* law = s[kHerseyLaw] == double(kRational)      ? "1/(1 + x^2)"
                      : s[kHerseyLaw] == double(kHerseyGauss) ? "exp(-x^2)"
                                                              : "exp(-x)";
    return "the flanks rub " + std::string(amount > 0.0 ? "more" : "less") +
           " at low speed, up to higher speeds the higher the load: a loss in proportion to the "
           "load, " +
           with_interval(figures[0], " N m") + (amount > 0.0 ? " more" : " less") +
           " at the largest load and no speed, that falls with the speed over the load, about by " +
           law + ": half of it is left at a speed of " + with_interval(figures[1], " rpm") +
           " at the largest load and of " + with_interval(figures[2], " rpm") +
           " at the least (a film of oil: Hersey's number?)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("by the friction of the flanks, that follows the speed over the load");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
