// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/step/step_writer.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <string_view>
#include <vector>

#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/base/contract.h"
#include "trueflank/export/step/step_entities.h"

namespace trueflank::io {
namespace {

std::string real_text(double number) { return StepEntities().put(number).take(); }
std::string coordinate_text(double number) { return StepEntities().put_coordinate(number).take(); }
std::string quoted_text(std::string_view text) { return StepEntities().put_quoted(text).take(); }

StepPart sample_part(std::string name) {
  const auto profile = ToothProfile::make(test::external_gear(12, 0.3));
  EXPECT_TRUE(profile);
  auto solid = brep_of(test::gear_part(name, *profile, 10.0, {BoreOutline{{.diameter_mm = 5.0}}}));
  EXPECT_TRUE(solid);
  return {.name = std::move(name), .solid = std::move(*solid)};
}

int occurrences(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// The whole numbers in a text that stand between two words.
std::vector<int> numbers_between(std::string_view text, std::string_view before, std::string_view after) {
  std::vector<int> numbers;
  for (std::size_t at = text.find(before); at != std::string_view::npos; at = text.find(before, at + 1)) {
    const char* const first = text.data() + at + before.size();
    int number = 0;
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
    if (error == std::errc() && text.substr(static_cast<std::size_t>(end - text.data())).starts_with(after))
      numbers.push_back(number);
  }
  return numbers;
}

TEST(StepEntities, RealNumbersAlwaysHaveADecimalPoint) {
  EXPECT_EQ(real_text(0.0), "0.");
  EXPECT_EQ(real_text(-0.0), "0.");
  EXPECT_EQ(real_text(10.0), "10.");
  EXPECT_EQ(real_text(-2.5), "-2.5");
  EXPECT_EQ(real_text(1e-7), "1.E-07");
  EXPECT_EQ(real_text(1.5e-7), "1.5E-07");
  EXPECT_EQ(real_text(1e300), "1.E+300");
  for (const double x : {0.1, 1.0 / 3.0, 1e22, 123456789.0, -5e-324})
    EXPECT_EQ(std::strtod(real_text(x).c_str(), nullptr), x);
}

TEST(StepEntities, CoordinatesAreRoundedToATenthOfAPicometre) {
  EXPECT_EQ(coordinate_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(coordinate_text(-1e-12), "0.");
  EXPECT_EQ(coordinate_text(25.68261234567891), "25.6826123457");
}

TEST(StepEntities, CoordinatesHaveTheFewestDigitsThatReadBackTheSame) {
  std::mt19937 random(7);
  const auto expect_shortest = [](double x) {
    const double rounded = std::round(x * 1e10) / 1e10;
    EXPECT_EQ(coordinate_text(x), real_text(rounded)) << x;
  };
  for (int i = 0; i < 100000; ++i) {
    const double size = std::exp(std::uniform_real_distribution<>(std::log(1e-5), std::log(8e5))(random));
    const double x = i % 2 == 0 ? size : -size;
    expect_shortest(x);
    expect_shortest(std::round(x * 1e4) / 1e4);  // few decimals: zeros at the end are left out
  }
  for (const double x : {1e-3, 9.99e-4, 1.0, 1e4, 9999.9999999999, 1e5, 0.0000100001}) expect_shortest(x);
}

TEST(StepEntities, StringsKeepQuotesBackslashesAndForeignLetters) {
  EXPECT_EQ(quoted_text("planet 1"), "'planet 1'");
  EXPECT_EQ(quoted_text("it's"), "'it''s'");
  EXPECT_EQ(quoted_text("a\\b"), "'a\\\\b'");
  EXPECT_EQ(quoted_text("ü"), "'\\X2\\00FC\\X0\\'");
  EXPECT_EQ(quoted_text("😀"), "'\\X4\\0001F600\\X0\\'");
  EXPECT_EQ(quoted_text("\n"), "'\\X2\\000A\\X0\\'");
  EXPECT_EQ(quoted_text("\xFF"), "'\\X2\\FFFD\\X0\\'");
}

TEST(StepWriter, TheSamePartGivesTheSameBytes) {
  EXPECT_EQ(step_text(sample_part("sun")), step_text(sample_part("sun")));
}

TEST(StepWriter, EveryReferenceIsToAnEntityThatExistsOnce) {
  const std::string text = step_text(sample_part("sun"));
  std::set<int> defined;
  for (const int number : numbers_between(text, "\n#", "=")) EXPECT_TRUE(defined.insert(number).second) << number;
  const std::vector<int> references = numbers_between(text, "#", "");
  EXPECT_GT(references.size(), defined.size());
  for (const int number : references) EXPECT_TRUE(defined.contains(number)) << number;
}

TEST(StepWriter, OuterBoundsStandBeforeHoles) {
  const std::string text = step_text(sample_part("sun"));
  std::set<int> outer;
  for (const int number : numbers_between(text, "\n#", "=FACE_OUTER_BOUND")) outer.insert(number);
  const std::vector<int> first_bounds = numbers_between(text, "ADVANCED_FACE('',(#", "");
  for (const int number : first_bounds) EXPECT_TRUE(outer.contains(number)) << "face of bound " << number;
  EXPECT_EQ(first_bounds.size(), 6 * 12 + 3);
  EXPECT_EQ(outer.size(), first_bounds.size());
}

TEST(StepWriter, AnAssemblyHoldsEveryPartOnce) {
  const std::string text =
      step_text({sample_part("sun"), sample_part("planet")},
                {{.part = 0, .name = "sun"}, {.part = 1, .name = "planet 1"}, {.part = 1, .name = "planet 2"}},
                "gearbox");
  EXPECT_EQ(occurrences(text, "=MANIFOLD_SOLID_BREP("), 2);
  EXPECT_EQ(occurrences(text, "=PRODUCT("), 3);
  EXPECT_EQ(occurrences(text, "=NEXT_ASSEMBLY_USAGE_OCCURRENCE("), 3);
  EXPECT_EQ(occurrences(text, "=STYLED_ITEM("), 2);
  EXPECT_EQ(occurrences(text, "LENGTH_MEASURE(1.E-06)"), 1);
}

TEST(StepWriter, APlacementOfNoPartIsABug) {
  EXPECT_THROW(static_cast<void>(step_text({sample_part("sun")}, {{.part = 1, .name = "?"}}, "gearbox")),
               ContractViolation);
}

}  // namespace
}  // namespace trueflank::io
