// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "tests/check/check_designs.h"
#include "tests/check/modified_designs.h"
#include "tests/support/draw.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/clearance_field.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/contact_judgement.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/mesh_face.h"

// Clearances over tolerances and of sections of modified teeth, each by its definition.
namespace trueflank::test {
namespace {

/// The field as it is described: of turned teeth at the corners of cells, a cell's plane where none
/// of them jams or all do, or where it is true in the middle.
class FieldByHand {
 public:
  FieldByHand(const GearPair& pair, double distance_mm, double thickness1_mm, double thickness2_mm)
      : pair_(pair),
        distance_mm_(distance_mm),
        thickness1_mm_(thickness1_mm),
        thickness2_mm_(thickness2_mm) {}

  double at(int i, int k) {
    const auto [found, is_new] = turned_.try_emplace({i, k}, 0.0);
    if (!is_new) return found->second;
    const double u = i / 4.0 - 1.0, v = k / 4.0 - 1.0;
    Gear gear1 = pair_.gear1(), gear2 = pair_.gear2();
    gear1.thinning_mm -= v * thickness1_mm_;
    gear2.thinning_mm -= v * thickness2_mm_;
    const auto profile1 = ToothProfile::make(gear1), profile2 = ToothProfile::make(gear2);
    const GearPair other{&*profile1, &*profile2, pair_.centre_distance_mm + u * distance_mm_};
    backlash_[{i, k}] = circumferential_backlash_mm(other);
    return found->second = sweep_clearance_mm(other);
  }
  double backlash(int i, int k) { return at(i, k), backlash_[{i, k}]; }

  double clearance(double distance_mm, double thickness_mm) {
    const double x = 4.0 * (1.0 + std::clamp(distance_mm / distance_mm_, -1.0, 1.0)),
                 y = 4.0 * (1.0 + std::clamp(thickness_mm / (thickness1_mm_ + thickness2_mm_), -1.0,
                                             1.0));
    for (int size = 4;; size /= 2) {
      const int i = std::min(static_cast<int>(x / size), 8 / size - 1) * size,
                k = std::min(static_cast<int>(y / size), 8 / size - 1) * size;
      const double a = at(i, k), b = at(i + size, k), c = at(i, k + size),
                   d = at(i + size, k + size);
      const auto jammed = (a < -1e-6) + (b < -1e-6) + (c < -1e-6) + (d < -1e-6);
      if (size > 1 && jammed > 0 && jammed < 4 &&
          std::abs(at(i + size / 2, k + size / 2) - 0.25 * (a + b + c + d)) > 1e-5) {
        ++halved;
        continue;
      }
      return std::lerp(std::lerp(a, c, (y - k) / size), std::lerp(b, d, (y - k) / size),
                       (x - i) / size);
    }
  }
  int halved = 0;

 private:
  const GearPair& pair_;
  double distance_mm_, thickness1_mm_, thickness2_mm_;
  std::map<std::pair<int, int>, double> turned_, backlash_;
};

TEST(ClearanceField, IsThatOfTurnedTeethAtTheCornersOfItsCellsAndPlaneBetweenThem) {
  static_assert(tolerance::kTouch_mm == 1e-6);
  const GearTrain train = laid_out(pair_design(13, 19, false, 0.05));
  const TrainMesh& mesh = train.meshes[0];
  const GearPair pair = train.pair(mesh);
  const GearSpread spread1{.thickness_mm = 0.02, .eccentricity_mm = 0.06, .pitch_mm = 0.01},
      spread2{.thickness_mm = 0.015, .eccentricity_mm = 0.05, .pitch_mm = 0.005};
  auto field = ClearanceField::make(train, mesh, spread1, spread2, 0.4);
  ASSERT_TRUE(field);
  FieldByHand hand(pair, 0.51, 0.03, 0.02);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(field->at(i, k).clearance_mm, hand.at(4 * i, 4 * k), 1e-12);
      EXPECT_NEAR(field->at(i, k).backlash_mm, hand.backlash(4 * i, 4 * k), 1e-12);
    }
  Draw draw(31);
  for (int i = 0; i < 150; ++i) {
    const double distance = draw(-0.6, 0.6), thickness = draw(-0.06, 0.06);
    EXPECT_NEAR(field->clearance_mm(distance, thickness), hand.clearance(distance, thickness),
                1e-12)
        << distance << ' ' << thickness;
  }
  EXPECT_GT(hand.halved, 20);
  EXPECT_LT(hand.halved, 280);
}

TEST(ClearanceField, OfFlanksAloneIsSoNearAPlaneThatNoCellIsHalved) {
  GearboxDesign design = pair_design(31, 52, false, 0.02);
  design.rack.addendum = 0.7;
  const GearTrain train = laid_out(design);
  const GearPair pair = train.pair(train.meshes[0]);
  const GearSpread spread1{.thickness_mm = 0.02, .eccentricity_mm = 0.003},
      spread2{.thickness_mm = 0.015};
  auto field = ClearanceField::make(train, train.meshes[0], spread1, spread2, 0.007);
  ASSERT_TRUE(field);
  FieldByHand hand(pair, 0.01, 0.02, 0.015);
  Draw draw(32);
  int jam = 0;
  for (int i = 0; i < 150; ++i) {
    const double distance = draw(-0.01, 0.01), thickness = draw(-0.035, 0.035);
    const double told = field->clearance_mm(distance, thickness);
    EXPECT_NEAR(told, hand.clearance(distance, thickness), 1e-12) << distance << ' ' << thickness;
    jam += told < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(hand.halved, 0);
  EXPECT_GT(jam, 10);
  EXPECT_LT(jam, 140);
}

TEST(ClearanceField, ThatReachesWhereTeethNoLongerMeshSaysSo) {
  const GearTrain train = laid_out(pair_design(13, 19, false, 0.05));
  const auto field = ClearanceField::make(train, train.meshes[0], {}, {}, 2.0);
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().message.substr(0, 22), "at centre distance 14 ") << field.error().message;
  EXPECT_NE(field.error().message.find("the teeth no longer mesh"), std::string::npos);
}

TEST(ClearanceField, WithoutWidthIsOnePlace) {
  const GearTrain train = laid_out(pair_design(13, 19, false, 0.05));
  const GearPair pair = train.pair(train.meshes[0]);
  auto point = ClearanceField::make(train, train.meshes[0], {}, {}, 0.0);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->clearance_mm(0.0, 0.0), sweep_clearance_mm(pair));
  EXPECT_EQ(point->clearance_mm(0.3, -0.2), sweep_clearance_mm(pair));
  // of one width alone: half way between the places turned
  auto line = ClearanceField::make(train, train.meshes[0], {}, {}, 0.02);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->clearance_mm(0.01, 0.0),
              0.5 * (line->at(1, 1).clearance_mm + line->at(2, 1).clearance_mm), 1e-12);
  EXPECT_GT(line->at(2, 0).clearance_mm, line->at(1, 2).clearance_mm + 1e-3);
}

TEST(ClearanceField, OfModifiedTeethIsThatOfTheirSections) {
  GearboxDesign design = pair_design(23, 37, false, 0.05);
  gear(design, "wheel").modifications.crowning_um = 20.0;
  gear(design, "pinion").modifications.profile_slope_um = 12.0;
  const GearTrain train = laid_out(design);
  const TrainMesh& mesh = train.meshes[0];
  auto field =
      ClearanceField::make(train, mesh, {.thickness_mm = 0.01}, {.thickness_mm = 0.02}, 0.03);
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->at(1, 1).clearance_mm, modified_clearance_mm(train, mesh), 1e-9);
  EXPECT_NEAR(field->at(1, 1).backlash_mm, modified_mesh(train, mesh).backlash_mm, 1e-9);
  // what thicker teeth take is what the distance gives: along the normal of the flanks both gears'
  // halves
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(mesh)));
  EXPECT_NEAR(field->at(1, 1).clearance_mm - field->at(1, 2).clearance_mm, 0.5 * 0.03 * cosine,
              2e-4);
  EXPECT_GT(field->at(2, 1).clearance_mm, field->at(1, 1).clearance_mm + 5e-3);
}

TEST(OverlapFigures, TheTipThatGoesTooDeepIsTheOneToShorten) {
  for (const bool ring : {false, true})
    for (const char* name : {"pinion", "wheel"}) {
      GearboxDesign design = pair_design(25, ring ? 60 : 40, ring, 0.3);
      const GearTrain before = laid_out(design);
      const bool first = std::string(name) == "pinion";
      const double standard = before.gears[first ? 0 : 1].profile.tip_radius_mm();
      gear(design, name).tip_diameter_mm = 2.0 * standard + (ring && !first ? -0.9 : 0.9);
      const Finding overlap = only(check_gearbox(laid_out(design)), "overlap");
      ASSERT_EQ(overlap.status, CheckStatus::kFail) << ring << name;
      EXPECT_EQ(overlap.cure.find(std::string("tip diameter of ") + name), 0u) << overlap.cure;
      EXPECT_NE(overlap.message.find(std::string("tip corner of ") + name), std::string::npos)
          << overlap.message;
    }
}

TEST(OverlapFigures, AShorterTipAlsoMakesUpForWhatModificationsCost) {
  GearboxDesign design = pair_design(25, 40, false, 0.3);
  const double standard = laid_out(design).gears[1].profile.tip_radius_mm();
  gear(design, "wheel").tip_diameter_mm = 2.0 * standard + 0.9;
  const auto cured_um = [&] {
    const Finding overlap = only(check_gearbox(laid_out(design)), "overlap");
    EXPECT_EQ(overlap.status, CheckStatus::kFail);
    GearboxDesign cured = design;
    gear(cured, "wheel").tip_diameter_mm = told(overlap.cure, "tip diameter of wheel ");
    const Finding after = only(check_gearbox(laid_out(cured)), "overlap");
    EXPECT_EQ(after.status, CheckStatus::kPass) << overlap.cure << '\n' << after.message;
    return after.value;
  };
  EXPECT_LT(cured_um(), 1.0);
  gear(design, "pinion").modifications.profile_slope_um = 60.0;
  EXPECT_LT(cured_um(), 60.0);
  gear(design, "pinion").modifications.profile_slope_um = 0.0;
  gear(design, "wheel").modifications.profile_slope_um = 60.0;  // of the tip that is in the way
  EXPECT_LT(cured_um(), 60.0);
}

TEST(CornerContactFigures, OnlyWhereItWarnsDoFlanksStillCarry) {
  int warned = 0, failed = 0;
  for (double tip = 29.0; tip < 31.0; tip += 0.04) {  // of an internal pair that is in its own way
    GearboxDesign design = pair_design(25, 31, true, 0.05);
    design.gears[0].shift = design.gears[1].shift = 0.0;
    gear(design, "wheel").tip_diameter_mm = tip;
    const auto train = lay_out(design);
    if (!train) continue;
    const Finding f = only(check_gearbox(*train), "corner_contact");
    EXPECT_EQ(f.message.find("still carry") != std::string::npos, f.status == CheckStatus::kWarn)
        << tip << ": " << f.message;
    warned += f.status == CheckStatus::kWarn;
    failed += f.status == CheckStatus::kFail;
  }
  EXPECT_GT(warned, 0);
  EXPECT_GT(failed, 0);
}

TEST(ContactJudge, TheTipOfModifiedTeethThatIsInTheWayIsThatOfThePlaceThatDecides) {
  int centred_alone = 0, driving_alone = 0;
  for (unsigned seed = 1; seed < 60 && (centred_alone == 0 || driving_alone == 0); ++seed) {
    std::optional<GearTrain> train;
    try {
      train = random_modified_pair(seed);
    } catch (const std::exception&) {
      continue;
    }
    const TrainMesh& mesh = train->meshes[0];
    const GearPair pair = train->pair(mesh);
    const MeshState state = modified_state(*train, mesh);
    const auto of_gear1 = [&](const MeshPlace& place) {
      return std::abs(place.radius1_mm - pair.profile1->tip_radius_mm()) <
             std::abs(place.radius2_mm - pair.profile2->tip_radius_mm());
    };
    if (of_gear1(state.centred.place) == of_gear1(state.driving.place)) continue;
    ContactJudge judge;
    const bool overlap = state.centred.clearance_mm < -tolerance::kTouch_mm;
    EXPECT_EQ(judge.clearances(*train, mesh).tip_of_gear1,
              of_gear1(overlap ? state.centred.place : state.driving.place))
        << seed;
    ++(overlap ? centred_alone : driving_alone);
  }
  EXPECT_GT(centred_alone, 0);
  EXPECT_GT(driving_alone, 0);
}

TEST(MeshSection, IsThatOfTheGearsWhereTheyStand) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "pinion").modifications.helix_slope_um = 15.0;
  gear(design, "wheel").modifications.helix_slope_um = -25.0;
  const GearTrain train = laid_out(design);
  GearTrain raised = train;
  raised.gears[0].z_lower_mm += 3.0;
  raised.gears[1].z_lower_mm += 3.0;
  const auto sections = decisive_sections(train, train.meshes[0]);
  const auto higher = decisive_sections(raised, train.meshes[0]);
  ASSERT_EQ(sections.size(), higher.size());
  ASSERT_GT(sections.size(), 1u);
  const auto flank_at = [](const ToothProfile& profile) {
    for (const ProfilePiece& piece : profile.pieces())
      if (piece.kind == PieceKind::kInvolute)
        return point_at(piece.curve, 0.5 * (piece.curve.begin + piece.curve.end));
    return Point2(0.0, 0.0);
  };
  for (std::size_t i = 0; i < sections.size(); ++i) {
    EXPECT_NEAR(higher[i].z_mm, sections[i].z_mm + 3.0, 1e-12);
    EXPECT_LT((flank_at(higher[i].profile1) - flank_at(sections[i].profile1)).norm(), 1e-12);
    EXPECT_LT((flank_at(higher[i].profile2) - flank_at(sections[i].profile2)).norm(), 1e-12);
    if (i > 0) {
      EXPECT_GT((flank_at(sections[i].profile2) - flank_at(sections[0].profile2)).norm(), 1e-3);
    }
  }
}

TEST(DecisiveSections, OfEqualHeightsAreTheFirst) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "wheel").modifications.crowning_um = -20.0;  // hollow: both ends stand out alike
  const GearTrain train = laid_out(design);
  const auto sections = decisive_sections(train, train.meshes[0]);
  ASSERT_EQ(sections.size(), 1u);
  EXPECT_EQ(sections[0].z_mm, 0.0);
}

}  // namespace
}  // namespace trueflank::test
