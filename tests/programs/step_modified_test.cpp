// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCASCADE reads modified, chamfered and displaced teeth and compound helical planets.
#include <gtest/gtest.h>

#include <chrono>

#include "tests/programs/opencascade_solid.h"
#include "tests/support/flank_distance.h"
#include "tests/support/sample_gears.h"
#include "tests/support/survey_size.h"

namespace trueflank {
namespace {

using test::expect_exact_solid, test::expect_solid, test::read_back, test::profile_of;

/// Largest distance [mm] of the flank faces' points from where the field has them.
double flank_error_mm(const TopoDS_Shape& shape, const Toothing& toothing,
                      const test::WantedDeviation& wanted, int& flanks) {
  const ToothProfile& profile = *toothing.profile;
  const double low = std::min(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  const double high = std::max(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  double worst = 0.0;
  flanks = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
    const BRepAdaptor_Surface s(TopoDS::Face(it.Current()));
    if (s.GetType() != GeomAbs_BSplineSurface) continue;
    const auto point = [&](double u, double v) -> std::array<double, 3> {
      const gp_Pnt p = s.Value(s.FirstUParameter() + u * (s.LastUParameter() - s.FirstUParameter()),
                               s.FirstVParameter() + v * (s.LastVParameter() - s.FirstVParameter()));
      return {p.X(), p.Y(), p.Z()};
    };
    const auto radius = [&](double u) { return std::hypot(point(u, 0.5)[0], point(u, 0.5)[1]); };
    if (!(radius(0.5) > low && radius(0.5) < high) || std::abs(radius(0.0) - radius(1.0)) < 1e-3)
      continue;
    ++flanks;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 13; ++j)
        worst = std::max(worst, test::flank_error_mm(toothing, point(i / 20.0, j / 13.0), wanted));
  }
  return worst;
}


TEST(StepModified, CrowningReliefAndEndReliefAreWhereTheFieldHasThem) {
  for (const double helix : {0.0, 0.26})
    for (const bool ring : {false, true}) {
      if (!test::is_surveyed((helix == 0.0) == ring)) continue;
      const Gear gear = ring ? test::helical_ring(36, 0.3, helix) : test::helical_gear(15, 0.3, helix);
      const ToothProfile profile = profile_of(gear);
      const double start =
          0.5 * (profile.tip_form_roll_length_mm() + profile.root_form_roll_length_mm());
      const FlankDeviation field = test::sample_modifications(gear, 9.0, start);
      const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 9.0, false),
                              .deviation = &field};
      const PartShape part = test::toothed_part(ring ? "ring" : "gear", toothing);
      const TopoDS_Shape shape = read_back(part);
      double volume = test::toothing_volume_mm3(toothing, field.z_breaks_mm);
      if (ring) volume = 9.0 * test::area_mm2(part.slabs[0].outer) - volume;
      expect_solid(part, shape, volume);
      int flanks = 0;
      EXPECT_LE(flank_error_mm(shape, toothing, field.deviation_mm, flanks), 1e-6);
      EXPECT_EQ(flanks, 2 * gear.teeth * 2 * 3);
    }
}

TEST(StepModified, AReliefThatIsTheSameOverTheFaceIsExtruded) {
  const Gear gear = test::external_gear(25, 0.1);
  const ToothProfile profile = profile_of(gear);
  const double start =
      0.5 * (profile.tip_form_roll_length_mm() + profile.root_form_roll_length_mm());
  FlankDeviation relief = test::sample_modifications(gear, 9.0, start, 0.0);
  const auto at_mid_face = relief.deviation_mm;
  relief.deviation_mm = [=](int tooth, Flank flank, double roll, double) {
    return at_mid_face(tooth, flank, roll, 4.5);
  };
  relief.varies_along_face = false;
  relief.z_breaks_mm = {};
  const Toothing toothing{.profile = &profile, .twist = {.face_width_mm = 9.0},
                          .deviation = &relief};
  ASSERT_TRUE(toothing.prismatic());
  const PartShape part = test::toothed_part("gear", toothing);
  const TopoDS_Shape shape = read_back(part);
  expect_solid(part, shape, 9.0 * test::section_area_mm2(toothing, 0.0));
  EXPECT_EQ(test::surface_types(shape)[GeomAbs_SurfaceOfExtrusion], 25 * 6);
}

TEST(StepModified, RoundedTipsAreExact) {
  for (const double helix : {0.0, 0.26})
    for (Gear gear : {test::helical_gear(17, 0.1, helix), test::helical_ring(40, 0.3, helix)}) {
      gear.tip_rounding_mm = 0.12;
      const ToothProfile profile = profile_of(gear);
      const PartShape part = test::helical_part("rounded", profile, 6.0);
      expect_exact_solid(part, read_back(part));
    }
}

TEST(StepModified, EdgeChamfersAndAHerringboneTogether) {
  const Gear gear = test::helical_gear(17, 0.2, 0.3);
  const ToothProfile profile = profile_of(gear);
  const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 8.0, true),
                          .edge_chamfer_mm = 0.15};
  const PartShape part = test::toothed_part("gear", toothing);
  const TopoDS_Shape shape = read_back(part);
  expect_solid(part, shape, test::toothing_volume_mm3(toothing, {0.15, 4.0, 7.85}));
  int flanks = 0;
  EXPECT_LE(flank_error_mm(shape, toothing, {}, flanks), 1e-6);
  EXPECT_EQ(flanks, 2 * 17 * 4);
}

TEST(StepModified, ADisplacedToothingIsOneValidSolid) {
  const Gear gear = test::helical_gear(14, 0.2, 0.2);
  const ToothProfile profile = profile_of(gear);
  const double scale = 1.002;
  const Displacement bent = [=](const std::array<double, 3>& p) -> std::array<double, 3> {
    // keeps areas but for the scale: shears in turn
    const double x = scale * p[0] + 0.01 * std::sin(0.3 * p[1] + 0.1 * p[2]);
    return {x - p[0], (scale - 1.0) * p[1] + 0.008 * std::cos(0.2 * x), 0.0};
  };
  const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 6.0, false),
                          .displacement = &bent};
  const PartShape part = test::toothed_part("gear", toothing);
  const ToothedOutline plain{.profile = &profile};
  expect_solid(part, read_back(part), 6.0 * scale * scale * test::area_mm2(plain));
}

TEST(StepModified, ACompoundHelicalPlanetIsOneExactSolid) {
  const ToothProfile lower = profile_of(test::helical_gear(39, 0.3, 0.26));
  const ToothProfile upper = profile_of(test::helical_gear(32, 0.4, -0.2));
  PartShape part = test::planet_part(lower, upper);
  for (Slab& slab : part.slabs)
    if (auto* teeth = std::get_if<ToothedOutline>(&slab.outer)) {
      const bool first = teeth->profile == &lower;
      teeth->z_lower_mm = first ? 0.0 : 11.0;
      teeth->twist = face_twist(teeth->profile->gear(), first ? 10.0 : 9.5, !first);
    }
  expect_exact_solid(part, read_back(part));
}

TEST(StepModified, APlanetOfHelicalTeethIsSmallAndQuicklyWritten) {
  const ToothProfile profile = profile_of(test::helical_gear(39, 0.3, 0.26));
  const PartShape part = test::helical_part("planet", profile, 8.0, false,
                                            {BoreOutline{{.diameter_mm = 8.0}}});
  const auto begin = std::chrono::steady_clock::now();
  auto solid = brep_of(part);
  ASSERT_TRUE(solid);
  const std::string text = io::step_text({.name = "planet", .solid = std::move(*solid)});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(text.size(), 1000000U);
  EXPECT_LT(took.count(), 1.0);
}

}  // namespace
}  // namespace trueflank
