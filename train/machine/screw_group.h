// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/point2.h"
#include "trueflank/train/machine/elements.h"

namespace trueflank {

/// Free depth over a screw's head.
inline constexpr double kHeadCover_mm = 0.2;
/// Room round a screw's head, on the radius.
inline constexpr double kHeadRoom_mm = 0.3;
/// Under a screw's head there is this much of the material at least, of the thread's diameter.
inline constexpr double kUnderHead = 0.8;

/// Screws of one kind at one place. Heights as in MachineLayout.
struct ScrewGroup {
  std::string what;  ///< "housing", "carrier", ...
  Screw screw = {};
  double length_mm = 0.0;       ///< stocked; 0: none of the stocked lengths does
  std::vector<Point2> at = {};  ///< about `axis`, in the frame of the body it is in
  Point2 axis = Point2::Zero();  ///< of that body, in the assembly
  double head_mm = 0.0;         ///< where the head rests
  double way = 1.0;             ///< +1: the shank points to the output, -1: to the motor
  double far_mm = 0.0;  ///< the face through which the insert is pressed in, on the shank's side
  double insert_mm =
      kNaN;  ///< the insert's end nearer the head; NaN: none, the motor's own threads or nuts
  double shortest_mm = 0.0,
         longest_mm = 0.0;  ///< between these a length would do at the deepest head

  [[nodiscard]] bool fits() const { return length_mm > 0.0; }
  [[nodiscard]] double tip_mm() const { return head_mm + way * length_mm; }
  [[nodiscard]] double head_top_mm() const { return head_mm - way * screw.head_height_mm; }
};

/// Equal steps on a circle about the origin.
[[nodiscard]] std::vector<Point2> on_circle(double radius_mm, int count, double first_rad);

/// Height that a screw's head takes with what covers it, and least height of the material under it.
[[nodiscard]] double head_depth_mm(const Screw& screw);
[[nodiscard]] double under_head_mm(const Screw& screw, double wall_mm);

/// The shortest stocked length that holds: the tip a diameter deep in the insert, not through the
/// far face. Where none does, the head goes deeper, by at most `deeper_mm`; the insert moves with
/// the tip.
[[nodiscard]] ScrewGroup with_length(ScrewGroup group, double clamped_mm, double deeper_mm);

}  // namespace trueflank
