// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layer 1 is settled before layer 2 is looked at: what falls there takes all of layer 2 with it, in
// one count. What is left of layer 2 is bounded by its centre distance, a few differences of teeth.
#include "trueflank/search/search_enumerate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

struct DistanceRange {
  double low = 0.0, high = -1.0;
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

DistanceRange common(const DistanceRange& a, const DistanceRange& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// Centre distances of meshes, in modules of layer 1, per sum or difference of teeth.
class CentreDistances {
 public:
  explicit CentreDistances(const SearchRequirements& requirements) : r_(requirements) {}

  [[nodiscard]] static MeshTeeth mesh(const SearchRequirements& r, int tooth_sum, bool internal,
                                      double module) {
    // only the sum counts: one tooth and the rest
    return {.teeth1 = 1,
            .teeth2 = internal ? tooth_sum + 1 : tooth_sum - 1,
            .internal = internal,
            .normal_module_mm = module,
            .helix_angle_rad = std::abs(r.helix_angle_rad),
            .pressure_angle_rad = r.rack.pressure_angle_rad};
  }

  /// Where shifts within their bounds give zero backlash.
  [[nodiscard]] DistanceRange interval(int tooth_sum, bool internal, double module) {
    const auto key = std::pair{internal ? -tooth_sum : tooth_sum, module};
    const auto it = cache_.find(key);
    if (it != cache_.end()) return it->second;
    const double low = internal ? r_.shift_min - r_.shift_max : 2.0 * r_.shift_min;
    const double high = internal ? r_.shift_max - r_.shift_min : 2.0 * r_.shift_max;
    const MeshTeeth teeth = mesh(r_, tooth_sum, internal, module);
    const auto a_high = zero_backlash_centre_distance_mm(teeth, high);
    const auto a_low = zero_backlash_centre_distance_mm(teeth, low);
    // a sum so small that the base circles meet first: the distance where they do
    const double least = reference_centre_distance_mm(teeth) *
                         std::cos(r_.helix_angle_rad == 0.0 ? r_.rack.pressure_angle_rad
                                                            : transverse_pressure_angle_rad(teeth));
    DistanceRange result;
    if (a_high) result = {a_low ? *a_low : least * (1.0 + 1e-12), *a_high};
    return cache_[key] = result;
  }

 private:
  const SearchRequirements& r_;
  std::map<std::pair<int, double>, DistanceRange> cache_;
};

double shift_sum_at(const MeshTeeth& mesh, double centre_distance) {
  const auto angle = working_pressure_angle_rad(mesh, centre_distance);
  return angle ? shift_sum(mesh, *angle) : -1e9;
}

/// The distances a layer allows. Sun, planet and ring share the planet between two meshes: x_s +
/// x_r = sum of both shift sums, within bounds.
DistanceRange layer_interval(const SearchRequirements& r, CentreDistances& distances, int z_s, int z_p,
                        int z_r) {
  if (z_r == 0) return distances.interval(z_s + z_p, false, 1.0);
  if (z_r <= z_p) return {};
  if (z_s == 0) return distances.interval(z_r - z_p, true, 1.0);
  DistanceRange both =
      common(distances.interval(z_s + z_p, false, 1.0), distances.interval(z_r - z_p, true, 1.0));
  if (both.empty()) return both;
  const MeshTeeth external = CentreDistances::mesh(r, z_s + z_p, false, 1.0);
  const MeshTeeth internal = CentreDistances::mesh(r, z_r - z_p, true, 1.0);
  const auto total = [&](double a) {
    return shift_sum_at(external, a) + shift_sum_at(internal, a);
  };
  // both sums grow with the distance
  if (total(both.low) > 2.0 * r.shift_max || total(both.high) < 2.0 * r.shift_min) return {};
  if (total(both.high) > 2.0 * r.shift_max)
    both.high =
        find_root([&](double a) { return total(a) - 2.0 * r.shift_max; }, both.low, both.high);
  if (total(both.low) < 2.0 * r.shift_min)
    both.low =
        find_root([&](double a) { return total(a) - 2.0 * r.shift_min; }, both.low, both.high);
  return both;
}

/// A bound on the tip radius of a planet of layer 1 that no choice of shifts goes below.
double least_planet1_tip(const SearchRequirements& r, int z_s, int z_p, const DistanceRange& a) {
  const double stretch = 1.0 / std::cos(r.helix_angle_rad);
  if (z_s == 0) return 0.5 * z_p * stretch + r.rack.addendum + r.shift_min;
  const double y = a.low - 0.5 * (z_s + z_p) * stretch;  // tip shortening at the least distance
  return 0.5 * z_p * stretch + r.rack.addendum + std::min(r.shift_min, y - r.shift_max);
}
double least_planet2_tip(const SearchRequirements& r, int z_p2, double module) {
  return module * (0.5 * z_p2 / std::cos(r.helix_angle_rad) + r.rack.addendum + r.shift_min);
}

bool neighbours_collide(const SearchRequirements& r, const ToothSet& set, double greatest_distance,
                        double tip_radius) {
  if (set.planets < 2) return false;
  // an outer diameter leaves the module open; the clearance then only has to be positive
  const auto& ratios = r.layer2_module_ratios;
  const double module =
      r.module_mm *
      (set.train->stage == 2 ? *std::max_element(ratios.begin(), ratios.end()) : 1.0);
  const double clearance = r.outer_diameter_mm ? 0.0 : r.planet_clearance_mm / module;
  return 2.0 * greatest_distance * std::sin(kPi / set.planets) < 2.0 * tip_radius + clearance;
}

enum Reason {
  kAssembly,
  kDistance1,
  kPlanets1,
  kDistance2,
  kRatio,
  kPlanets2,
  kIdentical,
  kHunting,
  kPhasing,
  kReasons
};

std::vector<SetClass> empty_classes() {
  return {
      {"assembly", "planets at equal spacing do not mesh with sun and ring1", 0},
      {"centre_distance_layer1",
       "no shifts within bounds give sun, planet1 and ring1 one centre "
       "distance",
       0},
      {"planet_spacing_layer1", "neighbouring planets collide in layer 1 whatever the shifts", 0},
      {"centre_distance_layer2",
       "no shifts within bounds give layer 2 the centre distance of "
       "layer 1",
       0},
      {"ratio", "ratio or direction outside the requirement", 0},
      {"planet_spacing_layer2", "neighbouring planets collide in layer 2 whatever the shifts", 0},
      {"identical_planets", "planet bodies would differ at equal spacing", 0},
      {"hunting", "tooth numbers of a mesh have a common divisor", 0},
      {"phasing", "in a mesh all planets engage at once", 0}};
}

/// The enumeration of the trains of one kind and input, which differ in their output, with one
/// number of planets.
class Enumerator {
 public:
  Enumerator(const SearchRequirements& requirements, std::vector<const SearchTrain*> trains,
             int planets)
      : r_(requirements), trains_(std::move(trains)), planets_(planets), distances_(requirements) {
    two_layers_ = trains_.front()->layers.size() > 1;
    if (two_layers_ || (trains_.front()->stage == 2 && !r_.outer_diameter_mm))
      modules_ = r_.layer2_module_ratios;
    const std::size_t ratios = modules_.size();
    for (const TrainPlace place : trains_.front()->places())
      ranges_[static_cast<std::size_t>(place)] = tooth_range(r_, *trains_.front(), place);
    behind_layer1_ = range(TrainPlace::kPlanet2).count() * range(TrainPlace::kRing2).count() *
                     static_cast<long long>(ratios * trains_.size());
  }

  /// What one choice of sun and planet1 gives.
  struct Piece {
    long long considered = 0;
    std::array<long long, kReasons> rejected{};
    std::vector<ToothSet> sets;
  };

  /// The pieces in their order, each with its sun and planet1.
  template <class Take>
  void run(const Take& take) {
    const ToothRange suns = range(TrainPlace::kSun), planets = range(TrainPlace::kPlanet1);
    for (int z_s = suns.min; z_s <= suns.max; ++z_s)
      for (int z_p = planets.min; z_p <= planets.max; ++z_p) take(z_s, z_p, piece(z_s, z_p));
  }

  const Piece& piece(int z_s, int z_p) {
    piece_.considered = 0;
    piece_.rejected.fill(0);
    piece_.sets.clear();
    const ToothRange rings = range(TrainPlace::kRing1);
    for (int z_r = rings.min; z_r <= rings.max; ++z_r) layer1(z_s, z_p, z_r);
    return piece_;
  }

 private:
  /// One choice, no tooth, where the train has no such gear.
  [[nodiscard]] const ToothRange& range(TrainPlace place) const {
    return ranges_[static_cast<std::size_t>(place)];
  }

  void reject(Reason reason, long long count) {
    piece_.rejected[static_cast<std::size_t>(reason)] += count;
  }

  void layer1(int z_s, int z_p, int z_r) {
    piece_.considered += behind_layer1_;
    ToothSet set{
        .sun = z_s, .planet1 = z_p, .ring1 = z_r, .train = trains_.front(), .planets = planets_};
    if (!set.train->accepts_planets(set.teeth(), planets_))
      return reject(kAssembly, behind_layer1_);
    const DistanceRange a = layer_interval(r_, distances_, z_s, z_p, z_r);
    if (a.empty()) return reject(kDistance1, behind_layer1_);
    if (neighbours_collide(r_, set, a.high, least_planet1_tip(r_, z_s, z_p, a)))
      return reject(kPlanets1, behind_layer1_);
    set.centre_distance_min = a.low;
    set.centre_distance_max = a.high;
    for (const double module : modules_) {
      set.layer2_module_ratio = module;
      two_layers_ ? layer2(set, a) : every_output(set);
    }
  }

  void layer2(ToothSet set, const DistanceRange& layer1) {
    long long with_distance = 0;
    const int centre = static_cast<int>(std::lround((layer1.low + layer1.high) *
                                                    std::cos(r_.helix_angle_rad) /
                                                    set.layer2_module_ratio));
    const auto try_difference = [&](int difference) {
      if (difference < 1) return false;
      const DistanceRange a =
          common(layer1, distances_.interval(difference, true, set.layer2_module_ratio));
      if (a.empty()) return false;
      set.centre_distance_min = a.low;
      set.centre_distance_max = a.high;
      with_distance += pairs_of_difference(set, difference);
      return true;
    };
    // the interval moves up with the difference: the fitting ones are neighbours
    int first = centre;
    while (first > 1 && fits(layer1, first - 1, set.layer2_module_ratio)) --first;
    for (int d = first; d <= centre || fits(layer1, d, set.layer2_module_ratio); ++d)
      try_difference(d);
    const long long pairs = range(TrainPlace::kPlanet2).count() * range(TrainPlace::kRing2).count();
    reject(kDistance2, (pairs - with_distance) * static_cast<long long>(trains_.size()));
  }

  bool fits(const DistanceRange& layer1, int difference, double module) {
    return !common(layer1, distances_.interval(difference, true, module)).empty();
  }

  /// All planet2, ring2 of one difference; returns how many there are.
  long long pairs_of_difference(ToothSet set, int difference) {
    long long pairs = 0;
    const ToothRange planets = range(TrainPlace::kPlanet2), rings = range(TrainPlace::kRing2);
    for (set.planet2 = planets.min; set.planet2 <= planets.max; ++set.planet2) {
      set.ring2 = set.planet2 + difference;
      if (set.ring2 < rings.min || set.ring2 > rings.max) continue;
      ++pairs;
      every_output(set);
    }
    return pairs;
  }

  void every_output(ToothSet set) {
    for (const SearchTrain* train : trains_) {
      set.train = train;
      last_tests(set);
    }
  }

  void last_tests(const ToothSet& set) {
    if (!ratio_fits(set, r_)) return reject(kRatio, 1);
    if (two_layers_ &&
        neighbours_collide(r_, set, set.centre_distance_max,
                           least_planet2_tip(r_, set.planet2, set.layer2_module_ratio)))
      return reject(kPlanets2, 1);
    if (r_.identical_planets && !set.train->planets_are_identical(set.teeth(), planets_))
      return reject(kIdentical, 1);
    if (r_.hunting && !has_hunting_teeth(set)) return reject(kHunting, 1);
    if (r_.sequential && !engages_in_sequence(set)) return reject(kPhasing, 1);
    piece_.sets.push_back(set);
  }

  const SearchRequirements& r_;
  std::vector<const SearchTrain*> trains_;
  int planets_;
  CentreDistances distances_;
  Piece piece_;
  std::array<ToothRange, kTrainPlaces> ranges_{};
  bool two_layers_ = false;
  std::vector<double> modules_{1.0};  ///< of layer 2, of a second stage, over that of the first
  long long behind_layer1_ = 0;  ///< sets behind each choice of layer 1
};

/// Alike but for the output.
bool same_but_output(const SearchTrain& p, const SearchTrain& q) {
  return p.kind() == q.kind() && p.input == q.input && p.internal_wheel == q.internal_wheel &&
         p.stage == q.stage;
}

/// What is asked for of the choices a kind has: its usual one where none of them is named.
std::vector<std::string> chosen(const std::vector<std::string>& asked,
                                const std::vector<std::string>& choices) {
  std::vector<std::string> result;
  const auto named = [&](const std::string& name) {
    return std::find(asked.begin(), asked.end(), name) != asked.end();
  };
  for (const std::string& choice : choices)
    if (named("any") || named(choice)) result.push_back(choice);
  if (result.empty()) result.push_back(choices.front());
  return result;
}

}  // namespace

std::vector<const SearchTrain*> searched_trains(const SearchRequirements& r) {
  std::vector<const SearchTrain*> result;
  for (const std::string& kind : r.kinds) {
    std::vector<std::string> outputs, inputs;
    const auto add = [](std::vector<std::string>& names, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const SearchTrain& train : search_trains()) {
      if (train.kind() != kind) continue;
      add(outputs, train.output);
      add(inputs, train.input);
    }
    if (outputs.empty()) continue;
    outputs = chosen(r.outputs, outputs);
    inputs = chosen(r.inputs, inputs);
    for (const SearchTrain& train : search_trains()) {
      const bool wheel =
          train.has_planets() || (train.internal_wheel ? r.internal_wheels : r.external_wheels);
      if (train.kind() == kind && wheel &&
          std::count(outputs.begin(), outputs.end(), train.output) > 0 &&
          std::count(inputs.begin(), inputs.end(), train.input) > 0)
        result.push_back(&train);
    }
  }
  return result;
}

ToothRange tooth_range(const SearchRequirements& r, const SearchTrain& train, TrainPlace place) {
  const auto at_place = [&](TrainPlace at) -> const ToothRange& {
    switch (at) {
      case TrainPlace::kSun:
        return r.sun;
      case TrainPlace::kPlanet1:
        return r.planet1;
      case TrainPlace::kRing1:
        return r.ring1;
      case TrainPlace::kPlanet2:
        return r.planet2;
      case TrainPlace::kRing2:
        break;
    }
    return r.ring2;
  };
  const std::string& name = train.name_at(place);
  // of a second stage in series, at the places of a first layer
  if (name == "planet2") return r.planet2;
  if (name == "ring2") return r.ring2;
  if (name == "planet") return r.planet.over(at_place(place));
  if (name == "ring") return r.ring.over(at_place(place));
  if (name == "pinion") return r.pinion.over(r.sun);
  if (name == "wheel") return r.wheel.over(at_place(place));
  return at_place(place);
}

double signed_ratio(const ToothSet& set) { return set.train->signed_ratio(set.teeth()); }

bool has_hunting_teeth(const ToothSet& set) {
  const SearchTrain& train = *set.train;
  return std::all_of(train.topology.meshes.begin(), train.topology.meshes.end(),
                     [&](const TopologyMesh& mesh) {
                       return std::gcd(set.teeth_at(train.place_of(mesh.gear1)),
                                       set.teeth_at(train.place_of(mesh.gear2))) == 1;
                     });
}

bool engages_in_sequence(const ToothSet& set) {
  const SearchTrain& train = *set.train;
  if (!train.has_planets() || set.planets < 2) return true;
  return std::all_of(train.layers.begin(), train.layers.end(), [&](const SearchLayer& layer) {
    for (const int gear : {layer.sun, layer.ring})
      if (gear >= 0 && set.teeth_at(train.place_of(gear)) % set.planets == 0) return false;
    return true;
  });
}

namespace {

/// No ratio of the other stage is outside these; 1 for a whole train.
DistanceRange ratios_of_others(const ToothSet& set, const SearchRequirements& r) {
  if (set.train->stage == 0) return {1.0, 1.0};
  DistanceRange ratios{1.0, 1.0};
  for (const SearchTrain& other : search_trains()) {
    if (other.kind() != set.train->kind() || other.stage == set.train->stage) continue;
    const ToothRange sun = tooth_range(r, other, TrainPlace::kSun),
                     ring = tooth_range(r, other, TrainPlace::kRing1);
    ratios.low *= 1.0 + static_cast<double>(ring.min) / sun.max;
    ratios.high *= 1.0 + static_cast<double>(ring.max) / sun.min;
  }
  return ratios;
}

}  // namespace

bool ratio_fits(const ToothSet& set, const SearchRequirements& requirements) {
  const double ratio = signed_ratio(set);
  if (requirements.direction == OutputDirection::kSame && ratio < 0.0) return false;
  if (requirements.direction == OutputDirection::kOpposite && ratio > 0.0) return false;
  const DistanceRange others = ratios_of_others(set, requirements);
  return std::abs(ratio) * others.high >= requirements.ratio_min &&
         std::abs(ratio) * others.low <= requirements.ratio_max;
}

/// Its pieces are those of the enumeration that have sets.
class ToothSets::Source {
 public:
  explicit Source(SearchRequirements requirements) : r_(std::move(requirements)) {}

  const SearchRequirements& requirements() const { return r_; }
  Enumerator& add(std::vector<const SearchTrain*> trains, int planets) {
    enumerators_.push_back(std::make_unique<Enumerator>(r_, std::move(trains), planets));
    return *enumerators_.back();
  }
  void add_piece(int z_s, int z_p, std::size_t sets) {
    pieces_.push_back({size_, static_cast<int>(enumerators_.size()) - 1, z_s, z_p});
    size_ += sets;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  ToothSet at(std::size_t index) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), index,
                                        [](std::size_t i, const Piece& p) { return i < p.first; });
    const auto piece = after - 1;
    const std::lock_guard lock(mutex_);
    if (made_ != piece->first) {
      sets_ = enumerators_[static_cast<std::size_t>(piece->enumerator)]->piece(piece->sun, piece->planet1).sets;
      made_ = piece->first;
    }
    return sets_[index - piece->first];
  }

 private:
  struct Piece {
    std::size_t first = 0;
    int enumerator = 0, sun = 0, planet1 = 0;
  };
  SearchRequirements r_;
  std::vector<std::unique_ptr<Enumerator>> enumerators_;
  std::vector<Piece> pieces_;
  std::size_t size_ = 0;
  mutable std::mutex mutex_;
  mutable std::size_t made_ = static_cast<std::size_t>(-1);  ///< first index of the piece in sets_
  mutable std::vector<ToothSet> sets_;
};

std::size_t ToothSets::size() const { return source_ ? source_->size() : kept_.size(); }

ToothSet ToothSets::operator[](std::size_t index) const {
  TRUEFLANK_EXPECTS(index < size());
  return source_ ? source_->at(index) : kept_[index];
}

SetEnumeration enumerate_sets(const SearchRequirements& requirements, std::size_t most_kept) {
  SetEnumeration result;
  result.rejected = empty_classes();
  const auto source = std::make_shared<ToothSets::Source>(requirements);
  std::vector<ToothSet> kept;
  const auto take = [&](int z_s, int z_p, const Enumerator::Piece& piece) {
    result.considered += piece.considered;
    for (std::size_t reason = 0; reason < kReasons; ++reason)
      result.rejected[reason].count += piece.rejected[reason];
    if (piece.sets.empty()) return;
    if (piece.sets.front().train->stage > 0) {
      result.stages.insert(result.stages.end(), piece.sets.begin(), piece.sets.end());
      return;
    }
    source->add_piece(z_s, z_p, piece.sets.size());
    if (source->size() <= most_kept)
      kept.insert(kept.end(), piece.sets.begin(), piece.sets.end());
    else
      kept = {};
  };
  const std::vector<const SearchTrain*> trains = searched_trains(requirements);
  for (std::size_t i = 0; i < trains.size();) {
    std::vector<const SearchTrain*> alike;
    for (; i < trains.size() && (alike.empty() || same_but_output(*alike.front(), *trains[i])); ++i)
      alike.push_back(trains[i]);
    const std::vector<int> planets =
        alike.front()->has_planets() ? requirements.planets : std::vector<int>{1};
    for (const int count : planets) source->add(alike, count).run(take);
  }
  result.sets = source->size() <= most_kept ? ToothSets(std::move(kept)) : ToothSets(source);
  return result;
}

}  // namespace trueflank
