// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/export/workmanship.h"
#include "trueflank/solid/shape/part_shape.h"

// Form, place and runout of a part's features (ISO 1101), and the rules their values follow.
namespace trueflank::io {

enum class ToleranceKind {
  kCircularRunout,
  kTotalRunout,
  kFlatness,
  kParallelism,
  kCylindricity,
  kPosition
};
/// "circular_runout", "flatness", ...
[[nodiscard]] const char* to_text(ToleranceKind kind);

enum class ToleratedFeature { kTips, kUpperFace, kLowerFace, kSeat, kHoles };

struct GeometricTolerance {
  ToleranceKind kind = ToleranceKind::kCircularRunout;
  ToleratedFeature feature = ToleratedFeature::kTips;
  double value_mm = kNaN;                     ///< of a position: the diameter of its zone
  char datum = 0;                             ///< 'A' or 'B' (the upper face); 0: none
  const TrainGear* gear = nullptr;            ///< of tips; not owned
  double z_lower_mm = 0.0, z_upper_mm = 0.0;  ///< of tips and faces
  double diameter_mm = 0.0, made_mm = 0.0;    ///< of a seat, as it is drawn and in the shape
  bool hole = false;                          ///< of a seat
  std::size_t pattern = 0;                    ///< of holes: index into PartDimensions::holes
};

struct PartDimensions;

/// What is asked of a part with a datum A:
/// - its tips run as true as the teeth have to, F_rT of ISO 1328-1, or what a process without a
/// class holds;
/// - its upper face runs out against A by no more than tilts the teeth by a fifth of F_betaT over
/// their width, or a
///   carrier or housing by half of it (10 um always); it is flat to the same, and the lower face
///   parallel to it. What is printed has its process's runout alone;
/// - seats and bores of a class of ISO 286 are cylindrical to half of IT5, and run as true to A as
/// that where they
///   are not A themselves (SKF's rule for the seats of bearings of class Normal);
/// - holes that carry an axis stand within the tolerance of axes, or IT7 of their distance from A;
/// holes of screws
///   within half of a screw's play, which is what both parts together may be off by.
[[nodiscard]] std::vector<GeometricTolerance> geometric_tolerances(const GearTrain& train,
                                                                   const PartShape& part,
                                                                   const PartDimensions& dimensions,
                                                                   const Workmanship& made);

}  // namespace trueflank::io
