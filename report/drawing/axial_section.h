// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/shape/part_shape.h"

// The section of a part through its axis, as drawings show it: the plane of z and x.
namespace trueflank::io {

/// Material of one slab between two distances from the axis, signed along x.
struct SectionBand {
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;
  bool teeth = false;  ///< between root and tip circle: ISO 2203 leaves teeth without hatching
};

/// An edge of the section, or one seen behind it, parallel to x or to z.
struct SectionEdge {
  double z1_mm = 0.0, x1_mm = 0.0, z2_mm = 0.0, x2_mm = 0.0;
};

struct AxialSection {
  std::vector<SectionBand> bands;
  std::vector<SectionEdge> edges;
};

/// As drawn by ISO 2203: teeth on both sides whatever their number, each from root to tip circle.
/// A hole off the axis shows where the plane meets it.
[[nodiscard]] AxialSection axial_section(const PartShape& part);

/// Distance from the axis to the outermost point of an outline: tip circle of external teeth, root
/// circle of a ring's.
[[nodiscard]] double outermost_mm(const Outline& outline);

}  // namespace trueflank::io
