// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A corner of two quantities: a loss, or a reading, beyond a place in the one AND beyond a place in
// the other (hot and fast, slow and loaded), where neither alone does it.
namespace trueflank::loop::drive_effects {

namespace {

/// Two sides, each of a quantity, a place in it (a share of its range), the side of the place and
/// whether it jumps there or grows from there on to the end of the range.
enum CornerValue : std::size_t {
  kCornerOver,
  kCornerPlace,
  kCornerBelow,
  kCornerGrows,
  kCornerOverToo,
  kCornerPlaceToo,
  kCornerBelowToo,
  kCornerGrowsToo,
  kCornerReads
};
constexpr std::size_t kOfOneSide = kCornerOverToo;
constexpr double kCornerNearest = 0.02, kCornerFarthest = 0.98;

double slowest(const DriveContext& context) {
  return std::max(context.table.least_speed_rpm, 1e-3 * context.table.most_speed_rpm);
}

/// Speeds go by their logarithm, as where they are run mostly does.
double corner_share(const DriveContext& context, const BenchPoint& p, double over) {
  if (over != 1.0) return context.share_of_range(p, over);
  const double least = slowest(context);
  return std::log(std::max(p.speed_rpm, least) / least) /
         std::log(std::max(1.001, context.table.most_speed_rpm / least));
}

double corner_quantity(const DriveContext& context, double over, double share) {
  if (over == 0.0) return context.quantity_at_share(over, share) * context.model.ratio;
  if (over != 1.0) return context.quantity_at_share(over, share);
  const double least = slowest(context);
  return least * std::pow(context.table.most_speed_rpm / least, share);
}

/// 0 ... 1 on one of the two sides.
double on_side(const DriveContext& context, const BenchPoint& p, const DriveShape& s,
               std::size_t side) {
  const double over = s[kCornerOver + side], place = s[kCornerPlace + side],
               share = corner_share(context, p, over);
  const bool below = s[kCornerBelow + side] != 0.0;
  const double beyond = below ? place - share : share - place;
  if (!(beyond > 0.0)) return 0.0;
  if (s[kCornerGrows + side] == 0.0) return 1.0;
  const double least = over == 0.0 ? context.least_share(0.0) : 0.0;
  return std::min(1.0, beyond / std::max(below ? place - least : 1.0 - place, 1e-9));
}

bool is_run_at_levels(const DriveContext& context, double over) {
  constexpr int kFewestLevels = 4;
  return context.table.levels[static_cast<std::size_t>(over)] >= kFewestLevels &&
         (over != 2.0 || context.table.temperature_span_c > 3.0);
}

/// Places between which about as many rows lie.
std::vector<double> corner_places(const DriveContext& context, double over) {
  constexpr int kPlaces = 12;
  std::vector<double> shares, places;
  for (const BenchPoint& p : context.table.points) shares.push_back(corner_share(context, p, over));
  std::sort(shares.begin(), shares.end());
  for (int k = 1; k < kPlaces; ++k) {
    const auto at = static_cast<std::size_t>(k) * shares.size() / kPlaces;
    if (at == 0) continue;
    const double place = 0.5 * (shares[at - 1] + shares[at]);
    if (place > kCornerNearest && place < kCornerFarthest &&
        (places.empty() || place > places.back() + 0.01))
      places.push_back(place);
  }
  return places;
}

std::vector<DriveShape> corner_shapes(const DriveContext& context, bool reads) {
  constexpr std::size_t kManyRows = 800;
  std::vector<DriveShape> shapes;
  if (context.table.points.size() > kManyRows) return shapes;
  const double as_read = reads ? 1.0 : 0.0;
  for (const auto& [over, too] : {std::pair(0.0, 1.0), std::pair(0.0, 2.0), std::pair(1.0, 2.0)}) {
    if (!is_run_at_levels(context, over) || !is_run_at_levels(context, too)) continue;
    const std::vector<double> places = corner_places(context, over),
                              places_too = corner_places(context, too);
    for (const double place : places)
      for (const double place_too : places_too)
        for (const int sides : {0, 1, 2, 3})
          for (const int growing : {0, 1, 2, 3})
            shapes.push_back({over, place, double(sides & 1), double(growing & 1), too, place_too,
                              double(sides >> 1), double(growing >> 1), as_read});
  }
  return shapes;
}

std::string corner_unit(double over) {
  return over == 0.0 ? " N m at the output" : unit_of_quantity(over);
}

std::string corner_key(const DriveShape& s, std::size_t side) {
  const double over = s[kCornerOver + side];
  return std::string(s[kCornerBelow + side] != 0.0 ? "below_" : "above_") +
         (over == 0.0 ? "output_nm" : key_of_quantity(over));
}

std::string side_in_words(const DriveShape& s, std::size_t side, const Parameter& place) {
  return std::string(name_of_quantity(s[kCornerOver + side])) + " is " +
         (s[kCornerBelow + side] != 0.0 ? "below " : "above ") +
         with_interval(place, corner_unit(s[kCornerOver + side]));
}

std::vector<Parameter> corner_figures(const DriveContext& context, const DriveShape& s,
                                      double amount) {
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
  for (const std::size_t side : {std::size_t{0}, kOfOneSide})
    figures.push_back(figure_of(corner_key(s, side), corner_quantity(context, s[kCornerOver + side],
                                                                     s[kCornerPlace + side])));
  if (s[kCornerReads] != 0.0)
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  return figures;
}

std::string corner_told(const DriveContext& context, const DriveShape& s, double amount,
                        const std::vector<Parameter>& figures) {
  const bool reads = s[kCornerReads] != 0.0,
             both = context.table.has(true) && context.table.has(false);
  std::string grows;
  for (const std::size_t side : {std::size_t{0}, kOfOneSide})
    if (s[kCornerGrows + side] != 0.0)
      grows += std::string(grows.empty() ? ", growing evenly with the " : " and the ") +
               name_of_quantity(s[kCornerOver + side]);
  return std::string(reads ? "a reading of the output's torque" : "a loss at the input") +
         " that is there only where the " + side_in_words(s, 0, figures[1]) + " and the " +
         side_in_words(s, kOfOneSide, figures[2]) + grows + ": " +
         with_interval(reads ? figures.back() : figures.front(), " N m") +
         (amount > 0.0 ? " more" : " less") + (grows.empty() ? "" : " in the end") +
         (reads && both ? kNoLoss : "");
}

DriveFamily corner(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over",      "place",     "below",     "grows",      "over_too",
                   "place_too", "below_too", "grows_too", "as_it_reads"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  const DriveShapeValue place{
      .continuous = true, .is_place = true, .reach = 0.05, .limits = [](const DriveContext&) {
        return std::pair(kCornerNearest, kCornerFarthest);
      }};
  f.shape_values = {{}, place, {}, {}, {}, place, {}, {}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return corner_shapes(context, reads); };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kCornerOver] + s[kCornerOverToo]); };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin;
    for (const int growing : {0, 1, 2, 3}) {
      kin.push_back(s);
      kin.back()[kCornerGrows] = double(growing & 1);
      kin.back()[kCornerGrowsToo] = double(growing >> 1);
    }
    return kin;
  };
  f.is_odd = [](const DriveShape&) { return true; };  // one side does it as well? then that
  // Of either side a part of the rows lies inside and a part outside: else one quantity does it.
  f.shows = [](const DriveContext& context, const DriveShape& s) {
    constexpr double kLeastOutside = 0.15;
    constexpr int kFewestInside = 6;
    double out = 0.0, out_too = 0.0;
    int inside = 0;
    for (const BenchPoint& p : context.table.points) {
      const bool one = on_side(context, p, s, 0) > 0.0,
                 other = on_side(context, p, s, kOfOneSide) > 0.0;
      // (among the rows of the other side)
      out += !one && other ? 1.0 : 0.0;
      out_too += one && !other ? 1.0 : 0.0;
      inside += one && other ? 1 : 0;
    }
    return inside >= kFewestInside && out > kLeastOutside * (out + inside) &&
           out_too > kLeastOutside * (out_too + inside);
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const std::vector<double> steps = growing_steps(context, 0.004, 0.06);
    for (const double by : steps)
      for (const double by_too : steps) {
        shapes.push_back(*about);
        shapes.back()[kCornerPlace] =
            std::clamp(shapes.back()[kCornerPlace] + by, kCornerNearest, kCornerFarthest);
        shapes.back()[kCornerPlaceToo] =
            std::clamp(shapes.back()[kCornerPlaceToo] + by_too, kCornerNearest, kCornerFarthest);
      }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double size = on_side(context, p, s, 0);
    if (size > 0.0) size *= on_side(context, p, s, kOfOneSide);
    c[0] = size > 0.0
               ? size * changed_nm(context, p,
                                   s[kCornerReads] != 0.0 ? double(kOutputReads) : double(kDrag))
               : 0.0;
  };
  f.figures = corner_figures;
  f.told = corner_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("in a corner of the ") + name_of_quantity(s[kCornerOver]) + " and the " +
           name_of_quantity(s[kCornerOverToo]) + " alone";
  };
  if (reads)
    f.term_shapes = [](const DriveShape&) {
      return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 1.0}};
    };
  return f;
}

}  // namespace

DriveFamily unnamed_corner() { return corner(false); }
DriveFamily unnamed_reading_corner() { return corner(true); }

}  // namespace trueflank::loop::drive_effects
