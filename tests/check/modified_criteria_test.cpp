// SPDX-License-Identifier: GPL-3.0-or-later
//
// What modifications do to the criteria, to radial removal, to tolerances and to the face that carries.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "tests/check/check_designs.h"
#include "tests/check/mesh_simulation.h"
#include "tests/check/modified_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/ring_criteria.h"
#include "trueflank/check/tolerance_analysis.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/section_profile.h"
#include "trueflank/train/mesh_face.h"
#include "trueflank/train/strength.h"

namespace trueflank::test {
namespace {

Finding finding_of(const GearboxDesign& design, const std::string& id, const std::string& where = "") {
  return only(check_gearbox(laid_out(design)), id, where);
}

/// Diameter on a gear at a place of the line of action, roll length of gear 1.
double diameter1(const GearPair& pair, double roll1_mm) {
  return 2.0 * std::hypot(base_radius_mm(pair.gear1()), roll1_mm);
}
double diameter2(const GearPair& pair, double roll1_mm) {
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  const double roll2 = pair.internal() ? roll1_mm + span : span - roll1_mm;
  return 2.0 * std::hypot(base_radius_mm(pair.gear2()), roll2);
}

TEST(ActivePath, WithoutModificationsRunsFromTipToTip) {
  for (bool internal : {false, true}) {
    const GearTrain train = laid_out(pair_design(23, internal ? 60 : 37, internal, 0.1));
    const LineOfAction line = line_of_action(train.pair(train.meshes[0]));
    const ActivePath path = active_path(train, train.meshes[0]);
    EXPECT_EQ(path.start_mm, line.start_mm);
    EXPECT_EQ(path.end_mm, line.end_mm);
  }
}

TEST(ActivePath, EndsWhereAReliefBegins) {
  for (bool internal : {false, true}) {
    GearboxDesign design = pair_design(23, internal ? 60 : 37, internal, 0.1);
    const GearTrain plain = laid_out(design);
    const GearPair pair = plain.pair(plain.meshes[0]);
    const LineOfAction line = line_of_action(pair);
    ASSERT_GT(line.end_mm - line.start_mm, 1.4 * line.base_pitch_mm);
    const double start = line.start_mm + 0.2 * line.base_pitch_mm;
    const double end = line.end_mm - 0.1 * line.base_pitch_mm;
    gear(design, "wheel").modifications = {.tip_relief_um = 10.0,
                                           .tip_relief_start_diameter_mm = diameter2(pair, start)};
    gear(design, "pinion").modifications = {.tip_relief_um = 10.0,
                                            .tip_relief_start_diameter_mm = diameter1(pair, end)};
    const GearTrain train = laid_out(design);
    const ActivePath path = active_path(train, train.meshes[0]);
    EXPECT_NEAR(path.start_mm, start, 2e-3);  // a parabola of 10 um: 1 nm deep 0.01 of its length on
    EXPECT_NEAR(path.end_mm, end, 2e-3);
    // the criterion counts from there
    const double form = pair.profile1->root_form_radius_mm();
    const Finding fillet = only(check_gearbox(train), "fillet_interference");
    const double margin1 = 0.5 * diameter1(pair, start) - form;
    const double margin2 = (internal ? -1.0 : 1.0) *
                           (0.5 * diameter2(pair, end) - pair.profile2->root_form_radius_mm());
    EXPECT_NEAR(fillet.value, std::min(margin1, margin2), 2e-3);
    EXPECT_NE(fillet.message.find("where the modified flanks touch without load"), std::string::npos);
  }
}

TEST(ActivePath, OfAProfileCrownedPairIsOneBasePitch) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "pinion").modifications.profile_crowning_um = 8.0;
  const GearTrain train = laid_out(design);
  const GearPair pair = train.pair(train.meshes[0]);
  const LineOfAction line = line_of_action(pair);
  const ActivePath path = active_path(train, train.meshes[0]);
  EXPECT_NEAR(path.end_mm - path.start_mm, line.base_pitch_mm, 1e-3);
  const double middle = 0.5 * (pair.profile1->root_form_roll_length_mm() +
                               pair.profile1->tip_form_roll_length_mm());
  EXPECT_NEAR(0.5 * (path.start_mm + path.end_mm), middle, 1e-3);
}

TEST(ActivePath, ReachesTheTipThatHasMoreMaterial) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "wheel").modifications.profile_slope_um = 12.0;
  const GearTrain train = laid_out(design);
  const LineOfAction line = line_of_action(train.pair(train.meshes[0]));
  const ActivePath path = active_path(train, train.meshes[0]);
  EXPECT_EQ(path.start_mm, line.start_mm);
  EXPECT_NEAR(path.end_mm, line.start_mm + line.base_pitch_mm, 1e-3);
}

TEST(ModifiedCriteria, TipReliefClearsThePrototypesFilletAndMaterialAtTheTipDoesNot) {
  // without backlash the tip of ring1 cuts 0.16 um into planet1's fillet
  GearboxDesign design = paper_design(0.0);
  EXPECT_EQ(finding_of(design, "fillet_interference", "planet1-ring1").status, CheckStatus::kFail);
  const GearTrain plain = laid_out(design);
  const TrainGear& ring = *plain.find("ring1");
  const double tip = ring.profile.tip_form_radius_mm();
  GearboxDesign relieved = design;
  gear(relieved, "ring1").modifications = {.tip_relief_um = 5.0,
                                           .tip_relief_start_diameter_mm = 2.0 * (tip + 0.25)};
  const Findings all = check_gearbox(laid_out(relieved));
  EXPECT_EQ(only(all, "overlap", "planet1-ring1").status, CheckStatus::kPass);
  const Finding fillet = only(all, "fillet_interference", "planet1-ring1");
  EXPECT_NE(fillet.status, CheckStatus::kFail) << fillet.message;
  EXPECT_EQ(only(all, "involute_interference", "planet1-ring1").status == CheckStatus::kFail, false);
  // half the backlash is 10 um: 25 um more at the tip, taken from the root, is too much
  GearboxDesign thick = paper_design(0.02);
  EXPECT_NE(finding_of(thick, "fillet_interference", "planet1-ring1").status, CheckStatus::kFail);
  gear(thick, "ring1").modifications = {.profile_slope_um = 50.0};
  EXPECT_EQ(finding_of(thick, "overlap", "planet1-ring1").status, CheckStatus::kFail);
  EXPECT_EQ(finding_of(thick, "fillet_interference", "planet1-ring1").status, CheckStatus::kFail);
}

TEST(ModifiedContactRatio, IsBetweenTheTipFormCirclesOfRoundedTips) {
  GearboxDesign design = pair_design(25, 40, false);
  gear(design, "pinion").shift = gear(design, "wheel").shift = 0.0;
  for (const char* name : {"pinion", "wheel"}) gear(design, name).modifications.tip_rounding_mm = 0.15;
  const GearTrain train = laid_out(design);
  // unshifted: a = m (z1 + z2) / 2, r_a = m (z / 2 + 1); the rounding meets the flank, on the tangent of the
  // base circle, rho beyond the arc's centre
  const double alpha = kPi / 9.0, rho = 0.15;
  const auto form_roll = [&](int z) {
    const double r_a = 0.5 * z + 1.0, r_b = 0.5 * z * std::cos(alpha);
    return std::sqrt((r_a - rho) * (r_a - rho) - r_b * r_b) + rho;
  };
  const double expected = (form_roll(25) + form_roll(40) - 32.5 * std::sin(alpha)) / (kPi * std::cos(alpha));
  const ContactRatios ratios = contact_ratios(train.pair(train.meshes[0]));
  EXPECT_NEAR(ratios.total, expected, 1e-9);
  const Finding finding = only(check_gearbox(train), "contact_ratio");
  EXPECT_NEAR(finding.value, expected, 1e-9);
  EXPECT_NE(finding.message.find("from the tip form circles"), std::string::npos) << finding.message;
}

TEST(ModifiedCriteria, ProcessesSeeModifiedTipsAndBacklash) {
  GearboxDesign design = pair_design(23, 37, false, 0.2);
  design.made.process = *ProcessTable().find("fdm-0.4");
  const auto backlash_of = [](const GearboxDesign& d) {
    return finding_of(d, "manufacturability", "pinion-wheel").value;
  };
  EXPECT_NEAR(backlash_of(design), 0.2, 1e-12);
  gear(design, "pinion").modifications.helix_slope_um = 30.0;
  const GearTrain train = laid_out(design);
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  EXPECT_NEAR(backlash_of(design), 0.2 - 0.030 / cosine, 1e-9);
}

TEST(ModifiedCriteria, TipMarginsFallByWhatTheTipsGain) {
  GearboxDesign design = pair_design(30, 42, true, 0.05);
  const GearTrain plain = laid_out(design);
  const GearPair pair = plain.pair(plain.meshes[0]);
  const double r_b2 = base_radius_mm(pair.gear2());
  const double trochoid = trochoid_margin_rad(pair), trimming = trimming_margin_rad(pair);
  // profile slope: half of it at the tip; helix slope: half of it at one end, on one side
  gear(design, "pinion").modifications.profile_slope_um = 10.0;
  gear(design, "wheel").modifications.helix_slope_um = 16.0;
  const GearTrain train = laid_out(design);
  const TrainMesh& mesh = train.meshes[0];
  const double gained = (0.005 + 0.008) / r_b2;
  EXPECT_NEAR(worst_margin_rad(train, mesh, trochoid_margin_rad), trochoid - gained, 1e-3 * gained);
  EXPECT_NEAR(worst_margin_rad(train, mesh, trimming_margin_rad), trimming - gained, 1e-3 * gained);
  const Finding finding = only(check_gearbox(train), "trochoid_interference");
  EXPECT_NEAR(finding.value, deg_from_rad(trochoid - gained), deg_from_rad(1e-3 * gained));
}

TEST(ModifiedCriteria, HelixSlopesThatMatchCostTheTipsNothing) {
  GearboxDesign design = pair_design(30, 42, true, 0.05);
  const GearTrain plain = laid_out(design);
  const GearPair pair = plain.pair(plain.meshes[0]);
  // both sections turn the same way: what the pinion's leading corner gains the ring's other side lacks
  for (const char* name : {"pinion", "wheel"}) gear(design, name).modifications.helix_slope_um = 16.0;
  const GearTrain train = laid_out(design);
  const double slack = 1e-3 * 0.008 / base_radius_mm(pair.gear2());
  EXPECT_NEAR(worst_margin_rad(train, train.meshes[0], trochoid_margin_rad),
              trochoid_margin_rad(pair), slack);
  EXPECT_NEAR(worst_margin_rad(train, train.meshes[0], trimming_margin_rad),
              trimming_margin_rad(pair), slack);
}

TEST(ModifiedCriteria, WithMoreMaterialNothingIsJudgedSafer) {
  int compared = 0;
  for (unsigned seed = 300; compared < 8; ++seed) {
    std::optional<GearTrain> less;
    try {
      less = random_modified_pair(seed);
    } catch (const std::runtime_error&) {
      continue;
    }
    // the same with less taken away
    GearboxDesign design = less->design;
    std::mt19937 engine(seed);
    for (GearDesign& g : design.gears)
      for (double* removed : {&g.modifications.tip_relief_um, &g.modifications.root_relief_um,
                              &g.modifications.profile_crowning_um, &g.modifications.crowning_um,
                              &g.modifications.end_relief_um, &g.modifications.edge_chamfer_mm})
        *removed *= std::uniform_real_distribution<double>(0.2, 1.0)(engine);
    const auto more = lay_out(design);
    if (!more) continue;
    ++compared;
    const TrainMesh &mesh1 = less->meshes[0], &mesh2 = more->meshes[0];
    constexpr double kSlack_mm = 2e-6;  // of the sweeps' refinement
    EXPECT_LE(modified_clearance_mm(*more, mesh2), modified_clearance_mm(*less, mesh1) + kSlack_mm)
        << seed;
    EXPECT_LE(modified_mesh(*more, mesh2).backlash_mm,
              modified_mesh(*less, mesh1).backlash_mm + kSlack_mm)
        << seed;
    if (!less->pair(mesh1).internal()) continue;
    for (auto* margin : {trochoid_margin_rad, trimming_margin_rad}) {
      const double with_more = worst_margin_rad(*more, mesh2, margin);
      const double with_less = worst_margin_rad(*less, mesh1, margin);
      if (!std::isfinite(with_less)) continue;
      EXPECT_LE(with_more, with_less + 1e-8) << seed;
    }
    EXPECT_LE(modified_removal(*more, mesh2).free_share, modified_removal(*less, mesh1).free_share)
        << seed;
  }
}

TEST(ModifiedCriteria, TrochoidAgreesWithTurningTheModifiedTips) {
  int bad = 0, good = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937 engine(seed);
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(engine);
    };
    GearboxDesign design = pair_design(30, 36 + static_cast<int>(seed % 3), true, real(0.02, 0.4));
    gear(design, "wheel").modifications.helix_slope_um = real(-40.0, 40.0);
    gear(design, "pinion").modifications = {.profile_slope_um = real(0.0, 20.0),
                                            .tip_rounding_mm = seed % 2 == 0 ? real(0.05, 0.2) : 0.0};
    const auto train = lay_out(design);
    if (!train) continue;
    const TrainMesh& mesh = train->meshes[0];
    const double margin = worst_margin_rad(*train, mesh, trochoid_margin_rad);
    const MeshClearance centred = modified_state(*train, mesh).centred;
    const auto at_tip = [](PieceKind kind) {
      return kind == PieceKind::kTip || kind == PieceKind::kTipRounding;
    };
    const bool tips = at_tip(centred.place.piece1) && at_tip(centred.place.piece2);
    if (std::abs(margin) * train->gears[1].profile.tip_radius_mm() < 2e-4) continue;
    if (centred.clearance_mm < 0.0 && !tips) continue;  // worse elsewhere
    EXPECT_EQ(margin < 0.0, centred.clearance_mm < 0.0) << seed << " " << margin;
    ++(margin < 0.0 ? bad : good);
  }
  EXPECT_GE(bad, 4);
  EXPECT_GE(good, 4);
}

/// By brute force: the pinion moved out of the ring in steps, its sections sampled from the surface; the
/// deepest penetration on the way (positive: none), to the last step before the tips are apart.
double way_out_mm(const GearTrain& train, double turn1_rad) {
  const TrainGear &gear1 = train.gears[0], &gear2 = train.gears[1];
  const double z1 = gear1.profile.gear().teeth, z2 = gear2.profile.gear().teeth;
  const double travel = train.centre_distance_mm -
                        (gear2.profile.tip_radius_mm() - gear1.profile.tip_radius_mm());
  double least = 1e300;
  for (double z : {0.0, 10.0})
    for (int i = 0; i < 40; ++i) {
      const Point2 axis2(-train.centre_distance_mm + travel * i / 40.0, 0.0);
      least = std::min(least, simulate_position_mm({gear1.toothing(), z}, turn1_rad,
                                                   {gear2.toothing(), z},
                                                   turn1_rad * z1 / z2 + kPi / z2, axis2));
    }
  return least;
}

TEST(ModifiedRemoval, AgreesWithMovingThePinionOut) {
  int kept = 0, free = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 engine(100 + seed);
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(engine);
    };
    GearboxDesign design = pair_design(20, 32 + static_cast<int>(seed % 3), true, real(0.1, 0.3));
    gear(design, "wheel").modifications.helix_slope_um = real(-60.0, 60.0);
    gear(design, "pinion").modifications = {.profile_slope_um = real(-30.0, 30.0),
                                            .tip_rounding_mm = seed % 2 == 0 ? 0.1 : 0.0};
    const auto train = lay_out(design);
    ASSERT_TRUE(train) << train.error().front().message;
    const RadialRemoval removal = modified_removal(*train, train->meshes[0]);
    for (std::size_t i = 1; i < 64; i += 9) {
      const double least = way_out_mm(*train, kTwoPi / 20.0 * static_cast<double>(i) / 64.0);
      if (std::abs(least) < 2e-3) continue;  // what little overhang is not seen
      EXPECT_EQ(removal.free_at.at(i), least > 0.0) << seed << " at " << i << ": " << least;
      ++(least > 0.0 ? free : kept);
    }
  }
  EXPECT_GE(kept, 10);
  EXPECT_GE(free, 5);
}

TEST(ModifiedRemoval, HelicalTeethLeaveOnlyWhereAllSectionsDo) {
  const GearTrain train = laid_out(pair_design(20, 34, true, 0.1));
  const GearPair pair = train.pair(train.meshes[0]);
  const RadialRemoval straight = radial_removal(pair);
  ASSERT_GT(straight.free_share, 0.1);
  ASSERT_LT(straight.free_share, 0.9);
  // a twelfth of a pitch over the face: where both ends and all between leave
  const RadialRemoval twisted = radial_removal({pair}, kTwoPi / 20.0 / 12.0);
  for (std::size_t i = 0; i < 64; ++i) {
    bool all = true;
    for (std::size_t k = 0; k <= 6; ++k) all = all && straight.free_at[(i + k) % 64];
    EXPECT_EQ(twisted.free_at[i], all) << i;
  }
  EXPECT_LT(twisted.free_share, straight.free_share);
  EXPECT_EQ(radial_removal({pair}, 1.2 * kTwoPi / 20.0).free_share, 0.0);
}

TEST(ModifiedTolerance, CornersAreTheSectionsOfTheDesignsThere) {
  for (bool internal : {false, true}) {
    GearboxDesign design = pair_design(25, internal ? 60 : 40, internal, 0.1);
    gear(design, "pinion").shift = gear(design, "wheel").shift = 0.0;
    gear(design, "pinion").modifications = {.profile_slope_um = 12.0, .helix_slope_um = 24.0};
    gear(design, "wheel").modifications = {.crowning_um = 5.0};
    const GearTrain train = laid_out(design);
    const auto result = analyse_tolerances(
        train, {.centre_distance_um = 15, .tooth_thickness_um = 10, .sets = 200});
    ASSERT_TRUE(result) << result.error().message;
    // the same corner as a design of its own, laid out and turned
    double backlash = 1e300, clearance = 1e300;
    for (double distance : {-0.015, 0.0, 0.015}) {
      GearboxDesign corner = design;
      corner.backlash_mm = 0.0;
      corner.centre_distance_mm = train.centre_distance_mm + distance;
      for (std::size_t g = 0; g < 2; ++g)
        corner.gears[g].thinning_mm = train.gears[g].profile.gear().thinning_mm - 0.010;
      const GearTrain at = laid_out(corner);
      backlash = std::min(backlash, modified_mesh(at, at.meshes[0]).backlash_mm);
      clearance = std::min(clearance, mesh_states(at)[0].centred.clearance_mm);
    }
    EXPECT_NEAR(result->meshes[0].smallest_backlash_mm, backlash, 1e-7) << internal;
    EXPECT_NEAR(result->meshes[0].smallest_clearance_mm, clearance, 1e-6) << internal;
    EXPECT_NEAR(result->meshes[0].nominal_backlash_mm,
                modified_mesh(train, train.meshes[0]).backlash_mm, 1e-9);
    // and not those of the unmodified teeth
    for (GearDesign& g : design.gears) g.modifications = {};
    const auto plain = analyse_tolerances(
        laid_out(design), {.centre_distance_um = 15, .tooth_thickness_um = 10, .sets = 200});
    EXPECT_LT(result->meshes[0].smallest_backlash_mm, plain->meshes[0].smallest_backlash_mm - 0.02);
  }
}

TEST(ModifiedTolerance, JamsMoreOftenWithMaterialAdded) {
  GearboxDesign design = pair_design(25, 40, false, 0.03);
  const ToleranceOptions options{.tooth_thickness_um = 15, .sets = 2000};
  const double plain = analyse_tolerances(laid_out(design), options)->jam_share;
  gear(design, "pinion").modifications.helix_slope_um = 20.0;
  EXPECT_GT(analyse_tolerances(laid_out(design), options)->jam_share, plain + 0.01);
}

TEST(CarryingFace, LosesTheEdgeChamfersOfBothGears) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  design.helix_angle_rad = rad_from_deg(20.0);
  const double m = design.module_mm;
  gear(design, "pinion").modifications.edge_chamfer_mm = 0.3;
  gear(design, "wheel").modifications.edge_chamfer_mm = 0.2;
  GearTrain train = laid_out(design);
  const CommonFace face = common_face(train, train.meshes[0]);
  EXPECT_NEAR(face.carrying_mm, 10.0 - 2.0 * 0.3, 1e-12);
  EXPECT_NEAR(overlap_ratio(train, train.meshes[0]),
              9.4 * std::sin(rad_from_deg(20.0)) / (kPi * m), 1e-12);
  // a narrower gear inside the wider one's chamfers: its own count alone
  gear(design, "pinion").face_width_mm = 12.0;
  gear(design, "wheel").face_width_mm = 10.0;
  train = laid_out(design);
  EXPECT_NEAR(common_face(train, train.meshes[0]).lower_mm, 0.3, 1e-12);
  EXPECT_NEAR(common_face(train, train.meshes[0]).upper_mm, 9.8, 1e-12);
}

TEST(CarryingFace, CarriesTheLoad) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  const auto whole = strength(laid_out(design));
  gear(design, "wheel").modifications.edge_chamfer_mm = 0.25;
  const auto chamfered = strength(laid_out(design));
  ASSERT_TRUE(whole && chamfered);
  EXPECT_NEAR(chamfered->meshes[0].tooth1.bending_force_n,
              0.95 * whole->meshes[0].tooth1.bending_force_n, 1e-9);
  EXPECT_NEAR(chamfered->meshes[0].contact_force_n, 0.95 * whole->meshes[0].contact_force_n, 1e-9);
}

TEST(CarryingFace, IsWhereHelixSlopesAreJudged) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "pinion").modifications = {.helix_slope_um = 30.0, .edge_chamfer_mm = 0.2};
  const GearTrain train = laid_out(design);
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  EXPECT_NEAR(modified_mesh(train, train.meshes[0]).ccw_play_mm, 0.05 * cosine - 0.96 * 0.015, 1e-9);
}

TEST(GearDistance, OfHalvesThatDifferIsThatOfAllTeeth) {
  for (bool internal : {false, true}) {
    const GearTrain train = laid_out(pair_design(18, internal ? 40 : 21, internal));
    const ToothProfile& design = train.gears[1].profile;
    const GearKind kind = design.gear().kind;
    // far more than any modification, so that neighbouring halves matter
    const FlankDeviation field{.deviation_mm = [kind](int, Flank flank, double, double) {
      return 0.12 * flank_side(flank, kind);
    }};
    const Toothing toothing{.profile = &design, .twist = {.face_width_mm = 10.0}, .deviation = &field};
    const GearDistance distance(section_profile(toothing, 5.0).profile);
    std::vector<Point2> outline;  // of three teeth
    std::vector<int> side_of;     // of each of its points
    for (int tooth : {-1, 0, 1})
      for (int side : {-1, 1}) {
        std::vector<Point2> half;
        for (std::size_t k = 0; k < design.pieces().size(); ++k)
          for (int i = 0; i <= 200; ++i) {
            const Curve& c = design.pieces()[k].curve;
            half.push_back(rotated(
                section_point(toothing, {0, side, k, c.begin + (c.end - c.begin) * i / 200.0}, 5.0),
                kTwoPi * tooth / design.gear().teeth));
          }
        if (side < 0) std::reverse(half.begin(), half.end());
        outline.insert(outline.end(), half.begin(), half.end());
        side_of.resize(outline.size(), side);
      }
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const double middle = 0.5 * (design.tip_radius_mm() + design.root_radius_mm());
    for (int i = 0; i < 400; ++i) {
      const Point2 p = (middle + 1.4 * share(engine)) *
                       unit_vector(share(engine) * kPi / design.gear().teeth);
      double nearest = 1e300, nearest_of_half = 1e300;
      const auto found = distance.nearest(p);
      for (std::size_t k = 0; k + 1 < outline.size(); ++k) {
        const Point2 along = outline[k + 1] - outline[k];
        const double square = along.squaredNorm();
        const double u =
            square > 0.0 ? std::clamp((p - outline[k]).dot(along) / square, 0.0, 1.0) : 0.0;
        const double away = (p - outline[k] - u * along).norm();
        nearest = std::min(nearest, away);
        if ((side_of[k] < 0) == found.clockwise_half || side_of[k] != side_of[k + 1])
          nearest_of_half = std::min(nearest_of_half, away);
      }
      EXPECT_NEAR(std::abs(found.distance_mm), nearest, 2e-5) << i << " " << internal;
      EXPECT_NEAR(nearest_of_half, nearest, 2e-5) << i << " " << internal;
    }
  }
}

}  // namespace
}  // namespace trueflank::test
