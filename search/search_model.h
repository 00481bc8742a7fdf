// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "trueflank/geometry/gear_pair.h"
#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/efficiency_sliding.h"
#include "trueflank/train/gearbox_design.h"

// What an optimiser sees of one tooth set: efficiency and the margins of all limits as functions of
// the centre distance and the ring shifts. Lengths are in modules of layer 1.
namespace trueflank {

/// The free variables; every other shift follows from the centre distance.
struct FreeShifts {
  double centre_distance = kNaN, ring1_shift = kNaN, ring2_shift = kNaN;

  bool operator==(const FreeShifts&) const = default;
};

/// Limits of layer 1 and of layer 2. A margin >= 0 keeps the limit; lengths in modules of the layer.
enum class Limit {
  kShift,            ///< a shift beyond its bounds
  kContactRatio,     ///< of any mesh: from the tip circles, and what undercut and root form leave
  kFillet,           ///< a tip corner cuts into the mate's root (search_corner.h)
  kTipClearance,
  kTrochoid,         ///< tips of planet and ring collide outside the line of action
  kTipThickness,
  kPlanetSpacing,
  kRingTip,          ///< ring tip inside its base circle
};
[[nodiscard]] const char* to_text(Limit limit);

struct LimitEntry {
  Limit limit;
  int layer;
  const char* where;
};
inline constexpr std::size_t kLayer1Limits = 24;
inline constexpr std::size_t kLayer2Limits = 14;
inline constexpr std::size_t kLimits = kLayer1Limits + kLayer2Limits;
/// What each margin is of; order of SetEvaluation::margins.
[[nodiscard]] const std::array<LimitEntry, kLimits>& limit_entries();

/// Loss of one mesh, as the torque balance takes it.
struct MeshLoss {
  double driving1 = kNaN, driving2 = kNaN;  ///< efficiency where gear 1, gear 2 drives
};
struct Layer1Evaluation {
  MeshLoss sun_planet, planet_ring;
  std::array<double, kLayer1Limits> margins{};
  double least_margin = -1e9;
};
struct Layer2Evaluation {
  MeshLoss planet_ring;
  std::array<double, kLayer2Limits> margins{};
  double least_margin = -1e9;
};

/// One tooth set.
class SearchModel {
 public:
  SearchModel(const SearchRequirements& requirements, const ToothSet& set);

  /// Cheap margins come first. Evaluation ends as soon as a margin is below `stop_below`, or where
  /// `worth`, asked with the losses before profiles are made (by the path between the tips, where no undercut
  /// can shorten it), says no; what was not computed is -1e9.
  [[nodiscard]] Layer1Evaluation layer1(
      double centre_distance, double ring1_shift, double stop_below = -1e300,
      const std::function<bool(const Layer1Evaluation&)>& worth = {}) const;
  [[nodiscard]] Layer2Evaluation layer2(
      double centre_distance, double ring2_shift, double stop_below = -1e300,
      const std::function<bool(const Layer2Evaluation&)>& worth = {}) const;

  /// Efficiency from mesh losses; 0 where the train locks. Equal to solve_balance (tested), without
  /// trying every assignment each time.
  [[nodiscard]] double efficiency(const MeshLoss& a, const MeshLoss& b, const MeshLoss& c,
                                  DriveDirection direction) const;

  /// Interval of ring1's shift within which sun, planet1 and ring1 keep their shift bounds.
  [[nodiscard]] std::array<double, 2> ring1_shift_range(double centre_distance) const;
  [[nodiscard]] std::array<double, 2> ring2_shift_range(double centre_distance) const;

  /// Larger of both rings' outer diameters over the module of layer 1.
  [[nodiscard]] double outer_diameter(const FreeShifts& free) const;
  /// Module of layer 1 [mm].
  [[nodiscard]] double module_mm(const FreeShifts& free) const;

  /// The smallest module of layer 1 that any shifts give [mm].
  [[nodiscard]] double least_module_mm() const { return least_module_mm_; }

  /// The design file's design: all shifts and the centre distance stated, rings with their outer
  /// diameters.
  [[nodiscard]] GearboxDesign design(const FreeShifts& free) const;

  [[nodiscard]] const ToothSet& set() const { return set_; }

 private:
  struct Shifts {
    double sun, planet1, ring1, planet2, ring2;
  };
  [[nodiscard]] Shifts shifts(const FreeShifts& free) const;
  [[nodiscard]] MeshLoss formula_loss(const MeshTeeth& mesh, double approach, double recess) const;
  [[nodiscard]] MeshLoss path_loss(ContactPath path) const;

  const SearchRequirements* requirements_;
  ToothSet set_;
  MeshTeeth mesh_a_, mesh_b_, mesh_c_;
  std::array<bool, 3> gear1_drives_forward_{}, gear1_drives_backward_{};
  double sun_speed_over_output_ = kNaN;
  double least_module_mm_ = kNaN;  ///< clearances in mm are kept with this: cautious where it varies
};

}  // namespace trueflank
