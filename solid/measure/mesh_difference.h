// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/solid/measure/mesh_compare.h"
#include "trueflank/solid/measure/mesh_section.h"
#include "trueflank/solid/measure/section_teeth.h"

namespace trueflank {

/// One point of an outline and how far the other outline is from it, within the section.
struct OutlineDeviation {
  Point2 point;               ///< in the section's axes [mm]
  Point2 nearest;             ///< the other outline's nearest point
  double deviation_mm = 0.0;  ///< positive where the new part has too much material
};

/// Deviations once along a closed outline: its corners, and points between them.
struct OutlineRun {
  bool on_golden = false;
  std::vector<OutlineDeviation> points;
};

/// What a part of all teeth has in common, in the section: "left flanks", "tips".
struct RegionDifference {
  ToothRegion region = ToothRegion::kTip;
  double least_mm = 0.0, greatest_mm = 0.0;  ///< deviations
  int teeth_off = 0;                         ///< with a deviation beyond the tolerance there
};

/// Where two meshes differ most, in section and in words.
struct MeshDifference {
  SectionPlane plane;     ///< through the worst place: across the axis, or along it
  bool across_axis = true;  ///< false: what differs is an end face, and the plane holds the axis
  MeshSection golden, made;
  std::vector<OutlineRun> outlines;  ///< of both parts, where both have one
  Point2 worst{0.0, 0.0};                 ///< in the section's axes
  double worst_deviation_mm = 0.0;  ///< sign: as in OutlineDeviation; size: MeshComparison::largest_mm()
  std::optional<SectionTeeth> teeth;  ///< of the golden part there
  bool on_teeth = false;  ///< the worst place is on the outline that has them
  std::string place;  ///< "left flank of tooth 3", "end face at z = 10 mm", "bore", "rim", "outline"
  std::vector<RegionDifference> regions;  ///< where there are teeth, in ToothRegion's order
};

/// Looks at the worst place that compare_meshes() found. Frame: gear axis = z.
/// Not guaranteed: deviations in the section are at least the distances in space, and more on slanted
/// faces. Requires: meshes with triangles, finite coordinates; a comparison of these two.
/// Cost: a second comparison's at most.
[[nodiscard]] MeshDifference mesh_difference(const TriangleMesh& golden, const TriangleMesh& made,
                                             const MeshComparison& comparison,
                                             const CompareOptions& options = {});

}  // namespace trueflank
