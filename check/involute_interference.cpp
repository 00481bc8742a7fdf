// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/involute_interference.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

struct RollLengths {
  double gear1_mm = 0.0, gear2_mm = kNaN;  ///< at first and last contact; gear 2: external only
  [[nodiscard]] double smaller() const { return std::fmin(gear1_mm, gear2_mm); }
};

/// Of contact between two roll lengths of gear 1.
RollLengths roll_lengths(const GearPair& pair, double start_mm, double end_mm) {
  RollLengths rolls{start_mm, kNaN};
  if (!pair.internal())
    rolls.gear2_mm = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair)) - end_mm;
  return rolls;
}

/// Of contact up to the tips. A ring's tip circle inside its base circle meets the base circle's tangent
/// nowhere: then the involute's own end, on the base circle, is what comes first.
RollLengths roll_lengths(const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  return roll_lengths(pair, line.start_mm, line.end_mm);
}

std::string rolls_text(const RollLengths& rolls, const std::string& name1, const std::string& name2) {
  std::string text = "roll length where the tip of " + name2 + " meets " + name1 + " " +
                     mm_text(rolls.gear1_mm);
  if (!std::isnan(rolls.gear2_mm))
    text += ", where the tip of " + name1 + " meets " + name2 + " " + mm_text(rolls.gear2_mm);
  return text;
}

Finding involute_interference_finding(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const GearPair pair = train.pair(mesh);
  const ActivePath path = active_path(train, mesh);
  const RollLengths rolls = roll_lengths(pair, path.start_mm, path.end_mm);
  const RollLengths to_the_tips = roll_lengths(pair);
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  Finding finding{.id = "involute_interference",
                  .where = mesh.name,
                  .value = rolls.smaller(),
                  .limit = 0.0,
                  .margin = rolls.smaller(),
                  .unit = "mm"};
  finding.message = rolls_text(to_the_tips, name1, name2);
  const bool relieved = rolls.smaller() > to_the_tips.smaller();
  if (relieved)
    finding.message += "; the modified flanks touch without load from " + mm_text(rolls.smaller());
  if (to_the_tips.smaller() >= 0.0) return finding;
  const bool penetrates = state.centred.clearance_mm < -tolerance::kTouch_mm;
  finding.message += penetrates ? "; below the base circle there is no involute, and the exact "
                                  "profiles penetrate by " +
                                      um_text(state.centred.penetration_mm())
                                : "; below the base circle there is no involute, but the exact "
                                  "profiles clear each other by " +
                                      um_text(state.centred.clearance_mm);
  if (!penetrates && rolls.smaller() >= 0.0 &&
      !(state.driving.clearance_mm < -tolerance::kTouch_mm))
    return finding;
  finding.status = penetrates ? CheckStatus::kFail : CheckStatus::kWarn;
  // where the reliefs do not keep it clear, the whole flank counts
  if (rolls.smaller() >= 0.0) finding.value = finding.margin = to_the_tips.smaller();
  const bool tip_of_gear1 = to_the_tips.gear2_mm < to_the_tips.gear1_mm;
  finding.cure = cure_text(train, mesh, tip_of_gear1, {.exact = [](const GearPair& changed) {
    return roll_lengths(changed).smaller();
  }});
  return finding;
}

}  // namespace

Findings check_involute_interference(const GearTrain& train,
                                     const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "involute_interference",
                       [&](const GearTrain& t, const TrainMesh& mesh) {
                         return involute_interference_finding(t, mesh, states[i++]);
                       });
}

}  // namespace trueflank
