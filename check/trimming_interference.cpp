// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/trimming_interference.h"

#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/check/ring_criteria.h"

namespace trueflank {
namespace {

std::string axial_text(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  if (state.centred.clearance_mm < -tolerance::kTouch_mm)
    return " Axially it does not go in either: the profiles penetrate.";
  if (train.design.herringbone)
    return is_made_in_halves(train.design, train.design.gears[static_cast<std::size_t>(mesh.gear2)])
               ? " Axially each half of the ring goes on from its side."
               : " A herringbone cannot go in axially: the ring must be split (halves = true).";
  return " It goes in axially.";
}

Finding trimming_interference_finding(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const GearPair pair = train.pair(mesh);
  Finding finding{.id = "trimming_interference", .where = mesh.name, .limit = 0.0, .unit = "deg"};
  if (!pair.internal()) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "an external pair";
    return finding;
  }
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  const double margin = worst_margin_rad(train, mesh, trimming_margin_rad);
  const RadialRemoval& removal = *state.removal;
  if (std::isnan(margin)) {
    const double excess = pair.profile2->tip_radius_mm() - pair.profile1->tip_radius_mm();
    finding.value = finding.margin = excess;
    finding.unit = "mm";
    finding.message = "the tip circle of " + name1 + " exceeds that of " + name2 + " by " +
                      mm_text(-excess) + " (radius): it cannot leave radially at any rotation.";
  } else {
    finding.value = finding.margin = deg_from_rad(margin);
    finding.message = name1 + " can leave " + name2 + " radially at " +
                      (removal.at_every_rotation ? std::string("every rotation")
                       : removal.at_some_rotation
                           ? number_text(100.0 * removal.free_share, 0) + " % of the rotations"
                           : std::string("no rotation")) +
                      "; margin of the textbook criterion " + deg_text(margin) +
                      " of the ring's rotation.";
  }
  if (removal.at_every_rotation) return finding;
  finding.status = CheckStatus::kWarn;
  finding.message += axial_text(train, mesh, state);
  const double unmodified = trimming_margin_rad(pair);
  const double cost = std::isnan(unmodified) ? 0.0 : unmodified - margin;  // of the modifications
  const PairMargin wanted = [cost](const GearPair& changed) {
    return changed.internal() ? trimming_margin_rad(changed) - cost : kNaN;
  };
  finding.cure = margin >= 0.0 ? "axial assembly; or more teeth between pinion and ring"
                               : "axial assembly; or " + cure_text(train, mesh, true, {.exact = wanted});
  return finding;
}

}  // namespace

Findings check_trimming_interference(const GearTrain& train,
                                     const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "trimming_interference",
                       [&](const GearTrain& t, const TrainMesh& mesh) {
                         return trimming_interference_finding(t, mesh, states[i++]);
                       });
}

}  // namespace trueflank
