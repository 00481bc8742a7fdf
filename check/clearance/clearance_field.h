// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// What one gear may be off by [mm].
struct GearSpread {
  double thickness_mm = 0.0, eccentricity_mm = 0.0, pitch_mm = 0.0;
};

/// A mesh with its centre distance and the thickness of its teeth changed.
struct ChangedPair {
  double backlash_mm = kNaN, clearance_mm = kNaN;
};

/// Clearance of a mesh over its tolerance field: over the error of the centre distance, eccentricities
/// included, and that of both thicknesses, pitches included.
///
/// The mesh is turned at three by three places of the field. Where some of the four around a cell jam and
/// some do not, the cell is halved until it is a quarter of the first ones or its middle is on the plane
/// between its corners: a clearance is the smallest of several curves, and the plane lies below it where
/// one takes over from another.
class ClearanceField {
 public:
  static constexpr int kPlaces = 3;  ///< turned in any case, each way

  /// `spread1`, `spread2`: of the mesh's gears. Keeps a reference to the train.
  /// Errors: where the teeth do not exist or do not mesh at one of those places.
  [[nodiscard]] static Result<ClearanceField> make(const GearTrain& train, const TrainMesh& mesh,
                                                   const GearSpread& spread1, const GearSpread& spread2,
                                                   double distance_mm);

  /// Of the places turned in any case.
  [[nodiscard]] const ChangedPair& at(int distance_place, int thickness_place) const;
  /// Interpolated; turns the mesh where that is worth it. Beyond the field as at its edge.
  [[nodiscard]] double clearance_mm(double distance_mm, double thickness_mm);

 private:
  static constexpr int kSteps = 8;  ///< of the finest places
  struct Cell {
    int distance, thickness, size;
    auto operator<=>(const Cell&) const = default;
  };
  using Place = std::optional<ChangedPair>;

  ClearanceField(const GearTrain& train, const TrainMesh& mesh) : train_(&train), mesh_(&mesh) {}
  [[nodiscard]] Result<ChangedPair> turned(int distance, int thickness) const;
  [[nodiscard]] const Place& place(int distance, int thickness) const;
  [[nodiscard]] Place& place(int distance, int thickness);
  [[nodiscard]] double clearance_at(int distance, int thickness);
  [[nodiscard]] bool worth_halving(const Cell& cell);
  [[nodiscard]] double interpolated(const Cell& cell, double u, double v);

  const GearTrain* train_;
  const TrainMesh* mesh_;
  double distance_mm_ = 0.0;                   ///< half widths of the field
  double thickness1_mm_ = 0.0, thickness2_mm_ = 0.0;
  std::array<std::array<Place, kSteps + 1>, kSteps + 1> places_{};
  std::map<Cell, bool> halved_;
};

}  // namespace trueflank
