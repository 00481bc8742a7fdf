// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/modified_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "check_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

using test::laid_out;

GearboxDesign pair(double backlash_mm, double helix_deg = 0.0, bool internal = false) {
  GearboxDesign design = test::pair_design(23, internal ? 60 : 37, internal, backlash_mm);
  design.helix_angle_rad = rad_from_deg(helix_deg);
  // the ring's tips clear the pinion's fillets, so that flanks are nearest
  if (internal) test::gear(design, "wheel").tip_diameter_mm = 58.9 / std::cos(design.helix_angle_rad);
  return design;
}

MeshState state_of(const GearTrain& train) { return mesh_states(train)[0]; }

/// By plain search: the real surface points of gear 1's flanks at one height against the nearest points
/// of dense flanks of gear 2 there; turned through two pitches.
double searched_clearance(const GearTrain& train, double z) {
  const TrainGear &g1 = train.gears[0], &g2 = train.gears[1];
  const bool internal = g2.profile.gear().kind == GearKind::kInternal;
  const auto outline = [&](const TrainGear& gear, int side, int places) {
    std::vector<Point2> points;
    const Toothing toothing = gear.toothing();
    for (std::size_t k = 0; k < gear.profile.pieces().size(); ++k) {
      if (gear.profile.pieces()[k].kind != PieceKind::kInvolute) continue;
      const Curve& c = gear.profile.pieces()[k].curve;
      for (int i = 0; i <= places; ++i)
        points.push_back(section_point(
            toothing, {0, side, k, c.begin + (c.end - c.begin) * i / places}, z));
    }
    return points;
  };
  double least = 1e300;
  const double z1 = g1.profile.gear().teeth, z2 = g2.profile.gear().teeth;
  const Point2 axis2(internal ? -train.centre_distance_mm : train.centre_distance_mm, 0.0);
  for (int side1 : {1, -1})
    for (int side2 : {1, -1}) {
      const auto moving = outline(g1, side1, 200), fixed = outline(g2, side2, 120);
      for (int step = -20; step <= 20; ++step) {
        const double turn1 = kTwoPi / z1 * step / 20.0;
        const double turn2 = internal ? turn1 * z1 / z2 - kPi / z2 : kPi + kPi / z2 - turn1 * z1 / z2;
        for (int tooth2 : {-1, 0, 1}) {
          const double placed2 = turn2 + kTwoPi * tooth2 / z2;
          for (const Point2& p : moving) {
            const Point2 q = rotated(Point2(rotated(p, turn1) - axis2), -placed2);
            for (std::size_t i = 0; i + 1 < fixed.size(); ++i) {
              const Point2 along = fixed[i + 1] - fixed[i];
              const double length = along.squaredNorm();
              if (length == 0.0) continue;
              const double u = std::clamp((q - fixed[i]).dot(along) / length, 0.0, 1.0);
              least = std::min(least, (q - fixed[i] - u * along).norm());
            }
          }
        }
      }
    }
  return least;
}

TEST(ModifiedClearance, WithoutModificationsNothingChanges) {
  const GearTrain train = laid_out(pair(0.1));
  EXPECT_FALSE(is_modified(train, train.meshes[0]));
  const MeshState state = state_of(train);
  EXPECT_EQ(state.centred.clearance_mm, mesh_clearance(train.pair(train.meshes[0])).clearance_mm);
  EXPECT_TRUE(std::isnan(state.centred.z_mm));
  EXPECT_NEAR(modified_mesh(train, train.meshes[0]).backlash_mm, 0.1, 1e-12);
}

TEST(ModifiedClearance, MismatchedHelixSlopesEatTheBacklashAtTheEnds) {
  for (bool internal : {false, true}) {
    GearboxDesign design = pair(0.1, 0.0, internal);
    test::gear(design, "pinion").modifications.helix_slope_um = 30.0;
    const GearTrain train = laid_out(design);
    const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
    const ModifiedMesh mesh = modified_mesh(train, train.meshes[0]);
    // each end takes half the slope from one flank
    EXPECT_NEAR(mesh.ccw_play_mm, 0.05 * cosine - 0.015, 1e-9);
    EXPECT_NEAR(mesh.cw_play_mm, 0.05 * cosine - 0.015, 1e-9);
    EXPECT_NEAR(mesh.backlash_mm, 0.1 - 0.030 / cosine, 1e-9);
    const MeshState state = state_of(train);
    EXPECT_NEAR(state.centred.clearance_mm, 0.05 * cosine - 0.015, 1e-6);
    EXPECT_TRUE(state.centred.z_mm == 0.0 || state.centred.z_mm == 10.0) << state.centred.z_mm;
    EXPECT_NEAR(state.driving.clearance_mm, 0.0, 1e-6);
    // the mate with the same slope of the mesh takes it back: external the other hand, ring the same
    test::gear(design, "wheel").modifications.helix_slope_um = internal ? 30.0 : -30.0;
    const GearTrain matched = laid_out(design);
    EXPECT_NEAR(modified_mesh(matched, matched.meshes[0]).backlash_mm, 0.1, 1e-9);
    EXPECT_NEAR(state_of(matched).centred.clearance_mm, 0.05 * cosine, 1e-6);
  }
}

TEST(ModifiedClearance, AgreesWithAPlainSearchOnTheRealSurface) {
  for (bool internal : {false, true}) {
    GearboxDesign design = pair(0.08, 15.0, internal);
    auto& pinion = test::gear(design, "pinion").modifications;
    pinion = {.profile_crowning_um = 6.0, .profile_slope_um = 9.0, .helix_slope_um = 14.0};
    test::gear(design, "wheel").modifications.profile_slope_um = -5.0;
    const GearTrain train = laid_out(design);
    const MeshState state = state_of(train);
    double searched = 1e300;
    for (double z : {0.0, 5.0, 10.0}) searched = std::min(searched, searched_clearance(train, z));
    EXPECT_NEAR(state.centred.clearance_mm, searched, 1e-4);
    EXPECT_LE(state.centred.clearance_mm, searched + 2e-5);
    EXPECT_LT(state.centred.clearance_mm, 0.04 * 0.94);
  }
}

TEST(ModifiedClearance, ReliefsTakeNothingFromTheClearanceAndShortenTheUnrelievedContact) {
  GearboxDesign design = pair(0.1);
  const GearTrain plain = laid_out(design);
  const TrainGear& pinion = plain.gears[0];
  const double r_b = base_radius_mm(pinion.profile.gear());
  const LineOfAction line = line_of_action(plain.pair(plain.meshes[0]));
  const double start = line.effective_end_mm - 0.3 * line.base_pitch_mm;
  test::gear(design, "pinion").modifications = {
      .tip_relief_um = 12.0, .tip_relief_start_diameter_mm = 2.0 * std::hypot(r_b, start)};
  const GearTrain train = laid_out(design);
  const double before = contact_ratios(plain.pair(plain.meshes[0])).effective;
  EXPECT_NEAR(modified_mesh(train, train.meshes[0]).unrelieved_contact_ratio, before - 0.3, 1e-9);
  const MeshState state = state_of(train);
  EXPECT_NEAR(state.centred.clearance_mm, state_of(plain).centred.clearance_mm, 1e-6);
  const auto find = [](const Findings& all, const std::string& id) {
    return *std::find_if(all.begin(), all.end(), [&](const Finding& f) { return f.id == id; });
  };
  const Finding contact = find(check_gearbox(train), "contact_ratio");
  EXPECT_EQ(contact.status, before - 0.3 < 1.0 ? CheckStatus::kWarn : CheckStatus::kPass);
  EXPECT_NE(contact.message.find("between the starts of the reliefs"), std::string::npos);
  EXPECT_NEAR(contact.value, before, 1e-12);
}

TEST(ModifiedClearance, RandomModificationsKeepWithinTheirBounds) {
  std::mt19937 engine(7);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  int judged = 0;
  for (int i = 0; i < 20; ++i) {
    const bool internal = i % 3 == 0;
    GearboxDesign design = pair(0.12, i % 2 == 0 ? 0.0 : real(-40.0, 40.0), internal);
    design.herringbone = i % 4 == 1;
    const GearTrain plain = laid_out(design);
    for (std::size_t g = 0; g < 2; ++g) {
      const ToothProfile& profile = plain.gears[g].profile;
      const double root = profile.root_form_radius_mm(), tip = profile.tip_form_radius_mm();
      design.gears[g].modifications = {
          .tip_relief_um = real(0.0, 10.0),
          .tip_relief_start_diameter_mm = 2.0 * (root + real(0.4, 0.8) * (tip - root)),
          .tip_relief_shape = i % 5 == 0 ? ReliefShape::kLinear : ReliefShape::kParabola,
          .profile_crowning_um = real(0.0, 4.0),
          .profile_slope_um = real(-8.0, 8.0),
          .crowning_um = real(0.0, 8.0),
          .end_relief_um = real(0.0, 8.0),
          .end_relief_length_mm = real(0.5, 3.0),
          .helix_slope_um = real(-15.0, 15.0)};
    }
    const auto train = lay_out(design);
    ASSERT_TRUE(train) << train.error().front().message;
    const TrainMesh& mesh = train->meshes[0];
    const ModifiedMesh play = modified_mesh(*train, mesh);
    const MeshState state = state_of(*train);
    const double cos_b = std::cos(base_helix_angle_rad(train->gears[0].profile.gear()));
    double added = 0.0;
    for (const TrainGear& gear : train->gears) {
      double most = 0.0;
      for (Flank flank : {Flank::kLeft, Flank::kRight})
        for (int a = 0; a <= 40; ++a)
          for (int b = 0; b <= 40; ++b) {
            const double from = gear.profile.root_form_roll_length_mm();
            const double to = gear.profile.tip_form_roll_length_mm();
            most = std::max(most, gear.deviation.deviation_mm(0, flank, from + (to - from) * a / 40,
                                                              gear.face_width_mm * b / 40));
          }
      added += most / cos_b;
    }
    ++judged;
    // play is read where flanks touch, clearance where half the backlash parts them
    EXPECT_LE(state.centred.clearance_mm, std::min(play.ccw_play_mm, play.cw_play_mm) + 5e-5) << i;
    EXPECT_GE(state.centred.clearance_mm, state_of(plain).centred.clearance_mm - added - 1e-6) << i;
    EXPECT_GE(state.driving.clearance_mm, -1e-6) << i;
  }
  EXPECT_EQ(judged, 20);
}

TEST(ModifiedClearance, AddedMaterialAtZeroBacklashFails) {
  GearboxDesign design = pair(0.0);
  test::gear(design, "pinion").modifications.profile_slope_um = 20.0;
  const Findings all = check_gearbox(laid_out(design));
  int failed = 0;
  for (const Finding& f : all)
    if (f.status == CheckStatus::kFail) {
      EXPECT_TRUE(f.id == "overlap" || f.id == "backlash") << f.id;
      EXPECT_FALSE(f.cure.empty());
      ++failed;
    }
  EXPECT_EQ(failed, 2);
}

TEST(ModifiedClearance, TipThicknessCountsWhatIsLeft) {
  GearboxDesign design = pair(0.1);
  const auto thickness = [](const GearTrain& train) {
    for (const Finding& f : check_gearbox(train))
      if (f.id == "tip_thickness" && f.where == "pinion") return f.value;
    return kNaN;
  };
  const GearTrain plain = laid_out(design);
  test::gear(design, "pinion").modifications.crowning_um = 25.0;
  const GearTrain crowned = laid_out(design);
  const double r_a = plain.gears[0].profile.tip_radius_mm();
  EXPECT_NEAR(thickness(plain) - thickness(crowned),
              2.0 * 0.025 * r_a / base_radius_mm(plain.gears[0].profile.gear()), 1e-9);
}

}  // namespace
}  // namespace trueflank
