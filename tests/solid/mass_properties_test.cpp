// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mass_properties.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/solid/random_toothing.h"
#include "tests/support/sample_parts.h"
#include "tests/train/prototype_design.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "tests/support/train_members.h"

namespace trueflank {
namespace {

/// Moment of a closed mesh about z: over the tetrahedra from the origin, exact for polyhedra.
double axial_moment_mm5(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double six_volume = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                              a[2] * (b[0] * c[1] - b[1] * c[0]);
    for (int k = 0; k < 2; ++k)
      sum += six_volume / 60.0 * (a[k] * a[k] + b[k] * b[k] + c[k] * c[k] + a[k] * b[k] +
                                  b[k] * c[k] + c[k] * a[k]);
  }
  return sum;
}

TEST(MassProperties, OfARingOfSteelAreTheClosedForm) {
  PartShape tube{"tube", {Slab{0.0, 10.0, CircleOutline{Point2::Zero(), 20.0},
                               {CircleOutline{Point2::Zero(), 15.0}}}}};
  const MassProperties p = mass_properties(tube, 7850.0);
  const double mass = kPi * (0.02 * 0.02 - 0.015 * 0.015) * 0.01 * 7850.0;
  EXPECT_NEAR(p.mass_kg, mass, 1e-12 * mass);
  EXPECT_NEAR(p.axial_inertia_kg_m2, 0.5 * mass * (0.02 * 0.02 + 0.015 * 0.015), 1e-12 * 1.5e-5);
}

/// Moments of a polygon by Green's theorem: area, and the second one about the origin.
std::array<double, 2> polygon_moments(const std::vector<Point2>& points) {
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 &p = points[i], &q = points[(i + 1) % points.size()];
    sum[0] += 0.5 * cross(p, q);
    sum[1] += cross(p, q) / 12.0 * (p.squaredNorm() + p.dot(q) + q.squaredNorm());
  }
  return sum;
}

// The polygon's chords keep within 1e-6 mm of the curves, on their inner or outer side.
TEST(MassProperties, OfTeethAndOffCentreHolesAgreeWithAFinePolygon) {
  for (const auto& [teeth, shift] : {std::pair{9, 0.1}, {39, -0.4}, {90, 0.5}}) {
    Gear gear{.teeth = teeth, .normal_module_mm = 1.0, .shift = shift};
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile);
    const CircleOutline hole{{1.2, -0.7}, 0.8};
    const PartShape part{"gear", {Slab{0.0, 1.0, ToothedOutline{.profile = &*profile}, {hole}}}};
    const MassProperties p = mass_properties(part, 1e9);  // of 1 kg/mm3
    auto [area, polar] = polygon_moments(section_polygon(*profile, 1e-6).points);
    const double cut = kPi * 0.8 * 0.8;
    area -= cut;
    polar -= cut * (0.5 * 0.8 * 0.8 + hole.centre.squaredNorm());
    EXPECT_NEAR(p.volume_mm3 / area, 1.0, 1e-6) << teeth;
    EXPECT_NEAR(p.axial_inertia_kg_m2 * 1e6 / polar, 1.0, 1e-6) << teeth;
  }
}

TEST(MassProperties, OfEveryPartAgreeWithTheIntegralOverItsMesh) {
  GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
  design.gears[0].bore = {.diameter_mm = 4.0};
  design.gears[1].bore = {.diameter_mm = 8.0, .kind = BoreKind::kHex};
  const auto train = lay_out(design);
  ASSERT_TRUE(train.has_value());
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes.has_value());
  for (const PartShape& part : shapes->parts) {
    const MassProperties p = mass_properties(part, 1000.0);
    const PartMesh mesh = part_mesh(part, {.tolerance_mm = 1e-4});
    const double volume = volume_mm3(mesh.mesh);
    EXPECT_NEAR(p.volume_mm3, volume, 2e-5 * volume) << part.name;
    const double moment = axial_moment_mm5(mesh.mesh) * 1e-12;
    EXPECT_NEAR(p.axial_inertia_kg_m2, moment, 3e-5 * moment) << part.name;
  }
}

TEST(MassProperties, GoToTheBodiesOfTheTrain) {
  const auto train = lay_out(test::prototype(0.46, 1.2, 25.66));
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes.has_value());
  BodyInertias bodies = body_inertias(*train, *shapes, [](const PartShape&) { return 7850.0; });
  const auto axial = [&](const char* member) { return test::inertia_of(*train, bodies, member).axial_kg_m2; };
  EXPECT_GT(axial("ring1"), axial("planet"));
  EXPECT_GT(axial("planet"), axial("sun"));
  EXPECT_GT(axial("sun"), 0.0);
  EXPECT_NEAR(test::inertia_of(*train, bodies, "planet").mass_kg, 0.18, 0.03);
}

TEST(MassProperties, CountEveryPartThatTurnsWithAMember) {
  const auto steel = [](const PartShape&) { return 7850.0; };
  GearboxDesign design = test::unshifted("simple", "", {18, 24, 66});
  design.helix_angle_rad = rad_from_deg(20.0);
  design.herringbone = true;
  design.gears[1].bore.diameter_mm = 8.0;
  design.carrier = CarrierDesign{};
  const auto whole = lay_out(design);
  design.gears[2].halves = true;
  const auto halved = lay_out(design);
  ASSERT_TRUE(whole && halved);
  const auto one = part_shapes(*whole), two = part_shapes(*halved);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(two->parts.size(), one->parts.size() + 1);
  BodyInertias a = body_inertias(*whole, *one, steel), b = body_inertias(*halved, *two, steel);
  for (const char* member : {"sun", "planet", "ring", "carrier"}) {
    const BodyInertia first = test::inertia_of(*whole, a, member),
                      second = test::inertia_of(*halved, b, member);
    EXPECT_GT(first.axial_kg_m2, 0.0) << member;
    EXPECT_NEAR(second.axial_kg_m2 / first.axial_kg_m2, 1.0, 1e-9) << member;
    EXPECT_NEAR(second.mass_kg / first.mass_kg, 1.0, 1e-9) << member;
  }
  const int carrier = whole->topology().find_member("carrier");
  double carrier_kg = 0.0;
  int parts = 0;
  for (const Placement& placement : one->assembly) {
    const PartShape& part = one->parts[static_cast<std::size_t>(placement.part)];
    if (part.member != carrier) continue;
    carrier_kg += mass_properties(part, 7850.0).mass_kg;
    ++parts;
  }
  EXPECT_EQ(parts, 5);  // two plates, three pins
  EXPECT_NEAR(test::inertia_of(*whole, a, "carrier").mass_kg, carrier_kg, 1e-9);
}

TEST(MassProperties, OfATwistedGearAreThoseOfTheSpurGearWithItsSection) {
  for (std::uint64_t seed = 700; seed < 712; ++seed) {
    auto random = test::random_toothing(seed);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    const MassProperties twisted = mass_properties(random->part, 7850.0);
    const double exact = test::exact_volume_mm3(random->part);
    EXPECT_NEAR(twisted.volume_mm3 / exact, 1.0, 3e-5);  // modules from 0.3 mm, thin rims
    // Cavalieri: the mesh's volume, its facets off by the tolerance at most
    const double mesh = volume_mm3(part_mesh(random->part, {.tolerance_mm = 2e-4}).mesh);
    EXPECT_NEAR(mesh / exact, 1.0, 3e-4);
    random->outline().twist.turn_rad_per_mm = 0.0;
    const MassProperties spur = mass_properties(random->part, 7850.0);
    EXPECT_NEAR(twisted.volume_mm3 / spur.volume_mm3, 1.0, 1e-12);
    EXPECT_NEAR(twisted.axial_inertia_kg_m2 / spur.axial_inertia_kg_m2, 1.0, 1e-12);
  }
}

TEST(MassProperties, OfModifiedAndChamferedTeethAgreeWithTheIntegralOverTheirMesh) {
  int made = 0;
  for (std::uint64_t seed = 800; made < 6; ++seed) {
    const auto random = test::random_toothing(seed, {.deviation = true, .chamfer = seed % 2 == 0});
    if (!random) continue;
    SCOPED_TRACE(random->text);
    ++made;
    const double volume = mass_properties(random->part, 7850.0).volume_mm3;
    const double mesh = volume_mm3(part_mesh(random->part, {.tolerance_mm = 3e-4}).mesh);
    // what the modifications take away counts: it is ten times more than the tolerance
    EXPECT_NEAR(mesh / volume, 1.0, 2e-4);
  }
}

}  // namespace
}  // namespace trueflank
