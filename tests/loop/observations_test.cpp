// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/observations.h"

#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"

namespace trueflank::test {
namespace {

ResultAll<loop::Observations> observed(const loop::MeasuredData& data) {
  return loop::make_observations(geometry_of(spur(24)), data, {});
}

/// Round after round, each tooth a little otherwise in every one: equal rows would count once.
loop::MeasuredData index_values(int count) {
  loop::MeasuredData data;
  data.inspections.emplace_back();
  for (int i = 0; i < count; ++i) {
    loop::InspectionRow row;
    row.record = loop::RecordKind::kIndex;
    row.tooth = i % 24 + 1;
    row.deviation_um = 0.01 * (i / 24);
    data.inspections.back().rows.push_back(row);
  }
  return data;
}

loop::MeasuredData spans(int count, double teeth) {
  loop::MeasuredData data;
  data.sizes.emplace_back();
  const double value = base_tangent_length_mm(geometry_of(spur(24)).gear(), 3);
  for (int i = 0; i < count; ++i)
    data.sizes.back().rows.push_back(
        {.quantity = loop::SizeQuantity::kSpan, .value_mm = value, .detail = teeth});
  return data;
}

TEST(Observations, ABallThatTouchesNoFlankIsOfAnotherGear) {
  const auto with_ball = [](double diameter_mm) {
    loop::MeasuredData data = index_values(24);
    data.inspections.back().ball_diameter_mm = diameter_mm;
    for (loop::InspectionRow& row : data.inspections.back().rows) row.record = loop::RecordKind::kRadial;
    return observed(data);
  };
  for (const double diameter : {1.5, 1.7, 2.0}) EXPECT_TRUE(with_ball(diameter)) << diameter;
  for (const double diameter : {0.1, 4.0, 1e9}) {
    const auto table = with_ball(diameter);
    ASSERT_FALSE(table) << diameter;
    EXPECT_NE(table.error().front().message.find("touches no flank"), std::string::npos) << table.error().front().message;
  }
}

TEST(Observations, ATraceMeasuredAgainHasAZeroOfItsOwn) {
  loop::MeasuredData data;
  data.inspections.emplace_back();
  for (const double height : {2.0, 6.0})  // a topography: traces at two heights share their zero
    for (int again = 0; again < 2; ++again)
      for (int i = 0; i < 20; ++i) {
        loop::InspectionRow row;
        row.record = loop::RecordKind::kProfile;
        row.tooth = 3;
        row.diameter_mm = 2.0 * spur(24).reference() - 1.0 + 0.1 * i;
        row.z_mm = height;
        row.deviation_um = 40.0 * again;
        data.inspections.back().rows.push_back(row);
      }
  const auto table = observed(data);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->traces, 2);
  ASSERT_EQ(table->rows.size(), 80U);
  for (const loop::Observation& row : table->rows)
    EXPECT_EQ(row.trace, row.deviation_um < 20.0 ? 0 : 1) << row.deviation_um;
}

TEST(Observations, ValuesInNoOrderAreOneTrace) {
  loop::MeasuredData data;
  data.inspections.emplace_back();
  for (int i = 0; i < 60; ++i) {
    loop::InspectionRow row;
    row.record = loop::RecordKind::kHelix;
    row.tooth = 3;
    row.z_mm = 0.5 + 7.0 * ((i * 23) % 60) / 60.0;
    data.inspections.back().rows.push_back(row);
  }
  const auto table = observed(data);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->traces, 1);
}

TEST(Observations, RepeatedSingleValuesAreRefusedBeforeTheyFillTheMemory) {
  EXPECT_TRUE(observed(index_values(20'000)));
  const auto index = observed(index_values(20'001));
  ASSERT_FALSE(index);
  EXPECT_EQ(index.error().front().code, ErrorCode::kUnsupported);
  EXPECT_NE(index.error().front().message.find("20001 values"), std::string::npos);
  EXPECT_TRUE(observed(spans(2'000, 3)));
  EXPECT_FALSE(observed(spans(2'001, 3)));
}

TEST(Observations, ASpanOverMoreTeethThanThereAreIsRefused) {
  EXPECT_TRUE(observed(spans(1, 3)));
  for (const double teeth : {25.0, 3.5, 1e300}) {
    const auto refused = observed(spans(1, teeth));
    ASSERT_FALSE(refused) << teeth;
    EXPECT_NE(refused.error().front().message.find("24"), std::string::npos) << teeth;
  }
}

}  // namespace
}  // namespace trueflank::test
