// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

/// Largest distance of the posed points from the flanks they were made on [mm].
double worst_distance(const MadeGear& made, const ScanOptions& options) {
  const auto geometry = geometry_of(made);
  const auto scan = scan_of(made, {}, options);
  const auto pose = loop::fit_pose(geometry, scan);
  EXPECT_TRUE(pose.has_value());
  double worst = 0.0;
  for (const auto& p : scan.points_mm)
    worst = std::max(worst, std::abs(geometry.nearest_flank((*pose)(p)).distance_mm));
  return worst;
}

TEST(Pose, IsFoundExactlyFromPointsWithoutNoise) {
  for (const MadeGear& made : {spur(12), spur(39), ring(60), helical(30, 20.0)}) {
    ScanOptions options;
    options.points = 6000;
    options.noise_um = 0.0;
    options.any_pose = true;
    EXPECT_LT(worst_distance(made, options), 1e-6) << made.teeth;
  }
}

TEST(Pose, IsFoundOfPinionsWhosePointsScatterAlikeInAllDirections) {
  // A cylinder 2.45 times as long as its radius has no principal direction.
  for (const double length : {2.2, 2.35, 2.45, 2.55, 2.7})
    for (const unsigned seed : {1U, 2U}) {
      MadeGear made = spur(17);
      made.face_mm = length * made.reference();
      ScanOptions options = scanned(4000, 2.0, seed);
      options.any_pose = true;
      const auto scan = scan_of(made, {}, options);
      const loop::FlankGeometry geometry = geometry_of(made);
      const auto pose = loop::fit_pose(geometry, scan);
      ASSERT_TRUE(pose.has_value());
      const loop::PoseQuality quality = loop::pose_quality(geometry, scan, *pose);
      EXPECT_GT(quality.share, 0.95) << length;
      EXPECT_LT(quality.median_mm, 0.003) << length;
    }
}

TEST(Pose, IsFoundWithHalfTheTeethMissing) {
  ScanOptions options;
  options.points = 6000;
  options.noise_um = 0.0;
  options.any_pose = true;
  for (int k = 3; k <= 14; ++k) options.missing_teeth.push_back(k);
  EXPECT_LT(worst_distance(spur(24), options), 1e-6);
}

// Strips of one side show no circle.
TEST(Pose, OfAFewFlanksIsFoundFromWhereTheScanStands) {
  for (const int teeth : {24, 39}) {
    const MadeGear made = spur(teeth);
    ScanOptions options = scanned(8000, 3.0, 4);
    for (int k = 5; k <= teeth; ++k) options.missing_teeth.push_back(k);
    auto scan = scan_of(made, {}, options);
    const loop::FlankGeometry geometry = geometry_of(made);
    std::erase_if(scan.points_mm, [&](const Vec3& p) {
      const auto placed = geometry.nearest_flank(p);
      return placed.place.surface != loop::Surface::kFlank || placed.place.side < 0;
    });
    for (Vec3& p : scan.points_mm)
      p = {p[0] + 0.2, p[1] - 0.15 + 0.003 * p[2], p[2] - 0.003 * p[1]};
    const auto pose = loop::fit_pose(geometry, scan);
    ASSERT_TRUE(pose.has_value());
    const loop::PoseQuality quality = loop::pose_quality(geometry, scan, *pose);
    EXPECT_GT(quality.share, 0.95) << teeth;
    EXPECT_LT(quality.median_mm, 0.004) << teeth;
  }
}

/// Points of another toothing, and of a shaft that carries both, beside those of a gear.
void add_rest_of_part(const MadeGear& made, const MadeGear& beside, loop::ScanData& scan) {
  ScanOptions options = scanned(8000, 2.0, 7);
  for (const Vec3& p : scan_of(beside, {}, options).points_mm)
    scan.points_mm.push_back({p[0], p[1], p[2] + made.face_mm});
  const double radius = 0.6 * made.reference(), length = 6.0;
  for (int i = 0; i < 2000; ++i)
    scan.points_mm.push_back(
        {radius * std::cos(0.1 * i), radius * std::sin(0.1 * i), -length * (i / 2000.0)});
}

TEST(Pose, OfOneToothingIsFoundInAScanOfAWholePart) {
  MadeGear wide = spur(39);
  wide.face_mm = 14.0;
  const std::vector<std::pair<MadeGear, MadeGear>> parts = {
      {spur(24), spur(17)}, {spur(17), spur(24)}, {spur(24), wide}, {helical(30, 20.0), spur(17)}};
  for (const auto& [made, beside] : parts) {
    auto scan = scan_of(made, {}, scanned(8000, 2.0, 3));
    const std::size_t of_gear = scan.points_mm.size();
    add_rest_of_part(made, beside, scan);
    const double lean = 0.7;
    for (Vec3& p : scan.points_mm)
      p = {p[0] + 40.0, p[1] * std::cos(lean) - p[2] * std::sin(lean) - 7.0,
           p[1] * std::sin(lean) + p[2] * std::cos(lean) + 3.0};
    const loop::FlankGeometry geometry = geometry_of(made);
    const auto pose = loop::fit_pose(geometry, scan);
    ASSERT_TRUE(pose.has_value());
    const std::string which =
        std::to_string(made.teeth) + " beside " + std::to_string(beside.teeth);
    const loop::PoseQuality quality = loop::pose_quality(geometry, scan, *pose);
    EXPECT_GT(quality.share, 0.95) << which;
    EXPECT_LT(quality.median_mm, 0.003) << which;
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < of_gear; ++i) {
      low = std::min(low, (*pose)(scan.points_mm[i])[2]);
      high = std::max(high, (*pose)(scan.points_mm[i])[2]);
    }
    EXPECT_NEAR(low, 0.0, 0.012 * made.face_mm) << which;
    EXPECT_NEAR(high, made.face_mm, 0.012 * made.face_mm) << which;
  }
}

TEST(Pose, AShoulderInTheBoreDoesNotLeanTheAxis) {
  const MadeGear made = spur(39);
  const double bore = 5.0;
  ScanOptions options = scanned(8000, 3.0, 2);
  options.any_pose = false;
  auto scan = scan_of(made, {}, options);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  // The bore from half the face on; a shoulder closes the wider seat below it, seen best from one
  // side.
  for (int i = 0; i < 260; ++i) {
    const double angle = 2.0 * M_PI * share(random);
    scan.points_mm.push_back(
        {bore * std::cos(angle), bore * std::sin(angle), 5.3 + 4.6 * share(random)});
  }
  for (int i = 0; i < 60; ++i) {
    const double angle = M_PI * share(random), radius = bore + 0.3 * share(random);
    scan.points_mm.push_back({radius * std::cos(angle), radius * std::sin(angle), 5.3});
  }
  for (Vec3& p : scan.points_mm) p = {p[2] + 4.0, p[0], p[1] - 9.0};
  loop::MeasuredData data;
  data.scans.push_back(scan);
  const loop::FlankGeometry geometry(*ToothProfile::make(design_of(made)), made.face_mm, bore);
  const auto closed = loop::close_loop(geometry, "gear", data, {});
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect) << list(closed->result);
  EXPECT_LT(closed->result.before.rms, 3.3);
}

TEST(Pose, OfAHerringboneGearHasItsHeight) {
  const MadeGear made = helical(25, 30.0);
  const loop::FlankGeometry geometry(*ToothProfile::make(design_of(made)), made.face_mm, 0.0, true);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(0.03, 0.97);
  loop::ScanData scan;
  for (int i = 0; i < 6000; ++i) {
    const double roll =
        geometry.root_form_roll_mm() +
        share(random) * (geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
    // more of the lower end was seen
    const double z = made.face_mm * std::pow(share(random), 1.3);
    const loop::Place place = geometry.on_flank(1 + i % made.teeth, i % 2 == 0 ? 1 : -1, roll, z);
    scan.points_mm.push_back({place.radius_mm * std::cos(place.polar_rad) + 20.0,
                              place.radius_mm * std::sin(place.polar_rad), z - 4.0});
  }
  for (const bool turned_over : {false, true}) {
    if (turned_over)
      for (Vec3& p : scan.points_mm) p = {p[0], -p[1], -p[2]};
    const auto pose = loop::fit_pose(geometry, scan);
    ASSERT_TRUE(pose.has_value());
    EXPECT_LT(loop::pose_quality(geometry, scan, *pose).median_mm, 1e-6) << turned_over;
  }
}

TEST(Pose, IsNotPulledByOutliers) {
  const MadeGear made = spur(24);
  ScanOptions options;
  options.points = 8000;
  options.noise_um = 2.0;
  options.outlier_share = 0.1;
  options.any_pose = true;
  const auto scan = scan_of(made, {}, options);
  const auto geometry = geometry_of(made);
  const auto pose = loop::fit_pose(geometry, scan);
  ASSERT_TRUE(pose);
  EXPECT_LT(loop::pose_quality(geometry, scan, *pose).median_mm, 1.8e-3);
}

TEST(Pose, OfAnotherGearIsRefused) {
  ScanOptions options;
  options.points = 4000;
  options.any_pose = true;
  loop::MeasuredData data;
  data.scans.push_back(scan_of(spur(24), {}, options));
  const auto result = loop::close_loop(geometry_of(spur(31)), "gear", data, {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().front().message.find("does not fit"), std::string::npos);
}

TEST(Pose, LandsOfTipsInManyPointsSpeakAgainstNoScan) {
  const MadeGear made = spur(24);
  ScanOptions options;
  options.points = 3000;
  auto scan = scan_of(made, {}, options);
  for (int i = 0; i < 40000; ++i) {
    const double angle = 2.0 * M_PI * i / 40000.0, radius = made.tip_mm + 0.01;
    scan.points_mm.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.002 * (i % 5000)});
  }
  EXPECT_GT(loop::pose_quality(geometry_of(made), scan, {}).share, 0.9);
}

TEST(Pose, AScanThatDoesNotFitAsAlignedSaysHowItWould) {
  const MadeGear made = spur(60);
  ScanOptions options;
  options.points = 6000;
  options.noise_um = 1.0;
  loop::MeasuredData data;
  data.scans.push_back(scan_of(made, {}, options));
  const double lean = 20.0 * M_PI / 180.0;
  for (auto& p : data.scans[0].points_mm)
    p = {p[0], p[1] * std::cos(lean) - p[2] * std::sin(lean), p[1] * std::sin(lean) + p[2] * std::cos(lean)};
  const auto result = loop::close_loop(geometry_of(made), "gear", data, {.aligned = true});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().front().remedy.find("its axis leaning by 20 degrees"), std::string::npos)
      << result.error().front().remedy;
}

TEST(Pose, NeedsEnoughPoints) {
  loop::ScanData scan;
  scan.points_mm = {{1, 2, 3}, {2, 3, 4}};
  const auto pose = loop::fit_pose(geometry_of(spur(24)), scan);
  ASSERT_FALSE(pose);
  EXPECT_EQ(pose.error().code, ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace trueflank::test
