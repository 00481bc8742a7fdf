// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/counted_runs.h"

// Effects in pairs, at every strength, in bad data, and effects that the library has no name for.
namespace trueflank::test {
namespace {

using loop::Verdict;

struct Hidden {
  std::string id;
  Process process;
};

/// One of each sort, each about three times the noise of 5 um.
std::vector<Hidden> hidden_effects() {
  return {{"eccentricity", off_centre(15, 30)},
          {"axis_tilt", leaning(4, 110)},
          {"scale", scaled(0.25)},
          {"crowning", grown([](auto&, const FlankSpot& s, auto&) { return -15.0 * s.v * s.v; })},
          {"helix_error", twisted(20)},
          {"pitch_wave", indexed(4, 12, 70)},
          {"lobing", out_of_round(3, 15, -40)}};
}

ScanOptions small_scan(unsigned seed = 1) {
  ScanOptions options;
  options.points = 4000;
  options.seed = seed;
  return options;
}

TEST(HiddenEffects, InPairsAreBothNamed) {
  const auto all = hidden_effects();
  const MadeGear gear = spur(18);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      if (!is_surveyed((i + k) % 3 == 0)) continue;
      const auto result =
          close(gear, scan_of(gear, {all[i].process, all[k].process}, small_scan()), true);
      SCOPED_TRACE(all[i].id + " + " + all[k].id + " -> " + list(result));
      EXPECT_EQ(result.effects.size(), 2u);
      EXPECT_NE(find(result, all[i].id), nullptr);
      EXPECT_NE(find(result, all[k].id), nullptr);
      EXPECT_LT(result.after.held_out_rms, 5.0 * 1.2);
    }
}

TEST(HiddenEffects, AreNeverNamedWronglyHoweverWeak) {
  // 0 to 10 sigma: what is found has the right name, and from one sigma on it is found.
  const MadeGear gear = spur(18);
  for (const double strength : survey_of(3, {0.0, 0.3, 1.0, 0.1, 3.0, 10.0})) {
    const double um = 5.0 * strength;
    const std::vector<Hidden> cases = {
        {"eccentricity", off_centre(um, 30)},
        {"crowning", grown([um](auto&, const FlankSpot& s, auto&) { return -um * s.v * s.v; })},
        {"lobing", out_of_round(3, um, -40)}};
    for (const Hidden& c : cases) {
      const auto result = close(gear, scan_of(gear, {c.process}, small_scan(9)), true);
      SCOPED_TRACE(c.id + " at " + std::to_string(strength) + " sigma -> " + list(result));
      EXPECT_EQ(result.effects.empty(), result.verdict == Verdict::kNoEffect);
      if (strength == 0.0) {
        EXPECT_EQ(result.verdict, Verdict::kNoEffect);
      } else if (strength >= 1.0) {
        EXPECT_NE(find(result, c.id), nullptr);
        EXPECT_EQ(result.effects.size(), 1u);
      }
      for (const auto& effect : result.effects) {
        if (!effect.named || effect.id == c.id) continue;
        EXPECT_NE(std::find(effect.confounded_with.begin(), effect.confounded_with.end(), c.id),
                  effect.confounded_with.end())
            << effect.id;
      }
    }
  }
}

TEST(HiddenEffects, AreFoundInBadData) {
  const MadeGear gear = spur(18);
  for (const double correlation : {0.0, 0.8}) {
    ScanOptions options = small_scan(3);
    options.correlation = correlation;
    options.outlier_share = 0.05;
    options.missing_teeth = {2, 3, 11};
    for (const Hidden& c : {hidden_effects()[0], hidden_effects()[3], hidden_effects()[6]}) {
      const auto result = close(gear, scan_of(gear, {c.process}, options), true);
      SCOPED_TRACE(c.id + " -> " + list(result));
      EXPECT_EQ(result.effects.size(), 1u);
      EXPECT_NE(find(result, c.id), nullptr);
      // Outliers below six times the noise cannot be told from it.
      EXPECT_GT(result.noise, 4.5);
      EXPECT_LT(result.noise, 8.0);
    }
  }
}

TEST(HiddenEffects, AreFoundInAnyPoseWhereThePoseCannotHideThem) {
  const MadeGear gear = spur(18);
  for (const Hidden& c : {hidden_effects()[2], hidden_effects()[3], hidden_effects()[6]}) {
    ScanOptions options = small_scan(5);
    options.any_pose = true;
    const auto result = close(gear, scan_of(gear, {c.process}, options), false);
    SCOPED_TRACE(c.id + " -> " + list(result));
    EXPECT_EQ(result.effects.size(), 1u);
    EXPECT_NE(find(result, c.id), nullptr);
  }
}

TEST(HiddenEffects, OfHelicalGearsAreFoundInScansAndTraces) {
  MadeGear gear = helical(21, 25);
  const std::vector<Hidden> in_scans = {hidden_effects()[0], hidden_effects()[2], hidden_effects()[4]};
  for (const Hidden& c : in_scans) {
    const auto result = close(gear, scan_of(gear, {c.process}, small_scan(2)), true);
    SCOPED_TRACE(c.id + " in a scan -> " + list(result));
    EXPECT_EQ(result.effects.size(), 1u);
    EXPECT_NE(find(result, c.id), nullptr);
    EXPECT_LT(result.after.held_out_rms, 5.0 * 1.1);
  }
  for (const Hidden& c : {Hidden{"eccentricity", off_centre(5, 30)}, Hidden{"axis_tilt", leaning(1, 60)},
                          Hidden{"helix_error", twisted(6)}}) {
    const auto result = close(gear, inspection_of(gear, {c.process}, {}));
    SCOPED_TRACE(c.id + " in traces -> " + list(result));
    EXPECT_EQ(result.effects.size(), 1u);
    EXPECT_NE(find(result, c.id), nullptr);
    EXPECT_LT(result.after.held_out_rms, 0.5 * 1.2);
  }
}

// Sections that are shifted in their planes, and a body that is turned: on helical flanks the second moves
// the flanks along the axis, too; of a spur gear the two differ where points went far.
TEST(HiddenEffects, AnAxisThatLeansIsOneEffectWhetherTheFacesLeanOrNot) {
  struct Case {
    MadeGear gear;
    double um_per_mm;
  };
  ScanOptions scan = small_scan(3);
  scan.noise_um = 1.0;
  for (const Case& c : {Case{spur(18), 25.0}, Case{helical(21, 25), 6.0}})
    for (const bool as_a_body : {true, false}) {
      const Process process =
          as_a_body ? leaning_as_a_body(c.um_per_mm, 60) : leaning(c.um_per_mm, 60);
      std::vector<loop::LoopResult> results{close(c.gear, scan_of(c.gear, {process}, scan), true)};
      if (c.gear.helix_rad != 0.0)
        results.push_back(close(c.gear, inspection_of(c.gear, {process}, {})));
      for (const loop::LoopResult& result : results) {
        SCOPED_TRACE(std::to_string(c.gear.teeth) + (as_a_body ? " body" : " sections") + " -> " + list(result));
        const auto* found = find(result, "axis_tilt");
        ASSERT_NE(found, nullptr);
        EXPECT_EQ(result.effects.size(), 1u);
        EXPECT_EQ(parameter(*found, "faces_lean").value, as_a_body ? 1.0 : 0.0);
        const loop::Parameter& slope = parameter(*found, "slope_um_per_mm");
        EXPECT_LT(slope.high - slope.low, 0.1 * c.um_per_mm);
        EXPECT_NEAR(slope.value, c.um_per_mm, slope.high - slope.low);
      }
    }
}

TEST(HiddenEffects, OfRingsAreFound) {
  const MadeGear gear = ring(45);
  for (const Hidden& c : {hidden_effects()[0], hidden_effects()[2], hidden_effects()[6]}) {
    const auto result = close(gear, scan_of(gear, {c.process}, small_scan(4)), true);
    SCOPED_TRACE(c.id + " -> " + list(result));
    EXPECT_EQ(result.effects.size(), 1u);
    EXPECT_NE(find(result, c.id), nullptr);
  }
}

/// Structure of no name: found, described by what it depends on, and no cause invented.
struct Nameless {
  std::string what, words;  ///< words that its description must hold
  Process process;
};

TEST(HiddenEffects, WithoutANameAreDescribedAndGivenNoCause) {
  const MadeGear gear = spur(20);
  const std::vector<Nameless> cases = {
      {"saddle", "crowned over the face", grown([](const MadeGear& g, const FlankSpot& s, auto&) {
         return 14.0 * (s.v * s.v - 1.0 / 3.0) * std::cos(2.0 * 2.0 * M_PI * (s.tooth - 1) / g.teeth);
       })},
      {"lean twice per turn", "twice per turn",
       grown([](const MadeGear& g, const FlankSpot& s, auto&) {
         return 12.0 * s.v * std::cos(2.0 * 2.0 * M_PI * (s.tooth - 1) / g.teeth - 0.7);
       })},
      {"S over the profile", "S-shaped over the profile",
       grown(
           [](auto&, const FlankSpot& s, auto&) { return 14.0 * (s.u * s.u * s.u - 0.6 * s.u); })},
      // (nothing at the root form)
      {"thickness wave", "5 times per turn, more and more evenly from the root on towards the tip",
       grown([](const MadeGear& g, const FlankSpot& s, auto&) {
         return 12.0 * std::cos(5.0 * 2.0 * M_PI * (s.tooth - 1) / g.teeth) * (1.0 + s.u);
       })}};
  for (const Nameless& c : cases) {
    const auto result = close(gear, scan_of(gear, {c.process}, small_scan(6)), true);
    SCOPED_TRACE(c.what + " -> " + list(result));
    ASSERT_FALSE(result.effects.empty());
    std::string described;
    for (const auto& effect : result.effects) {
      EXPECT_FALSE(effect.named) << effect.id;
      EXPECT_TRUE(effect.cause.empty());
      described += effect.description + " ";
    }
    EXPECT_NE(described.find(c.words), std::string::npos) << described;
    EXPECT_LT(result.after.held_out_rms, 5.0 * 1.2);
  }
}

TEST(HiddenEffects, BeyondTheFreeFormLeaveTheVerdictPartly) {
  // A dent of 40 um on one flank, and a wave too fine for the free form over the face.
  const MadeGear gear = spur(20);
  const Process dent = grown([](auto&, const FlankSpot& s, auto&) {
    const double du = s.u / 0.3, dv = (s.v - 0.3) / 0.3;
    return s.tooth == 6 && s.side > 0 ? -120.0 * std::exp(-du * du - dv * dv) : 0.0;
  });
  const auto dented = close(gear, scan_of(gear, {dent}, small_scan(8)), true);
  for (const auto& effect : dented.effects)
    EXPECT_TRUE(!effect.named || effect.id == "single_tooth") << list(dented);
  const bool tooth_named =
      std::any_of(dented.effects.begin(), dented.effects.end(), [](const auto& effect) {
        return effect.description.find("tooth 6") != std::string::npos || effect.id == "single_tooth";
      });
  EXPECT_TRUE(tooth_named || dented.verdict == Verdict::kPartlyExplained) << list(dented);
}

TEST(HiddenEffects, OfGearsWithFewTeethAreFound) {
  MadeGear gear = spur(17);
  gear.teeth = 17;
  for (const int teeth : {6, 8}) {
    MadeGear small = gear;
    small.teeth = teeth;
    small.shift = 0.6;
    small.tip_mm = small.reference() + 1.2;
    small.root_form_mm = ToothProfile::make(design_of(small))->root_form_radius_mm();
    const auto result =
        close(small, scan_of(small, {scaled(0.4)}, small_scan(4)), true);
    EXPECT_NE(find(result, "scale"), nullptr) << teeth << ": " << list(result);
  }
}

TEST(HiddenEffects, FiveTracesAreEnoughForWhatTheyShow) {
  const MadeGear gear = spur(20);
  InspectionOptions options;
  options.teeth = {1, 5, 9, 13, 17};
  options.helix = options.index = false;
  const Process crowned = grown([](auto&, const FlankSpot& s, auto&) { return -5.0 * s.u * s.u; });
  auto data = inspection_of(gear, {crowned}, options);
  std::erase_if(data.rows, [](const auto& row) { return row.flank == Flank::kRight; });
  const auto result = close(gear, data);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "profile_crowning");
  EXPECT_NE(std::find(result.not_observable.begin(), result.not_observable.end(), "helix_error"),
            result.not_observable.end());
}

TEST(HiddenEffects, ALargeHelicalGearThatLeansIsNotStretched) {
  // Its points come to other heights by a third of a millimetre: columns are taken there anew.
  MadeGear gear = helical(70, 21);
  gear.module_mm *= 3.0;
  gear.tip_mm *= 3.0;
  gear.root_form_mm *= 3.0;
  ScanOptions scan = small_scan(5);
  scan.points = 9000;
  scan.noise_um = 1.5;
  const auto result =
      close(gear, scan_of(gear, {leaning_as_a_body(4.0, 100.0), twisted(-17.0)}, scan), true);
  EXPECT_EQ(result.effects.size(), 2u) << list(result);
  EXPECT_NE(find(result, "axis_tilt"), nullptr) << list(result);
  EXPECT_NE(find(result, "helix_error"), nullptr) << list(result);
}

TEST(HiddenEffects, ALayerShiftOfALargeThinGearInAnyPoseKeepsItsHeightAllAround) {
  // Without the shift its pose leans, and the step stands at another height all around the gear.
  MadeGear gear = spur(95);
  gear.face_mm = 5.0;
  ScanOptions scan = small_scan(6);
  scan.points = 4000;
  scan.noise_um = 4.0;
  scan.any_pose = true;
  const auto result = close(gear, scan_of(gear, {shifted_above(3.6, 40.0, 30.0)}, scan), false);
  const auto* found = find(result, "layer_shift");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_NEAR(std::hypot(parameter(*found, "dx_um").value, parameter(*found, "dy_um").value), 50.0,
              1.5);
  EXPECT_NEAR(parameter(*found, "height_mm").value, 3.6, 0.05);
}

}  // namespace
}  // namespace trueflank::test
