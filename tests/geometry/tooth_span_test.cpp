// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/tooth_span.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {
namespace {

using Point3 = std::array<double, 3>;

Gear gear_of(GearKind kind, int teeth, double helix_deg, double shift) {
  Gear gear{.kind = kind, .teeth = teeth, .normal_module_mm = 2.0,
            .helix_angle_rad = rad_from_deg(helix_deg), .shift = shift, .thinning_mm = 0.04};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

/// The flank in space by its definition alone: the end of a thread unwound from the base circle, turned
/// along the axis. side +1: counter-clockwise flank of tooth `tooth`.
Point3 flank_point(const Gear& g, int tooth, int side, double xi, double z) {
  const double r_b = base_radius_mm(g);
  const double sense = g.kind == GearKind::kExternal ? -1.0 : 1.0;
  const double tau = base_half_angle_rad(g) + sense * xi;
  const double x = r_b * (std::cos(tau) + sense * xi * std::sin(tau));
  const double y = side * r_b * (std::sin(tau) - sense * xi * std::cos(tau));
  const double turn =
      kTwoPi * tooth / g.teeth + std::tan(g.helix_angle_rad) / reference_radius_mm(g) * z;
  return {x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), z};
}

double distance(const Point3& a, const Point3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The place of a flank where the line to a point stands normal on it: Newton on the gradient of the
/// squared distance, by differences.
struct Foot {
  double xi, z, distance_mm;
};
Foot foot(const Gear& g, int tooth, int side, const Point3& p, double xi, double z) {
  const double h = 1e-4;
  const auto square = [&](double u, double v) {
    const double d = distance(flank_point(g, tooth, side, u, v), p);
    return d * d;
  };
  for (int i = 0; i < 60; ++i) {
    const double f_u = (square(xi + h, z) - square(xi - h, z)) / (2 * h);
    const double f_v = (square(xi, z + h) - square(xi, z - h)) / (2 * h);
    const double f = square(xi, z);
    const double f_uu = (square(xi + h, z) - 2 * f + square(xi - h, z)) / (h * h);
    const double f_vv = (square(xi, z + h) - 2 * f + square(xi, z - h)) / (h * h);
    const double f_uv = (square(xi + h, z + h) - square(xi + h, z - h) - square(xi - h, z + h) +
                         square(xi - h, z - h)) / (4 * h * h);
    const double det = f_uu * f_vv - f_uv * f_uv;
    xi -= (f_vv * f_u - f_uv * f_v) / det;
    z -= (f_uu * f_v - f_uv * f_u) / det;
  }
  return {xi, z, distance(flank_point(g, tooth, side, xi, z), p)};
}

class Helical : public ::testing::TestWithParam<std::tuple<GearKind, int, double, double>> {
 protected:
  Gear gear() const {
    const auto& [kind, teeth, helix, shift] = GetParam();
    return gear_of(kind, teeth, helix, shift);
  }
};

TEST_P(Helical, ABallInTheGapTouchesBothHelicoidsWhereOverPinsPutsIt) {
  const Gear g = gear();
  const double ball = recommended_pin_diameter_mm(g);
  const double over = over_pins_mm(g, ball);
  ASSERT_FALSE(std::isnan(over));
  const double sign = g.kind == GearKind::kExternal ? 1.0 : -1.0;
  // two balls in gaps as nearly opposite as the teeth allow, both in one transverse plane
  double centre = over - sign * ball;
  if (g.teeth % 2 == 1) centre /= std::cos(0.5 * kPi / g.teeth);
  const double gap = kPi / g.teeth, r = 0.5 * centre;
  const Point3 middle{r * std::cos(gap), r * std::sin(gap), 0.0};
  const double xi = roll_length_mm(r, base_radius_mm(g)) / base_radius_mm(g);
  const double start = xi - sign * 0.5 * ball / base_radius_mm(g);
  const Foot lower = foot(g, 0, 1, middle, start, 0.0), upper = foot(g, 1, -1, middle, start, 0.0);
  EXPECT_NEAR(lower.distance_mm, 0.5 * ball, 1e-6);
  EXPECT_NEAR(upper.distance_mm, 0.5 * ball, 1e-6);
  // and it touches a little off the plane, to either side
  EXPECT_NEAR(lower.z, -upper.z, 1e-4);
  EXPECT_NEAR(std::abs(lower.z),
              0.5 * ball * std::sin(std::abs(base_helix_angle_rad(g))), 1e-4);
}

TEST_P(Helical, TheSpanIsTheCommonNormalAndNeedsItsFaceWidth) {
  const Gear g = gear();
  if (g.kind == GearKind::kInternal) {
    EXPECT_TRUE(std::isnan(base_tangent_length_mm(g, 3)));
    EXPECT_TRUE(std::isnan(span_face_width_mm(g, 3)));
    return;
  }
  const int k = recommended_span_teeth(g);
  const double span = base_tangent_length_mm(g, k);
  // from a point of the upper flank of tooth k - 1 the normal goes on to the lower flank of tooth 0
  const double r_b = base_radius_mm(g);
  const double xi = 0.5 * span * std::cos(base_helix_angle_rad(g)) / r_b;
  const Point3 from = flank_point(g, k - 1, 1, xi, 0.0);
  const double lean = std::sin(base_helix_angle_rad(g)) * span;
  const Foot other = foot(g, 0, -1, from, xi, lean);
  EXPECT_NEAR(other.distance_mm, span, 1e-6);
  EXPECT_NEAR(std::abs(other.z), span_face_width_mm(g, k), 1e-5);
}
TEST(SpanTeeth, OfHelicalTeethTouchTheFlankNearTheCircleOfTheShift) {
  const Gear published{.teeth = 65, .normal_module_mm = 2.0, .helix_angle_rad = rad_from_deg(35.0), .shift = -0.2};
  EXPECT_EQ(recommended_span_teeth(published), 13);
  int below = 0, all = 0;
  for (int teeth = 20; teeth <= 120; teeth += 5)
    for (const double helix : {0.0, 20.0, 35.0, 45.0})
      for (const double shift : {-0.2, 0.0, 0.4}) {
        Gear g{.teeth = teeth, .normal_module_mm = 2.0, .helix_angle_rad = rad_from_deg(helix), .shift = shift};
        g.tip_radius_mm = nominal_tip_radius_mm(g);
        const auto profile = ToothProfile::make(g);
        ASSERT_TRUE(profile.has_value());
        const double roll = 0.5 * base_tangent_length_mm(g, recommended_span_teeth(g)) * std::cos(base_helix_angle_rad(g));
        ++all;
        if (roll < profile->root_form_roll_length_mm()) ++below;
        EXPECT_LT(std::hypot(base_radius_mm(g), roll), g.tip_radius_mm);
      }
  EXPECT_LE(below, all / 50);  // few-toothed gears whose next number of teeth is too many
}

INSTANTIATE_TEST_SUITE_P(
    Gears, Helical,
    ::testing::Values(std::tuple{GearKind::kExternal, 24, 0.0, 0.1},
                      std::tuple{GearKind::kExternal, 24, 15.0, 0.2},
                      std::tuple{GearKind::kExternal, 31, -28.0, -0.1},
                      std::tuple{GearKind::kExternal, 12, 44.0, 0.3},
                      std::tuple{GearKind::kInternal, 60, 20.0, 0.2},
                      std::tuple{GearKind::kInternal, 81, -12.0, 0.5}));

}  // namespace
}  // namespace trueflank
