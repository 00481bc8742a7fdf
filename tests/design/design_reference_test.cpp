// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_reference.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace {

const std::string kPage = TRUEFLANK_SOURCE_DIR "/docs/design-file.md";

std::string page() {
  std::ostringstream text;
  text << std::ifstream(kPage).rdbuf();
  return text.str();
}

TEST(DesignReference, IsThePageInDocs) {
  if (std::getenv("TRUEFLANK_UPDATE")) std::ofstream(kPage) << design_reference();
  EXPECT_EQ(page(), design_reference())
      << "after a change of the keys: TRUEFLANK_UPDATE=1 ctest -R DesignReference";
}

TEST(DesignReference, ShowsAnExampleThatReads) {
  const std::string text = design_reference();
  const auto begin = text.find("```toml\n") + 8;
  const auto example = text.substr(begin, text.find("```", begin) - begin);
  const auto design = read_design_text(example, "example.toml");
  EXPECT_TRUE(design) << design.error().front().message;
}

template <class Target>
void expect_defaults_as_told(const std::vector<DesignKey<Target>>& keys, const Target& by_default) {
  for (const DesignKey<Target>& key : keys) {
    const auto value = key.get(by_default);
    if (!value || key.rule.required || !std::holds_alternative<double>(*value)) continue;
    EXPECT_EQ(plain_number(std::get<double>(*value)), key.rule.by_default) << key.rule.name;
  }
}

TEST(DesignReference, TellsTheDefaultsThereAre) {
  expect_defaults_as_told(gearbox_keys(), GearboxDesign{});
  expect_defaults_as_told(rack_keys(), BasicRack{});
  expect_defaults_as_told(gear_keys(), GearDesign{});
  expect_defaults_as_told(cutter_keys(), ShaperCutter{});
  expect_defaults_as_told(modification_keys(), ModificationsDesign{});
  EXPECT_EQ(plain_number(GearboxDesign{}.layer_gap_mm), "1");
}

template <class Target>
void expect_meanings(const std::vector<DesignKey<Target>>& keys) {
  for (const DesignKey<Target>& key : keys) {
    const std::string name = key.rule.name, unit = key.rule.unit;
    EXPECT_NE(std::string(key.rule.meaning), "") << name;
    EXPECT_EQ(key.rule.required, std::string(key.rule.by_default).empty() || name == "output")
        << name;
    if (!unit.empty() && unit != "module")
      EXPECT_TRUE(name.ends_with("_" + unit)) << name;
    else
      EXPECT_FALSE(name.ends_with("_mm") || name.ends_with("_um") || name.ends_with("_deg"))
          << name;
  }
}

TEST(DesignReference, GivesEveryKeyAMeaningAndItsUnitInItsName) {
  expect_meanings(file_keys());
  expect_meanings(gearbox_keys());
  expect_meanings(rack_keys());
  expect_meanings(gear_keys());
  expect_meanings(cutter_keys());
  expect_meanings(modification_keys());
}

}  // namespace
}  // namespace trueflank
