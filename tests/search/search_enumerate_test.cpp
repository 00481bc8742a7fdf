// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_enumerate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/train/prototype_design.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/design/kinds/train_kind.h"

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
            if ((a + c) % 3 || !ratio_fits(set, r) || !planets_are_identical(set, 3)) continue;
            if (!has_shifts(r, set)) continue;
            ++expected;
            EXPECT_TRUE(kept.contains({a, b, c, d, e})) << a << ' ' << b << ' ' << c << ' ' << d
                                                         << ' ' << e;
          }
  EXPECT_GT(expected, 3);
}

TEST(SearchEnumerate, EverySetConsideredIsKeptOrFellForOneReason) {
  for (const bool identical : {true, false}) {
    SearchRequirements r = small_requirements();
    r.identical_planets = identical;
    r.outputs = {OutputMember::kRing2, OutputMember::kRing1};
    r.layer2_module_ratios = {1.0, 0.8};
    const SetEnumeration found = enumerate_sets(r);
    EXPECT_EQ(found.considered, 4LL * 4 * 11 * 5 * 9 * 2 * 2);
    long long sum = static_cast<long long>(found.sets.size());
    for (const SetClass& c : found.rejected) sum += c.count;
    EXPECT_EQ(sum, found.considered);
  }
}

TEST(SearchEnumerate, RatioIsThatOfTheKinematics) {
  for (const OutputMember output : {OutputMember::kRing2, OutputMember::kRing1})
    for (const std::vector<int>& z : {std::vector<int>{12, 39, 90, 32, 81}, {12, 30, 72, 34, 78}}) {
      const ToothSet set{.sun = z[0], .planet1 = z[1], .ring1 = z[2], .planet2 = z[3],
                         .ring2 = z[4], .output = output};
      const BalanceTrain train = balance_train(train_topology("3k", to_text(output)), {z[0], z[1], -z[2], z[3], -z[4]});
      EXPECT_NEAR(signed_ratio(set), 1.0 / train.speeds.output,
                  1e-9 * std::abs(signed_ratio(set)));
    }
  EXPECT_TRUE(std::isinf(
      signed_ratio({.sun = 12, .planet1 = 30, .ring1 = 72, .planet2 = 35, .ring2 = 84})));
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
      EXPECT_EQ(planets_are_identical(set, 3), train->assembly.identical_planets) << z_p2 << z_r2;
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
