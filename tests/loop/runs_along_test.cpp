// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/runs_along.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// How named effects run along the flanks, by what they are.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::FlankChoice;
using loop::Runs;

Effect named(const std::string& id, FlankChoice flank = FlankChoice::kLeft) {
  for (const auto& known : loop::effect_library())
    if (known.id == id) return {&known, flank, {}};
  throw std::logic_error("no effect " + id);
}

const loop::FlankGeometry kGeometry = geometry_of(spur(24));

TEST(RunsAlong, NamedEffectsRunAsTheirNamesSay) {
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
    const auto runs = [&](const std::string& id) { return runs_of(kGeometry, named(id, flank)); };
    EXPECT_EQ(runs("pressure_angle_error"), Runs::kOverProfile);
    EXPECT_EQ(runs("profile_crowning"), Runs::kOverProfile);
    EXPECT_EQ(runs("helix_error"), Runs::kOverFace);
    EXPECT_EQ(runs("crowning"), Runs::kOverFace);
    EXPECT_EQ(runs("flank_twist"), Runs::kOverBoth);
    EXPECT_EQ(runs("tooth_thickness"), Runs::kNowhere);
  }
  EXPECT_EQ(runs_of(kGeometry, named("eccentricity", FlankChoice::kBoth)), Runs::kOtherwise);
  EXPECT_EQ(runs_of(kGeometry, named("crowning", FlankChoice::kBoth)), Runs::kOverFace);
}

/// The same asked at places drawn at random, for every effect of the library that needs no shape.
TEST(RunsAlong, EveryEffectRunsAsItDoesAtRandomPlaces) {
  std::mt19937 engine(492);
  const auto share = [&] { return std::uniform_real_distribution<double>(0.02, 0.98)(engine); };
  const double low = kGeometry.root_form_roll_mm(), high = kGeometry.tip_form_roll_mm();
  std::set<Runs> met;
  for (const auto& family : loop::effect_library()) {
    if (family.shapes) continue;
    const Effect effect{&family, FlankChoice::kBoth, {}};
    if (effect.columns() > 2 || effect.order() != 0.0 || family.local) {
      EXPECT_EQ(runs_of(kGeometry, effect), Runs::kOtherwise) << family.id;
      continue;
    }
    const auto at = [&](int tooth, int side, double u, double v) {
      std::array<double, 2> values{};
      effect.evaluate(
          kGeometry,
          kGeometry.on_flank(tooth, side, low + u * (high - low), v * kGeometry.face_width_mm()),
          values.data());
      return values;
    };
    double profile = 0.0, face = 0.0, flanks = 0.0, teeth = 0.0;
    const auto keep = [](double& most, std::array<double, 2> a, std::array<double, 2> b) {
      most = std::max({most, std::abs(a[0] - b[0]), std::abs(a[1] - b[1])});
    };
    for (int draw = 0; draw < 60; ++draw) {
      const double u = share(), v = share();
      const int side = draw % 2 == 0 ? 1 : -1;
      const auto here = at(1, side, u, v);
      keep(profile, here, at(1, side, share(), v));
      keep(face, here, at(1, side, u, share()));
      keep(flanks, here, at(1, -side, u, v));
      keep(teeth, here, at(2 + draw % 23, side, u, v));
    }
    const Runs runs = teeth > 1e-5                    ? Runs::kOtherwise
                      : profile > 1e-5 && face > 1e-5 ? Runs::kOverBoth
                      : profile > 1e-5                ? Runs::kOverProfile
                      : face > 1e-5                   ? Runs::kOverFace
                                                      : Runs::kNowhere;
    EXPECT_EQ(runs_of(kGeometry, effect, loop::Flanks::kOfEither), runs) << family.id;
    EXPECT_EQ(runs_of(kGeometry, effect), flanks > 1e-5 ? Runs::kOtherwise : runs) << family.id;
    met.insert(runs);
  }
  EXPECT_GE(met.size(), 4U);
}

TEST(RunsAlong, SlopesAreStraightAndBowsAreNot) {
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
    EXPECT_TRUE(is_straight(kGeometry, named("pressure_angle_error", flank)));
    EXPECT_TRUE(is_straight(kGeometry, named("helix_error", flank)));
    for (const char* bow : {"profile_crowning", "crowning", "flank_twist", "tooth_thickness"})
      EXPECT_FALSE(is_straight(kGeometry, named(bow, flank))) << bow;
  }
}

TEST(RunsAlong, EffectsRunAlikeThatDifferByAFactorAndALevel) {
  const char* const effects[] = {"pressure_angle_error", "profile_crowning", "helix_error",
                                 "crowning"};
  for (const char* a : effects)
    for (const char* b : effects)
      EXPECT_EQ(run_alike(kGeometry, named(a), named(b)), std::string(a) == b) << a << " " << b;
  const Effect aside = named("eccentricity", FlankChoice::kBoth);
  EXPECT_FALSE(run_alike(kGeometry, aside, aside));
  EXPECT_FALSE(run_alike(kGeometry, aside, named("crowning")));
  EXPECT_FALSE(run_alike(kGeometry, named("crowning"), aside));
}

TEST(RunsAlong, AnEccentricityAloneMovesTheTeeth) {
  EXPECT_TRUE(moves_the_teeth(named("eccentricity", FlankChoice::kBoth)));
  for (const char* other : {"axis_tilt", "crowning", "tooth_thickness", "scale"})
    EXPECT_FALSE(moves_the_teeth(named(other, FlankChoice::kBoth))) << other;
}

TEST(RunsAlong, TheGridOfAToothHasItsPlacesInTheMiddleOfNineByNineCells) {
  const double low = kGeometry.root_form_roll_mm(), high = kGeometry.tip_form_roll_mm();
  for (const char* id : {"pressure_angle_error", "crowning", "flank_twist", "eccentricity"}) {
    const Effect effect = named(id, FlankChoice::kBoth);
    const Eigen::MatrixXd field = over_a_tooth(kGeometry, effect);
    ASSERT_EQ(field.rows(), 162);
    ASSERT_EQ(field.cols(), effect.columns());
    for (int row = 0; row < 162; ++row) {
      const int side = row < 81 ? 1 : -1, i = row % 81 / 9, k = row % 9;
      std::vector<double> values(static_cast<std::size_t>(effect.columns()));
      effect.evaluate(kGeometry,
                      kGeometry.on_flank(1, side, low + (2 * i + 1) / 18.0 * (high - low),
                                         (2 * k + 1) / 18.0 * kGeometry.face_width_mm()),
                      values.data());
      for (std::size_t c = 0; c < values.size(); ++c)
        EXPECT_NEAR(field(row, static_cast<Eigen::Index>(c)), values[c], 1e-9) << id << row;
    }
  }
}

}  // namespace
}  // namespace trueflank::test
