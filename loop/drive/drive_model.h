// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/losses.h"

namespace trueflank::loop {

/// Efficiencies of the meshes alone, at no other loss.
struct DriveEfficiency {
  double forward = 1.0, backward = 1.0;
};

/// Something that turns, and how often per turn of the input.
struct MemberOrder {
  std::string member;  ///< "carrier", "planet against the sun", ...
  double order = 1.0;  ///< per turn of the input
};

/// What the loop must know of a drive: its ratio, what friction in the meshes costs, what turns how
/// often. Made from a design, or written down for a drive whose teeth are not known.
struct DriveModel {
  double ratio = 1.0;            ///< |input speed / output speed|
  double friction = 0.1;         ///< as designed
  std::vector<std::string> meshes;
  /// Efficiencies for a friction of each mesh (as many as meshes).
  std::function<DriveEfficiency(const std::vector<double>& friction)> efficiency;
  std::vector<MemberOrder> orders;
  std::optional<LossesDesign> losses;  ///< that the design already knows of

  [[nodiscard]] DriveEfficiency at(double coefficient) const {
    return efficiency(std::vector<double>(meshes.size(), coefficient));
  }
  /// As designed.
  [[nodiscard]] double friction_at(const DrivePoint& point) const {
    return losses ? mesh_friction(*losses, friction, point) : friction;
  }
};

/// The drive of a laid-out train. Errors: a single gear, or an output that stands still.
[[nodiscard]] Result<DriveModel> drive_model(const GearTrain& train);

}  // namespace trueflank::loop
