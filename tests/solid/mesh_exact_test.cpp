// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's exact predicates, behind solid_fault(), judge what part_mesh() says of itself.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "tests/solid/random_toothing.h"
#include "tests/support/survey_size.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/solid_fault.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/bed_chamfer.h"

namespace trueflank {
namespace {

void expect_boundary_of_a_solid(const TriangleMesh& mesh) {
  EXPECT_STREQ(to_text(solid_fault(mesh)), to_text(SolidFault::kNone));
}

/// A tetrahedron with a corner at (at, at, at), its facets outwards.
TriangleMesh tetrahedron(double at) {
  TriangleMesh mesh;
  mesh.vertices = {{at, at, at}, {at + 1.0, at, at}, {at, at + 1.0, at}, {at, at, at + 1.0}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TriangleMesh both(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

TEST(SolidFault, IsToldOfTetrahedraWithEachFault) {
  EXPECT_EQ(solid_fault(tetrahedron(0.0)), SolidFault::kNone);
  EXPECT_EQ(solid_fault(both(tetrahedron(0.0), tetrahedron(2.0))), SolidFault::kNone);
  EXPECT_EQ(solid_fault(both(tetrahedron(0.0), tetrahedron(0.1))), SolidFault::kCrossesItself);
  TriangleMesh inside_out = tetrahedron(0.0);
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(solid_fault(inside_out), SolidFault::kInsideOut);
  EXPECT_EQ(solid_fault(both(both(tetrahedron(3.0), tetrahedron(5.0)), inside_out)),
            SolidFault::kInsideOut)
      << "one of three";
  // a facet is missing that takes all the volume seen from the origin, or that takes off from it
  TriangleMesh flat = tetrahedron(0.0), open = tetrahedron(1.0);
  flat.triangles.pop_back();
  EXPECT_EQ(solid_fault(flat), SolidFault::kBroken);
  open.triangles.erase(open.triangles.begin());
  EXPECT_EQ(solid_fault(open), SolidFault::kBroken);
}

TriangleMesh rounded_to_32_bits(TriangleMesh mesh) {
  for (auto& v : mesh.vertices)
    for (double& x : v) x = static_cast<double>(static_cast<float>(x));
  return mesh;
}

TEST(MeshExact, PartsOfTheExamplesBoundSolidsAlsoIn32Bits) {
  int parts = 0;
  for (const auto& folder : std::filesystem::directory_iterator(TRUEFLANK_SOURCE_DIR "/examples")) {
    const auto file = folder.path() / "design.toml";
    if (!std::filesystem::exists(file)) continue;
    const auto design = read_design(file.string());
    ASSERT_TRUE(design) << file;
    const auto train = lay_out(*design);
    ASSERT_TRUE(train) << file;
    const auto shapes = part_shapes(*train);
    ASSERT_TRUE(shapes) << file;
    for (const PartShape& part : shapes->parts)
      for (double tolerance : {2e-2, 1e-3}) {
        // (in the gate the fine ones of every third part)
        if (!test::is_surveyed(tolerance > 1e-2 || parts % 4 == 1)) continue;
        SCOPED_TRACE(file.string() + " " + part.name);
        const TriangleMesh mesh = part_mesh(part, {.tolerance_mm = tolerance}).mesh;
        expect_boundary_of_a_solid(mesh);
        expect_boundary_of_a_solid(rounded_to_32_bits(mesh));
        ++parts;
      }
  }
  EXPECT_GE(parts, 20);
}

TEST(MeshExact, RandomPartsBoundSolidsAlsoIn32Bits) {
  int made = 0;
  for (std::uint64_t seed = 8000; made < test::survey_size(20, 60); ++seed) {
    const auto random = test::random_part(seed);
    if (!random || random->train->gears[0].profile.gear().teeth > 150) continue;
    SCOPED_TRACE(random->text);
    const TriangleMesh mesh =
        part_mesh(random->part, {.tolerance_mm = std::max(random->tolerance_mm, 1e-3)}).mesh;
    expect_boundary_of_a_solid(mesh);
    expect_boundary_of_a_solid(rounded_to_32_bits(mesh));
    ++made;
  }
}

TEST(MeshExact, TwistedModifiedAndDisplacedTeethBoundSolidsAlsoIn32Bits) {
  constexpr std::array kKinds = {test::ToothingKinds{}, test::ToothingKinds{.deviation = true},
                                 test::ToothingKinds{true, true, true}};
  int made = 0;
  for (std::uint64_t seed = 9000; made < 9; ++seed) {
    const auto random = test::random_toothing(seed, kKinds[seed % kKinds.size()]);
    if (!random || random->train->gears[0].profile.gear().teeth > 40) continue;
    SCOPED_TRACE(random->text);
    const TriangleMesh mesh =
        part_mesh(random->part, {.tolerance_mm = 4.0 * random->tolerance_mm}).mesh;
    expect_boundary_of_a_solid(mesh);
    expect_boundary_of_a_solid(rounded_to_32_bits(mesh));
    ++made;
  }
}

/// Strips between rows, stretches of other numbers beside each other, breaks that cross a chamfer.
TEST(MeshExact, TeethWithEdgeChamfersBoundSolidsAlsoIn32Bits) {
  constexpr std::array kKinds = {test::ToothingKinds{.chamfer = true},
                                 test::ToothingKinds{.deviation = true, .chamfer = true}};
  int made = 0;
  const int asked = test::survey_size(6, 24);
  for (std::uint64_t seed = 9500; made < asked; ++seed) {
    auto random = test::random_toothing(seed, kKinds[seed % kKinds.size()]);
    if (!random || random->train->gears[0].profile.gear().teeth > 40) continue;
    // wider ones are more than some of these teeth hold
    const double module_mm = random->train->gears[0].profile.gear().normal_module_mm;
    if (random->outline().edge_chamfer_mm > 0.1 * module_mm) continue;
    SCOPED_TRACE(random->text);
    const double tolerance_mm = (seed % 3 == 0 ? 0.5 : 2.0) * random->tolerance_mm;
    const PartMesh made_mesh = part_mesh(random->part, {.tolerance_mm = tolerance_mm});
    EXPECT_LE(measure_accuracy(made_mesh.mesh, random->part).largest_mm(), tolerance_mm);
    expect_boundary_of_a_solid(made_mesh.mesh);
    expect_boundary_of_a_solid(rounded_to_32_bits(made_mesh.mesh));
    ++made;
  }
}

TEST(MeshExact, ChamferedAtTheBedPartsBoundSolidsAlsoIn32Bits) {
  int made = 0;
  // whether a chamfer fits the part
  const auto expect_chamfered_solid = [](PartShape& part, double module_mm, double tolerance_mm) {
    std::deque<InsetProfile> profiles;
    const auto note = add_bed_chamfer(part, 0.2 * module_mm, 0.5 * module_mm, profiles);
    if (bed_depth_mm(part) == 0.0) return false;
    SCOPED_TRACE(note.value_or("as deep as asked"));
    const TriangleMesh mesh = part_mesh(part, {.tolerance_mm = tolerance_mm}).mesh;
    expect_boundary_of_a_solid(mesh);
    expect_boundary_of_a_solid(rounded_to_32_bits(mesh));
    return true;
  };
  for (std::uint64_t seed = 8200; made < 12; ++seed) {
    auto random = test::random_part(seed);
    if (!random || random->train->gears[0].profile.gear().teeth > 60) continue;
    SCOPED_TRACE(random->text);
    const double module_mm = random->train->gears[0].profile.gear().normal_module_mm;
    if (expect_chamfered_solid(random->part, module_mm, std::max(random->tolerance_mm, 1e-3)))
      ++made;
  }
  for (std::uint64_t seed = 9200; made < 18; ++seed) {
    auto random = test::random_toothing(seed, {.deviation = seed % 2 == 0});
    if (!random || random->train->gears[0].profile.gear().teeth > 30) continue;
    SCOPED_TRACE(random->text);
    const double module_mm = random->train->gears[0].profile.gear().normal_module_mm;
    if (expect_chamfered_solid(random->part, module_mm, 4.0 * random->tolerance_mm)) ++made;
  }
}

TEST(MeshExact, FinestAndCoarsestToleranceAndTheLargestGearBoundSolids) {
  GearboxDesign design;
  design.topology = train_topology("gear");
  for (int teeth : {5, 500}) {
    GearDesign gear;
    gear.name = "gear";
    gear.teeth = teeth;
    gear.shift = teeth < 10 ? 0.6 : 0.0;
    gear.bore = {.diameter_mm = teeth < 10 ? 2.0 : 100.0};
    design.gears = {gear};
    const auto train = lay_out(design);
    ASSERT_TRUE(train);
    const auto shapes = part_shapes(*train);
    ASSERT_TRUE(shapes);
    for (double tolerance : {5e-2, teeth < 10 ? 5e-5 : 1e-3})
      expect_boundary_of_a_solid(part_mesh(shapes->parts[0], {.tolerance_mm = tolerance}).mesh);
  }
}

}  // namespace
}  // namespace trueflank
