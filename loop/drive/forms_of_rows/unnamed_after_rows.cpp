// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// What came right before a row: the first rows of every dwell, taken before a brake has settled,
// and what rows at a slow speed or a high load leave behind for the rows after them.
namespace trueflank::loop::drive_effects {

namespace {

enum FirstRows : std::size_t { kFirstOf };

/// Of the speed itself, of the range of speeds, and of loads. (The load may hold the effect itself,
/// where it is read beside what is driven.)
constexpr double kSameSpeed = 0.01, kSameOfSpeeds = 0.0005, kSameLoad = 0.05;

/// True where a row was taken at the set point of the row before.
bool stays_at_set_point(const BenchTable& table, const BenchPoint& p) {
  const BenchPoint* before = table.row_before(p);
  return before != nullptr && before->forward == p.forward &&
         std::abs(before->speed_rpm - p.speed_rpm) <=
             kSameSpeed * p.speed_rpm +
                 kSameOfSpeeds * (table.most_speed_rpm - table.least_speed_rpm) &&
         std::abs(before->driving_nm - p.driving_nm) <=
             kSameLoad * (p.forward ? 1.0 : p.driving_nm / std::max(p.load_nm, 1e-300)) *
                 (table.most_load_nm - table.least_load_nm);
}

/// Several rows at most set points, and many of these.
bool has_dwells(const BenchTable& table) {
  constexpr double kFewestDwells = 10.0, kLeastFirst = 0.08, kMostFirst = 0.55;
  double first = 0.0;
  for (const BenchPoint& p : table.points) first += stays_at_set_point(table, p) ? 0.0 : 1.0;
  const double share = first / static_cast<double>(table.points.size());
  return first >= kFewestDwells && share > kLeastFirst && share < kMostFirst;
}

DriveFamily first_rows() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (has_dwells(context.table))
      for (const double what : {double(kDrag), double(kFlanks)}) shapes.push_back({what});
    return shapes;
  };
  f.follows_rows_before = true;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = stays_at_set_point(context.table, p) ? 0.0 : changed_nm(context, p, s[kFirstOf]);
  };
  f.figures = [](const DriveContext&, const DriveShape&, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    std::string lines;
    int told = 0;
    for (const BenchPoint& p : context.table.points)
      if (told < 3 && !stays_at_set_point(context.table, p)) {
        lines += (told > 0 ? ", " : "") + std::to_string(p.line);
        ++told;
      }
    return "a loss at the input in the first row at every new set point (lines " + lines +
           ", ...): " + more_of(figures, s[kFirstOf], amount) +
           " than in the rows after it (rows taken before the brake or the oil has settled: "
           "wait longer, or leave them out)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("in the first row at every new set point");
  };
  return f;
}

enum LeftBehind : std::size_t {
  kLeftOver,  ///< the speed or the load that drives
  kLeftPlace,
  kLeftAbove,  ///< rows above the place bring it, not those below
  kLeftRows,   ///< in which it dies away to exp(-1)
  kLeftOf
};

double left_quantity(const BenchPoint& p, double over) {
  return over == 1.0 ? p.speed_rpm : p.load_nm;
}

/// Rows since the last one that brings it, of every row: 0 in such a row, -1 where there was none.
std::vector<int> rows_since(const BenchTable& table, double over, double place, bool above) {
  const auto& rows = table.every_row();
  std::vector<int> since(rows.size(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int before = rows[i].before;
    if ((left_quantity(rows[i], over) > place) == above)
      since[i] = 0;
    else if (before >= 0 && since[static_cast<std::size_t>(before)] >= 0)
      since[i] = since[static_cast<std::size_t>(before)] + 1;
  }
  return since;
}

/// What is left after so many rows, down to little.
std::vector<double> left_after_rows(double rows) {
  constexpr double kLeast = 0.01;
  const double each = std::exp(-1.0 / rows);
  std::vector<double> left;
  for (double now = 1.0; now > kLeast; now *= each) left.push_back(now);
  return left;
}

/// What is left of the last row that brought it, 1 in such a row.
double left_of_rows_before(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const std::vector<int>& all = context.last_rows_since.of({s.data(), kLeftRows}, [&] {
    return rows_since(context.table, s[kLeftOver], s[kLeftPlace], s[kLeftAbove] != 0.0);
  });
  const auto at = static_cast<std::size_t>(p.place);
  if (at >= all.size() || all[at] < 0) return 0.0;
  const std::vector<double>& left = context.last_powers.of(
      {s.data() + kLeftRows, 1}, [&] { return left_after_rows(s[kLeftRows]); });
  const auto since = static_cast<std::size_t>(all[at]);
  return since < left.size() ? left[since] : 0.0;
}

/// Places half-way between neighbouring values of the rows, about so many, or all next to a place.
std::vector<double> left_places(const DriveContext& context, double over, const double* about) {
  constexpr std::size_t kPlaces = 12, kAbout = 10;
  std::vector<double> values, places;
  for (const BenchPoint& p : context.table.points) values.push_back(left_quantity(p, over));
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  const auto add = [&](std::size_t k) {
    if (k > 0 && k < n && values[k] > values[k - 1])
      places.push_back(0.5 * (values[k - 1] + values[k]));
  };
  if (about == nullptr) {
    for (std::size_t k = 1; k < kPlaces; ++k) add(k * n / kPlaces);
    return places;
  }
  const auto at = static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), *about) -
                                           values.begin()),
             each = std::max<std::size_t>(1, n / (kPlaces * kAbout));
  for (std::size_t k = 0; k <= 2 * kAbout; ++k)
    for (const std::size_t by : {std::size_t{1}, each})
      if (at + k * by >= kAbout * by) add(at + k * by - kAbout * by);
  return places;
}

DriveFamily left_behind() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place", "above", "rows", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  f.shape_values = {
      {},
      {.continuous = true},
      {},
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(1.5, 60.0); }},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    constexpr std::size_t kFewestRows = 100;
    std::vector<DriveShape> shapes;
    if (!has_one_course(context) || context.table.points.size() < kFewestRows) return shapes;
    for (const double over : {1.0, 0.0})
      for (const double place : left_places(context, over, nullptr))
        for (const double rows : {2.5, 5.0, 10.0, 20.0})
          for (const double above : {0.0, 1.0})
            shapes.push_back({over, place, above, rows, double(kDrag)});
    return shapes;
  };
  f.follows_rows_before = true;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double place : left_places(context, (*about)[kLeftOver], &(*about)[kLeftPlace]))
      for (const double longer : growing_steps(context, 0.02, 0.7)) {
        shapes.push_back(*about);
        shapes.back()[kLeftPlace] = place;
        shapes.back()[kLeftRows] *= std::exp(longer);
      }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double left = left_of_rows_before(context, p, s);
    c[0] = left == 0.0 ? 0.0 : left * changed_nm(context, p, s[kLeftOf]);
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    return std::vector<Parameter>{figure_of("amplitude_nm", std::abs(amount)),
                                  figure_of("at_" + key_of_quantity(s[kLeftOver]), s[kLeftPlace]),
                                  figure_of("dies_within_rows", s[kLeftRows])};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return std::string("a loss at the input that rows ") +
           (s[kLeftAbove] != 0.0 ? "above a " : "below a ") + name_of_quantity(s[kLeftOver]) +
           " of " + with_interval(figures[1], unit_of_quantity(s[kLeftOver])) +
           " bring, and leave behind: " + with_interval(figures[0], " N m") +
           (amount > 0.0 ? " more" : " less") +
           " in them, dying away over the rows after them, to a third within " +
           with_interval(figures[2], " rows") +
           " (grease or oil that flows back, warmth that stays?)";
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that rows at a ") + (s[kLeftAbove] != 0.0 ? "high " : "low ") +
           name_of_quantity(s[kLeftOver]) + " bring and leave behind";
  };
  return f;
}

}  // namespace

DriveFamily unnamed_first_rows() { return first_rows(); }
DriveFamily unnamed_left_behind() { return left_behind(); }

}  // namespace trueflank::loop::drive_effects
