// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A short loss once in every turn of a shaft that swells and dies away: a tooth that is damaged, a
// chip, a place that rubs.
namespace trueflank::loop::drive_effects {

namespace {

enum BumpValue : std::size_t {
  kBumpOrder,
  kBumpCentre,
  kBumpHalf,
  kBumpDirection,
  kBumpWithLoad  ///< as large at every load (0), or in proportion to it
};

/// Turns of the drive's members, and places that come several times in a turn of the input.
std::vector<double> bump_orders(const DriveContext& context) {
  constexpr double kFewestTurns = 5.0;
  constexpr int kMostPerTurn = 6;
  std::vector<double> orders;
  const auto add = [&](double order) {
    for (const double known : orders)
      if (std::abs(known - order) < 1e-6 * order) return;
    orders.push_back(order);
  };
  if (!context.table.has_angle) return orders;
  for (int k = 1; k <= kMostPerTurn; ++k) add(k);
  for (const MemberOrder& member : context.model.orders)
    if (member.order <= kMostPerTurn && member.order * context.table.turns >= kFewestTurns &&
        context.table.turns > 1.01)
      add(member.order);
  return orders;
}

}  // namespace

DriveFamily unnamed_bump() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  // (the centre and the half width in turns)
  f.shape_names = {"order", "centre", "half_width", "which_direction", "with_load"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {
      {},
      {.continuous = true, .is_place = true, .reach = 0.03},
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.004, 0.2); }},
      {},
      {}};
  // Waves and parts of a turn that were found say where to look.
  f.shapes = no_shapes;
  f.turns_per_turn = first_value;
  f.kind = [](const DriveShape& s) {
    return 2 * static_cast<int>(s[kBumpDirection]) + (s[kBumpOrder] == 1.0 ? 1 : 0);
  };
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double order : bump_orders(context))
      for (const double half : {0.015, 0.03, 0.06, 0.12})
        for (double centre = 0.0; centre < 1.0; centre += 0.6 * half)
          for (const double which : directions_alone(context))
            shapes.push_back({order, centre, half, which, 0.0});
    return shapes;
  };
  f.kin_shapes = [](const DriveShape& s) {
    DriveShape even = s, with_load = s;
    even[kBumpWithLoad] = 0.0;
    with_load[kBumpWithLoad] = 1.0;
    return std::vector<DriveShape>{even, with_load};
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double by : growing_steps(context, 0.01, 1.0))
      for (const double wider : growing_steps(context, 0.02, 0.7))
        shapes.push_back({(*about)[kBumpOrder], (*about)[kBumpCentre] + by * (*about)[kBumpHalf],
                          (*about)[kBumpHalf] * std::exp(wider), (*about)[kBumpDirection],
                          (*about)[kBumpWithLoad]});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double off = place_of_spell(p, s[kBumpOrder]) - s[kBumpCentre];
    off -= std::round(off);
    const double x = off / s[kBumpHalf];
    c[0] = x * x < 40.0
               ? std::exp2(-x * x) * in_direction(context, p, s[kBumpDirection]) *
                     (s[kBumpWithLoad] != 0.0 ? p.load_nm / context.table.most_load_nm : 1.0)
               : 0.0;
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("order", s[kBumpOrder]),
                                  figure_of("at_deg", 360.0 * s[kBumpCentre]),
                                  figure_of("half_width_deg", 360.0 * s[kBumpHalf]),
                                  figure_of("amplitude_nm", std::abs(amount))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    // (where it is no member's turn it is told by the input's)
    const double every = 360.0 / s[kBumpOrder],
                 at = every * (s[kBumpCentre] - std::floor(s[kBumpCentre]));
    const std::string of_input = s[kBumpOrder] > 1.001
                                     ? printed(" (%.4g degrees of the input", at) +
                                           printed(" and every %.4g degrees on)", every)
                                     : "";
    return "a short loss once in every turn " + turn_in_words(context.model, s[kBumpOrder]) +
           of_input + ": " + with_interval(figures[3], " N m") +
           (amount > 0.0 ? " more" : " less") +
           (s[kBumpWithLoad] != 0.0 ? " at the largest load, in proportion to the load," : "") +
           direction_in_words(s[kBumpDirection]) + " at " + with_interval(figures[1], " degrees") +
           " of it, half of that " + with_interval(figures[2], " degrees") + " to either side" +
           (s[kBumpDirection] == 0.0 ? "" : ", and nothing in the other direction") +
           " (a chip, a damaged tooth, a tight place?)";
  };
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return "short, once in every turn " + turn_in_words(model, s[kBumpOrder]);
  };
  return f;
}

DriveFamily unnamed_cusps() {
  enum CuspValue : std::size_t { kCuspOrder, kCuspPlace };
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "place"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {.continuous = true, .is_place = true, .reach = 0.03}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr int kPlaces = 30;
    std::vector<DriveShape> shapes;
    for (const double order : bump_orders(context))
      for (int place = 0; place < kPlaces; ++place)
        shapes.push_back({order, static_cast<double>(place) / kPlaces});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double step : growing_steps(context, 0.001, 0.06))
      shapes.push_back({(*about)[kCuspOrder], (*about)[kCuspPlace] + step});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] =
        -context.lever(p) *
        std::abs(std::sin(0.5 * kTwoPi * (s[kCuspOrder] * p.angle_rad / kTwoPi - s[kCuspPlace])));
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)), figure_of("periods_per_turn", s[kCuspOrder]),
        figure_of("edge_at_deg",
                  360.0 * (s[kCuspPlace] - std::floor(s[kCuspPlace])) / s[kCuspOrder])};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return "a loss at the input in arches over the angle (" +
           turn_in_words(context.model, s[kCuspOrder]) + "), nothing at the edge between two at " +
           with_interval(figures[2], " degrees of the input") +
           (s[kCuspOrder] > 1.001 ? printed(" and every %.4g degrees on", 360.0 / s[kCuspOrder])
                                  : "") +
           ": " + with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") +
           " half way between (a joint at an angle, what is pushed to either side in turn?)";
  };
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return "in arches over the turn " + turn_in_words(model, s[kCuspOrder]);
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
