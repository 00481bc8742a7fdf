// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "trueflank/design/design_file.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/design/new_design.h"

namespace trueflank {
namespace {

std::string text() { return new_design_text(*find_train_kind("two-stage"), "two"); }

std::string with_instead(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

/// The keys of all errors of a text.
std::vector<std::string> wrong_keys(const std::string& text) {
  const auto read = read_design_text(text, "two.toml");
  std::vector<std::string> keys;
  if (!read)
    for (const Error& error : read.error()) keys.push_back(error.key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(TwoStageFile, EachStageHasItsOwnPlanetsModuleAndCentreDistance) {
  const auto design = read_design_text(
      with_instead(text(), "[stage2]\n", "[stage2]\ncentre_distance_mm = 23.4\n"), "two.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  ASSERT_EQ(design->later_stages.size(), 1U);
  EXPECT_EQ(design->planets, 3);
  EXPECT_EQ(design->later_stages[0], (StageDesign{.planets = 4, .module_mm = 1.0, .centre_distance_mm = 23.4}));
  EXPECT_EQ(module_of(*design, design->gears[0]), 0.8);
  EXPECT_EQ(module_of(*design, design->gears[3]), 1.0);
  EXPECT_EQ(planets_of(*design, design->topology.find_member("planet1")), 3);
  EXPECT_EQ(planets_of(*design, design->topology.find_member("planet2")), 4);
}

TEST(TwoStageFile, AModuleThatTheStageLeavesOutIsTheGearboxs) {
  std::string shared =
      with_instead(text(), "module_mm = 1.0                # it carries more torque\n", "");
  const auto design = read_design_text(shared, "two.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  EXPECT_EQ(module_of(*design, design->gears[3]), 0.8);
}

TEST(TwoStageFile, WhatIsMissingOrInTheWrongPlaceIsNamed) {
  EXPECT_EQ(wrong_keys(with_instead(text(), "[stage2]\nplanets = 4 ", "[stage2]\n#planets = 4 ")),
            Keys{"stage2.planets"});
  const auto simple = [](const char* table) {
    return new_design_text(*find_train_kind("simple"), "one") + "\n[" + table + "]\nplanets = 3\n";
  };
  EXPECT_EQ(wrong_keys(simple("stage2")), Keys{"stage2"});
  EXPECT_EQ(wrong_keys(with_instead(text(), "planets = 4", "planets = 0")), Keys{"stage2.planets"});
  EXPECT_EQ(wrong_keys(with_instead(text(), "planets = 4", "planet = 4")),
            (Keys{"stage2.planets", "stage2.planet"}));
  EXPECT_EQ(wrong_keys(with_instead(text(), "teeth = 26", "teeth = 26\nmodule_mm = 1.1")).front(),
            "planet2.module_mm");
}

TEST(TwoStageFile, AHousingIsRefusedAndSaysWhatThereIs) {
  const auto read = read_design_text(text() + "\n[housing]\n[motor]\nname = \"nema17\"\n[bearings]\noutput = \"6806\"\n", "two.toml");
  ASSERT_FALSE(read);
  const auto it = std::find_if(read.error().begin(), read.error().end(), [](const Error& e) { return e.key == "housing"; });
  ASSERT_NE(it, read.error().end());
  EXPECT_NE(it->message.find("several stages"), std::string::npos);
  EXPECT_NE(it->remedy.find("[carrier]"), std::string::npos);
}

TEST(TwoStageFile, CarrierPinsAreAskedOfThePlanetsOfBothStages) {
  std::string bare = text();
  for (int i = 0; i < 2; ++i) bare = with_instead(bare, "bore_mm = 8.0\n", "\n");
  Keys keys = wrong_keys(bare);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(keys, (Keys{"planet1.bore_mm", "planet2.bore_mm"}));
}

}  // namespace
}  // namespace trueflank
