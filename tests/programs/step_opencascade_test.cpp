// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCASCADE reads what our STEP writer wrote and says whether it is a solid, which one, and how
// far its flanks are from the involute.
#include <gtest/gtest.h>

#include "tests/programs/opencascade_solid.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "tests/support/survey_size.h"
#include "trueflank/design/design_file.h"
#include "trueflank/export/step/step_writer.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

using test::count, test::expect_exact_solid, test::read_back, test::surface_types;

/// Largest distance of points of the shape's faces from the involutes of an untwisted gear.
double largest_flank_error_mm(const TopoDS_Shape& shape, const ToothProfile& profile) {
  const Gear& gear = profile.gear();
  const double r_b = base_radius_mm(gear), psi = base_half_angle_rad(gear);
  const int sense = gear.kind == GearKind::kExternal ? -1 : 1;
  double worst = 0.0;
  int flanks = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
    const BRepAdaptor_Surface surface(TopoDS::Face(it.Current()));
    if (surface.GetType() != GeomAbs_SurfaceOfExtrusion) continue;
    const double u0 = surface.FirstUParameter(), u1 = surface.LastUParameter();
    const double v0 = surface.FirstVParameter(), v1 = surface.LastVParameter();
    const auto point = [&](double u, double v) {
      const gp_Pnt p = surface.Value(u0 + u * (u1 - u0), v0 + v * (v1 - v0));
      return Point2(p.X(), p.Y());
    };
    const double middle = point(0.5, 0.5).norm();
    const double lower = std::min(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
    const double upper = std::max(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
    if (!(middle > lower && middle < upper)) continue;
    ++flanks;
    for (int i = 0; i <= 40; ++i)
      for (const double v : {0.0, 0.37, 1.0}) {
        const Point2 p = point(i / 40.0, v);
        const double inv = involute_function(pressure_angle_at_radius_rad(p.norm(), r_b));
        const double angle = centred_rad(polar_angle_rad(p), kTwoPi / gear.teeth);
        worst = std::max(worst, std::abs(std::abs(angle) - (psi + sense * inv)) * r_b);
      }
  }
  EXPECT_EQ(flanks, 2 * gear.teeth);
  return worst;
}

TEST(StepRead, EverySampleGearIsOneExactSolidWithExactFlanks) {
  for (const auto& [name, gear] : test::sample_gears()) {
    if (!test::is_surveyed(gear.teeth < 80)) continue;  // (as what has fewer, and longest)
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << name;
    const PartShape part = gear.kind == GearKind::kExternal ? test::gear_part(name, *profile, 7.5)
                                                            : test::ring_part(name, *profile, 7.5);
    const TopoDS_Shape shape = read_back(part);
    expect_exact_solid(part, shape);
    // the contract is 1e-5 mm
    EXPECT_LE(largest_flank_error_mm(shape, *profile), 2e-8) << name;
  }
}

TEST(StepRead, AFlankAFilletSideATipAndARootAreOneFaceEach) {
  const auto profile = ToothProfile::make(test::external_gear(39, 0.3));
  ASSERT_TRUE(profile);
  const PartShape part =
      test::gear_part("gear", *profile, 8.0, {BoreOutline{{.diameter_mm = 8.0}}});
  auto types = surface_types(read_back(part));
  EXPECT_EQ(types[GeomAbs_SurfaceOfExtrusion], 4 * 39);
  EXPECT_EQ(types[GeomAbs_Cylinder], 2 * 39 + 1);
  EXPECT_EQ(types[GeomAbs_Plane], 2);
}

TEST(StepRead, BoresOfEveryKindAreExact) {
  const auto profile = ToothProfile::make(test::external_gear(39, 0.3));
  ASSERT_TRUE(profile);
  for (const BoreDesign& bore :
       {BoreDesign{.diameter_mm = 8.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 2.0, .keyway_depth_mm = 1.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kDFlat, .d_flat_mm = 7.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kDFlat, .d_flat_mm = 3.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kHex}}) {
    const PartShape part = test::gear_part("gear", *profile, 8.0, {BoreOutline{bore}});
    expect_exact_solid(part, read_back(part));
  }
}

TEST(StepRead, CompoundPlanetIsOneClosedSolidWithStepFaces) {
  const auto lower = ToothProfile::make(test::external_gear(39, 0.3));
  const auto upper = ToothProfile::make(test::external_gear(32, 0.4));
  ASSERT_TRUE(lower && upper);
  const PartShape part = test::planet_part(*lower, *upper);
  const TopoDS_Shape shape = read_back(part);
  expect_exact_solid(part, shape);
  auto types = surface_types(shape);
  EXPECT_EQ(types[GeomAbs_Plane], 5);  // two ends, two steps, the mark's floor
  EXPECT_EQ(types[GeomAbs_Cylinder], 2 * 39 + 2 * 32 + 3);  // and neck, bore, mark
}

TEST(StepRead, RingWithBoltHolesIsExact) {
  const auto profile = ToothProfile::make(test::ring_gear(90, 0.5225));
  ASSERT_TRUE(profile);
  std::vector<Outline> bolts;
  for (int i = 0; i < 6; ++i)
    bolts.push_back(
        CircleOutline{(profile->root_radius_mm() + 3.0) * unit_vector(kPi * i / 3.0), 1.5});
  const PartShape part = test::ring_part("ring1", *profile, 10.0, bolts);
  const TopoDS_Shape shape = read_back(part);
  expect_exact_solid(part, shape);
  // tip, two flanks, two fillets, root a tooth; rim and bolt holes
  EXPECT_EQ(surface_types(shape)[GeomAbs_Cylinder], 4 * 90 + 7);
}

class StepExample : public ::testing::TestWithParam<std::string> {};

TEST_P(StepExample, EveryPartIsOneExactSolid) {
  const auto design =
      read_design(std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + GetParam() + "/design.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  const auto train = lay_out(*design);
  ASSERT_TRUE(train) << train.error().front().message;
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes) << shapes.error().front().message;
  for (const PartShape& part : shapes->parts) expect_exact_solid(part, read_back(part));
}

INSTANTIATE_TEST_SUITE_P(All, StepExample,
                         ::testing::Values("bilateral_drive", "pinion_8_undercut", "ring_shaper"),
                         [](const auto& example) { return example.param; });

/// A prism whose upper end is turned: its sides are ruled spline surfaces.
Brep turned_prism(double half_mm, double height_mm, double turn_rad) {
  Brep brep;
  std::vector<Point2> corners = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (const double z : {0.0, height_mm})
    for (const Point2& corner : corners) {
      const Point2 p = half_mm * (z == 0.0 ? corner : rotated(corner, turn_rad));
      brep.vertices.emplace_back(p.x(), p.y(), z);
    }
  const auto add_edge = [&](int from, int to) {
    const Point3 along = brep.vertices[to] - brep.vertices[from];
    brep.curves.push_back(LineCurve{brep.vertices[from], along.normalized()});
    brep.edges.push_back({from, to, static_cast<int>(brep.curves.size()) - 1});
  };
  for (int i = 0; i < 4; ++i) add_edge(i, (i + 1) % 4);
  for (int i = 0; i < 4; ++i) add_edge(4 + i, 4 + (i + 1) % 4);
  for (int i = 0; i < 4; ++i) add_edge(i, 4 + i);
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const auto& v = brep.vertices;
    brep.surfaces.push_back(SplineSurface{.degree_u = 1, .degree_v = 1, .count_v = 2,
                                          .poles = {v[i], v[4 + i], v[j], v[4 + j]},
                                          .knots_u = {0, 1}, .knots_v = {0, 1},
                                          .multiplicities_u = {2, 2}, .multiplicities_v = {2, 2}});
    brep.faces.push_back({i, true, {{{i, true}, {8 + j, true}, {4 + i, false}, {8 + i, false}}}});
  }
  brep.surfaces.push_back(PlaneSurface{{Point3::Zero(), -Point3::UnitZ(), Point3::UnitX()}});
  brep.faces.push_back({4, true, {{{3, false}, {2, false}, {1, false}, {0, false}}}});
  brep.surfaces.push_back(PlaneSurface{{{0, 0, height_mm}, Point3::UnitZ(), Point3::UnitX()}});
  brep.faces.push_back({5, true, {{{4, true}, {5, true}, {6, true}, {7, true}}}});
  return brep;
}

TEST(StepRead, SplineSurfacesAreExact) {
  const double half = 3.0, height = 5.0, turn = 0.4;
  Brep solid = turned_prism(half, height, turn);
  ASSERT_TRUE(is_closed(solid));
  std::istringstream text(io::step_text({.name = "prism", .solid = std::move(solid)}));
  STEPControl_Reader reader;
  ASSERT_EQ(reader.ReadStream("prism", text), IFSelect_RetDone);
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  ASSERT_EQ(shape.ShapeType(), TopAbs_SOLID);
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  // corners move on straight lines: a section at t of the height is |1 - t + t e^(i turn)|^2 as large
  const double exact = 4.0 * half * half * height * (1.0 - (1.0 - std::cos(turn)) / 3.0);
  EXPECT_NEAR(properties.Mass(), exact, 1e-6 * exact);
}

}  // namespace
}  // namespace trueflank
