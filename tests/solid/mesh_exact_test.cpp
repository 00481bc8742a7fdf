// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's exact predicates judge what part_mesh() says of itself.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "tests/solid/random_toothing.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/bed_chamfer.h"

namespace trueflank {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Nothing where CGAL refuses a triangle: then it would not be 2-manifold.
std::optional<Surface> surface_of(const TriangleMesh& mesh) {
  Surface surface;
  for (const auto& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v[0], v[1], v[2]));
  for (const auto& t : mesh.triangles)
    if (surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]),
                         Surface::Vertex_index(t[2])) == Surface::null_face())
      return std::nullopt;
  return surface;
}

void expect_boundary_of_a_solid(const TriangleMesh& mesh) {
  const auto surface = surface_of(mesh);
  ASSERT_TRUE(surface);
  EXPECT_TRUE(CGAL::is_closed(*surface));
  EXPECT_FALSE(PMP::does_self_intersect(*surface));
  EXPECT_TRUE(PMP::does_bound_a_volume(*surface));
  EXPECT_TRUE(PMP::is_outward_oriented(*surface));
  const double volume = PMP::volume(*surface);
  EXPECT_NEAR(volume_mm3(mesh) / volume, 1.0, 1e-10);
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
  for (std::uint64_t seed = 8000; made < 60; ++seed) {
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

TEST(MeshExact, ChamferedAtTheBedPartsBoundSolidsAlsoIn32Bits) {
  int made = 0;
  const auto expect_chamfered_solid = [&](PartShape& part, double module_mm, double tolerance_mm) {
    std::deque<InsetProfile> profiles;
    const auto note = add_bed_chamfer(part, 0.2 * module_mm, 0.5 * module_mm, profiles);
    if (bed_depth_mm(part) == 0.0) return;
    SCOPED_TRACE(note.value_or("as deep as asked"));
    const TriangleMesh mesh = part_mesh(part, {.tolerance_mm = tolerance_mm}).mesh;
    expect_boundary_of_a_solid(mesh);
    expect_boundary_of_a_solid(rounded_to_32_bits(mesh));
    ++made;
  };
  for (std::uint64_t seed = 8200; made < 12; ++seed) {
    auto random = test::random_part(seed);
    if (!random || random->train->gears[0].profile.gear().teeth > 60) continue;
    SCOPED_TRACE(random->text);
    expect_chamfered_solid(random->part, random->train->gears[0].profile.gear().normal_module_mm,
                           std::max(random->tolerance_mm, 1e-3));
  }
  for (std::uint64_t seed = 9200; made < 18; ++seed) {
    auto random = test::random_toothing(seed, {.deviation = seed % 2 == 0});
    if (!random || random->train->gears[0].profile.gear().teeth > 30) continue;
    SCOPED_TRACE(random->text);
    expect_chamfered_solid(random->part, random->train->gears[0].profile.gear().normal_module_mm,
                           4.0 * random->tolerance_mm);
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
