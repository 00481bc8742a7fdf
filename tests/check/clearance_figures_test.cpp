// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "tests/check/recorded_clearances.h"
#include "tests/support/draw.h"
#include "tests/support/recorded.h"
#include "tests/support/sample_gears.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/clearance_field.h"
#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/clearance/tooth_crossing.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/geometry/polyline.h"

// What small clearances are made of, by formulas and by turning the teeth.
namespace trueflank::test {
namespace {

TEST(GearDistanceFigures, APointNearTheOneBeforeIsMeasuredToTheSameDigits) {
  std::mt19937_64 random(20261123);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  int elsewhere = 0;  // on another piece than the point before
  for (const SampleGear& gear : sample_gears()) {
    const auto profile = ToothProfile::make(gear.gear);
    ASSERT_TRUE(profile);
    const GearDistance distance(*profile);
    const double tip = profile->tip_radius_mm(), root = profile->root_radius_mm();
    GearDistance::Before before;
    Point2 point = Point2::Zero(), stride = Point2::Zero();
    int piece = -1;
    for (int i = 0; i < 2400; ++i) {
      // straight on for a while, as along a path; then anywhere
      if (i % 16 == 0) {
        point = between(std::min(tip, root), std::max(tip, root)) * unit_vector(between(0.0, kTwoPi));
        stride = std::exp(between(std::log(1e-3), std::log(0.1))) * unit_vector(between(0.0, kTwoPi));
      }
      point += stride;
      const auto known = distance.nearest(point, before), alone = distance.nearest(point);
      ASSERT_EQ(known.distance_mm, alone.distance_mm) << gear.name << " " << point.transpose();
      ASSERT_EQ(known.piece, alone.piece);
      ASSERT_EQ(known.corner, alone.corner);
      ASSERT_EQ(known.clockwise_half, alone.clockwise_half);
      ASSERT_EQ(known.point, alone.point);
      if (known.piece != piece) ++elsewhere;
      piece = known.piece;
    }
  }
  EXPECT_GT(elsewhere, 1000);
}

TEST(ModifiedClearanceFigures, ACrownedWheelBesideAPlainPinionIsNearestInTheMiddle) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "wheel").modifications.crowning_um = 20.0;
  const GearTrain train = laid_out(design);
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  const MeshState state = mesh_states(train)[0];
  EXPECT_NEAR(state.centred.clearance_mm, 0.05 * cosine, 1e-6);
  EXPECT_NEAR(state.centred.z_mm, 5.0, 1e-9);
}

TEST(OverlapFigures, TeethThatModificationsMakePenetrateAskForTheBacklashTheyLack) {
  GearboxDesign design = pair_design(23, 37, false, 0.0);
  gear(design, "pinion").modifications.profile_slope_um = 20.0;
  const GearTrain train = laid_out(design);
  const Finding overlap = only(check_gearbox(train), "overlap");
  ASSERT_EQ(overlap.status, CheckStatus::kFail);
  EXPECT_LT(overlap.value, -5.0);
  const std::string start =
      "without their modifications these teeth clear each other: smaller slopes, or backlash_mm "
      "larger by ";
  ASSERT_EQ(overlap.cure.substr(0, start.size()), start);
  const double larger_mm = std::stod(overlap.cure.substr(start.size()));
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  EXPECT_NEAR(larger_mm, -2e-3 * overlap.value / cosine, 1e-5);
  design.backlash_mm = larger_mm + 1e-5;
  EXPECT_NE(only(check_gearbox(laid_out(design)), "overlap").status, CheckStatus::kFail);
}

TEST(OverlapFigures, SayWhetherThereIsClearanceOrTheFlanksTouch) {
  const auto message = [](double backlash_mm) {
    const Finding overlap =
        only(check_gearbox(laid_out(pair_design(25, 40, false, backlash_mm))), "overlap");
    EXPECT_EQ(overlap.status, CheckStatus::kPass);
    return overlap.message;
  };
  EXPECT_EQ(message(0.1).find("smallest clearance 46.98"), 0u)
      << message(0.1);  // 50 cos 20 degrees
  EXPECT_EQ(message(0.0).find("the flanks touch over a mesh cycle"), 0u) << message(0.0);
}

TEST(OverlapFigures, AClearanceThatIsAskedForTakesSoMuchMoreBacklash) {
  for (const double helix : {0.0, 0.4}) {
    GearboxDesign design = pair_design(25, 40, false, 0.1);
    design.helix_angle_rad = helix;
    design.made.clearance_mm = 0.08;
    const Finding overlap = only(check_gearbox(laid_out(design)), "overlap");
    ASSERT_EQ(overlap.status, CheckStatus::kFail);
    EXPECT_NEAR(overlap.margin, overlap.value - 80.0, 1e-9);
    const std::string start = "backlash_mm larger by at least ";
    ASSERT_EQ(overlap.cure.substr(0, start.size()), start);
    design.backlash_mm += std::stod(overlap.cure.substr(start.size()));
    const double value = only(check_gearbox(laid_out(design)), "overlap").value;
    EXPECT_GE(value, 80.0);
    // seen in the section; along the normal of helical flanks the backlash parts them by less
    EXPECT_LE(value, helix == 0.0 ? 80.1 : 80.0 + 33.1 * (1.0 / 0.93 - 1.0) + 0.1);
  }
}

TEST(OverlapFigures, AxesThatStandTooNearAskForThinnerTeeth) {
  GearboxDesign design = pair_design(25, 40, false, 0.0);
  design.gears[0].shift = design.gears[1].shift = 0.0;
  design.centre_distance_mm = 32.47;  // 30 um too near
  const Finding overlap = only(check_gearbox(laid_out(design)), "overlap");
  ASSERT_EQ(overlap.status, CheckStatus::kFail);
  const std::string start = "teeth thinned by ";
  ASSERT_EQ(overlap.cure.substr(0, start.size()), start) << overlap.cure;
  EXPECT_NEAR(std::stod(overlap.cure.substr(start.size())), 60.0 * std::tan(rad_from_deg(20.0)),
              0.1);
}

/// The clearance of a mesh with both gears thicker by so much and the axes farther apart.
double turned_clearance_mm(const GearTrain& train, const TrainMesh& mesh, double distance_mm,
                           double thickness_mm) {
  const GearPair pair = train.pair(mesh);
  Gear gear1 = pair.gear1(), gear2 = pair.gear2();
  gear1.thinning_mm -= thickness_mm;
  gear2.thinning_mm -= thickness_mm;
  const auto profile1 = ToothProfile::make(gear1), profile2 = ToothProfile::make(gear2);
  return sweep_clearance_mm({&*profile1, &*profile2, pair.centre_distance_mm + distance_mm});
}

TEST(ClearanceField, OfDistanceAndThicknessIsThatOfTheTurnedTeethWhereSetsBeginToJam) {
  const GearTrain train = laid_out(paper_design(0.05));
  constexpr double kWidth_mm = 0.15, kThickness_mm = 0.03;
  const GearSpread spread{.thickness_mm = kThickness_mm};
  double worst_um = 0.0, worst_far_um = 0.0;
  int near = 0;
  for (const TrainMesh& mesh : train.meshes) {
    auto field = ClearanceField::make(train, mesh, spread, spread, kWidth_mm);
    ASSERT_TRUE(field);
    for (const double v : {-0.65, 0.35, 0.85})
      for (int i = -10; i <= 10; ++i) {
        const double off_mm = kWidth_mm * i / 10.0;
        const double turned_um = 1e3 * turned_clearance_mm(train, mesh, off_mm, v * kThickness_mm);
        const double told_um = 1e3 * field->clearance_mm(off_mm, 2.0 * v * kThickness_mm);
        worst_far_um = std::max(worst_far_um, std::abs(told_um - turned_um));
        if (std::abs(turned_um) > 5.0) continue;
        ++near;
        worst_um = std::max(worst_um, std::abs(told_um - turned_um));
      }
  }
  EXPECT_GT(near, 5);
  EXPECT_LT(worst_um, 0.4);
  EXPECT_LT(worst_far_um, 2.0);  // between sections that are not halved
}

/// Distance of a point from a polygon, negative inside it.
double distance_of_polygon(const std::vector<Point2>& points, const Point2& p) {
  double least = 1e300;
  bool inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 &a = points[i], &b = points[(i + 1) % points.size()];
    const Point2 along = b - a;
    const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - share * along).norm());
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * along.x())
      inside = !inside;
  }
  return inside ? -least : least;
}

TEST(GearDistance, IsThatOfTheFinePolygonNearTheTeeth) {
  constexpr double kTolerance_mm = 1e-5;
  for (const SampleGear& sample : sample_gears()) {
    SCOPED_TRACE(sample.name);
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    if (profile->gear().teeth > 60) continue;  // the same curves on more teeth
    const GearDistance gear(*profile);
    const SectionPolygon polygon = section_polygon(*profile, kTolerance_mm);
    const double low = std::min(profile->root_radius_mm(), profile->tip_radius_mm()),
                 high = std::max(profile->root_radius_mm(), profile->tip_radius_mm());
    const double sense = profile->gear().kind == GearKind::kInternal ? -1.0 : 1.0;
    Draw share(5);
    for (int i = 0; i < 60; ++i) {
      const double radius = std::lerp(low - 0.2 * (high - low), high + 0.2 * (high - low), share());
      const Point2 p = radius * unit_vector((i % 4 == 0 ? kTwoPi : 0.4) * share());
      const auto nearest = gear.nearest(p);
      EXPECT_NEAR(nearest.distance_mm, sense * distance_of_polygon(polygon.points, p),
                  2.0 * kTolerance_mm)
          << p.transpose();
      const double beside =
          std::remainder(std::atan2(p.y(), p.x()), kTwoPi / profile->gear().teeth);
      EXPECT_EQ(nearest.clockwise_half, beside < 0.0);
      EXPECT_NEAR(nearest.point.norm(), p.norm(), std::abs(nearest.distance_mm) + 1e-9);
    }
  }
}

TEST(GearDistance, IsThatOfTheFinePolygonAroundEveryEndOfAPiece) {
  constexpr double kTolerance_mm = 1e-5;
  for (const SampleGear& sample : sample_gears()) {
    SCOPED_TRACE(sample.name);
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    if (profile->gear().teeth > 40) continue;
    const GearDistance gear(*profile);
    const SectionPolygon polygon = section_polygon(*profile, kTolerance_mm);
    const double sense = profile->gear().kind == GearKind::kInternal ? -1.0 : 1.0;
    for (const ProfilePiece& piece : profile->pieces())
      for (int i = 0; i < 8; ++i) {
        const Point2 p = piece.curve.start_point() + (i % 2 == 0 ? 0.003 : 0.02) * unit_vector(0.1 + kTwoPi * i / 8.0);
        EXPECT_NEAR(gear.nearest(p).distance_mm, sense * distance_of_polygon(polygon.points, p), 2.0 * kTolerance_mm)
            << p.transpose();
      }
  }
}

TEST(GearDistance, KeepsASplineForItsOwnErrorAndItsOwnEndsAlone) {
  const GearTrain train = laid_out(pair_design(19, 37, false, 0.1));
  const ToothProfile& profile = train.gears[0].profile;
  std::size_t fillet = 0;
  while (profile.pieces()[fillet].kind != PieceKind::kFillet) ++fillet;
  const Curve curve = profile.pieces()[fillet].curve;
  const auto at = [&](double share) { return point_at(curve, std::lerp(curve.begin, curve.end, share)); };
  const GearDistance rough(profile, 1e-2), exact(profile);
  double worst = 0.0;
  for (int i = 1; i < 20; ++i) worst = std::max(worst, std::abs(rough.nearest(at(i / 20.0)).distance_mm));
  EXPECT_GT(worst, 1e-7);
  for (int i = 1; i < 20; ++i) EXPECT_NEAR(exact.nearest(at(i / 20.0)).distance_mm, 0.0, 2e-9);
  for (const bool first_half : {false, true}) {
    std::vector<ProfilePiece> pieces = profile.pieces();
    (first_half ? pieces[fillet].curve.end : pieces[fillet].curve.begin) = 0.5 * (curve.begin + curve.end);
    const GearDistance half(profile.with_pieces(pieces, {}));
    EXPECT_LT(std::abs(half.nearest(at(first_half ? 0.4 : 0.6)).distance_mm), 2e-9);
    EXPECT_GT(std::abs(half.nearest(at(first_half ? 0.7 : 0.3)).distance_mm), 1e-3);
  }
}

TEST(GearDistance, OfAFlankInManyPiecesIsThatOfTheWholeFlank) {
  for (const bool ring : {false, true}) {
    const GearTrain train = laid_out(pair_design(19, 47, ring, 0.1));
    const ToothProfile& profile = train.gears[ring ? 1 : 0].profile;
    std::vector<ProfilePiece> parts;
    for (const ProfilePiece& piece : profile.pieces()) {
      const int n = piece.kind == PieceKind::kInvolute ? 9 : 1;
      for (int i = 0; i < n; ++i) {
        ProfilePiece part = piece;
        part.curve.begin =
            std::lerp(piece.curve.begin, piece.curve.end, static_cast<double>(i) / n);
        part.curve.end = std::lerp(piece.curve.begin, piece.curve.end, (i + 1.0) / n);
        parts.push_back(part);
      }
    }
    const ToothProfile divided = profile.with_pieces(parts);
    const GearDistance whole(profile), of_parts(divided);
    const double tip = profile.tip_radius_mm(), root = profile.root_radius_mm();
    Draw draw(17);
    GearDistance::Before before;
    for (int i = 0; i < 400; ++i) {
      const Point2 p =
          draw(std::min(tip, root) - 0.3, std::max(tip, root) + 0.3) * unit_vector(draw(-0.5, 0.5));
      EXPECT_NEAR(of_parts.nearest(p).distance_mm, whole.nearest(p).distance_mm, 1e-9)
          << p.transpose();
      EXPECT_NEAR(of_parts.nearest(p, before).distance_mm, whole.nearest(p).distance_mm, 1e-9)
          << p.transpose();
    }
  }
}

TEST(GearDistance, OfTeethWhoseHalvesDifferIsThatOfBothHalves) {
  GearboxDesign design = pair_design(19, 37, false, 0.1);
  gear(design, "pinion").modifications.helix_slope_um = 60.0;
  const GearTrain train = laid_out(design);
  const PairSection section = mesh_section(train, train.meshes[0], 0.0);
  const ToothProfile& profile = section.profile1;
  ASSERT_NE(&profile.clockwise_pieces(), &profile.pieces());
  const GearDistance gear_distance(profile);
  Draw share(6);
  int clockwise = 0;
  for (int i = 0; i < 40; ++i) {
    const Point2 p =
        std::lerp(profile.root_radius_mm() - 0.3, profile.tip_radius_mm() + 0.5, share()) *
        unit_vector(kTwoPi * share());
    double least = 1e300;
    bool on_clockwise = false;
    for (int tooth = 0; tooth < 19; ++tooth) {
      const Point2 turned = rotated(p, -kTwoPi * tooth / 19.0);
      if (turned.x() < 0.9 * turned.norm()) continue;
      for (const bool mirror : {false, true})
        for (const ProfilePiece& piece : mirror ? profile.clockwise_pieces() : profile.pieces())
          for (int k = 0; k <= 1500; ++k) {
            const Point2 at =
                point_at(piece.curve, std::lerp(piece.curve.begin, piece.curve.end, k / 1500.0));
            const double away = (turned - Point2(at.x(), mirror ? -at.y() : at.y())).norm();
            if (away < least) least = away, on_clockwise = mirror;
          }
    }
    const auto nearest = gear_distance.nearest(p);
    EXPECT_NEAR(std::abs(nearest.distance_mm), least, 2e-5) << p.transpose();
    if (least > 0.02) {
      EXPECT_EQ(nearest.clockwise_half, on_clockwise) << p.transpose();
    }
    clockwise += on_clockwise ? 1 : 0;
  }
  EXPECT_GT(clockwise, 10);
  EXPECT_LT(clockwise, 30);
  // signed, and beside the rays that part the halves
  constexpr double kTolerance_mm = 1e-5;
  const SectionPolygon polygon = section_polygon(profile, kTolerance_mm);
  for (int i = 0; i < 300; ++i) {
    const double angle = kPi / 19.0 * (i % 7 + (i % 3 == 0 ? share() : 0.06 * (share() - 0.5)));
    const Point2 p =
        std::lerp(profile.root_radius_mm() - 0.5, profile.tip_radius_mm() + 0.5, share()) * unit_vector(angle);
    EXPECT_NEAR(gear_distance.nearest(p).distance_mm, distance_of_polygon(polygon.points, p), 2.0 * kTolerance_mm)
        << p.transpose();
  }
}

TEST(ToothCrossing, IsToldWhereCornersOfOneLieInTheMaterialOfTheOther) {
  Draw between(8);
  int cross = 0, apart = 0;
  for (const bool internal : {false, true}) {
    const GearTrain train = laid_out(pair_design(17, internal ? 45 : 28, internal, 0.2));
    const GearPair pair = train.pair(train.meshes[0]);
    const GearDistance distance1(*pair.profile1), distance2(*pair.profile2);
    const SectionPolygon section1 = section_polygon(*pair.profile1, 2e-3),
                         section2 = section_polygon(*pair.profile2, 2e-3);
    for (int i = 0; i < 60; ++i) {
      // beside the mesh, at every angle about gear 1
      const double direction = between(0.0, kTwoPi), turn1 = between(0.0, kTwoPi);
      const Point2 centre2 = (internal ? -1.0 : 1.0) *
                             (pair.centre_distance_mm + between(0.0, i % 2 == 0 ? 2.4 : 0.4)) *
                             unit_vector(direction);
      const double turn2 = i % 3 == 0 ? between(0.0, kTwoPi) : turn1 + between(-0.2, 0.2);
      double least = 1e300;
      for (const Point2& p : section1.points)
        least = std::min(
            least, distance2.nearest(rotated(rotated(p, turn1) - centre2, -turn2)).distance_mm);
      for (const Point2& p : section2.points)
        least = std::min(
            least, distance1.nearest(rotated(rotated(p, turn2) + centre2, -turn1)).distance_mm);
      if (std::abs(least) < 5e-3) continue;
      const ToothCrossing found = teeth_cross(pair, turn1, turn2, centre2, 2e-5);
      EXPECT_EQ(found.cross, least < 0.0) << internal << ' ' << i << ": " << least;
      EXPECT_LE(found.chord_error_mm, 4e-5);
      ++(least < 0.0 ? cross : apart);
    }
  }
  EXPECT_GT(cross, 15);
  EXPECT_GT(apart, 15);
}

TEST(ExactVerdict, ChordsAreAnEighthOfTheClearanceWithinBoundsOfTheModule) {
  for (const double module_mm : {1.0, 3.0}) {
    GearboxDesign design = pair_design(17, 28, false, 0.2 * module_mm);
    design.module_mm = module_mm;
    const GearTrain train = laid_out(design);
    const auto chord_error_mm = [&](double modules) {
      MeshClearance result;
      result.clearance_mm = modules * module_mm;
      add_exact_verdict(train.pair(train.meshes[0]), result);
      return result.chord_error_mm / module_mm;
    };
    // of both polygons together
    EXPECT_LE(chord_error_mm(0.0), 2.0 * 2e-5);
    EXPECT_GE(chord_error_mm(0.0), 0.2 * 2e-5);
    for (const double clearance : {-0.016, 0.016}) {
      EXPECT_LE(chord_error_mm(clearance), 0.25 * 0.016);
      EXPECT_GE(chord_error_mm(clearance), 0.025 * 0.016);
    }
    EXPECT_LE(chord_error_mm(1.0), 2.0 * 5e-3);
    EXPECT_GE(chord_error_mm(1.0), 0.2 * 5e-3);
  }
}

/// To three digits, without a sign of zero.
std::string figure(double value) {
  if (std::isnan(value)) return "none";
  char text[40];
  std::snprintf(text, sizeof text, "%.3f", std::abs(value) < 5e-4 ? 0.0 : value);
  return text;
}

/// Of the first mesh of a random design: clearances in micrometres. Where they are least hangs on
/// the last digit along flanks that touch.
std::string clearances_of(int seed) {
  const auto train = lay_out(random_design(static_cast<std::uint64_t>(seed)));
  if (!train) return "not laid out";
  const GearPair pair = train->pair(train->meshes[0]);
  return figure(1e3 * mesh_clearance(pair).clearance_mm) + ' ' +
         figure(1e3 * mesh_clearance(pair, 0.002).clearance_mm) + ' ' +
         figure(1e3 * driving_clearance(pair).clearance_mm) + " sweep " +
         figure(1e3 * sweep_clearance_mm(pair));
}

/// The same of teeth with modified flanks, the worst of their heights.
std::string modified_clearances_of(int number) {
  GearboxDesign design =
      pair_design(17 + 3 * number, 31 + 5 * number, number % 3 == 2, 0.02 * (number % 4));
  design.helix_angle_rad = number % 2 == 0 ? 0.0 : 0.3;
  ModificationsDesign& pinion = gear(design, "pinion").modifications;
  pinion.helix_slope_um = 8.0 * (number % 3);
  pinion.profile_slope_um = number % 4 == 1 ? 12.0 : 0.0;
  gear(design, "wheel").modifications.crowning_um = number % 2 == 0 ? 10.0 : 0.0;
  gear(design, "wheel").modifications.profile_crowning_um = number % 3 == 1 ? 7.0 : 0.0;
  const GearTrain train = laid_out(design);
  const MeshState state = modified_state(train, train.meshes[0]);
  std::string heights;
  for (const PairSection& section : decisive_sections(train, train.meshes[0]))
    heights += ' ' + figure(section.z_mm);
  if (number % 3 == 2) {
    const auto free = modified_removal(train, train.meshes[0]).free_at;
    heights += ", free at " + std::to_string(std::count(free.begin(), free.end(), true));
  }
  const auto at = [](const MeshClearance& c) {
    return figure(1e3 * c.clearance_mm) + " at " + figure(c.z_mm);
  };
  return at(state.centred) + ", driving " + at(state.driving) + ", alone " +
         figure(1e3 * modified_clearance_mm(train, train.meshes[0])) + "," + heights;
}

TEST(ClearanceFigures, OfModifiedTeethAreThoseWrittenDown) {
  expect_as_recorded(kRecordedModifiedClearances, modified_clearances_of);
}

TEST(ClearanceFigures, OfRandomMeshesAreThoseWrittenDown) {
  expect_as_recorded(kRecordedClearances, clearances_of);
}

}  // namespace
}  // namespace trueflank::test
