// SPDX-License-Identifier: GPL-3.0-or-later
//
// Protuberance tools against numerical rolling: the finished rack and the protuberance's tooth are
// rolled as two plain wedges, and every point of the profile must be where the nearer one comes to.
#include "trueflank/geometry/protuberance.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/rolling_tool.h"
#include "tests/support/sample_gears.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {
namespace {

using test::described;

using testing::RackTool;

/// Finished flank, cut off inside the protuberance, and the protuberance's own tooth.
struct ProtuberanceTool {
  RackTool flank, tip;
};

ProtuberanceTool tool_of(const Gear& g, double rho) {
  const double m = g.normal_module_mm, a = g.rack.pressure_angle_rad,
               b = g.rack.protuberance_angle_rad, s = residual_protuberance(g.rack) * m;
  const double half = 0.25 * kPi * m + 0.5 * g.thinning_mm;
  // centre of the corner's arc: it touches the tip line and the flank displaced by s
  const double depth = g.rack.dedendum * m - rho;
  const double beside = half - depth * std::tan(a) + (s - rho) / std::cos(a);
  // its tangent at the angle b, followed up to the reference line
  const double width = beside + depth * std::tan(b) + rho / std::cos(b);
  return {{a, half, depth + rho * std::sin(a), 0.0}, {b, width, g.rack.dedendum * m, rho}};
}

double miss(const ProtuberanceTool& tool, const Gear& g, const Point2& p) {
  const double r = 0.5 * g.normal_module_mm * g.teeth, x = g.shift * g.normal_module_mm;
  const double range = 0.6 + 8.0 / g.teeth;
  return std::min(testing::rack_miss(tool.flank, r, x, p, range),
                  testing::rack_miss(tool.tip, r, x, p, range));
}

Gear gear_of(int teeth, double shift, double amount, double angle_deg, double stock, double rho) {
  Gear gear{.teeth = teeth, .shift = shift};
  gear.rack.dedendum = 1.4;
  gear.rack.root_radius = rho;
  gear.rack.protuberance = amount;
  gear.rack.protuberance_angle_rad = rad_from_deg(angle_deg);
  gear.rack.grinding_stock = stock;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

void expect_tool_generates(const ToothProfile& profile) {
  const Gear& g = profile.gear();
  const ProtuberanceTool tool = tool_of(g, profile.root_radius_coefficient() * g.normal_module_mm);
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind == PieceKind::kTip) continue;
    for (double u : {0.02, 0.3, 0.55, 0.8, 0.98}) {
      const Curve& c = piece.curve;
      const Point2 p = rotated(point_at(c, c.begin + u * (c.end - c.begin)), -kPi / g.teeth);
      EXPECT_NEAR(miss(tool, g, p), 0.0, tolerance::kCurve_mm * std::max(1.0, g.normal_module_mm))
          << described(g) << " piece " << static_cast<int>(piece.kind) << " u " << u;
    }
  }
  for (std::size_t i = 1; i < profile.pieces().size(); ++i)
    EXPECT_LT((profile.pieces()[i].curve.start_point() -
               profile.pieces()[i - 1].curve.end_point())
                  .norm(),
              1e-9)
        << described(g) << " at piece " << i;
}

TEST(Protuberance, IsWhatTheRollingToolCuts) {
  for (const Gear& gear :
       {gear_of(25, 0.0, 0.06, 10, 0.04, 0.3), gear_of(40, 0.3, 0.1, 8, 0.0, 0.3),
        gear_of(17, 0.2, 0.05, 12, 0.02, 0.38), gear_of(12, 0.0, 0.05, 10, 0.0, 0.3),
        gear_of(10, -0.1, 0.05, 5, 0.0, 0.2), gear_of(100, 0.0, 0.03, 10, 0.01, 0.39),
        gear_of(30, 0.0, 0.004, 5, 0.0, 0.39), gear_of(30, 0.0, 0.05, 10, 0.0, 0.0)}) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << described(gear) << profile.error().message;
    EXPECT_NEAR(profile->notes().protuberance_undercut_mm, residual_protuberance(gear.rack), 1e-15);
    expect_tool_generates(*profile);
  }
}

TEST(Protuberance, IsWhatTheRollingToolCutsForRandomGears) {
  std::mt19937 random(20260212);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int made = 0, with_side = 0, undercut = 0;
  for (int i = 0; i < 60; ++i) {
    // one after the other: in a call each compiler would draw them in an order of its own
    const double amount = uniform(0.005, 0.12);
    const double rho = uniform(0.0, 0.4);
    const double stock = i % 2 == 0 ? 0.0 : uniform(0.0, 0.8) * amount;
    const double angle_deg = uniform(3.0, 18.0);
    const double shift = uniform(-0.4, 0.9);
    const int teeth = static_cast<int>(std::exp(uniform(std::log(8.0), std::log(200.0))));
    Gear gear = gear_of(teeth, shift, amount, angle_deg, stock, rho);
    gear.rack.dedendum = uniform(1.2, 1.5);
    gear.normal_module_mm = std::exp(uniform(-1.0, 1.0));
    gear.thinning_mm = uniform(0.0, 0.05);
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    const auto profile = ToothProfile::make(gear);
    if (!profile) continue;
    ++made;
    undercut += profile->notes().undercut;
    int fillets = 0;
    for (const ProfilePiece& piece : profile->pieces()) fillets += piece.kind == PieceKind::kFillet;
    with_side += fillets == 2;
    expect_tool_generates(*profile);
    if (HasFailure()) return;
  }
  EXPECT_GT(made, 40);
  EXPECT_GT(with_side, 20);
  EXPECT_LT(with_side, made);
  EXPECT_GT(undercut, 3);
}

TEST(Protuberance, RootFormCircleIsWhereTheRolledToolLeavesTheFlank) {
  const Gear gear = gear_of(25, 0.0, 0.06, 10, 0.04, 0.3);
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  const ProtuberanceTool tool = tool_of(gear, 0.3);
  // on the finished involute, above and below the root form circle: untouched, and cut by the tip
  const auto cut_at = [&](double radius) {
    const Point2 p = radius * unit_vector(tooth_half_angle_rad(gear, radius) - kPi / gear.teeth);
    return testing::rack_miss(tool.tip, 12.5, 0.0, p, 1.0);
  };
  EXPECT_GT(cut_at(profile->root_form_radius_mm() + 1e-4), 0.0);
  EXPECT_LT(cut_at(profile->root_form_radius_mm() - 1e-4), 0.0);
  EXPECT_FALSE(profile->notes().undercut);
  // without protuberance the involute goes on farther down
  Gear plain = gear;
  plain.rack.protuberance = plain.rack.grinding_stock = 0.0;
  EXPECT_GT(profile->root_form_radius_mm(), ToothProfile::make(plain)->root_form_radius_mm());
}

TEST(Protuberance, ThatVanishesLeavesTheProfileOfThePlainRack) {
  Gear plain = gear_of(25, 0.1, 0.0, 10, 0.0, 0.3);
  Gear hardly = gear_of(25, 0.1, 1e-9, 10, 0.0, 0.3);
  const auto a = ToothProfile::make(plain), b = ToothProfile::make(hardly);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->root_form_radius_mm(), b->root_form_radius_mm(), 2e-4);
  EXPECT_NEAR(a->root_radius_mm(), b->root_radius_mm(), 1e-12);
}

TEST(Protuberance, ImpossibleToolsAreRefused) {
  const auto error_of = [](const Gear& gear) {
    const auto profile = ToothProfile::make(gear);
    EXPECT_FALSE(profile);
    return profile ? std::string() : profile.error().key;
  };
  EXPECT_EQ(error_of(gear_of(25, 0.0, 0.05, 10, 0.05, 0.3)), "rack.grinding_stock");
  EXPECT_EQ(error_of(gear_of(25, 0.0, 0.0, 10, 0.05, 0.3)), "rack.grinding_stock");
  EXPECT_EQ(error_of(gear_of(25, 0.0, 0.05, 20, 0.0, 0.3)), "rack.protuberance_angle_deg");
  EXPECT_EQ(error_of(gear_of(25, 0.0, 0.9, 19, 0.0, 0.1)), "rack.protuberance");
}

}  // namespace
}  // namespace trueflank
