// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layer 1 is settled before layer 2 is looked at: what falls there takes all of layer 2 with it, in
// one count. What is left of layer 2 is bounded by its centre distance, a few differences of teeth.
#include "trueflank/search/search_enumerate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

struct Interval {
  double low = 0.0, high = -1.0;
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

Interval common(const Interval& a, const Interval& b) {
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
            .pressure_angle_rad = r.rack.pressure_angle_rad};
  }

  /// Where shifts within their bounds give zero backlash.
  [[nodiscard]] Interval interval(int tooth_sum, bool internal, double module) {
    const auto key = std::pair{internal ? -tooth_sum : tooth_sum, module};
    const auto it = cache_.find(key);
    if (it != cache_.end()) return it->second;
    const double low = internal ? r_.shift_min - r_.shift_max : 2.0 * r_.shift_min;
    const double high = internal ? r_.shift_max - r_.shift_min : 2.0 * r_.shift_max;
    const MeshTeeth teeth = mesh(r_, tooth_sum, internal, module);
    const auto a_high = zero_backlash_centre_distance_mm(teeth, high);
    const auto a_low = zero_backlash_centre_distance_mm(teeth, low);
    // a sum so small that the base circles meet first: the distance where they do
    const double least =
        reference_centre_distance_mm(teeth) * std::cos(r_.rack.pressure_angle_rad);
    Interval result;
    if (a_high) result = {a_low ? *a_low : least * (1.0 + 1e-12), *a_high};
    return cache_[key] = result;
  }

 private:
  const SearchRequirements& r_;
  std::map<std::pair<int, double>, Interval> cache_;
};

double shift_sum_at(const MeshTeeth& mesh, double centre_distance) {
  const auto angle = working_pressure_angle_rad(mesh, centre_distance);
  return angle ? shift_sum(mesh, *angle) : -1e9;
}

/// Layer 1 shares planet1 between two meshes: x_s + x_r1 = sum of both shift sums, within bounds.
Interval layer1_interval(const SearchRequirements& r, CentreDistances& distances, int z_s, int z_p,
                         int z_r) {
  if (z_r <= z_p) return {};
  Interval both =
      common(distances.interval(z_s + z_p, false, 1.0), distances.interval(z_r - z_p, true, 1.0));
  if (both.empty()) return both;
  const MeshTeeth external = CentreDistances::mesh(r, z_s + z_p, false, 1.0);
  const MeshTeeth internal = CentreDistances::mesh(r, z_r - z_p, true, 1.0);
  const auto total = [&](double a) { return shift_sum_at(external, a) + shift_sum_at(internal, a); };
  // both sums grow with the distance
  if (total(both.low) > 2.0 * r.shift_max || total(both.high) < 2.0 * r.shift_min) return {};
  if (total(both.high) > 2.0 * r.shift_max)
    both.high = find_root([&](double a) { return total(a) - 2.0 * r.shift_max; }, both.low, both.high);
  if (total(both.low) < 2.0 * r.shift_min)
    both.low = find_root([&](double a) { return total(a) - 2.0 * r.shift_min; }, both.low, both.high);
  return both;
}

/// A bound on planet1's tip radius that no choice of shifts goes below.
double least_planet1_tip(const SearchRequirements& r, int z_s, int z_p, const Interval& a) {
  const double y = a.low - 0.5 * (z_s + z_p);  // tip shortening at the least distance
  return 0.5 * z_p + r.rack.addendum + std::min(r.shift_min, y - r.shift_max);
}
double least_planet2_tip(const SearchRequirements& r, int z_p2, double module) {
  return module * (0.5 * z_p2 + r.rack.addendum + r.shift_min);
}

bool neighbours_collide(const SearchRequirements& r, double greatest_distance, double tip_radius) {
  if (r.planets < 2) return false;
  // an outer diameter leaves the module open; the clearance then only has to be positive
  const double clearance = r.outer_diameter_mm ? 0.0 : r.planet_clearance_mm / r.module_mm;
  return 2.0 * greatest_distance * std::sin(kPi / r.planets) < 2.0 * tip_radius + clearance;
}

enum Reason { kAssembly, kDistance1, kPlanets1, kDistance2, kRatio, kPlanets2, kIdentical, kReasons };

std::vector<SetClass> empty_classes() {
  return {{"assembly", "planets at equal spacing do not mesh with sun and ring1", 0},
          {"centre_distance_layer1", "no shifts within bounds give sun, planet1 and ring1 one centre "
                                     "distance", 0},
          {"planet_spacing_layer1", "neighbouring planets collide in layer 1 whatever the shifts", 0},
          {"centre_distance_layer2", "no shifts within bounds give layer 2 the centre distance of "
                                     "layer 1", 0},
          {"ratio", "ratio or direction outside the requirement", 0},
          {"planet_spacing_layer2", "neighbouring planets collide in layer 2 whatever the shifts", 0},
          {"identical_planets", "planet bodies would differ at equal spacing", 0}};
}

/// One enumeration under way.
class Enumerator {
 public:
  explicit Enumerator(const SearchRequirements& requirements)
      : r_(requirements), distances_(requirements) {
    result_.rejected = empty_classes();
    layer2_pairs_ = r_.planet2.count() * r_.ring2.count();
    variants_ = static_cast<long long>(r_.layer2_module_ratios.size() * r_.outputs.size());
  }

  SetEnumeration run() {
    for (int z_s = r_.sun.min; z_s <= r_.sun.max; ++z_s)
      for (int z_p = r_.planet1.min; z_p <= r_.planet1.max; ++z_p)
        for (int z_r = r_.ring1.min; z_r <= r_.ring1.max; ++z_r) layer1(z_s, z_p, z_r);
    return std::move(result_);
  }

 private:
  void reject(Reason reason, long long count) {
    result_.rejected[static_cast<std::size_t>(reason)].count += count;
  }

  void layer1(int z_s, int z_p, int z_r) {
    const long long behind = layer2_pairs_ * variants_;
    result_.considered += behind;
    ToothSet set{.sun = z_s, .planet1 = z_p, .ring1 = z_r};
    if (!sun_and_ring_accept_planets(set, r_.planets)) return reject(kAssembly, behind);
    const Interval a = layer1_interval(r_, distances_, z_s, z_p, z_r);
    if (a.empty()) return reject(kDistance1, behind);
    if (neighbours_collide(r_, a.high, least_planet1_tip(r_, z_s, z_p, a)))
      return reject(kPlanets1, behind);
    for (const double module : r_.layer2_module_ratios) {
      set.layer2_module_ratio = module;
      layer2(set, a);
    }
  }

  void layer2(ToothSet set, const Interval& layer1) {
    const auto outputs = static_cast<long long>(r_.outputs.size());
    long long with_distance = 0;
    const int centre = static_cast<int>(std::lround((layer1.low + layer1.high) /
                                                    set.layer2_module_ratio));
    const auto try_difference = [&](int difference) {
      if (difference < 1) return false;
      const Interval a =
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
    reject(kDistance2, (layer2_pairs_ - with_distance) * outputs);
  }

  bool fits(const Interval& layer1, int difference, double module) {
    return !common(layer1, distances_.interval(difference, true, module)).empty();
  }

  /// All planet2, ring2 of one difference; returns how many there are.
  long long pairs_of_difference(ToothSet set, int difference) {
    long long pairs = 0;
    for (set.planet2 = r_.planet2.min; set.planet2 <= r_.planet2.max; ++set.planet2) {
      set.ring2 = set.planet2 + difference;
      if (set.ring2 < r_.ring2.min || set.ring2 > r_.ring2.max) continue;
      ++pairs;
      for (const OutputMember output : r_.outputs) {
        set.output = output;
        last_tests(set);
      }
    }
    return pairs;
  }

  void last_tests(const ToothSet& set) {
    if (!ratio_fits(set, r_)) return reject(kRatio, 1);
    if (neighbours_collide(r_, set.centre_distance_max,
                           least_planet2_tip(r_, set.planet2, set.layer2_module_ratio)))
      return reject(kPlanets2, 1);
    if (r_.identical_planets && !planets_are_identical(set, r_.planets))
      return reject(kIdentical, 1);
    result_.sets.push_back(set);
  }

  const SearchRequirements& r_;
  CentreDistances distances_;
  SetEnumeration result_;
  long long layer2_pairs_ = 0;
  long long variants_ = 0;
};

}  // namespace

double signed_ratio(const ToothSet& set) {
  // differences of products in integers: exact
  const long long product1 = 1LL * set.ring1 * set.planet2, product2 = 1LL * set.planet1 * set.ring2;
  if (product1 == product2) return std::numeric_limits<double>::infinity();
  const double i1 = static_cast<double>(set.ring1) / set.sun;
  if (set.output == OutputMember::kRing2)
    return (1.0 + i1) * static_cast<double>(product2) / static_cast<double>(product2 - product1);
  // (1 + I1 / I2) / (1 - 1 / I2)
  const double i2 = static_cast<double>(product1) / static_cast<double>(product2);
  return (i2 + i1) * static_cast<double>(product2) / static_cast<double>(product1 - product2);
}

bool sun_and_ring_accept_planets(const ToothSet& set, int planets) {
  return (set.sun + set.ring1) % planets == 0;
}

bool planets_are_identical(const ToothSet& set, int planets) {
  const long long difference = 1LL * set.ring1 * set.planet2 - 1LL * set.ring2 * set.planet1;
  return difference % (1LL * planets * std::gcd(set.planet1, set.planet2)) == 0;
}

bool ratio_fits(const ToothSet& set, const SearchRequirements& requirements) {
  const double ratio = signed_ratio(set);
  if (requirements.direction == OutputDirection::kSame && ratio < 0.0) return false;
  if (requirements.direction == OutputDirection::kOpposite && ratio > 0.0) return false;
  return std::abs(ratio) >= requirements.ratio_min && std::abs(ratio) <= requirements.ratio_max;
}

SetEnumeration enumerate_sets(const SearchRequirements& requirements) {
  return Enumerator(requirements).run();
}

}  // namespace trueflank
