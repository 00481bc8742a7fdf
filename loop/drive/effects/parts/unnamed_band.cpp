// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss, or a reading, between two speeds, loads or temperatures alone, with sharp edges, or
// everywhere but there: a lock-up clutch, a pump or a fan that a controller turns on.
namespace trueflank::loop::drive_effects {

namespace {

/// The edges are 0 ... 1 from the least to the largest that was run.
enum BandValue : std::size_t { kBandOver, kBandFrom, kBandTo, kBandOutside, kBandOf };

bool is_in_band(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const double share = share_in_range(context, p, s[kBandOver]);
  return (share > s[kBandFrom] && share <= s[kBandTo]) == (s[kBandOutside] == 0.0);
}

std::vector<DriveShape> band_shapes(const DriveContext& context, bool reads) {
  constexpr std::size_t kPlaces = 20;
  std::vector<DriveShape> shapes;
  for (const double over : ranges_with_edges(context)) {
    const std::vector<double> places = edges_to_try(shares_of_rows(context, over), kPlaces);
    for (const double what : kinds_of(reads))
      for (std::size_t from = 0; from < places.size(); ++from)
        for (std::size_t to = from + 1; to < places.size(); ++to)
          shapes.push_back({over, places[from], places[to], 0.0, what});
  }
  return shapes;
}

/// Rows below, in and above it, of which none may be few: else it is a step.
bool shows_band(const DriveContext& context, const DriveShape& s) {
  constexpr double kFewest = 6.0, kLeastOfRows = 0.04;
  double below = 0.0, inside = 0.0, above = 0.0;
  for (const BenchPoint& p : context.table.points) {
    const double share = share_in_range(context, p, s[kBandOver]);
    (share <= s[kBandFrom] ? below : share <= s[kBandTo] ? inside : above) += 1.0;
  }
  return std::min({below, inside, above}) >=
         std::max(kFewest, kLeastOfRows * (below + inside + above));
}

/// Edges between other rows near by, and on either side of the gaps in which they lie: their
/// intervals reach from row to row.
std::vector<DriveShape> bands_about(const DriveContext& context, const DriveShape& about) {
  constexpr std::ptrdiff_t kGaps = 9;
  const std::vector<double> shares = shares_of_rows(context, about[kBandOver]);
  const std::vector<double> froms = places_between(shares, about[kBandFrom], kGaps),
                            tos = places_between(shares, about[kBandTo], kGaps);
  std::vector<DriveShape> shapes;
  const auto add = [&](double from, double to) {
    if (!(from < to)) return;
    shapes.push_back(about);
    shapes.back()[kBandFrom] = from;
    shapes.back()[kBandTo] = to;
  };
  for (const double from : froms)
    for (const double to : tos) add(from, to);
  for (const double middle : froms)
    for (const double from : ends_of_gap(shares, middle)) add(from, about[kBandTo]);
  for (const double middle : tos)
    for (const double to : ends_of_gap(shares, middle)) add(about[kBandFrom], to);
  return shapes;
}

std::string band_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const bool outside = s[kBandOutside] != 0.0;
  return subject_of(s[kBandOf]) + " that is there only at " + name_of_range(s[kBandOver]) + "s " +
         (outside ? "below " : "between ") + value_in_range(s[kBandOver], figures[1]) +
         (outside ? " and above " : " and ") + value_in_range(s[kBandOver], figures[2]) + ": " +
         more_of(figures, s[kBandOf], amount) + ", and nothing " +
         (outside ? "between" : "below and above") + same_sign(context, s[kBandOf]);
}

DriveFamily band(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "from", "to", "outside", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  const DriveShapeValue edge{
      .continuous = true, .is_place = true, .reach = 0.02, .limits = [](const DriveContext&) {
        return std::pair(0.0, 1.0);
      }};
  f.shape_values = {{}, edge, edge, {}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return band_shapes(context, reads); };
  f.kin_shapes = [](const DriveShape& s) {
    DriveShape outside = s;
    outside[kBandOutside] = 1.0;
    return std::vector<DriveShape>{s, outside};
  };
  f.is_odd = [](const DriveShape& s) { return s[kBandOutside] != 0.0; };
  f.shows = shows_band;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : bands_about(context, *about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = is_in_band(context, p, s) ? changed_nm(context, p, s[kBandOf]) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const bool outside = s[kBandOutside] != 0.0;
    std::vector<Parameter> figures{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_at_share(context, s[kBandOver], outside ? "below_" : "from_", s[kBandFrom]),
        figure_at_share(context, s[kBandOver], outside ? "above_" : "up_to_", s[kBandTo])};
    add_reading(context, s[kBandOf], amount, figures);
    return figures;
  };
  f.told = band_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string(s[kBandOutside] != 0.0 ? "outside" : "in") + " a band of the " +
           name_of_range(s[kBandOver]) + " alone";
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kBandOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_band() { return band(false); }
DriveFamily unnamed_reading_band() { return band(true); }

}  // namespace trueflank::loop::drive_effects
