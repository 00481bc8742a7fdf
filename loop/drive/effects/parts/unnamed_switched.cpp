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

// A loss, or a reading, that a recorded quantity turns on at one value and off at another one: a
// fan or a pump with a thermostat. Between the two it is as it was in the row before.
namespace trueflank::loop::drive_effects {

namespace {

/// The two values are 0 ... 1 from the least to the largest that was run.
enum SwitchedValue : std::size_t {
  kSwitchedOver,
  kSwitchedLower,
  kSwitchedUpper,
  kSwitchedOnBelow,  ///< it is on once it fell below the lower one
  kSwitchedStarts,   ///< it is on in rows between the two at the start of the run
  kSwitchedOf
};

/// Where it has risen above the upper value and not yet fallen below the lower one, of every row:
/// between some rows of a log it may have changed.
struct SwitchedRows {
  std::vector<char> high;
  int changes = 0;
  /// Between these the two values may be, and the rows stay as they are.
  double upper_from = -1e300, upper_to = 1e300, lower_from = -1e300, lower_to = 1e300;
};

SwitchedRows switched_rows(const DriveContext& context, const DriveShape& s) {
  SwitchedRows rows;
  bool high = (s[kSwitchedStarts] != 0.0) != (s[kSwitchedOnBelow] != 0.0);
  for (const double share : shares_of_every_row(context, s[kSwitchedOver])) {
    const bool before = high;
    if (high) {
      high = share >= s[kSwitchedLower];
      double& bound = high ? rows.lower_to : rows.lower_from;
      bound = high ? std::min(bound, share) : std::max(bound, share);
    } else {
      high = share > s[kSwitchedUpper];
      double& bound = high ? rows.upper_to : rows.upper_from;
      bound = high ? std::min(bound, share) : std::max(bound, share);
    }
    rows.changes += high != before && !rows.high.empty() ? 1 : 0;
    rows.high.push_back(high ? 1 : 0);
  }
  return rows;
}

bool is_switched_on(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const std::vector<char>& high =
      context.last_switched.of(s, [&] { return switched_rows(context, s).high; });
  const auto at = static_cast<std::size_t>(p.place);
  return at < high.size() && (high[at] != 0) == (s[kSwitchedOnBelow] == 0.0);
}

/// Half way between the rows that say where they may be; as they are where none does.
DriveShape in_the_middle(const DriveContext& context, DriveShape s) {
  const SwitchedRows rows = switched_rows(context, s);
  if (rows.upper_from > -1e300 && rows.upper_to < 1e300)
    s[kSwitchedUpper] = 0.5 * (rows.upper_from + rows.upper_to);
  if (rows.lower_from > -1e300 && rows.lower_to < 1e300)
    s[kSwitchedLower] = 0.5 * (rows.lower_from + rows.lower_to);
  return s;
}

std::vector<DriveShape> switched_shapes(const DriveContext& context, bool reads) {
  constexpr std::size_t kPlaces = 14;
  std::vector<DriveShape> shapes;
  if (!has_one_course(context)) return shapes;
  for (const double over : ranges_with_edges(context)) {
    const std::vector<double> places = edges_to_try(shares_of_rows(context, over), kPlaces);
    for (const double what : kinds_of(reads))
      for (std::size_t lower = 0; lower < places.size(); ++lower)
        for (std::size_t upper = lower + 1; upper < places.size(); ++upper)
          shapes.push_back({over, places[lower], places[upper], 0.0, 0.0, what});
  }
  return shapes;
}

/// Rows between the two values that are on and rows there that are off, and changes to and fro:
/// else it is a step, or a change in the run.
bool shows_switched(const DriveContext& context, const DriveShape& s) {
  constexpr int kFewestChanges = 3, kFewestBetween = 4;
  if (!(s[kSwitchedLower] < s[kSwitchedUpper])) return false;
  const SwitchedRows rows = switched_rows(context, s);
  const std::vector<double>& shares = shares_of_every_row(context, s[kSwitchedOver]);
  int high = 0, low = 0;
  for (std::size_t i = 0; i < rows.high.size(); ++i) {
    const double share = shares[i];
    if (share < s[kSwitchedLower] || share > s[kSwitchedUpper]) continue;
    (rows.high[i] != 0 ? high : low) += 1;
  }
  return rows.changes >= kFewestChanges && std::min(high, low) >= kFewestBetween;
}

/// Other values near by, half way between the rows that say where they may be; of this one also
/// nearly as far as they may go.
std::vector<DriveShape> switched_about(const DriveContext& context, const DriveShape& about) {
  constexpr std::ptrdiff_t kGaps = 24, kGapsOfBoth = 4;
  constexpr double kNearlyAtTheRow = 0.98;  // of the way there
  const std::vector<double> shares = shares_of_rows(context, about[kSwitchedOver]);
  std::vector<DriveShape> shapes{in_the_middle(context, about)};
  const auto add = [&](double lower, double upper) {
    if (!(lower < upper)) return;
    DriveShape shape = about;
    shape[kSwitchedLower] = lower;
    shape[kSwitchedUpper] = upper;
    shapes.push_back(in_the_middle(context, std::move(shape)));
  };
  for (const double lower : places_between(shares, about[kSwitchedLower], kGaps))
    add(lower, about[kSwitchedUpper]);
  for (const double upper : places_between(shares, about[kSwitchedUpper], kGaps))
    add(about[kSwitchedLower], upper);
  const auto uppers = places_between(shares, about[kSwitchedUpper], kGapsOfBoth);
  for (const double lower : places_between(shares, about[kSwitchedLower], kGapsOfBoth))
    for (const double upper : uppers) add(lower, upper);
  const std::size_t middles = shapes.size();
  for (std::size_t k = 0; k < middles; ++k) {
    const SwitchedRows rows = switched_rows(context, shapes[k]);
    const auto nearly_at = [&](SwitchedValue value, double bound) {
      if (std::abs(bound) >= 1e300) return;
      shapes.push_back(shapes[k]);
      shapes.back()[value] += kNearlyAtTheRow * (bound - shapes[k][value]);
    };
    nearly_at(kSwitchedUpper, rows.upper_from);
    nearly_at(kSwitchedUpper, rows.upper_to);
    nearly_at(kSwitchedLower, rows.lower_from);
    nearly_at(kSwitchedLower, rows.lower_to);
  }
  return shapes;
}

std::vector<Parameter> switched_figures(const DriveContext& context, const DriveShape& s,
                                        double amount) {
  const bool on_below = s[kSwitchedOnBelow] != 0.0;
  double on = 0.0;
  for (const BenchPoint& p : context.table.points) on += is_switched_on(context, p, s) ? 1.0 : 0.0;
  std::vector<Parameter> figures{
      figure_of("amplitude_nm", std::abs(amount)),
      figure_at_share(context, s[kSwitchedOver], on_below ? "off_above_" : "on_above_",
                      s[kSwitchedUpper]),
      figure_at_share(context, s[kSwitchedOver], on_below ? "on_below_" : "off_below_",
                      s[kSwitchedLower]),
      figure_of("rows_percent", 100.0 * on / static_cast<double>(context.table.points.size())),
      figure_of("changes", switched_rows(context, s).changes)};
  add_reading(context, s[kSwitchedOf], amount, figures);
  return figures;
}

std::string switched_told(const DriveContext& context, const DriveShape& s, double amount,
                          const std::vector<Parameter>& figures) {
  const std::string name = name_of_range(s[kSwitchedOver]),
                    rises = "when the " + name + " rises above " +
                            value_in_range(s[kSwitchedOver], figures[1]),
                    falls = "when it falls below " + value_in_range(s[kSwitchedOver], figures[2]);
  const bool on_below = s[kSwitchedOnBelow] != 0.0;
  return subject_of(s[kSwitchedOf]) + " that " +
         (on_below ? "goes off " + rises + " and comes on again "
                   : "comes on " + rises + " and goes off again ") +
         falls + ", and between the two is as it was: " + more_of(figures, s[kSwitchedOf], amount) +
         printed(" while it is on, in %.0f %% of the rows", figures[3].value) +
         same_sign(context, s[kSwitchedOf]) + " (a thermostat or a governor with hysteresis?)";
}

DriveFamily switched(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "lower", "upper", "on_below", "starts_on", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  const DriveShapeValue value{
      .continuous = true, .is_place = true, .reach = 0.02, .limits = [](const DriveContext&) {
        return std::pair(0.0, 1.0);
      }};
  f.shape_values = {{}, value, value, {}, {}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return switched_shapes(context, reads); };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin;
    for (const double on_below : {0.0, 1.0})
      for (const double starts : {0.0, 1.0}) {
        kin.push_back(s);
        kin.back()[kSwitchedOnBelow] = on_below;
        kin.back()[kSwitchedStarts] = starts;
      }
    return kin;
  };
  f.shows = shows_switched;
  // (of values that do the same those half way between the rows that say where they may be)
  f.was_run = [](const DriveContext& context, const DriveShape& s) {
    constexpr double kSame = 1e-9;
    const DriveShape middle = in_the_middle(context, s);
    return std::abs(middle[kSwitchedLower] - s[kSwitchedLower]) < kSame &&
           std::abs(middle[kSwitchedUpper] - s[kSwitchedUpper]) < kSame;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : switched_about(context, *about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = is_switched_on(context, p, s) ? changed_nm(context, p, s[kSwitchedOf]) : 0.0;
  };
  f.figures = switched_figures;
  f.told = switched_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that the ") + name_of_range(s[kSwitchedOver]) +
           " turns on and off, at two values";
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kSwitchedOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_switched() { return switched(false); }
DriveFamily unnamed_reading_switched() { return switched(true); }

}  // namespace trueflank::loop::drive_effects
