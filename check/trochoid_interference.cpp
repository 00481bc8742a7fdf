// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/trochoid_interference.h"

#include <cmath>
#include <limits>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/check/ring_criteria.h"

namespace trueflank {
namespace {

Finding trochoid_interference_finding(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const GearPair pair = train.pair(mesh);
  Finding finding{.id = "trochoid_interference", .where = mesh.name, .limit = 0.0, .unit = "deg"};
  if (!pair.internal()) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "an external pair";
    return finding;
  }
  const double margin = worst_margin_rad(train, mesh, trochoid_margin_rad);
  if (std::isinf(margin)) {
    finding.message = "the tip circles do not cross";
    return finding;
  }
  finding.value = finding.margin = deg_from_rad(margin);
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  finding.message =
      std::isnan(margin)
          ? "the tip circle of " + name1 + " lies all around that of " + name2 +
                ": the criterion does not exist, the teeth are in reach all the way round"
          : "where the tip circles cross, the tip of " + name1 +
                (margin >= 0.0 ? " passes" : " runs into") + " the tip of " + name2 + " by " +
                deg_text(std::abs(margin)) + " of the ring's rotation";
  if (margin >= -tolerance::kAngle_rad) return finding;
  const bool penetrates = state.centred.clearance_mm < -tolerance::kTouch_mm;
  finding.status = penetrates ? CheckStatus::kFail : CheckStatus::kWarn;
  finding.message += penetrates ? "; the exact profiles penetrate by " +
                                      um_text(state.centred.penetration_mm())
                                : "; the exact profiles clear each other by " +
                                      um_text(state.centred.clearance_mm);
  const double cost = trochoid_margin_rad(pair) - margin;  // of the modifications
  finding.cure = cure_text(train, mesh, true, {.exact = [cost](const GearPair& changed) {
    return changed.internal() ? trochoid_margin_rad(changed) - cost : kNaN;
  }});
  return finding;
}

}  // namespace

Findings check_trochoid_interference(const GearTrain& train,
                                     const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "trochoid_interference",
                       [&](const GearTrain& t, const TrainMesh& mesh) {
                         return trochoid_interference_finding(t, mesh, states[i++]);
                       });
}

}  // namespace trueflank
