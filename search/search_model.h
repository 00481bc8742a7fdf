// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/geometry/gear_pair.h"
#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/efficiency_sliding.h"
#include "trueflank/train/gearbox_design.h"

// What an optimiser sees of one tooth set: efficiency and the margins of all limits as functions of
// the centre distance and the free shifts. Lengths are in modules of layer 1.
namespace trueflank {

/// The free variables; every other shift follows from the centre distance. A layer's free shift is
/// its ring's; without a ring its planet's (of a pair, its wheel's).
struct FreeShifts {
  double centre_distance = kNaN, layer1_shift = kNaN;
  double layer2_shift = kNaN;  ///< 0 where there is one layer

  bool operator==(const FreeShifts&) const = default;
};

/// What a design's size is where a torque asked for decides it.
struct DesignDimensions {
  double face_width_mm = kNaN, module_mm = kNaN;  ///< NaN: as the requirements say

  bool operator==(const DesignDimensions&) const = default;
};

/// Loss of one mesh, as the torque balance takes it.
struct MeshLoss {
  double driving1 = kNaN, driving2 = kNaN;  ///< efficiency where gear 1, gear 2 drives
};
struct LayerEvaluation {
  MeshLoss sun_planet, planet_ring;            ///< NaN where there is no such mesh
  std::array<double, kLayerLimits> margins{};  ///< in the order of SearchTrain::limits
  double least_margin = -1e9;
};

struct LayerSetting;
struct PartlyJudged;
class Margins;

/// One tooth set.
class SearchModel {
 public:
  SearchModel(const SearchRequirements& requirements, const ToothSet& set);

  /// Cheap margins come first. Evaluation ends as soon as a margin is below `stop_below`, or where
  /// `worth`, asked with the losses before profiles are made (by the path between the tips, where
  /// no undercut can shorten it), says no; what was not computed is -1e9.
  [[nodiscard]] LayerEvaluation layer1(
      double centre_distance, double shift, double stop_below = -1e300,
      const std::function<bool(const LayerEvaluation&)>& worth = {}) const {
    return layer(0, centre_distance, shift, stop_below, worth);
  }
  /// Of a train with one layer: no limit, no mesh.
  [[nodiscard]] LayerEvaluation layer2(
      double centre_distance, double shift, double stop_below = -1e300,
      const std::function<bool(const LayerEvaluation&)>& worth = {}) const {
    return layer(1, centre_distance, shift, stop_below, worth);
  }

  /// The margins that need no profiles, computed; those that do, when they are asked for. No losses.
  /// Where a margin is below `stop_below`, what was not computed is -1e9.
  [[nodiscard]] PartlyJudged in_parts(int layer, double centre_distance, double shift,
                                      double stop_below) const;

  /// The margins that need no profiles, and losses no greater than the true ones: where undercut or
  /// a fillet may shorten the path, those of its best part.
  [[nodiscard]] LayerEvaluation outline(int layer, double centre_distance, double shift,
                                        double stop_below) const;

  /// Efficiency from mesh losses; 0 where the train locks. Equal to solve_balance (tested), without
  /// trying every assignment each time.
  [[nodiscard]] double efficiency(const LayerEvaluation& layer1, const LayerEvaluation& layer2,
                                  DriveDirection direction) const;

  /// Interval of a layer's free shift within which all gears of it keep their shift bounds.
  [[nodiscard]] std::array<double, 2> shift_range(int layer, double centre_distance) const;

  /// Diameter of the smallest circle around all gears, over the module of layer 1: of rings outside
  /// their rims, of planets on their way round, of both gears of a pair.
  [[nodiscard]] double outer_diameter(const FreeShifts& free) const;
  /// Module of layer 1 [mm].
  [[nodiscard]] double module_mm(const FreeShifts& free) const;

  /// The smallest module of layer 1 that any shifts give [mm].
  [[nodiscard]] double least_module_mm() const { return least_module_mm_; }

  /// The design file's design: all shifts and the centre distance stated, rings with their outer
  /// diameters.
  [[nodiscard]] GearboxDesign design(const FreeShifts& free,
                                     const DesignDimensions& dimensions = {}) const;

  [[nodiscard]] const ToothSet& set() const { return set_; }

  [[nodiscard]] const SearchTrain& train() const { return *set_.train; }
  [[nodiscard]] bool has_layer2() const { return set_.train->layers.size() > 1; }
  [[nodiscard]] std::size_t limits() const { return set_.train->limits.size(); }

  /// A mesh in the torque balance.
  struct BalanceMesh {
    int layer = 0;
    bool internal = false;
    double teeth_ratio = kNaN;  ///< of gear 2 to gear 1, negative where internal
    bool gear1_drives_forward = true;
    int member1 = 0, member2 = 0;
  };
  [[nodiscard]] const std::vector<BalanceMesh>& balance() const { return balance_; }
  /// Input speed over output speed, signed.
  [[nodiscard]] double ratio() const { return ratio_; }

 private:
  /// Shifts at their places; 0 where there is no gear.
  using Shifts = std::array<double, kTrainPlaces>;
  /// One layer with its tooth numbers; 0: no such gear.
  struct Layer {
    int sun = 0, planet = 0, ring = 0;
    MeshTeeth sun_planet, planet_ring;
    double module = 1.0;  ///< over that of layer 1
    TrainPlace sun_at = TrainPlace::kSun, planet_at = TrainPlace::kPlanet1,
               ring_at = TrainPlace::kRing1;
  };
  enum class Profiles { kMade, kLeftOut };

  /// Up to the margins that need profiles; nothing where one before is below what ends it.
  [[nodiscard]] std::optional<LayerSetting> set_out(int number, double centre_distance,
                                                    double shift, Margins& margins) const;
  [[nodiscard]] std::size_t limits_of(int number) const;
  [[nodiscard]] LayerEvaluation layer(
      int number, double centre_distance, double shift, double stop_below,
      const std::function<bool(const LayerEvaluation&)>& worth,
      Profiles profiles = Profiles::kMade) const;
  [[nodiscard]] Shifts shifts(const FreeShifts& free) const;
  void add_shifts(int number, double centre_distance, double shift, Shifts& x) const;
  void set_up_layers();
  void set_up_balance();
  [[nodiscard]] double greatest_outer_diameter() const;
  /// Of a gear, or of gears together, in normal modules.
  [[nodiscard]] double reference_radius(int teeth) const;
  /// External torque on the output per unit of torque at the input: the negative ratio where
  /// nothing is lost.
  [[nodiscard]] double output_torque(const std::array<double, 3>& torque_ratios) const;

  const SearchRequirements* requirements_;
  ToothSet set_;
  std::vector<Layer> layers_;
  std::vector<BalanceMesh> balance_;
  double ratio_ = kNaN;  ///< input speed over output speed
  double least_module_mm_ =
      kNaN;  ///< clearances in mm are kept with this: cautious where it varies
};

}  // namespace trueflank
