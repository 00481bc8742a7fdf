// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/mesh_clearance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/clearance/tooth_crossing.h"
#include "trueflank/check/clearance/tooth_sweep.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

/// Polygons that tell whether the teeth cross, of the module: never finer, and never coarser.
constexpr double kFinestChords = 2e-5, kCoarsestChords = 5e-3;
/// Both polygons together are within a quarter of the clearance that they confirm.
constexpr double kChordsOfClearance = 0.125;

}  // namespace

void add_exact_verdict(const GearPair& pair, MeshClearance& result) {
  const double m = pair.gear1().normal_module_mm;
  const double tolerance = std::clamp(kChordsOfClearance * std::abs(result.clearance_mm),
                                      kFinestChords * m, kCoarsestChords * m);
  const Point2 axis2(pair.internal() ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const ToothCrossing crossing =
      teeth_cross(pair, result.place.rotation1_rad, result.place.rotation2_rad, axis2, tolerance);
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

/// By which gear 2 is turned where it is turned towards the counter-clockwise flank of gear 1: a ring's own
/// counter-clockwise flank touches on the other side.
double turn_for_gear1_rad(const GearPair& pair, double turn) { return pair.internal() ? -turn : turn; }

MeshClearance closed(const GearPair& pair, const PairDistances& d, double turn) {
  return sweep_both(pair, d.gear1, d.gear2, turn_for_gear1_rad(pair, turn), turn);
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

/// Fillets are measured roughly, and to their full accuracy where that decides.
bool tips_clear(const GearPair& pair, double turn_rad, double least_mm) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  constexpr double kRough_mm = 1e-7, kDoubt_mm = 2.0 * kRough_mm;
  const double turn_of_gear1 = turn_for_gear1_rad(pair, turn_rad);
  const double rough_mm = tips_swept_mm(pair, kRough_mm, turn_of_gear1, turn_rad, least_mm - kDoubt_mm);
  if (std::abs(rough_mm - least_mm) > kDoubt_mm) return rough_mm > least_mm;
  return tips_swept_mm(pair, CurveSpline::kError, turn_of_gear1, turn_rad, least_mm) >= least_mm;
}

/// The mesh turned, without radial removal.
MeshState turned_through(const GearTrain& train, const TrainMesh& mesh) {
  if (is_modified(train, mesh)) return modified_state(train, mesh);
  const GearPair pair = train.pair(mesh);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return {centred(pair, d, 0.0), driving(pair, d), std::nullopt};
}

RadialRemoval removal_of(const GearTrain& train, const TrainMesh& mesh) {
  return is_modified(train, mesh) ? modified_removal(train, mesh)
                                  : radial_removal({train.pair(mesh)}, twist_over_face_rad(train, mesh));
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

bool tips_clear(const GearPair& pair, double least_mm) { return tips_clear(pair, 0.0, least_mm); }

bool tips_clear_driving(const GearPair& pair, double least_mm) {
  return tips_clear(pair, closing_rad(pair), least_mm);
}

MeshClearance driving_clearance(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return driving(pair, d);
}

bool clears_driving(const GearPair& pair, double least_mm) {
  TRUEFLANK_EXPECTS(pair.profile1 && pair.profile2 && pair.centre_distance_mm > 0.0);
  const double turn = closing_rad(pair);
  if (!(turn > 0.0)) return sweep_clearance_mm(pair) >= least_mm;
  const PairDistances d{GearDistance(*pair.profile1), GearDistance(*pair.profile2)};
  return both_clear(pair, d.gear1, d.gear2, turn_for_gear1_rad(pair, turn), turn, least_mm);
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
  // Meshes do not know of each other: they are shared out among the processors, the long work first.
  const std::size_t meshes = train.meshes.size();
  std::vector<MeshState> states(meshes);
  std::vector<std::optional<RadialRemoval>> removals(meshes);
  for_each_piece(2 * meshes, [&](std::size_t i) {
    const TrainMesh& mesh = train.meshes[i % meshes];
    if (i < meshes)
      states[i] = turned_through(train, mesh);
    else if (train.pair(mesh).internal())
      removals[i - meshes] = removal_of(train, mesh);
  });
  for (std::size_t i = 0; i < meshes; ++i) states[i].removal = std::move(removals[i]);
  return states;
}

}  // namespace trueflank
