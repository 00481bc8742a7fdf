// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/discovery.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/loud_places.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Folds of the cross-validation, and the one of tips, roots and sizes.
inline constexpr int kFolds = 8, kAnchorFold = kFolds + 1;

struct WeightedPlace {
  Place place;
  double weight = 1.0;
};

/// Observations gathered into small patches of a flank (or pieces of a trace): their means carry
/// all the effects at a fraction of the rows, and random error that hangs together stays inside.
struct Patches {
  struct Patch {
    std::vector<WeightedPlace> places;  ///< at the patch's mean roll and height
    std::vector<Place> sample;  ///< of its values, up to eight: what varies inside is seen by these
    double mean_um = 0.0;
    double count = 0.0;
    double weight = 0.0;
    double loud = 1.0;  ///< its values' random error over the usual one (scanned flanks)
    double z_low_mm = 1e300, z_high_mm = -1e300;  ///< of its values
    int unit = 0, fold = 0, zero = -1, source = 0;
    int whole = -1;  ///< the trace or flank it is a piece of; -1: a single value, tip, root or bore
    ObservationKind kind = ObservationKind::kScanFlank;
  };
  std::vector<Patch> patches;
  std::vector<int> patch_of_row;
  int units = 0;
  std::vector<LouderPlace> louder;  ///< of scans
  /// How much the flanks of each scan scatter, beside each other: its source, their teeth and
  /// sides.
  std::vector<std::pair<int, std::vector<MemberScatter>>> flank_scatters;

  std::vector<std::pair<std::size_t, double>> left_out;  ///< patches, and the weight they had

  /// Takes the weight from patches with values on both sides of a step: their mean is on neither.
  /// Those left out for other heights before get theirs back.
  void leave_out_across(const std::vector<double>& heights_mm) {
    constexpr double kNearlyNothing = 1e-6;
    for (const auto& [patch, weight] : left_out) patches[patch].weight = weight;
    left_out.clear();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      Patch& patch = patches[i];
      for (const double z_mm : heights_mm) {
        if (!(patch.z_low_mm <= z_mm && patch.z_high_mm > z_mm)) continue;
        left_out.emplace_back(i, patch.weight);
        patch.weight *= kNearlyNothing;
        break;
      }
    }
  }
};

/// Folds: 0 is the locked hold-out, about a fifth. A scan is held out in patches of one tooth and
/// one of five height bands, so that every tooth and every height is also seen; traces, index and
/// radial values by whole teeth, or by whole traces where fewer than five teeth were measured.
/// Weights: inverse variance of the patch means of each kind, from differences of neighbours; where
/// it is given, from those of what is left of every row.
[[nodiscard]] Patches make_patches(const FlankGeometry& geometry, const Observations& table,
                                   const std::vector<float>* left_um = nullptr);
/// Takes the weights of scans with louder places anew from what effects leave of every row: patches
/// on the slopes of a narrow ridge scatter by where their values lie on it. False, and nothing is
/// done, where few count for more.
[[nodiscard]] bool weigh_again(const FlankGeometry& geometry, const Observations& table,
                               const std::vector<float>& left_um, Patches& patches);

/// Nuisance columns of a table: what the pose of each scan can still do.
class NuisanceColumns {
 public:
  NuisanceColumns(const FlankGeometry& geometry, const Observations& table);
  [[nodiscard]] int count() const { return count_; }
  /// Of a scan in any pose: a turn about the axis, shifts along x and y, turns about x and y through
  /// the middle of the face, in thousandths and um.
  static constexpr int kOfFreePose = 5;
  [[nodiscard]] int first_of(std::size_t scan) const { return sources_[scan].first; }
  /// The columns at a place of a source.
  void set(const Place& place, ObservationKind kind, int source, double* values) const {
    if (count_ == kOfFreePose)  // (as a rule: no loop)
      for (int k = 0; k < kOfFreePose; ++k) values[k] = 0.0;
    else
      for (int k = 0; k < count_; ++k) values[k] = 0.0;
    add(place, kind, source, 1.0, values);
  }
  /// Adds weight times the columns at a place of a source.
  void add(const Place& place, ObservationKind kind, int source, double weight,
           double* values) const {
    if (source >= static_cast<int>(sources_.size())) return;
    if (kind == ObservationKind::kScanTip || kind == ObservationKind::kScanRoot) return;
    const Source& of = sources_[static_cast<std::size_t>(source)];
    double* const c = values + of.first;
    const double x = place.radius_mm * place.polar_direction[0];
    const double y = place.radius_mm * place.polar_direction[1];
    const double transverse = place.surface == Surface::kFlank ? cos_base_helix_ : 1.0;
    const double nx = transverse * place.normal_direction[0];
    const double ny = transverse * place.normal_direction[1];
    c[0] += weight * (x * ny - y * nx);  // turn about the axis
    if (!of.free) return;
    const double nz = geometry_.normal_z(place);
    const double z = place.z_mm - 0.5 * geometry_.face_width_mm();
    c[1] += weight * nx;
    c[2] += weight * ny;
    c[3] += weight * (y * nz - z * ny);
    c[4] += weight * (z * nx - x * nz);
  }

 private:
  /// Of a scan: its first column, and whether it is free in all directions.
  struct Source {
    int first = 0;
    bool free = false;
  };
  const FlankGeometry& geometry_;
  double cos_base_helix_ = 1.0;
  std::vector<Source> sources_;
  int count_ = 0;
};

/// Effects whose columns of the same patches are at hand.
struct KnownColumns {
  const std::vector<Effect>& effects;
  const DiscoveryProblem& problem;
};

/// The discovery problem of a table: one row a patch. Columns that are known are copied.
[[nodiscard]] DiscoveryProblem make_problem(const FlankGeometry& geometry,
                                            const Observations& table, const Patches& patches,
                                            const std::vector<Effect>& effects,
                                            const KnownColumns* known = nullptr);
/// Other candidates for a problem of the same patches; those that stand where they stood before are
/// kept, and so are sums over them (DiscoveryProblem::kept).
void set_candidates(const FlankGeometry& geometry, const Patches& patches,
                    const std::vector<Effect>& before, const std::vector<Effect>& effects,
                    DiscoveryProblem& problem, const KnownColumns* known = nullptr);

}  // namespace trueflank::loop
