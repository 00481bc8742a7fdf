// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// What follows the load, the speed or the temperature of the rows before, or how it has changed
// from them: oil that the last minutes warmed, a flywheel that speeds up, a sensor whose body is
// colder than its sleeve.
namespace trueflank::loop::drive_effects {

namespace {

enum MemoryValue : std::size_t {
  kMemoryRows,  ///< in which a row is forgotten to exp(-1)
  kMemoryOver,  ///< 0: the load that drives, 1: the speed, 2: the temperature
  kMemoryOf,    ///< What
  kMemoryHow,
};
/// By the mean of the rows before from nothing at its least or at its largest; by the row less that
/// mean; by the mean of the rows after less that of those before, which noise of what is read
/// slowly does not hide.
enum HowOfMemory { kFromLeast, kFromMost, kByChange, kByRate };
bool is_by_change(const DriveShape& s) { return s[kMemoryHow] >= double(kByChange); }

/// Fewer rows than these: the row before alone.
constexpr double kOneRow = 0.5;
constexpr double kLeastOfMemory = 0.2, kMostOfMemory = 200.0;

double remembered_quantity(const BenchPoint& p, double over) {
  return over == 0.0 ? p.load_nm : over == 1.0 ? p.speed_rpm : p.temperature_c;
}

/// The mean of the rows before, the last ones most, of every row; where there was none the row.
/// `after`: of the rows after, the next ones most.
std::vector<double> means_beside(const BenchTable& table, double over, double rows_kept,
                                 bool after) {
  const auto& rows = table.every_row();
  const double each = std::exp(-1.0 / rows_kept);
  std::vector<double> sum(rows.size(), 0.0), weight = sum, mean(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) mean[i] = remembered_quantity(rows[i], over);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t i = after ? rows.size() - 1 - k : k;
    if (rows[i].before < 0) continue;
    const auto before = static_cast<std::size_t>(rows[i].before);
    const std::size_t to = after ? before : i, from = after ? i : before;
    sum[to] = remembered_quantity(rows[from], over) + each * sum[from];
    weight[to] = 1.0 + each * weight[from];
    mean[to] = sum[to] / weight[to];
  }
  return mean;
}

/// What is followed, as it is: of a rate for a row.
std::vector<double> memory_of_rows(const BenchTable& table, const DriveShape& s) {
  const auto mean_of = [&](bool after) {
    return means_beside(table, s[kMemoryOver], s[kMemoryRows], after);
  };
  std::vector<double> memory = mean_of(false);
  const auto& rows = table.every_row();
  if (s[kMemoryHow] == double(kByChange))
    for (std::size_t i = 0; i < rows.size(); ++i)
      memory[i] = remembered_quantity(rows[i], s[kMemoryOver]) - memory[i];
  if (s[kMemoryHow] != double(kByRate)) return memory;
  // (the rows of one side are so far from the row in the mean)
  const double far = 1.0 / -std::expm1(-1.0 / s[kMemoryRows]);
  const std::vector<double> after = mean_of(true);
  for (std::size_t i = 0; i < rows.size(); ++i) memory[i] = (after[i] - memory[i]) / (2.0 * far);
  return memory;
}

/// From 0 at the least to 1, or 1 at the most to either side of 0.
double range_of_memory(const std::vector<double>& memory, bool by_change) {
  const auto [least, most] = std::minmax_element(memory.begin(), memory.end());
  return by_change ? std::max(*most, -*least) : *most - *least;
}

double remembered(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const std::array<double, 3> figures{s[kMemoryRows], s[kMemoryOver],
                                      std::max(s[kMemoryHow], double(kFromMost))};
  const std::vector<double>& memory = context.last_memories.of(figures, [&] {
    std::vector<double> of_rows = memory_of_rows(context.table, s);
    const double range = range_of_memory(of_rows, is_by_change(s)),
                 from = is_by_change(s) ? 0.0 : *std::ranges::min_element(of_rows);
    for (double& one : of_rows) one = range > 0.0 ? (one - from) / range : 0.0;
    return of_rows;
  });
  const auto at = static_cast<std::size_t>(p.place);
  if (at >= memory.size()) return 0.0;
  return s[kMemoryHow] == double(kFromMost) ? 1.0 - memory[at] : memory[at];
}

/// One run of rows, most of which follow the one before, over which the quantity changes and not
/// only slowly: its memory is another thing than itself.
bool has_memory_of(const DriveContext& context, double over) {
  constexpr double kFewestFollow = 0.8, kLeastChange = 0.02;  // of the whole variance
  const BenchTable& table = context.table;
  double follow = 0.0, change = 0.0, mean = 0.0, square = 0.0;
  // (one row of a log without it, and no row after it has a mean)
  if (std::ranges::any_of(table.every_row(), [&](const BenchPoint& p) {
        return std::isnan(remembered_quantity(p, over));
      }))
    return false;
  for (const BenchPoint& p : table.points) {
    const double x = remembered_quantity(p, over);
    mean += x;
    square += x * x;
    const BenchPoint* before = table.row_before(p);
    if (before == nullptr) continue;
    follow += 1.0;
    change += std::pow(x - remembered_quantity(*before, over), 2);
  }
  const auto n = static_cast<double>(table.points.size());
  mean /= n;
  const double variance = square / n - mean * mean;
  return follow >= kFewestFollow * n && variance > 1e-9 * mean * mean &&
         (over == 2.0 || change > kLeastChange * variance * follow);
}

std::vector<DriveShape> memory_shapes(const DriveContext& context, bool reads) {
  constexpr std::size_t kFewestRows = 60;
  constexpr double kFewestTimes = 6.0;
  std::vector<DriveShape> shapes;
  const auto n = context.table.points.size();
  if (!has_one_course(context) || n < kFewestRows) return shapes;
  for (const double over : {0.0, 1.0, 2.0}) {
    if (!has_parts_over(context, over == 0.0 ? kOverDrivingLoad : over) ||
        !has_memory_of(context, over))
      continue;
    for (const double what : kinds_of(reads))
      for (const double rows : {0.25, 1.5, 3.0, 6.0, 12.0, 25.0, 50.0}) {
        if (rows * kFewestTimes > static_cast<double>(n)) continue;
        // (the mean of slow rows is what they are)
        if (over != 2.0) shapes.push_back({rows, over, what, double(kFromLeast)});
        shapes.push_back({rows, over, what, double(over == 2.0 ? kByRate : kByChange)});
      }
  }
  return shapes;
}

std::string memory_told(const DriveContext& context, const DriveShape& s, double amount,
                        const std::vector<Parameter>& figures) {
  const bool by_change = is_by_change(s), by_rate = s[kMemoryHow] == double(kByRate);
  const std::string name = name_of_quantity(s[kMemoryOver]),
                    load = is_beside_the_load(s[kMemoryOf]) ? " at the largest load" : "",
                    fading = ", which fade to a third within " + with_interval(figures[1], " rows"),
                    guess =
                        s[kMemoryOver] == 2.0
                            ? " (a part that grows warm later than what is measured?)"
                        : by_change
                            ? " (what turns must be sped up and slowed down: wait until the set "
                              "point is steady, or log the acceleration)"
                            : " (oil or grease that they warm or move? log a temperature)";
  if (!by_change)
    return subject_of(s[kMemoryOf]) + " that follows the " + name + " of the rows before" + fading +
           ": " + more_of(figures, s[kMemoryOf], amount) + " after the " +
           (s[kMemoryHow] == double(kFromLeast) ? "largest, nothing after the least"
                                                : "least, nothing after the largest") +
           load + same_sign(context, s[kMemoryOf]) + guess;
  return subject_of(s[kMemoryOf]) + " by how " + (by_rate ? "fast " : "") + "the " + name +
         " changes" +
         (by_rate ? ", over " + with_interval(figures[1], " rows") + " to either side"
          : s[kMemoryRows] < kOneRow ? std::string(", from the row before")
                                     : ", against the rows before" + fading) +
         ": " + more_of(figures, s[kMemoryOf], amount) +
         (by_rate ? " where it rises by " : " where it has risen by ") +
         with_interval(figures[2], unit_of_quantity(s[kMemoryOver])) + (by_rate ? " a row" : "") +
         ", as much " + (amount > 0.0 ? "less" : "more") +
         (by_rate ? " where it falls so" : " where it has fallen by as much") + load +
         same_sign(context, s[kMemoryOf]) + guess;
}

DriveFamily memory(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"rows", "over", "what", "how"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {
      {.continuous = true,
       .limits = [](const DriveContext&) { return std::pair(kLeastOfMemory, kMostOfMemory); }},
      {},
      {},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return memory_shapes(context, reads); };
  f.kind = [](const DriveShape& s) {
    return static_cast<int>(s[kMemoryOver] * 8.0 + s[kMemoryOf]) * 2 + (is_by_change(s) ? 1 : 0);
  };
  f.kin_shapes = [](const DriveShape& s) {
    std::vector<DriveShape> kin{s};
    if (is_by_change(s)) return kin;
    kin.push_back(s);
    kin[0][kMemoryHow] = kFromLeast;
    kin[1][kMemoryHow] = kFromMost;
    return kin;
  };
  f.follows_rows_before = true;
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    if (about == nullptr) return std::vector<DriveShape>{};
    return with_first_moved(context, *about,
                            {.first = 0.01,
                             .last = 0.7,
                             .least = kLeastOfMemory,
                             .most = kMostOfMemory,
                             .as_shares = true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = remembered(context, p, s) * changed_nm(context, p, s[kMemoryOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("fades_within_rows", s[kMemoryRows])};
    if (is_by_change(s))
      figures.push_back(figure_of("change_" + key_of_quantity(s[kMemoryOver]) +
                                      (s[kMemoryHow] == double(kByRate) ? "_per_row" : ""),
                                  range_of_memory(memory_of_rows(context.table, s), true)));
    add_reading(context, s[kMemoryOf], amount, figures);
    return figures;
  };
  f.told = memory_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return is_by_change(s)
               ? std::string("by how the ") + name_of_quantity(s[kMemoryOver]) + " changes"
               : std::string("that follows the ") + name_of_quantity(s[kMemoryOver]) +
                     " of the rows before";
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kMemoryOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_memory() { return memory(false); }
DriveFamily unnamed_reading_memory() { return memory(true); }

}  // namespace trueflank::loop::drive_effects
