// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop::drive_effects {

bool is_beside_the_load(double what) {
  return what == double(kFlanks) || what == double(kOutputGain);
}

bool has_parts_over(const DriveContext& context, double over) {
  constexpr int kFewestLevels = 6;
  if (over == kOverRun) return has_one_course(context);
  const auto of = over == kOverDrivingLoad ? std::size_t{0} : static_cast<std::size_t>(over);
  return context.table.levels[of] >= kFewestLevels &&
         (over != 2.0 || context.table.temperature_span_c > 3.0);
}

double share_in_range(const DriveContext& context, const BenchPoint& p, double over) {
  if (over == kOverRun) return p.taken;
  const BenchTable& t = context.table;
  if (over == kOverDrivingLoad)
    return (p.load_nm - t.least_load_nm) / std::max(1e-12, t.most_load_nm - t.least_load_nm);
  const double least = over == 0.0 ? context.least_share(0.0) : 0.0;
  return (context.share_of_range(p, over) - least) / std::max(1e-9, 1.0 - least);
}

std::vector<double> ranges_with_edges(const DriveContext& context) {
  std::vector<double> overs;
  for (const double over : {0.0, 1.0, 2.0, kOverDrivingLoad})
    if (has_parts_over(context, over) && (over != 0.0 || context.table.has(false)) &&
        (over != kOverDrivingLoad || context.table.has(true)))
      overs.push_back(over);
  return overs;
}

std::vector<double> shares_of_rows(const DriveContext& context, double over) {
  std::vector<double> shares;
  for (const BenchPoint& p : context.table.points)
    shares.push_back(share_in_range(context, p, over));
  return shares;
}

const std::vector<double>& shares_of_every_row(const DriveContext& context, double over) {
  return context.last_shares.of({&over, 1}, [&] {
    std::vector<double> shares;
    for (const BenchPoint& p : context.table.every_row())
      shares.push_back(share_in_range(context, p, over));
    return shares;
  });
}

std::vector<double> edges_to_try(std::vector<double> shares, std::size_t most) {
  std::vector<double> places;
  std::sort(shares.begin(), shares.end());
  std::size_t last = 0;
  for (std::size_t at = 1; at < shares.size(); ++at) {
    if (!(shares[at] > shares[at - 1]) || (at - last) * most < shares.size()) continue;
    places.push_back(0.5 * (shares[at] + shares[at - 1]));
    last = at;
  }
  return places;
}

std::vector<double> ends_of_gap(const std::vector<double>& shares, double place) {
  constexpr double kNearlyAtTheRow = 0.98;  // of the way there
  double below = -1e300, above = 1e300;
  for (const double share : shares)
    share <= place ? below = std::max(below, share) : above = std::min(above, share);
  std::vector<double> ends;
  if (below > -1e300) ends.push_back(place + kNearlyAtTheRow * (below - place));
  if (above < 1e300) ends.push_back(place + kNearlyAtTheRow * (above - place));
  return ends;
}

Parameter figure_at_share(const DriveContext& context, double over, const std::string& key,
                          double share) {
  const BenchTable& t = context.table;
  if (over == kOverRun) {
    for (const BenchPoint& p : t.points)
      if (p.taken >= share) return figure_of(key + "line", p.line);
    return figure_of(key + "line", t.points.back().line);
  }
  if (over == kOverDrivingLoad)
    return figure_of(key + "input_nm",
                     t.least_load_nm + share * (t.most_load_nm - t.least_load_nm));
  const double least = over == 0.0 ? context.least_share(0.0) : 0.0,
               quantity = context.quantity_at_share(over, least + share * (1.0 - least));
  return over == 0.0 ? figure_of(key + "output_nm", quantity * context.model.ratio)
                     : figure_of(key + key_of_quantity(over), quantity);
}

std::string place_in_range(double over, const Parameter& place) {
  return over == kOverRun
             ? "line " + value_in_range(over, place)
             : std::string("a ") + name_of_range(over) + " of " + value_in_range(over, place);
}

std::string value_in_range(double over, const Parameter& place) {
  return with_interval(place, over == kOverRun           ? ""
                              : over == 0.0              ? " N m at the output"
                              : over == kOverDrivingLoad ? unit_of_quantity(0.0)
                                                         : unit_of_quantity(over));
}

const char* name_of_range(double over) {
  return over == kOverRun ? "run" : name_of_quantity(over == kOverDrivingLoad ? 0.0 : over);
}

std::vector<double> kinds_of(bool reads) {
  return reads ? std::vector{double(kOutputReads), double(kOutputGain)}
               : std::vector{double(kDrag), double(kFlanks)};
}

std::string subject_of(double what) {
  return what == double(kOutputReads)  ? "a reading of the output's torque"
         : what == double(kOutputGain) ? "a gain of the output's torque"
                                       : "a loss at the input";
}

std::string more_of(const std::vector<Parameter>& figures, double what, double amount,
                    const std::string& than) {
  const bool reads = what == double(kOutputReads) || what == double(kOutputGain);
  return with_interval(reads ? figures.back() : figures.front(), " N m") +
         (amount > 0.0 ? " more" : " less") + than +
         (what == kBySpeed            ? " at the largest speed, in proportion to it"
          : is_beside_the_load(what) ? " at the largest load, in proportion to it"
                                     : "");
}

void add_reading(const DriveContext& context, double what, double amount,
                 std::vector<Parameter>& figures) {
  if (what == double(kOutputReads) || what == double(kOutputGain))
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
}

std::string same_sign(const DriveContext& context, double what) {
  const bool both = context.table.has(true) && context.table.has(false);
  return both && (what == double(kOutputReads) || what == double(kOutputGain)) ? kNoLoss : "";
}

}  // namespace trueflank::loop::drive_effects
