// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/gear_train.h"

// What a mesh is along its face: the width that carries, and what modifications make of its play.
namespace trueflank {

/// The face both gears of a mesh have, in the assembly, without the edge chamfers of either: where
/// flanks can touch.
struct CommonFace {
  double lower_mm = 0.0, upper_mm = 0.0;
  double carrying_mm = 0.0;  ///< width less the relief groove; 0 where they do not face each other
  double helix_mm = 0.0;     ///< of one helix: half of it for herringbone teeth
};
[[nodiscard]] CommonFace common_face(const GearTrain& train, const TrainMesh& mesh);

/// Angle by which gear 1's sections turn over the whole common face, chamfers included.
[[nodiscard]] double twist_over_face_rad(const GearTrain& train, const TrainMesh& mesh);

/// Overlap ratio of one helix: its width over the axial pitch, b sin(beta) / (pi m_n); 0 for spur.
/// Source: ISO 21771; a herringbone's halves carry side by side and do not add.
[[nodiscard]] double overlap_ratio(const GearTrain& train, const TrainMesh& mesh);

/// A mesh whose flanks deviate, centred as without modifications.
struct ModifiedMesh {
  bool modified = false;
  /// From the centred position to the touch of gear 1's counter-clockwise (clockwise) flanks, along the
  /// line of action, smallest over face and path of contact. Accuracy: 1e-8 mm on the involutes.
  double ccw_play_mm = kNaN, cw_play_mm = kNaN;
  double backlash_mm = kNaN;  ///< both, circumferential at the working pitch circle
  /// Transverse contact ratio between the starts of the reliefs, where involute runs on involute.
  double unrelieved_contact_ratio = kNaN;
};
[[nodiscard]] ModifiedMesh modified_mesh(const GearTrain& train, const TrainMesh& mesh);

/// Heights in the assembly at which the sections of a mesh are looked at: ends, middle, quarters and
/// breaks of the common face, and where either side has least play; the middle alone where nothing
/// varies along it.
[[nodiscard]] std::vector<double> section_heights_mm(const GearTrain& train, const TrainMesh& mesh);

/// Where modified flanks touch without load, as roll lengths of gear 1, between the ends that the tip form
/// circles set: there no neighbouring pair of teeth, a base pitch away, has more material. Of both sides of
/// the teeth the larger range. Without modifications that of line_of_action, from tip to tip.
struct ActivePath {
  double start_mm = kNaN, end_mm = kNaN;
};
[[nodiscard]] ActivePath active_path(const GearTrain& train, const TrainMesh& mesh);

}  // namespace trueflank
