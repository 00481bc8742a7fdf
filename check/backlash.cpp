// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/backlash.h"

#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

Finding backlash_finding(const GearTrain& train, const TrainMesh& mesh) {
  const ModifiedMesh modified = modified_mesh(train, mesh);
  const double backlash = modified.backlash_mm;
  const GearPair pair = train.pair(mesh);
  const double normal = backlash * std::cos(working_pressure_angle_rad(pair)) *
                        std::cos(base_helix_angle_rad(pair.gear1()));
  Finding finding{.id = "backlash",
                  .where = mesh.name,
                  .value = backlash,
                  .limit = 0.0,
                  .margin = backlash,
                  .unit = "mm"};
  finding.message = "circumferential backlash " + number_text(backlash, 5) +
                    " mm at the working pitch circle, " + um_text(normal) + " normal to the flanks";
  if (modified.modified)
    finding.message += ", the smallest that the modifications leave (" +
                       number_text(mesh.backlash_mm, 5) + " mm without them)";
  if (backlash >= -tolerance::kTouch_mm) {
    if (backlash < tolerance::kTouch_mm) finding.message += ": no play for errors of manufacture";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  finding.message += ": the flanks overlap";
  // thinning on the reference circle grows by the ratio of the radii
  const double needed = -backlash * reference_radius_mm(pair.gear1()) / pitch_radius1_mm(pair);
  finding.cure = "teeth thinned by another " + bound_text(um_from_mm(needed), Rounded::kUp, 2) + " um" +
                 " on the reference circle (both gears together)";
  return finding;
}

}  // namespace

Findings check_backlash(const GearTrain& train) { return for_each_mesh(train, "backlash", backlash_finding); }

}  // namespace trueflank
