// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/strip_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/solid/random_part.h"

namespace trueflank {
namespace {

using test::RandomNumbers;

constexpr std::size_t kRowCells = 16;
constexpr BentEdges::Heights kRowHeights = {0.12, 0.5, 0.88};

/// Alike everywhere, with a tolerance of an eighth: so many chords a cell, bent across its strips
/// by `saddle` rooms; lines up the face are straight.
BentEdges even_saddle(double chords, double saddle) {
  const double across = chords * chords;
  const SurfaceForm form{across, std::sqrt(saddle * across), 0.0, across};
  return {std::vector<std::vector<SurfaceForm>>(kRowCells, {form, form, form}), kRowHeights,
          std::vector<double>(kRowCells, 1.0)};
}

RowBeside nothing_beside() {
  RowBeside beside{.chords = ColumnDemand(0.0, kRowCells)};
  for (std::size_t c = 0; c < kRowCells; ++c) beside.chords.add(0.0);
  return beside;
}

/// Of the facets between rows, joined in the best way, and of the rows.
double largest_error(const BentEdges& edges, const StripRows& rows, bool down) {
  const auto last = static_cast<double>(rows.size() - 1);
  const auto height = [&](std::size_t row) {
    return (down ? last - static_cast<double>(row) : static_cast<double>(row)) / last;
  };
  double largest = 0.0;
  for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
    const auto &a = rows[row], &b = rows[row + 1];
    std::vector<double> least(b.size(), 0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k) {
        double before = i == 0 && k == 0 ? 0.0 : 1e300;
        if (i > 0) before = std::min(before, least[k]);
        if (k > 0) before = std::min(before, least[k - 1]);
        least[k] = std::max(before, edges.over_strip(a[i], height(row), b[k], height(row + 1)));
      }
    largest = std::max(largest, least.back());
  }
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t i = 1; i < rows[row].size(); ++i)
      largest = std::max(largest, edges.along_row(rows[row][i - 1], rows[row][i], height(row)));
  return largest;
}

TEST(StripRows, OfASaddleStandAsFarApartAsSteepestAndFlattestEdgesAllow) {
  for (const double saddle : {2.0, 6.0, 30.0}) {
    const BentEdges edges = even_saddle(4.0, saddle);
    const RowBeside beside = nothing_beside();
    const StripRows rows = strip_rows({edges, beside, 1, false}, 0.0, 16.0);
    // docs/theory/helical-facets.md: chords between two vertices; edges aim at 0.97 of the
    // tolerance
    const double m = saddle / 0.97, apart = std::sqrt(m + 1.0) - std::sqrt(m - 1.0),
                 steps = 64.0 / std::sqrt(0.97) / apart;
    for (const auto& row : rows) {
      EXPECT_GE(static_cast<double>(row.size()), steps) << saddle;
      EXPECT_LE(static_cast<double>(row.size()), 1.03 * steps + 3.0) << saddle;
    }
    EXPECT_LE(largest_error(edges, rows, false), 1.0);
  }
}

TEST(StripRows, OfStripsThatAreFlatEnoughHaveTheirChordsAlone) {
  const BentEdges edges = even_saddle(4.0, 25.0 * 1.2);
  const RowBeside beside = nothing_beside();
  for (const auto& row : strip_rows({edges, beside, 5, false}, 0.0, 16.0))
    EXPECT_LE(row.size(), 64.0 / std::sqrt(0.97) + 4.0);
}

TEST(StripRows, BeginAndEndTogetherAndHaveTheFixedVerticesOfTheBreak) {
  const BentEdges edges = even_saddle(3.0, 5.0);
  RowBeside beside = nothing_beside();
  beside.fixed = {2.5, 3.0, 7.125};
  for (const bool down : {false, true})
    for (const auto& rows : {strip_rows({edges, beside, 3, down}, 2.0, 9.0),
                             even_strip_rows({edges, beside, 3, down}, 2.0, 9.0)}) {
      ASSERT_EQ(rows.size(), 4U);
      for (const auto& row : rows) {
        EXPECT_EQ(row.front(), 2.0);
        EXPECT_EQ(row.back(), 9.0);
        EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
      }
      for (const double place : beside.fixed)
        EXPECT_EQ(std::count(rows[0].begin(), rows[0].end(), place), 1) << place;
    }
}

TEST(StripRows, KeepTheToleranceOnFormsThatChange) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomNumbers random(seed);
    const double chords = random.between(1.0, 5.0), bent = random.between(0.0, 6.0),
                 lean = random.between(-0.5, 0.5), sense = random.chance(0.5) ? 1.0 : -1.0;
    std::vector<std::vector<SurfaceForm>> forms(kRowCells);
    for (std::size_t c = 0; c < kRowCells; ++c)
      for (int surface = 0; surface < 2; ++surface)
        for (const double height : kRowHeights) {
          const double share = (static_cast<double>(c) + 0.5) / kRowCells,
                       across = chords * chords * (1.3 - 0.6 * share + 0.2 * height);
          forms[c].push_back({sense * across,
                              bent * chords * std::sin(kPi * share) * (1.0 + 0.2 * surface), lean,
                              1.2 * across});
        }
    const BentEdges edges(forms, kRowHeights, std::vector<double>(kRowCells, 1.0));
    RowBeside beside = nothing_beside();
    if (random.chance(0.5))
      for (int k = 1; k < 16; ++k) beside.fixed.push_back(k + 0.3);
    const int strips = static_cast<int>(random.between(1.0, 7.0));
    const bool down = random.chance(0.5);
    const StripRows fewest = strip_rows({edges, beside, strips, down}, 0.0, kRowCells),
                    even = even_strip_rows({edges, beside, strips, down}, 0.0, kRowCells);
    EXPECT_LE(largest_error(edges, fewest, down), 1.0) << "seed " << seed;
    EXPECT_LE(largest_error(edges, even, down), largest_error(edges, fewest, down) + 1e-3)
        << "seed " << seed;
    EXPECT_LE(vertex_count(even), vertex_count(fewest)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace trueflank
