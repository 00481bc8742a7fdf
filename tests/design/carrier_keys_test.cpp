// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"

namespace trueflank {
namespace {

std::string simple(const std::string& bore, const std::string& carrier) {
  return "format = 1\n[gearbox]\nkind = \"simple\"\nplanets = 3\nmodule_mm = 1\n"
         "[sun]\nteeth = 18\nface_width_mm = 8\n[planet]\nteeth = 18\nface_width_mm = 8\n" +
         bore + "[ring]\nteeth = 54\nface_width_mm = 8\n" + carrier;
}

std::string first_key(const std::string& text) {
  const auto design = read_design_text(text, "carrier.toml");
  return design ? "" : design.error().front().key;
}

TEST(CarrierKeys, AreReadAndWrittenBack) {
  const std::string text = simple("bore_mm = 6\n",
                                  "[carrier]\nplate_thickness_mm = 5\npin_diameter_mm = 5.5\n"
                                  "bearing_diameter_mm = 16\nbearing_width_mm = 4\n");
  const auto design = read_design_text(text, "carrier.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  ASSERT_TRUE(design->carrier);
  EXPECT_EQ(design->carrier->plate_thickness_mm, 5.0);
  EXPECT_EQ(design->carrier->pin_diameter_mm, 5.5);
  EXPECT_EQ(design->carrier->bearing_width_mm, 4.0);
  const auto again = read_design_text(design_file_text(*design, ""), "carrier.toml");
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *design);
}

TEST(CarrierKeys, WhatDoesNotAgreeIsTold) {
  const std::string bore = "bore_mm = 6\n";
  EXPECT_EQ(first_key(simple(bore, "[carrier]\nplate_thickness_mm = 5\n")), "");
  EXPECT_EQ(first_key(simple(bore, "[carrier]\n")), "carrier.plate_thickness_mm");
  EXPECT_EQ(first_key(simple("", "[carrier]\nplate_thickness_mm = 5\n")), "planet.bore_mm");
  EXPECT_EQ(first_key(simple(bore, "[carrier]\nplate_thickness_mm = 5\npin_diameter_mm = 6\n")),
            "carrier.pin_diameter_mm");
  EXPECT_EQ(first_key(simple(bore, "[carrier]\nplate_thickness_mm = 5\nbearing_width_mm = 2\n")),
            "carrier.bearing_diameter_mm");
  EXPECT_EQ(first_key(simple(bore, "[carrier]\nplate_thickness_mm = 5\nbearing_diameter_mm = 12\n"
                                   "bearing_width_mm = 5\n")),
            "carrier.bearing_width_mm");
  EXPECT_EQ(first_key(simple(bore, "[carrier]\nplate_thickness_mm = 5\nplates = 2\n")),
            "carrier.plates");
  EXPECT_EQ(first_key("carrier = 3\n" + simple(bore, "")), "carrier");
  EXPECT_EQ(first_key("format = 1\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1\n"
                      "[gear]\nteeth = 20\nface_width_mm = 5\n[carrier]\nplate_thickness_mm = 5\n"),
            "carrier");
}

}  // namespace
}  // namespace trueflank
