// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

std::string place_in_words(const DriveShape& s, const DriveContext* context, const char* what) {
  const std::string text = std::string("with a ") + what + " over the " + name_of_quantity(s[0]);
  if (context == nullptr) return text;
  return text + " at " + short_text(context->quantity_at(s[0], s[1])) +
         (s[0] == 0.0   ? " N m at the input"
          : s[0] == 1.0 ? " rpm"
                        : " C");
}

/// A bell over the coordinate, a resonance, a bell over the quantity itself.
enum HumpKind { kSmooth, kSharp, kEvenBell };
constexpr double kHalfOfGauss = 0.8325546;  // of its width, where half is left

/// Half of a resonance's width, as a share of the range: as wide as the same hump at its place.
double half_of_resonance(const DriveContext& context, const DriveShape& s) {
  const double by = kHalfOfGauss * s[2];
  return 0.5 * (context.share_at(s[0], context.quantity_at(s[0], s[1] + by)) -
                context.share_at(s[0], context.quantity_at(s[0], s[1] - by)));
}

/// Of what has this coordinate and this share of the range.
double hump_of(const DriveContext& context, double coordinate, double share, const DriveShape& s) {
  if (s[3] == double(kSmooth)) {
    const double x = (coordinate - s[1]) / s[2];
    return std::exp(-x * x);
  }
  const double x = (share - context.share_at(s[0], context.quantity_at(s[0], s[1]))) /
                   half_of_resonance(context, s);
  return s[3] == double(kSharp) ? 1.0 / (1.0 + x * x) : std::exp2(-x * x);
}

double hump_at(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  return hump_of(context, s[3] == double(kSmooth) ? coordinate(context, p, s[0]) : 0.0,
                 s[3] == double(kSmooth) ? 0.0 : context.share_of_range(p, s[0]), s);
}

/// So many levels are counted at most: there may be none.
constexpr int kManyLevels = 8;
/// Of a hump and of a step: the direction that it stands in.
constexpr std::size_t kHumpDirection = 4, kStepDirection = 3;

/// What the output reads more, as its own figure beside the others.
std::vector<Parameter> with_reading(const DriveContext& context, double which, double amount,
                                    std::vector<Parameter> figures) {
  if (which == kAsItReads)
    figures.push_back(figure_of("reads_more_nm", amount * context.model.ratio));
  if (which == kAsItsGainReads)
    figures.push_back(
        figure_of("gain_changes_percent", 100.0 * amount / context.table.most_load_nm));
  return figures;
}

/// False where what is most of it stands where nothing was run: how high it is there nobody knows.
bool hump_shows(const DriveContext& context, const DriveShape& s) {
  constexpr double kShown = 0.4;
  const auto& points = context.table.points;
  // (where no levels were run its rows say it)
  if (context.table.levels[static_cast<std::size_t>(s[0])] >= kManyLevels)
    return std::any_of(points.begin(), points.end(), [&](const BenchPoint& p) {
      return is_of_direction(p, s[kHumpDirection] == kAsItReads ? 0.0 : s[kHumpDirection]) &&
             hump_at(context, p, s) > kShown;
    });
  const std::vector<double> levels = levels_run(context, s[0]);
  return std::any_of(levels.begin(), levels.end(), [&](double level) {
    return hump_of(context, context.coordinate_of(s[0], level), context.share_at(s[0], level), s) >
           kShown;
  });
}

std::vector<Parameter> hump_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  const std::string unit = key_of_quantity(s[0]);
  if (s[3] != double(kSmooth)) {
    const double half = half_of_resonance(context, s);
    return with_reading(context, s[kHumpDirection], amount,
                        {figure_of("at_" + unit, context.quantity_at(s[0], s[1])),
                         figure_of("half_width_" + unit, context.quantity_at_share(s[0], half) -
                                                             context.quantity_at_share(s[0], 0.0)),
                         figure_of("amplitude_nm", std::abs(amount))});
  }
  const auto at = [&](double by) {
    return context.quantity_at(s[0], s[1] + by * kHalfOfGauss * s[2]);
  };
  const double place = context.quantity_at(s[0], s[1]);
  return with_reading(
      context, s[kHumpDirection], amount,
      {figure_of("at_" + unit, place), figure_of("half_width_" + unit, 0.5 * (at(1.0) - at(-1.0))),
       figure_of("amplitude_nm", std::abs(amount))});
}

std::string hump_told(const DriveContext&, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const std::string unit = unit_of_quantity(s[0]);
  if (s[kHumpDirection] == kAsItReads)
    return "the output's torque " + reads_in_words(figures[3]) + " at a " + name_of_quantity(s[0]) +
           " of " + with_interval(figures[0], unit) + ", and half of that " +
           with_interval(figures[1], unit) + " away" + kNoLoss;
  return "a loss" + direction_in_words(s[kHumpDirection]) + " that is " +
         std::string(amount > 0.0 ? "largest" : "smallest") + " at a " + name_of_quantity(s[0]) +
         " of " + with_interval(figures[0], unit) + ", by " + with_interval(figures[2], " N m") +
         ", and half of that " + with_interval(figures[1], unit) + " away" +
         (s[kHumpDirection] == 0.0 ? "" : ", and nothing in the other direction") +
         (s[0] == 1.0 && amount > 0.0 ? " (a resonance?)" : "");
}

std::vector<Parameter> step_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  return with_reading(context, s[kStepDirection], amount,
                      {figure_of("at_" + key_of_quantity(s[0]), context.quantity_at(s[0], s[1])),
                       figure_of("amplitude_nm", std::abs(amount))});
}

/// Of a step: below the place or above it.
constexpr std::size_t kUpToIt = 2;

std::string step_told(const DriveContext&, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const std::string unit = unit_of_quantity(s[0]);
  const Parameter& at = figures[0];
  const std::string place =
      at.high - at.low > 0.01 * std::abs(at.value)
          ? "between " + printed("%.4g", at.low) + " and " + printed("%.4g", at.high) + unit
          : "of " + with_interval(at, unit);
  const std::string where = (s[kUpToIt] == 0.0 ? " from a " : " up to a ") +
                            std::string(name_of_quantity(s[0])) + " " + place +
                            (s[kUpToIt] == 0.0 ? " on" : "");
  const std::string than = s[kUpToIt] == 0.0 ? " than below" : " than above";
  if (s[kStepDirection] == kAsItReads)
    return "the output's torque " + reads_in_words(figures[2]) + where + than + kNoLoss;
  if (s[kStepDirection] == kAsItsGainReads)
    return "the output's torque reads " + percent_in_words(figures[2]) + where + than +
           ", in proportion to the load, or the input's torque as much the other way (a motor's "
           "constant in a weakened field, an amplifier's range?)" +
           kNoLoss;
  const std::string size = with_interval(figures[1], " N m") + (amount > 0.0 ? " more" : " less");
  return "a loss" + direction_in_words(s[kStepDirection]) + " that changes at once: " + size +
         where + (s[kStepDirection] == 0.0 ? "" : ", and nothing in the other direction");
}

/// Temperatures lie about their mean, which may be far from their middle.
std::pair<double, double> ends_of_places(const DriveContext& context) {
  constexpr double kEnd = 0.95;
  const BenchTable& t = context.table;
  if (!t.has_temperature || !(t.temperature_span_c > 0.0)) return {-kEnd, kEnd};
  const double low = context.coordinate_of(2.0, t.least_temperature_c),
               high = context.coordinate_of(2.0, t.least_temperature_c + t.temperature_span_c);
  return {std::min(-kEnd, kEnd * low), std::max(kEnd, kEnd * high)};
}

double far_end_of_places(const DriveContext& context) {
  const auto [low, high] = ends_of_places(context);
  return std::max(-low, high);
}

/// Places about one, in steps that grow, and over the whole range.
std::vector<double> near_and_far(const DriveContext& context, double place, double end) {
  std::vector<double> places;
  for (const double step : growing_steps(context, 0.0005, 0.2)) places.push_back(place + step);
  for (int k = -38; k <= 38; ++k) places.push_back(k * end / 38.0);
  std::erase_if(places, [&](double at) { return std::abs(at) > end; });
  return places;
}

/// Both directions and each alone, or as the output reads.
std::vector<double> directions_of(const DriveContext& context, bool reading) {
  const std::vector<double> alone = directions_alone(context);
  if (!reading) return alone;
  return alone.size() > 1 ? std::vector{kAsItReads} : std::vector<double>{};
}

/// A step of a gain over the load is that of a range, which is a form of its own.
bool can_be_a_gain(double over) { return over != 0.0; }

/// Of a step that is read: the largest load [N m], and how much a gain changes at most.
constexpr std::size_t kStepOfNm = 4;
constexpr double kMostGainChange = 0.15;

DriveShape step_shape(const DriveContext& context, double over, double place, double up_to_it,
                      double which) {
  DriveShape shape{over, place, up_to_it, which};
  if (which == kAsItReads || which == kAsItsGainReads) shape.push_back(context.table.most_load_nm);
  return shape;
}

/// Everywhere between the ends of the range, or, to be found by, at the levels and between them.
std::vector<DriveShape> all_places(const DriveContext& context, const DriveShape* about, bool hump,
                                   bool reading) {
  std::vector<DriveShape> shapes;
  const std::vector<double> directions =
      about == nullptr ? directions_of(context, reading)
                       : std::vector{(*about)[hump ? kHumpDirection : kStepDirection]};
  for (int over = 0; over < 3; ++over) {
    if (context.table.levels[static_cast<std::size_t>(over)] < 4) continue;
    if (about != nullptr && (*about)[0] != double(over)) continue;
    std::vector<double> places;
    if (about != nullptr)
      places = near_and_far(context, (*about)[1], over == 2 ? far_end_of_places(context) : 0.95);
    else
      for (const double share : places_between_levels(context, over))
        places.push_back(context.coordinate_of(over, context.quantity_at_share(over, share)));
    if (hump)
      for (const double level : levels_run(context, over))
        if (const double at = context.coordinate_of(over, level); std::abs(at) <= 1.0)
          places.push_back(at);
    std::vector<double> widths{0.05, 0.08, 0.12, 0.17, 0.24, 0.34, 0.48, 0.68};
    if (about != nullptr && hump)
      for (const double wider : growing_steps(context, 0.004, 0.5))
        widths.push_back((*about)[2] * std::exp(wider));
    std::erase_if(widths, [](double w) { return w < 0.05 || w > 0.8; });
    for (const double place : places) {
      for (const double which : directions) {
        if (!hump) {
          const auto add = [&](double up_to_it, double of_which) {
            shapes.push_back(step_shape(context, over, place, up_to_it, of_which));
          };
          add(about ? (*about)[kUpToIt] : 0.0, which);
          // (of one direction alone nothing stands for what it is on the other side)
          if (about == nullptr && which != 0.0) add(1.0, which);
          if (about == nullptr && which == kAsItReads && can_be_a_gain(over))
            for (const double up_to_it : {0.0, 1.0}) add(up_to_it, kAsItsGainReads);
          continue;
        }
        for (const double kind : {double(kSmooth), double(kSharp), double(kEvenBell)}) {
          if (about == nullptr && kind != double(kSmooth)) continue;
          for (const double width : widths)
            shapes.push_back({double(over), place, width, kind, which});
        }
      }
    }
  }
  return shapes;
}

/// Narrow ones too, wherever they stand.
std::vector<DriveShape> fine_humps(const DriveContext& context) {
  std::vector<DriveShape> shapes;
  for (int over = 0; over < 3; ++over)
    if (context.table.levels[static_cast<std::size_t>(over)] >= 6)
      for (int k = -31; k <= 31; ++k)
        for (const double width : {0.055, 0.1, 0.18})
          for (const double which : directions_alone(context))
            if (which == 0.0 || over == 1)  // (a resonance of one direction)
              shapes.push_back({double(over), 0.03 * k, width, double(kSmooth), which});
  return shapes;
}

/// A step at a place, or a hump about one, over load, speed or temperature (in -1 ... 1 of the
/// range), of a loss or of what the output reads.
DriveFamily at_a_place(bool hump, bool reading) {
  DriveFamily f = reading ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place"};
  f.over = first_value;
  f.shape_values = {{}, {.continuous = true, .is_place = true, .limits = ends_of_places}};
  if (hump) {
    f.shape_names.insert(f.shape_names.end(), {"width", "kind", "which_direction"});
    f.shape_values.push_back(
        {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.05, 0.8); }});
    f.shape_values.resize(f.shape_names.size());
    f.kind = [](const DriveShape& s) { return static_cast<int>(3.0 * s[kHumpDirection] + s[0]); };
    if (!reading) f.whole_shapes = fine_humps;
    f.kin_shapes = [](const DriveShape& s) {
      std::vector<DriveShape> shapes;
      for (const double kind : {double(kSmooth), double(kSharp), double(kEvenBell)})
        shapes.push_back({s[0], s[1], s[2], kind, s[kHumpDirection]});
      return shapes;
    };
  }
  f.shapes = [hump, reading](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double which : directions_of(context, reading))
      for (int over = 0; over < 3; ++over) {
        if (context.table.levels[over] < 4) continue;
        // (of one direction fewer: they are refined where they are chosen)
        const auto places = which == 0.0 ? std::vector{-0.75, -0.5, -0.25, 0.05, 0.25, 0.5, 0.75}
                                         : std::vector{-0.6, -0.2, 0.2, 0.6};
        const auto widths = which == 0.0 ? std::vector{0.15, 0.35} : std::vector{0.35};
        for (const double place : places) {
          if (!hump)
            shapes.push_back(step_shape(context, over, place, 0.0, which));
          else
            for (const double width : widths)
              shapes.push_back({double(over), place, width, 0.0, which});
        }
      }
    return shapes;
  };
  f.evaluate = [hump](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                      double* c) {
    const double size = hump ? hump_at(context, p, shape)
                        : (coordinate(context, p, shape[0]) > shape[1]) == (shape[kUpToIt] == 0.0)
                            ? 1.0
                            : 0.0;
    c[0] = size == 0.0
               ? 0.0
               : size * in_direction(context, p, shape[hump ? kHumpDirection : kStepDirection]);
  };
  if (!hump) {
    f.shape_names.insert(f.shape_names.end(), {"up_to_it", "which_direction"});
    if (reading) {
      f.shape_names.emplace_back("of_nm");
      f.plausible = [](const DriveModel&, const DriveShape& s, double amount_nm) {
        return s[kStepDirection] != kAsItsGainReads ||
               std::abs(amount_nm) < kMostGainChange * s[kStepOfNm];
      };
    }
    f.kind = [](const DriveShape& s) { return static_cast<int>(s[kStepDirection]); };
    f.kin_shapes = [](const DriveShape& s) {
      std::vector<DriveShape> shapes;
      const bool reads = s[kStepDirection] == kAsItReads || s[kStepDirection] == kAsItsGainReads;
      for (const double which : reads&& can_be_a_gain(s[0])
                                    ? std::vector{kAsItReads, kAsItsGainReads}
                                    : std::vector{s[kStepDirection]})
        for (const double up_to_it : {0.0, 1.0}) {
          shapes.push_back(s);
          shapes.back()[kUpToIt] = up_to_it;
          shapes.back()[kStepDirection] = which;
        }
      return shapes;
    };
  }
  f.stands_alone = true;
  f.has_a_place = true;
  f.falls_in_steps = !hump;
  f.all_shapes = [hump, reading](const DriveContext& context, const DriveShape* about) {
    return all_places(context, about, hump, reading);
  };
  f.figures = hump ? hump_figures : step_figures;
  f.told = hump ? hump_told : step_told;
  if (hump) f.shows = hump_shows;
  if (hump)
    f.was_run = [](const DriveContext& context, const DriveShape& s) {
      const std::vector<double> levels = levels_run(context, s[0]);
      return std::any_of(levels.begin(), levels.end(), [&](double level) {
        return std::abs(context.coordinate_of(s[0], level) - s[1]) < 1e-9;
      });
    };
  f.words = [hump, reading](const DriveModel&, const DriveShape& shape,
                            const DriveContext* context) {
    return (reading ? "as a reading of the output's torque " : "") +
           place_in_words(shape, context, hump ? "hump" : "step");
  };
  if (reading)
    f.term_shapes = [](const DriveShape&) {
      return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
    };
  return f;
}

}  // namespace

DriveFamily unnamed_step() { return at_a_place(false, false); }
DriveFamily unnamed_hump() { return at_a_place(true, false); }
DriveFamily unnamed_reading_step() { return at_a_place(false, true); }
DriveFamily unnamed_reading_hump() { return at_a_place(true, true); }

}  // namespace trueflank::loop::drive_effects
