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

/// Which way the diagonals of a net lean: steps across times steps up, over the edges of all
/// facets.
double lean_of(const NetPatch& net) {
  double sum = 0.0;
  for (const auto& facet : net.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const NetNode &a = facet[k], &b = facet[(k + 1) % 3];
      const auto height = [&](const NetNode& node) {
        const auto& rows = net.inner[static_cast<std::size_t>(node.column) % net.inner.size()];
        const auto row = static_cast<std::size_t>(node.row);
        return row == 0 ? 0.0 : row > rows.size() ? 1.0 : rows[row - 1];
      };
      sum += (b.column - a.column) * (height(b) - height(a));
    }
  return sum;
}

std::string figures_of(const ToothingGrid& grid) {
  std::size_t inner = 0, rising = 0, facets = 0;
  double radius = 0.0, height = 0.0, turn = 0.0, lean = 0.0;
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
    for (std::size_t i = 0; i < some; ++i) add(row[(some + i) % row.size()]);
  }
  for (std::size_t k = 0; k < grid.patches().size(); ++k) {
    const auto points = grid.inner_points(k);
    const std::size_t some = points.size() / static_cast<std::size_t>(grid.teeth());
    for (std::size_t i = 0; i < some; ++i) add(points[some + i]);
    inner += some;
    lean += lean_of(grid.patches()[k]);
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
      "%d columns, %zu rows, %zu facets, %zu inside, %zu rising, lean %.5f, at %.6f %.6f %.6f, "
      "%.4f um",
      grid.points_per_tooth(), grid.heights_mm().size(), facets, inner, rising, lean, radius / n,
      height / n, turn / n, 1e3 * grid.chord_error_mm());
  return text;
}

constexpr std::array kKinds = {ToothingKinds{},
                               ToothingKinds{.deviation = true},
                               ToothingKinds{.displacement = true},
                               ToothingKinds{.chamfer = true},
                               ToothingKinds{true, true, true},
                               ToothingKinds{.deviation = true, .chamfer = true}};

/// Few teeth, whose involutes begin on the base circle; rings with straight flanks inside it;
/// modified teeth with chamfers; more heights than nets have.
GearboxDesign chosen_design(int number) {
  GearboxDesign design;
  design.topology = train_topology("gear");
  GearDesign gear{.name = "gear", .face_width_mm = 8.0};
  design.helix_angle_rad = rad_from_deg(number % 2 == 0 ? 20.0 : -12.0);
  if (number >= 100) {  // steep, with few teeth
    design.helix_angle_rad = rad_from_deg((number % 2 == 0 ? 1.0 : -1.0) * (25.0 + 3.0 * (number % 7)));
    gear.teeth = 5 + number % 11;
    gear.shift = std::max(0.0, (14.0 - gear.teeth) / 17.0);
    gear.face_width_mm = 8.0 + 4.0 * (number % 3);
    design.rack.root_radius = 0.1 * (number % 4);
    if (number % 4 == 1) gear.modifications.edge_chamfer_mm = 0.1 + 0.1 * (number % 3);
    if (number % 5 == 2) gear.modifications.crowning_um = 25.0;
  } else if (number < 20) {
    gear.teeth = 6 + number;
    gear.shift = std::max(0.0, (17.0 - gear.teeth) / 17.0) + 0.1 * (number % 3);
  } else if (number < 30) {
    gear.kind = GearKind::kInternal;
    gear.teeth = 16 + 3 * (number - 20);
    design.rack.root_radius = 0.05 * (number % 4);
  } else {
    gear.kind = number % 4 == 1 ? GearKind::kInternal : GearKind::kExternal;
    gear.teeth = 14 + 2 * (number - 30) + (number % 4 == 1 ? 24 : 0);
    gear.shift = 0.3;
    if (number % 3 == 0) design.helix_angle_rad = 0.0;
    design.herringbone = number % 5 == 2 && number % 3 != 0;
    gear.modifications.crowning_um = number % 2 == 0 ? 12.0 : 0.0;
    gear.modifications.profile_crowning_um = number % 3 == 1 ? 6.0 : 0.0;
    gear.modifications.helix_slope_um = number % 5 == 1 ? 9.0 : 0.0;
    gear.modifications.edge_chamfer_mm = number % 4 < 2 ? 0.05 * (1 + number % 5) : 0.0;
    if (number >= 66) {
      gear.teeth = number - 40;
      gear.kind = GearKind::kExternal;
      gear.modifications.tip_relief_um = 6.0 + number % 7;
      gear.modifications.tip_relief_start_diameter_mm =
          gear.teeth / std::cos(design.helix_angle_rad) + 1.2;
      if (number % 4 < 2) gear.modifications.tip_relief_shape = ReliefShape::kLinear;
    }
  }
  design.gears = {gear};
  return design;
}

std::string figures_of_chosen(int number) {
  const auto train = lay_out(chosen_design(number));
  if (!train) return "not laid out";
  const auto shapes = part_shapes(*train);
  if (!shapes) return "no part";
  const Slab& slab = shapes->parts[0].slabs[0];
  const auto* outer = std::get_if<ToothedOutline>(&slab.outer);
  ToothedOutline outline = outer ? *outer : std::get<ToothedOutline>(slab.holes[0]);
  // bends the section at the upper face alone
  const Displacement displacement = [](const std::array<double, 3>& p) {
    return std::array<double, 3>{0.01 * p[2] / 8.0 * std::cos(5.0 * p[0]), 0.0, 0.0};
  };
  const Displacement step = [](const std::array<double, 3>& p) {
    return std::array<double, 3>{p[2] > 4.1 ? 0.02 : 0.0, 0.0, 0.0};
  };
  if (number == 51 || number == 52) outline.displacement = &displacement;
  if (number == 16) outline.displacement = &step;
  std::vector<double> levels{0.0, number < 100 ? 8.0 : outline.twist.face_width_mm};
  const double tolerance_mm = number < 100      ? number % 3 == 2 ? 3e-4 : 2e-3
                              : number % 6 == 0 ? 3e-4
                              : number % 6 < 4  ? 3e-3
                                                : 0.02;
  if (number == 49) {
    levels.clear();
    for (int k = 0; k <= 70; ++k) levels.push_back(8.0 * k / 70.0);
  }
  return figures_of(ToothingGrid(
      outline, levels, tolerance_mm,
      number < 54 || number >= 100 || (number >= 66 && number % 2 == 0) ? GridKind::kFewest : GridKind::kRows));
}

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

TEST(MeshFigures, OfChosenToothingsAreThoseWrittenDown) {
  test::expect_as_recorded(test::kRecordedChosenNets, figures_of_chosen);
}

TEST(MeshFigures, OfRandomToothingsAreThoseWrittenDown) {
  test::expect_as_recorded(test::kRecordedNets, figures_of_seed);
}

}  // namespace
}  // namespace trueflank
