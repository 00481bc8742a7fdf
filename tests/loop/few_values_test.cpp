// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/loop/gear/local/neighbour_variance.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/observations.h"

// Traces of few values, values read coarsely, and forms a few values wide.
namespace trueflank::test {
namespace {

// Cells along a trace may stand empty between its values, and then no three of them are neighbours.
TEST(FewValues, WeightsAreThoseOfTheirErrorAtAnyDistance) {
  const MadeGear gear = spur(24);
  const loop::FlankGeometry geometry = geometry_of(gear);
  for (int points = 10; points <= 70; ++points) {
    InspectionOptions options;
    options.points = points;
    options.noise_um = 0.8;
    options.seed = static_cast<unsigned>(points);
    loop::MeasuredData data;
    data.inspections.push_back(inspection_of(gear, {}, options));
    const loop::Observations table = *make_observations(geometry, data, {});
    for (const auto kind : {loop::ObservationKind::kProfile, loop::ObservationKind::kHelix}) {
      double weight = 0.0, values = 0.0;
      for (const loop::Patches::Patch& patch : make_patches(geometry, table).patches) {
        if (patch.kind != kind) continue;
        weight += patch.weight;
        values += patch.count;
      }
      EXPECT_NEAR(weight * 0.8 * 0.8 / values, 1.0, 0.4) << points << " values a trace";
    }
  }
}

TEST(FewValues, SquaresBesideLinesAreTheVarianceWhateverTheDistances) {
  std::mt19937_64 random(20261128);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> step(0.05, 1.0);
  std::vector<loop::OnTrace> values;
  double at = 0.0;
  for (int i = 0; i < 20000; ++i) {
    at += step(random);
    const double loud = i % 2 == 0 ? 1.0 : 2.0;
    values.push_back({at, 3.0 + 0.7 * at + 1.5 * loud * normal(random), loud * loud});
  }
  std::shuffle(values.begin(), values.end(), random);
  std::vector<double> squares = loop::squares_beside_lines(values);
  ASSERT_EQ(squares.size(), values.size() - 2);
  double mean = 0.0;
  for (const double square : squares) mean += square / static_cast<double>(squares.size());
  EXPECT_NEAR(mean, 1.5 * 1.5, 0.1);
  EXPECT_NEAR(loop::robust_variance(squares), 1.5 * 1.5, 0.12);
}

/// Standard deviation of a normal error that is read in whole numbers.
double spread_of_readings(double noise_um) {
  const auto below = [&](double x) { return 0.5 * std::erfc(-x / (noise_um * std::sqrt(2.0))); };
  double square = 0.0;
  for (int k = 1; k < 20; ++k) square += 2.0 * k * k * (below(k + 0.5) - below(k - 0.5));
  return std::sqrt(square);
}

// Most values of such traces are one reading, and the others lie one step off.
TEST(CoarseReadings, AreNoOutliers) {
  for (const double noise_um : {0.25, 0.5, 0.7}) {
    const MadeGear gear = spur(25);
    InspectionOptions options;
    options.noise_um = noise_um;
    options.points = 60;
    options.common_zero = true;
    auto data = inspection_of(gear, {}, options);
    for (auto& row : data.rows) row.deviation_um = std::round(row.deviation_um);
    const auto result = close(gear, data);
    EXPECT_EQ(result.verdict, loop::Verdict::kNoEffect) << list(result);
    EXPECT_EQ(result.outliers, 0) << noise_um;
    EXPECT_NEAR(result.noise, spread_of_readings(noise_um), 0.06) << noise_um;
    // A wild value is one all the same.
    data.rows[data.rows.size() / 3].deviation_um += 40.0;
    EXPECT_EQ(close(gear, data).outliers, 1) << noise_um;
  }
}

// Of a level and one wild value the step is not known.
TEST(CoarseReadings, OneWildValueOfNoneOtherIsAnOutlier) {
  const MadeGear gear = spur(25);
  InspectionOptions options;
  options.points = 60;
  options.common_zero = true;
  auto data = inspection_of(gear, {}, options);
  for (auto& row : data.rows) row.deviation_um = 0.0;
  data.rows[data.rows.size() / 3].deviation_um = 40.0;
  EXPECT_EQ(close(gear, data).outliers, 1);
}

// Of sizes alone their stated errors are the noise.
TEST(FewValues, SizesWithinTheirErrorsAreNoEffect) {
  const MadeGear gear = spur(25);
  const Gear design = design_of(gear);
  int quiet = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 0.002);
    loop::SizeData sizes;
    for (const int teeth : {3, 4})
      sizes.rows.push_back({loop::SizeQuantity::kSpan,
                            base_tangent_length_mm(design, teeth) + normal(random),
                            static_cast<double>(teeth), 2.0});
    for (int i = 0; i < 2; ++i)
      sizes.rows.push_back(
          {loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm + normal(random), kNaN, 2.0});
    loop::MeasuredData data;
    data.sizes = {sizes};
    const auto result = loop::close_loop(geometry_of(gear), "gear", data, {})->result;
    EXPECT_GE(result.noise, 2.0 - 1e-9) << seed;  // (repeated sizes that scatter say it is more)
    const bool is_quiet = result.verdict == loop::Verdict::kNoEffect;
    quiet += is_quiet ? 1 : 0;
    if (!is_quiet) std::printf("%u: %s\n", seed, list(result).c_str());
  }
  EXPECT_GE(quiet, 18);
}

// A nick three values wide on one trace: 15 times the noise at its middle.
TEST(FewValues, AShortNickOfOneTraceIsSeen) {
  int seen = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const MadeGear gear = spur(24);
    const auto nick = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      const double off_mm = (0.5 * (s.v + 1.0) - 0.4) * g.face_mm;
      const double half_mm = 0.033 * g.face_mm;
      return s.tooth == 5 && s.side < 0 ? 9.0 * std::exp(-off_mm * off_mm / (half_mm * half_mm))
                                        : 0.0;
    });
    InspectionOptions options;
    options.noise_um = 0.6;
    options.correlation = 0.6;
    options.points = 41;
    options.profile = false;
    options.seed = seed;
    const auto result = close(gear, inspection_of(gear, {nick}, options));
    seen += tells(result, "flank of tooth 5") || tells(result, "on tooth 5 alone") ? 1 : 0;
    EXPECT_NE(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
  }
  EXPECT_GE(seen, 3);
}

}  // namespace
}  // namespace trueflank::test
