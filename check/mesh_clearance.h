// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/check/ring_criteria.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/train/gear_train.h"

// The truth about a mesh: the real profiles turned through the whole engagement of a tooth.
namespace trueflank {

/// One position of a pair and the place on its profiles that is nearest.
/// Frame: axis of gear 1 at the origin, axis of gear 2 on the x axis (external pair: +a, ring: -a), so
/// that the teeth meet around +x.
struct MeshPlace {
  double rotation1_rad = 0.0;  ///< of tooth 1 of gear 1, from +x
  double rotation2_rad = 0.0;  ///< of tooth 1 of gear 2, from +x
  Point2 point_mm = Point2::Zero();
  double radius1_mm = kNaN, radius2_mm = kNaN;  ///< of the place on either gear
  PieceKind piece1 = PieceKind::kInvolute, piece2 = PieceKind::kInvolute;
  bool corner1 = false, corner2 = false;  ///< the end of that piece, not its inside
  Flank flank1 = Flank::kLeft;            ///< on gear 1; with centred backlash both flanks are alike
};

/// What crossing segments prove, by exact predicates on polygons within `chord_error_mm` of the curves.
enum class ExactVerdict { kApart, kCross };

/// Smallest distance of two profiles over a mesh cycle.
struct MeshClearance {
  double clearance_mm = kNaN;  ///< smallest distance; negative: deepest penetration
  MeshPlace place;
  double z_mm = kNaN;  ///< height in the assembly, where the teeth differ along the face
  ExactVerdict exact = ExactVerdict::kApart;  ///< at `place`; the polygons are as fine as the clearance asks for
  double chord_error_mm = kNaN;               ///< of the polygons behind `exact`

  [[nodiscard]] double minimum_clearance_mm() const { return clearance_mm > 0.0 ? clearance_mm : 0.0; }
  [[nodiscard]] double penetration_mm() const { return clearance_mm < 0.0 ? -clearance_mm : 0.0; }
};

/// Turns the pair with its backlash centred through the whole engagement of a tooth: every point of
/// both profiles at every position. Gear 2 may be turned by an angle out of the centred position.
/// Profiles may be sections whose halves differ (section_profile.h).
/// Guarantees: contact of the involutes is exact; other places are found on a grid of 0.05 module and
/// refined on the exact curves. |clearance| below 1e-9 mm is reported as 0.
/// Accuracy: 0.01 um at module 1 where the place is found; tests/check/mesh_clearance_test.cpp
/// compares with an independent simulation.
/// Requires: the pair has a working pressure angle.
[[nodiscard]] MeshClearance mesh_clearance(const GearPair& pair, double gear2_turn_rad = 0.0);

/// The clearance alone, without the exact verdict; for solvers.
[[nodiscard]] double sweep_clearance_mm(const GearPair& pair);

/// Whether the tip corners alone (or their roundings) clear the mate by at least so much: a small part of
/// the work, and true where all places do. For bisections that verify their answer.
[[nodiscard]] bool tips_clear(const GearPair& pair, double least_mm);
/// The same as one gear drives the other; centred where there is no backlash to take up.
[[nodiscard]] bool tips_clear_driving(const GearPair& pair, double least_mm);

/// The clearance with gear 2 turned until the flanks of the left side of gear 1 touch as they do when
/// driving. Below 0: something else touches first (a tip corner in a root fillet), and the teeth
/// cannot run conjugate there. NaN where there is no backlash to take up.
[[nodiscard]] MeshClearance driving_clearance(const GearPair& pair);

/// Whether driving_clearance() is at least so much; the centred clearance where there is no backlash to take up.
[[nodiscard]] bool clears_driving(const GearPair& pair, double least_mm);

/// What stands at a place, in words: "tip corner of sun (diameter 14.2 mm) at the root fillet of ...".
[[nodiscard]] std::string place_text(const MeshPlace& place, const std::string& name1,
                                     const std::string& name2);

/// What turning and moving the real profiles of a mesh says.
struct MeshState {
  MeshClearance centred;
  MeshClearance driving;  ///< of modified flanks, which differ by the side, the lower of both sides
  std::optional<RadialRemoval> removal;  ///< rings only
};
/// Of one pair, gear 2 turned by these angles [rad] that close the play of either side of gear 1; no
/// driving one where either is 0. No exact verdict, no removal.
[[nodiscard]] MeshState mesh_state(const GearPair& pair, double left_rad, double right_rad);
/// Whether the teeth cross at the place of a centred clearance.
void add_exact_verdict(const GearPair& pair, MeshClearance& result);
/// Of every mesh of a train, in its order. Where flanks are modified the sections of both gears at the
/// heights with most material are turned, exact to section_profile.h; the worst of them counts.
[[nodiscard]] std::vector<MeshState> mesh_states(const GearTrain& train);

}  // namespace trueflank
