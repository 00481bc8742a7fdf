// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/mesh_clearance.h"

#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/clearance/tooth_crossing.h"
#include "trueflank/check/clearance/tooth_sweep.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {

void add_exact_verdict(const GearPair& pair, MeshClearance& result) {
  const Point2 axis2(pair.internal() ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const ToothCrossing crossing =
      teeth_cross(pair, result.place.rotation1_rad, result.place.rotation2_rad, axis2);
  result.exact = crossing.cross ? ExactVerdict::kCross : ExactVerdict::kApart;
  result.chord_error_mm = crossing.chord_error_mm;
}

namespace {

struct PairDistances {
  GearDistance gear1, gear2;
};

/// A pair seen from the other side, for the sweeps of the clockwise halves.
struct MirroredPair {
  explicit MirroredPair(const GearPair& pair)
      : profile1(pair.profile1->mirror_image()),
        profile2(pair.profile2->mirror_image()),
        distances{GearDistance(profile1), GearDistance(profile2)},
        centre_distance_mm(pair.centre_distance_mm) {}
  [[nodiscard]] GearPair pair() const { return {&profile1, &profile2, centre_distance_mm}; }

  ToothProfile profile1, profile2;
  PairDistances distances;
  double centre_distance_mm;
};

bool symmetric(const GearPair& pair) {
  return pair.profile1->symmetric() && pair.profile2->symmetric();
}

MeshClearance mirror_image(MeshClearance c) {
  c.place.rotation1_rad = -c.place.rotation1_rad;
  c.place.rotation2_rad = -c.place.rotation2_rad;
  c.place.point_mm = mirrored(c.place.point_mm);
  c.place.flank1 = c.place.flank1 == Flank::kLeft ? Flank::kRight : Flank::kLeft;
  return c;
}

/// The lower of both halves, the clockwise one as its image has it, gear 2 turned by an angle.
MeshClearance lower_of_halves(MeshClearance own, const MirroredPair& image, double turn_rad) {
  MeshClearance other = mirror_image(sweep_both(image.pair(), image.distances.gear1,
                                                image.distances.gear2, -turn_rad, -turn_rad));
  return other.clearance_mm < own.clearance_mm ? other : own;
}

/// Both halves of both gears against each other, gear 2 turned by an angle.
MeshClearance swept(const GearPair& pair, const PairDistances& d, double turn_rad) {
  MeshClearance result = sweep_both(pair, d.gear1, d.gear2, turn_rad, turn_rad);
  if (turn_rad == 0.0 && symmetric(pair)) return result;
  return lower_of_halves(std::move(result), MirroredPair(pair), turn_rad);
}

MeshClearance centred(const GearPair& pair, const PairDistances& d, double turn_rad) {
  MeshClearance result = swept(pair, d, turn_rad);
  add_exact_verdict(pair, result);
  return result;
}

/// Gear 2 turned towards the counter-clockwise flank of gear 1; a ring's own counter-clockwise flank
/// touches on the other side.
MeshClearance closed(const GearPair& pair, const PairDistances& d, double turn,
                     SweptPlaces places = SweptPlaces::kAll) {
  return sweep_both(pair, d.gear1, d.gear2, pair.internal() ? -turn : turn, turn, places);
}

/// By which gear 2 turns from the middle of its play to its end; 0 without play.
double closing_rad(const GearPair& pair) {
  const double backlash = circumferential_backlash_mm(pair);
  return backlash > kZero_mm ? 0.5 * backlash / pitch_radius2_mm(pair) : 0.0;
}

MeshClearance driving(const GearPair& pair, const PairDistances& d) {
  const double turn = closing_rad(pair);
  return turn > 0.0 ? closed(pair, d, turn) : MeshClearance{};
}

double tip_clearance_mm(const GearPair& pair, double turn_rad) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return closed(pair, d, turn_rad, SweptPlaces::kTips).clearance_mm;
}

const char* piece_text(PieceKind kind) {
  switch (kind) {
    case PieceKind::kTip: return "tip circle";
    case PieceKind::kTipRounding: return "tip rounding";
    case PieceKind::kTrim: return "trimmed tip corner";
    case PieceKind::kRadial: return "radial tip";
    case PieceKind::kInvolute: return "flank";
    case PieceKind::kFillet: return "root fillet";
    case PieceKind::kRoot: return "root circle";
  }
  return "";
}

std::string side_text(PieceKind kind, bool corner, double radius_mm, const std::string& name) {
  return std::string(corner && kind == PieceKind::kTip ? "tip corner" : piece_text(kind)) + " of " +
         name + " at diameter " + mm_text(2.0 * radius_mm);
}

}  // namespace

MeshClearance mesh_clearance(const GearPair& pair, double gear2_turn_rad) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return centred(pair, d, gear2_turn_rad);
}

double sweep_clearance_mm(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return swept(pair, d, 0.0).clearance_mm;
}

double tip_sweep_clearance_mm(const GearPair& pair) { return tip_clearance_mm(pair, 0.0); }

double tip_driving_clearance_mm(const GearPair& pair) { return tip_clearance_mm(pair, closing_rad(pair)); }

MeshClearance driving_clearance(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return driving(pair, d);
}

MeshState mesh_state(const GearPair& pair, double left_rad, double right_rad) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  const bool drives = left_rad > 0.0 && right_rad > 0.0;
  MeshState state;
  state.centred = sweep_both(pair, d.gear1, d.gear2, 0.0, 0.0);
  if (!symmetric(pair) || drives) {
    const MirroredPair image(pair);
    if (!symmetric(pair)) state.centred = lower_of_halves(std::move(state.centred), image, 0.0);
    if (drives) {
      state.driving = closed(pair, d, left_rad);
      MeshClearance right = mirror_image(closed(image.pair(), image.distances, right_rad));
      if (right.clearance_mm < state.driving.clearance_mm) state.driving = std::move(right);
    }
  }
  return state;
}

std::string place_text(const MeshPlace& place, const std::string& name1, const std::string& name2) {
  return side_text(place.piece1, place.corner1, place.radius1_mm, name1) + ", " +
         side_text(place.piece2, place.corner2, place.radius2_mm, name2) + ", " +
         deg_text(polar_angle_rad(place.point_mm)) + " from the line of centres";
}

std::vector<MeshState> mesh_states(const GearTrain& train) {
  // Meshes do not know of each other: all at once, as many as there are processors.
  std::vector<std::future<MeshState>> turned;
  std::vector<std::future<RadialRemoval>> removals;
  for (const TrainMesh& mesh : train.meshes) {
    const GearPair pair = train.pair(mesh);
    const bool modified = is_modified(train, mesh);
    turned.push_back(begun_beside([pair, modified, &train, &mesh] {
      if (modified) return modified_state(train, mesh);
      const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
      return MeshState{centred(pair, d, 0.0), driving(pair, d), std::nullopt};
    }));
    removals.emplace_back();
    if (pair.internal())
      removals.back() = begun_beside([pair, modified, &train, &mesh] {
        return modified ? modified_removal(train, mesh)
                        : radial_removal({pair}, twist_over_face_rad(train, mesh));
      });
  }
  std::vector<MeshState> states;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    states.push_back(turned[i].get());
    if (removals[i].valid()) states.back().removal = removals[i].get();
  }
  return states;
}

}  // namespace trueflank
