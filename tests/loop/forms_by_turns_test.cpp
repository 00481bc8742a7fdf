// SPDX-License-Identifier: GPL-3.0-or-later
// What comes and goes from tooth to tooth: of one tooth in so many, growing, in the order of
// cutting; and lines that run on over teeth.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

/// Draws of this file's own.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

 private:
  std::mt19937 random_;
};

InspectionOptions all_teeth(const MadeGear& gear, bool profile, double noise_um, unsigned seed) {
  InspectionOptions options;
  options.profile = profile;
  options.helix = !profile;
  options.index = false;
  options.teeth.resize(static_cast<std::size_t>(gear.teeth));
  std::iota(options.teeth.begin(), options.teeth.end(), 1);
  options.points = 60;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

InspectionOptions index_alone(double noise_um, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

/// One effect, so large within a fifth, and little more left than the noise of 1 um.
void expect_one_of(const loop::LoopResult& result, const std::string& words, double amount_um,
                   const std::string& draw, double noise_um = 1.0) {
  const std::string told = draw + ": " + list(result);
  ASSERT_EQ(result.effects.size(), 1U) << told;
  EXPECT_TRUE(tells(result, words)) << words << "; " << told;
  EXPECT_LT(result.after.held_out_rms, 1.2 * noise_um) << told;
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, amount_um, 0.2 * amount_um)
      << told;
}

TEST(OneToothInSoMany, ThatLeansLeavesTheOthersNoName) {
  Numbers draw(1);
  for (int k = 0; k < 4; ++k) {
    const MadeGear gear = spur(2 * draw.whole(9, 20));
    const int odd = draw.whole(0, 1);
    const bool profile = k % 2 == 0;
    const double um = draw.any(3.0, 8.0);
    const auto lean = grown([=](auto&, const FlankSpot& s, auto&) {
      return s.tooth % 2 == odd ? um * (profile ? s.u : s.v * s.side) : 0.0;
    });
    const auto result =
        close(gear, inspection_of(gear, {lean}, all_teeth(gear, profile, 1.0, 40U + k)));
    expect_one_of(result,
                  "one tooth in 2, from tooth " + std::to_string(odd == 1 ? 1 : 2) + " on, leans",
                  um, std::to_string(k));
  }
}

TEST(OneToothInSoMany, ThatHasAGrooveOrWavesIsOneForm) {
  Numbers draw(2);
  for (int k = 0; k < survey_size(2, 4); ++k) {
    const int every = draw.whole(2, 4), first = draw.whole(1, every);
    const MadeGear gear = spur(every * draw.whole(7, 11));
    const double um = draw.any(6.0, 14.0), at = draw.any(-0.3, 0.3), phase = draw.any(0.0, 6.0);
    const bool waves = k % 2 == 1;
    const auto form = grown([=](auto&, const FlankSpot& s, auto&) {
      if ((s.tooth - first) % every != 0 || (!waves && s.side < 0)) return 0.0;
      return waves ? um * std::cos(1.7 * M_PI * s.u - phase)
                   : -um * std::exp(-std::pow((s.u - at) / 0.25, 2));
    });
    const auto result =
        close(gear, inspection_of(gear, {form}, all_teeth(gear, true, 1.0, 60U + k)));
    expect_one_of(result,
                  "one tooth in " + std::to_string(every) + ", from tooth " +
                      std::to_string(first) + " on, " + (waves ? "1.7 waves" : "about a diameter"),
                  um, std::to_string(k));
  }
}

TEST(Saws, FromNothingLeaveNoNameForTheirMean) {
  Numbers draw(3);
  for (int k = 0; k < 3; ++k) {
    const int every = draw.whole(6, 9);
    const MadeGear gear = spur(every * draw.whole(3, 5));
    const double um = draw.any(4.0, 8.0);
    const auto dressed = grown([=](auto&, const FlankSpot& s, auto&) {
      return um * s.u * ((s.tooth - 1) % every) / (every - 1.0);
    });
    const auto result =
        close(gear, inspection_of(gear, {dressed}, all_teeth(gear, true, 1.0, 80U + k)));
    expect_one_of(result, "from nothing on its first tooth, and begins anew every", um,
                  std::to_string(k));
  }
}

TEST(GrowingWaves, OfTracesAreOneForm) {
  Numbers draw(4);
  for (int k = 0; k < survey_size(2, 6); ++k) {
    const int z = draw.whole(18, 50);
    const MadeGear gear = spur(z);
    const double um = draw.any(8.0, 16.0), waves = draw.any(2.6, 6.0), phase = draw.any(0.0, 6.0);
    const bool profile = k % 2 == 0, fades = k % 3 == 0;
    const auto wave = grown([=](auto&, const FlankSpot& s, auto&) {
      const double grown_to = (s.tooth - 1.0) / (z - 1.0);
      return um * (fades ? 1.0 - grown_to : grown_to) *
             std::cos(M_PI * waves * (profile ? s.u : s.v) - phase);
    });
    InspectionOptions options = all_teeth(gear, profile, 1.0, 100U + k);
    options.points = 100;
    std::erase_if(options.teeth, [](int tooth) { return tooth % 2 == 0; });
    const auto result = close(gear, inspection_of(gear, {wave}, options));
    expect_one_of(result,
                  std::string(fades ? "less and less" : "more and more") +
                      " from tooth to tooth, once around, ",
                  um, std::to_string(k));
  }
}

TEST(CutOrders, ThatJumpOverTeethAreTold) {
  Numbers draw(5);
  for (int k = 0; k < survey_size(2, 5); ++k) {
    int z = draw.whole(19, 43), step = draw.whole(3, 7);
    while (std::gcd(z, step) != 1) ++z;
    const int first = draw.whole(1, z);
    const double um = draw.any(6.0, 14.0);
    std::vector<double> place(static_cast<std::size_t>(z));
    for (int cut = 0, tooth = first - 1; cut < z; ++cut, tooth = (tooth + step) % z)
      place[static_cast<std::size_t>(tooth)] = um * cut / (z - 1.0);
    const auto result =
        close(spur(z), inspection_of(spur(z), {grown([&](auto&, const FlankSpot& s, auto&) {
                                       return s.side * place[static_cast<std::size_t>(s.tooth - 1)];
                                     })},
                                     index_alone(0.5, 120U + k)));
    const std::string told =
        std::to_string(z) + " teeth, step " + std::to_string(step) + ": " + list(result);
    ASSERT_EQ(result.effects.size(), 1U) << told;
    EXPECT_TRUE(tells(result,
                      "drifts from cut to cut, counter-clockwise, where teeth are cut in "
                      "steps of " +
                          std::to_string(step) + ": tooth " + std::to_string(first) + ",") ||
                tells(result, " times a turn"))
        << told;
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, um, 0.12 * um) << told;
  }
}

TEST(ChangingWaves, OfAnIndexGrowOrRing) {
  Numbers draw(6);
  for (int k = 0; k < survey_size(2, 6); ++k) {
    const int z = draw.whole(30, 60), first = draw.whole(1, z);
    const double um = draw.any(6.0, 12.0), phase = draw.any(0.0, 6.0);
    const bool rings = k % 2 == 1;
    const double periods = rings ? draw.any(6.0, z / 4.0) : draw.whole(3, 7);
    const auto wave = grown([=](auto&, const FlankSpot& s, auto&) {
      const int since = (s.tooth - first + z) % z;
      const double size = rings ? std::exp(-since / 7.0) : since / (z - 1.0);
      return s.side * um * size *
             std::cos(2.0 * M_PI * periods * since / z - (rings ? 0.4 : phase));
    });
    const auto result = close(spur(z), inspection_of(spur(z), {wave}, index_alone(0.4, 140U + k)));
    const std::string told =
        std::to_string(z) + " teeth, " + std::to_string(periods) + ": " + list(result);
    EXPECT_EQ(result.effects.size(), 1U) << told;
    EXPECT_TRUE(
        tells(result, rings ? "that die away, to a third within" : "that grow evenly from nothing"))
        << told;
    EXPECT_LT(result.noise, 0.6) << told;
  }
}

TEST(SlantedRidges, OverTheFlanksAndAroundTheGearAreOneForm) {
  Numbers draw(7);
  for (int k = 0; k < survey_size(2, 6); ++k) {
    const int z = draw.whole(16, 40);
    const MadeGear gear = spur(z);
    const double face = gear.face_mm, um = draw.any(25.0, 45.0);
    const bool around = k % 2 == 0;
    const double rise = (k % 4 < 2 ? 1.0 : -1.0) * draw.any(0.5, 1.1) * face,
                 at = draw.any(0.3, 0.6) * face, wide = draw.any(0.06, 0.1) * face;
    const auto ridge = grown([=](const MadeGear&, const FlankSpot& s, const Vec3& p) {
      const double z_mm = 0.5 * (s.v + 1.0) * face;
      if (!around) return um * std::exp(-std::pow((z_mm - at - 0.5 * rise * s.u) / wide, 2));
      const double turn = std::atan2(p[1], p[0]) / (2.0 * M_PI);
      double sum = 0.0;
      for (int line = -4; line <= 4; ++line)
        sum += um * std::exp(-std::pow((z_mm - at - rise * (turn + line)) / wide, 2));
      return sum;
    });
    const auto result = close(gear, scan_of(gear, {ridge}, scanned(9000, 4.0, 160U + k)), true);
    const std::string told = std::to_string(k) + ": " + list(result);
    ASSERT_FALSE(result.effects.empty()) << told;
    EXPECT_TRUE(tells(result, around ? "a ridge that runs around the gear as it rises"
                                     : "a ridge in a line aslant over the flanks"))
        << told;
    EXPECT_EQ(result.effects.size(), 1U) << told;
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, um, 0.1 * um) << told;
    const loop::EffectShape& shape = result.effects[0].terms.front().shape;
    EXPECT_NEAR(shape[around ? 2 : 1], rise, 0.03 * std::abs(rise)) << told;
  }
}

TEST(PlaneSaw, OfAnAxisInStepsIsOneForm) {
  const MadeGear gear = spur(31);
  for (const bool along_y : {false, true}) {
    const double period = along_y ? 1.3 : 5.1;
    const Process steps{.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
      const double at = p[along_y ? 1 : 0] / period + 0.3;
      const double um = 30.0 * (0.5 - (at - std::floor(at)));
      return {along_y ? 0.0 : um, along_y ? um : 0.0, 0.0};
    }};
    const auto result = close(gear, scan_of(gear, {steps}, scanned(9000, 4.0, 180)), true);
    expect_one_of(
        result,
        std::string("places are shifted along ") + (along_y ? "y" : "x") + " in a sawtooth over",
        30.0, along_y ? "y" : "x", 4.0);
    ASSERT_FALSE(result.effects.empty());
    EXPECT_NEAR(result.effects[0].terms.front().shape[2], period, 0.01 * period) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
