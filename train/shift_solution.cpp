// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/train/shift_solution.h"

#include <cmath>
#include <optional>

namespace trueflank {
namespace {

class ShiftSolver {
 public:
  ShiftSolver(const GearboxDesign& design, const std::vector<TrainMesh>& meshes)
      : design_(design), meshes_(meshes) {
    for (const GearDesign& gear : design.gears) shifts_.push_back(gear.shift);
  }

  ResultAll<ShiftSolution> solve() {
    check_pairs();
    if (!errors_.empty()) return fail_all(std::move(errors_));
    ShiftSolution solution;
    if (meshes_.empty()) {
      for (const auto& shift : shifts_) solution.shifts.push_back(shift.value_or(0.0));
      return solution;
    }
    if (auto a = centre_distance(); a) {
      solution.centre_distance_mm = *a;
    } else {
      errors_.push_back(a.error());
      return fail_all(std::move(errors_));
    }
    propagate(solution.centre_distance_mm);
    if (!errors_.empty()) return fail_all(std::move(errors_));
    for (const auto& shift : shifts_) solution.shifts.push_back(shift.value_or(0.0));
    for (const TrainMesh& mesh : meshes_)
      solution.implied_backlash_mm.push_back(implied_backlash(mesh, solution));
    return solution;
  }

 private:
  [[nodiscard]] const GearDesign& gear(int i) const {
    return design_.gears[static_cast<std::size_t>(i)];
  }
  std::optional<double>& shift(int i) { return shifts_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] MeshTeeth teeth(const TrainMesh& mesh) const {
    return {.teeth1 = gear(mesh.gear1).teeth,
            .teeth2 = gear(mesh.gear2).teeth,
            .internal = gear(mesh.gear2).kind == GearKind::kInternal,
            .normal_module_mm = module_of(design_, gear(mesh.gear1)),
            .helix_angle_rad = design_.helix_angle_rad,
            .pressure_angle_rad = design_.rack.pressure_angle_rad};
  }

  void check_pairs() {
    for (const TrainMesh& mesh : meshes_) {
      const GearDesign &g1 = gear(mesh.gear1), &g2 = gear(mesh.gear2);
      if (module_of(design_, g1) != module_of(design_, g2))
        errors_.push_back({.code = ErrorCode::kInconsistent,
                           .message = mesh.name + ": gears in mesh need one module",
                           .key = g2.name + ".module_mm",
                           .value = trimmed_number(module_of(design_, g2)),
                           .remedy = "the module of " + g1.name + ", " +
                                     trimmed_number(module_of(design_, g1))});
      if (g2.kind == GearKind::kInternal && g2.teeth <= g1.teeth)
        errors_.push_back({.code = ErrorCode::kInconsistent,
                           .message = mesh.name + ": a ring needs more teeth than the gear in it",
                           .key = g2.name + ".teeth",
                           .value = std::to_string(g2.teeth),
                           .remedy = "more than " + std::to_string(g1.teeth)});
    }
  }

  /// x1 + x2 or x2 - x1 of a mesh whose shifts are known.
  double sum_of(const TrainMesh& mesh) {
    const double x1 = *shift(mesh.gear1), x2 = *shift(mesh.gear2);
    return teeth(mesh).internal ? x2 - x1 : x1 + x2;
  }

  Result<double> centre_distance() {
    if (design_.centre_distance_mm) return *design_.centre_distance_mm;
    const TrainMesh* best = &meshes_.front();
    int known_best = -1;
    for (const TrainMesh& mesh : meshes_) {
      const int known = shift(mesh.gear1).has_value() + shift(mesh.gear2).has_value();
      if (known > known_best) {
        known_best = known;
        best = &mesh;
      }
    }
    for (int i : {best->gear1, best->gear2})
      if (!shift(i)) shift(i) = 0.0;
    auto a = zero_backlash_centre_distance_mm(teeth(*best), sum_of(*best));
    if (!a) {
      Error error = a.error();
      error.key = gear(best->gear2).name + ".shift";
      error.message = best->name + ": " + error.message;
      return fail(std::move(error));
    }
    return a;
  }

  /// Settles the other gear of every mesh with one known shift; true where anything was settled.
  bool settle_known(double a) {
    bool any = false;
    for (const TrainMesh& mesh : meshes_) {
      auto &x1 = shift(mesh.gear1), &x2 = shift(mesh.gear2);
      if (x1.has_value() == x2.has_value()) continue;
      const auto sum = sum_at(mesh, a);
      if (!sum) return false;
      if (x1)
        x2 = teeth(mesh).internal ? *sum + *x1 : *sum - *x1;
      else
        x1 = teeth(mesh).internal ? *x2 - *sum : *sum - *x2;
      any = true;
    }
    return any;
  }

  std::optional<double> sum_at(const TrainMesh& mesh, double a) {
    const auto working = working_pressure_angle_rad(teeth(mesh), a);
    if (!working) {
      Error error = working.error();
      error.message = mesh.name + ": " + error.message;
      errors_.push_back(std::move(error));
      return std::nullopt;
    }
    return shift_sum(teeth(mesh), *working);
  }

  void propagate(double a) {
    for (const TrainMesh& mesh : meshes_)
      if (!sum_at(mesh, a)) continue;
    if (!errors_.empty()) return;
    for (;;) {
      while (settle_known(a)) {
      }
      const TrainMesh* open = nullptr;
      for (const TrainMesh& mesh : meshes_)
        if (!shift(mesh.gear1) && !shift(mesh.gear2) && !open) open = &mesh;
      if (!open) return;
      free_choice(*open, a);
    }
  }

  void free_choice(const TrainMesh& mesh, double a) {
    if (teeth(mesh).internal)
      shift(mesh.gear1) = 0.0;
    else if (design_.topology.is_planet_gear(static_cast<std::size_t>(mesh.gear2)))
      shift(mesh.gear2) = 0.0;
    else
      shift(mesh.gear1) = 0.5 * *sum_at(mesh, a);
  }

  double implied_backlash(const TrainMesh& mesh, const ShiftSolution& solution) {
    if (!gear(mesh.gear1).shift || !gear(mesh.gear2).shift) {
      // solved, unless both were settled by other meshes
      const double missing = sum_of(mesh) - *sum_at(mesh, solution.centre_distance_mm);
      if (std::abs(missing) < 1e-12) return 0.0;
    }
    // The sum that has zero backlash, less the sum there is, as arcs at the working pitch circle.
    const MeshTeeth t = teeth(mesh);
    const auto working = working_pressure_angle_rad(t, solution.centre_distance_mm);
    const double missing = shift_sum(t, *working) - sum_of(mesh);
    const double alpha_t =
        std::atan(std::tan(t.pressure_angle_rad) / std::cos(t.helix_angle_rad));
    const double at_reference = 2.0 * t.normal_module_mm * std::tan(t.pressure_angle_rad) /
                                std::cos(t.helix_angle_rad) * missing;
    const double arc = at_reference * std::cos(alpha_t) / std::cos(*working);
    return t.internal ? -arc : arc;
  }

  const GearboxDesign& design_;
  const std::vector<TrainMesh>& meshes_;
  std::vector<std::optional<double>> shifts_;
  Errors errors_;
};

}  // namespace

ResultAll<ShiftSolution> solve_shifts(const GearboxDesign& design,
                                      const std::vector<TrainMesh>& meshes) {
  return ShiftSolver(design, meshes).solve();
}

}  // namespace trueflank
