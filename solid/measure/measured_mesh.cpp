// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/measured_mesh.h"

#include <algorithm>

#include "trueflank/solid/measure/mesh_accuracy.h"

namespace trueflank {
namespace {

/// What each round asks for at most, as a share of the round before. An error falls with the
/// tolerance as a rule and the first is enough; but rows and columns are whole numbers, and one
/// more may take a jump.
constexpr double kSteps[] = {0.96, 0.8, 0.65, 0.5, 0.35};
/// What is measured of displaced teeth is right within 2 % (mesh_accuracy.h): they are made this far below.
constexpr double kRightWithin = 0.98;
/// Below the goal by so much: an error does not fall quite as fast as the tolerance.
constexpr double kRoom = 0.96;
/// No round asks for less than this share of the last: facets grow with its inverse.
constexpr double kSmallestStep = 0.25;

bool has_displaced_teeth(const PartShape& shape) {
  const auto displaced = [](const Outline& outline) {
    const auto* toothed = std::get_if<ToothedOutline>(&outline);
    return toothed != nullptr && toothed->displacement != nullptr;
  };
  return std::any_of(shape.slabs.begin(), shape.slabs.end(), [&](const Slab& slab) {
    return displaced(slab.outer) || std::any_of(slab.holes.begin(), slab.holes.end(), displaced);
  });
}

MeasuredMesh mesh_and_measure(const PartShape& shape, double tolerance_mm) {
  MeasuredMesh result{.part = part_mesh(shape, {.tolerance_mm = tolerance_mm})};
  result.accuracy_mm = measure_accuracy(result.part.mesh, shape).largest_mm();
  return result;
}

}  // namespace

MeasuredMesh measured_part_mesh(const PartShape& shape, const MeshOptions& options) {
  const double goal_mm = options.tolerance_mm * (has_displaced_teeth(shape) ? kRightWithin : 1.0);
  MeasuredMesh best = mesh_and_measure(shape, goal_mm);
  double aim_mm = goal_mm, last_mm = best.accuracy_mm;
  for (const double step : kSteps) {
    if (best.accuracy_mm <= goal_mm) break;
    aim_mm *= std::clamp(kRoom * goal_mm / last_mm, kSmallestStep, step);
    MeasuredMesh next = mesh_and_measure(shape, aim_mm);
    last_mm = next.accuracy_mm;
    if (next.accuracy_mm < best.accuracy_mm) best = std::move(next);
  }
  return best;
}

}  // namespace trueflank
