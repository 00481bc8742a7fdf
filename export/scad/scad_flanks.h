// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/solid/shape/part_shape.h"

// Modified flanks as OpenSCAD evaluates them: tables of turns that it interpolates.
namespace trueflank::io {

struct ScadFlanks {
  /// Curves of the half tooth as the file lists them; the flank cut where its modification bends.
  std::vector<Curve> curves;
  /// `[first, last curve of the flank, turns over the roll angle: two flanks, fades of the fillet]`.
  std::string profile;
  bool along_face = false;  ///< whether the section changes along the face
};

/// Nothing where the modification is more than a term along the profile plus one along the face, alike on
/// all teeth, and an edge chamfer.
/// Accuracy: 0.01 um of the modification; the field's own terms to 1 nm.
[[nodiscard]] std::optional<ScadFlanks> scad_flanks(const ToothedOutline& teeth);

/// Turns over the share of a slab's height, gear's frame: `[counter-clockwise flank, clockwise flank,
/// chamfer's depth, shares where they bend]`.
[[nodiscard]] std::string scad_face(const ToothedOutline& teeth, double z_lower_mm, double z_upper_mm);

/// Whether the outline has modified flanks.
[[nodiscard]] bool is_modified(const ToothedOutline& teeth);

}  // namespace trueflank::io
