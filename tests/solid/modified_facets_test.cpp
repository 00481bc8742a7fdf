// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets of modified teeth against the least number there can be.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/solid/least_facets.h"
#include "tests/solid/random_toothing.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

using test::RandomNumbers;

struct Ratio {
  double facets = 0.0, least = 0.0;
};

const ToothedOutline& toothed(const PartShape& part) {
  const Slab& slab = part.slabs[0];
  if (const auto* outer = std::get_if<ToothedOutline>(&slab.outer)) return *outer;
  return std::get<ToothedOutline>(slab.holes[0]);
}

/// Of one tooth.
Ratio facets_of(const PartShape& part, double tolerance_mm) {
  const ToothedOutline& outline = toothed(part);
  const Toothing toothing = outline.toothing();
  const double width = toothing.twist.face_width_mm,
               tolerance = meshing_tolerance_mm(part, tolerance_mm);
  const ToothingGrid grid(outline, {0.0, width}, tolerance);
  Ratio ratio;
  if (grid.patches().empty())
    ratio.facets =
        2.0 * static_cast<double>(grid.heights_mm().size() - 1) * grid.points_per_tooth();
  for (const NetPatch& patch : grid.patches())
    ratio.facets += static_cast<double>(patch.facets.size());
  std::vector<double> breaks{0.0, width};
  if (toothing.twist.herringbone) breaks.push_back(0.5 * width);
  for (const double z : {toothing.edge_chamfer_mm, width - toothing.edge_chamfer_mm})
    if (toothing.edge_chamfer_mm > 0.0) breaks.push_back(z);
  if (toothing.has_deviation())
    for (const double z : toothing.deviation->z_breaks_mm)
      if (z > 0.0 && z < width) breaks.push_back(z);
  std::sort(breaks.begin(), breaks.end());
  const test::LeastFacets least(toothing, tolerance);
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    if (breaks[k + 1] - breaks[k] > 1e-6) ratio.least += least.between(breaks[k], breaks[k + 1]);
  return ratio;
}

/// Facets of a surface of one form between two rows one step apart, their vertices on a lattice:
/// all that keep the tolerance by their edges (on a dome over the circumcentre) are tried.
void expect_bound(double across, double mixed, double along) {
  constexpr double kTolerance = 0.125, kRoom = 8.0 * kTolerance;  // a room of 1
  constexpr int kLevels = 6, kLattice = 16;                       // between the rows; to a chord
  const double chord = 1.0 / std::sqrt(std::abs(across)), step = chord / kLattice;
  const double reach = test::reach_on_row(across, mixed, along, kRoom),
               area = test::most_area(across, mixed, along, kTolerance);
  const int most = static_cast<int>((2.0 * reach + chord) / step);
  const auto off = [&](double u, double v) {
    return (across * u * u + 2.0 * mixed * u * v + along * v * v) / 8.0;
  };
  double largest = 0.0, farthest = 0.0;
  for (int first = 0; first <= kLevels; ++first)
    for (int second = first; second <= kLevels; ++second)
      for (int i = -most; i <= most; ++i) {
        const double u = i * step, v = static_cast<double>(second - first) / kLevels;
        if (std::abs(off(u, v)) > kTolerance || (second == first && i <= 0)) continue;
        for (int third = 0; third <= kLevels; ++third)
          for (int k = -most; k <= most; ++k) {
            const double w = k * step, h = static_cast<double>(third - first) / kLevels;
            const double a = off(u, v), b = off(w - u, h - v), c = off(w, h);
            if (std::max(std::abs(b), std::abs(c)) > kTolerance ||
                std::abs(triangle_error(a, b, c)) > kTolerance)
              continue;
            largest = std::max(largest, 0.5 * std::abs(u * h - v * w));
            if (first == second && first % kLevels == 0) farthest = std::max({farthest, -w, w - u});
          }
      }
  EXPECT_LT(largest, 1.001 * area) << across << ' ' << mixed << ' ' << along;
  EXPECT_LT(farthest, 1.001 * reach) << across << ' ' << mixed << ' ' << along;
  EXPECT_GT(largest, 0.85 * area) << "of a patch as high as a facet";
  EXPECT_GT(farthest, 0.5 * reach);
}

TEST(LeastFacets, NoFacetOfALatticeCoversOrReachesMore) {
  expect_bound(4.0, 0.0, 0.9);
  expect_bound(-4.0, 1.0, -1.2);
  expect_bound(3.0, 0.0, -2.0);
  expect_bound(3.0, 2.0, -1.5);
  expect_bound(-2.0, 2.5, 0.5);
  expect_bound(2.0, 3.0, 1.0);
}

enum class Kind { kCrowned, kProfile, kMixed, kChamfered, kOnlyChamfered };

/// Of a single gear: where a tooth has few facets all is rounding to whole chords and steps.
double worst_of(Kind kind) {
  return kind == Kind::kProfile ? 1.8 : kind == Kind::kChamfered || kind == Kind::kOnlyChamfered ? 3.0 : 2.4;
}

/// A gear or ring with modifications of a kind; empty where it cannot be laid out.
std::optional<GearboxDesign> modified(std::uint64_t seed, Kind kind, bool spur) {
  RandomNumbers random(seed);
  GearboxDesign design;
  design.topology = train_topology("gear");
  design.module_mm = random.log_between(0.5, 4.0);
  const double m = design.module_mm, um = 1e3 * m;
  design.helix_angle_rad =
      spur ? 0.0 : rad_from_deg((random.chance(0.5) ? 1.0 : -1.0) * random.between(5.0, 35.0));
  design.herringbone = !spur && random.chance(0.25);
  GearDesign gear;
  gear.name = "gear";
  gear.kind = random.chance(0.35) ? GearKind::kInternal : GearKind::kExternal;
  gear.teeth =
      static_cast<int>(random.log_between(gear.kind == GearKind::kInternal ? 30.0 : 15.0, 90.0));
  gear.shift = random.between(-0.1, 0.5);
  gear.face_width_mm = random.between(4.0, 14.0) * m;
  const double sense = gear.kind == GearKind::kInternal ? -1.0 : 1.0;
  const double pitch = m * gear.teeth / std::cos(design.helix_angle_rad);
  ModificationsDesign& mods = gear.modifications;
  if (kind == Kind::kOnlyChamfered) {
    mods.edge_chamfer_mm = random.between(0.05, 0.2) * m;
    design.gears = {gear};
    return design;
  }
  const bool crowned = kind == Kind::kCrowned || (kind != Kind::kProfile && random.chance(0.6));
  if (crowned) mods.crowning_um = random.between(0.001, 0.01) * um;
  if (kind != Kind::kCrowned) {
    if (random.chance(0.7)) {
      mods.tip_relief_um = random.between(0.002, 0.015) * um;
      mods.tip_relief_start_diameter_mm =
          pitch + 2.0 * m * (*gear.shift + sense * random.between(0.1, 0.5));
      if (random.chance(0.5)) mods.tip_relief_shape = ReliefShape::kLinear;
    }
    if (random.chance(0.4)) mods.profile_crowning_um = random.between(0.001, 0.01) * um;
    if (random.chance(0.3)) mods.profile_slope_um = random.between(-0.01, 0.01) * um;
  }
  if (kind == Kind::kMixed || kind == Kind::kChamfered) {
    if (random.chance(0.4)) mods.helix_slope_um = random.between(-0.01, 0.01) * um;
    if (random.chance(0.4)) {
      mods.end_relief_um = random.between(0.001, 0.01) * um;
      mods.end_relief_length_mm = random.between(0.1, 0.3) * gear.face_width_mm;
      if (random.chance(0.5)) mods.end_relief_shape = ReliefShape::kLinear;
    }
  }
  if (kind == Kind::kChamfered) mods.edge_chamfer_mm = random.between(0.05, 0.2) * m;
  if (!(mods == ModificationsDesign{})) design.gears = {gear};
  if (design.gears.empty()) return std::nullopt;
  return design;
}

/// Of so many gears, half of them fine: with many facets the whole numbers matter less.
Ratio survey(Kind kind, bool spur, int count, std::uint64_t seed) {
  Ratio all;
  int made = 0;
  for (const std::uint64_t last = seed + 10 * static_cast<std::uint64_t>(count);
       made < count && seed < last; ++seed) {
    const auto design = modified(seed, kind, spur);
    if (!design) continue;
    const auto train = lay_out(*design);
    if (!train) continue;
    const auto shapes = part_shapes(*train);
    if (!shapes) continue;
    RandomNumbers random(seed + 77);
    const double tolerance_mm =
        random.log_between(2e-4, 5e-3) * design->module_mm * (made % 2 == 0 ? 0.2 : 1.0);
    const Ratio one = facets_of(shapes->parts[0], tolerance_mm);
    const ModificationsDesign& mods = design->gears[0].modifications;
    EXPECT_GT(one.facets, 0.999 * one.least) << "the bound of seed " << seed << " is none";
    EXPECT_LT(one.facets, worst_of(kind) * one.least)
        << "seed " << seed << ": "
        << (design->gears[0].kind == GearKind::kInternal ? "ring " : "gear ")
        << design->gears[0].teeth << " teeth, module " << design->module_mm << " mm, helix "
        << design->helix_angle_rad << " rad, tolerance " << tolerance_mm << " mm, crowning "
        << mods.crowning_um << " um, tip relief " << mods.tip_relief_um << " um, profile crowning "
        << mods.profile_crowning_um << " um, end relief " << mods.end_relief_um << " um, chamfer "
        << mods.edge_chamfer_mm << " mm";
    all.facets += one.facets, all.least += one.least;
    ++made;
  }
  EXPECT_EQ(made, count);
  std::printf("%s: %d gears, %.0f facets a tooth, %.3f times the least\n",
              spur ? "spur" : "twisted", made, all.facets, all.facets / all.least);
  return all;
}

int asked_for() {
  const char* count = std::getenv("TRUEFLANK_DESIGNS");
  return count != nullptr ? std::atoi(count) : 8;
}
std::uint64_t first_seed() {
  const char* seed = std::getenv("TRUEFLANK_SEED");
  return seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1;
}

void expect_few(Kind kind, double spur, double twisted) {
  for (const bool is_spur : {true, false}) {
    const Ratio all = survey(kind, is_spur, asked_for(), first_seed());
    EXPECT_LT(all.facets, (is_spur ? spur : twisted) * all.least);
  }
}

TEST(ModifiedFacets, OfCrownedTeethAreFewMoreThanTheLeast) {
  expect_few(Kind::kCrowned, 1.32, 1.3);
}
/// Where the twist bends a saddle most, a vertex that is off its place by half a step costs half of
/// the tolerance.
TEST(ModifiedFacets, OfACrownedTwistedRingAreFewMoreThanTheLeast) {
  const auto design = modified(31036, Kind::kCrowned, false);
  ASSERT_TRUE(design && design->gears[0].kind == GearKind::kInternal);
  const auto train = lay_out(*design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  const Ratio one = facets_of(shapes->parts[0], 6e-5);
  EXPECT_LT(one.facets, 1.3 * one.least);
}
TEST(ModifiedFacets, OfTeethWithModifiedProfilesAreFewMoreThanTheLeast) {
  expect_few(Kind::kProfile, 1.1, 1.3);
}
TEST(ModifiedFacets, OfTeethWithModificationsOfEveryKindAreFewMoreThanTheLeast) {
  expect_few(Kind::kMixed, 1.45, 1.35);
}

/// The bound is less sharp here: see docs/theory/helical-facets.md.
TEST(ModifiedFacets, OfModifiedTeethWithChamfersAreLessThanTwiceTheLeast) {
  expect_few(Kind::kChamfered, 1.7, 1.6);
}
TEST(ModifiedFacets, OfPlainTeethWithChamfersAreFewMoreThanTheLeast) {
  expect_few(Kind::kOnlyChamfered, 1.5, 1.5);
}

/// One net for all teeth against rows and columns.
void expect_fewer_than_rows(test::ToothingKinds kinds, double share) {
  double facets = 0.0, of_rows = 0.0;
  int made = 0;
  for (std::uint64_t seed = first_seed(); made < asked_for(); ++seed) {
    const auto random = test::random_toothing(seed, kinds);
    if (!random) continue;
    const ToothedOutline& outline = toothed(random->part);
    const double tolerance = meshing_tolerance_mm(random->part, random->tolerance_mm);
    const std::vector<double> ends{0.0, outline.twist.face_width_mm};
    const ToothingGrid grid(outline, ends, tolerance),
        rows(outline, ends, tolerance, GridKind::kRows);
    if (grid.teeth_alike()) continue;
    EXPECT_LE(grid.chord_error_mm(), tolerance) << random->text;
    const auto layers = [](const ToothingGrid& g) {
      return 2.0 * static_cast<double>(g.heights_mm().size() - 1) * g.points_per_tooth();
    };
    for (const NetPatch& patch : grid.patches()) facets += static_cast<double>(patch.facets.size());
    if (grid.patches().empty()) facets += layers(grid);
    of_rows += layers(rows);
    ++made;
  }
  std::printf("%.0f facets a tooth, %.0f by rows and columns\n", facets, of_rows);
  EXPECT_LT(facets, share * of_rows);
}

TEST(ModifiedFacets, OfTeethThatDifferAreHalfThoseOfRowsAndColumns) {
  expect_fewer_than_rows({.deviation = true}, 0.5);
}
TEST(ModifiedFacets, OfDisplacedTeethAreFewerThanThoseOfRowsAndColumns) {
  expect_fewer_than_rows({.displacement = true}, 0.8);
}

}  // namespace
}  // namespace trueflank
