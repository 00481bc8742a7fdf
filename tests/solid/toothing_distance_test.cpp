// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points are lifted off the true surface along its normal, found from the surface's own points; the
// distance must come out as the lift.
#include "trueflank/solid/measure/toothing_distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/train/prototype_design.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

Point3 vector_of(const std::array<double, 3>& p) { return Point3(p.data()); }

struct Share {
  double worst = 0.0;  ///< error of the distance, of the lift
  int places = 0;
};

Share lift_off(const GearTrain& train, double lift_mm) {
  const TrainGear& gear = train.gears[0];
  const ToothedOutline outline{.profile = &gear.profile, .twist = gear.toothing().twist,
                               .deviation = &gear.deviation};
  const Toothing toothing = outline.toothing();
  const ToothingDistance distance(outline);
  Share share;
  const double width = toothing.twist.face_width_mm;
  for (std::size_t k = 0; k < gear.profile.pieces().size(); ++k) {
    const ProfilePiece& piece = gear.profile.pieces()[k];
    if (piece.kind != PieceKind::kInvolute && piece.kind != PieceKind::kFillet) continue;
    for (int i = 1; i < 16; ++i)
      for (const double height : {0.13, 0.4, 0.77})
        for (const int side : {1, -1}) {
          const Curve& c = piece.curve;
          const double t = c.begin + (c.end - c.begin) * i / 16, dt = 1e-4 * (c.end - c.begin);
          const double z = height * width, dz = 1e-4 * width;
          const auto at = [&](double parameter, double z_mm) {
            return vector_of(surface_point(toothing, {2, side, k, parameter}, z_mm));
          };
          Point3 normal = (at(t + dt, z) - at(t - dt, z)).cross(at(t, z + dz) - at(t, z - dz));
          normal.normalize();
          const double one = distance.distance_mm(at(t, z) + lift_mm * normal);
          const double other = distance.distance_mm(at(t, z) - lift_mm * normal);
          EXPECT_LT(one * other, 0.0);
          for (const double found : {one, other})
            share.worst = std::max(share.worst, std::abs(std::abs(found) - lift_mm) / lift_mm);
          share.places += 2;
        }
  }
  return share;
}

GearboxDesign gear_of(int teeth, double shift, ModificationsDesign modifications) {
  GearboxDesign design = test::unshifted("gear", "", {teeth});
  design.gears[0].shift = shift;
  design.gears[0].face_width_mm = 10.0;
  design.gears[0].modifications = modifications;
  return design;
}

void expect_lift(const GearboxDesign& design, double limit) {
  const auto train = lay_out(design);
  ASSERT_TRUE(train) << train.error().front().message;
  const Share share = lift_off(*train, 2e-4);
  EXPECT_GT(share.places, 300);
  EXPECT_LT(share.worst, limit);
}

TEST(ToothingDistance, IsTheLiftWhereAnUndercutFootIsNarrowerThanTheTip) {
  expect_lift(gear_of(5, -0.3581, {.profile_slope_um = -2.0}), 0.01);
}

TEST(ToothingDistance, IsTheLiftOnBothPiecesOfAProtuberance) {
  GearboxDesign design = gear_of(30, 0.2, {.crowning_um = 8.0});
  design.rack.dedendum = 1.4;
  design.rack.protuberance = 0.06;
  expect_lift(design, 0.01);
}

TEST(ToothingDistance, IsTheLiftOnATightFilletOverWhichADeviationFades) {
  GearboxDesign design = gear_of(85, 0.0, {.profile_crowning_um = 4.0});
  GearDesign& ring = design.gears[0];
  ring.kind = GearKind::kInternal;
  ring.root = RingRoot::kShaper;
  ring.cutter = ShaperCutter{.teeth = 50};
  design.helix_angle_rad = rad_from_deg(16.8);
  expect_lift(design, 0.03);
}

}  // namespace
}  // namespace trueflank
