// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_difference.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "tests/train/prototype_design.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {
namespace {

class MeshDifferenceParts : public testing::Test {
 protected:
  void SetUp() override {
    train_ = std::make_unique<GearTrain>(*lay_out(test::bored_prototype()));
    shapes_ = *part_shapes(*train_);
  }
  [[nodiscard]] TriangleMesh mesh(std::size_t part) const {
    return part_mesh(shapes_.parts[part], {.tolerance_mm = kTolerance}).mesh;
  }
  /// The difference after every vertex (r, angle, z) has been moved as told.
  [[nodiscard]] MeshDifference after(std::size_t part,
                                     const std::function<void(double&, double&, double&)>& move) const {
    const TriangleMesh golden = mesh(part);
    TriangleMesh moved = golden;
    for (auto& v : moved.vertices) {
      double r = std::hypot(v[0], v[1]), angle = std::atan2(v[1], v[0]);
      move(r, angle, v[2]);
      v[0] = r * std::cos(angle);
      v[1] = r * std::sin(angle);
    }
    comparison_ = compare_meshes(golden, moved, {.tolerance_mm = kTolerance});
    return mesh_difference(golden, moved, comparison_, {.tolerance_mm = kTolerance});
  }
  static constexpr double kTolerance = 2e-3;
  mutable MeshComparison comparison_;
  std::unique_ptr<GearTrain> train_;
  PartShapes shapes_;
};

TEST_F(MeshDifferenceParts, ThickerFlankOfOneToothIsNamed) {
  const ToothProfile& sun = train_->gears[0].profile;
  const double pitch = kTwoPi / 12, middle = 0.5 * (sun.tip_radius_mm() + sun.root_radius_mm());
  // tooth 3 stands at two pitches; its left flank, tip up, is the counter-clockwise one
  const auto d = after(0, [&](double r, double& angle, double) {
    const double from = centred_rad(angle - 2 * pitch);
    if (std::abs(r - middle) < 0.6 && from > 0.0 && from < 0.5 * pitch) angle += 0.03 / r;
  });
  EXPECT_EQ(d.place, "left flank of tooth 3");
  EXPECT_TRUE(d.across_axis && d.on_teeth);
  EXPECT_GT(d.worst_deviation_mm, 0.02);
  EXPECT_LE(d.worst_deviation_mm, 0.03);
  ASSERT_EQ(d.regions.size(), 4u);
  EXPECT_EQ(d.regions[0].teeth_off, 1);  // left flanks
  EXPECT_EQ(d.regions[1].teeth_off, 0);
  EXPECT_EQ(d.regions[2].teeth_off, 0);
  EXPECT_EQ(d.regions[3].teeth_off, 0);
}

TEST_F(MeshDifferenceParts, FlanksOfARingAreNamedWithItsTipUp) {
  const ToothProfile& ring = train_->gears[2].profile;
  const double pitch = kTwoPi / 90, middle = 0.5 * (ring.tip_radius_mm() + ring.root_radius_mm());
  // tooth 90, the last: one pitch back; thinner on the counter-clockwise side, which is its right one
  const auto d = after(2, [&](double r, double& angle, double) {
    const double from = centred_rad(angle + pitch);
    if (std::abs(r - middle) < 0.6 && from > 0.0 && from < 0.5 * pitch) angle -= 0.02 / r;
  });
  ASSERT_TRUE(d.teeth);
  EXPECT_TRUE(d.teeth->internal);
  EXPECT_EQ(d.teeth->count, 90);
  EXPECT_EQ(d.place, "right flank of tooth 90");
  EXPECT_LT(d.worst_deviation_mm, -0.012);
}

TEST_F(MeshDifferenceParts, TipsAndRootsAreCountedOnEveryTooth) {
  const ToothProfile& sun = train_->gears[0].profile;
  const auto tips = after(0, [&](double& r, double, double) {
    if (r > sun.tip_radius_mm() - 1e-6) r -= 0.05;
  });
  EXPECT_TRUE(tips.place.starts_with("tip of tooth ")) << tips.place;
  EXPECT_NEAR(tips.worst_deviation_mm, -0.05, 1e-3);
  EXPECT_EQ(tips.regions[2].teeth_off, 12);
  const auto roots = after(0, [&](double& r, double, double) {
    if (r < sun.root_radius_mm() + 1e-6 && r > 3.0) r += 0.04;
  });
  EXPECT_TRUE(roots.place.starts_with("root between teeth ")) << roots.place;
  EXPECT_NEAR(roots.worst_deviation_mm, 0.04, 1e-3);
  EXPECT_EQ(roots.regions[3].teeth_off, 12);
}

TEST_F(MeshDifferenceParts, BoreRimAndHoleAreNotTeeth) {
  const auto bore = after(0, [](double& r, double, double) {
    if (r < 3.0) r += 0.1;
  });
  EXPECT_EQ(bore.place, "bore");
  EXPECT_NEAR(bore.worst_deviation_mm, -0.1, 1e-3);
  const double rim_radius = shapes_.parts[2].slabs.empty() ? 0.0 : comparison_.golden.upper_mm[0];
  EXPECT_GT(rim_radius, 0.0);
  const auto rim = after(2, [&](double& r, double, double) {
    if (r > 51.5) r += 0.07;
  });
  EXPECT_EQ(rim.place, "rim");
  EXPECT_NEAR(rim.worst_deviation_mm, 0.07, 1e-3);
  const auto hole = after(2, [](double& r, double& angle, double) {
    // the hole on +x, 3.2 mm wide, moved outwards
    if (std::abs(r - 49.5) < 1.7 && std::abs(r * angle) < 1.7) r += 0.3;
  });
  EXPECT_TRUE(hole.place.starts_with("hole at radius 49.")) << hole.place;
}

TEST_F(MeshDifferenceParts, WiderFaceIsShownAlongTheAxis) {
  const auto d = after(0, [](double, double, double& z) {
    if (z > 5.0) z += 0.2;
  });
  EXPECT_FALSE(d.across_axis);
  EXPECT_TRUE(d.place.starts_with("face at z = ")) << d.place;
  EXPECT_NEAR(d.worst_deviation_mm, 0.2, 1e-9);
  EXPECT_NEAR(d.worst.y(), comparison_.made.upper_mm[2], 1e-9);
}

TEST(MeshSection, BoxCutAnywhereHasItsArea) {
  TriangleMesh box;
  for (int i = 0; i < 8; ++i)
    box.vertices.push_back({2.0 * (i & 1), 3.0 * ((i >> 1) & 1), 4.0 * ((i >> 2) & 1)});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  ASSERT_NEAR(volume_mm3(box), 24.0, 1e-12);
  const auto area = [](const MeshSection& section) {
    double twice = 0.0;
    for (const auto& loop : section.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
    return 0.5 * twice;
  };
  // heights of vertices included: they count as above
  for (double z : {1e-9, 1.0, 3.999, 4.0}) {
    const MeshSection section = mesh_section(box, {.origin_mm = {0.0, 0.0, z}});
    EXPECT_TRUE(section.closed);
    EXPECT_NEAR(area(section), 6.0, 1e-12) << z;
    EXPECT_TRUE(in_material(section, {1.0, 1.0}));
    EXPECT_FALSE(in_material(section, {2.1, 1.0}));
  }
  EXPECT_TRUE(mesh_section(box, {.origin_mm = {0.0, 0.0, 5.0}}).loops.empty());
  const MeshSection along =
      mesh_section(box, {.origin_mm = {1.0, 0.0, 0.0}, .u = {0.0, 1.0, 0.0}, .v = {0.0, 0.0, 1.0}});
  EXPECT_NEAR(area(along), 12.0, 1e-12);
  box.triangles.pop_back();
  EXPECT_FALSE(mesh_section(box, {.origin_mm = {0.0, 0.0, 1.0}}).closed);
}

TEST(SectionTeeth, HexagonKeyAndCircleAreNoTeeth) {
  MeshSection section;
  section.loops.resize(2);
  for (int i = 0; i < 200; ++i) section.loops[0].push_back(20.0 * unit_vector(kTwoPi * i / 200));
  for (int i = 0; i < 6; ++i) section.loops[1].push_back(5.0 * unit_vector(-kTwoPi * i / 6));
  EXPECT_FALSE(find_teeth(section));
}

}  // namespace
}  // namespace trueflank
