// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace trueflank {
namespace {

const std::string kSmall =
    "format = 1\n[gearbox]\nkind = \"3k\"\n[ratio]\nmin = 90\nmax = 100\n";

Errors errors_of(const std::string& text) {
  const auto read = read_requirements_text(text, "needs.toml");
  EXPECT_FALSE(read.has_value());
  return read ? Errors{} : read.error();
}

TEST(RequirementsFile, TheLeastFileTakesTheDefaultsThePageStates) {
  const auto read = read_requirements_text(kSmall, "folder/needs.toml");
  ASSERT_TRUE(read.has_value()) << read.error().front().message;
  EXPECT_EQ(read->name, "needs");
  EXPECT_EQ(read->ratio_min, 90);
  EXPECT_EQ(read->shift_max, 2.0);
  EXPECT_EQ(read->objectives, std::vector<SearchObjective>{SearchObjective::kForward});
  EXPECT_TRUE(read->identical_planets);
}

TEST(RequirementsFile, EveryKeyReachesItsRequirement) {
  const auto read = read_requirements_text(
      kSmall +
          "direction = \"opposite\"\n"
          "[rack]\npressure_angle_deg = 25\naddendum = 0.9\ndedendum = 1.2\nroot_radius = 0.3\n"
          "[teeth]\nsun_min = 7\nsun_max = 8\nplanet1_min = 9\nplanet1_max = 10\nring1_min = 20\n"
          "ring1_max = 30\nplanet2_min = 11\nplanet2_max = 12\nring2_min = 21\nring2_max = 31\n"
          "identical_planets = false\n"
          "[shift]\nmin = -0.5\nmax = 0.9\n"
          "[limits]\ncontact_ratio_min = 1.1\ncontact_ratio_max = 1.9\ntip_clearance = 0.2\n"
          "clearance_um = 7\n"
          "tip_thickness = 0.3\nplanet_clearance_mm = 1\n"
          "[strength]\noutput_torque_nm = 12\nmaterial = \"mine\"\nreversing = false\n"
          "bending_safety = 1.5\n"
          "[material.mine]\nbending_limit_mpa = 100\ncontact_limit_mpa = 500\n"
          "elastic_modulus_mpa = 2e5\npoisson_ratio = 0.3\ndensity_kg_m3 = 7800\n"
          "[search]\nobjectives = \"backward, size\"\nloss_model = \"contact_ratios\"\nresults = 5\n",
      "needs.toml");
  ASSERT_TRUE(read.has_value()) << read.error().front().message << read.error().front().key;
  EXPECT_EQ(read->direction, OutputDirection::kOpposite);
  EXPECT_NEAR(read->rack.pressure_angle_rad, rad_from_deg(25), 1e-15);
  EXPECT_EQ(read->sun.min, 7);
  EXPECT_EQ(read->ring2.max, 31);
  EXPECT_FALSE(read->identical_planets);
  EXPECT_EQ(read->shift_min, -0.5);
  EXPECT_EQ(read->contact_ratio_max, 1.9);
  EXPECT_EQ(read->output_torque_nm, 12);
  EXPECT_EQ(read->strength.materials.find("mine")->bending_limit_mpa, 100);
  EXPECT_FALSE(read->strength.reversing);
  EXPECT_EQ(read->objectives.size(), 2u);
  EXPECT_EQ(read->objectives[1], SearchObjective::kSize);
  EXPECT_EQ(read->loss_model, LossModel::kContactRatios);
  EXPECT_EQ(read->results, 5);
}

TEST(RequirementsFile, AllErrorsAreToldAtOnceWithLineAndRemedy) {
  const Errors errors = errors_of(
      "format = 1\n[gearbox]\nkind = \"3k\"\nplanetts = 3\nfriction = \"much\"\n[ratio]\nmin = 90\n"
      "max = 1e9\n[search]\nobjectives = \"fast\"\n[nonsense]\n");
  ASSERT_EQ(errors.size(), 5u);
  EXPECT_EQ(errors[0].key, "gearbox.planetts");
  EXPECT_EQ(errors[0].line, 4);
  EXPECT_EQ(errors[0].remedy, "did you mean planets?");
  EXPECT_EQ(errors[1].code, ErrorCode::kWrongType);
  EXPECT_EQ(errors[2].key, "ratio.max");
  EXPECT_EQ(errors[3].key, "search.objectives");
  EXPECT_EQ(errors[4].key, "nonsense");
  for (const Error& error : errors) EXPECT_EQ(error.file, "needs.toml");
}

TEST(RequirementsFile, ContradictionsAreErrorsOfTheirKeys) {
  EXPECT_EQ(errors_of("format = 1\n[gearbox]\nkind = \"3k\"\n[ratio]\nmin = 100\nmax = 90\n")[0].key,
            "ratio.max");
  EXPECT_EQ(errors_of(kSmall + "[teeth]\nsun_min = 20\nsun_max = 10\n")[0].key, "teeth.sun_max");
  EXPECT_EQ(errors_of(kSmall + "[shift]\nmin = 1\nmax = 0\n")[0].key, "shift.max");
  EXPECT_EQ(errors_of(kSmall + "[strength]\nmaterial = \"cheese\"\n")[0].key, "strength.material");
  EXPECT_EQ(errors_of("format = 1\n")[0].code, ErrorCode::kMissingKey);
  EXPECT_EQ(errors_of("what is this")[0].code, ErrorCode::kSyntax);
}

TEST(RequirementsFile, KindsPlanetsAndTeethOfEveryNameAreRead) {
  const auto read = read_requirements_text(
      "format = 1\n[gearbox]\nkind = \"3k, stepped, pair\"\nplanets = \"3, 4\"\noutput = \"ring1, carrier\"\n"
      "input = \"any\"\nwheel = \"any\"\n[ratio]\nmin = 3\nmax = 9\n[teeth]\nring_max = 70\nplanet_min = 20\n"
      "pinion_max = 30\nwheel_min = 31\n",
      "needs.toml");
  ASSERT_TRUE(read.has_value()) << read.error().front().message << read.error().front().key;
  EXPECT_EQ(read->kinds, (std::vector<std::string>{"3k", "stepped", "pair"}));
  EXPECT_EQ(read->planets, (std::vector<int>{3, 4}));
  EXPECT_EQ(read->outputs, (std::vector<std::string>{"ring1", "carrier"}));
  EXPECT_TRUE(read->internal_wheels && read->external_wheels);
  EXPECT_EQ(read->ring.max, 70);
  EXPECT_EQ(read->planet.min, 20);
  EXPECT_EQ(read->pinion.max, 30);
  EXPECT_EQ(read->wheel.min, 31);
}

TEST(RequirementsFile, WhatNoKindHasIsAnErrorOfItsKey) {
  const auto first = [](const std::string& lines, const std::string& more = "") {
    const Errors errors = errors_of("format = 1\n[gearbox]\n" + lines + "\n[ratio]\nmin = 3\nmax = 9\n" + more);
    EXPECT_EQ(errors.size(), 1u) << lines;
    EXPECT_FALSE(errors.front().value.empty());
    EXPECT_FALSE(errors.front().remedy.empty());
    return errors.front().key;
  };
  for (const char* line : {"kind = \"simpel\"", "kind = \"\"", "kind = \"3k,\"", "kind = \"gear\"",
                           "kind = \"simple, simple\"", "kind = 3"})
    EXPECT_EQ(first(line), "gearbox.kind");
  EXPECT_EQ(first("kind = \"simple\"\noutput = \"ring2\""), "gearbox.output");
  EXPECT_EQ(first("kind = \"pair\"\ninput = \"carrier\""), "gearbox.input");
  EXPECT_EQ(first("kind = \"pair\"\nwheel = \"both\""), "gearbox.wheel");
  for (const char* planets : {"0", "21", "2.5", "\"3, x\"", "\"3, 3\"", "\"\"", "\"3,,4\"", "true"})
    EXPECT_EQ(first(std::string("kind = \"simple\"\nplanets = ") + planets), "gearbox.planets");
  EXPECT_EQ(first("kind = \"simple\"", "[teeth]\nring_min = 70\nring_max = 60\n"), "teeth.ring_max");
  EXPECT_EQ(first("kind = \"pair\"", "[teeth]\npinion_min = 70\n"), "teeth.pinion_max");
}

TEST(RequirementsFile, MaterialsExtendATable) {
  const auto table = read_materials_text(
      "[material.pom]\nbending_limit_mpa = 40\ncontact_limit_mpa = 70\nelastic_modulus_mpa = 2900\n"
      "poisson_ratio = 0.35\ndensity_kg_m3 = 1400\nsource = \"own tests\"\n",
      "m.toml");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->find("pom")->source, "own tests");
  EXPECT_NE(table->find("brass"), nullptr);
  EXPECT_FALSE(read_materials_text("[material.x]\npoisson_ratio = 3\n", "m.toml").has_value());
}

TEST(RequirementsFile, FiguresAreLimitsObjectivesAndWeights) {
  const auto read = read_requirements_text(
      kSmall +
          "[limits]\nmass_max_kg = 0.8\nhunting = true\nphasing = \"sequential\"\nassembling_share_min = 0.99\n"
          "tolerance_class = 7\naxis_tolerance_um = 10\n[motor]\ntorque_nm = 0.4\nmove_deg = 180\n"
          "[search]\nobjectives = \"forward: 1, settling: 0.25\"\n",
      "needs.toml");
  ASSERT_TRUE(read.has_value()) << read.error().front().message << read.error().front().key;
  EXPECT_EQ(read->figure_limits, (std::vector<FigureLimit>{{SearchObjective::kMass, 0.8}}));
  EXPECT_TRUE(read->hunting && read->sequential);
  EXPECT_EQ(read->assembling_share_min, 0.99);
  EXPECT_EQ(read->tolerance->tolerance_class, 7);
  EXPECT_EQ(read->tolerance->centre_distance_um, 10);
  EXPECT_NEAR(read->motor.move_rad, kPi, 1e-12);
  EXPECT_EQ(read->objectives, std::vector<SearchObjective>{SearchObjective::kWeighted});
  EXPECT_EQ(read->weights, (std::vector<ObjectiveWeight>{{SearchObjective::kForward, 1.0},
                                                         {SearchObjective::kSettling, 0.25}}));
}

TEST(RequirementsFile, FiguresWithoutWhatTheyNeedAreErrors) {
  EXPECT_EQ(errors_of(kSmall + "[search]\nobjectives = \"settling\"\n")[0].key, "motor.torque_nm");
  EXPECT_EQ(errors_of(kSmall + "[limits]\nstarting_torque_max_nm = 1\n")[0].key, "losses.drag_torque_nm");
  EXPECT_EQ(errors_of(kSmall + "[limits]\nassembling_share_min = 0.9\n")[0].key, "limits.tolerance_class");
  EXPECT_EQ(errors_of("format = 1\n[gearbox]\nkind = \"3k\"\nmodule_max_mm = 2\n[ratio]\nmin = 90\nmax = 100\n")[0].key,
            "strength.output_torque_nm");
  EXPECT_EQ(errors_of(kSmall + "[search]\nobjectives = \"forward: 1, mass\"\n")[0].key, "search.objectives");
  EXPECT_EQ(errors_of(kSmall + "[search]\nobjectives = \"forward: -1\"\n")[0].key, "search.objectives");
}

TEST(RequirementsFile, ATableOfTheCutterAloneIsOneWithTheUsualCutter) {
  const std::string rest = "[ratio]\nmin = 6\nmax = 7\n";
  const std::string begin = "format = 1\n[gearbox]\nkind = \"simple\"\n";
  EXPECT_FALSE(read_requirements_text(begin + rest, "r.toml")->cutter);
  EXPECT_EQ(read_requirements_text(begin + "[cutter]\n" + rest, "r.toml")->cutter, ShaperCutter{});
  const auto shaped =
      read_requirements_text(begin + "[cutter]\nteeth = 18\nshift = 0.1\ntip_radius = 0.2\n" + rest, "r.toml");
  EXPECT_EQ(shaped->cutter, (ShaperCutter{.teeth = 18, .shift = 0.1, .tip_radius = 0.2}));
}

TEST(RequirementsFile, EveryKeyHasItsPlaceInTheListOfTables) {
  const auto tables = requirements_tables();
  EXPECT_EQ(tables.size(), 13u);
  for (const RequirementsTable& table : tables) EXPECT_FALSE(table.rules.empty()) << table.name;
}

TEST(RequirementsFile, ThePageInDocsListsEveryKey) {
  std::ostringstream page;
  page << std::ifstream(TRUEFLANK_SOURCE_DIR "/docs/requirements-file.md").rdbuf();
  for (const RequirementsTable& table : requirements_tables())
    for (const KeyRule& rule : table.rules) {
      const std::string place = table.name.empty() ? "" : "`[" + table.name + "]` ";
      EXPECT_NE(page.str().find("| " + place + "`" + rule.name + "` | " + wanted(rule)),
                std::string::npos)
          << table.name << "." << rule.name;
    }
}

}  // namespace
}  // namespace trueflank
