// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/corner_contact.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

/// ISO 6336-1 counts with 14 N/(mm um) for a mesh of steel; 70 N on a millimetre of face and module
/// is a full load: such teeth give by 5 um a millimetre of module, and flanks that come so much
/// later still carry.
constexpr double kLimit = 0.005;

/// The state in which the play is taken up; without play the centred one.
const MeshClearance& closed_state(const MeshState& state) {
  return std::isnan(state.driving.clearance_mm) ? state.centred : state.driving;
}

std::string cure_of(const GearTrain& train, const TrainMesh& mesh, const MeshPlace& place) {
  const GearPair pair = train.pair(mesh);
  const bool tip_of_gear1 = std::abs(place.radius1_mm - pair.profile1->tip_radius_mm()) <
                            std::abs(place.radius2_mm - pair.profile2->tip_radius_mm());
  return cure_text(train, mesh, tip_of_gear1,
                   {.exact =
                        [](const GearPair& changed) {
                          return clears_driving(changed, -tolerance::kTouch_mm) ? 0.0 : -1.0;
                        },
                    .quick =
                        [](const GearPair& changed) {
                          return tips_clear_driving(changed, -tolerance::kTouch_mm);
                        }});
}

Finding corner_contact_finding(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const MeshClearance& closed = closed_state(state);
  const double ahead = std::max(0.0, -closed.clearance_mm);
  const double most = train.design.corner_contact_limit_mm.value_or(
      corner_contact_limit_mm(train.pair(mesh).gear1().normal_module_mm));
  const bool passes = !(ahead > tolerance::kTouch_mm);
  Finding finding{.id = "corner_contact",
                  .where = mesh.name,
                  .value = passes ? 0.0 : um_from_mm(ahead),
                  .limit = um_from_mm(most),
                  .margin = um_from_mm(most - ahead),
                  .unit = "um"};
  if (modified_mesh(train, mesh).backlash_mm < -tolerance::kTouch_mm) {
    finding.value = finding.margin = kNaN;
    finding.status = CheckStatus::kNotApplicable;
    finding.message =
        "the teeth are too thick for their gaps: they jam before they drive (see overlap)";
    return finding;
  }
  if (passes) {
    finding.message = "driving either way, the flanks touch first";
    return finding;
  }
  finding.status = ahead > most ? CheckStatus::kFail : CheckStatus::kWarn;
  finding.message = "driving, the " +
                    place_text(closed.place, gear1_name(train, mesh), gear2_name(train, mesh)) +
                    " meet " + um_text(ahead) + " before the flanks do";
  if (finding.status == CheckStatus::kWarn)
    finding.message += "; a full load bends the teeth by about " + um_text(most) +
                       ", so the flanks still carry then";
  finding.cure = cure_of(train, mesh, closed.place);
  return finding;
}

}  // namespace

double corner_contact_limit_mm(double normal_module_mm) { return kLimit * normal_module_mm; }

Findings check_corner_contact(const GearTrain& train, const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "corner_contact", [&](const GearTrain& t, const TrainMesh& mesh) {
    return corner_contact_finding(t, mesh, states[i++]);
  });
}

}  // namespace trueflank
