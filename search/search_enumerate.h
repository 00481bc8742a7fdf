// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "trueflank/search/search_requirements.h"
#include "trueflank/search/search_train.h"

namespace trueflank {

/// The trains that are searched, in the order of the kinds asked for; those that differ in their
/// output alone are neighbours.
[[nodiscard]] std::vector<const SearchTrain*> searched_trains(
    const SearchRequirements& requirements);

/// The tooth numbers asked for of the gear at a place of a train.
[[nodiscard]] ToothRange tooth_range(const SearchRequirements& requirements,
                                     const SearchTrain& train, TrainPlace place);

/// One choice of the whole numbers (and the ratio of the modules). Places without a gear hold 0.
struct ToothSet {
  int sun = 0, planet1 = 0, ring1 = 0, planet2 = 0, ring2 = 0;
  const SearchTrain* train = &usual_search_train();
  int planets = 3;
  double layer2_module_ratio = 1.0;
  /// Centre distances, in modules of layer 1, at which all shifts can lie within their bounds.
  double centre_distance_min = 0.0, centre_distance_max = 0.0;

  bool operator==(const ToothSet&) const = default;

  [[nodiscard]] ToothNumbers teeth() const { return {sun, planet1, ring1, planet2, ring2}; }
  [[nodiscard]] int teeth_at(TrainPlace place) const {
    return teeth()[static_cast<std::size_t>(place)];
  }
};

/// Input speed over output speed, signed; infinite where the output stands still.
[[nodiscard]] double signed_ratio(const ToothSet& set);

/// Whether every tooth of a gear meets every tooth of its mate: tooth numbers without a common
/// divisor, in every mesh.
[[nodiscard]] bool has_hunting_teeth(const ToothSet& set);
/// Whether in every mesh of identical planets at equal spacing these engage one after another: the
/// teeth of the gear about the axis are no multiple of their number. The forces of the mesh frequency
/// then cancel in their sum about the axis; where they are a multiple, they add up.
/// Source: the i-th planet is i z/N pitches behind the first; docs/search.md.
[[nodiscard]] bool engages_in_sequence(const ToothSet& set);

/// Why a class of sets fell, and how many sets.
struct SetClass {
  std::string id;  ///< "assembly", "centre_distance_layer1", ...
  std::string description;
  long long count = 0;
};

/// Tooth sets by their index: kept, or where they are many made again piece by piece when they are
/// asked for. Neighbours are cheap, a place far from the last one asked for takes the time of a piece.
class ToothSets {
 public:
  /// Makes a piece of them again: those from its first index on.
  class Source;

  ToothSets() = default;
  ToothSets(std::vector<ToothSet> sets) : kept_(std::move(sets)) {}
  explicit ToothSets(std::shared_ptr<const Source> source) : source_(std::move(source)) {}

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Requires: index < size(). Any number of threads may ask.
  [[nodiscard]] ToothSet operator[](std::size_t index) const;
  [[nodiscard]] ToothSet front() const { return (*this)[0]; }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = ToothSet;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = ToothSet;
    Iterator(const ToothSets* sets, std::size_t index) : sets_(sets), index_(index) {}
    ToothSet operator*() const { return (*sets_)[index_]; }
    Iterator& operator++() { return ++index_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    const ToothSets* sets_;
    std::size_t index_;
  };
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

 private:
  std::vector<ToothSet> kept_;
  std::shared_ptr<const Source> source_;  ///< where they are not kept
};

/// So many sets are kept at most: 20 MB.
inline constexpr std::size_t kMostSetsKept = 250000;

struct SetEnumeration {
  long long considered = 0;        ///< every combination within the tooth limits
  std::vector<SetClass> rejected;  ///< in the order of the tests; their counts and the size of
                                   ///< `sets` and `stages` add up to `considered`
  ToothSets sets;                  ///< in a fixed order
  std::vector<ToothSet> stages;    ///< of trains in series, each alone (search_stages.h)
};

/// Every tooth set within the limits that passes what can be decided from whole numbers and shift
/// bounds alone: exact conditions, and for colliding planets a bound that no choice of shifts
/// passes. Guarantees: no set that has a solution is left out (tested against plain enumeration).
/// More than `most_kept` sets are not kept but enumerated again where they are asked for, so that
/// memory does not grow with their number.
[[nodiscard]] SetEnumeration enumerate_sets(const SearchRequirements& requirements,
                                            std::size_t most_kept = kMostSetsKept);

/// Of a stage of a train in series: whether some other stage can make up the ratio.
[[nodiscard]] bool ratio_fits(const ToothSet& set, const SearchRequirements& requirements);

}  // namespace trueflank
