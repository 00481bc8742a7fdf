// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/loop/gear/observations.h"

// The order of files, and of rows within them, says nothing of the gear.
namespace trueflank::test {
namespace {

/// Traces of three teeth, an index, spans and sizes of the tip: each a file.
loop::MeasuredData sheet_of(const MadeGear& gear, unsigned seed) {
  const auto lean = [](auto&, const FlankSpot& s, auto&) { return 3.0 * s.v; };
  InspectionOptions options;
  options.teeth = {1, 8, 15};
  options.points = 60;
  options.noise_um = 0.5;
  options.seed = seed;
  loop::MeasuredData data;
  for (const bool index : {false, true}) {
    options.index = index;
    options.profile = options.helix = !index;
    data.inspections.push_back(inspection_of(gear, {off_centre(6.0, 40.0), grown(lean)}, options));
    data.inspections.back().file = index ? "index" : "traces";
  }
  std::mt19937_64 random(seed);
  std::normal_distribution<double> read_um(0.0, 3.0);
  const double span_mm = base_tangent_length_mm(geometry_of(gear).gear(), 3);
  for (const char* file : {"first", "second"}) {
    loop::SizeData& sizes = data.sizes.emplace_back();
    sizes.file = file;
    for (int i = 0; i < 4; ++i) {
      sizes.rows.push_back({loop::SizeQuantity::kSpan, span_mm + mm_from_um(read_um(random)), 3, 1.0});
      sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm + mm_from_um(read_um(random))});
    }
  }
  return data;
}

std::string told(const MadeGear& gear, const loop::MeasuredData& data) {
  return loop::loop_json(loop::close_loop(geometry_of(gear), "gear", data, {}).value().result);
}

TEST(CanonicalOrder, TheAnswerIsTheSameInWhateverOrderFilesAndRowsStand) {
  const MadeGear gear = helical(21, 21.0);
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    loop::MeasuredData data = sheet_of(gear, seed);
    const std::string first = told(gear, data);
    std::mt19937_64 random(seed);
    for (int again = 0; again < 4; ++again) {
      std::shuffle(data.inspections.begin(), data.inspections.end(), random);
      std::shuffle(data.sizes.begin(), data.sizes.end(), random);
      for (auto& file : data.inspections) std::shuffle(file.rows.begin(), file.rows.end(), random);
      for (auto& file : data.sizes) std::shuffle(file.rows.begin(), file.rows.end(), random);
      EXPECT_EQ(told(gear, data), first) << seed << ", " << again;
    }
  }
}

TEST(CanonicalOrder, OfFilesOfSeveralPartsToo) {
  const MadeGear gear = spur(17);
  loop::MeasuredData data;
  for (unsigned part = 1; part <= 3; ++part) {
    InspectionOptions options;
    options.points = 24;
    options.seed = part;
    data.inspections.push_back(inspection_of(gear, {off_centre(6.0, 40.0)}, options));
    data.inspections.back().part = "p" + std::to_string(part);
  }
  const std::string first = told(gear, data);
  std::reverse(data.inspections.begin(), data.inspections.end());
  EXPECT_EQ(told(gear, data), first);
}

TEST(CanonicalOrder, RecordsInOneFileOrInSeveralAreTheSameTable) {
  const MadeGear gear = helical(21, 21.0);
  const loop::MeasuredData apart = sheet_of(gear, 1);
  loop::MeasuredData joined = apart;
  auto& rows = joined.inspections.front().rows;
  rows.insert(rows.begin(), joined.inspections.back().rows.begin(),
              joined.inspections.back().rows.end());
  joined.inspections.pop_back();
  const auto a = loop::make_observations(geometry_of(gear), apart, {});
  const auto b = loop::make_observations(geometry_of(gear), joined, {});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->rows.size(), b->rows.size());
  for (std::size_t i = 0; i < a->rows.size(); ++i) {
    EXPECT_EQ(a->rows[i].kind, b->rows[i].kind) << i;
    EXPECT_EQ(a->rows[i].deviation_um, b->rows[i].deviation_um) << i;
    EXPECT_EQ(a->rows[i].trace, b->rows[i].trace) << i;
    EXPECT_EQ(a->rows[i].source, b->rows[i].source) << i;
  }
}

}  // namespace
}  // namespace trueflank::test
