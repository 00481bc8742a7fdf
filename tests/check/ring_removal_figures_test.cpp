// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a pinion leaves its ring at a rotation, against whole polygons of both: every vertex of
// the ring, every edge of the pinion, all the way, nothing sorted and nothing mirrored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/check/check_designs.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/ring_criteria.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank::test {
namespace {

/// Turned about the origin, then moved along x.
std::vector<Point2> placed(const std::vector<Point2>& points, double turn_rad, double x_mm) {
  std::vector<Point2> moved;
  moved.reserve(points.size());
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  for (const Point2& p : points)
    moved.emplace_back(c * p.x() - s * p.y() + x_mm, s * p.x() + c * p.y());
  return moved;
}

/// Whether the pinion cannot move by `travel_mm` in -x for a ring whose outline stands `off_mm` in
/// its space.
bool held(const std::vector<Point2>& pinion, const std::vector<Point2>& ring, double travel_mm,
          double off_mm) {
  double radius_mm = 0.0;
  for (const Point2& p : pinion) radius_mm = std::max(radius_mm, p.norm());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i].norm() > radius_mm + travel_mm + 1.0) continue;  // never met
    const Point2 along = ring[(i + 1) % ring.size()] - ring[i];
    if (along.norm() == 0.0) continue;
    const Point2 at = ring[i] + Point2(-along.y(), along.x()) * (off_mm / along.norm());
    for (std::size_t k = 0; k < pinion.size(); ++k) {
      const Point2 &a = pinion[k], &b = pinion[(k + 1) % pinion.size()];
      if (!(a.y() > at.y() && b.y() <= at.y())) continue;  // material begins in +x of it
      const double ahead_mm = a.x() + (b.x() - a.x()) * (at.y() - a.y()) / (b.y() - a.y()) - at.x();
      if (ahead_mm > 0.0 && ahead_mm < travel_mm) return true;
    }
  }
  return false;
}

struct Removals {
  int kept = 0, left = 0, close = 0;
};

/// From `first` on every `step`-th of the 64 rotations; those that hang on half of what is not seen
/// are counted as close.
void compare(const GearPair& pair, int first, int step, Removals& counted) {
  const RadialRemoval removal = radial_removal(pair);
  const double m = pair.gear1().normal_module_mm;
  const SectionPolygon pinion = section_polygon(*pair.profile1, 4e-4 * m);
  const SectionPolygon ring = section_polygon(*pair.profile2, 4e-4 * m);
  const double travel =
      pair.centre_distance_mm - (pair.profile2->tip_radius_mm() - pair.profile1->tip_radius_mm());
  const int z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  int free = 0;
  for (int i = 0; i < 64; ++i) free += removal.free_at.at(static_cast<std::size_t>(i)) ? 1 : 0;
  EXPECT_EQ(removal.free_share, free / 64.0);
  EXPECT_EQ(removal.at_every_rotation, free == 64);
  EXPECT_EQ(removal.at_some_rotation, free > 0);
  for (int i = first; i < 64; i += step) {
    const double turn = kTwoPi / z1 * i / 64.0;
    const auto points1 = placed(pinion.points, turn, 0.0);
    const auto points2 = placed(ring.points, turn * z1 / z2 + kPi / z2, -pair.centre_distance_mm);
    // 1e-3 is not seen; these polygons and those of the criterion are up to 1.2e-3 apart
    const bool less = held(points1, points2, travel, 2.3e-3 * m);
    if (less != held(points1, points2, travel, -0.3e-3 * m)) {
      ++counted.close;
      continue;
    }
    ++(less ? counted.kept : counted.left);
    EXPECT_EQ(removal.free_at[static_cast<std::size_t>(i)], !less) << i;
  }
}

TEST(RadialRemovalFigures, AreThoseOfWholePolygonsMovedOut) {
  Removals counted;
  for (int seed = 0; seed < 14; ++seed) {
    std::mt19937 engine(static_cast<unsigned>(seed));
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(engine);
    };
    const int z1 = 11 + seed;
    GearboxDesign design = pair_design(z1, z1 + 9 + seed % 7, true, real(0.02, 0.3));
    design.module_mm = seed % 2 == 0 ? 1.0 : 2.5;
    gear(design, "pinion").modifications.tip_rounding_mm = seed % 3 == 0 ? 0.08 : 0.0;
    const auto train = lay_out(design);
    ASSERT_TRUE(train) << seed << " " << train.error().front().message;
    compare(train->pair(train->meshes[0]), seed % 5, 5, counted);
  }
  EXPECT_GE(counted.kept, 40);
  EXPECT_GE(counted.left, 40);
  EXPECT_LE(counted.close, 20);
}

// Flanks that all but touch over many teeth: where the walls stand counts, and how far from the
// line of centres.
TEST(RadialRemovalFigures, OfTightTeethAndManyAreThoseOfWholePolygonsToo) {
  Removals counted;
  for (int seed = 0; seed < 8; ++seed) {
    const int z1 = 20 + 6 * seed;
    const GearTrain train = laid_out(pair_design(z1, z1 + 10 + 2 * seed, true, 0.012));
    compare(train.pair(train.meshes[0]), seed, 13, counted);
  }
  EXPECT_GE(counted.kept, 10);
  EXPECT_GE(counted.left, 10);
  EXPECT_LE(counted.close, 10);
}

// The lower half is no mirror image of the upper one then.
TEST(RadialRemovalFigures, OfTeethWhoseFlanksDifferAreThoseOfWholePolygonsToo) {
  Removals counted;
  for (int seed = 0; seed < 10; ++seed) {
    const int z1 = 13 + 2 * seed;
    GearboxDesign design = pair_design(z1, z1 + 12 + seed % 6, true, 0.3);
    gear(design, seed % 2 == 0 ? "pinion" : "wheel").modifications.helix_slope_um =
        seed % 3 == 0 ? -80.0 : 80.0;
    const GearTrain train = laid_out(design);
    const PairSection section = mesh_section(train, train.meshes[0], seed % 4 < 2 ? 0.5 : 9.5);
    ASSERT_FALSE(section.pair().profile1->symmetric() && section.pair().profile2->symmetric());
    compare(section.pair(), seed % 7, 7, counted);
  }
  EXPECT_GE(counted.kept, 15);
  EXPECT_GE(counted.left, 15);
  EXPECT_LE(counted.close, 20);
}

TEST(RadialRemovalFigures, SectionsOfAFaceLeaveTogetherAndOverTheirTwist) {
  const GearTrain one = laid_out(pair_design(20, 34, true, 0.1));
  const GearTrain two = laid_out(pair_design(20, 34, true, 0.4));
  const GearPair tight = one.pair(one.meshes[0]), loose = two.pair(two.meshes[0]);
  const RadialRemoval first = radial_removal(tight), second = radial_removal(loose);
  ASSERT_NE(first.free_at, second.free_at);
  for (const int steps : {0, 1, 7, 40}) {
    // a little less than whole steps of a 64th of a pitch, either way round
    const double twist = (steps == 0 ? 0.0 : steps - 0.3) * kTwoPi / 20.0 / 64.0;
    for (const double sign : {1.0, -1.0}) {
      const RadialRemoval both = radial_removal({tight, loose}, sign * twist);
      for (std::size_t i = 0; i < 64; ++i) {
        bool leaves = true;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(steps); ++k)
          leaves = leaves && first.free_at[(i + k) % 64] && second.free_at[(i + k) % 64];
        EXPECT_EQ(both.free_at[i], leaves) << steps << " at " << i;
      }
    }
  }
}

/// Of one half of a tooth: where its corner is, and points all along a rounding.
std::vector<Point2> points_of_tip(const ToothProfile& profile) {
  const ProfilePiece& land = profile.pieces().front();
  std::vector<Point2> points{point_at(land.curve, land.curve.end)};
  for (const ProfilePiece& piece : profile.pieces())
    for (int i = 0; piece.kind == PieceKind::kTipRounding && i <= 80; ++i)
      points.push_back(point_at(
          piece.curve, piece.curve.begin + (piece.curve.end - piece.curve.begin) * (i / 80.0)));
  return points;
}

// How far the ring's point lags where the pinion's is at a place: at the crossing of both circles,
// and where that is least of all places at which both stand at the same height over the line of
// centres.
TEST(RingCriteriaFigures, OfRoundedTipsAreTheWorstOfAllPointsOfTheRoundings) {
  for (int seed = 0; seed < 6; ++seed) {
    GearboxDesign design = pair_design(28 + seed, 37 + 2 * seed, true, 0.1);
    gear(design, "pinion").modifications.tip_rounding_mm = seed % 3 == 2 ? 0.0 : 0.1 + 0.02 * seed;
    gear(design, "wheel").modifications.tip_rounding_mm = seed % 3 == 1 ? 0.0 : 0.15;
    const GearTrain train = laid_out(design);
    const GearPair pair = train.pair(train.meshes[0]);
    const double a = pair.centre_distance_mm, z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
    double crossing = 1e300, passing = 1e300;
    for (const Point2& tip1 : points_of_tip(*pair.profile1))
      for (const Point2& tip2 : points_of_tip(*pair.profile2)) {
        const double r1 = tip1.norm(), r2 = tip2.norm();
        const auto lag = [&](double phi1, double phi2) {
          return z1 / z2 * (phi1 - std::atan2(tip1.y(), tip1.x())) + kPi / z2 -
                 std::atan2(tip2.y(), tip2.x()) - phi2;
        };
        const double x = (r2 * r2 - r1 * r1 - a * a) / (2.0 * a), y = std::sqrt(r1 * r1 - x * x);
        crossing = std::min(crossing, lag(std::atan2(y, x), std::atan2(y, x + a)));
        for (int i = 0; i <= 160; ++i) {
          const double phi1 = 0.5 * kPi * i / 160.0;
          passing = std::min(passing, lag(phi1, std::asin(r1 / r2 * std::sin(phi1))));
        }
      }
    // the sixteen places of a rounding miss its worst point by s^2 / 8 rho = 0.15 um
    EXPECT_NEAR(trochoid_margin_rad(pair), crossing, 1e-5) << seed;
    EXPECT_NEAR(trimming_margin_rad(pair), passing, 1e-5) << seed;
  }
}

TEST(RadialRemovalFigures, APinionWiderThanTheRingNeverLeaves) {
  GearboxDesign design = pair_design(30, 31, true, 0.1);
  const auto train = lay_out(design);
  ASSERT_TRUE(train) << train.error().front().message;
  const RadialRemoval removal = radial_removal(train->pair(train->meshes[0]));
  EXPECT_TRUE(removal.free_at.empty());
  EXPECT_EQ(removal.free_share, 0.0);
  EXPECT_FALSE(removal.at_some_rotation);
}

}  // namespace
}  // namespace trueflank::test
