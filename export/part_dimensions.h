// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/export/hole_patterns.h"
#include "trueflank/solid/shape/part_shape.h"

// What a part is dimensioned by, and the tolerances it has to keep: one list for the workshop drawings
// and for the product information in STEP files (docs/drawings.md).
namespace trueflank::io {

/// Flank tolerance class of ISO 1328-1 that is asked for where the design says none.
inline constexpr int kDrawingToleranceClass = 7;

/// Deviations from a nominal size; NaN: none are known for a size like this.
struct SizeLimits {
  double lower_mm = kNaN, upper_mm = kNaN;
  std::string fit = {};  ///< "H7"; empty: the general tolerance
};

/// A diameter about the part's axis; of a hexagonal bore the distance across flats.
struct PartDiameter {
  double diameter_mm = 0.0;
  double z_mm = 0.0;          ///< lower end of the slab where it is met first
  bool hole = false;          ///< material is outside
  bool tip = false;           ///< tip circle of a toothing
  bool datum = false;         ///< its axis is datum A
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
  int count = 0;
  SizeLimits limits = {};  ///< of a hole
};

/// Circular runout of a gear's tips against datum A.
struct TipRunout {
  const TrainGear* gear = nullptr;  ///< not owned
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  double value_mm = kNaN;
};
/// Circular runout of an end face, measured along the axis, against datum A.
struct FaceRunout {
  double z_mm = 0.0;
  double value_mm = kNaN;
};

struct PartDimensions {
  std::vector<PartDiameter> diameters;  ///< smallest first, each size once
  std::vector<PartWidth> widths;        ///< bottom to top, the whole part last
  std::vector<PartWidth> depths;        ///< of bores about the axis that do not run through, bottom to top
  std::vector<BoltCircle> bolt_circles; ///< a row a diameter of the holes below
  std::vector<HolePattern> holes;       ///< off the axis
  std::vector<TipRunout> tip_runouts;   ///< one a gear
  std::optional<FaceRunout> face_runout;  ///< of the upper face

  [[nodiscard]] const PartDiameter* datum() const;  ///< nullptr: none
};

/// Datum A is a ring's outer cylinder, the bore of other gears, and of parts without teeth the
/// smallest cylinder; a gear without a bore has none, and no runout.
/// Bores, and holes as wide as a bearing of the design whose seats have no play (`[housing] fit_mm` 0), have
/// limits H7 (ISO 286-1, to 500 mm) where the part is not printed; all other sizes those of ISO 2768-1 m. Tips run as true as the teeth have to, F_rT of ISO 1328-1. The end face may
/// lean by as much as takes a fifth of the helix tolerance F_betaT, over the teeth's width; 10 um always.
[[nodiscard]] PartDimensions part_dimensions(const GearTrain& train, const PartShape& part,
                                             int tolerance_class = kDrawingToleranceClass);

/// ISO 2768-1 class m.
[[nodiscard]] SizeLimits general_limits(double size_mm);

/// A number with at most `decimals` places, trailing zeros dropped; "-" for what does not exist.
[[nodiscard]] std::string drawing_number(double value, int decimals);
/// What a bore has besides its diameter: "flat 4.5", "keyway 2 x 1"; empty: nothing.
[[nodiscard]] std::string bore_shape_text(const BoreDesign& bore);

/// The train's gears that a part carries, bottom to top.
[[nodiscard]] std::vector<const TrainGear*> gears_of(const GearTrain& train, const PartShape& part);
/// Whether the parts are printed: fits and machined surfaces are then none of theirs.
[[nodiscard]] bool additive(const GearTrain& train);

}  // namespace trueflank::io
