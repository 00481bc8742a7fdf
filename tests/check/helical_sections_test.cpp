// SPDX-License-Identifier: GPL-3.0-or-later
//
// Helical trains by an independent route: the transverse sections of both gears are placed at several
// heights of every mesh, and the real profiles must stand with the backlash centred at all of them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "check_designs.h"
#include "trueflank/check/assembly.h"
#include "trueflank/check/clearance/gear_distance.h"

namespace trueflank {
namespace {

using test::laid_out;

/// How a gear of the train stands: its axis and the angle of tooth 1 at its lower face.
struct Placed {
  Point2 axis = Point2::Zero();
  double rotation_rad = 0.0;
};

Placed placed(const GearTrain& train, const TrainGear& gear, std::size_t planet) {
  const int index = static_cast<int>(&gear - train.gears.data());
  const int member = train.topology().gears[static_cast<std::size_t>(index)].member;
  return {axis_centre_mm(train, train.phases, member, planet),
          train.phases.rotation_rad(member, planet) + train.phases.offset_rad(index, planet)};
}

double section_angle(const TrainGear& gear, const Placed& at, double z) {
  return at.rotation_rad + section_turn_rad(gear.twist, z - gear.z_lower_mm);
}

/// Smallest distance of gear 1's flanks of one side from gear 2, over all teeth.
double nearest(const TrainGear& gear1, const Placed& at1, const TrainGear& gear2, const Placed& at2,
               const GearDistance& distance2, int side, double z) {
  const double turn1 = section_angle(gear1, at1, z), turn2 = section_angle(gear2, at2, z);
  double least = 1e300;
  for (const ProfilePiece& piece : gear1.profile.pieces()) {
    if (piece.kind != PieceKind::kInvolute) continue;
    constexpr int kPlaces = 600;
    for (int i = 0; i <= kPlaces; ++i) {
      Point2 p = point_at(piece.curve,
                          piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / kPlaces);
      if (side < 0) p = mirrored(p);
      for (int tooth = 0; tooth < gear1.profile.gear().teeth; ++tooth) {
        const Point2 world =
            at1.axis + rotated(p, turn1 + kTwoPi * tooth / gear1.profile.gear().teeth);
        const Point2 local = rotated(Point2(world - at2.axis), -turn2);
        if (local.norm() > gear2.profile.tip_radius_mm() + 1.0 &&
            gear2.profile.gear().kind == GearKind::kExternal)
          continue;
        if (local.norm() < gear2.profile.tip_radius_mm() - 1.0 &&
            gear2.profile.gear().kind == GearKind::kInternal)
          continue;
        least = std::min(least, distance2.nearest(local).distance_mm);
      }
    }
  }
  return least;
}

void expect_centred_at_all_heights(const GearTrain& train) {
  for (const TrainMesh& mesh : train.meshes) {
    const TrainGear& gear1 = train.gears[static_cast<std::size_t>(mesh.gear1)];
    const TrainGear& gear2 = train.gears[static_cast<std::size_t>(mesh.gear2)];
    const GearDistance distance2(gear2.profile);
    const std::size_t planets = std::max<std::size_t>(1, train.phases.positions_rad(train.topology().first_planet()).size());
    const double half = 0.5 * mesh.backlash_mm * std::cos(working_pressure_angle_rad(train.pair(mesh)));
    for (std::size_t i = 0; i < planets; ++i)
      for (double share : {0.0, 0.37, 0.5, 1.0}) {
        const double z = gear1.z_lower_mm + share * std::min(gear1.face_width_mm, gear2.face_width_mm);
        for (int side : {1, -1})
          EXPECT_NEAR(nearest(gear1, placed(train, gear1, i), gear2, placed(train, gear2, i), distance2,
                              side, z),
                      half, 1e-5)
              << mesh.name << " planet " << i + 1 << " z " << z << " side " << side;
      }
  }
}

GearboxDesign with_helix(GearboxDesign design, double helix_deg, bool herringbone = false) {
  design.helix_angle_rad = rad_from_deg(helix_deg);
  design.herringbone = herringbone;
  design.backlash_mm = 0.05;
  return design;
}

TEST(HelicalSections, PairsStandCentredAtAllHeights) {
  for (double helix : {17.0, -30.0, 44.0}) {
    expect_centred_at_all_heights(laid_out(with_helix(test::pair_design(17, 40, false), helix)));
    expect_centred_at_all_heights(laid_out(with_helix(test::pair_design(17, 60, true), helix, true)));
  }
}

TEST(HelicalSections, SimpleSetsStandCentredAtAllHeights) {
  expect_centred_at_all_heights(laid_out(with_helix(test::simple_design(18, 21, 60, 3), 20.0)));
  expect_centred_at_all_heights(laid_out(with_helix(test::simple_design(18, 21, 60, 3), -25.0, true)));
}

TEST(HelicalSections, BothLayersOf3kStandCentredAtAllHeightsWhateverTheirModules) {
  GearboxDesign design = with_helix(test::paper_design(), 12.0);
  design.centre_distance_mm.reset();
  test::gear(design, "ring1").shift.reset();
  test::gear(design, "ring2").shift.reset();
  expect_centred_at_all_heights(laid_out(design));
  design.helix_angle_rad = rad_from_deg(-18.0);
  for (const char* name : {"planet2", "ring2"}) {
    test::gear(design, name).module_mm = 0.9;
    test::gear(design, name).face_width_mm = 7.0;
  }
  test::gear(design, "planet2").teeth = 36;
  test::gear(design, "ring2").teeth = 93;
  const GearTrain train = laid_out(design);
  // one reference helix angle, but each layer its own base helix only through its pressure angle
  EXPECT_NEAR(train.find("planet1")->profile.gear().helix_angle_rad, rad_from_deg(18.0), 1e-15);
  EXPECT_NEAR(train.find("planet2")->profile.gear().helix_angle_rad, rad_from_deg(18.0), 1e-15);
  expect_centred_at_all_heights(train);
}

TEST(HelicalSections, RandomPairsStandCentredAtAllHeights) {
  std::mt19937 engine(20261121);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(engine);
  };
  int laid = 0;
  for (int i = 0; i < 24; ++i) {
    const bool internal = whole(0, 2) == 0;
    const int z1 = whole(12, 30), z2 = internal ? z1 + whole(25, 50) : whole(12, 45);
    GearboxDesign design = with_helix(test::pair_design(z1, z2, internal), real(-44.0, 44.0),
                                      whole(0, 1) == 1);
    test::gear(design, "pinion").shift = real(-0.1, 0.5);
    test::gear(design, "wheel").shift = real(-0.1, 0.5);
    test::gear(design, "pinion").face_width_mm = test::gear(design, "wheel").face_width_mm =
        real(3.0, 30.0);
    const auto train = lay_out(design);
    if (!train || contact_ratios(train->pair(train->meshes[0])).effective < 1.05) continue;
    ++laid;
    SCOPED_TRACE("z " + std::to_string(z1) + "/" + std::to_string(z2) + " helix " +
                 std::to_string(deg_from_rad(design.helix_angle_rad)));
    expect_centred_at_all_heights(*train);
  }
  EXPECT_GE(laid, 12);
}

TEST(HelicalSections, AWrongHandIsSeen) {
  GearTrain train = laid_out(with_helix(test::pair_design(17, 40, false), 20.0));
  train.gears[1].twist.turn_rad_per_mm *= -1.0;
  const TrainGear &pinion = train.gears[0], &wheel = train.gears[1];
  const GearDistance distance(wheel.profile);
  EXPECT_LT(nearest(pinion, placed(train, pinion, 0), wheel, placed(train, wheel, 0), distance, 1, 3.0),
            -0.05);
}

TEST(HelicalSections, HerringboneOfDifferentWidthsIsRefused) {
  GearboxDesign design = with_helix(test::simple_design(18, 21, 60, 3), 20.0, true);
  test::gear(design, "sun").face_width_mm = 12.0;
  const auto train = lay_out(design);
  ASSERT_FALSE(train);
  EXPECT_EQ(train.error()[0].key, "planet.face_width_mm");
  EXPECT_NE(train.error()[0].message.find("apexes"), std::string::npos);
}

TEST(HelicalSections, SetsThatNeedHalvesSaySo) {
  const auto status = [](const GearboxDesign& design) {
    const GearTrain train = laid_out(design);
    return check_assembly(train, mesh_states(train))[0];
  };
  const Finding set = status(with_helix(test::simple_design(18, 21, 60, 3), 20.0, true));
  EXPECT_EQ(set.status, CheckStatus::kWarn);
  EXPECT_NE(set.message.find("halves"), std::string::npos);
  EXPECT_EQ(status(with_helix(test::simple_design(18, 21, 60, 3), 20.0)).status, CheckStatus::kPass);
  EXPECT_EQ(status(with_helix(test::pair_design(17, 60, true), 20.0, true)).status, CheckStatus::kWarn);
  EXPECT_EQ(status(with_helix(test::pair_design(17, 60, false), 20.0, true)).status,
            CheckStatus::kNotApplicable);
}

}  // namespace
}  // namespace trueflank
