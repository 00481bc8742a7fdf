// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueflank/train/topology.h"

// What a search needs to know of a kind of train. All of it follows from the kind's topology: which
// gears share a layer, which meshes tie their shifts, how speeds and torques depend on the tooth
// numbers.
namespace trueflank {

/// Limits of layer 1 and of layer 2. A margin >= 0 keeps the limit; lengths in modules of the
/// layer.
enum class Limit {
  kShift,         ///< a shift beyond its bounds
  kContactRatio,  ///< of any mesh: from the tip circles, and what undercut and root form leave
  kFillet,        ///< a tip corner cuts into the mate's root (search_corner.h)
  kTipClearance,
  kTrochoid,  ///< tips of planet and ring collide outside the line of action
  kTipThickness,
  kPlanetSpacing,
  kRingTip,  ///< ring tip inside its base circle
};
[[nodiscard]] const char* to_text(Limit limit);

struct LimitEntry {
  Limit limit;
  int layer;
  std::string where;  ///< gear or mesh
  std::string which = {};  ///< of several of this limit there: "least", "root of ring1"; else empty
};
/// The most limits a layer, a train can have: a layer of sun, planet and ring, and one of planet
/// and ring.
inline constexpr std::size_t kLayerLimits = 24;
inline constexpr std::size_t kLimits = 38;

/// Gears that mesh with one another: a sun outside the planet, a ring around it, or both. One shift
/// is free; the others follow from the centre distance. Indices into the topology; -1: not there. A
/// pair counts its pinion as sun and its external wheel as planet, or its pinion as planet and its
/// internal wheel as ring.
struct SearchLayer {
  int sun = -1, planet = -1, ring = -1;
  int sun_planet = -1, planet_ring = -1;  ///< meshes
};

/// The places a tooth number can have in a set.
enum class TrainPlace { kSun, kPlanet1, kRing1, kPlanet2, kRing2 };
inline constexpr std::size_t kTrainPlaces = 5;
using ToothNumbers = std::array<int, kTrainPlaces>;

/// A train that can be searched: a kind with its input, its output and what its wheel is.
struct SearchTrain {
  Topology topology;   ///< without gears that idle
  std::string output;  ///< as the design file names it
  std::string input;
  bool internal_wheel = false;      ///< of a pair
  int stage = 0;  ///< of a train in series this stage alone, from 1 (search_stages.h); 0: the whole
  std::vector<SearchLayer> layers;  ///< one or two
  std::vector<LimitEntry> limits;   ///< what each margin is of: layer 1, then layer 2
  std::size_t layer1_limits = 0;    ///< of them

  [[nodiscard]] bool has_planets() const { return topology.has_planets(); }
  [[nodiscard]] const std::string& kind() const { return topology.kind; }
  /// Where a gear of the topology stands.
  [[nodiscard]] TrainPlace place_of(int gear) const;
  /// The places of its gears, in their order.
  [[nodiscard]] std::vector<TrainPlace> places() const;
  /// The gear at a place; its design file's name.
  [[nodiscard]] const std::string& name_at(TrainPlace place) const;
  /// Input speed over output speed, signed; infinite where the output stands still.
  /// Guarantees: whole numbers up to the one division: correctly rounded.
  [[nodiscard]] double signed_ratio(const ToothNumbers& teeth) const;
  /// Whether bodies at equal spacing mesh with all gears about the axis.
  [[nodiscard]] bool accepts_planets(const ToothNumbers& teeth, int planets) const;
  /// Whether the bodies at equal spacing are all alike.
  [[nodiscard]] bool planets_are_identical(const ToothNumbers& teeth, int planets) const;
};

/// Every train that can be searched; its kinds in the order of train_kinds(), the usual output
/// first.
[[nodiscard]] const std::vector<SearchTrain>& search_trains();
/// The first of a kind; the 3k of type I where no kind is named. Requires: there is one.
[[nodiscard]] const SearchTrain& usual_search_train(const std::string& kind = "3k");
/// "3k, stepped, simple, two-stage, pair".
[[nodiscard]] std::string searched_kind_names();

}  // namespace trueflank
