// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that comes in between two places and stays: evenly, or in two steps, over the load, the
// speed, the temperature or the run, from either end; and a bow over the run.
namespace trueflank::loop::drive_effects {

namespace {

/// `kPlateauFrom` and `kPlateauTo` are 0 ... 1 over the range, from the end where it is nothing.
enum PlateauValue : std::size_t {
  kPlateauOver,
  kPlateauMirrored,  ///< it is nothing at the upper end
  kPlateauFrom,
  kPlateauTo,
  kPlateauOf,
  kPlateauPart  ///< of two steps the share of the first; of an even one, that it stays nothing
                ///< below
};
constexpr double kLeastWhole = 0.1, kMostWhole = 0.93, kLeastRise = 0.06;
/// What it may be at the end of the range, of what it comes to, where it goes on evenly.
constexpr double kLeastAtEnd = -0.6, kMostAtEnd = 0.3;
constexpr double kLeastFirstStep = 0.2, kMostFirstStep = 0.8;

/// 0 ... 1 from the end of the range where it is nothing.
double plateau_share(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const double share = share_in_range(context, p, s[kPlateauOver]);
  return s[kPlateauMirrored] != 0.0 ? 1.0 - share : share;
}

std::vector<double> overs_of_plateaus(const DriveContext& context) {
  std::vector<double> overs;
  for (const double over : {0.0, 1.0, 2.0, kOverRun, kOverDrivingLoad})
    if (has_parts_over(context, over)) overs.push_back(over);
  return overs;
}

double even_part(const DriveShape& s, double share) {
  const double x = (share - s[kPlateauFrom]) / (s[kPlateauTo] - s[kPlateauFrom]);
  return std::min(1.0, s[kPlateauPart] != 0.0 ? std::max(0.0, x) : x);
}
double stepped_part(const DriveShape& s, double share) {
  return share > s[kPlateauTo] ? 1.0 : share > s[kPlateauFrom] ? s[kPlateauPart] : 0.0;
}

/// True of an even one whose places can be told: what it is at the end of the range is little.
bool is_even_shape(const DriveShape& s) {
  if (s[kPlateauTo] < kLeastWhole || s[kPlateauTo] > kMostWhole ||
      s[kPlateauTo] - s[kPlateauFrom] < kLeastRise)
    return false;
  if (s[kPlateauPart] != 0.0) return s[kPlateauFrom] > 0.0;
  const double at_end = even_part(s, 0.0);
  return at_end >= kLeastAtEnd && at_end <= kMostAtEnd;
}

/// A figure of one of the two places.
Parameter figure_of_plateau(const DriveContext& context, const DriveShape& s,
                            const std::string& key, double place) {
  return figure_at_share(context, s[kPlateauOver], key,
                         s[kPlateauMirrored] != 0.0 ? 1.0 - place : place);
}

std::string plateau_place(const DriveShape& s, const Parameter& place) {
  return place_in_range(s[kPlateauOver], place);
}

std::string of_plateau(const DriveShape& s, const Parameter& size, double amount) {
  return with_interval(size, amount > 0.0 ? " N m more" : " N m less") +
         (s[kPlateauOf] == double(kFlanks) ? " at the largest load, in proportion to it" : "");
}

/// Rows before, between and beyond its places, of which none may be few.
bool shows_plateau(const DriveContext& context, const DriveShape& s, bool stepped) {
  constexpr double kFewest = 6.0, kLeastOfRows = 0.06;
  double below = 0.0, between = 0.0, n = 0.0;
  for (const BenchPoint& p : context.table.points) {
    const double share = plateau_share(context, p, s);
    (share <= s[kPlateauFrom] ? below : share <= s[kPlateauTo] ? between : n) += 1.0;
  }
  const double fewest = std::max(kFewest, kLeastOfRows * (below + between + n));
  const bool must_be_below = stepped || s[kPlateauPart] != 0.0;
  return between >= fewest && n >= fewest && (!must_be_below || below >= fewest);
}

/// What even ones and stepped ones have in common.
DriveFamily plateau(bool stepped) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "mirrored", "from", "to", "what", stepped ? "part" : "nothing_below"};
  f.preference = 7;
  f.stands_alone = true;
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) {
    return static_cast<int>(8.0 * s[kPlateauMirrored] + s[kPlateauOver]);
  };
  f.kin_shapes = [](const DriveShape& s) {
    DriveShape flanks = s;
    flanks[kPlateauOf] = double(kFlanks);
    const bool load = s[kPlateauOver] == 0.0 || s[kPlateauOver] == kOverDrivingLoad;
    return load ? std::vector<DriveShape>{s} : std::vector<DriveShape>{s, flanks};
  };
  f.evaluate = [stepped](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                         double* c) {
    const double share = plateau_share(context, p, s),
                 part = stepped ? stepped_part(s, share) : even_part(s, share);
    c[0] = part != 0.0 ? part * changed_nm(context, p, s[kPlateauOf]) : 0.0;
  };
  f.shows = [stepped](const DriveContext& context, const DriveShape& s) {
    return (stepped || is_even_shape(s)) && shows_plateau(context, s, stepped);
  };
  f.words = [stepped](const DriveModel&, const DriveShape& s, const DriveContext*) {
    const std::string over = name_of_range(s[kPlateauOver]);
    return stepped ? "in two steps over the " + over
                   : "that grows evenly over a part of the " + over + " and stays";
  };
  return f;
}

}  // namespace

DriveFamily unnamed_plateau() {
  DriveFamily f = plateau(false);
  const DriveShapeValue place{
      .continuous = true, .is_place = true, .reach = 0.1, .limits = [](const DriveContext&) {
        return std::pair(-1.0, kMostWhole);
      }};
  f.shape_values = {{}, {}, place, place, {}, {}};
  f.whole_shapes = [](const DriveContext& context) {
    constexpr double kStep = 0.1;
    std::vector<DriveShape> shapes;
    for (const double over : overs_of_plateaus(context))
      for (const double mirrored : {0.0, 1.0})
        for (double to = kLeastWhole + 0.05; to < kMostWhole; to += kStep) {
          for (double from = 0.05; from < to - kLeastRise; from += kStep)
            shapes.push_back({over, mirrored, from, to, double(kDrag), 1.0});
          for (const double at_end : {-0.4, -0.2, 0.0, 0.2})
            shapes.push_back(
                {over, mirrored, -to * at_end / (1.0 - at_end), to, double(kDrag), 0.0});
        }
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double from : growing_steps(context, 0.004, 0.2))
      for (const double to : growing_steps(context, 0.004, 0.2)) {
        shapes.push_back(*about);
        shapes.back()[kPlateauFrom] += from;
        shapes.back()[kPlateauTo] += to;
        if (!is_even_shape(shapes.back())) shapes.pop_back();
      }
    return shapes;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of_plateau(context, s, "nothing_at_", s[kPlateauFrom]),
                                  figure_of_plateau(context, s, "whole_at_", s[kPlateauTo])};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const std::string from = plateau_place(s, figures[1]), to = plateau_place(s, figures[2]),
                      size = of_plateau(s, figures[0], amount);
    const bool below = s[kPlateauPart] != 0.0;
    return s[kPlateauMirrored] != 0.0 ? "a loss at the input that is the same up to " + to + ", " +
                                            size + ", and goes evenly from there: nothing at " +
                                            from + (below ? " and above" : "")
                                      : "a loss at the input that comes evenly, from nothing at " +
                                            from + (below ? " and below" : "") + " to " + size +
                                            " at " + to + ", and stays so above";
  };
  return f;
}

DriveFamily unnamed_two_steps() {
  DriveFamily f = plateau(true);
  const DriveShapeValue place{
      .continuous = true, .is_place = true, .reach = 0.02, .limits = [](const DriveContext&) {
        return std::pair(0.0, 1.0);
      }};
  f.falls_in_steps = true;
  f.changes_in_run = [](const DriveShape& s) { return s[kPlateauOver] == kOverRun ? 2.0 : 0.0; };
  f.shape_values = {
      {}, {}, place, place, {}, {.continuous = true, .limits = [](const DriveContext&) {
                                   return std::pair(kLeastFirstStep, kMostFirstStep);
                                 }}};
  f.whole_shapes = [](const DriveContext& context) {
    constexpr std::size_t kPlaces = 12;
    std::vector<DriveShape> shapes;
    for (const double over : overs_of_plateaus(context))
      for (const double mirrored : {0.0, 1.0}) {
        DriveShape shape{over, mirrored, 0.0, 1.0, double(kDrag), 0.5};
        std::vector<double> shares, places;
        for (const BenchPoint& p : context.table.points)
          shares.push_back(plateau_share(context, p, shape));
        std::sort(shares.begin(), shares.end());
        for (std::size_t k = 1; k < kPlaces; ++k)
          if (const std::size_t at = k * shares.size() / kPlaces;
              at > 0 && shares[at] > shares[at - 1])
            places.push_back(0.5 * (shares[at] + shares[at - 1]));
        for (std::size_t first = 0; first < places.size(); ++first)
          for (std::size_t second = first + 1; second < places.size(); ++second)
            for (const double part : {0.35, 0.5, 0.65}) {
              shape[kPlateauFrom] = places[first];
              shape[kPlateauTo] = places[second];
              shape[kPlateauPart] = part;
              shapes.push_back(shape);
            }
      }
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    constexpr std::ptrdiff_t kRows = 10;
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    std::vector<double> shares;
    for (const BenchPoint& p : context.table.points)
      shares.push_back(plateau_share(context, p, *about));
    const auto near = [&](double now) {
      std::vector<double> places = places_between(shares, now, kRows);
      places.insert(places.begin(), now);
      return places;
    };
    const std::vector<double> firsts = near((*about)[kPlateauFrom]),
                              seconds = near((*about)[kPlateauTo]);
    DriveShape shape = *about;
    const auto add = [&](double first, double second, double part) {
      if (first >= second || part < kLeastFirstStep || part > kMostFirstStep) return;
      shape[kPlateauFrom] = first;
      shape[kPlateauTo] = second;
      shape[kPlateauPart] = part;
      shapes.push_back(shape);
    };
    for (const double first : firsts)
      for (const double second : seconds) add(first, second, (*about)[kPlateauPart]);
    for (const double by : growing_steps(context, 0.005, 0.2))
      add((*about)[kPlateauFrom], (*about)[kPlateauTo], (*about)[kPlateauPart] + by);
    return shapes;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of_plateau(context, s, "first_step_at_", s[kPlateauFrom]),
                                  figure_of_plateau(context, s, "second_step_at_", s[kPlateauTo]),
                                  figure_of("first_step_nm", std::abs(amount) * s[kPlateauPart])};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const std::string way = s[kPlateauMirrored] != 0.0 ? " and below" : " and above";
    return "a loss at the input in two steps: " + of_plateau(s, figures[3], amount) + " from " +
           plateau_place(s, figures[1]) + way + ", " + of_plateau(s, figures[0], amount) +
           " from " + plateau_place(s, figures[2]) + way;
  };
  return f;
}

namespace {

DriveFamily bow_of_run(bool reading) {
  DriveFamily f = reading ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what"};
  f.preference = 7;
  f.stands_alone = true;
  f.follows_the_run = !reading;
  f.shape_values = {{}};
  f.shapes = no_shapes;
  f.whole_shapes = [reading](const DriveContext& context) {
    if (!has_one_course(context)) return std::vector<DriveShape>{};
    return reading ? std::vector<DriveShape>{{double(kOutputReads)}, {double(kOutputGain)}}
                   : std::vector<DriveShape>{{double(kDrag)}, {double(kFlanks)}};
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[0]); };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = 4.0 * p.taken * (1.0 - p.taken) * changed_nm(context, p, s[0]);
  };
  f.figures = [reading](const DriveContext& context, const DriveShape&, double amount) {
    const auto& points = context.table.points;
    const auto middle = std::find_if(points.begin(), points.end(),
                                     [](const BenchPoint& p) { return p.taken >= 0.5; });
    std::vector<Parameter> figures{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("most_at_line", middle == points.end() ? points.back().line : middle->line)};
    if (reading) figures.push_back(figure_of("reads_more_nm", amount * context.model.ratio));
    return figures;
  };
  f.told = [reading](const DriveContext&, const DriveShape& s, double amount,
                     const std::vector<Parameter>& figures) {
    const bool with_load = s[0] == double(kFlanks) || s[0] == double(kOutputGain);
    const std::string size =
        reading ? reads_in_words(figures[2])
                : with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less");
    return std::string(reading ? "the output's torque" : "a loss at the input that") +
           " goes out in a bow over the run and comes back, nothing at both its ends: it " +
           (reading ? "" : "is ") + size + " in the middle, at line " +
           printed("%.0f", figures[1].value) +
           (with_load ? ", at the largest load, in proportion to it" : "") +
           (reading ? kNoLoss : "");
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("in a bow over the run");
  };
  return f;
}

}  // namespace

DriveFamily unnamed_bow() { return bow_of_run(false); }
DriveFamily unnamed_reading_bow() { return bow_of_run(true); }

}  // namespace trueflank::loop::drive_effects
