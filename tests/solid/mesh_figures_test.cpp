// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/solid/random_toothing.h"
#include "tests/solid/recorded_nets.h"
#include "tests/support/recorded.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

using test::RandomToothing;
using test::ToothingKinds;

std::string figures_of(const ToothingGrid& grid) {
  std::size_t inner = 0, rising = 0, facets = 0;
  double radius = 0.0, height = 0.0, turn = 0.0;
  std::size_t count = 0;
  const auto add = [&](const std::array<double, 3>& p) {
    radius += std::hypot(p[0], p[1]), height += p[2], turn += std::sin(std::atan2(p[1], p[0]));
    ++count;
  };
  const std::size_t layers = grid.heights_mm().size() - 1;
  for (const double z : grid.heights_mm()) {
    const auto row = grid.row(z);
    const std::size_t some =
        grid.teeth_alike() ? row.size() / static_cast<std::size_t>(grid.teeth()) : row.size();
    for (std::size_t i = 0; i < some; ++i) add(row[i]);
  }
  for (std::size_t k = 0; k < grid.patches().size(); ++k) {
    const auto points = grid.inner_points(k);
    const std::size_t some = points.size() / static_cast<std::size_t>(grid.teeth());
    for (std::size_t i = 0; i < some; ++i) add(points[i]);
    inner += some;
    facets += grid.patches()[k].facets.size();
  }
  const int teeth = grid.teeth_alike() ? 1 : grid.teeth();
  if (grid.patches().empty())
    for (std::size_t k = 0; k < layers; ++k)
      for (int tooth = 0; tooth < teeth; ++tooth)
        for (int i = 0; i < grid.points_per_tooth(); ++i) rising += grid.rises(k, tooth, i) ? 1 : 0;
  const auto n = static_cast<double>(count);
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%d columns, %zu rows, %zu facets, %zu inside, %zu rising, at %.6f %.6f %.6f, %.4f um",
      grid.points_per_tooth(), grid.heights_mm().size(), facets, inner, rising, radius / n,
      height / n, turn / n, 1e3 * grid.chord_error_mm());
  return text;
}

constexpr std::array kKinds = {ToothingKinds{},
                               ToothingKinds{.deviation = true},
                               ToothingKinds{.displacement = true},
                               ToothingKinds{.chamfer = true},
                               ToothingKinds{true, true, true},
                               ToothingKinds{.deviation = true, .chamfer = true}};

std::string figures_of_seed(int seed) {
  const auto kind = static_cast<std::size_t>(seed) % kKinds.size();
  auto random = test::random_toothing(static_cast<std::uint64_t>(seed), kKinds[kind]);
  if (!random) return "";
  const double b = random->outline().twist.face_width_mm;
  const bool rows = seed % 4 == 3;
  if (seed % 5 == 4) random->tolerance_mm *= 0.2;
  const ToothingGrid grid(random->outline(),
                          rows ? std::vector<double>{0.0, 0.4 * b, b} : std::vector<double>{0.0, b},
                          random->tolerance_mm, rows ? GridKind::kRows : GridKind::kFewest);
  return figures_of(grid);
}

TEST(MeshFigures, OfRandomToothingsAreThoseWrittenDown) {
  test::expect_as_recorded(test::kRecordedNets, figures_of_seed);
}

}  // namespace
}  // namespace trueflank
