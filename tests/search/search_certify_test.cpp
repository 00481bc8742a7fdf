// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_certify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trueflank/search/search_enclosure.h"
#include "trueflank/search/search_mesh_loss.h"
#include "trueflank/search/search_values.h"
#include "trueflank/train/efficiency_sliding.h"

namespace trueflank {
namespace {

SearchRequirements requirements_of(int round) {
  const double bounds[] = {0.5, 0.9, 1.2, 2.0};
  const char* kinds[] = {"3k", "simple", "3k", "stepped", "3k", "pair"};
  SearchRequirements r;
  r.kinds = {kinds[round % 6]};
  r.outputs = r.inputs = {"any"};
  r.external_wheels = r.internal_wheels = true;
  r.shift_max = bounds[round % 4];
  r.shift_min = -r.shift_max;
  r.clearance_um = round % 3 ? 2.0 : 0.0;
  r.loss_model = round % 4 == 3 ? LossModel::kContactRatios : LossModel::kPathIntegral;
  r.friction = round % 2 ? 0.1 : 0.05;
  r.ratio_min = r.kinds[0] == "3k" ? 40.0 : 5.0;
  r.ratio_max = 1.15 * r.ratio_min;
  r.sun = {9 + round, 11 + round};
  r.wheel = {40, 90};
  r.identical_planets = false;
  return r;
}

/// The best of many random points that keep every limit; -1 where none does.
double best_of_random_points(const SearchRequirements& r, const ToothSet& set, int points,
                             std::mt19937& random) {
  const SearchModel model(r, set);
  SetValues values(r, set, LimitReserve{});
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double best = -1.0;
  for (int i = 0; i < points; ++i) {
    const double a = set.centre_distance_min +
                     (set.centre_distance_max - set.centre_distance_min) * share(random);
    const auto range1 = model.shift_range(0, a), range2 = model.shift_range(1, a);
    const double x1 = range1[0] + (range1[1] - range1[0]) * share(random),
                 x2 = range2[0] + (range2[1] - range2[0]) * share(random);
    const LayerEvaluation first = model.layer1(a, x1, 0.0), second = model.layer2(a, x2, 0.0);
    if (values.layer_margin(0, first, false) < 0.0 || values.layer_margin(1, second, false) < 0.0)
      continue;
    best = std::max(best, model.efficiency(first, second, DriveDirection::kForward));
  }
  return best;
}

TEST(SearchCertify, NothingThatKeepsTheLimitsIsBetterThanTheBound) {
  std::mt19937 random(175);
  int feasible = 0, close = 0;
  for (int round = 0; round < 10; ++round) {
    const SearchRequirements r = requirements_of(round);
    const SetEnumeration found = enumerate_sets(r);
    ASSERT_FALSE(found.sets.empty()) << round;
    const ToothSet set = found.sets[random() % found.sets.size()];
    const SetResult optimised = optimise_set(r, set);
    const double reached = optimised.candidates.empty() ? -1.0 : optimised.candidates[0].forward;
    // not told what is known: it has to find its way alone
    const double bound =
        certified_bound(r, set, DriveDirection::kForward, {.known = -1.0, .most_boxes = 600})
            .efficiency;
    EXPECT_GE(bound, reached - 1e-9)
        << round << ' ' << set.train->kind() << ' ' << set.sun << '/' << set.planet1;
    EXPECT_GE(bound, best_of_random_points(r, set, 300, random)) << round;
    feasible += reached > 0.0;
    close += reached > 0.0 && bound < reached + 0.01;
  }
  EXPECT_GE(feasible, 5);
  EXPECT_GE(close, 3);  // a bound that bounds nothing would pass the rest
}

TEST(SearchCertify, AnEnclosureHoldsTheMarginsAndLossesOfEveryPointInIt) {
  std::mt19937 random(176);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int kept = 0, ruled_out = 0;
  for (int round = 0; round < 6; ++round) {
    const SearchRequirements r = requirements_of(round);
    const ToothSet set = enumerate_sets(r).sets.front();
    const SearchModel model(r, set);
    SetValues values(r, set, LimitReserve{});
    const SearchLayer& gears = set.train->layers[0];
    const auto teeth = [&](int gear) {
      return gear < 0 ? 0 : set.teeth_at(set.train->place_of(gear));
    };
    const auto drives = [&](int mesh) {
      return mesh < 0 || model.balance()[static_cast<std::size_t>(mesh)].gear1_drives_forward;
    };
    const EnclosedLayer layer{.sun = teeth(gears.sun),
                              .planet = teeth(gears.planet),
                              .ring = teeth(gears.ring),
                              .planets = set.planets,
                              .module = 1.0,
                              .least_module_mm = model.least_module_mm(),
                              .sun_drives = drives(gears.sun_planet),
                              .planet_drives_ring = drives(gears.planet_ring)};
    for (int k = 0; k < 150; ++k) {
      const double width = std::pow(10.0, -1.0 - 3.0 * share(random));
      const double a = set.centre_distance_min +
                       (set.centre_distance_max - set.centre_distance_min) * share(random);
      const double x = r.shift_min + (r.shift_max - r.shift_min) * share(random);
      const LayerEnclosure box = enclose(r, layer, {{a, a + width}, {x, x + width}});
      ruled_out += !box.possible;
      for (int point = 0; point < 12; ++point) {
        const LayerEvaluation e =
            model.layer1(a + width * share(random), x + width * share(random));
        if (values.layer_margin(0, e, false) < 0.0) continue;
        ++kept;
        ASSERT_TRUE(box.possible) << round << ' ' << a << ' ' << x << ' ' << width;
        if (layer.sun) {
          const double loss = layer.sun_drives ? e.sun_planet.driving1 : e.sun_planet.driving2;
          EXPECT_TRUE(box.sun_planet.v.lo - 1e-10 <= loss && loss <= box.sun_planet.v.hi + 1e-10)
              << round;
        }
        if (layer.ring) {
          const double loss =
              layer.planet_drives_ring ? e.planet_ring.driving1 : e.planet_ring.driving2;
          EXPECT_TRUE(box.planet_ring.v.lo - 1e-10 <= loss && loss <= box.planet_ring.v.hi + 1e-10)
              << round;
        }
      }
    }
  }
  EXPECT_GE(kept, 150);
  EXPECT_GE(ruled_out, 200);
}

TEST(SearchCertify, ThePathEfficiencyIsThatOfTheGaussRuleAndItsSlopesBoundItsChanges) {
  for (const bool internal : {false, true})
    for (const bool gear1_drives : {false, true})
      for (const double recess : {1.1, 1.9, 3.3, 4.6}) {
        const double r1 = 9.0, r2 = 31.0, pb = 2.95, u = 0.5, approach = 2.1, friction = 0.08;
        const auto exact = [&](double e1, double e2) {
          const SlidingEfficiency s = sliding_efficiency({.base_radius1_mm = r1,
                                                          .base_radius2_mm = r2,
                                                          .internal = internal,
                                                          .pitch_point_mm = r1 * u,
                                                          .start_mm = r1 * u - e1,
                                                          .end_mm = r1 * u + e2,
                                                          .base_pitch_mm = pb},
                                                         friction, LoadSharing::kEqual);
          return gear1_drives ? s.gear1_driving : s.gear2_driving;
        };
        const LossMesh mesh{.base_radius1 = r1,
                            .base_radius2 = r2,
                            .internal = internal,
                            .gear1_drives = gear1_drives,
                            .base_pitch = pb,
                            .friction = friction};
        const auto enclosed = [&](double width) {
          return enclosed_path_efficiency(
              mesh, {.approach = Slope::variable({approach - width, approach + width}, 0),
                     .recess = Slope::variable({recess - width, recess + width}, 1),
                     .tangent = Slope(u)});
        };
        const Slope point = enclosed(0.0);
        EXPECT_NEAR(point.v.middle(), exact(approach, recess), 1e-11);
        EXPECT_LT(point.v.width(), 1e-10);
        constexpr double kStep = 1e-5;
        EXPECT_NEAR(
            point.d[0].middle(),
            (exact(approach + kStep, recess) - exact(approach - kStep, recess)) / (2 * kStep),
            1e-7);
        EXPECT_NEAR(
            point.d[1].middle(),
            (exact(approach, recess + kStep) - exact(approach, recess - kStep)) / (2 * kStep),
            1e-7);
        const Slope wide = enclosed(0.2);
        for (const double d1 : {-0.2, 0.0, 0.2})
          for (const double d2 : {-0.2, 0.1, 0.2}) {
            if (approach + recess + d1 + d2 < pb) continue;
            EXPECT_TRUE(wide.v.has(exact(approach + d1, recess + d2)));
          }
      }
}

TEST(SearchCertify, TheExamplesBestDesignIsProvedOptimalToOneInHundredThousand) {
  SearchRequirements r;
  r.ratio_min = 90;
  r.ratio_max = 100;
  r.sun = {10, 10}, r.planet1 = {51, 51}, r.ring1 = {113, 113}, r.planet2 = {39, 39},
  r.ring2 = {100, 100};
  const ToothSet set = enumerate_sets(r).sets.front();
  const double reached = optimise_set(r, set).candidates.at(0).forward;
  const CertifiedBound bound =
      certified_bound(r, set, DriveDirection::kForward, {.known = reached});
  EXPECT_GT(reached, 0.9489);
  EXPECT_LE(bound.efficiency, reached + 1.001e-5);
  EXPECT_GE(bound.efficiency, reached);
}

}  // namespace
}  // namespace trueflank
