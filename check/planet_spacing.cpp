// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/planet_spacing.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Smallest angle between neighbouring planets where they stand.
double smallest_angle_rad(const std::vector<double>& positions) {
  std::vector<double> sorted;
  for (double p : positions) sorted.push_back(wrapped_rad(p));
  std::sort(sorted.begin(), sorted.end());
  double smallest = kTwoPi - (sorted.back() - sorted.front());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    smallest = std::min(smallest, sorted[i] - sorted[i - 1]);
  return smallest;
}

Finding planet_spacing_finding(const GearTrain& train, const TrainGear& gear) {
  const double a = train.centre_distance_mm, tip = gear.profile.tip_radius_mm();
  const double angle = std::min(smallest_angle_rad(train.phases.positions_rad(train.topology().first_planet())), kPi);
  const double gap = 2.0 * a * std::sin(0.5 * angle) - 2.0 * tip;
  const int most = most_planets(a, tip);
  Finding finding{.id = "planet_spacing",
                  .where = gear.name,
                  .value = gap,
                  .limit = 0.0,
                  .margin = gap,
                  .unit = "mm"};
  finding.message = "neighbouring tip circles of diameter " + mm_text(2.0 * tip) + ", " +
                    deg_text(angle) + " apart, " +
                    (gap > 0.0 ? "clear each other by " + mm_text(gap)
                               : "overlap by " + mm_text(-gap)) +
                    "; up to " + std::to_string(most) + " fit at equal spacing";
  if (gap > 0.0) return finding;
  finding.status = CheckStatus::kFail;
  finding.cure = "at most " + std::to_string(most) + " planets, or a tip diameter of " + gear.name +
                 " below " + bound_text(2.0 * a * std::sin(0.5 * angle), Rounded::kDown) + " mm (" + mm_text(gap) + ")";
  return finding;
}

}  // namespace

int most_planets(double centre_distance_mm, double tip_radius_mm) {
  const double ratio = tip_radius_mm / centre_distance_mm;
  if (ratio >= 1.0) return 1;
  int n = static_cast<int>(std::floor(kPi / std::asin(ratio)));
  while (n > 1 && centre_distance_mm * std::sin(kPi / n) <= tip_radius_mm) --n;
  return n;
}

Findings check_planet_spacing(const GearTrain& train) {
  Findings findings;
  if (train.phases.positions_rad(train.topology().first_planet()).size() > 1)
    for (std::size_t i = 0; i < train.gears.size(); ++i)
      if (train.topology().is_planet_gear(i)) findings.push_back(planet_spacing_finding(train, train.gears[i]));
  if (findings.empty())
    findings.push_back({.id = "planet_spacing",
                        .where = "train",
                        .status = CheckStatus::kNotApplicable,
                        .message = "there are no neighbouring planets"});
  return findings;
}

}  // namespace trueflank
