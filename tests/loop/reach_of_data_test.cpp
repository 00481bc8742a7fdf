// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <utility>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/part_model.h"

// What measured data can show of either flank.
namespace trueflank::test {
namespace {

using loop::FlankChoice;

loop::Effect along(double profile, double face, FlankChoice flank) {
  return {loop::find_family("unnamed"), flank, {profile, face, 0.0, 0.0}};
}

// Ends of what was never followed are infinite, and so was the range between them.
TEST(ReachOfData, AFlankThatTheIndexAloneTouchesShowsNoCourseOverItsProfile) {
  for (const MadeGear& gear : {spur(24), ring(60)}) {
    loop::InspectionData traces = inspection_of(gear, {}, {.teeth = {1, 7, 13, 19}});
    std::erase_if(traces.rows, [](const loop::InspectionRow& row) {
      return row.record != loop::RecordKind::kIndex && row.flank == Flank::kRight;
    });
    loop::MeasuredData data;
    data.inspections.push_back(traces);
    const loop::FlankGeometry geometry = geometry_of(gear);
    loop::PartModel model(geometry, *make_observations(geometry, data, {}), {});
    divide_into_patches(model);
    ban_what_cannot_be_seen(model);
    for (const auto& [profile, face] : {std::pair{1.0, 0.0}, std::pair{0.0, 1.0}}) {
      EXPECT_TRUE(is_within_reach(model, along(profile, face, FlankChoice::kLeft)));
      EXPECT_TRUE(is_within_reach(model, along(profile, face, FlankChoice::kBoth)));
      EXPECT_FALSE(is_within_reach(model, along(profile, face, FlankChoice::kRight)));
    }
    EXPECT_TRUE(is_within_reach(model, along(0.0, 0.0, FlankChoice::kRight)));
  }
}

}  // namespace
}  // namespace trueflank::test
