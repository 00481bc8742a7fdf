// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/assembly.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

std::string list_text(const std::vector<double>& angles_rad) {
  std::string text;
  for (double angle : angles_rad)
    text += (text.empty() ? "" : ", ") + number_text(deg_from_rad(angle), 4);
  return text + " deg";
}

/// Largest departure of the positions from equal spacing.
double departure_rad(const std::vector<double>& positions_rad) {
  double largest = 0.0;
  const auto n = static_cast<double>(positions_rad.size());
  for (std::size_t i = 0; i < positions_rad.size(); ++i)
    largest = std::max(
        largest, std::abs(positions_rad[i] - kTwoPi * static_cast<double>(i) / n));
  return largest;
}

}  // namespace

Findings check_assembly(const GearTrain& train) {
  Finding finding{.id = "assembly", .where = "train"};
  const bool planetary =
      train.design.kind == TrainKind::k3k || train.design.kind == TrainKind::kSimple;
  if (!planetary) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "there are no planets to assemble";
    return {finding};
  }
  const AssemblyCondition& condition = train.assembly;
  const std::string count = std::to_string(train.design.planets);
  const std::string step = " Planets that are alike mesh at multiples of " +
                           number_text(deg_from_rad(condition.angle_step_rad), 4) + " deg.";
  finding.unit = "deg";
  finding.limit = 0.0;
  finding.value = 0.0;
  if (condition.equal_spacing && condition.identical_planets) {
    finding.message = count + " identical planets mesh with all gears at equal spacing." + step;
  } else if (condition.equal_spacing) {
    finding.status = CheckStatus::kWarn;
    finding.message = count + " planets mesh at equal spacing, but their bodies differ: planet2 ahead "
                      "of planet1, against body 1, by " +
                      list_text(condition.planet_offsets_rad) + ".";
    finding.cure = condition.nearest_angles_rad.empty()
                       ? "mark the bodies and mount each in its place"
                       : "mark the bodies and mount each in its place, or mount identical ones at " +
                             list_text(condition.nearest_angles_rad);
  } else {
    finding.status = CheckStatus::kFail;
    finding.message = count + " planets do not mesh at equal spacing with sun and rings.";
    finding.value = kNaN;
    if (!condition.nearest_angles_rad.empty()) {
      finding.value = deg_from_rad(departure_rad(condition.nearest_angles_rad));
      finding.message += " Identical ones do at " + list_text(condition.nearest_angles_rad) + ".";
    }
    finding.message += step;
    finding.cure = "tooth numbers of sun and ring whose sum is a multiple of " + count +
                   (condition.nearest_angles_rad.empty() ? "" : ", or the angles given");
  }
  finding.margin = -finding.value;
  return {finding};
}

}  // namespace trueflank
