// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/carrier.h"

#include <gtest/gtest.h>

#include "tests/train/prototype_design.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "tests/support/train_members.h"

namespace trueflank {
namespace {

GearboxDesign carried_planets() {
  GearboxDesign design = test::prototype(0.5225, 1.9967, 25.6826);
  design.gears[1].bore.diameter_mm = 19.0;
  design.carrier = CarrierDesign{.plate_thickness_mm = 8.0,
                                 .pin_diameter_mm = 10.0,
                                 .opening_diameter_mm = 20.5,
                                 .bearing_diameter_mm = 32.0,
                                 .bearing_width_mm = 7.0};
  return design;
}

const PartShape& part(const PartShapes& shapes, const std::string& name) {
  for (const PartShape& shape : shapes.parts)
    if (shape.name == name) return shape;
  throw std::runtime_error("no part " + name);
}

TEST(Carrier, HasTwoPlatesAndAPinForEveryPlanet) {
  const auto train = lay_out(carried_planets());
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  int pins = 0;
  for (const Placement& body : shapes->assembly)
    pins += shapes->parts[static_cast<std::size_t>(body.part)].name == "carrier_pin";
  EXPECT_EQ(pins, 3);
  EXPECT_EQ(part(*shapes, "carrier").slabs.size(), 2U);
  EXPECT_EQ(part(*shapes, "carrier_top").slabs.size(), 2U);
}

TEST(Carrier, PartsAreClosedShellsOfTheVolumeOfTheirCylinders) {
  const auto train = lay_out(carried_planets());
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  // disc of 2 (25.6826 + 12.5) mm, pins of 10.02 mm; the seat 7 deep, the opening through 1 mm
  const double disc = kPi * std::pow(25.6826 + 12.5, 2) - 3.0 * kPi * 5.01 * 5.01;
  const double plate = 8.0 * disc - 7.0 * kPi * 16.0 * 16.0 - 1.0 * kPi * 10.25 * 10.25;
  const double pin = kPi * 25.0 * (10.0 + 1.0 + 10.0 + 2.0 * 0.3 + 2.0 * 8.0);
  const std::pair<const char*, double> expected[] = {
      {"carrier", plate}, {"carrier_top", plate}, {"carrier_pin", pin}};
  for (const auto& [name, volume] : expected) {
    const PartMesh made = part_mesh(part(*shapes, name));
    const MeshValidity validity = mesh_validity(made.mesh);
    EXPECT_TRUE(validity.valid()) << name;
    EXPECT_EQ(validity.components, 1U) << name;
    EXPECT_NEAR(volume_mm3(made.mesh), volume, 4e-4 * volume) << name;
  }
}

// -------------------------------------------------------------------- turning without collision

bool inside(const std::vector<Point2>& polygon, const Point2& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

/// Outlines of one slab in the assembly.
struct PlacedSlab {
  std::string body;
  double lower = 0.0, upper = 0.0;
  std::vector<Point2> outer;
  std::vector<std::vector<Point2>> holes;

  [[nodiscard]] bool holds(const Point2& p) const {
    if (!inside(outer, p)) return false;
    for (const auto& hole : holes)
      if (inside(hole, p)) return false;
    return true;
  }
};

std::vector<Point2> placed(const Outline& outline, double rotation, const Point2& centre) {
  std::vector<Point2> points = outline_loop(outline, 0.01).points;
  for (Point2& p : points) p = rotated(p, rotation) + centre;
  return points;
}

std::vector<PlacedSlab> slabs_at(const GearTrain& train, const PartShapes& shapes, double sun_turn) {
  std::vector<PlacedSlab> all;
  for (const Placement& body : shapes.assembly) {
    const PartShape& shape = shapes.parts[static_cast<std::size_t>(body.part)];
    const bool carried = shape.name.starts_with("carrier");
    const bool planet = shape.name.starts_with("planet");
    const double own = shape.name == "sun" ? test::speed_of(train, "sun")
                       : planet            ? test::speed_of(train, "planet")
                       : carried           ? test::speed_of(train, "carrier")
                       : shape.name == "ring2" ? test::speed_of(train, "ring2")
                                               : test::speed_of(train, "ring1");
    const double orbit = planet || carried ? test::speed_of(train, "carrier") : 0.0;
    const Point2 centre = rotated(Point2(body.translation_mm[0], body.translation_mm[1]), orbit * sun_turn);
    const double rotation = body.rotation_rad + own * sun_turn;
    for (const Slab& slab : shape.slabs) {
      PlacedSlab out{body.name, slab.z_lower_mm + body.translation_mm[2],
                     slab.z_upper_mm + body.translation_mm[2], placed(slab.outer, rotation, centre), {}};
      for (const Outline& hole : slab.holes) out.holes.push_back(placed(hole, rotation, centre));
      all.push_back(std::move(out));
    }
  }
  return all;
}

/// Points of one slab's outlines in the material of the other.
int points_inside(const PlacedSlab& a, const PlacedSlab& b) {
  int count = 0;
  for (const Point2& p : a.outer) count += b.holds(p);
  for (const auto& hole : a.holes)
    for (const Point2& p : hole) count += b.holds(p);
  return count;
}

int collisions(const GearTrain& train, const PartShapes& shapes, double sun_turn) {
  const std::vector<PlacedSlab> slabs = slabs_at(train, shapes, sun_turn);
  int count = 0;
  for (const PlacedSlab& a : slabs)
    for (const PlacedSlab& b : slabs)
      if (a.body.starts_with("carrier") && a.body != b.body && a.lower < b.upper && b.lower < a.upper)
        count += points_inside(a, b) + points_inside(b, a);
  return count;
}

TEST(Carrier, TheAssemblyTurnsWithoutRunningIntoIt) {
  const auto train = lay_out(carried_planets());
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(collisions(*train, *shapes, 0.83 * i), 0) << i;
}

TEST(Carrier, ThatTestSeesAPlateInARing) {
  GearboxDesign design = carried_planets();
  design.gears[4].face_width_mm = 12.0;  // ring2 beyond planet2, into the upper plate
  design.carrier->outer_diameter_mm = 86.0;
  const auto train = lay_out(design);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  EXPECT_GT(collisions(*train, *shapes, 0.5), 0);
}

// ------------------------------------------------------------------------------------- errors

void expect_error(const GearboxDesign& design, const std::string& key) {
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_FALSE(shapes) << key;
  EXPECT_EQ(shapes.error().front().key, key);
  EXPECT_EQ(shapes.error().front().code, ErrorCode::kInfeasible);
  EXPECT_FALSE(shapes.error().front().remedy.empty());
}

TEST(Carrier, EveryWallThatIsMissingIsTold) {
  GearboxDesign design = carried_planets();
  design.carrier->pin_diameter_mm = 19.0;
  expect_error(design, "carrier.pin_diameter_mm");
  design = carried_planets();
  design.gears[1].bore = {.diameter_mm = 15.0, .kind = BoreKind::kHex};
  expect_error(design, "carrier.pin_diameter_mm");
  design = carried_planets();
  design.carrier->bearing_diameter_mm = 41.0;
  expect_error(design, "carrier.bearing_diameter_mm");
  design = carried_planets();
  design.carrier->opening_diameter_mm = 32.0;
  expect_error(design, "carrier.bearing_diameter_mm");
  design = carried_planets();
  design.carrier->bearing_width_mm = 7.8;
  expect_error(design, "carrier.bearing_width_mm");
  design = carried_planets();
  design.carrier->outer_diameter_mm = 61.0;
  expect_error(design, "carrier.outer_diameter_mm");
  design = carried_planets();
  design.carrier->bearing_diameter_mm = 0.0;
  design.carrier->opening_diameter_mm = 41.0;
  expect_error(design, "carrier.opening_diameter_mm");
}

TEST(Carrier, ADesignWithoutOneHasNone) {
  GearboxDesign design = carried_planets();
  design.carrier.reset();
  const auto train = lay_out(design);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  EXPECT_EQ(shapes->parts.size(), 4U);
}

}  // namespace
}  // namespace trueflank
