// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/zeros_at_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"
#include "tests/loop/topography.h"

// Traces of one flank at several heights: with a zero each, or one for the flank.
namespace trueflank::test {
namespace {

/// Forms that differ from height to height and from tooth to tooth.
std::vector<Process> forms(const MadeGear& gear) {
  const auto grown_by = [](const auto& um) {
    return grown([um](auto&, const FlankSpot& s, auto&) { return um(s); });
  };
  const double pitch = 2.0 * M_PI / gear.teeth;
  return {grown_by([](const FlankSpot&) { return 0.0; }),
          grown_by([](const FlankSpot& s) { return 8.0 * s.v + 5.0 * s.u * s.v; }),
          grown_by([pitch](const FlankSpot& s) {
            return 9.0 * s.v * std::cos(pitch * s.tooth) + 6.0 * s.v * s.v;
          }),
          grown_by([](const FlankSpot& s) { return s.tooth == 5 && s.v > 0.2 ? 40.0 : 0.0; }),
          grown_by([](const FlankSpot& s) { return s.tooth > 9 && s.v > 0.2 ? 12.0 : 0.0; })};
}

TEST(ZerosAtPlaces, AreToldFromZerosOfFlanksWhateverTheFormIs) {
  unsigned seed = 0;
  for (const std::vector<double>& heights :
       {std::vector{0.25, 0.75}, std::vector{0.1, 0.5, 0.9}, std::vector{0.1, 0.4, 0.6, 0.9}})
    for (const int every : {1, 3}) {
      const MadeGear gear = spur(heights.size() == 2 ? 37 : 23);
      for (const Process& form : forms(gear))
        for (const double zero_um : {3.0, 20.0}) {
          const auto shared =
              topography(gear, form, Zeros::kOfFlanks, heights, every, 0.6, zero_um, ++seed);
          EXPECT_FALSE(loop::zeros_at_places_um(shared, loop::RecordKind::kProfile))
              << heights.size() << " heights, every " << every << ", zeros of " << zero_um << " um";
          const auto own =
              topography(gear, form, Zeros::kOfTraces, heights, every, 0.6, zero_um, ++seed);
          const auto scatter = loop::zeros_at_places_um(own, loop::RecordKind::kProfile);
          // (two heights of few flanks do not tell; nor do zeros as small as the forms)
          if (zero_um < 10.0 || (heights.size() == 2 && every > 1)) continue;
          ASSERT_TRUE(scatter) << heights.size() << " heights, every " << every;
          EXPECT_GT(*scatter, 0.45 * zero_um);
          EXPECT_LT(*scatter, 1.8 * zero_um);
        }
    }
}

TEST(ZerosAtPlaces, OfTheirOwnLeaveATaperAndItsNoise) {
  const MadeGear gear = spur(25);
  const auto made =
      grown([](auto&, const FlankSpot& s, auto&) { return 3.0 * s.u + 2.0 * s.u * s.v; });
  loop::InspectionData data = inspection_of(gear, {made}, traced({1, 6, 11, 16, 21}, 0.7, 3));
  const auto profiles = topography(gear, made, Zeros::kOfTraces, {0.2, 0.5, 0.8}, 1, 0.7, 5.0, 4);
  std::erase_if(data.rows,
                [](const auto& row) { return row.record == loop::RecordKind::kProfile; });
  data.rows.insert(data.rows.end(), profiles.rows.begin(), profiles.rows.end());
  const auto result = close(gear, data);
  EXPECT_LT(result.noise, 0.8) << list(result);
  EXPECT_GT(result.noise, 0.6) << list(result);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes.front().find("zero of its own"), std::string::npos)
      << result.notes.front();
}

// A value that no gear has, and one that is wild, change nothing of it.
TEST(ZerosAtPlaces, AreToldBesideWildValues) {
  const MadeGear gear = spur(23);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) { return 3.0 * s.u; });
  for (const double wild : {1e308, -900.0}) {
    auto data = topography(gear, made, Zeros::kOfTraces, {0.2, 0.5, 0.8}, 1, 0.7, 5.0, 9);
    data.rows[77].deviation_um = wild;
    const auto result = close(gear, data);
    EXPECT_LT(result.noise, 0.8) << list(result);
    const auto said = std::count_if(result.notes.begin(), result.notes.end(), [](const auto& note) {
      return note.find("zero of its own") != std::string::npos;
    });
    EXPECT_EQ(said, 1) << wild;
  }
}

}  // namespace
}  // namespace trueflank::test
