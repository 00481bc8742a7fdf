// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/flank_breaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/sampled_deviation.h"
#include "tests/train/prototype_design.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

constexpr double kTolerance_mm = 1e-3;

struct CrownedGear {
  std::unique_ptr<GearTrain> train;  // the part points into it
  PartShape part;

  [[nodiscard]] ToothedOutline& outline() {
    Slab& slab = part.slabs[0];
    if (auto* outer = std::get_if<ToothedOutline>(&slab.outer)) return *outer;
    return std::get<ToothedOutline>(slab.holes[0]);
  }
  /// Not where a chamfer has taken it away.
  [[nodiscard]] bool has_break(int tooth, int side, double z_mm) {
    const Toothing t = outline().toothing();
    const Curve& curve = t.profile->pieces()[involute_piece(*t.profile)].curve;
    const double at = break_parameter(t, tooth, side, t.deviation->roll_breaks_mm[0], z_mm);
    return (at - curve.begin) * (at - curve.end) < 0.0;
  }
  [[nodiscard]] Point3 on_break(int tooth, int side, double z_mm) {
    const Toothing t = outline().toothing();
    const double at = break_parameter(t, tooth, side, t.deviation->roll_breaks_mm[0], z_mm);
    return Point3(surface_point(t, {tooth, side, involute_piece(*t.profile), at}, z_mm).data());
  }
};

/// Crowned by far more than the relief of its tips is high.
CrownedGear crowned_gear(GearKind kind, double helix_rad, double chamfer_mm) {
  GearboxDesign design = test::unshifted("gear", "", {43});
  design.helix_angle_rad = helix_rad;
  GearDesign& gear = design.gears[0];
  gear.kind = kind;
  gear.face_width_mm = 2.0;
  const double tip_mm = lay_out(design)->gears[0].profile.tip_form_radius_mm();
  gear.modifications = {.tip_relief_um = 3.3,
                        .tip_relief_start_diameter_mm =
                            2.0 * (tip_mm + (kind == GearKind::kExternal ? -0.014 : 0.014)),
                        .tip_relief_shape = ReliefShape::kLinear,
                        .crowning_um = 20.0,
                        .edge_chamfer_mm = chamfer_mm};
  CrownedGear result{std::make_unique<GearTrain>(*lay_out(design)), {}};
  result.part = part_shapes(*result.train)->parts[0];
  return result;
}

TEST(BreakParameter, IsWhereTheSectionOfACrownedToothBends) {
  for (const GearKind kind : {GearKind::kExternal, GearKind::kInternal})
    for (const double z_mm : {0.0, 0.05, 0.3, 1.0, 1.95}) {
      CrownedGear gear = crowned_gear(kind, 0.0, 0.1);
      const Toothing t = gear.outline().toothing();
      const std::size_t flank = involute_piece(*t.profile);
      const double at = break_parameter(t, 3, 1, t.deviation->roll_breaks_mm[0], z_mm);
      const auto slope = [&](double from, double to) {
        const auto turn = [&](double p) { return deviation_turn_rad(t, {3, 1, flank, p}, z_mm); };
        return (turn(to) - turn(from)) / (to - from);
      };
      const double step = 1e-5;  // rad; the relief's slope begins at once
      EXPECT_GT(std::abs(slope(at, at + step) - slope(at - step, at)), 0.01) << z_mm;
      EXPECT_NEAR(slope(at + step, at + 2.0 * step), slope(at, at + step), 1e-6);
      EXPECT_NEAR(slope(at - 2.0 * step, at - step), slope(at - step, at), 1e-6);
    }
}

TEST(FlankBreaks, AColumnOfTheMeshFollowsABreakThatCrowningMoves) {
  for (const GearKind kind : {GearKind::kExternal, GearKind::kInternal})
    for (const double helix_rad : {0.0, 0.3})
      for (const double chamfer_mm : {0.0, 0.1}) {
        CrownedGear gear = crowned_gear(kind, helix_rad, chamfer_mm);
        ToothedOutline outline = gear.outline();
        outline.rotation_rad = 0.0;
        const ToothingGrid grid(outline, {0.0, 2.0}, kTolerance_mm);
        for (const double z_mm : grid.heights_mm()) {
          if (std::min(z_mm, 2.0 - z_mm) < chamfer_mm - 1e-9)
            continue;  // the chamfer takes the break away
          const auto row = grid.row(z_mm);
          for (const int side : {-1, 1}) {
            if (!gear.has_break(5, side, z_mm)) continue;
            double nearest_mm = 1.0;
            const Point3 there = gear.on_break(5, side, z_mm);
            for (const auto& p : row)
              nearest_mm = std::min(nearest_mm, (Point2(p[0], p[1]) - there.head<2>()).norm());
            EXPECT_LT(nearest_mm, 0.26 * kTolerance_mm)
                << z_mm << " " << helix_rad << " " << chamfer_mm;
          }
        }
      }
}

TEST(FlankBreaks, PlacesKeepTheirOrderWhereABreakLeavesTheFlank) {
  CrownedGear gear = crowned_gear(GearKind::kExternal, 0.0, 0.0);
  const Toothing t = gear.outline().toothing();
  FlankDeviation field = *t.deviation;
  field.roll_breaks_mm.push_back(field.roll_breaks_mm[0] - 0.001);
  field.roll_breaks_mm.push_back(t.profile->root_form_roll_length_mm() +
                                 0.005);  // 20 um off the flank at the ends
  Toothing broken = t;
  broken.deviation = &field;
  const FlankBreaks breaks(broken, {0}, {0.0, 1.0, 2.0}, 1e-4);
  EXPECT_EQ(breaks.parameters().size(), 3U);
  const std::size_t flank = involute_piece(*t.profile);
  const Curve& curve = t.profile->pieces()[flank].curve;
  for (const double z_mm : {0.0, 0.4, 1.0, 2.0}) {
    double last = curve.begin;
    for (int i = 0; i <= 1000; ++i) {
      const ToothPlace place{0, 1, flank, std::lerp(curve.begin, curve.end, i / 1000.0)};
      const double drawn = breaks.drawn(broken, place, z_mm).parameter;
      if (i == 0) {
        EXPECT_EQ(drawn, curve.begin);
      } else {
        EXPECT_GT((drawn - last) * (curve.end - curve.begin), 0.0) << z_mm << " " << i;
      }
      last = drawn;
    }
    EXPECT_EQ(last, curve.end);
  }
}

TEST(MeshAccuracyAtBreaks, FindsAMeshWhoseFacetsPassOverALowBreak) {
  for (const GearKind kind : {GearKind::kExternal, GearKind::kInternal}) {
    CrownedGear gear = crowned_gear(kind, 0.0, 0.0);
    FlankDeviation unknown = *gear.outline().deviation;
    unknown.roll_breaks_mm.clear();
    PartShape part = gear.part;
    CrownedGear other{nullptr, part};
    other.outline().deviation = &unknown;
    // a column may come to stand near the break by chance: coarse enough to miss it all the same
    const TriangleMesh mesh = part_mesh(other.part, {.tolerance_mm = 2.0 * kTolerance_mm}).mesh;
    const TriangleTree tree(mesh);
    double off_mm = 0.0;
    for (const double z_mm : {0.03, 0.3, 0.7, 1.0, 1.6}) {
      Point3 p = gear.on_break(0, 1, z_mm);
      p.head<2>() = rotated(p.head<2>(), gear.outline().rotation_rad);
      off_mm = std::max(off_mm, tree.nearest(p).distance_mm);
    }
    ASSERT_GT(off_mm, kTolerance_mm);
    EXPECT_GT(measure_accuracy(mesh, gear.part).surface_to_facets_mm, 0.95 * off_mm);
  }
}

}  // namespace
}  // namespace trueflank
