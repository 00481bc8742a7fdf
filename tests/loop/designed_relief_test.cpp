// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"

// Relief and crowning of the design are part of the model, not effects.
namespace trueflank::test {
namespace {

constexpr double kRelief_um = 20.0, kCrowning_um = 12.0;

/// What the made gear and the design both have, in the terms of each.
double relief_um(double u, double v) {
  const double t = (u - 0.3) / 0.7;
  return (t > 0.0 ? -kRelief_um * t * t : 0.0) - kCrowning_um * v * v;
}

loop::FlankGeometry relieved(const MadeGear& made) {
  const auto profile = *ToothProfile::make(design_of(made));
  const double from = profile.root_form_roll_length_mm(), to = profile.tip_form_roll_length_mm();
  const double face = made.face_mm;
  TrainGear gear{.name = "gear", .profile = profile, .face_width_mm = face};
  gear.twist = face_twist(profile.gear(), face, false);
  gear.deviation.deviation_mm = [=](int, Flank, double roll, double z) {
    return 1e-3 * relief_um(2.0 * (roll - from) / (to - from) - 1.0, 2.0 * z / face - 1.0);
  };
  return loop::FlankGeometry(gear);
}

Process made_relieved() {
  return grown([](auto&, const FlankSpot& s, auto&) { return relief_um(s.u, s.v); });
}

TEST(DesignedRelief, IsNoEffectInAScan) {
  const MadeGear gear = spur(18);
  loop::MeasuredData data;
  ScanOptions options;
  options.points = 6000;
  data.scans.push_back(scan_of(gear, {made_relieved()}, options));
  const auto own = loop::close_loop(relieved(gear), "gear", data, {.aligned = true})->result;
  EXPECT_EQ(own.verdict, loop::Verdict::kNoEffect) << list(own);
  EXPECT_NEAR(own.before.rms, 5.0, 0.2);
  const auto plain = loop::close_loop(geometry_of(gear), "gear", data, {.aligned = true})->result;
  EXPECT_NE(find(plain, "crowning"), nullptr) << list(plain);
  EXPECT_NE(find(plain, "tip_relief"), nullptr) << list(plain);
}

TEST(DesignedRelief, IsTakenOffTracesUnlessTheMachineDidSo) {
  const MadeGear gear = spur(18);
  for (const bool from_design : {false, true}) {
    loop::MeasuredData data;
    data.inspections.push_back(
        inspection_of(gear, from_design ? std::vector<Process>{} : std::vector{made_relieved()}, {}));
    data.inspections.back().from_design = from_design;
    const auto result = loop::close_loop(relieved(gear), "gear", data, {})->result;
    EXPECT_EQ(result.verdict, loop::Verdict::kNoEffect) << from_design << ": " << list(result);
  }
}

TEST(DesignedRelief, DoesNotHideWhatIsNotDesigned) {
  const MadeGear gear = spur(18);
  loop::MeasuredData data;
  ScanOptions options;
  options.points = 6000;
  data.scans.push_back(scan_of(gear, {made_relieved(), off_centre(15, 20)}, options));
  const auto result = loop::close_loop(relieved(gear), "gear", data, {.aligned = true})->result;
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "eccentricity");
}

// The walls of the groove between the halves of herringbone teeth stand where flanks would be.
TEST(DesignedReliefGroove, ItsWallsAreNoFlanks) {
  const MadeGear made = helical(25, 30.0);
  const double groove = 2.0;
  const auto profile = *ToothProfile::make(design_of(made));
  TrainGear gear{.name = "gear", .profile = profile, .face_width_mm = made.face_mm};
  gear.twist = face_twist(profile.gear(), made.face_mm, true, groove);
  const loop::FlankGeometry geometry(gear);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> noise_mm(0.0, 3e-3);
  loop::ScanData scan;
  const auto add = [&](int i, double z, double inwards_mm) {
    const double roll = geometry.root_form_roll_mm() +
                        (0.03 + 0.94 * share(random)) *
                            (geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
    const loop::Place place = geometry.on_flank(1 + i % made.teeth, i % 2 == 0 ? 1 : -1, roll, z);
    const double out = noise_mm(random) / geometry.cos_base_helix() - inwards_mm;
    scan.points_mm.push_back(
        {place.radius_mm * std::cos(place.polar_rad) + out * place.normal_direction[0],
         place.radius_mm * std::sin(place.polar_rad) + out * place.normal_direction[1], z});
  };
  for (int i = 0; i < 8000; ++i) {
    const double z = 0.15 + share(random) * (0.5 * (made.face_mm - groove) - 0.15);
    add(i, i % 4 < 2 ? z : made.face_mm - z, 0.0);
  }
  for (int i = 0; i < 800; ++i)
    add(i, 0.5 * (made.face_mm + (i % 4 < 2 ? groove : -groove)), 0.3 * share(random));
  loop::MeasuredData data;
  data.scans.push_back(scan);
  for (const bool aligned : {true, false}) {
    const auto closed = loop::close_loop(geometry, "gear", data, {.aligned = aligned});
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect) << list(closed->result);
    EXPECT_LT(closed->result.before.rms, 3.3);
  }
}

}  // namespace
}  // namespace trueflank::test
