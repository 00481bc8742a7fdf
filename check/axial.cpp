// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/axial.h"

#include <algorithm>

#include "trueflank/check/quantity_text.h"
#include "trueflank/train/carrier.h"

namespace trueflank {
namespace {

/// Radii about the train's axis between which a gear's material may stand.
struct Reach {
  double inner_mm = 0.0, outer_mm = 0.0;
};

/// The topology's member that a gear belongs to.
int member_of(const GearTrain& train, const TrainGear& gear) {
  return train.topology().gears[static_cast<std::size_t>(&gear - train.gears.data())].member;
}

Reach reach_of(const GearTrain& train, const TrainGear& gear) {
  const double tip = gear.profile.tip_radius_mm();
  if (gear.profile.gear().kind == GearKind::kInternal) return {tip, 1e300};  // the rim is unbounded here
  if (const int member = member_of(train, gear); train.topology().is_planet(member)) {
    const double a = train.axis_distance_mm(member);
    return {a - tip, a + tip};
  }
  return {0.0, tip};
}

/// Largest of the gaps that keep a gear and a plate apart, along the axis or across it.
double plate_gap_mm(const GearTrain& train, const TrainGear& gear, const CarrierLayout& carrier,
                    const HeightRange& plate) {
  const Reach reach = reach_of(train, gear);
  const double top = gear.z_lower_mm + gear.face_width_mm;
  const double axial = std::max(gear.z_lower_mm - plate.upper_mm, plate.lower_mm - top);
  const double radial = std::max(reach.inner_mm - 0.5 * carrier.outer_diameter_mm,
                                 0.5 * carrier.opening_diameter_mm - reach.outer_mm);
  return std::max(axial, radial);
}

/// All parts are round about the axis or turn with the carrier: what is clear here is clear at every
/// position.
Finding judge_carrier(const GearTrain& train, const CarrierLayout& carrier) {
  const Topology& topology = train.topology();
  const std::string name = topology.name_of(topology.carrier_of(topology.first_planet()));
  Finding finding{.id = "axial", .where = name, .limit = 0.0, .unit = "mm"};
  for (const TrainGear& gear : train.gears) {
    for (const bool lower : {true, false}) {
      const double gap = plate_gap_mm(train, gear, carrier,
                                      lower ? carrier.lower_plate : carrier.upper_plate);
      if (gap >= finding.value) continue;  // NaN: the first one
      finding.value = finding.margin = gap;
      const std::string which = lower ? name : name + "_top";
      finding.message = which + " and " + gear.name +
                        (gap > 0.0 ? " clear each other by " + mm_text(gap)
                                   : " run into each other by " + mm_text(-gap));
    }
  }
  finding.status = finding.value > 0.0 ? CheckStatus::kPass : CheckStatus::kFail;
  if (finding.status == CheckStatus::kFail)
    finding.cure = "axial_clearance_mm in [carrier] larger by more than " + bound_text(-finding.value, Rounded::kUp) +
                   " mm, an outer_diameter_mm smaller by twice that, or a larger opening_diameter_mm";
  return finding;
}

}  // namespace

Findings check_axial(const GearTrain& train) {
  Finding finding{.id = "axial", .where = "train", .limit = 0.0, .unit = "mm"};
  for (const TrainGear& lower : train.gears) {
    for (const TrainGear& upper : train.gears) {
      if (lower.layer >= upper.layer || member_of(train, lower) == member_of(train, upper)) continue;
      const Reach a = reach_of(train, lower), b = reach_of(train, upper);
      if (a.outer_mm <= b.inner_mm || b.outer_mm <= a.inner_mm) continue;
      const double gap = upper.z_lower_mm - (lower.z_lower_mm + lower.face_width_mm);
      if (gap >= finding.value) continue;  // NaN: the first one
      finding.value = finding.margin = gap;
      finding.message = lower.name + " and " + upper.name +
                        (gap > 0.0 ? " stand " + mm_text(gap) + " apart"
                                   : " touch: they overlap by " + mm_text(-gap)) +
                        " along the axis";
      finding.status = gap > 0.0 ? CheckStatus::kPass : CheckStatus::kFail;
      finding.cure = gap > 0.0 ? ""
                               : "layer_gap_mm above " +
                                     bound_text(train.design.layer_gap_mm - gap, Rounded::kUp) +
                                     ", or a face width of " + lower.name + " below " +
                                     bound_text(lower.face_width_mm + gap, Rounded::kDown) + " mm";
    }
  }
  if (finding.message.empty()) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "all parts are in one layer, or pass each other";
  }
  Findings findings{finding};
  for (const GearTrain* stage : train.each_stage())
    if (const auto carrier = carrier_layout(*stage)) findings.push_back(judge_carrier(*stage, *carrier));
  return findings;
}

}  // namespace trueflank
