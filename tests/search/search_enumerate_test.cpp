// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_enumerate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/train/prototype_design.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

SearchRequirements small_requirements() {
  SearchRequirements r;
  r.ratio_min = 20;
  r.ratio_max = 60;
  r.sun = {10, 13};
  r.planet1 = {15, 18};
  r.ring1 = {40, 50};
  r.planet2 = {12, 16};
  r.ring2 = {38, 46};
  r.shift_min = -0.8;
  r.shift_max = 0.8;
  return r;
}

double involute(double a) { return std::tan(a) - a; }

/// Whether some centre distance of a dense grid lets all shifts lie within bounds: an independent,
/// plain account of what the enumeration must not leave out.
bool has_shifts(const SearchRequirements& r, const ToothSet& set) {
  const double alpha = rad_from_deg(20.0);
  const auto sum = [&](double teeth, double a) {
    const double cosine = teeth / 2 * std::cos(alpha) / a;
    if (cosine >= 1) return -1e9;
    return teeth / (2 * std::tan(alpha)) * (involute(std::acos(cosine)) - involute(alpha));
  };
  for (double a = 0.42 * (set.sun + set.planet1); a < 0.62 * (set.sun + set.planet1); a += 0.002) {
    const double s_a = sum(set.sun + set.planet1, a), s_b = sum(set.ring1 - set.planet1, a),
                 s_c = sum(set.ring2 - set.planet2, a);
    // x_p1 within bounds and x_s = s_a - x_p1, x_r1 = s_b + x_p1 as well
    const double low = std::max({r.shift_min, s_a - r.shift_max, r.shift_min - s_b});
    const double high = std::min({r.shift_max, s_a - r.shift_min, r.shift_max - s_b});
    if (low <= high && std::abs(s_c) <= r.shift_max - r.shift_min) return true;
  }
  return false;
}

TEST(SearchEnumerate, LeavesOutNoSetThatHasShifts) {
  const SearchRequirements r = small_requirements();
  const SetEnumeration found = enumerate_sets(r);
  std::set<std::vector<int>> kept;
  for (const ToothSet& s : found.sets) kept.insert({s.sun, s.planet1, s.ring1, s.planet2, s.ring2});
  EXPECT_EQ(kept.size(), found.sets.size());
  int expected = 0;
  for (int a = 10; a <= 13; ++a)
    for (int b = 15; b <= 18; ++b)
      for (int c = 40; c <= 50; ++c)
        for (int d = 12; d <= 16; ++d)
          for (int e = 38; e <= 46; ++e) {
            const ToothSet set{.sun = a, .planet1 = b, .ring1 = c, .planet2 = d, .ring2 = e};
            if ((a + c) % 3 || !ratio_fits(set, r) ||
                !set.train->planets_are_identical(set.teeth(), 3))
              continue;
            if (!has_shifts(r, set)) continue;
            ++expected;
            EXPECT_TRUE(kept.contains({a, b, c, d, e}))
                << a << ' ' << b << ' ' << c << ' ' << d << ' ' << e;
          }
  EXPECT_GT(expected, 3);
}

TEST(SearchEnumerate, EverySetConsideredIsKeptOrFellForOneReason) {
  for (const bool identical : {true, false}) {
    SearchRequirements r = small_requirements();
    r.identical_planets = identical;
    r.outputs = {"any"};
    r.layer2_module_ratios = {1.0, 0.8};
    const SetEnumeration found = enumerate_sets(r);
    EXPECT_EQ(found.considered, 4LL * 4 * 11 * 5 * 9 * 2 * 2);
    long long sum = static_cast<long long>(found.sets.size());
    for (const SetClass& c : found.rejected) sum += c.count;
    EXPECT_EQ(sum, found.considered);
  }
}

TEST(SearchEnumerate, SetsThatAreNotKeptAreMadeAgainAlike) {
  SearchRequirements r = small_requirements();
  r.identical_planets = false;
  r.kinds = {"3k", "simple", "stepped"};
  r.outputs = {"any"};
  r.planets = {3, 4};
  r.ratio_min = 1.5;
  const SetEnumeration kept = enumerate_sets(r), made = enumerate_sets(r, 0);
  ASSERT_GT(kept.sets.size(), 100u);
  ASSERT_EQ(made.sets.size(), kept.sets.size());
  EXPECT_EQ(made.considered, kept.considered);
  std::size_t i = 0;
  for (const ToothSet& set : made.sets) EXPECT_EQ(set, kept.sets[i++]);
  for (i = 0; i < kept.sets.size(); i += 7) {  // back and forth
    const std::size_t other = kept.sets.size() - 1 - i;
    EXPECT_EQ(made.sets[other], kept.sets[other]);
  }
}

/// Tooth numbers that could be of any train: plausible, and different at every place.
ToothSet some_set(const SearchTrain& train, int variant) {
  ToothSet set{.train = &train,
               .planets = train.has_planets() ? 3 : 1,
               .centre_distance_min = 20,
               .centre_distance_max = 30};
  for (const TrainPlace place : train.places()) switch (place) {
      case TrainPlace::kSun:
        set.sun = 12 + variant;
        break;
      case TrainPlace::kPlanet1:
        set.planet1 = 39 - 3 * variant;
        break;
      case TrainPlace::kRing1:
        set.ring1 = 90 - 5 * variant;
        break;
      case TrainPlace::kPlanet2:
        set.planet2 = 32 + variant;
        break;
      case TrainPlace::kRing2:
        set.ring2 = 81 + 2 * variant;
        break;
    }
  return set;
}

TEST(SearchEnumerate, RatioIsThatOfTheKinematicsForEveryTrain) {
  EXPECT_EQ(search_trains().size(), 12u);
  for (const SearchTrain& train : search_trains())
    for (int variant = 0; variant < 4; ++variant) {
      const ToothSet set = some_set(train, variant);
      std::vector<int> teeth;
      for (const TrainPlace place : train.places())
        teeth.push_back(place == TrainPlace::kRing1 || place == TrainPlace::kRing2
                            ? -set.teeth_at(place)
                            : set.teeth_at(place));
      const BalanceTrain balance = balance_train(train.topology, teeth);
      const double ratio = train.signed_ratio(set.teeth());
      EXPECT_NEAR(ratio, 1.0 / balance.speeds.output, 1e-9 * std::abs(ratio))
          << train.kind() << train.output;
      EXPECT_EQ(signed_ratio(set), ratio);
    }
  EXPECT_TRUE(std::isinf(
      signed_ratio({.sun = 12, .planet1 = 30, .ring1 = 72, .planet2 = 35, .ring2 = 84})));
}

TEST(SearchEnumerate, EveryKindIsEnumeratedWholeAndCountedOnce) {
  SearchRequirements r = small_requirements();
  r.kinds = {"stepped", "pair", "simple", "3k"};
  r.outputs = r.inputs = {"any"};
  r.external_wheels = r.internal_wheels = true;
  r.planets = {3, 4};
  r.ratio_min = 1.5;
  r.wheel = {20, 24};
  r.ring = {50, std::nullopt};
  const SetEnumeration found = enumerate_sets(r);
  r.ring = {40, 46};
  const SetEnumeration all = enumerate_sets(r);
  const long long stepped = 4LL * 4 * 5 * 7 * 2 * 2, pair = 4LL * 5 * 2,
                  simple = 4LL * 4 * 7 * 2 * 2, threek = 4LL * 4 * 11 * 5 * 9 * 2 * 2,
                  split = 4LL * 11 * 5 * 9 * 2 * 2;
  EXPECT_EQ(all.considered, stepped + pair + simple + threek + split);
  long long sum = static_cast<long long>(all.sets.size());
  for (const SetClass& c : all.rejected) sum += c.count;
  EXPECT_EQ(sum, all.considered);
  // ring 50 to 46 of stepped sets is empty, 50 to 50 of simple ones one
  EXPECT_EQ(found.considered, pair + 4LL * 4 * 1 * 2 * 2 + threek + split);
  std::set<std::string> kinds;
  for (const ToothSet& set : all.sets) {
    kinds.insert(set.train->kind());
    EXPECT_TRUE(set.train->accepts_planets(set.teeth(), set.planets));
    EXPECT_GE(std::abs(signed_ratio(set)), 1.5);
  }
  EXPECT_EQ(kinds.size(), 4u);
}

TEST(SearchEnumerate, PlanetsOfSteppedSetsAgreeWithTheAssemblyOfTheTrain) {
  int alike = 0, different = 0;
  const SearchTrain& train = usual_search_train("stepped");
  for (int z_p2 = 17; z_p2 <= 20; ++z_p2)
    for (int z_r = 71; z_r <= 73; ++z_r) {
      const ToothNumbers z{18, 36, 0, z_p2, z_r};
      GearboxDesign design{.name = "stepped", .topology = train.topology, .planets = 3};
      for (const TrainPlace place : train.places())
        design.gears.push_back(
            {.name = train.name_at(place),
             .kind = place == TrainPlace::kRing2 ? GearKind::kInternal : GearKind::kExternal,
             .teeth = z[static_cast<std::size_t>(place)],
             .face_width_mm = 10.0});
      design.module_mm = 1.0;
      design.centre_distance_mm = 27.0;
      const auto laid = lay_out(design);
      if (!laid) continue;
      EXPECT_EQ(train.planets_are_identical(z, 3), laid->assembly.identical_planets)
          << z_p2 << ' ' << z_r;
      (laid->assembly.identical_planets ? alike : different)++;
    }
  EXPECT_GT(alike, 0);
  EXPECT_GT(different, 0);
}

TEST(SearchEnumerate, IdenticalPlanetsAgreeWithTheAssemblyOfTheTrain) {
  int alike = 0, different = 0;
  for (int z_p2 = 30; z_p2 <= 34; ++z_p2)
    for (int z_r2 = z_p2 + 48; z_r2 <= z_p2 + 50; ++z_r2) {
      GearboxDesign design = test::prototype(0.5, 0.0, 25.6);
      design.gears[3].teeth = z_p2;
      design.gears[4].teeth = z_r2;
      const auto train = lay_out(design);
      if (!train) continue;
      const ToothSet set{.sun = 12, .planet1 = 39, .ring1 = 90, .planet2 = z_p2, .ring2 = z_r2};
      EXPECT_EQ(set.train->planets_are_identical(set.teeth(), 3), train->assembly.identical_planets)
          << z_p2 << z_r2;
      EXPECT_TRUE(train->assembly.equal_spacing);
      (train->assembly.identical_planets ? alike : different)++;
    }
  EXPECT_GT(alike, 0);
  EXPECT_GT(different, 0);
}

TEST(SearchEnumerate, DirectionIsARequirement) {
  SearchRequirements r = small_requirements();
  r.direction = OutputDirection::kSame;
  for (const ToothSet& set : enumerate_sets(r).sets) EXPECT_GT(signed_ratio(set), 0.0);
  r.direction = OutputDirection::kOpposite;
  for (const ToothSet& set : enumerate_sets(r).sets) EXPECT_LT(signed_ratio(set), 0.0);
}

}  // namespace
}  // namespace trueflank
