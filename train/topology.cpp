// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/topology.h"

#include <algorithm>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

template <class Named>
int index_of(const std::vector<Named>& list, std::string_view name) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const Named& n) { return n.name == name; });
  return it == list.end() ? -1 : static_cast<int>(it - list.begin());
}

/// Indices above the one taken out move down by one.
void close_gap(int& index, int removed) {
  if (index > removed) --index;
}

Topology without_member(Topology topology, int member) {
  topology.members.erase(topology.members.begin() + member);
  for (TopologyAxis& axis : topology.axes) close_gap(axis.carrier, member);
  for (TopologyGear& gear : topology.gears) close_gap(gear.member, member);
  std::erase(topology.fixed, member);
  for (int& fixed : topology.fixed) close_gap(fixed, member);
  close_gap(topology.input, member);
  close_gap(topology.output, member);
  return topology;
}

}  // namespace

bool Topology::is_carrier(int member) const {
  return std::any_of(axes.begin(), axes.end(),
                     [&](const TopologyAxis& axis) { return axis.carrier == member; });
}

bool Topology::has_planets() const { return first_planet() != kNoMember; }

int Topology::arm_of(const TopologyMesh& mesh) const {
  const int carrier1 = carrier_of(gears[static_cast<std::size_t>(mesh.gear1)].member);
  const int carrier2 = carrier_of(gears[static_cast<std::size_t>(mesh.gear2)].member);
  TRUEFLANK_EXPECTS(carrier1 == carrier2 || carrier1 == kHousing || carrier2 == kHousing);
  return carrier1 == kHousing ? carrier2 : carrier1;
}

std::vector<int> Topology::gears_of(int member) const {
  std::vector<int> own;
  for (std::size_t i = 0; i < gears.size(); ++i)
    if (gears[i].member == member) own.push_back(static_cast<int>(i));
  return own;
}

int Topology::find_member(std::string_view name) const { return index_of(members, name); }

int Topology::find_gear(std::string_view name) const { return index_of(gears, name); }

int Topology::first_planet() const {
  for (std::size_t m = 0; m < members.size(); ++m)
    if (is_planet(static_cast<int>(m))) return static_cast<int>(m);
  return kNoMember;
}

int Topology::stage_count() const { return gears.empty() ? 1 : gears.back().stage; }

std::string Topology::name_of(int member) const {
  return member == kNoMember ? "" : members[static_cast<std::size_t>(member)].name;
}

std::string Topology::mesh_name(const TopologyMesh& mesh) const {
  return gears[static_cast<std::size_t>(mesh.gear1)].name + "-" +
         gears[static_cast<std::size_t>(mesh.gear2)].name;
}

Topology without_gear(const Topology& topology, int gear) {
  Topology rest = topology;
  const int member = topology.gears[static_cast<std::size_t>(gear)].member;
  std::erase_if(rest.meshes,
                [&](const TopologyMesh& mesh) { return mesh.gear1 == gear || mesh.gear2 == gear; });
  for (TopologyMesh& mesh : rest.meshes) {
    close_gap(mesh.gear1, gear);
    close_gap(mesh.gear2, gear);
  }
  rest.gears.erase(rest.gears.begin() + gear);
  return rest.gears_of(member).empty() ? without_member(std::move(rest), member) : rest;
}

std::vector<bool> idle_meshes(const Topology& topology) {
  std::vector<bool> idle(topology.meshes.size(), false);
  const auto has_torque = [&](int member) {
    return member == topology.input || member == topology.output || topology.is_carrier(member) ||
           std::find(topology.fixed.begin(), topology.fixed.end(), member) != topology.fixed.end();
  };
  // a body behind an idle mesh may idle as well
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t m = 0; m < topology.members.size(); ++m) {
      if (has_torque(static_cast<int>(m))) continue;
      int loaded = 0;
      std::size_t last = 0;
      for (std::size_t k = 0; k < topology.meshes.size(); ++k) {
        const TopologyMesh& mesh = topology.meshes[k];
        const bool own = topology.gears[static_cast<std::size_t>(mesh.gear1)].member == static_cast<int>(m) ||
                         topology.gears[static_cast<std::size_t>(mesh.gear2)].member == static_cast<int>(m);
        if (!own || idle[k]) continue;
        ++loaded;
        last = k;
      }
      if (loaded != 1) continue;
      idle[last] = changed = true;
    }
  }
  return idle;
}

}  // namespace trueflank
