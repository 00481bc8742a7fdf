// SPDX-License-Identifier: GPL-3.0-or-later
//
// Willis: seen from the carrier every mesh runs at the inverse ratio of its teeth.
#include <cmath>

#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

double teeth(const GearTrain& train, const char* name) {
  return train.find(name)->profile.gear().teeth;
}

MemberSpeeds speeds_3k(const GearTrain& train) {
  const double z_s = teeth(train, "sun"), z_p1 = teeth(train, "planet1"),
               z_r1 = teeth(train, "ring1"), z_p2 = teeth(train, "planet2"),
               z_r2 = teeth(train, "ring2");
  MemberSpeeds w;
  if (train.design.output == OutputMember::kRing1) {
    w.carrier = z_s / (z_s + z_p1 * z_r2 / z_p2);
    w.planet = w.carrier * (1.0 - z_r2 / z_p2);
    w.ring1 = w.carrier + z_p1 / z_r1 * (w.planet - w.carrier);
    w.output = w.ring1;
  } else {
    w.carrier = z_s / (z_s + z_r1);
    w.planet = w.carrier * (1.0 - z_r1 / z_p1);
    w.ring2 = w.carrier * (1.0 - z_r1 * z_p2 / (z_p1 * z_r2));
    w.output = w.ring2;
  }
  return w;
}

MemberSpeeds speeds_simple(const GearTrain& train) {
  const double z_s = teeth(train, "sun"), z_p = teeth(train, "planet"), z_r = teeth(train, "ring");
  MemberSpeeds w;
  if (train.design.output == OutputMember::kRing) {
    w.planet = -z_s / z_p;
    w.ring1 = -z_s / z_r;
    w.output = w.ring1;
  } else {
    w.carrier = z_s / (z_s + z_r);
    w.planet = w.carrier * (1.0 - z_r / z_p);
    w.output = w.carrier;
  }
  return w;
}

}  // namespace

MemberSpeeds member_speeds(const GearTrain& train) {
  switch (train.design.kind) {
    case TrainKind::k3k: return speeds_3k(train);
    case TrainKind::kSimple: return speeds_simple(train);
    case TrainKind::kPair: {
      MemberSpeeds w;
      const bool internal = train.find("wheel")->profile.gear().kind == GearKind::kInternal;
      w.ring1 = (internal ? 1.0 : -1.0) * teeth(train, "pinion") / teeth(train, "wheel");
      w.output = w.ring1;
      return w;
    }
    case TrainKind::kGear: return {};
  }
  return {};
}

AssemblyPhases turned(const GearTrain& train, double sun_turn_rad) {
  AssemblyPhases phases = train.phases;
  const MemberSpeeds w = member_speeds(train);
  phases.sun_rotation_rad += sun_turn_rad;
  phases.ring1_rotation_rad += w.ring1 * sun_turn_rad;
  phases.ring2_rotation_rad += w.ring2 * sun_turn_rad;
  for (double& position : phases.planet_position_rad) position += w.carrier * sun_turn_rad;
  for (double& rotation : phases.planet_rotation_rad) rotation += w.planet * sun_turn_rad;
  return phases;
}

}  // namespace trueflank
