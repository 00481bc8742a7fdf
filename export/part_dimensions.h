// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/export/geometric_tolerances.h"
#include "trueflank/export/hole_patterns.h"
#include "trueflank/export/workmanship.h"
#include "trueflank/solid/shape/part_shape.h"

// What a part is dimensioned by, and the tolerances it has to keep: one list for the workshop
// drawings and for the product information in STEP files (docs/drawings.md).
namespace trueflank::io {

/// A diameter about the part's axis; of a hexagonal bore the distance across flats.
struct PartDiameter {
  double diameter_mm = 0.0;  ///< as it is drawn: nominal size of a class of ISO 286
  double made_mm = 0.0;      ///< in the shape: in the middle of that class's limits
  double z_mm = 0.0;         ///< lower end of the slab where it is met first
  bool hole = false;         ///< material is outside
  bool tip = false;          ///< tip circle of a toothing
  bool datum = false;        ///< its axis is datum A
  bool seat = false;         ///< of a bearing, shaft or pin
  std::optional<BoreDesign> bore = {};
  SizeLimits limits = {};
};

/// A length along the axis, of slabs of one outer outline or of the whole part.
struct PartWidth {
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  SizeLimits limits = {};
  [[nodiscard]] double width_mm() const { return z_upper_mm - z_lower_mm; }
};

/// Equal holes on one circle.
struct BoltCircle {
  double hole_diameter_mm = 0.0, circle_diameter_mm = 0.0;
  double made_mm = 0.0;  ///< of a hole, in the shape
  int count = 0;
  SizeLimits limits = {};  ///< of a hole
};

struct PartDimensions {
  std::vector<PartDiameter> diameters;  ///< smallest first, each size once
  std::vector<PartWidth> widths;        ///< bottom to top, the whole part last
  std::vector<PartWidth>
      depths;  ///< of bores about the axis that do not run through, bottom to top
  std::vector<BoltCircle> bolt_circles;        ///< a row a diameter of the holes below
  std::vector<HolePattern> holes;              ///< off the axis
  std::vector<GeometricTolerance> tolerances;  ///< tips, faces, seats, holes

  [[nodiscard]] const PartDiameter* datum() const;  ///< nullptr: none
  [[nodiscard]] std::vector<GeometricTolerance> of(ToleratedFeature feature) const;
};

/// Datum A is a ring's outer cylinder, the bore of other gears, and of parts without teeth the
/// largest seat, else the largest cylinder; a gear without a bore has none, and nothing that refers
/// to it. Bores and seats have limits H7, journals g6, made pins h6 (ISO 286-1, to 250 mm) where
/// parts are not printed, and what the process holds between two walls where they are; all other
/// sizes have the general tolerance.
[[nodiscard]] PartDimensions part_dimensions(const GearTrain& train, const PartShape& part);

/// A number with at most `decimals` places, trailing zeros dropped; "-" for what does not exist.
[[nodiscard]] std::string drawing_number(double value, int decimals);
/// What stands behind a size: " H7 (+0.021 / 0)", " ±0.04"; empty: the general tolerance holds.
[[nodiscard]] std::string limits_text(const SizeLimits& limits);
/// What a bore has besides its diameter: "flat 4.5", "keyway 2 x 1"; empty: nothing.
[[nodiscard]] std::string bore_shape_text(const BoreDesign& bore);

/// The train's gears that a part carries, bottom to top.
[[nodiscard]] std::vector<const TrainGear*> gears_of(const GearTrain& train, const PartShape& part);

}  // namespace trueflank::io
