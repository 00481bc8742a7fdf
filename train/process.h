// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

// What a way of making parts can make: limits to check against, and what its files need.
namespace trueflank {

/// Zero: no such limit, no such effect.
struct Process {
  std::string name;
  double nozzle_mm = 0.0;  ///< width of what lays material down: bead, laser spot, pixel
  double layer_mm = 0.0;   ///< layer height
  double least_wall_mm = 0.0;        ///< walls: rims, bore to root circle
  double least_tip_mm = 0.0;         ///< free-standing features: thickness of tooth tips
  double least_gap_mm = 0.0;         ///< gaps: narrowest place between two teeth
  double least_root_radius_mm = 0.0; ///< concave corners: a wire's or cutter's own radius
  double backlash_mm = 0.0;          ///< recommended least circumferential backlash of a mesh
  /// Every wall comes out this much too far outwards (material grows); + is compensated inwards.
  double horizontal_expansion_mm = 0.0;
  double elephant_foot_mm = 0.0;         ///< how far the first layers spread, at the bed
  double elephant_foot_height_mm = 0.0;  ///< over this height
  double kerf_mm = 0.0;                  ///< width of a wire's or beam's cut
  double ledge_mm = 0.0;  ///< a flat underside may stand out so far without support
  double bridge_mm = 0.0;  ///< and span so much between what carries it
  double overhang_rad = 0.0;  ///< and a slanted one lean so far from the vertical
  int tolerance_class = 0;            ///< ISO 1328-1 class that its gears keep; 0: none
  double axis_tolerance_mm = 0.0;       ///< +-, of the distance of two axes
  double thickness_tolerance_mm = 0.0;  ///< +-, of a tooth on the reference circle
  double runout_mm = 0.0;               ///< of every gear, where no class says it
  std::string source = {};  ///< where the values come from, or that they are typical

  bool operator==(const Process&) const = default;
};

/// Presets a user can extend and override (docs/made.md).
class ProcessTable {
 public:
  /// The built-in presets.
  ProcessTable();

  /// Adds a process, or replaces the one of that name.
  void set(Process process);
  /// nullptr where there is none.
  [[nodiscard]] const Process* find(const std::string& name) const;
  [[nodiscard]] const std::vector<Process>& all() const { return processes_; }

 private:
  std::vector<Process> processes_;
};

}  // namespace trueflank
