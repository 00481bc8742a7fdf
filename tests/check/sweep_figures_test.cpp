// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "tests/support/draw.h"
#include "tests/support/sample_gears.h"
#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/clearance/tooth_crossing.h"
#include "trueflank/check/clearance/tooth_sweep.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/geometry/polyline.h"

// What the sweep of a tooth asks, where, and what it says of the place, each by its definition.
namespace trueflank::test {
namespace {

/// Parts of a piece that its length and its bend ask for.
int parts_by_hand(const ProfilePiece& piece, double module_mm) {
  const Curve& curve = piece.curve;
  double length = 0.0;
  for (int i = 0; i < 2000; ++i)
    length += (point_at(curve, std::lerp(curve.begin, curve.end, (i + 1) / 2000.0)) -
               point_at(curve, std::lerp(curve.begin, curve.end, i / 2000.0)))
                  .norm();
  const double step = piece.kind == PieceKind::kInvolute ? 0.1 : 0.05;
  const double sag = chord_error_mm(curve, curve.begin, curve.end);
  const double parts = std::max(length / (step * module_mm), std::sqrt(sag / (2e-4 * module_mm)));
  return std::clamp(static_cast<int>(std::ceil(parts)), 2, 400);
}

TEST(SweepSamples, AreTheEndsOfAllPiecesAndEvenPartsOfThem) {
  int fewest = 1000, asked_by_bend = 0;
  for (const SampleGear& sample : sample_gears()) {
    SCOPED_TRACE(sample.name);
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    const std::vector<SweepSample> all = sweep_samples(*profile);
    std::size_t at = 0;
    const auto expect_next = [&](std::size_t piece, double parameter, double low, double high) {
      ASSERT_LT(at, all.size());
      const SweepSample& s = all[at++];
      const Curve& curve = profile->pieces()[piece].curve;
      const double near = 1e-12 * (1.0 + std::abs(curve.begin) + std::abs(curve.end));
      EXPECT_EQ(s.piece, static_cast<int>(piece));
      EXPECT_NEAR(s.parameter, parameter, near);
      EXPECT_NEAR(s.low, low, near);
      EXPECT_NEAR(s.high, high, near);
      EXPECT_EQ(s.point, point_at(curve, s.parameter));
    };
    for (std::size_t k = 0; k < profile->pieces().size(); ++k) {
      const Curve& curve = profile->pieces()[k].curve;
      const int n = parts_by_hand(profile->pieces()[k], profile->gear().normal_module_mm);
      fewest = std::min(fewest, n);
      if (n > 2 && k + 1 == profile->pieces().size()) ++asked_by_bend;
      const auto place = [&](int i) {
        return std::lerp(curve.begin, curve.end, std::clamp(i, 0, n) / static_cast<double>(n));
      };
      expect_next(k, curve.begin, curve.begin, curve.begin);
      for (int i = 0; i <= n; ++i) expect_next(k, place(i), place(i - 1), place(i + 1));
    }
    const std::size_t last = profile->pieces().size() - 1;
    const double end = profile->pieces()[last].curve.end;
    expect_next(last, end, end, end);
    EXPECT_EQ(at, all.size());
  }
  EXPECT_EQ(fewest, 2);
  EXPECT_GT(asked_by_bend, 0);
}

TEST(SweepSamples, OfTipsAreTheirCornersAndWhatStandsInTheirPlace) {
  int rounded = 0, sharp = 0;
  for (const SampleGear& sample : sample_gears()) {
    SCOPED_TRACE(sample.name);
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    const auto& pieces = profile->pieces();
    std::vector<SweepSample> wanted;
    for (const SweepSample& s : sweep_samples(*profile)) {
      const auto piece = static_cast<std::size_t>(s.piece);
      const bool corner = s.low == s.high;
      const bool at_tip = std::abs(s.point.norm() - profile->tip_radius_mm()) < 1e-6;
      const bool begins = s.parameter == pieces[piece].curve.begin;
      const PieceKind kind = pieces[piece].kind;
      const bool in_place = kind == PieceKind::kTipRounding || kind == PieceKind::kTrim;
      if (corner ? at_tip && begins : in_place) wanted.push_back(s);
      (in_place ? rounded : sharp) += 1;
    }
    const std::vector<SweepSample> found = tip_samples(*profile);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].piece, wanted[i].piece);
      EXPECT_EQ(found[i].parameter, wanted[i].parameter);
      EXPECT_EQ(found[i].low, wanted[i].low);
      EXPECT_EQ(found[i].high, wanted[i].high);
    }
  }
  EXPECT_GT(rounded, 0);
  EXPECT_GT(sharp, 0);
}

TEST(SweepGrid, EndsWhereTheToothIsClearAndMovesByAboutATwentiethOfTheModule) {
  for (const bool ring : {false, true})
    for (const bool gear1_moves : {true, false})
      for (const int teeth : {12, 19, 31}) {
        SCOPED_TRACE(std::to_string(ring) + std::to_string(gear1_moves) + ' ' +
                     std::to_string(teeth));
        const GearTrain train = laid_out(pair_design(teeth, ring ? 2 * teeth + 9 : 41, ring, 0.05));
        const GearPair pair = train.pair(train.meshes[0]);
        const ToothProfile& mover = gear1_moves ? *pair.profile1 : *pair.profile2;
        const ToothProfile& mate = gear1_moves ? *pair.profile2 : *pair.profile1;
        const double a = pair.centre_distance_mm, z = mover.gear().teeth,
                     z_mate = mate.gear().teeth;
        const bool mate_is_ring = ring && gear1_moves;
        const SweepGrid grid = sweep_grid(mover, mate, a);
        const Point2 axis(mate_is_ring ? -a : a, 0.0);
        // the tip at the near end of the tooth is as far from the mate's as the margin of 0.3
        // modules
        const double away =
            (mover.tip_radius_mm() * unit_vector(grid.reach_rad - kPi / z) - axis).norm();
        EXPECT_NEAR(away, mate.tip_radius_mm() + (mate_is_ring ? -0.3 : 0.3), 1e-9);
        // a point that moves with the mover, in the frame of the mate
        const double ratio = (ring ? 1.0 : -1.0) * z / z_mate;
        const auto seen = [&](const Point2& p, double angle) {
          return rotated(Point2(rotated(p, angle) - axis), -ratio * angle);
        };
        const double step = 2.0 * grid.reach_rad / grid.steps;
        double most = 0.0, most_turned = 0.0;
        for (const SweepSample& sample : sweep_samples(mover))
          for (int k = -grid.steps; k < grid.steps; k += 3) {
            const double angle = 0.5 * k * step;
            const double moved =
                (seen(sample.point, angle + 0.5 * step) - seen(sample.point, angle - 0.5 * step))
                    .norm();
            const Point2 placed = rotated(sample.point, angle);
            most = std::max(most, moved);
            most_turned =
                std::max(most_turned,
                         std::abs(moved - step * grid.turning *
                                              (placed - Point2(grid.pitch_radius_mm, 0.0)).norm()));
          }
        EXPECT_LE(most, 0.057);
        EXPECT_GE(most, 0.042);
        EXPECT_LT(most_turned, 1e-4);
      }
}

TEST(ColumnsWithout, AreAsManyAsTheDistanceSurelyStaysAboveItsLimit) {
  Draw draw(3);
  EXPECT_EQ(columns_without(0.0, 0.1, 0.01), 0u);
  EXPECT_EQ(columns_without(-1.0, 0.1, 0.01), 0u);
  for (int i = 0; i < 200; ++i) {
    const double above = std::exp(draw(-6.0, 2.0)),
                 first = i % 5 == 0 ? 0.0 : std::exp(draw(-8.0, -1.0)),
                 growth = std::exp(draw(-12.0, -3.0));
    const auto k = static_cast<double>(columns_without(above, first, growth));
    const auto moved = [&](double columns) {
      return columns * first + 0.5 * columns * columns * growth;
    };
    EXPECT_LE(moved(k), above);
    EXPECT_GT(moved(k + 1.0), above * (1.0 - 1e-8));
  }
  EXPECT_EQ(columns_without(1e6, 0.0, 1e-9), 1000000u);
}

/// Whether a place of a profile is an end of a piece, and of which kind it is there.
struct PlaceByHand {
  double distance_mm;
  bool corner, end;
  PieceKind kind;
};
PlaceByHand place_of(const ToothProfile& profile, const Point2& p) {
  const auto near = GearDistance(profile).nearest(p);
  double to_end = 1e300;
  const auto& pieces = near.clockwise_half ? profile.clockwise_pieces() : profile.pieces();
  for (const ProfilePiece& piece : pieces)
    to_end = std::min({to_end, (piece.curve.start_point() - near.point).norm(),
                       (piece.curve.end_point() - near.point).norm()});
  const bool end = to_end < 1e-7;
  const bool at_tip = std::abs(near.point.norm() - profile.tip_radius_mm()) < 1e-6;
  return {near.distance_mm, near.corner, end,
          end && at_tip ? PieceKind::kTip : pieces[static_cast<std::size_t>(near.piece)].kind};
}

void expect_place_is_true(const GearPair& pair, const MeshClearance& found, double turn_rad) {
  const MeshPlace& place = found.place;
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  const bool ring = pair.internal();
  // the gears run together, gear 2 turned out of the middle of its play
  const double together =
      ring ? place.rotation1_rad * z1 / z2 : kPi - place.rotation1_rad * z1 / z2;
  EXPECT_NEAR(std::remainder(place.rotation2_rad - together - kPi / z2 - turn_rad, kTwoPi / z2),
              0.0, 1e-9);
  const Point2 axis2(ring ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const Point2 in1 = rotated(place.point_mm, -place.rotation1_rad),
               in2 = rotated(Point2(place.point_mm - axis2), -place.rotation2_rad);
  EXPECT_GT(place.point_mm.x(), 0.0);
  const PlaceByHand at1 = place_of(*pair.profile1, in1), at2 = place_of(*pair.profile2, in2);
  // the point lies on one of the profiles, and the other one is as far away as is said
  const bool on1 = std::abs(at1.distance_mm) < std::abs(at2.distance_mm);
  EXPECT_NEAR(on1 ? at1.distance_mm : at2.distance_mm, 0.0, 1e-9);
  EXPECT_NEAR(on1 ? at2.distance_mm : at1.distance_mm, found.clearance_mm, 2e-9);
  if (std::abs(found.clearance_mm) < 1e-6) return;  // which of both is the nearer says rounding
  // a foot at the end of a piece is no corner of the other one
  EXPECT_EQ(place.corner1, on1 ? at1.end : at1.corner);
  EXPECT_EQ(place.corner2, on1 ? at2.corner : at2.end);
  EXPECT_EQ(place.piece1, at1.kind);
  EXPECT_EQ(place.piece2, at2.kind);
  EXPECT_NEAR(place.radius1_mm, in1.norm(), on1 ? 1e-9 : std::abs(found.clearance_mm) + 1e-9);
  EXPECT_NEAR(place.radius2_mm, in2.norm(), on1 ? std::abs(found.clearance_mm) + 1e-9 : 1e-9);
  const double beside = std::remainder(std::atan2(in1.y(), in1.x()), kTwoPi / z1);
  if (on1 && kPi / z1 - std::abs(beside) > 1e-6 && std::abs(beside) > 1e-6) {
    EXPECT_EQ(place.flank1, beside > 0.0 ? Flank::kLeft : Flank::kRight);
  }
}

TEST(MeshPlace, IsWhereTheProfilesAreAsNearAsTheClearanceSays) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    SCOPED_TRACE(seed);
    const GearPair pair = train->pair(train->meshes[0]);
    expect_place_is_true(pair, mesh_clearance(pair), 0.0);
    expect_place_is_true(pair, mesh_clearance(pair, 0.002), 0.002);
    ++meshes;
  }
  EXPECT_GT(meshes, 30);
}

/// The least distance of all samples of both gears at all positions of their grids.
double least_of_all_mm(const GearPair& pair) {
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth, a = pair.centre_distance_mm;
  const bool ring = pair.internal();
  const Point2 axis2(ring ? -a : a, 0.0);
  const GearDistance distance1(*pair.profile1), distance2(*pair.profile2);
  double least = 1e300;
  const SweepGrid grid1 = sweep_grid(*pair.profile1, *pair.profile2, a),
                  grid2 = sweep_grid(*pair.profile2, *pair.profile1, a);
  for (int k = 0; k <= grid1.steps; ++k) {
    const double turn1 = grid1.reach_rad * (2.0 * k / grid1.steps - 1.0);
    const double turn2 = (ring ? turn1 * z1 / z2 : kPi - turn1 * z1 / z2) + kPi / z2;
    for (const SweepSample& s : sweep_samples(*pair.profile1))
      least = std::min(
          least,
          distance2.nearest(rotated(Point2(rotated(s.point, turn1) - axis2), -turn2)).distance_mm);
  }
  for (int k = 0; k <= grid2.steps; ++k) {
    const double turn2 = grid2.reach_rad * (2.0 * k / grid2.steps - 1.0) + (ring ? 0.0 : kPi);
    const double turn1 = (ring ? turn2 - kPi / z2 : kPi + kPi / z2 - turn2) * z2 / z1;
    for (const SweepSample& s : sweep_samples(*pair.profile2))
      least = std::min(
          least,
          distance1.nearest(rotated(Point2(rotated(s.point, turn2) + axis2), -turn1)).distance_mm);
  }
  return least;
}

TEST(SweepClearance, IsNoMoreThanThatOfAnySampleInAnyColumn) {
  for (const auto& [teeth1, teeth2, ring] : {std::tuple(11, 17, false),
                                             {17, 12, false},
                                             {12, 40, true},
                                             {24, 30, true},
                                             {27, 30, true}}) {
    SCOPED_TRACE(std::to_string(teeth1) + ' ' + std::to_string(teeth2));
    const GearTrain train = laid_out(pair_design(teeth1, teeth2, ring, 0.05));
    const GearPair pair = train.pair(train.meshes[0]);
    const double least = least_of_all_mm(pair), swept = sweep_clearance_mm(pair);
    EXPECT_LE(swept, least + 1e-9);
    EXPECT_GE(swept, least - 0.01);
  }
}

/// The least distance of a gear's points around a place from its mate, as both turn a little on.
double least_around_mm(const GearPair& pair, const MeshPlace& place, bool gear1_moves) {
  const ToothProfile& mover = gear1_moves ? *pair.profile1 : *pair.profile2;
  const GearDistance mate(gear1_moves ? *pair.profile2 : *pair.profile1);
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth, m = pair.gear1().normal_module_mm;
  const Point2 axis2(pair.internal() ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const Point2 axis = gear1_moves ? Point2(0.0, 0.0) : axis2,
               axis_of_mate = gear1_moves ? axis2 : Point2(0.0, 0.0);
  const double turn = gear1_moves ? place.rotation1_rad : place.rotation2_rad,
               turn_of_mate = gear1_moves ? place.rotation2_rad : place.rotation1_rad;
  const double ratio = (pair.internal() ? 1.0 : -1.0) * (gear1_moves ? z1 / z2 : z2 / z1);
  const Point2 seen = rotated(Point2(place.point_mm - axis), -turn);
  const double pitch = kTwoPi / mover.gear().teeth,
               tooth = pitch * std::round(polar_angle_rad(seen) / pitch);
  Point2 there = rotated(seen, -tooth);
  const bool below = there.y() < 0.0;
  if (below) there = mirrored(there);
  double least = 1e300;
  for (const ProfilePiece& piece : mover.pieces())
    for (int i = 0; i <= 3000; ++i) {
      const Point2 on_half =
          point_at(piece.curve, std::lerp(piece.curve.begin, piece.curve.end, i / 3000.0));
      if ((on_half - there).norm() > 0.02 * m) continue;
      const Point2 p = rotated(below ? mirrored(on_half) : on_half, tooth + turn);
      for (int k = -20; k <= 20; ++k) {
        const double on = 1e-3 * k / 20.0;
        const Point2 placed = axis + rotated(p, on);
        least = std::min(
            least, mate.nearest(rotated(Point2(placed - axis_of_mate), -turn_of_mate - ratio * on))
                       .distance_mm);
      }
    }
  return least;
}

void expect_nothing_nearer(const GearTrain& train) {
  const GearPair pair = train.pair(train.meshes[0]);
  const MeshClearance found = mesh_clearance(pair);
  const double least =
      std::min(least_around_mm(pair, found.place, true), least_around_mm(pair, found.place, false));
  EXPECT_GE(least, found.clearance_mm - 2e-8);
  EXPECT_LE(least, found.clearance_mm + 2e-5);
}

TEST(MeshPlace, NoPlaceAroundItIsNearer) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    SCOPED_TRACE(seed);
    expect_nothing_nearer(*train);
    ++meshes;
  }
  EXPECT_GT(meshes, 15);
}

// A rounding that comes near a fillet does so between the points of any grid.
TEST(MeshPlace, NoPlaceAroundThatOfARoundedTipIsNearer) {
  int rounded = 0;
  for (int i = 0; i < 16; ++i) {
    SCOPED_TRACE(i);
    const bool ring = i % 2 == 1;
    GearboxDesign design = pair_design(17 + 3 * i, (ring ? 40 : 33) + 5 * i, ring, 0.5);
    for (GearDesign& g : design.gears) g.modifications.tip_rounding_mm = 0.12 + 0.01 * (i % 5);
    design.rack.dedendum = 1.1 + 0.01 * i;
    const GearTrain train = laid_out(design);
    expect_nothing_nearer(train);
    const MeshPlace place = mesh_clearance(train.pair(train.meshes[0])).place;
    rounded +=
        place.piece1 == PieceKind::kTipRounding || place.piece2 == PieceKind::kTipRounding ? 1 : 0;
  }
  EXPECT_GT(rounded, 4);
}

TEST(TipsClear, LooksAtTheTipsOfBothGears) {
  for (const bool ring : {false, true})
    for (const char* longer : {"pinion", "wheel"}) {
      GearboxDesign design = pair_design(20, 50, ring, 0.2);
      const auto clear = [&] {
        const GearTrain train = laid_out(design);
        return tips_clear(train.pair(train.meshes[0]), 0.0);
      };
      EXPECT_TRUE(clear()) << ring;
      // up to 1.3 modules above the pitch circle: 0.05 beyond the mate's root
      const bool in_ring = ring && longer == std::string("wheel");
      const double pitch_diameter = longer == std::string("wheel") ? 50.0 : 20.0;
      gear(design, longer).tip_diameter_mm = pitch_diameter + (in_ring ? -2.6 : 2.6);
      EXPECT_FALSE(clear()) << ring << ' ' << longer;
    }
}

TEST(TipsClear, DecidesAtTheClearanceItself) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    const GearPair pair = train->pair(train->meshes[0]);
    const double clearance_mm = tips_swept_mm(pair, CurveSpline::kError, 0.0, 0.0, -1e9);
    EXPECT_TRUE(tips_clear(pair, clearance_mm)) << seed;
    EXPECT_FALSE(tips_clear(pair, clearance_mm + 1e-9)) << seed;
    ++meshes;
  }
  EXPECT_GT(meshes, 20);
}

TEST(TipsClear, AsksTheTipsAlone) {
  GearboxDesign design = pair_design(23, 37, false, 0.0);
  const auto pair_of = [&](const PairSection& section) {
    GearPair pair = section.pair();
    pair.centre_distance_mm -= 0.02;
    return pair;
  };
  const GearTrain plain = laid_out(design);
  const PairSection unmodified = mesh_section(plain, plain.meshes[0], 5.0);
  EXPECT_LT(sweep_clearance_mm(pair_of(unmodified)), -5e-3);
  EXPECT_FALSE(tips_clear(pair_of(unmodified), 0.0));
  // with their tips and roots taken back the flanks penetrate in their middles
  for (const char* name : {"pinion", "wheel"})
    gear(design, name).modifications.profile_crowning_um = 40.0;
  const GearTrain crowned = laid_out(design);
  const PairSection section = mesh_section(crowned, crowned.meshes[0], 5.0);
  EXPECT_LT(sweep_clearance_mm(pair_of(section)), -5e-3);
  EXPECT_TRUE(tips_clear(pair_of(section), 0.0));
  EXPECT_FALSE(tips_clear(pair_of(section), 0.1));
}

bool segments_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  using Exact = long double;
  const auto side = [](const Point2& p, const Point2& q, const Point2& r) {
    return (Exact(q.x()) - Exact(p.x())) * (Exact(r.y()) - Exact(p.y())) -
           (Exact(q.y()) - Exact(p.y())) * (Exact(r.x()) - Exact(p.x()));
  };
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) ||
      std::max(c.x(), d.x()) < std::min(a.x(), b.x()))
    return false;
  return side(a, b, c) * side(a, b, d) <= 0.0L && side(c, d, a) * side(c, d, b) <= 0.0L;
}

std::vector<Point2> placed_polygon(const ToothProfile& profile, double tolerance_mm,
                                   double turn_rad, const Point2& centre_mm) {
  std::vector<Point2> points = section_polygon(profile, tolerance_mm).points;
  const Point2 axis = unit_vector(turn_rad);
  for (Point2& p : points) p = Point2(centre_mm + p.x() * axis + p.y() * perpendicular(axis));
  return points;
}

bool polygons_cross(const std::vector<Point2>& one, const std::vector<Point2>& two) {
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t k = 0; k < two.size(); ++k)
      if (segments_cross(one[i], one[(i + 1) % one.size()], two[k], two[(k + 1) % two.size()]))
        return true;
  return false;
}

TEST(ToothCrossing, IsThatOfAllEdgesWithAllOthersWhereTipsJustMeet) {
  Draw draw(12);
  constexpr double kTolerance_mm = 5e-3;  // a tip land is one edge
  std::array<int, 2> seen{};
  for (const bool internal : {false, true}) {
    const GearTrain train = laid_out(pair_design(15, internal ? 34 : 19, internal, 0.2));
    const GearPair pair = train.pair(train.meshes[0]);
    const double tips_mm = internal
                               ? pair.profile2->tip_radius_mm() - pair.profile1->tip_radius_mm()
                               : pair.profile1->tip_radius_mm() + pair.profile2->tip_radius_mm();
    for (int i = 0; i < 80; ++i) {
      const double direction = draw(0.0, kTwoPi), depth = draw(-6e-3, i % 2 == 0 ? 0.01 : 0.1);
      const Point2 centre2 =
          (internal ? -(tips_mm + depth) : tips_mm - depth) * unit_vector(direction);
      const double turn1 = direction + draw(-0.03, 0.03),
                   turn2 = direction + (internal ? 0.0 : kPi) + draw(-0.03, 0.03);
      const bool expected =
          polygons_cross(placed_polygon(*pair.profile1, kTolerance_mm, turn1, Point2::Zero()),
                         placed_polygon(*pair.profile2, kTolerance_mm, turn2, centre2));
      EXPECT_EQ(teeth_cross(pair, turn1, turn2, centre2, kTolerance_mm).cross, expected)
          << internal << ' ' << i << ' ' << depth;
      ++seen[expected ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 20);
  EXPECT_GT(seen[1], 20);
}

TEST(GearDistance, OverTheMiddlesOfTipAndGapIsToTheirArcsNotToTheirEnds) {
  for (const bool ring : {false, true}) {
    const GearTrain train = laid_out(pair_design(17, 46, ring, 0.05));
    for (const TrainGear& gear : train.gears) {
      const GearDistance distance(gear.profile);
      const double z = gear.profile.gear().teeth, tip = gear.profile.tip_radius_mm(),
                   root = gear.profile.root_radius_mm(), out = tip > root ? 0.1 : -0.1;
      const auto over_tip = distance.nearest(Point2(tip + out, 0.0)),
                 in_gap = distance.nearest((root + out) * unit_vector(kPi / z));
      EXPECT_NEAR(over_tip.distance_mm, 0.1, 1e-12);
      EXPECT_FALSE(over_tip.corner);
      EXPECT_NEAR(in_gap.distance_mm, 0.1, 1e-9);
      EXPECT_FALSE(in_gap.corner);
    }
  }
}

TEST(GearDistance, IsTheSameOnBothSidesOfTheMiddleOfAGap) {
  Draw draw(41);
  for (const bool ring : {false, true}) {
    const GearTrain train = laid_out(pair_design(17, 46, ring, 0.05));
    for (const TrainGear& gear : train.gears) {
      const GearDistance distance(gear.profile);
      const double z = gear.profile.gear().teeth, tip = gear.profile.tip_radius_mm(),
                   root = gear.profile.root_radius_mm();
      for (int i = 0; i < 200; ++i) {
        const double middle = kPi / z * (2.0 * std::floor(draw(-3.0, 3.0)) + 1.0),
                     beside = draw(0.0, 2e-3);
        const double radius = std::lerp(root, tip, draw(-0.2, 0.6));
        const auto left = distance.nearest(radius * unit_vector(middle + beside)),
                   right = distance.nearest(radius * unit_vector(middle - beside));
        EXPECT_NEAR(left.distance_mm, right.distance_mm, 1e-9)
            << middle << ' ' << beside << ' ' << radius;
        EXPECT_TRUE(left.clockwise_half);
        EXPECT_FALSE(right.clockwise_half);
      }
    }
  }
}

}  // namespace
}  // namespace trueflank::test
