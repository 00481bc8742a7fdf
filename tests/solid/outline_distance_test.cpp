// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/outline_distance.h"

#include <gtest/gtest.h>

#include "tests/solid/random_part.h"

namespace trueflank {
namespace {

std::vector<Outline> outlines_of(const PartShape& part) {
  std::vector<Outline> outlines = part.slabs[0].holes;
  outlines.push_back(part.slabs[0].outer);
  return outlines;
}

TEST(OutlineDistance, StepAlongTheNormalIsTheDistance) {
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const auto random = test::random_part(seed);
    if (!random) continue;
    test::RandomNumbers numbers(seed + 7000);
    const double module = random->train->design.module_mm;
    for (const Outline& outline : outlines_of(random->part)) {
      const OutlineDistance distance(outline);
      for (int i = 0; i < 100; ++i) {
        const auto& pieces = distance.pieces();
        const auto index = static_cast<std::size_t>(numbers.between(0, 0.999999) *
                                                    static_cast<double>(pieces.size()));
        const Curve& curve = pieces[index].curve;
        const double at = curve.begin + (curve.end - curve.begin) * numbers.between(0.05, 0.95);
        const Point2 on = point_at(curve, at);
        const Point2 out = -perpendicular(tangent_at(curve, at));
        // a step far below the radii of curvature, the width of a gap and the rest of the piece
        const double most = std::min(2e-3 * module, 0.02 * pieces[index].length_mm);
        const double step = most * numbers.between(-1.0, 1.0);
        const int copy = static_cast<int>(numbers.between(0, 0.999999) * distance.copies());
        const OutlineFoot foot = distance.foot(distance.to_outline(on + step * out, copy));
        ASSERT_NEAR(foot.distance_mm, step, 2e-9 * std::max(1.0, module))
            << random->text << " piece " << index;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 10000);
}

TEST(OutlineDistance, AgreesWithTheNearestOfManySamples) {
  for (std::uint64_t seed = 200; seed < 230; ++seed) {
    const auto random = test::random_part(seed);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    test::RandomNumbers numbers(seed);
    const double module = random->train->design.module_mm;
    for (const Outline& outline : outlines_of(random->part)) {
      const OutlineDistance distance(outline);
      for (int i = 0; i < 5; ++i) {
        const auto& pieces = distance.pieces();
        const auto index = static_cast<std::size_t>(numbers.between(0, 0.999999) *
                                                    static_cast<double>(pieces.size()));
        const Point2 near_by = point_at(pieces[index].curve, pieces[index].curve.begin);
        const int copy = static_cast<int>(numbers.between(0, 0.999999) * distance.copies());
        const Point2 p = distance.to_outline(
            near_by + 0.1 * module * Point2(numbers.between(-1, 1), numbers.between(-1, 1)), copy);
        double nearest = 1e300, spacing = 0.0;
        for (int c = 0; c < distance.copies(); ++c)
          for (const auto& piece : pieces) {
            constexpr int kSamples = 300;
            Point2 last = Point2::Zero();
            for (int k = 0; k <= kSamples; ++k) {
              const double t = piece.curve.begin + (piece.curve.end - piece.curve.begin) * k / kSamples;
              const Point2 q = distance.to_outline(point_at(piece.curve, t), c);
              if (k > 0) spacing = std::max(spacing, (q - last).norm());
              last = q;
              nearest = std::min(nearest, (p - q).norm());
            }
          }
        const double found = std::abs(distance.foot(p).distance_mm);
        EXPECT_LE(found, nearest + 1e-9 * module);
        EXPECT_GE(found, nearest - 0.5 * spacing);
        EXPECT_LE(distance.lower_bound_mm(p), found + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace trueflank
