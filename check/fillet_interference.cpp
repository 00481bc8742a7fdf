// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/fillet_interference.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

/// Rounding of two equal radii found in different ways.
constexpr double kEqualRadii_mm = 1e-9;

struct Margins {
  double gear1 = 0.0, gear2 = 0.0;  ///< >= 0: contact starts on the involute [mm on the radius]
  [[nodiscard]] double smaller() const { return std::min(gear1, gear2); }
  [[nodiscard]] bool hold() const { return smaller() >= -kEqualRadii_mm; }
};

/// With contact between two roll lengths of gear 1.
Margins margins_between(const GearPair& pair, double start_mm, double end_mm) {
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  const double start2_mm = pair.internal() ? end_mm + span : span - end_mm;
  const auto radius = [](const Gear& gear, double roll_mm) {
    return std::hypot(base_radius_mm(gear), std::max(0.0, roll_mm));
  };
  const double gap1 = radius(pair.gear1(), start_mm) - pair.profile1->root_form_radius_mm();
  const double gap2 = radius(pair.gear2(), start2_mm) - pair.profile2->root_form_radius_mm();
  Margins margins{gap1, pair.internal() ? -gap2 : gap2};
  // beyond the base circle there is no radius to compare: the roll length says how far
  if (start_mm < 0.0) margins.gear1 = std::min(margins.gear1, start_mm);
  return margins;
}

/// With contact up to the tips.
Margins margins_of(const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  return margins_between(pair, line.start_mm, line.end_mm);
}

bool at_root(const MeshPlace& place) {
  const auto root = [](PieceKind kind) {
    return kind == PieceKind::kFillet || kind == PieceKind::kRoot;
  };
  return root(place.piece1) || root(place.piece2);
}

std::string margins_text(const Margins& margins, const std::string& name1, const std::string& name2) {
  return mm_text(margins.gear1) + " on " + name1 + ", " + mm_text(margins.gear2) + " on " + name2;
}

std::string trouble_text(const MeshState& state, const std::string& name1, const std::string& name2) {
  const double centred = state.centred.clearance_mm, driving = state.driving.clearance_mm;
  if (centred < -tolerance::kTouch_mm)
    return "; the exact profiles do penetrate, but not worst at a root (see overlap)";
  std::string text = "; the exact profiles clear each other with centred backlash, so contact is "
                     "lost there but nothing jams";
  if (centred >= 0.0 && driving < -tolerance::kTouch_mm)
    text += "; driving, the " + place_text(state.driving.place, name1, name2) + " meet " +
            um_text(-driving) + " before the flanks do";
  return text;
}

Finding fillet_interference_finding(const GearTrain& train, const TrainMesh& mesh, const MeshState& state) {
  const GearPair pair = train.pair(mesh);
  const ActivePath path = active_path(train, mesh);
  const Margins margins = margins_between(pair, path.start_mm, path.end_mm);
  const Margins to_the_tips = margins_of(pair);
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  Finding finding{.id = "fillet_interference",
                  .where = mesh.name,
                  .value = margins.smaller(),
                  .limit = 0.0,
                  .margin = margins.smaller(),
                  .unit = "mm"};
  finding.message = "start of active profile clear of the root form circle by " +
                    margins_text(margins, name1, name2);
  const bool relieved = margins.gear1 > to_the_tips.gear1 + kEqualRadii_mm ||
                        margins.gear2 > to_the_tips.gear2 + kEqualRadii_mm;
  if (relieved)
    finding.message += ", where the modified flanks touch without load (to their tips: " +
                       margins_text(to_the_tips, name1, name2) + ")";
  const MeshClearance& centred = state.centred;
  const bool penetrates = centred.clearance_mm < -tolerance::kTouch_mm && at_root(centred.place);
  // what the relieved part of a flank does at a root the turning says, not the path of contact
  const bool passes_relieved = margins.hold() && centred.clearance_mm >= -tolerance::kTouch_mm &&
                               !(state.driving.clearance_mm < -tolerance::kTouch_mm);
  if (penetrates) {
    finding.status = CheckStatus::kFail;
    finding.message += std::string(margins.hold() ? "; the criterion holds, but" : ";") +
                       " the exact profiles penetrate by " + um_text(centred.penetration_mm()) + ": " +
                       place_text(centred.place, name1, name2);
  } else if (to_the_tips.hold()) {
    return finding;
  } else if (relieved && passes_relieved) {
    finding.message += "; under a load that takes up the reliefs, contact begins in a root fillet";
    return finding;
  } else {
    finding.status = CheckStatus::kWarn;
    finding.message += trouble_text(state, name1, name2);
  }
  const bool tip_of_gear1 = to_the_tips.gear2 < to_the_tips.gear1;
  finding.cure = cure_text(train, mesh, tip_of_gear1, {.exact = [](const GearPair& changed) {
    return margins_of(changed).smaller() + kEqualRadii_mm;
  }});
  return finding;
}

}  // namespace

Findings check_fillet_interference(const GearTrain& train, const std::vector<MeshState>& states) {
  std::size_t i = 0;
  return for_each_mesh(train, "fillet_interference",
                       [&](const GearTrain& t, const TrainMesh& mesh) {
                         return fillet_interference_finding(t, mesh, states[i++]);
                       });
}

}  // namespace trueflank
