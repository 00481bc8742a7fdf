// SPDX-License-Identifier: GPL-3.0-or-later
//
// Helical teeth and shaped rings in the search: what it tells of a set is what the laid-out train has.
#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/search/search_bound.h"
#include "trueflank/search/search_optimise.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

SearchRequirements requirements(const std::string& kind, double ratio) {
  SearchRequirements r;
  r.kinds = {kind};
  r.ratio_min = 0.97 * ratio;
  r.ratio_max = 1.03 * ratio;
  r.sun = {12, 14};
  r.planet1 = {14, 44};
  r.ring1 = {40, 100};
  r.planet2 = {14, 40};
  r.ring2 = {40, 100};
  r.internal_wheels = true;
  return r;
}

struct Found {
  ToothSet set;
  SearchCandidate best;
};

/// Optima of a few sets of the enumeration, taken evenly from it.
std::vector<Found> optima(const SearchRequirements& r, std::size_t count) {
  EXPECT_TRUE(validate(r).empty());
  const SetEnumeration sets = enumerate_sets(r);
  EXPECT_GE(sets.sets.size(), count);
  std::vector<Found> found;
  for (std::size_t i = 0; i < sets.sets.size() && found.size() < count;
       i += std::max<std::size_t>(1, sets.sets.size() / (4 * count))) {
    const SetResult result = optimise_set(r, sets.sets[i]);
    if (!result.candidates.empty()) found.push_back({sets.sets[i], result.candidates.front()});
  }
  return found;
}

/// The design of a candidate, laid out, and what it tells of itself.
void expect_as_laid_out(const SearchRequirements& r, const Found& found) {
  const SearchModel model(r, found.set);
  const auto train = lay_out(model.design(found.best.free));
  ASSERT_TRUE(train) << train.error().front().message;
  EXPECT_NEAR(train->design.centre_distance_mm.value_or(0.0),
              found.best.free.centre_distance * model.module_mm(found.best.free), 1e-9);
  const EfficiencyResult told = efficiency(*train);
  EXPECT_NEAR(found.best.forward, told.forward, 1e-7);
  EXPECT_NEAR(found.best.backward, told.backward, 1e-7);
  for (const TrainMesh& mesh : train->meshes) {
    const GearPair pair = train->pair(mesh);
    EXPECT_NEAR(std::abs(pair.gear1().helix_angle_rad), std::abs(r.helix_angle_rad), 1e-15);
    EXPECT_EQ(pair.internal() && r.cutter, pair.gear2().cutter.has_value());
    const double module = pair.gear1().normal_module_mm;
    EXPECT_GE(contact_ratios(pair).effective, r.contact_ratio_min - 1e-6) << mesh.name;
    EXPECT_LE(contact_ratios(pair).total, r.contact_ratio_max + 1e-6) << mesh.name;
    EXPECT_GE(tip_clearance_of_gear1_mm(pair), (r.tip_clearance - 1e-6) * module) << mesh.name;
    EXPECT_GE(tip_clearance_of_gear2_mm(pair), (r.tip_clearance - 1e-6) * module) << mesh.name;
    EXPECT_NEAR(circumferential_backlash_mm(pair), kUsualBacklash * r.module_mm, 1e-6) << mesh.name;
  }
  for (const TrainGear& gear : train->gears) {
    EXPECT_GE(gear.profile.gear().shift, r.shift_min - 1e-9);
    EXPECT_LE(gear.profile.gear().shift, r.shift_max + 1e-9);
  }
  EXPECT_GE(efficiency_bound(r, found.set, DriveDirection::kForward, BoundBy::kHalving, 0.0),
            found.best.forward);
}

TEST(SearchTeeth, HelicalSetsAreToldAsTheirTrainsAre) {
  for (const auto& [kind, ratio] : {std::pair("3k", 90.0), std::pair("stepped", 8.0),
                                    std::pair("simple", 6.5), std::pair("pair", 4.0)})
    for (const double helix : {0.35, -0.2}) {
      SCOPED_TRACE(std::string(kind) + " " + std::to_string(helix));
      SearchRequirements r = requirements(kind, ratio);
      r.helix_angle_rad = helix;
      const std::vector<Found> found = optima(r, 2);
      EXPECT_FALSE(found.empty());
      for (const Found& one : found) expect_as_laid_out(r, one);
    }
}

TEST(SearchTeeth, ShapedRingsAreToldAsTheirTrainsAre) {
  for (const auto& [kind, ratio] : {std::pair("3k", 90.0), std::pair("simple", 6.5)}) {
    SCOPED_TRACE(kind);
    SearchRequirements r = requirements(kind, ratio);
    r.cutter = ShaperCutter{.teeth = 18, .shift = 0.1, .tip_radius = 0.2};
    const std::vector<Found> found = optima(r, 2);
    EXPECT_FALSE(found.empty());
    for (const Found& one : found) expect_as_laid_out(r, one);
  }
}

TEST(SearchTeeth, CentreDistancesOfHelicalSetsAreThoseTheirShiftsAllow) {
  // by rolling the numbers of teeth out on pitch circles of normal modules: every mesh of every set
  // has shifts within the bounds somewhere in the interval told, and nowhere outside of it
  SearchRequirements r = requirements("simple", 6.5);
  r.helix_angle_rad = 0.4;
  r.shift_min = -0.4;
  r.shift_max = 0.5;
  const SetEnumeration sets = enumerate_sets(r);
  ASSERT_FALSE(sets.sets.empty());
  const double cosine = std::cos(0.4), normal = r.rack.pressure_angle_rad,
               transverse = std::atan(std::tan(normal) / cosine);
  const auto inv = [](double angle) { return std::tan(angle) - angle; };
  for (const ToothSet& set : sets.sets) {
    const auto sum = [&](int teeth, double a) {
      const double base = 0.5 * teeth / cosine * std::cos(transverse);
      return base < a ? teeth * (inv(std::acos(base / a)) - inv(transverse)) / (2.0 * std::tan(normal))
                      : -1e9;
    };
    const auto allowed = [&](double a) {
      const double outer = sum(set.sun + set.planet1, a), inner = sum(set.ring1 - set.planet1, a);
      for (int i = 0; i <= 2000; ++i) {
        const double planet = r.shift_min + (r.shift_max - r.shift_min) * i / 2000,
                     sun = outer - planet, ring = inner + planet;
        if (sun >= r.shift_min && sun <= r.shift_max && ring >= r.shift_min && ring <= r.shift_max)
          return true;
      }
      return false;
    };
    const double low = set.centre_distance_min, high = set.centre_distance_max;
    EXPECT_TRUE(allowed(0.5 * (low + high)));
    const double off = 0.002;
    EXPECT_TRUE(high - low < 2.0 * off || (allowed(low + off) && allowed(high - off)));
    EXPECT_FALSE(allowed(low - off));
    EXPECT_FALSE(allowed(high + off));
  }
}

TEST(SearchTeeth, WhatTheFormulaAndTheCutterCannotDoIsRefused) {
  SearchRequirements r = requirements("simple", 6.5);
  r.helix_angle_rad = 0.2;
  r.loss_model = LossModel::kContactRatios;
  ASSERT_EQ(validate(r).size(), 1u);
  EXPECT_EQ(validate(r)[0].key, "search.loss_model");
  r = requirements("simple", 6.5);
  r.cutter = ShaperCutter{.teeth = 100};
  ASSERT_EQ(validate(r).size(), 1u);
  EXPECT_EQ(validate(r)[0].key, "cutter.teeth");
  EXPECT_NE(fingerprint(r), fingerprint(requirements("simple", 6.5)));
}

}  // namespace
}  // namespace trueflank
