// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/design_tolerances.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/mesh_clearance.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank {
namespace {

bool inside_scope(const GearTrain& train, int tolerance_class) {
  return std::all_of(train.gears.begin(), train.gears.end(), [&](const TrainGear& gear) {
    return flank_tolerances(tolerance_size(gear.profile.gear(), gear.face_width_mm), tolerance_class).has_value();
  });
}

std::string text_of(const ToleranceOptions& o) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (o.tolerance_class) add("ISO class " + std::to_string(*o.tolerance_class));
  if (o.runout_um.value_or(0.0) > 0.0) add("runout " + number_text(*o.runout_um, 2) + " um");
  if (o.centre_distance_um > 0.0) add("axes +-" + number_text(o.centre_distance_um, 2) + " um");
  if (o.tooth_thickness_um > 0.0) add("tooth thickness +-" + number_text(o.tooth_thickness_um, 2) + " um");
  return text;
}

/// What only the process says is typical: sets that jam warn, and limits that no set in hundreds meets pass.
void soften(Finding& finding) {
  if (finding.status == CheckStatus::kWarn) {
    finding.status = CheckStatus::kPass;
    finding.cure.clear();
  }
  if (finding.status == CheckStatus::kFail) finding.status = CheckStatus::kWarn;
}

}  // namespace

std::optional<DesignTolerances> design_tolerances(const GearTrain& train) {
  const MadeDesign& made = train.design.made;
  const Process process = made.process.value_or(Process{});
  DesignTolerances result;
  ToleranceOptions& o = result.options;
  result.asked = made.tolerance_class || made.axis_tolerance_mm || made.thickness_tolerance_mm;
  o.centre_distance_um = um_from_mm(made.axis_tolerance_mm.value_or(process.axis_tolerance_mm));
  o.tooth_thickness_um = um_from_mm(made.thickness_tolerance_mm.value_or(process.thickness_tolerance_mm));
  if (made.tolerance_class)
    o.tolerance_class = made.tolerance_class;
  else if (process.tolerance_class > 0 && inside_scope(train, process.tolerance_class))
    o.tolerance_class = process.tolerance_class;
  else if (process.runout_mm > 0.0)
    o.runout_um = um_from_mm(process.runout_mm);
  result.text = text_of(o);
  if (result.text.empty()) return std::nullopt;
  return result;
}

Findings check_design_tolerance(const GearTrain& train) {
  const auto tolerances = design_tolerances(train);
  if (!tolerances || train.meshes.empty()) return {};
  const auto result = analyse_tolerances(train, tolerances->options);
  if (!result)
    return {{.id = "tolerance",
             .where = "train",
             .status = CheckStatus::kNotApplicable,
             .message = tolerances->text + ": " + result.error().message + "; " + result.error().remedy}};
  Findings findings = check_tolerance(train, *result);
  for (Finding& finding : findings) {
    finding.message = tolerances->text + ": " + finding.message;
    if (!tolerances->asked) soften(finding);
  }
  return findings;
}

double lacking_backlash_mm(const GearTrain& train) {
  const auto tolerances = design_tolerances(train);
  if (!tolerances || !tolerances->asked || train.meshes.empty()) return 0.0;
  const auto result = analyse_tolerances(train, tolerances->options);
  if (!result || verdict(check_tolerance(train, *result)) != CheckStatus::kFail) return 0.0;
  double lacking = 0.0;
  for (std::size_t k = 0; k < result->meshes.size(); ++k) {
    const MeshTolerance& mesh = result->meshes[k];
    // what stands in the way without any tolerance is not for backlash to clear
    const double in_the_way = mesh.smallest_clearance_mm < 0.0
                                  ? std::min(0.0, sweep_clearance_mm(train.pair(train.meshes[k])))
                                  : 0.0;
    lacking = std::max({lacking, -mesh.smallest_backlash_mm,
                        -2.0 * (mesh.smallest_clearance_mm - in_the_way)});
  }
  return lacking;
}

double lacking_for_clearance_mm(const GearTrain& train) {
  const double asked = train.design.made.clearance_mm.value_or(0.0);
  double lacking = 0.0;
  if (asked > 0.0)
    for (const TrainMesh& mesh : train.meshes) {
      const GearPair pair = train.pair(mesh);
      const double normal = std::cos(working_pressure_angle_rad(pair)) * std::cos(base_helix_angle_rad(pair.gear1()));
      lacking = std::max(lacking, 2.0 * asked / normal - mesh.backlash_mm);
    }
  return lacking;
}

}  // namespace trueflank
