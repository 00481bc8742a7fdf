// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/overlap.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Whose tip it is that goes too deep: the piece nearer to its own tip circle; of equals that of
/// gear 2.
bool tip_is_of_gear1(const GearPair& pair, const MeshPlace& place) {
  const double depth1 = std::abs(place.radius1_mm - pair.profile1->tip_radius_mm());
  const double depth2 = std::abs(place.radius2_mm - pair.profile2->tip_radius_mm());
  return depth1 < depth2;
}

/// Unmodified teeth that clear by what modifications cost.
CureMargin margin_beyond(double cost_mm) {
  const double less_mm = tolerance::kTouch_mm - cost_mm;
  return {
      .exact = [less_mm](const GearPair& changed) { return sweep_clearance_mm(changed) + less_mm; },
      .quick = [less_mm](const GearPair& changed) { return tips_clear(changed, -less_mm); }};
}

/// A slope reaches its amount at the tip, so a shorter tooth has it nearer to its root: what
/// modifications cost is asked again where the cured tip would be.
double cost_at_cured_tip_mm(const GearTrain& train, const TrainMesh& mesh, bool of_gear1,
                            double cost_mm) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const auto radius = tip_radius_cure_mm(train.pair(mesh), of_gear1, margin_beyond(cost_mm));
    if (!radius) break;
    GearboxDesign design = train.design;
    design.gears[static_cast<std::size_t>(of_gear1 ? mesh.gear1 : mesh.gear2)].tip_diameter_mm =
        2.0 * *radius;
    const auto cured = lay_out(design);
    if (!cured) break;
    const TrainMesh& same = cured->meshes[static_cast<std::size_t>(&mesh - train.meshes.data())];
    const double there =
        sweep_clearance_mm(cured->pair(same)) - modified_clearance_mm(*cured, same);
    if (there <= cost_mm) break;
    cost_mm = there;
  }
  return cost_mm;
}

std::string cure_of(const GearTrain& train, const TrainMesh& mesh, const MeshClearance& centred) {
  const GearPair pair = train.pair(mesh);
  const double unmodified =
      is_modified(train, mesh) ? sweep_clearance_mm(pair) : centred.clearance_mm;
  if (is_modified(train, mesh) && unmodified > -tolerance::kTouch_mm)
    return "without their modifications these teeth clear each other: smaller slopes, or "
           "backlash_mm "
           "larger by " +
           number_text(-2.0 * centred.clearance_mm / std::cos(working_pressure_angle_rad(pair)));
  const double backlash = circumferential_backlash_mm(pair);
  if (backlash < -tolerance::kTouch_mm)
    return "teeth thinned by " +
           um_text(-backlash * reference_radius_mm(pair.gear1()) / pitch_radius1_mm(pair)) +
           " on the reference circle (both gears together), or shifts that fit the centre distance";
  const bool of_gear1 = tip_is_of_gear1(pair, centred.place);
  double cost = std::max(0.0, unmodified - centred.clearance_mm);
  if (is_modified(train, mesh)) cost = cost_at_cured_tip_mm(train, mesh, of_gear1, cost);
  return cure_text(train, mesh, of_gear1, margin_beyond(cost));
}

/// Flanks part by half of the backlash, seen along their normal; a root that is nearer needs
/// another tip or shift.
std::string cure_of_clearance(const GearTrain& train, const TrainMesh& mesh, double clearance,
                              double asked) {
  const GearPair pair = train.pair(mesh);
  const double per_backlash = 0.5 * std::cos(working_pressure_angle_rad(pair)) *
                              std::cos(base_helix_angle_rad(pair.gear1()));
  return "backlash_mm larger by at least " + number_text((asked - clearance) / per_backlash, 4);
}

Finding judge(const GearTrain& train, const TrainMesh& mesh, const MeshClearance& centred) {
  const double clearance = centred.clearance_mm;
  Finding finding{.id = "overlap",
                  .where = mesh.name,
                  .value = um_from_mm(clearance),
                  .limit = 0.0,
                  .margin = um_from_mm(clearance),
                  .unit = "um"};
  const std::string place =
      place_text(centred.place, gear1_name(train, mesh), gear2_name(train, mesh)) +
      (std::isnan(centred.z_mm) ? "" : ", at z = " + mm_text(centred.z_mm));
  const bool cross = centred.exact == ExactVerdict::kCross;
  // within their chord error the polygons prove nothing and the curves decide
  const bool proven = std::abs(clearance) > centred.chord_error_mm;
  const bool penetrates = proven ? cross : clearance < -tolerance::kTouch_mm;
  const double asked = train.design.made.clearance_mm.value_or(0.0);
  if (!penetrates && asked > 0.0) {
    finding.limit = um_from_mm(asked);
    finding.margin = um_from_mm(clearance - asked);
    if (clearance < asked - tolerance::kTouch_mm) {
      finding.status = CheckStatus::kFail;
      finding.message = "smallest clearance " + um_text(clearance) + " over a mesh cycle, " +
                        um_text(asked) + " are asked for (made.clearance_um): " + place;
      finding.cure = cure_of_clearance(train, mesh, clearance, asked);
      return finding;
    }
  }
  if (!penetrates) {
    finding.message = (clearance > tolerance::kTouch_mm ? "smallest clearance " + um_text(clearance)
                                                        : std::string("the flanks touch")) +
                      " over a mesh cycle: " + place;
    return finding;
  }
  finding.status = CheckStatus::kFail;
  finding.message = "the profiles penetrate by " + um_text(-clearance) + ": " + place +
                    (proven ? "; the outlines cross by exact predicates"
                            : "; too little for polygons, found on the curves");
  finding.cure = cure_of(train, mesh, centred);
  return finding;
}

}  // namespace

Findings check_overlap(const GearTrain& train, const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "overlap", [&](const GearTrain& t, const TrainMesh& mesh) {
    return judge(t, mesh, states[i++].centred);
  });
}

}  // namespace trueflank
