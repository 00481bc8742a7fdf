// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/declared_effect.h"

#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/gear/formula.h"

// Effects that users describe, and the formulas they are described with.
namespace trueflank::test {
namespace {

double value_of(const std::string& text, std::vector<double> values = {2.0, 3.0}) {
  const auto formula = loop::Formula::make(text, {"x", "y"});
  EXPECT_TRUE(formula) << text << ": " << (formula ? "" : formula.error().message);
  return formula ? (*formula)(values.data()) : kNaN;
}

TEST(Formula, FollowsTheRulesOfArithmetic) {
  EXPECT_DOUBLE_EQ(value_of("1 + 2 * 3"), 7.0);
  EXPECT_DOUBLE_EQ(value_of("(1 + 2) * 3"), 9.0);
  EXPECT_DOUBLE_EQ(value_of("-x^2"), -4.0);
  EXPECT_DOUBLE_EQ(value_of("2^3^2"), 512.0);
  EXPECT_DOUBLE_EQ(value_of("x^-1"), 0.5);
  EXPECT_DOUBLE_EQ(value_of("8/2/2"), 2.0);
  EXPECT_DOUBLE_EQ(value_of("1 - 2 - 3"), -4.0);
  EXPECT_DOUBLE_EQ(value_of("max(x, y) + min(x, y) * 10"), 23.0);
  EXPECT_DOUBLE_EQ(value_of("step(x - 1) + step(1 - x)"), 1.0);
  EXPECT_DOUBLE_EQ(value_of("abs(-x) + sqrt(y * 3)"), 5.0);
  EXPECT_DOUBLE_EQ(value_of("exp(log(y))"), 3.0);
  EXPECT_NEAR(value_of("cos(pi)"), -1.0, 1e-15);
  EXPECT_DOUBLE_EQ(value_of("1e1 * .5"), 5.0);
}

TEST(Formula, SaysWhereItDoesNotUnderstand) {
  for (const char* text : {"", "1 +", "(1", "cos 2", "zz * 2", "1 2", "max(1)", "inf", "nan", "x..y"}) {
    const auto formula = loop::Formula::make(text, {"x", "y"});
    ASSERT_FALSE(formula) << text;
    EXPECT_EQ(formula.error().code, ErrorCode::kSyntax);
    EXPECT_NE(formula.error().message.find("at character"), std::string::npos);
    EXPECT_NE(formula.error().remedy.find("x y"), std::string::npos);
  }
}

TEST(Formula, EndsNestingThatHasNoEnd) {
  EXPECT_FALSE(loop::Formula::make(std::string(100000, '('), {"x"}));
  EXPECT_FALSE(loop::Formula::make(std::string(100000, '-'), {"x"}));
  std::string powers = "x";
  for (int i = 0; i < 10000; ++i) powers += "^x";
  EXPECT_FALSE(loop::Formula::make(powers, {"x"}));
  std::string sums = "x";
  for (int i = 0; i < 1000; ++i) sums += "+x";
  EXPECT_TRUE(loop::Formula::make(sums, {"x"}));
  for (int i = 0; i < 1000; ++i) sums += "+x";
  EXPECT_FALSE(loop::Formula::make(sums, {"x"}));
}

loop::DeclaredFamilies cooled() {
  const auto family = loop::declared_family(
      {.id = "cooled_side",
       .description = "the side towards the fan is thinner at the top",
       .cause = "one-sided cooling",
       .correction = "turn the fan down",
       .columns = {{"cos_um", "(1 + v)^2 * cos(theta)"}, {"sin_um", "(1 + v)^2 * sin(theta)"}}});
  return std::make_shared<const std::vector<loop::EffectFamily>>(
      std::vector<loop::EffectFamily>{*family});
}

Process one_sided_cooling() {
  return grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    const double a = 2.0 * M_PI * (s.tooth - 1) / g.teeth;
    return (1.0 + s.v) * (1.0 + s.v) * (6.0 * std::cos(a) - 4.0 * std::sin(a));
  });
}

TEST(DeclaredEffect, IsFoundAndToldLikeALibraryEffect) {
  const MadeGear gear = spur(20);
  ScanOptions options;
  options.points = 5000;
  loop::MeasuredData data;
  data.scans.push_back(scan_of(gear, {one_sided_cooling()}, options));
  const auto result = loop::close_loop(geometry_of(gear), "gear", data,
                                       {.aligned = true, .declared = cooled()})->result;
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "cooled_side");
  EXPECT_EQ(result.effects[0].cause, "one-sided cooling");
  EXPECT_TRUE(result.effects[0].named);
  EXPECT_NEAR(parameter(result.effects[0], "cos_um").value, 6.0, 0.5);
  EXPECT_NEAR(parameter(result.effects[0], "sin_um").value, -4.0, 0.5);
  // Without the declaration the same data have no name for it.
  const auto without = loop::close_loop(geometry_of(gear), "gear", data, {.aligned = true})->result;
  EXPECT_EQ(find(without, "cooled_side"), nullptr);
  // The correction needs loop.json alone.
  const auto correction = loop::Correction::make(loop_json(result), geometry_of(gear));
  ASSERT_TRUE(correction) << correction.error().message;
  EXPECT_EQ(correction->corrected(), std::vector<std::string>{"cooled_side"});
}

TEST(DeclaredEffect, IsNotFoundWhereItIsNot) {
  const MadeGear gear = spur(20);
  ScanOptions options;
  options.points = 3000;
  loop::MeasuredData data;
  data.scans.push_back(scan_of(gear, {}, options));
  const auto result = loop::close_loop(geometry_of(gear), "gear", data,
                                       {.aligned = true, .declared = cooled()})->result;
  EXPECT_EQ(result.verdict, loop::Verdict::kNoEffect) << list(result);
}

TEST(DeclaredEffect, OfALibraryNameOrWithoutAFormulaIsRefused) {
  EXPECT_FALSE(loop::declared_family({.id = "scale", .columns = {{"a_um", "1"}}}));
  EXPECT_FALSE(loop::declared_family({.id = "mine"}));
  const auto wrong = loop::declared_family({.id = "mine", .columns = {{"a_um", "u *"}, {"b_um", "w"}}});
  ASSERT_FALSE(wrong);
  ASSERT_EQ(wrong.error().size(), 2u);
  EXPECT_EQ(wrong.error()[0].key, "mine.form.a_um");
}

}  // namespace
}  // namespace trueflank::test
