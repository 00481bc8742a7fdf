// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/stages.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trueflank/base/contract.h"
#include "trueflank/train/carrier.h"

namespace trueflank {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Keys of [gearbox] that a later stage has of its own.
constexpr std::array<std::string_view, 3> kOwnKeys{"planets", "module_mm", "centre_distance_mm"};

bool contains(const std::vector<int>& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Members that carry a gear of the stage, or carry one round.
std::vector<int> members_of(const Topology& whole, int stage) {
  std::vector<int> members;
  for (std::size_t m = 0; m < whole.members.size(); ++m) {
    const int member = static_cast<int>(m);
    const bool part = std::any_of(whole.gears.begin(), whole.gears.end(), [&](const TopologyGear& gear) {
      return gear.stage == stage && (gear.member == member || whole.carrier_of(gear.member) == member);
    });
    if (part) members.push_back(member);
  }
  return members;
}

/// The place of a member of the whole in a stage; kNoMember where it is none of it.
int place_in(const std::vector<int>& members, int member) {
  const auto it = std::find(members.begin(), members.end(), member);
  return it == members.end() ? kNoMember : static_cast<int>(it - members.begin());
}

/// The shaft that a stage shares with an earlier (later) one.
int shared_member(const std::vector<std::vector<int>>& members, std::size_t stage, bool earlier) {
  const std::size_t from = earlier ? 0 : stage + 1, to = earlier ? stage : members.size();
  for (std::size_t other = from; other < to; ++other)
    for (std::size_t i = 0; i < members[stage].size(); ++i)
      if (contains(members[other], members[stage][i])) return static_cast<int>(i);
  return kNoMember;
}

/// Bodies of a stage: a carrier of the whole that only drives a gear here is that gear's body.
void add_members(const Topology& whole, int stage, StageTopology& own) {
  for (const int member : own.members) {
    TopologyMember body = whole.members[at(member)];
    if (whole.is_planet(member)) {
      own.topology.axes.push_back({.carrier = place_in(own.members, whole.carrier_of(member))});
      body.axis = static_cast<int>(own.topology.axes.size()) - 1;
    }
    for (const int gear : whole.gears_of(member))
      if (whole.is_carrier(member) && whole.gears[at(gear)].stage == stage) body.name = whole.gears[at(gear)].name;
    own.topology.members.push_back(std::move(body));
  }
}

void add_gears(const Topology& whole, int stage, StageTopology& own) {
  bool first = true;
  int below = 0;  // layers of the stages below
  for (std::size_t i = 0; i < whole.gears.size(); ++i) {
    TopologyGear gear = whole.gears[i];
    if (gear.stage != stage) continue;
    if (first) own.first_gear = static_cast<int>(i), below = gear.layer - 1, first = false;
    gear.member = place_in(own.members, gear.member);
    gear.layer -= below;
    gear.stage = 1;
    own.topology.gears.push_back(std::move(gear));
  }
  first = true;
  for (std::size_t k = 0; k < whole.meshes.size(); ++k) {
    const TopologyMesh& mesh = whole.meshes[k];
    if (whole.gears[at(mesh.gear1)].stage != stage) continue;
    if (first) own.first_mesh = static_cast<int>(k), first = false;
    own.topology.meshes.push_back({mesh.gear1 - own.first_gear, mesh.gear2 - own.first_gear});
  }
}

/// The lowest layer stands on the one of the stage before.
void raise(GearTrain& stage, double by_mm) {
  for (TrainGear& gear : stage.gears) gear.z_lower_mm += by_mm;
}

/// Gears, meshes and places of a stage, in the whole.
void add_to_whole(const GearTrain& stage, const StageTopology& own, GearTrain& whole) {
  for (TrainGear gear : stage.gears) {
    gear.layer = whole.topology().gears[whole.gears.size()].layer;
    whole.gears.push_back(std::move(gear));
  }
  for (TrainMesh mesh : stage.meshes) {
    mesh.gear1 += own.first_gear;
    mesh.gear2 += own.first_gear;
    whole.meshes.push_back(std::move(mesh));
  }
  for (std::size_t m = 0; m < own.members.size(); ++m) {
    const std::size_t member = at(own.members[m]);
    whole.phases.position_rad[member] = stage.phases.position_rad[m];
    // a gear on the carrier of another stage turns with that, and stands ahead of it
    if (whole.topology().is_carrier(static_cast<int>(member))) continue;
    whole.phases.member_rotation_rad[member] = stage.phases.member_rotation_rad[m];
  }
  for (std::size_t g = 0; g < stage.gears.size(); ++g) {
    const int member = stage.topology().gears[g].member;
    std::vector<double> ahead = stage.phases.gear_offset_rad[g];
    if (whole.topology().is_carrier(own.members[at(member)]))
      for (double& offset : ahead) offset += stage.phases.rotation_rad(member, 0);
    whole.phases.gear_offset_rad.push_back(std::move(ahead));
  }
  whole.assembly.equal_spacing = whole.assembly.equal_spacing && stage.assembly.equal_spacing;
  whole.assembly.identical_planets = whole.assembly.identical_planets && stage.assembly.identical_planets;
}

}  // namespace

std::vector<StageTopology> stage_topologies(const Topology& whole) {
  std::vector<std::vector<int>> members;
  for (int stage = 1; stage <= whole.stage_count(); ++stage) members.push_back(members_of(whole, stage));
  std::vector<StageTopology> stages;
  for (std::size_t s = 0; s < members.size(); ++s) {
    const int stage = static_cast<int>(s) + 1;
    StageTopology own{.topology = {.kind = whole.kind}, .members = members[s]};
    add_members(whole, stage, own);
    add_gears(whole, stage, own);
    for (const int fixed : whole.fixed)
      if (const int member = place_in(own.members, fixed); member != kNoMember) own.topology.fixed.push_back(member);
    const int input = place_in(own.members, whole.input), output = place_in(own.members, whole.output);
    own.topology.input = input == kNoMember ? shared_member(members, s, true) : input;
    own.topology.output = output == kNoMember ? shared_member(members, s, false) : output;
    stages.push_back(std::move(own));
  }
  return stages;
}

GearboxDesign stage_design(const GearboxDesign& design, int stage) {
  const StageTopology part = stage_topologies(design.topology)[at(stage - 1)];
  GearboxDesign own = design;
  own.later_stages.clear();
  own.topology = part.topology;
  const auto first = design.gears.begin() + part.first_gear;
  own.gears.assign(first, first + static_cast<std::ptrdiff_t>(part.topology.gears.size()));
  if (stage == 1) return own;
  const StageDesign& later = design.later_stages[at(stage - 2)];
  own.planets = later.planets;
  own.module_mm = later.module_mm.value_or(design.module_mm);
  own.centre_distance_mm = later.centre_distance_mm;
  return own;
}

void set_stage(const GearboxDesign& own, int stage, GearboxDesign& design) {
  const StageTopology part = stage_topologies(design.topology)[at(stage - 1)];
  GearboxDesign whole = own;
  whole.name = design.name;
  whole.topology = design.topology;
  whole.gears = design.gears;
  std::copy(own.gears.begin(), own.gears.end(), whole.gears.begin() + part.first_gear);
  whole.later_stages = design.later_stages;
  if (stage > 1) {
    StageDesign& later = whole.later_stages[at(stage - 2)];
    if (later.module_mm || own.module_mm != design.module_mm) later.module_mm = own.module_mm;
    later.planets = own.planets;
    later.centre_distance_mm = own.centre_distance_mm;
    whole.planets = design.planets;
    whole.module_mm = design.module_mm;
    whole.centre_distance_mm = design.centre_distance_mm;
  }
  design = std::move(whole);
}

std::string key_of_stage(const std::string& key, int stage) {
  constexpr std::string_view kTable = "gearbox.";
  if (stage < 2 || !key.starts_with(kTable)) return key;
  const std::string name = key.substr(kTable.size());
  const bool own = std::find(kOwnKeys.begin(), kOwnKeys.end(), name) != kOwnKeys.end();
  return own ? "stage" + std::to_string(stage) + "." + name : key;
}

TrainHeights heights_of(const GearTrain& train) {
  TrainHeights heights{1e300, -1e300};
  for (const TrainGear& gear : train.gears) {
    heights.lower_mm = std::min(heights.lower_mm, gear.z_lower_mm);
    heights.upper_mm = std::max(heights.upper_mm, gear.z_lower_mm + gear.face_width_mm);
  }
  for (const GearTrain* stage : train.each_stage())
    if (const auto carrier = carrier_layout(*stage)) {
      heights.lower_mm = std::min(heights.lower_mm, carrier->lower_plate.lower_mm);
      heights.upper_mm = std::max(heights.upper_mm, carrier->upper_plate.upper_mm);
    }
  return heights;
}

ResultAll<GearTrain> lay_out_stages(const GearboxDesign& design) {
  TRUEFLANK_EXPECTS(at(design.topology.stage_count()) == design.later_stages.size() + 1);
  const std::vector<StageTopology> parts = stage_topologies(design.topology);
  GearTrain whole;
  whole.design = design;
  whole.phases.position_rad.resize(design.topology.members.size());
  whole.phases.member_rotation_rad.assign(design.topology.members.size(), {0.0});
  Errors errors;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const int number = static_cast<int>(s) + 1;
    auto stage = lay_out(stage_design(design, number));
    if (!stage) {
      for (Error& error : stage.error()) {
        error.key = key_of_stage(error.key, number);
        const bool known = std::any_of(errors.begin(), errors.end(), [&](const Error& other) {
          return other.key == error.key && other.message == error.message;  // of what all stages share
        });
        if (!known) errors.push_back(std::move(error));
      }
      continue;
    }
    if (!whole.stages.empty())
      raise(*stage, heights_of(whole.stages.back()).upper_mm + design.layer_gap_mm - heights_of(*stage).lower_mm);
    whole.stages.push_back(std::move(*stage));
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  for (std::size_t s = 0; s < parts.size(); ++s) add_to_whole(whole.stages[s], parts[s], whole);
  whole.speeds = member_speeds(design.topology, signed_teeth(design));
  return whole;
}

}  // namespace trueflank
