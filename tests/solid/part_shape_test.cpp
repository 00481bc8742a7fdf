// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/part_shape.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/train/prototype_design.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

class PartShapeTest : public testing::Test {
 protected:
  PartShapeTest() : design_(test::prototype(0.5225, 1.9967, 25.6826)) {}

  GearDesign& gear(const char* name) {
    return *std::find_if(design_.gears.begin(), design_.gears.end(),
                         [&](const GearDesign& g) { return g.name == name; });
  }
  PartShapes shapes() {
    train_ = std::make_unique<GearTrain>(*lay_out(design_));
    auto made = part_shapes(*train_);
    EXPECT_TRUE(made) << (made ? "" : made.error()[0].message);
    return made ? *made : PartShapes{};
  }
  Errors errors() {
    train_ = std::make_unique<GearTrain>(*lay_out(design_));
    auto made = part_shapes(*train_);
    EXPECT_FALSE(made);
    return made ? Errors{} : made.error();
  }
  void expect_one_error(const std::string& key) {
    const Errors found = errors();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].key, key);
    EXPECT_EQ(found[0].code, ErrorCode::kInfeasible);
    EXPECT_FALSE(found[0].message.empty());
    EXPECT_FALSE(found[0].remedy.empty());
  }

  /// 100 = 12 + 88 teeth give four planets equal spacing, every second one with another offset:
  /// 25 is no multiple of 100 / gcd(100, 88 31 - 81 38) = 2.
  static GearboxDesign four_planets_of_two_kinds() {
    GearboxDesign design =
        test::unshifted("3k", "ring2", {12, 38, 88, 31, 81});
    design.planets = 4;
    return design;
  }

  GearboxDesign design_;
  std::unique_ptr<GearTrain> train_;
};

TEST_F(PartShapeTest, PrototypeHasSunOnePlanetAndTwoRings) {
  const PartShapes made = shapes();
  std::vector<std::string> names;
  for (const PartShape& part : made.parts) names.push_back(part.name);
  EXPECT_EQ(names, (std::vector<std::string>{"sun", "planet", "ring1", "ring2"}));
  ASSERT_EQ(made.assembly.size(), 6U);  // the planet three times
  EXPECT_EQ(std::count_if(made.assembly.begin(), made.assembly.end(),
                          [](const Placement& p) { return p.part == 1; }),
            3);
}

TEST_F(PartShapeTest, PlanetStandsOnThreeSlabsAndItsNeckIsInsideBothRootCircles) {
  const PartShapes made = shapes();
  const auto& slabs = made.parts[1].slabs;
  ASSERT_EQ(slabs.size(), 3U);
  EXPECT_DOUBLE_EQ(slabs[0].z_upper_mm, 10.0);
  EXPECT_DOUBLE_EQ(slabs[1].z_upper_mm, 11.0);
  EXPECT_DOUBLE_EQ(slabs[2].z_upper_mm, 21.0);
  const double neck = std::get<CircleOutline>(slabs[1].outer).radius_mm;
  EXPECT_LT(neck, train_->find("planet1")->profile.root_radius_mm());
  EXPECT_LT(neck, train_->find("planet2")->profile.root_radius_mm());
  EXPECT_GT(neck, train_->find("planet2")->profile.root_radius_mm() - 0.3);
}

/// Nearest distance between the walls of two placed parts at one height, by their polygons' vertices and
/// edges; negative where a vertex of one lies inside the other.
double clearance_mm(const PartShapes& shapes, const Placement& a, const Placement& b, double z) {
  const auto outline = [&](const Placement& p) -> std::vector<Point2> {
    for (const Slab& slab : shapes.parts[static_cast<std::size_t>(p.part)].slabs) {
      const double below = p.translation_mm[2] + slab.z_lower_mm;
      if (z < below || z > p.translation_mm[2] + slab.z_upper_mm) continue;
      const bool ring = std::holds_alternative<CircleOutline>(slab.outer);
      std::vector<Point2> points = outline_loop(ring ? slab.holes[0] : slab.outer, 1e-3).points;
      for (Point2& q : points)
        q = rotated(q, p.rotation_rad) + Point2(p.translation_mm[0], p.translation_mm[1]);
      return points;
    }
    return {};
  };
  const auto in = [](const std::vector<Point2>& polygon, const Point2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
      if ((polygon[i].y() > p.y()) != (polygon[j].y() > p.y()) &&
          p.x() < polygon[i].x() + (polygon[j].x() - polygon[i].x()) * (p.y() - polygon[i].y()) /
                                       (polygon[j].y() - polygon[i].y()))
        inside = !inside;
    return inside;
  };
  const bool ring = shapes.parts[static_cast<std::size_t>(b.part)].name.starts_with("ring");
  const std::vector<Point2> p = outline(a), q = outline(b);
  double nearest = 1e300;
  for (const Point2& v : p) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Point2 along = q[(i + 1) % q.size()] - q[i];
      const double t = std::clamp((v - q[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (q[i] + t * along - v).norm());
    }
    if (in(q, v) != ring) return -1.0;
  }
  return nearest;
}

TEST_F(PartShapeTest, AssemblyIsInMeshWithTheBacklashCentred) {
  design_.backlash_mm = 0.1;
  const PartShapes made = shapes();
  const auto find = [&](const std::string& name) {
    return *std::find_if(made.assembly.begin(), made.assembly.end(),
                         [&](const Placement& p) { return p.name == name; });
  };
  for (const char* planet : {"planet 1", "planet 2", "planet 3"}) {
    // half the backlash on either flank, along the normal: 0.05 cos a_w
    EXPECT_NEAR(clearance_mm(made, find(planet), find("sun"), 5.0), 0.046, 0.004) << planet;
    EXPECT_NEAR(clearance_mm(made, find(planet), find("ring1"), 5.0), 0.046, 0.004) << planet;
    EXPECT_NEAR(clearance_mm(made, find(planet), find("ring2"), 16.0), 0.046, 0.004) << planet;
  }
}

TEST_F(PartShapeTest, PlanetsThatDifferAreMarkedByAsManyHolesAsTheirNumber) {
  design_ = four_planets_of_two_kinds();
  const PartShapes made = shapes();
  ASSERT_EQ(made.parts.size(), 7U);
  for (std::size_t i = 1; i <= 4; ++i) {
    const PartShape& planet = made.parts[i];
    EXPECT_EQ(planet.name, "planet_" + std::to_string(i));
    EXPECT_EQ(planet.slabs.back().holes.size(), i);
    EXPECT_TRUE(mesh_validity(part_mesh(planet).mesh).valid());
  }
  EXPECT_TRUE(made.notes.empty());
}

TEST_F(PartShapeTest, MarkWithoutRoomIsLeftOutAndNoted) {
  design_ = four_planets_of_two_kinds();
  gear("planet1").bore.diameter_mm = 27.6;
  const PartShapes made = shapes();
  EXPECT_EQ(made.notes.size(), 4U);
  EXPECT_EQ(made.parts[1].slabs.size(), 3U);
}

TEST_F(PartShapeTest, WithoutGapTheSmallerSectionStandsOnTheLargerOne) {
  // P2 inside P1's root circle: 39 teeth above 20
  design_ = test::unshifted("3k", "ring2", {12, 39, 90, 20, 71});
  for (GearDesign& g : design_.gears) g.shift.reset();
  gear("ring1").shift = 0.0;
  gear("ring2").shift = 0.0;
  design_.centre_distance_mm = 25.5;
  design_.layer_gap_mm = 0.0;
  const PartShapes made = shapes();
  const auto planet = std::find_if(made.parts.begin(), made.parts.end(),
                                   [](const auto& p) { return p.name.starts_with("planet"); });
  ASSERT_NE(planet, made.parts.end());
  const MeshValidity validity = mesh_validity(part_mesh(*planet).mesh);
  EXPECT_TRUE(validity.valid());
  EXPECT_EQ(validity.components, 1U);
  EXPECT_TRUE(std::holds_alternative<ToothedOutline>(planet->slabs[1].outer));
}

TEST_F(PartShapeTest, WithoutGapCrossingSectionsAreRefused) {
  design_ = test::unshifted("3k", "ring2", {12, 39, 90, 37, 88});
  design_.layer_gap_mm = 0.0;
  expect_one_error("gearbox.layer_gap_mm");
}

TEST_F(PartShapeTest, GapTooSmallForANeckIsRefused) {
  design_.layer_gap_mm = 1e-4;
  expect_one_error("gearbox.layer_gap_mm");
}

TEST_F(PartShapeTest, BoreThatReachesTheRootCircleIsRefusedByItsFarthestPoint) {
  gear("sun").bore.diameter_mm = 9.0;
  expect_one_error("sun.bore_mm");
  gear("sun").bore = {.diameter_mm = 8.0, .kind = BoreKind::kHex};  // its corners: 9.24
  expect_one_error("sun.bore_hex_mm");
  gear("sun").bore = {
      .diameter_mm = 7.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 3.0, .keyway_depth_mm = 1.2};
  expect_one_error("sun.bore_mm");
}

TEST_F(PartShapeTest, BoreOfThePlanetMustFitBothLayers) {
  shapes();
  const double root2 = train_->find("planet2")->profile.root_radius_mm();
  ASSERT_LT(root2 + 0.5, train_->find("planet1")->profile.root_radius_mm());
  gear("planet1").bore.diameter_mm = 2.0 * (root2 - 0.1);  // enough for P1 alone
  expect_one_error("planet1.bore_mm");
}

TEST_F(PartShapeTest, RimTooThinIsRefused) {
  gear("ring1").outer_diameter_mm = 93.8;
  expect_one_error("ring1.outer_diameter_mm");
}

TEST_F(PartShapeTest, BoltsOutsideTheRimOrInTheTeethAreRefused) {
  gear("ring1").outer_diameter_mm = 104.0;
  gear("ring1").bolt_circle = {.count = 6, .circle_diameter_mm = 101.0, .hole_diameter_mm = 4.0};
  expect_one_error("ring1.bolt_circle_diameter_mm");
  gear("ring1").bolt_circle.circle_diameter_mm = 96.0;
  expect_one_error("ring1.bolt_circle_diameter_mm");
  gear("ring1").bolt_circle = {.count = 90, .circle_diameter_mm = 98.8, .hole_diameter_mm = 3.4};
  expect_one_error("ring1.bolt_hole_diameter_mm");
}

TEST_F(PartShapeTest, AllErrorsAreToldAtOnce) {
  gear("sun").bore.diameter_mm = 9.0;
  gear("planet1").bore.diameter_mm = 40.0;
  gear("ring1").outer_diameter_mm = 90.0;
  gear("ring2").outer_diameter_mm = 80.0;
  EXPECT_EQ(errors().size(), 4U);
}

TEST_F(PartShapeTest, RimLeavesRoomForItsBoltsWhereNoDiameterIsGiven) {
  gear("ring1").bolt_circle = {.count = 6, .circle_diameter_mm = 110.0, .hole_diameter_mm = 5.0};
  const PartShapes made = shapes();
  EXPECT_GE(std::get<CircleOutline>(made.parts[2].slabs[0].outer).radius_mm, 57.5 + 1.0);
}

TEST(BoreEdges, FormAClosedOutlineWhoseFlatsAndKeywayFacePlusX) {
  for (const BoreDesign& bore :
       {BoreDesign{.diameter_mm = 8.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 2.0, .keyway_depth_mm = 1.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kDFlat, .d_flat_mm = 7.0},
        BoreDesign{.diameter_mm = 8.0, .kind = BoreKind::kHex}}) {
    const auto edges = bore_edges(bore);
    for (std::size_t i = 0; i < edges.size(); ++i)
      EXPECT_LT((edges[i].to - edges[(i + 1) % edges.size()].from).norm(), 1e-14);
    const OutlineLoop loop = outline_loop(BoreOutline{bore}, 1e-4);
    double area = 0.0, along_x = 0.0;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      area += 0.5 * cross(loop.points[i], loop.points[(i + 1) % loop.points.size()]);
      along_x = std::max(along_x, loop.points[i].x());
    }
    const double circle = kPi * 16.0;
    switch (bore.kind) {  // closed forms
      case BoreKind::kRound: EXPECT_NEAR(area, circle, 2e-3); break;
      case BoreKind::kKeyway: {
        // 2 wide, floor at x = 5, less the part of the circle it already had
        const double mouth = std::sqrt(15.0), had = 16.0 * std::asin(0.25) + mouth;
        EXPECT_NEAR(area, circle + 10.0 - had, 2e-3);
        EXPECT_DOUBLE_EQ(along_x, 5.0);
        break;
      }
      case BoreKind::kDFlat: {
        const double half = std::acos(3.0 / 4.0);
        EXPECT_NEAR(area, circle - (16.0 * half - 3.0 * std::sqrt(7.0)), 2e-3);
        EXPECT_DOUBLE_EQ(along_x, 3.0);
        break;
      }
      case BoreKind::kHex:
        EXPECT_NEAR(area, 2.0 * std::sqrt(3.0) * 16.0, 1e-12);
        EXPECT_NEAR(along_x, 4.0, 1e-14);
        break;
    }
  }
}

TEST(PartShapeGroove, PartsTheHalvesOfAHerringboneBelowTheRoots) {
  for (const bool ring : {false, true}) {
    GearboxDesign design = test::unshifted("gear", "", {39});
    design.helix_angle_rad = rad_from_deg(25.0);
    design.herringbone = true;
    design.relief_groove_mm = 1.5;
    if (ring) design.gears[0].kind = GearKind::kInternal;
    const auto train = lay_out(design);
    ASSERT_TRUE(train);
    const auto shapes = part_shapes(*train);
    ASSERT_TRUE(shapes);
    const auto& slabs = shapes->parts[0].slabs;
    ASSERT_EQ(slabs.size(), 3U);
    EXPECT_DOUBLE_EQ(slabs[1].z_upper_mm - slabs[1].z_lower_mm, 1.5);
    const double root = train->gears[0].profile.root_radius_mm();
    const double floor = std::get<CircleOutline>(ring ? slabs[1].holes[0] : slabs[1].outer).radius_mm;
    EXPECT_DOUBLE_EQ(floor, ring ? root + 0.1 : root - 0.1);
    const PartMesh made = part_mesh(shapes->parts[0]);
    EXPECT_TRUE(mesh_validity(made.mesh).valid());
    EXPECT_LE(measure_accuracy(made.mesh, shapes->parts[0]).largest_mm(), 1e-3);
  }
}

TEST(PartShapeHalves, CloseOverTheApexOfAHerringboneRing) {
  for (const double groove_mm : {0.0, 1.5}) {
    GearboxDesign design = test::unshifted("gear", "", {61});
    design.gears[0].kind = GearKind::kInternal;
    design.helix_angle_rad = rad_from_deg(25.0);
    design.herringbone = true;
    design.relief_groove_mm = groove_mm;
    design.gears[0].bolt_circle = {.count = 6, .circle_diameter_mm = 76.0, .hole_diameter_mm = 3.0};
    const auto whole = lay_out(design);
    design.gears[0].halves = true;
    const auto train = lay_out(design);
    ASSERT_TRUE(whole && train);
    const auto one = part_shapes(*whole), two = part_shapes(*train);
    ASSERT_TRUE(one) << one.error()[0].message;
    ASSERT_TRUE(two) << two.error()[0].message;
    ASSERT_EQ(one->parts.size(), 1U);
    ASSERT_EQ(two->parts.size(), 2U);
    EXPECT_EQ(two->parts[0].name, "gear_lower");
    EXPECT_EQ(two->parts[1].name, "gear_upper");
    double volume = 0.0;
    std::vector<std::array<double, 3>> apex[2];
    for (int i = 0; i < 2; ++i) {
      const PartMesh made = part_mesh(two->parts[i]);
      EXPECT_TRUE(mesh_validity(made.mesh).valid());
      EXPECT_LE(measure_accuracy(made.mesh, two->parts[i]).largest_mm(), 1e-3);
      volume += mass_properties(two->parts[i], 1.0).volume_mm3;
      const double z0 = two->assembly[i].translation_mm[2], face = i == 0 ? 5.0 : 0.0;
      EXPECT_NEAR(z0, i == 0 ? 0.0 : 5.0, 1e-12);
      for (const auto& vertex : made.mesh.vertices)
        if (std::abs(vertex[2] - face) < 1e-9) apex[i].push_back({vertex[0], vertex[1], 0.0});
    }
    EXPECT_NEAR(volume, mass_properties(one->parts[0], 1.0).volume_mm3, 1e-9 * volume);
    // where they meet, both have the same section: every corner of one lies on the other
    ASSERT_FALSE(apex[0].empty());
    double farthest = 0.0;
    for (const auto& p : apex[0]) {
      double nearest = 1e300;
      for (const auto& q : apex[1]) nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1]));
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, 1e-6);
  }
}

}  // namespace
}  // namespace trueflank
