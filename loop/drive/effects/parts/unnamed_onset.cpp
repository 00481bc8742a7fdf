// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that begins at a speed or a load, or that is gone from there on: oil that is taken along,
// a preload that the load takes up, magnets that cog while little is carried.
namespace trueflank::loop::drive_effects {

namespace {

enum OnsetValue : std::size_t {
  kOnsetOver,
  kOnsetPlace,
  kOnsetRises,
  kOnsetPower,
  kOnsetDirection,
  kOnsetOfFlanks  ///< 1: in proportion to the load, as the flanks' friction; over speed,
                  ///< temperature
};

constexpr std::array kOnsetPowers{1.0, 1.25, 1.5, 1.75, 2.0};

/// Of these powers by square roots, which are exact and quick.
double to_the_power(double x, double power) {
  if (power == 1.0) return x;
  if (power == 2.0) return x * x;
  const double root = std::sqrt(x);
  return power == 1.5 ? x * root : power == 1.25 ? x * std::sqrt(root) : x * root * std::sqrt(root);
}

/// Shares of the range about one, in steps that grow, and over all of it.
std::vector<double> near_and_far_shares(const DriveContext& context, double share) {
  std::vector<double> shares;
  for (const double step : growing_steps(context, 0.0005, 0.1)) shares.push_back(share + step);
  constexpr std::size_t kVeryMany = 3000;
  const int steps = context.table.points.size() < kVeryMany ? 200 : 50;
  for (int k = 1; k < steps; ++k) shares.push_back(static_cast<double>(k) / steps);
  std::erase_if(shares, [](double at) { return at < 0.02 || at > 0.98; });
  return shares;
}

/// Share of the way from the place to the end of the range that it runs to; 0 on the other side.
double way_beyond(double share, const DriveShape& s) {
  const bool rises = s[kOnsetRises] > 0.0;
  const double room = rises ? 1.0 - s[kOnsetPlace] : s[kOnsetPlace];
  return std::max(0.0,
                  (rises ? share - s[kOnsetPlace] : s[kOnsetPlace] - share) / std::max(room, 1e-9));
}

/// A place or an end as people know it: of loads the torque at the output.
double in_words_of_the_bench(const DriveContext& context, double over, double quantity) {
  return over == 0.0 ? quantity * context.model.ratio : quantity;
}
std::string unit_of_the_bench(double over) {
  return over == 0.0 ? " N m at the output" : unit_of_quantity(over);
}

/// End of the range that it runs to, and the one where it is nothing.
double far_end(const DriveContext& context, const DriveShape& s) {
  if (s[kOnsetOver] == 0.0 && s[kOnsetRises] > 0.0 && s[kOnsetDirection] != 0.0)
    return context.table.most_carried_of[s[kOnsetDirection] == 1.0 ? 1 : 0];
  return context.quantity_at_share(s[kOnsetOver],
                                   s[kOnsetRises] > 0.0 ? 1.0 : context.least_share(s[kOnsetOver]));
}

std::vector<Parameter> onset_figures(const DriveContext& context, const DriveShape& s,
                                     double amount) {
  const double place = context.quantity_at_share(s[kOnsetOver], s[kOnsetPlace]),
               end = far_end(context, s);
  const std::string unit = s[kOnsetOver] == 0.0 ? "output_nm" : key_of_quantity(s[kOnsetOver]);
  const double reached =
      amount * to_the_power(way_beyond(context.share_at(s[kOnsetOver], end), s), s[kOnsetPower]);
  if (s[kOnsetOfFlanks] != 0.0) {
    const double nm = nm_of_coefficient(context);
    return {figure_of((s[kOnsetRises] > 0.0 ? "begins_at_" : "ends_at_") + unit, place),
            figure_of("slope_nm_per_" + unit, reached * nm / (end - place)),
            figure_of("amplitude_nm", std::abs(reached) * nm),
            figure_of("coefficient_change", std::abs(reached))};
  }
  std::vector<Parameter> figures{
      figure_of((s[kOnsetRises] > 0.0 ? "begins_at_" : "ends_at_") + unit,
                in_words_of_the_bench(context, s[kOnsetOver], place)),
      figure_of("slope_nm_per_" + unit,
                reached / in_words_of_the_bench(context, s[kOnsetOver], end - place)),
      figure_of("amplitude_nm", std::abs(reached)), figure_of("power", s[kOnsetPower])};
  if (s[kOnsetDirection] == kAsItReads)
    figures.push_back(figure_of("reads_more_nm", reached * context.model.ratio));
  return figures;
}

/// The friction of the flanks from a speed or a temperature on.
std::string flanks_onset_told(const DriveContext& context, const DriveShape& s, double amount,
                              const std::vector<Parameter>& figures) {
  const std::string unit = unit_of_the_bench(s[kOnsetOver]), of = name_of_quantity(s[kOnsetOver]),
                    end = printed("%.4g", far_end(context, s)) + unit;
  const bool more = amount > 0.0;
  const double found = context.model.friction + context.state.shift,
               reached = found + (more ? figures[3].value : -figures[3].value);
  return std::string("the flanks rub ") + (more ? "more " : "less ") +
         (s[kOnsetRises] > 0.0 ? "from a " : "below a ") + of + " of " +
         with_interval(figures[0], unit) + (s[kOnsetRises] > 0.0 ? " on" : "") +
         ": their coefficient is " + with_interval(figures[3], more ? " more" : " less") + " at " +
         end + printed(", %.3g instead of %.3g, a loss of ", reached, found) +
         with_interval(figures[2], more ? " N m more" : " N m less") + " at the largest load";
}

std::string onset_told(const DriveContext& context, const DriveShape& s, double amount,
                       const std::vector<Parameter>& figures) {
  if (s[kOnsetOfFlanks] != 0.0) return flanks_onset_told(context, s, amount, figures);
  const std::string unit = unit_of_the_bench(s[kOnsetOver]), of = name_of_quantity(s[kOnsetOver]);
  const std::string end =
      printed("%.4g", in_words_of_the_bench(context, s[kOnsetOver], far_end(context, s))) + unit;
  const Parameter &place = figures[0], &slope = figures[1], &reached = figures[2];
  const std::string which = direction_in_words(s[kOnsetDirection]);
  const std::string at = with_interval(place, unit), size = short_text(std::abs(reached.value));
  const bool more = amount > 0.0;
  std::string text;
  if (s[kOnsetDirection] == kAsItReads)
    return "the output's torque " + reads_in_words(figures[4]) + " at " + end +
           (s[kOnsetRises] > 0.0 ? ", which begins at a " : ", which ends at a ") + of + " of " +
           at + kNoLoss;
  if (s[kOnsetRises] > 0.0) {
    text = "a " + std::string(more ? "loss" : "change of the loss") + which + " that begins at a " +
           of + " of " + at + ", then " + (more ? "rises" : "falls");
    text += s[kOnsetPower] == 1.0
                ? " by " + with_interval(slope, " N m per" + unit_alone(s[kOnsetOver])) + ", to "
                : " ever faster, to ";
    text += size + " N m " + (more ? "more" : "less") + " at " + end;
    // A place further down and a bend explain as much.
    const Parameter& power = figures[3];
    if (power.high > power.low)
      text += printed(" (or, from further down, by a power of it of up to %.3g)", power.high);
  } else {
    text = "a " + std::string(more ? "loss" : "change of the loss") + which + " at low " + of +
           ": " + size + " N m " + (more ? "more" : "less") + " at " + end + ", which ends at a " +
           of + " of " + at;
  }
  if (s[kOnsetDirection] != 0.0) text += ", and nothing in the other direction";
  return text;
}

/// Of a loss, or of what the output reads. What it reads over its own load is a bend.
DriveFamily from_a_place_on(bool reading) {
  const int least_over = reading ? 1 : 0;
  const auto directions_of = [reading](const DriveContext& context) {
    const std::vector<double> alone = directions_alone(context);
    if (!reading) return alone;
    return alone.size() > 1 ? std::vector{kAsItReads} : std::vector<double>{};
  };
  DriveFamily f = reading ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place", "rises", "power", "which_direction", "of_flanks"};
  f.preference = 7;
  f.stands_alone = true;
  f.over = first_value;
  f.shape_values = {{},
                    {.continuous = true,
                     .is_place = true,
                     .limits = [](const DriveContext&) { return std::pair(0.03, 0.97); }},
                    {},
                    {},
                    {},
                    {}};
  f.kind = [](const DriveShape& s) {
    return static_cast<int>(s[kOnsetOfFlanks] + 2.0 * s[kOnsetDirection]);
  };
  f.has_a_place = true;
  f.beside_load = [](const DriveShape& s) {
    return s[kOnsetOfFlanks] != 0.0 ? s[kOnsetOver] : kOverNothing;
  };
  f.shapes = [directions_of, least_over](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double which : directions_of(context))
      for (int over = least_over; over < 3; ++over) {
        if (context.table.levels[static_cast<std::size_t>(over)] < 4) continue;
        const auto places = which == 0.0 ? std::vector{0.2, 0.4, 0.6, 0.8} : std::vector{0.3, 0.7};
        for (const double place : places)
          for (const double rises : {1.0, -1.0})
            shapes.push_back({double(over), place, rises, 1.0, which, 0.0});
      }
    return shapes;
  };
  f.all_shapes = [directions_of, least_over](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    for (int over = least_over; over < 3; ++over) {
      if (context.table.levels[static_cast<std::size_t>(over)] < 4) continue;
      if (about != nullptr && (*about)[kOnsetOver] != double(over)) continue;
      for (const double rises : {1.0, -1.0})
        for (const double which : directions_of(context)) {
          if (about != nullptr &&
              ((*about)[kOnsetRises] != rises || (*about)[kOnsetDirection] != which))
            continue;
          if (about == nullptr) {
            for (const double place : places_between_levels(context, over)) {
              shapes.push_back({double(over), place, rises, 1.0, which, 0.0});
              if (over != 0 && which == 0.0)
                shapes.push_back({double(over), place, rises, 1.0, which, 1.0});
            }
            continue;
          }
          for (const double power : kOnsetPowers)
            for (const double place : near_and_far_shares(context, (*about)[kOnsetPlace]))
              shapes.push_back(
                  {double(over), place, rises, power, which, (*about)[kOnsetOfFlanks]});
        }
    }
    return shapes;
  };
  f.is_odd = [](const DriveShape& s) { return s[kOnsetPower] != 1.0; };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> shapes;
    for (const double power : {1.0, 1.5, 2.0})
      shapes.push_back({s[kOnsetOver], s[kOnsetPlace], s[kOnsetRises], power, s[kOnsetDirection],
                        s[kOnsetOfFlanks]});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = 0.0;
    const double beyond = way_beyond(context.share_of_range(p, s[kOnsetOver]), s);
    if (!(beyond > 0.0)) return;
    const double unit = s[kOnsetOfFlanks] != 0.0 ? context.friction_slope(p)
                                                 : in_direction(context, p, s[kOnsetDirection]);
    c[0] = unit * to_the_power(beyond, s[kOnsetPower]);
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext* context) {
    const std::string of = name_of_quantity(s[kOnsetOver]);
    const std::string at =
        context == nullptr ? ""
                           : " of " +
                                 short_text(in_words_of_the_bench(
                                     *context, s[kOnsetOver],
                                     context->quantity_at_share(s[kOnsetOver], s[kOnsetPlace]))) +
                                 unit_of_the_bench(s[kOnsetOver]);
    return std::string(s[kOnsetOfFlanks] != 0.0           ? "by friction of the flanks "
                       : s[kOnsetDirection] == kAsItReads ? "as a reading of the output's torque "
                                                          : "") +
           (s[kOnsetRises] > 0.0 ? "that begins at a " : "that ends at a ") + of + at;
  };
  f.figures = onset_figures;
  f.told = onset_told;
  if (reading)
    f.term_shapes = [](const DriveShape&) {
      return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
    };
  return f;
}

}  // namespace

DriveFamily unnamed_onset() { return from_a_place_on(false); }
DriveFamily unnamed_reading_onset() { return from_a_place_on(true); }

}  // namespace trueflank::loop::drive_effects
