// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCASCADE reads helical, herringbone and modified teeth from our STEP text: a solid or not, its
// volume, and how far every toothing surface is from the true one.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/programs/opencascade_solid.h"
#include "tests/support/sample_gears.h"
#include "tests/support/survey_size.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

using test::expect_exact_solid, test::read_back, test::profile_of;

/// Distances [mm] of the points of spline faces from the true helicoids, by the equation of the
/// involute and by the distance from the section's own curves.
struct SurfaceErrors {
  double flank_mm = 0.0, fillet_mm = 0.0;
  int flanks = 0, others = 0;
};

double distance_mm(const Point2& p, const std::vector<Point2>& line) {
  double best = 1e9;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point2 edge = line[i + 1] - line[i];
    const double u = std::clamp((p - line[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - line[i] - u * edge).norm());
  }
  return best;
}

/// Every piece but lands and involute of a half profile, its steps finer than 1e-7 mm of chord error.
std::vector<std::vector<Point2>> fillet_lines(const ToothProfile& profile) {
  std::vector<std::vector<Point2>> lines;
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind == PieceKind::kInvolute || piece.kind == PieceKind::kTip ||
        piece.kind == PieceKind::kRoot)
      continue;
    lines.emplace_back();
    for (int i = 0; i <= 1500; ++i)
      lines.back().push_back(
          point_at(piece.curve, piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / 1500.0));
  }
  return lines;
}

SurfaceErrors surface_errors(const TopoDS_Shape& shape, const Toothing& toothing) {
  const ToothProfile& profile = *toothing.profile;
  const Gear& gear = profile.gear();
  const double r_b = base_radius_mm(gear), psi = base_half_angle_rad(gear);
  const int sense = gear.kind == GearKind::kExternal ? -1 : 1;
  const double lower = std::min(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  const double upper = std::max(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  const auto fillets = fillet_lines(profile);
  SurfaceErrors errors;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
    const BRepAdaptor_Surface surface(TopoDS::Face(it.Current()));
    if (surface.GetType() != GeomAbs_BSplineSurface) continue;
    const double u0 = surface.FirstUParameter(), u1 = surface.LastUParameter();
    const double v0 = surface.FirstVParameter(), v1 = surface.LastVParameter();
    const auto section = [&](double u, double v) {
      const gp_Pnt p = surface.Value(u0 + u * (u1 - u0), v0 + v * (v1 - v0));
      return rotated({p.X(), p.Y()}, -section_turn_rad(toothing.twist, p.Z()));
    };
    const double middle = section(0.5, 0.5).norm();
    const bool flank = middle > lower && middle < upper;
    ++(flank ? errors.flanks : errors.others);
    const bool first = errors.others <= 4;  // the search is slow, and teeth are alike
    for (int i = 0; i <= 24; ++i)
      for (int j = 0; j <= 12; ++j) {
        const Point2 p = section(i / 24.0, j / 12.0);
        const double angle = centred_rad(polar_angle_rad(p), kTwoPi / gear.teeth);
        if (flank) {
          const double inv = involute_function(pressure_angle_at_radius_rad(p.norm(), r_b));
          errors.flank_mm =
              std::max(errors.flank_mm, std::abs(std::abs(angle) - (psi + sense * inv)) * r_b);
        } else if (first && i % 2 == 0 && j % 3 == 0) {
          double nearest = 1e9;
          for (const auto& line : fillets)
            nearest = std::min(nearest, distance_mm(p.norm() * unit_vector(std::abs(angle)), line));
          errors.fillet_mm = std::max(errors.fillet_mm, nearest);
        }
      }
  }
  return errors;
}

TEST(StepHelical, EveryShapeOfToothIsOneExactSolidWithAHelix) {
  int made = 0;
  for (auto [name, gear] : test::sample_gears()) {
    if (gear.teeth > 40) continue;  // nothing new, and slow
    const bool herringbone = made % 2 == 1;
    gear.helix_angle_rad = herringbone ? -0.35 : 0.22;
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    const auto profile = ToothProfile::make(gear);
    if (!profile) continue;  // there is no such gear
    ++made;
    if (!test::is_surveyed(made % 4 < 2)) continue;  // (the gate: two in four, straight and broken)
    const double width_mm = 4.0 * gear.normal_module_mm;
    const PartShape part = test::helical_part(name, *profile, width_mm, herringbone);
    expect_exact_solid(part, read_back(part));
  }
  EXPECT_GE(made, 10);
}

class HelicalSample : public ::testing::TestWithParam<test::SampleGear> {};

TEST_P(HelicalSample, IsOneExactSolidWithTrueHelicoids) {
  const auto& [name, gear] = GetParam();
  for (const bool herringbone : {false, true}) {
    const ToothProfile profile = profile_of(gear);
    const PartShape part = test::helical_part(name, profile, 8.0, herringbone);
    const TopoDS_Shape shape = read_back(part);
    expect_exact_solid(part, shape);
    const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 8.0, herringbone)};
    const SurfaceErrors errors = surface_errors(shape, toothing);
    EXPECT_EQ(errors.flanks, 2 * gear.teeth * (herringbone ? 2 : 1)) << name;
    EXPECT_LE(errors.flank_mm, 3e-7) << name;  // the contract is 1e-5 mm
    EXPECT_LE(errors.fillet_mm, 1e-6) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, HelicalSample,
    ::testing::Values(test::SampleGear{"planet", test::helical_gear(39, 0.3, 0.26)},
                      test::SampleGear{"steep_pinion", test::helical_gear(9, 0.2, -0.6)},
                      test::SampleGear{"sharp_rack", test::with_root_radius(test::helical_gear(17, 0.0, 0.3), 0.0)},
                      test::SampleGear{"ring", test::helical_ring(60, 0.3, 0.26)},
                      test::SampleGear{"full_round_ring", test::with_root_radius(test::helical_ring(45, 0.0, -0.2), 1.0)},
                      test::SampleGear{"sharp_ring", test::with_root_radius(test::helical_ring(45, 0.0, 0.2), 0.0)}),
    [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace trueflank
