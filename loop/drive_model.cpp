// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive_model.h"

#include <cmath>
#include <memory>

#include "trueflank/train/efficiency.h"

namespace trueflank::loop {
namespace {

/// A wave of order n on a gear is met n times per turn of that gear against its mates' place: the
/// carrier for sun and rings, so a planet's counts against the carrier too.
std::vector<MemberOrder> member_orders(const GearTrain& train) {
  const MemberSpeeds w = member_speeds(train);
  std::vector<MemberOrder> orders;
  const auto add = [&](const std::string& member, double order) {
    order = std::abs(order);
    if (!std::isfinite(order) || order < 1e-6) return;
    orders.push_back({member, order});
  };
  add("input shaft", 1.0);
  add("input shaft, twice", 2.0);
  const std::string name1 = train.design.kind == TrainKind::k3k ? "ring1" : "ring";
  switch (train.design.kind) {
    case TrainKind::k3k:
    case TrainKind::kSimple: {
      const int planets = train.design.planets;
      const int teeth = train.gears[0].profile.gear().teeth;
      add("sun against the carrier", 1.0 - w.carrier);
      add("sun against the carrier, twice", 2.0 * (1.0 - w.carrier));
      add("planets passing the sun", planets * (1.0 - w.carrier));
      add("carrier", w.carrier);
      add("carrier, twice", 2.0 * w.carrier);
      add("planet against the carrier", w.planet - w.carrier);
      add("planet against the carrier, twice", 2.0 * (w.planet - w.carrier));
      add(name1 + " against the carrier", w.ring1 - w.carrier);
      add("planets passing " + name1, planets * (w.ring1 - w.carrier));
      add("mesh of sun and planets", teeth * (1.0 - w.carrier));
      if (train.design.kind == TrainKind::k3k) {
        add("ring2 against the carrier", w.ring2 - w.carrier);
        add("planets passing ring2", planets * (w.ring2 - w.carrier));
        add("mesh of planets and ring2",
            train.find("ring2")->profile.gear().teeth * (w.ring2 - w.carrier));
      }
      add("output", w.output);
      break;
    }
    case TrainKind::kPair:
      add("wheel", w.output);
      add("wheel, twice", 2.0 * w.output);
      add("mesh", train.gears[0].profile.gear().teeth);
      break;
    case TrainKind::kGear: break;
  }
  // Of orders that coincide the first name stands, with the other beside it.
  std::vector<MemberOrder> distinct;
  for (const MemberOrder& order : orders) {
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
  if (train.design.kind == TrainKind::kGear)
    return fail({.code = ErrorCode::kUsage,
                 .message = "bench data belong to a drive, and this design is a single gear",
                 .key = "gearbox.kind",
                 .value = "gear",
                 .remedy = "a design of kind 3k, simple or pair"});
  const double output = member_speeds(train).output;
  if (!std::isfinite(output) || output == 0.0)
    return fail({.code = ErrorCode::kInfeasible,
                 .message = "the output of this design stands still: it has no efficiency",
                 .remedy = "other tooth numbers"});
  DriveModel model;
  model.ratio = std::abs(1.0 / output);
  model.friction = train.design.friction;
  model.losses = train.design.losses;
  for (const TrainMesh& mesh : train.meshes) model.meshes.push_back(mesh.name);
  const auto copy = std::make_shared<const GearTrain>(train);
  model.efficiency = [copy](const std::vector<double>& friction) {
    const EfficiencyResult result =
        trueflank::efficiency(*copy, {.model = LossModel::kContactRatios, .mesh_friction = friction});
    return DriveEfficiency{result.forward_locking ? 0.0 : result.forward,
                           result.self_locking ? 0.0 : result.backward};
  };
  model.orders = member_orders(train);
  return model;
}

}  // namespace trueflank::loop
