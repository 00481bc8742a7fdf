// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_file.h"

#include <gtest/gtest.h>

#include "trueflank/base/units.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kSimple = R"(format = 1
name = "small"
[gearbox]
kind = "simple"
planets = 3
module_mm = 0.5
backlash_mm = 0.04
[rack]
pressure_angle_deg = 25
[sun]
teeth = 18
shift = 0.1
face_width_mm = 8
bore_mm = 4
bore_d_flat_mm = 3.5
[planet]
teeth = 27
face_width_mm = 8.5
thinning_um = 30
[planet.modifications]
tip_relief_um = 8
tip_relief_start_diameter_mm = 14.1
[ring]
teeth = 72
face_width_mm = 8
root = "shaper"
cutter = { teeth = 25, tip_radius = 0.2 }
)";

TEST(DesignFile, IsReadIntoMillimetresAndRadians) {
  const auto design = read_design_text(kSimple, "small.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  EXPECT_EQ(design->name, "small");
  EXPECT_EQ(design->topology, train_topology("simple", "carrier"));
  EXPECT_EQ(design->planets, 3);
  EXPECT_EQ(design->module_mm, 0.5);
  EXPECT_EQ(design->backlash_mm, 0.04);
  EXPECT_EQ(design->rack.pressure_angle_rad, rad_from_deg(25.0));
  EXPECT_EQ(design->rack.dedendum, 1.25);
  ASSERT_EQ(design->gears.size(), 3u);
  const GearDesign& sun = design->gears[0];
  EXPECT_EQ(sun.name, "sun");
  EXPECT_EQ(sun.teeth, 18);
  EXPECT_EQ(sun.shift, 0.1);
  EXPECT_EQ(sun.face_width_mm, 8.0);
  EXPECT_EQ(sun.bore, (BoreDesign{.diameter_mm = 4.0, .kind = BoreKind::kDFlat, .d_flat_mm = 3.5}));
  const GearDesign& planet = design->gears[1];
  EXPECT_FALSE(planet.shift);
  EXPECT_DOUBLE_EQ(*planet.thinning_mm, 0.03);
  EXPECT_EQ(planet.modifications.tip_relief_um, 8.0);
  const GearDesign& ring = design->gears[2];
  EXPECT_EQ(ring.kind, GearKind::kInternal);
  EXPECT_EQ(ring.root, RingRoot::kShaper);
  EXPECT_EQ(ring.cutter, (ShaperCutter{.teeth = 25, .shift = 0.0, .tip_radius = 0.2}));
}

TEST(DesignFile, MayHoldEveryKeyThereIs) {
  const auto design = read_design_text(R"(format = 1
name = "bilateral-drive-96"

[gearbox]
kind = "3k"
output = "ring2"
planets = 3
module_mm = 1.0
centre_distance_mm = 25.6826
friction = 0.1
backlash_mm = 0.0
layer_gap_mm = 1.0
helix_angle_deg = 0.0
herringbone = false

[rack]
pressure_angle_deg = 20.0
addendum = 1.0
dedendum = 1.25
root_radius = 0.38

[sun]
teeth = 12
module_mm = 1
face_width_mm = 10.0
bore_mm = 5.0

[ring1]
teeth = 90
shift = 0.5225
face_width_mm = 10
outer_diameter_mm = 104.0
root = "fillet"
[ring1.cutter]
teeth = 25
shift = 0.0
tip_radius = 0.2
[planet1.modifications]
tip_relief_um = 8
tip_relief_start_diameter_mm = 40.5
crowning_um = 0
edge_chamfer_mm = 0.0
[planet1]
teeth = 39
face_width_mm = 10
tip_diameter_mm = 41.5
thinning_um = 20
[planet2]
teeth = 32
face_width_mm = 10
[ring2]
teeth = 81
shift = 1.9967
face_width_mm = 10
)",
                                       "all.toml");
  ASSERT_TRUE(design) << design.error().front().key << " " << design.error().front().message;
  EXPECT_EQ(design->gears[1].name, "planet1");
  EXPECT_EQ(design->gears[1].modifications.tip_relief_start_diameter_mm, 40.5);
  EXPECT_EQ(design->gears[2].root, RingRoot::kFillet);
  EXPECT_TRUE(design->gears[2].cutter);
}

TEST(DesignFile, IsNamedAfterItsFileWhereItHasNoName) {
  const auto design = read_design_text(
      "format = 1\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1\n"
      "[gear]\nteeth = 20\nface_width_mm = 5\n",
      "folder/my-gear.toml");
  ASSERT_TRUE(design) << design.error().front().message;
  EXPECT_EQ(design->name, "my-gear");
  EXPECT_EQ(design_name_from("gr\xC3\xB6\xC3\x9F" "e"), "größe");
  EXPECT_EQ(design_name_from("a\x1B[1m\u009Bb"), "a[1mb");
  EXPECT_EQ(design_name_from("\xFF\xFE"), "gearbox");
  EXPECT_EQ(design_name_from(std::string(99, 'x') + "ö"), std::string(99, 'x'));
}

TEST(DesignFile, TellsAllItsErrorsInTheOrderOfTheLines) {
  const auto design = read_design_text(
      "format = 1\n[gearbox]\nkind = \"gear\"\nmodul_mm = 1\nmodule_mm = nan\n[gear]\nteeth = 2\n",
      "bad.toml");
  ASSERT_FALSE(design);
  ASSERT_EQ(design.error().size(), 4u);
  const Errors& errors = design.error();
  EXPECT_EQ(errors[0].key, "gearbox.modul_mm");
  EXPECT_EQ(errors[0].line, 4);
  EXPECT_EQ(errors[0].message, "unknown key; did you mean module_mm?");
  EXPECT_EQ(errors[1].key, "gearbox.module_mm");
  EXPECT_EQ(errors[1].value, "nan");
  EXPECT_EQ(errors[2].key, "gear.face_width_mm");
  EXPECT_EQ(errors[2].code, ErrorCode::kMissingKey);
  EXPECT_EQ(errors[3].key, "gear.teeth");
  EXPECT_EQ(errors[3].file, "bad.toml");
  EXPECT_EQ(errors[3].line, 7);
}

}  // namespace
}  // namespace trueflank
