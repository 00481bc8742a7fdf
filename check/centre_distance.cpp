// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/centre_distance.h"

#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Shifts and centre distances written with four decimals agree with themselves no better than this.
constexpr double kWrittenRounding = 1e-4;  // of the module
constexpr double kLargestImpliedBacklash = 0.25;  // of the module

/// Cure: the shift of gear 2 at which nothing is implied, and the centre distance likewise.
std::string cure_of(const GearPair& pair, const std::string& name2) {
  const MeshTeeth mesh = mesh_teeth(pair);
  const double x1 = pair.gear1().shift, x2 = pair.gear2().shift;
  const double wanted = shift_sum(mesh, working_pressure_angle_rad(pair));
  const double shift2 = mesh.internal ? wanted + x1 : wanted - x1;
  std::string cure = "shift of " + name2 + " " + number_text(shift2, 5) + " (" +
                     (shift2 > x2 ? "+" : "") + number_text(shift2 - x2, 5) + ")";
  const auto distance = zero_backlash_centre_distance_mm(mesh, mesh.internal ? x2 - x1 : x1 + x2);
  if (distance) cure += ", or centre distance " + number_text(*distance, 5) + " mm";
  return cure + "; or leave one shift out, it is then solved";
}

Finding centre_distance_finding(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  const double m = pair.gear1().normal_module_mm;
  const double implied = mesh.implied_backlash_mm;
  const double largest = kLargestImpliedBacklash * m;
  const bool tight = implied < -kWrittenRounding * m, loose = implied > largest;
  Finding finding{.id = "centre_distance",
                  .where = mesh.name,
                  .value = implied,
                  .limit = loose ? largest : 0.0,
                  .margin = loose ? largest - implied : implied,
                  .unit = "mm"};
  finding.message = "at centre distance " + mm_text(pair.centre_distance_mm) +
                    " the profile shifts imply a backlash of " + number_text(implied, 5) + " mm";
  if (!tight && !loose) return finding;
  finding.status = CheckStatus::kFail;
  finding.message += tight ? ": the teeth overlap" : ": more than a quarter of the module";
  finding.cure = cure_of(pair, gear2_name(train, mesh));
  return finding;
}

}  // namespace

Findings check_centre_distance(const GearTrain& train) {
  return for_each_mesh(train, "centre_distance", centre_distance_finding);
}

}  // namespace trueflank
