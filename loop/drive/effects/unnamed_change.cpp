// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/legendre.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A jump in the course of the run: an oil, a seal or a sensor's zero that was changed. A spell of
// the run, or a part of every turn of a shaft: a door that stood open, a chip in a ring. Who
// changed what is not in the data, so it has no name; that it changes, and where, is.
namespace trueflank::loop::drive_effects {

namespace {

BenchPoint at_largest_load(const DriveContext& context, const BenchPoint& p) {
  BenchPoint most = p;
  most.load_nm = context.table.most_load_nm;
  most.driving_nm = p.forward ? most.load_nm : most.load_nm * context.model.ratio;
  return most;
}

/// Change of the driven torque for 1 N m of loss at the input, which the flanks lose at the largest
/// load.
double of_flanks(const DriveContext& context, const BenchPoint& p) {
  return context.row_flank_changes.of(context.table.points, p, [&] {
    const BenchPoint most = at_largest_load(context, p);
    const double slope = context.friction_slope(most);
    return slope != 0.0 ? -context.lever(most) * context.friction_slope(p) / slope : 0.0;
  });
}

/// The first row after the jump.
const BenchPoint* row_after(const BenchTable& table, double place) {
  const auto at = std::find_if(table.points.begin(), table.points.end(),
                               [&](const BenchPoint& p) { return 2.0 * p.taken - 1.0 > place; });
  return at == table.points.end() ? nullptr : &*at;
}

/// Of the lines from the first row to the last in a part of the run; empty: no row lies there.
std::string lines_between(const BenchTable& table, double begin, double end) {
  int first = 0, last = 0;
  for (const BenchPoint& p : table.points)
    if (p.taken >= begin && p.taken <= end) {
      if (first == 0) first = p.line;
      last = p.line;
    }
  return first == 0 ? "" : ", lines " + std::to_string(first) + " to " + std::to_string(last);
}

constexpr int kDriftDegrees = 3;  ///< of the load
constexpr double kMostOfJump = 0.95;

std::string of_what(double number) {
  const auto what = static_cast<What>(static_cast<int>(number));
  return what == kFlanks ? ", by the friction of the flanks (an oil that was changed?)"
         : what == kDrag ? ", by the same torque at every load (a seal or grease that was changed?)"
         : what == kOutputReads ? ", as a zero of the output's torque that was moved"
                                : ", as a gain of the output's torque that was switched";
}

}  // namespace

std::string turn_in_words(const DriveModel& model, double order) {
  std::string member;
  for (const MemberOrder& one : model.orders)
    if (std::abs(one.order - order) < 1e-6 * std::max(1.0, order)) member = one.member;
  return order == 1.0
             ? "of the input"
             : "of order " + short_text(order) + (member.empty() ? "" : " (" + member + ")");
}

double nm_of_coefficient(const DriveContext& context) {
  const BenchPoint most = at_largest_load(context, context.table.points.front());
  return std::abs(context.friction_slope(most) / context.lever(most));
}

double changed_nm(const DriveContext& context, const BenchPoint& p, double number) {
  const auto what = static_cast<What>(static_cast<int>(number));
  return what == kFlanks ? of_flanks(context, p)
         : what == kDrag ? -context.lever(p)
                         : context.model.ratio * context.misread(p, false) *
                               (what == kOutputGain ? true_share(context, p) : 1.0);
}

double place_of_spell(const BenchPoint& p, double order) {
  if (order == 0.0) return p.taken;
  const double turns = order * p.angle_rad / kTwoPi;
  return turns - std::floor(turns);
}

bool has_one_course(const DriveContext& context) {
  const auto& points = context.table.points;
  return !where_rows_follow_each_other(context).empty() &&
         std::all_of(points.begin(), points.end(),
                     [&](const BenchPoint& p) { return p.file == points.front().file; });
}

DriveFamily unnamed_spell() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "order", "begin", "length"};
  f.preference = 8;
  // Its places are too many to try: a scan of what is left proposes them.
  f.shapes = no_shapes;
  f.changes_in_run = [](const DriveShape& s) { return s[1] == 0.0 ? 2.0 : 0.0; };
  f.shape_of_spell = [](double what, double order, double begin, double length) {
    return DriveShape{what, order, begin, length};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    double after = place_of_spell(p, s[1]) - s[2];
    if (s[1] != 0.0) after -= std::floor(after);
    c[0] = after >= 0.0 && after <= s[3] ? changed_nm(context, p, s[0]) : 0.0;
  };
  f.stands_alone = true;
  f.turns_per_turn = [](const DriveShape& s) { return s[1]; };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr || (*about)[1] == 0.0) return shapes;
    const std::vector<double> steps = growing_steps(context, 0.0007, 0.05);
    for (const double begin : steps)
      for (const double end : steps)
        if (const double length = (*about)[3] - begin + end; length > 0.0 && length < 1.0)
          shapes.push_back({(*about)[0], (*about)[1], (*about)[2] + begin, length});
    return shapes;
  };
  f.figures = [](const DriveContext&, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
    if (s[1] == 0.0) return figures;
    figures.push_back(figure_of("order", s[1]));
    figures.push_back(figure_of("from_deg", 360.0 * s[2]));
    figures.push_back(figure_of("width_deg", 360.0 * s[3]));
    return figures;
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const std::string size = with_interval(figures[0], " N m") + (amount > 0.0 ? " more" : " less");
    if (s[1] == 0.0)
      return "a loss at the input over a part of the run" +
             lines_between(context.table, s[2], s[2] + s[3]) + of_what(s[0]) + ": " + size;
    return "a loss over a part of every turn " + turn_in_words(context.model, s[1]) + ": " + size +
           ", from " + with_interval(figures[2], " degrees") + " on, for " +
           with_interval(figures[3], " degrees") + " (a chip, a damaged tooth, a tight place?)";
  };
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext* context) {
    if (s[1] != 0.0)
      return "over a part of every turn " + turn_in_words(model, s[1]) +
             printed(
                 ": from %.0f degrees on, for %.0f degrees (a chip, a damaged tooth, a tight "
                 "place?)",
                 360.0 * (s[2] - std::floor(s[2])), 360.0 * s[3]);
    return "over a part of the run" +
           (context ? lines_between(context->table, s[2], s[2] + s[3]) : std::string()) +
           of_what(s[0]);
  };
  return f;
}

namespace {

constexpr std::size_t kJumpOf = 0, kJumpAt = 1;

/// Half way between rows that follow each other, at most so many about a place (or, of many rows,
/// so many over the run).
std::vector<double> places_between_rows(const DriveContext& context, const DriveShape* about) {
  constexpr std::size_t kAbout = 12, kOverTheRun = 150;
  const auto& points = context.table.points;
  std::vector<double> places;
  for (std::size_t i = 1; i < points.size(); ++i)
    places.push_back(points[i - 1].taken + points[i].taken - 1.0);
  std::erase_if(places, [](double at) { return std::abs(at) > kMostOfJump; });
  std::sort(places.begin(), places.end());
  if (about != nullptr) {
    const auto at = std::lower_bound(places.begin(), places.end(), (*about)[kJumpAt]);
    const auto before = static_cast<std::size_t>(at - places.begin());
    const std::size_t from = before > kAbout ? before - kAbout : 0,
                      to = std::min(places.size(), before + kAbout);
    return {places.begin() + static_cast<std::ptrdiff_t>(from),
            places.begin() + static_cast<std::ptrdiff_t>(to)};
  }
  std::vector<double> some;
  const std::size_t each = 1 + places.size() / kOverTheRun;
  for (std::size_t k = 0; k < places.size(); k += each) some.push_back(places[k]);
  return some;
}

std::vector<Parameter> jump_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  const BenchPoint* row = row_after(context.table, s[kJumpAt]);
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                 figure_of("at_line", row ? row->line : 0)};
  if (s[kJumpOf] == double(kOutputReads))
    figures.push_back(figure_of("reads_more_nm", amount * context.model.ratio));
  if (s[kJumpOf] == double(kOutputGain))
    figures.push_back(
        figure_of("gain_changes_percent", 100.0 * amount / context.table.most_load_nm));
  return figures;
}

std::string jump_told(const DriveContext&, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const std::string at =
      " that jumps in the course of the run at line " + printed("%.0f", figures[1].value);
  if (s[kJumpOf] == double(kOutputReads))
    return "a zero of the output's torque" + at + ": it " + reads_in_words(figures[2]) +
           " from there on (a zero that was moved?)";
  if (s[kJumpOf] == double(kOutputGain))
    return "a gain of the output's torque" + at + ": it reads " + percent_in_words(figures[2]) +
           " from there on, in proportion to the load (an amplifier's range, a lever that was "
           "changed?)";
  return "a loss at the input" + at + of_what(s[kJumpOf]) + ": " +
         with_interval(figures[0], " N m") + (amount > 0.0 ? " more" : " less") +
         (s[kJumpOf] == double(kFlanks) ? " at the largest load" : "") + " from there on";
}

/// A loss that jumps, or what the output reads.
DriveFamily jump(bool reading) {
  DriveFamily f = reading ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "place"};
  f.stands_alone = true;
  f.jumps_in_run = true;
  f.changes_in_run = [](const DriveShape&) { return 1.0; };
  f.preference = 6;
  f.shape_values = {{}, {.continuous = true, .is_place = true, .limits = [](const DriveContext&) {
                           return std::pair(-kMostOfJump, kMostOfJump);
                         }}};
  const std::vector<double> kinds = reading ? std::vector{double(kOutputReads), double(kOutputGain)}
                                            : std::vector{double(kFlanks), double(kDrag)};
  f.shapes = [kinds, reading](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    const bool both = context.table.has(true) && context.table.has(false);
    if (!has_one_course(context)) return shapes;
    for (const double what : kinds) {
      if (reading && what == double(kOutputGain) && !both) continue;
      for (const double place : {-0.75, -0.5, -0.25, 0.05, 0.25, 0.5, 0.75})
        shapes.push_back({what, place});
    }
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kJumpOf]); };
  f.all_shapes = [kinds](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    for (const double place : places_between_rows(context, about))
      for (const double what : kinds)
        if (about == nullptr || what == (*about)[kJumpOf]) shapes.push_back({what, place});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    c[0] = 2.0 * p.taken - 1.0 > shape[kJumpAt] ? changed_nm(context, p, shape[kJumpOf]) : 0.0;
  };
  f.figures = jump_figures;
  f.told = jump_told;
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext* context) {
    std::string text = "that jumps in the course of the run";
    if (const BenchPoint* row = context ? row_after(context->table, shape[kJumpAt]) : nullptr)
      text += " at line " + std::to_string(row->line);
    return text + of_what(shape[kJumpOf]);
  };
  if (reading) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kJumpOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_change() { return jump(false); }
DriveFamily unnamed_reading_change() { return jump(true); }

/// A gain that changes evenly over the run.
DriveFamily unnamed_gain_drift() {
  DriveFamily f = reading_without_a_name();
  f.shapes = [](const DriveContext& context) {
    return has_one_course(context) && context.table.levels[0] >= kDriftDegrees &&
                   context.table.has(true) && context.table.has(false)
               ? where_rows_follow_each_other(context)
               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = p.taken * changed_nm(context, p, double(kOutputGain));
  };
  f.figures = [](const DriveContext& context, const DriveShape&, double amount) {
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("gain_changes_percent", 100.0 * amount / context.table.most_load_nm)};
  };
  f.told = [](const DriveContext&, const DriveShape&, double,
              const std::vector<Parameter>& figures) {
    return "a gain of the output's torque that drifts over the run: at its end it reads " +
           percent_in_words(figures[1]) +
           ", in proportion to the load, if it was right at its start (an amplifier that warms "
           "up, a lever that creeps?)";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a gain of the output's torque that drifts over the run");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

DriveFamily unnamed_drift() {
  DriveFamily f = without_a_name();
  f.parameters = {"degree_0", "degree_1", "degree_2"};
  f.preference = 8;
  f.differs_by_direction = true;
  // (of both directions the zero's drift and the gain's are asked one by one: together with these it
  // would be the same twice)
  f.shapes = [](const DriveContext& context) {
    const bool both = context.table.has(true) && context.table.has(false);
    return has_one_course(context) && context.table.levels[0] >= kDriftDegrees && !both
               ? std::vector<DriveShape>{{}}
               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    const double drifted = p.taken * changed_nm(context, p, kOutputReads);
    for (int k = 0; k < kDriftDegrees; ++k) c[k] = drifted * legendre(k, context.load_coordinate(p));
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that grows in the course of the run, as the output's torque that drifts otherwise at "
                       "every load (a gain that drifts, a lever that creeps?)");
  };
  f.term_shapes = [](const DriveShape&) {
    std::vector<DriveShape> terms;
    for (int k = 0; k < kDriftDegrees; ++k) terms.push_back({double(k), 0.0, 0.0, 0.0, 0.0});
    return terms;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
