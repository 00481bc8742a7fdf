// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/rough_flanks.h"

#include <algorithm>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/loudness.h"

namespace trueflank::loop {

RoughFlanks rough_flanks(const Courses& courses) {
  std::array<std::vector<std::vector<ValueAlong>>, 2> of_side;
  for (std::size_t side = 0; side < of_side.size(); ++side)
    for (const auto& [course, samples] : courses.of_flank[side]) {
      std::vector<ValueAlong>& trace = of_side[side].emplace_back();
      for (const RemainderSample& sample : samples)
        trace.push_back({(sample.at - courses.low) / (courses.high - courses.low), sample.um});
      std::stable_sort(trace.begin(), trace.end(),
                       [](const auto& a, const auto& b) { return a.at < b.at; });
    }
  std::vector<std::vector<ValueAlong>> both = of_side[0];
  both.insert(both.end(), of_side[1].begin(), of_side[1].end());
  RoughFlanks surest;
  int asked = 0;
  for (const int side : {-1, 0, 1}) {
    const auto& traces = side < 0 ? both : of_side[static_cast<std::size_t>(side)];
    if (traces.empty() || (side >= 0 && traces.size() == both.size())) continue;
    ++asked;
    const std::optional<RoughZone> zone = rough_zone(traces);
    if (zone && zone->p_value < surest.zone.p_value) surest = {side, *zone};
  }
  surest.zone.p_value = std::min(1.0, asked * surest.zone.p_value);
  return surest;
}

bool is_rough_surface(const RoughZone& zone) {
  constexpr double kRough = 2.5;
  return zone.at_least >= kRough;
}

std::vector<MemberScatter> scatters_of(const Courses& courses) {
  std::vector<MemberScatter> scatters;
  for (const int side : {0, 1})
    for (const auto& [number, samples] : courses.of_flank[static_cast<std::size_t>(side)]) {
      std::vector<RemainderSample> in_order = samples;
      std::stable_sort(in_order.begin(), in_order.end(),
                       [](const auto& a, const auto& b) { return a.at < b.at; });
      Eigen::VectorXd course(static_cast<Eigen::Index>(in_order.size()));
      for (std::size_t i = 0; i < in_order.size(); ++i)
        course[static_cast<Eigen::Index>(i)] = in_order[i].um;
      scatters.push_back({.number = courses.tooth_of[static_cast<std::size_t>(side)].at(number),
                          .set = side,
                          .scatter = short_wave_scatter(course),
                          .values = static_cast<double>(in_order.size())});
    }
  return scatters;
}

std::string words_of(const RoughZone& zone, FlankChoice flank, bool face, double low_mm,
                     double high_mm) {
  return printed(
      "all traces over the %s%s are rougher between %s of %.4g and %.4g mm: %.3g um "
      "against %.3g um elsewhere",
      face ? "face" : "profile",
      flank == FlankChoice::kLeft    ? " of left flanks"
      : flank == FlankChoice::kRight ? " of right flanks"
                                     : "",
      face ? "heights" : "diameters", low_mm, high_mm, zone.inside_um, zone.outside_um);
}

std::string words_of(const RougherMembers& rougher, const std::string& what, FlankChoice flank) {
  const std::string of = what + (flank == FlankChoice::kLeft    ? "left flanks"
                                 : flank == FlankChoice::kRight ? "right flanks"
                                 : what.empty()                 ? "flanks"
                                                                : "all flanks");
  if (rougher.grows)
    return printed(
        "the %s are rougher and rougher from tooth %d to tooth %d: neighbouring values "
        "scatter %.2g times as much there",
        of.c_str(), rougher.first, rougher.last, rougher.times);
  return printed(
      "the %s are rougher on teeth %d to %d: neighbouring values scatter %.2g times as "
      "much as on the others",
      of.c_str(), rougher.first, rougher.last, rougher.times);
}

std::string words_of_teeth(const std::set<int>& teeth) {
  constexpr std::size_t kMostListed = 5;
  const int first = *teeth.begin(), last = *teeth.rbegin();
  if (teeth.size() == 1) return "on tooth " + std::to_string(first);
  if (teeth.size() > 2 && last - first + 1 == static_cast<int>(teeth.size()))
    return printed("on teeth %d to %d", first, last);
  if (teeth.size() > kMostListed)
    return printed("on %d teeth, %d the first of them and %d the last",
                   static_cast<int>(teeth.size()), first, last);
  std::string words = "on teeth ";
  for (const int tooth : teeth)
    words += (tooth == first ? "" : tooth == last ? " and " : ", ") + std::to_string(tooth);
  return words;
}

}  // namespace trueflank::loop
