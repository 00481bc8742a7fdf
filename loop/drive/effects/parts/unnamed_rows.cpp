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

// What counts rows: rows that are read by turns (two transducers, two hands on a lever), a block of
// rows in the run (a coupling that slipped, a preload that was set aside for a while), and a
// sawtooth over the rows (a controller that switches).
namespace trueflank::loop::drive_effects {

namespace {

enum TurnOfRows : std::size_t {
  kRowsEvery,  ///< rows after which it comes again
  kRowsFirst,  ///< of these the first that is moved, from 0 on
  kRowsCount,  ///< how many follow each other
  kRowsOf,     ///< What
  kRowsBased   ///< nothing in the others, or as much in sum over all rows
};

bool is_in_turn(const BenchPoint& p, const DriveShape& s) {
  const int every = static_cast<int>(s[kRowsEvery]), first = static_cast<int>(s[kRowsFirst]);
  return (p.row + every - first) % every < static_cast<int>(s[kRowsCount]);
}

std::vector<DriveShape> turn_shapes(const DriveContext& context, bool reads) {
  std::vector<DriveShape> shapes;
  if (!has_one_course(context)) return shapes;
  struct Turn {
    int every, first, count;
  };
  std::vector<Turn> turns{{2, 0, 1}, {4, 0, 2}, {4, 1, 2}};
  for (const int every : {3, 4})
    for (int first = 0; first < every; ++first) turns.push_back({every, first, 1});
  for (const double what : kinds_of(reads))
    for (const Turn& turn : turns)
      shapes.push_back({double(turn.every), double(turn.first), double(turn.count), what, 0.0});
  return shapes;
}

std::string turns_told(const DriveContext& context, const DriveShape& s, double amount,
                       const std::vector<Parameter>& figures) {
  const auto& points = context.table.points;
  const auto first = std::find_if(points.begin(), points.end(), [&](const BenchPoint& p) {
    BenchPoint before = p;
    before.row += static_cast<int>(s[kRowsEvery]) - 1;
    return is_in_turn(p, s) && !is_in_turn(before, s);
  });
  const int every = static_cast<int>(s[kRowsEvery]), count = static_cast<int>(s[kRowsCount]);
  const std::string which = count == 2   ? "two rows of every four"
                            : every == 2 ? "every second row"
                            : every == 3 ? "every third row"
                                         : "every fourth row";
  return subject_of(s[kRowsOf]) + " that goes by turns of the rows: " + which + ", from line " +
         std::to_string((first == points.end() ? points.front() : *first).line) + " on, has " +
         more_of(figures, s[kRowsOf], amount, " than the rows between") +
         (s[kRowsBased] != 0.0 ? ", which have nothing of it" : "") +
         same_sign(context, s[kRowsOf]) +
         " (two transducers, or two ways of setting a load, by turns?)";
}

DriveFamily rows_by_turns(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"every", "first", "count", "what", "based"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return turn_shapes(context, reads); };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kRowsEvery]); };
  f.kin_shapes = [](const DriveShape& s) {
    // (what is based on nothing stands for a loss of its own everywhere: every second row is so
    // from either end)
    std::vector<DriveShape> kin{s, s};
    kin.back()[kRowsBased] = 1.0;
    if (s[kRowsEvery] != 2.0 * s[kRowsCount]) return kin;
    kin.push_back(kin.back());
    kin.back()[kRowsFirst] = std::fmod(s[kRowsFirst] + s[kRowsCount], s[kRowsEvery]);
    return kin;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double share = s[kRowsBased] != 0.0 ? 0.0 : s[kRowsCount] / s[kRowsEvery];
    c[0] = ((is_in_turn(p, s) ? 1.0 : 0.0) - share) * changed_nm(context, p, s[kRowsOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("comes_again_after_rows", s[kRowsEvery]),
                                   figure_of("rows_of_these", s[kRowsCount])};
    add_reading(context, s[kRowsOf], amount, figures);
    return figures;
  };
  f.told = turns_told;
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("that goes by turns of the rows");
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kRowsOf]); };
  return f;
}

enum BlockValue : std::size_t { kBlockFrom, kBlockTo, kBlockOf };  // places: 0 ... 1 of the run

/// Half way between rows that follow each other.
std::vector<double> edges_of_rows(const DriveContext& context) {
  std::vector<double> taken, edges;
  for (const BenchPoint& p : context.table.points) taken.push_back(p.taken);
  std::sort(taken.begin(), taken.end());
  for (std::size_t i = 1; i < taken.size(); ++i) edges.push_back(0.5 * (taken[i - 1] + taken[i]));
  return edges;
}

constexpr std::size_t kFewestOfBlock = 5, kFewestAtAnEnd = 3;
constexpr double kLongestBlock = 0.7;  // of the run

bool can_be_a_block(std::size_t from, std::size_t to, std::size_t edges) {
  return from + kFewestOfBlock <= to && from + 1 >= kFewestAtAnEnd &&
         to + kFewestAtAnEnd <= edges &&
         static_cast<double>(to - from) < kLongestBlock * static_cast<double>(edges + 1);
}

std::vector<DriveShape> block_shapes(const DriveContext& context, bool reads) {
  constexpr std::size_t kPlaces = 60, kManyRows = 600;
  std::vector<DriveShape> shapes;
  if (!has_one_course(context)) return shapes;
  const std::vector<double> edges = edges_of_rows(context);
  const std::size_t places = edges.size() > kManyRows ? kPlaces / 2 : kPlaces,
                    each = std::max<std::size_t>(1, edges.size() / places);
  for (std::size_t from = 0; from < edges.size(); from += each)
    for (std::size_t to = from + each; to < edges.size(); to += each)
      if (can_be_a_block(from, to, edges.size()))
        for (const double what : kinds_of(reads)) shapes.push_back({edges[from], edges[to], what});
  return shapes;
}

/// The first row after a place of the run, and the last one before.
int line_after(const BenchTable& table, double place) {
  for (const BenchPoint& p : table.points)
    if (p.taken > place) return p.line;
  return table.points.back().line;
}
int line_before(const BenchTable& table, double place) {
  int line = table.points.front().line;
  for (const BenchPoint& p : table.points)
    if (p.taken <= place) line = p.line;
  return line;
}

DriveFamily block(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"from", "to", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  f.changes_in_run = [](const DriveShape&) { return 2.0; };
  const DriveShapeValue edge{
      .continuous = true, .is_place = true, .reach = 0.02, .limits = [](const DriveContext&) {
        return std::pair(0.0, 1.0);
      }};
  f.shape_values = {edge, edge, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return block_shapes(context, reads); };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kBlockOf]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    constexpr std::size_t kLeastAbout = 12, kPartAbout = 50;
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const std::vector<double> edges = edges_of_rows(context);
    const std::size_t far = std::max(kLeastAbout, edges.size() / kPartAbout);
    const auto near = [&](double place) {
      const auto at = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), place) -
                                               edges.begin());
      return std::pair(at > far ? at - far : 0, std::min(edges.size(), at + far + 1));
    };
    const auto [least_from, most_from] = near((*about)[kBlockFrom]);
    const auto [least_to, most_to] = near((*about)[kBlockTo]);
    for (std::size_t from = least_from; from < most_from; ++from)
      for (std::size_t to = least_to; to < most_to; ++to)
        if (can_be_a_block(from, to, edges.size()))
          shapes.push_back({edges[from], edges[to], (*about)[kBlockOf]});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = p.taken > s[kBlockFrom] && p.taken <= s[kBlockTo] ? changed_nm(context, p, s[kBlockOf])
                                                             : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("from_line", line_after(context.table, s[kBlockFrom])),
                                   figure_of("to_line", line_before(context.table, s[kBlockTo]))};
    add_reading(context, s[kBlockOf], amount, figures);
    return figures;
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    return subject_of(s[kBlockOf]) + " over a block of the run, from " +
           with_interval(figures[1], "").insert(0, "line ") + " to " +
           with_interval(figures[2], "").insert(0, "line ") + ": " +
           more_of(figures, s[kBlockOf], amount, " than before and after") +
           same_sign(context, s[kBlockOf]) +
           " (something that slipped, or was changed and changed back?)";
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext* context) {
    return "over a block of the run" +
           (context ? ", from line " + std::to_string(line_after(context->table, s[kBlockFrom])) +
                          " to line " + std::to_string(line_before(context->table, s[kBlockTo]))
                    : std::string());
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kBlockOf]); };
  return f;
}

enum SawOfRows : std::size_t {
  kRowSawEvery,  ///< rows after which it jumps again
  kRowSawFirst,  ///< the row before which it jumps, from 0 on, not whole
  kRowSawOf,     ///< What
  kRowSawFrom
};
/// As much above as below its middle, from nothing on, or back to nothing.
enum FromOfSaw { kSawAboutMiddle, kSawFromNothing, kSawToNothing };

/// 0 in the first row after a jump ... 1 in the last one before the next.
double place_in_row_saw(double row, const DriveShape& s) {
  constexpr double kRounding = 1e-9;
  const double cycles = (row - s[kRowSawFirst]) / s[kRowSawEvery],
               part = cycles - std::floor(cycles + kRounding);
  return std::clamp(part * s[kRowSawEvery] / (s[kRowSawEvery] - 1.0), 0.0, 1.0);
}

std::vector<DriveShape> row_saw_shapes(const DriveContext& context, bool reads) {
  constexpr double kShortest = 8.0, kFewestTimes = 2.5, kStep = 0.35, kMostPlaces = 20.0;
  constexpr std::size_t kMostRowsOfSaw = 800;
  std::vector<DriveShape> shapes;
  if (!has_one_course(context) || context.table.points.size() > kMostRowsOfSaw) return shapes;
  const double rows = 1.0 + context.table.points.back().row;
  for (double times = kFewestTimes; times < rows / kShortest; times += kStep) {
    const double every = rows / times, places = std::min(kMostPlaces, std::ceil(every));
    for (double place = 0.0; place < places; place += 1.0)
      for (const double what : kinds_of(reads))
        shapes.push_back({every, place * every / places, what, double(kSawAboutMiddle)});
  }
  return shapes;
}

/// Line of the first row after a jump.
int line_of_first_jump(const DriveContext& context, const DriveShape& s) {
  const auto& points = context.table.points;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (std::floor((points[i].row - s[kRowSawFirst]) / s[kRowSawEvery] + 1e-9) >
        std::floor((points[i - 1].row - s[kRowSawFirst]) / s[kRowSawEvery] + 1e-9))
      return points[i].line;
  return points.back().line;
}

std::string row_saw_told(const DriveContext& context, const DriveShape& s, double amount,
                         const std::vector<Parameter>& figures) {
  const bool reads = s[kRowSawOf] == double(kOutputReads) || s[kRowSawOf] == double(kOutputGain);
  const double from = s[kRowSawFrom];
  return subject_of(s[kRowSawOf]) + " in a sawtooth over the rows of the run: it " +
         (amount > 0.0 ? "rises" : "falls") + " evenly by " +
         with_interval(reads ? figures.back() : figures.front(), " N m") +
         (is_beside_the_load(s[kRowSawOf]) ? " at the largest load, in proportion to it," : "") +
         " and " + (amount > 0.0 ? "drops" : "jumps up") + ", anew every " +
         with_interval(figures[1], " rows") + ", first before line " +
         with_interval(figures[2], "") +
         (from == double(kSawFromNothing) ? ", from nothing on"
          : from == double(kSawToNothing) ? ", back to nothing"
                                          : ", as much above as below its middle") +
         same_sign(context, s[kRowSawOf]) +
         " (a controller of the oil or the load that switches, something that fills and empties?)";
}

DriveFamily row_sawtooth(bool reads) {
  constexpr double kOfAnyPeriod = 8.0;  // its period is no whole number
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"every", "first", "what", "from"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms + kOfAnyPeriod;
  f.falls_in_steps = true;
  f.shape_values = {{.continuous = true, .is_place = true, .reach = 0.1},
                    {.continuous = true, .is_place = true, .reach = 0.3},
                    {},
                    {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return row_saw_shapes(context, reads); };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kRowSawOf]); };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin{s, s, s};
    kin[1][kRowSawFrom] = kSawFromNothing;
    kin[2][kRowSawFrom] = kSawToNothing;
    return kin;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    const double every = (*about)[kRowSawEvery], rows = 1.0 + context.table.points.back().row,
                 far = 0.6 * every * every / rows;
    std::vector<double> periods;
    for (const double by : growing_steps(context, 0.02 * far, far)) periods.push_back(every + by);
    for (double whole = std::ceil(every - far); whole <= every + far; whole += 1.0)
      periods.push_back(whole);
    // (about the middle of the run, where the period does not move it)
    const double times = std::round((0.5 * rows - (*about)[kRowSawFirst]) / every);
    for (const double period : periods) {
      if (period < 3.0) continue;
      for (const double by : growing_steps(context, 0.25, std::max(1.0, every / 12.0))) {
        const double first = (*about)[kRowSawFirst] + times * (every - period) + by;
        for (const double at : {first, std::round(first)}) {
          shapes.push_back(*about);
          shapes.back()[kRowSawEvery] = period;
          shapes.back()[kRowSawFirst] = at - period * std::floor(at / period);
        }
      }
    }
    return shapes;
  };
  // (what counts rows jumps by whole numbers of them, where that does as well)
  f.was_run = [](const DriveContext&, const DriveShape& s) {
    const auto whole = [](double value) { return std::abs(value - std::round(value)) < 1e-9; };
    return whole(s[kRowSawEvery]) && whole(s[kRowSawFirst]);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double from = s[kRowSawFrom];
    c[0] = (place_in_row_saw(p.row, s) - (from == double(kSawFromNothing) ? 0.0
                                          : from == double(kSawToNothing) ? 1.0
                                                                          : 0.5)) *
           changed_nm(context, p, s[kRowSawOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("comes_again_after_rows", s[kRowSawEvery]),
                                   figure_of("first_jump_line", line_of_first_jump(context, s))};
    add_reading(context, s[kRowSawOf], amount, figures);
    return figures;
  };
  f.told = row_saw_told;
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("in a sawtooth over the rows of the run");
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kRowSawOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_rows_by_turns() { return rows_by_turns(false); }
DriveFamily unnamed_reading_by_turns() { return rows_by_turns(true); }
DriveFamily unnamed_block() { return block(false); }
DriveFamily unnamed_reading_block() { return block(true); }
DriveFamily unnamed_row_sawtooth() { return row_sawtooth(false); }
DriveFamily unnamed_reading_row_sawtooth() { return row_sawtooth(true); }

}  // namespace trueflank::loop::drive_effects
