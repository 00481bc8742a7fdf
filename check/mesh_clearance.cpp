// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/mesh_clearance.h"

#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/check/modified_clearance.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/check/tooth_crossing.h"
#include "trueflank/check/tooth_sweep.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

void add_exact_verdict(const GearPair& pair, MeshClearance& result) {
  const Point2 axis2(pair.internal() ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const ToothCrossing crossing =
      teeth_cross(pair, result.place.rotation1_rad, result.place.rotation2_rad, axis2);
  result.exact = crossing.cross ? ExactVerdict::kCross : ExactVerdict::kApart;
  result.chord_error_mm = crossing.chord_error_mm;
}

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

/// Both halves of both gears against each other, gear 2 turned by an angle.
MeshClearance swept(const GearPair& pair, const PairDistances& d, double turn_rad) {
  MeshClearance result = sweep_both(pair, d.gear1, d.gear2, turn_rad, turn_rad);
  if (turn_rad == 0.0 && symmetric(pair)) return result;
  const MirroredPair image(pair);
  const MeshClearance other = mirror_image(sweep_both(
      image.pair(), image.distances.gear1, image.distances.gear2, -turn_rad, -turn_rad));
  return other.clearance_mm < result.clearance_mm ? other : result;
}

MeshClearance centred(const GearPair& pair, const PairDistances& d, double turn_rad) {
  MeshClearance result = swept(pair, d, turn_rad);
  add_exact_verdict(pair, result);
  return result;
}

/// Gear 2 turned towards the counter-clockwise flank of gear 1; a ring's own counter-clockwise flank
/// touches on the other side.
MeshClearance closed(const GearPair& pair, const PairDistances& d, double turn) {
  return pair.internal() ? sweep_both(pair, d.gear1, d.gear2, -turn, turn)
                         : sweep_both(pair, d.gear1, d.gear2, turn, turn);
}

MeshClearance driving(const GearPair& pair, const PairDistances& d) {
  const double backlash = circumferential_backlash_mm(pair);
  if (!(backlash > kZero_mm)) return {};
  return closed(pair, d, 0.5 * backlash / pitch_radius2_mm(pair));
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

MeshClearance driving_clearance(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return driving(pair, d);
}

MeshClearance closed_clearance(const GearPair& pair, Flank flank1, double closing_rad) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  if (flank1 == Flank::kRight) {
    const MirroredPair image(pair);
    return mirror_image(closed(image.pair(), image.distances, closing_rad));
  }
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return closed(pair, d, closing_rad);
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
