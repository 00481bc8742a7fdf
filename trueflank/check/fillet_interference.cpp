// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/fillet_interference.h"

#include <algorithm>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Rounding of two equal radii found in different ways.
constexpr double kEqualRadii_mm = 1e-9;

struct Margins {
  double gear1 = 0.0, gear2 = 0.0;  ///< >= 0: contact starts on the involute [mm on the radius]
  [[nodiscard]] double smaller() const { return std::min(gear1, gear2); }
};

Margins margins_of(const GearPair& pair) {
  const double gap1 = start_of_active_profile1_mm(pair) - pair.profile1->root_form_radius_mm();
  const double gap2 = start_of_active_profile2_mm(pair) - pair.profile2->root_form_radius_mm();
  const LineOfAction line = line_of_action(pair);
  Margins margins{gap1, pair.internal() ? -gap2 : gap2};
  // beyond the base circle there is no radius to compare: the roll length says how far
  if (line.start_mm < 0.0) margins.gear1 = std::min(margins.gear1, line.start_mm);
  return margins;
}

bool at_root(const MeshPlace& place) {
  const auto root = [](PieceKind kind) {
    return kind == PieceKind::kFillet || kind == PieceKind::kRoot;
  };
  return root(place.piece1) || root(place.piece2);
}

Finding judge(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const GearPair pair = train.pair(mesh);
  const Margins margins = margins_of(pair);
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  Finding finding{.id = "fillet_interference",
                  .where = mesh.name,
                  .value = margins.smaller(),
                  .limit = 0.0,
                  .margin = margins.smaller(),
                  .unit = "mm"};
  finding.message = "start of active profile clear of the root form circle by " +
                    mm_text(margins.gear1) + " on " + name1 + ", " + mm_text(margins.gear2) + " on " +
                    name2;
  const bool criterion = margins.smaller() >= -kEqualRadii_mm;
  const MeshClearance& centred = state.centred;
  const bool penetrates = centred.clearance_mm < -tolerance::kTouch_mm && at_root(centred.place);
  if (penetrates) {
    finding.status = CheckStatus::kFail;
    finding.message += std::string(criterion ? "; the criterion holds, but" : ";") +
                       " the exact profiles penetrate by " + um_text(centred.penetration_mm()) + ": " +
                       place_text(centred.place, name1, name2);
  } else if (!criterion) {
    finding.status = CheckStatus::kWarn;
    const double driving = state.driving.clearance_mm;
    if (centred.clearance_mm < -tolerance::kTouch_mm)
      finding.message += "; the exact profiles do penetrate, but not worst at a root (see overlap)";
    else
      finding.message += "; the exact profiles clear each other with centred backlash, so contact is "
                         "lost there but nothing jams";
    if (centred.clearance_mm >= 0.0 && driving < -tolerance::kTouch_mm)
      finding.message += "; driving, the " +
                         place_text(state.driving.place, name1, name2) + " meet " +
                         um_text(-driving) + " before the flanks do";
  } else {
    return finding;
  }
  const bool tip_of_gear1 = margins.gear2 < margins.gear1;
  finding.cure = cure_text(train, mesh, tip_of_gear1, [](const GearPair& changed) {
    return margins_of(changed).smaller() + kEqualRadii_mm;
  });
  return finding;
}

}  // namespace

Findings check_fillet_interference(const GearTrain& train, const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "fillet_interference",
                       [&](const GearTrain& t, const TrainMesh& mesh) {
                         return judge(t, mesh, states[i++]);
                       });
}

}  // namespace trueflank
