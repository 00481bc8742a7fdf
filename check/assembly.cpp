// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/assembly.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/check/train_turning.h"
#include "trueflank/train/planet_phase.h"

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

/// How many different places there are for a planet, and how far apart.
std::string places_text(const GearTrain& train) {
  const AssemblyCondition& condition = train.assembly;
  if (std::isnan(condition.angle_step_rad)) return " Identical planets mesh at any angle.";
  const std::string places = number_text(std::round(kTwoPi / condition.angle_step_rad), 0);
  return " Identical planets mesh at multiples of " +
         number_text(deg_from_rad(condition.angle_step_rad), 4) + " deg (" +
         places + (places == "1" ? " place" : " places") + " round the " +
         (train.sun() ? "sun" : "axis") + ").";
}

/// Whether every ring is made as two parts that close over the planets.
bool rings_in_halves(const GearTrain& train) {
  return std::all_of(train.design.gears.begin(), train.design.gears.end(), [&](const GearDesign& gear) {
    return gear.kind != GearKind::kInternal || is_made_in_halves(train.design, gear);
  });
}

std::string order_text(const GearTrain& train, const std::vector<MeshState>& states) {
  if (rings_in_halves(train))
    return " Order: planets round the sun first, radially, then onto their pins; then the lower half of"
           " each ring along the axis, turning with its teeth, and the upper half from the other side.";
  if (train.design.herringbone)
    return " Order: herringbone teeth do not slide into each other along the axis, and planets between"
           " sun and ring cannot move apart: this set can only be assembled from halves. Planets round"
           " the sun first, radially; then each ring in two halves, split at the apex, closed over them"
           " (or whole rings, and the sun in two halves from either side).";
  const Topology& topology = train.topology();
  const std::vector<int> planet_gears = topology.gears_of(topology.first_planet());
  std::string text = " Order: planets on the carrier at their angles and marks";
  const TrainGear* sun = train.sun();
  if (sun) text += ", then the sun along the axis";
  if (planet_gears.size() > 1) {
    const TrainGear& upper = train.gear(planet_gears.back());
    const double room = train.centre_distance_mm - upper.profile.tip_radius_mm();
    if (sun)
      text += sun->profile.tip_radius_mm() < room ? " from either side"
                                                  : " from below (" + upper.name + " bars it above)";
    bool first = true;
    for (const TrainGear& ring : train.gears) {
      if (ring.profile.gear().kind != GearKind::kInternal) continue;
      text += ", " + ring.name + (first ? " along the axis" : "") +
              (ring.layer == 1 ? " from below" : " from above");
      first = false;
    }
  } else {
    text += ", then the ring along the axis";
  }
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].removal && states[i].removal->at_every_rotation)
      text += std::string(sun ? "; without the sun in place, " : "; ") + gear1_name(train, train.meshes[i]) +
              " also goes into " + gear2_name(train, train.meshes[i]) + " radially";
  return text + ".";
}

/// Two gears alone: only a herringbone pinion in a ring does not simply go in.
Finding without_planets(const GearTrain& train) {
  Finding finding{.id = "assembly",
                  .where = "train",
                  .status = CheckStatus::kNotApplicable,
                  .message = "there are no planets to assemble"};
  if (!train.meshes.empty() && train.design.herringbone && train.pair(train.meshes[0]).internal() &&
      !rings_in_halves(train)) {
    finding.status = CheckStatus::kWarn;
    finding.message = "herringbone teeth do not slide into a ring along the axis: this pair can only be "
                      "assembled from halves.";
    finding.cure = "halves = true for the wheel: two parts that close over the pinion";
  }
  return finding;
}

std::string indexed_text(const GearTrain& train, const IndexedPlanets& indexed) {
  const Topology& topology = train.topology();
  const std::vector<int> gears = topology.gears_of(topology.first_planet());
  return " at " + list_text(indexed.angles_rad) + ", with " + train.gear(gears[1]).name + " ahead of " +
         train.gear(gears[0]).name + ", against body 1, by " + list_text(indexed.offsets_rad);
}

/// Equal spacing is impossible: which angles are left, and for which bodies.
void at_other_angles(const GearTrain& train, const std::string& count, Finding& finding) {
  const AssemblyCondition& condition = train.assembly;
  finding.status = CheckStatus::kFail;
  finding.message = count + " planets do not mesh at equal spacing with sun and rings.";
  finding.value = kNaN;
  finding.cure = "tooth numbers of sun and ring whose sum is a multiple of " + count;
  if (condition.nearest_angles_rad.empty()) {
    finding.message += " At the angles nearest to it where they do, neighbours would collide.";
    return;
  }
  finding.value = deg_from_rad(departure_rad(condition.nearest_angles_rad));
  finding.cure += ", or the angles given";
  const IndexedPlanets indexed = indexed_planets(train);
  if (!planet_bodies_alike(condition)) {
    finding.message += " Identical ones would collide at the nearest angles; bodies that differ mesh" +
                       indexed_text(train, indexed) + ": these are taken.";
    finding.cure += ", each body marked and mounted in its place";
    return;
  }
  finding.message += " Identical ones do at " + list_text(condition.nearest_angles_rad) + ": these are taken.";
  if (!indexed.angles_rad.empty() && indexed.angles_rad != condition.nearest_angles_rad)
    finding.message += " Bodies that differ would" + indexed_text(train, indexed) + ".";
}

/// The closed form's word, without the order.
Finding by_closed_form(const GearTrain& train) {
  const AssemblyCondition& condition = train.assembly;
  const std::string count = std::to_string(train.design.planets);
  Finding finding{.id = "assembly", .where = "train", .value = 0.0, .limit = 0.0, .unit = "deg"};
  if (condition.equal_spacing && condition.identical_planets) {
    finding.message = count + " identical planets mesh with all gears at equal spacing.";
  } else if (condition.equal_spacing) {
    finding.status = CheckStatus::kWarn;
    const Topology& topology = train.topology();
    const std::vector<int> gears = topology.gears_of(topology.first_planet());
    finding.message = count + " planets mesh at equal spacing, but their bodies differ: " +
                      train.gear(gears[1]).name + " ahead of " + train.gear(gears[0]).name +
                      ", against body 1, by " +
                      list_text(condition.planet_offsets_rad) + ".";
    finding.cure = "mark the bodies and mount each in its place";
    if (!condition.nearest_angles_rad.empty())
      finding.cure += ", or mount identical ones at " + list_text(condition.nearest_angles_rad);
  } else {
    at_other_angles(train, count, finding);
  }
  finding.margin = -finding.value;
  finding.message += places_text(train);
  return finding;
}

}  // namespace

Findings check_assembly(const GearTrain& train, const std::vector<MeshState>& states) {
  if (!train.topology().has_planets())
    return {without_planets(train)};
  Finding finding = by_closed_form(train);
  const TrainTurning turning = turn_train(train, states);
  // equal spacing where nothing meshes is drawn all the same: the closed form has failed it already
  if (turning.phase_error_mm > tolerance::kTouch_mm) {
    finding.status = CheckStatus::kFail;
    finding.message += " Turned, " + turning.mesh + " stands " + um_text(turning.phase_error_mm) +
                       " out of phase, clearance " + um_text(turning.clearance_mm) + ".";
    if (finding.cure.empty()) finding.cure = "tooth numbers that assemble";
  } else {
    finding.message += " Turned, every mesh of every planet keeps its phase.";
  }
  if (finding.status != CheckStatus::kFail) finding.message += order_text(train, states);
  if (train.design.herringbone && !rings_in_halves(train) && finding.status != CheckStatus::kFail) {
    finding.status = CheckStatus::kWarn;
    finding.cure += std::string(finding.cure.empty() ? "" : "; ") +
                    (train.design.machine
                         ? "helical or straight teeth: in a housing the ring that drives out is one part"
                         : "halves = true for every ring (or make the sun in halves that part at the apex)");
  }
  return {finding};
}

}  // namespace trueflank
