// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/tip_clearance.h"

#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

constexpr double kWantedClearance = 0.1;  // of the module
/// Standard tips have equal clearances but for rounding: of these the first is named.
constexpr double kEqualClearance_mm = 1e-9;

Finding tip_clearance_finding(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  const double of1 = tip_clearance_of_gear1_mm(pair), of2 = tip_clearance_of_gear2_mm(pair);
  const bool first = of1 <= of2 + kEqualClearance_mm;
  const double smaller = first ? of1 : of2;
  const double wanted = kWantedClearance * pair.gear1().normal_module_mm;
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  const double limit = smaller < 0.0 ? 0.0 : wanted;
  Finding finding{.id = "tip_clearance",
                  .where = mesh.name,
                  .value = smaller,
                  .limit = limit,
                  .margin = smaller - limit,
                  .unit = "mm"};
  finding.message = "tip of " + name1 + " to root of " + name2 + " " + mm_text(of1) + ", tip of " +
                    name2 + " to root of " + name1 + " " + mm_text(of2);
  if (smaller >= wanted) return finding;
  finding.status = smaller < 0.0 ? CheckStatus::kFail : CheckStatus::kWarn;
  const ToothProfile& tip = first ? *pair.profile1 : *pair.profile2;
  const double change = wanted - smaller;
  const bool external = tip.gear().kind == GearKind::kExternal;
  finding.cure = "a tip diameter of " + (first ? name1 : name2) + " of " +
                 bound_text(2.0 * (tip.tip_radius_mm() + (external ? -change : change)),
                            external ? Rounded::kDown : Rounded::kUp) +
                 (external ? " mm (" : " mm (+") + mm_text(external ? -2.0 * change : 2.0 * change) +
                 ") gives " + mm_text(wanted);
  return finding;
}

}  // namespace

Findings check_tip_clearance(const GearTrain& train) {
  return for_each_mesh(train, "tip_clearance", tip_clearance_finding);
}

}  // namespace trueflank
