// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_model.h"

#include <cmath>
#include <memory>

#include "trueflank/train/efficiency.h"

namespace trueflank::loop {
namespace {

/// Orders by their names; each also twice where a shaft's own errors show so.
class Orders {
 public:
  void add(const std::string& member, double order) {
    order = std::abs(order);
    if (!std::isfinite(order) || order < 1e-6) return;
    all.push_back({member, order});
  }
  void add_twice(const std::string& member, double order) {
    add(member, order);
    add(member + ", twice", 2.0 * order);
  }

  std::vector<MemberOrder> all;
};

/// A wave of order n on a gear is met n times per turn of that gear against its mates' place: the
/// carrier for sun and rings, so a planet's counts against the carrier too. `planet`: the set's body.
void add_planet_set(const GearTrain& train, int planet, Orders& orders) {
  const Topology& topology = train.topology();
  const std::vector<double>& w = train.speeds.of;
  const TopologyGear& lowest = topology.gears[static_cast<std::size_t>(topology.first_gear_of(planet))];
  const bool one_set = train.stages.empty();
  const int planets = train.copies_of(planet), arm = topology.carrier_of(planet);
  const double carrier = train.speeds.of_arm(arm);
  const std::string carrier_name = one_set ? "carrier" : topology.name_of(arm);
  const std::string planet_name = one_set ? "planet" : topology.name_of(planet);
  const std::string set_name = one_set ? "planets" : "planets of stage " + std::to_string(lowest.stage);
  const TrainGear* first = nullptr;
  double first_against = 0.0;
  int central = 0;
  // the gears on the train's own axis in their order, carrier and planets after the first of them
  for (std::size_t g = 0; g < train.gears.size(); ++g) {
    if (topology.is_planet_gear(g) || topology.gears[g].stage != lowest.stage) continue;
    const TrainGear& gear = train.gears[g];
    const double against = w[static_cast<std::size_t>(topology.gears[g].member)] - carrier;
    if (++central == 1) {
      first = &gear;
      first_against = against;
      orders.add_twice(gear.name + " against the " + carrier_name, against);
      orders.add(set_name + " passing the " + gear.name, planets * against);
      orders.add_twice(carrier_name, carrier);
      orders.add_twice(planet_name + " against the " + carrier_name, w[static_cast<std::size_t>(planet)] - carrier);
      continue;
    }
    orders.add(gear.name + " against the " + carrier_name, against);
    orders.add(set_name + " passing " + gear.name, planets * against);
    if (central == 2)
      orders.add("mesh of " + first->name + " and " + set_name, first->profile.gear().teeth * first_against);
    if (gear.layer > lowest.layer)
      orders.add("mesh of " + set_name + " and " + gear.name, gear.profile.gear().teeth * against);
  }
}

std::vector<MemberOrder> member_orders(const GearTrain& train) {
  const Topology& topology = train.topology();
  Orders orders;
  orders.add_twice("input shaft", 1.0);
  for (std::size_t m = 0; m < topology.members.size(); ++m)
    if (topology.is_planet(static_cast<int>(m))) add_planet_set(train, static_cast<int>(m), orders);
  if (topology.has_planets()) {
    orders.add("output", train.speeds.output);
  } else {
    orders.add_twice(topology.name_of(topology.output), train.speeds.output);
    orders.add("mesh", train.gears[0].profile.gear().teeth);
  }
  // Of orders that coincide the first name stands, with the other beside it.
  std::vector<MemberOrder> distinct;
  for (const MemberOrder& order : orders.all) {
    bool known = false;
    for (MemberOrder& other : distinct)
      if (std::abs(other.order - order.order) < 1e-6) {
        other.member += " or " + order.member;
        known = true;
      }
    if (!known) distinct.push_back(order);
  }
  return distinct;
}

}  // namespace

Result<DriveModel> drive_model(const GearTrain& train) {
  if (train.meshes.empty())
    return fail({.code = ErrorCode::kUsage,
                 .message = "bench data belong to a drive, and this design is a single gear",
                 .key = "gearbox.kind",
                 .value = train.topology().kind,
                 .remedy = "a design of a drive: two gears or more"});
  const double output = train.speeds.output;
  if (!std::isfinite(output) || output == 0.0)
    return fail({.code = ErrorCode::kInfeasible,
                 .message = "the output of this design stands still: it has no efficiency",
                 .remedy = "other tooth numbers"});
  for (const MeshEfficiency& mesh : trueflank::efficiency(train).meshes)
    if (std::isnan(mesh.by_path_integral))
      return fail({.code = ErrorCode::kInfeasible,
                   .message = "contact is interrupted in " + mesh.name + ": the drive has no efficiency",
                   .remedy = "a design that passes the check contact_ratio"});
  DriveModel model;
  model.ratio = std::abs(1.0 / output);
  model.friction = train.design.friction;
  model.losses = train.design.losses;
  for (const TrainMesh& mesh : train.meshes) model.meshes.push_back(mesh.name);
  const auto copy = std::make_shared<const GearTrain>(train);
  model.efficiency = [copy](const std::vector<double>& friction) {
    const EfficiencyResult result = trueflank::efficiency(*copy, {.mesh_friction = friction});
    return DriveEfficiency{result.forward_locking ? 0.0 : result.forward,
                           result.self_locking ? 0.0 : result.backward};
  };
  model.orders = member_orders(train);
  return model;
}

}  // namespace trueflank::loop
