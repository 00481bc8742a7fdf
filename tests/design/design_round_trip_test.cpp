// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever design a file can hold is written as a file that holds the equal design.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "trueflank/base/units.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

/// Designs that the reader takes, with numbers of all 53 bits; whether they turn does not matter.
class RandomDesigns {
 public:
  explicit RandomDesigns(unsigned seed) : engine_(seed) {}

  GearboxDesign next() {
    const auto& kinds = train_kinds();
    const TrainKind& kind = kinds[static_cast<std::size_t>(whole(0, static_cast<int>(kinds.size()) - 1))];
    const std::size_t outputs = kind.outputs.size(), inputs = kind.inputs.size();
    GearboxDesign d{.name = name()};
    d.topology = train_topology(kind.name, outputs > 1 ? kind.outputs[coin() ? 1 : 0] : "",
                                inputs > 1 ? kind.inputs[coin() ? 1 : 0] : "");
    const bool planetary = d.topology.has_planets(), alone = d.topology.meshes.empty();
    if (planetary) d.planets = whole(1, 50);
    d.module_mm = real(1.0, 3.0);
    if (!alone && coin()) d.centre_distance_mm = real(0.01, 1e5);
    for (int stage = 2; stage <= d.topology.stage_count(); ++stage) {
      StageDesign& later = d.later_stages.emplace_back(StageDesign{.planets = whole(1, 50)});
      if (coin()) later.module_mm = real(1.0, 3.0);
      if (coin()) later.centre_distance_mm = real(0.01, 1e5);
    }
    d.friction = real(0.0, 1.0);
    d.backlash_mm = coin() ? real(0.0, 1.0) : 0.0;
    d.layer_gap_mm = coin() ? real(0.0, 9.0) : 1.0;
    if (coin()) d.helix_angle_rad = rad_from_deg(real(-59.0, 59.0));
    d.herringbone = d.helix_angle_rad != 0.0 && coin();
    if (d.herringbone && coin()) d.relief_groove_mm = real(0.1, 2.9);
    d.rack = {.pressure_angle_rad = rad_from_deg(real(14.0, 30.0)),
              .addendum = real(0.5, 1.5),
              .dedendum = real(0.5, 1.5),
              .root_radius = coin() ? real(0.0, 0.4) : 0.0};
    if (!alone && coin()) {  // there is an external gear
      d.rack.protuberance = real(0.01, 0.1);
      d.rack.protuberance_angle_rad = rad_from_deg(real(2.0, 13.0));
      d.rack.grinding_stock = coin() ? d.rack.protuberance * real(0.0, 0.9) : 0.0;
    }
    if (coin()) d.made.process = *ProcessTable().find(coin() ? "fdm-0.4" : "wire-edm");
    if (coin()) d.made.kerf_mm = real(0.0, 1.0);
    for (const TopologyGear& gear : d.topology.gears) d.gears.push_back(next_gear(gear.name));
    return d;
  }

 private:
  GearDesign next_gear(const std::string& gear_name) {
    GearDesign g{.name = gear_name};
    const bool either = gear_name == "wheel" || gear_name == "gear";
    if (gear_name.starts_with("ring") || (either && coin())) g.kind = GearKind::kInternal;
    const bool ring = g.kind == GearKind::kInternal;
    g.teeth = ring ? whole(200, 1500) : whole(20, 150);
    if (coin()) g.shift = real(-2.0, 2.0);
    g.face_width_mm = real(3.0, 100.0);
    if (coin()) g.tip_diameter_mm = ring ? real(1.0, 2.0) : real(4e4, 1e5);
    if (coin())
      g.thinning_mm = mm_from_um(real(0.0, 500.0));
    else if (coin())
      g.thickness = ThicknessAllowance{.series = "cd25"};
    else if (coin())
      g.thickness = ThicknessAllowance{.upper_mm = mm_from_um(real(-50.0, 50.0)),
                                       .lower_mm = mm_from_um(real(-500.0, -50.0))};
    if (ring)
      dress_ring(g);
    else if (gear_name != "planet2")
      g.bore = bore();
    if (coin()) {
      g.modifications = {.profile_crowning_um = real(0.0, 5.0),
                         .profile_slope_um = real(-5.0, 5.0),
                         .crowning_um = real(0.0, 20.0),
                         .helix_slope_um = real(-9.0, 9.0),
                         .edge_chamfer_mm = real(0.0, 1.0),
                         .tip_rounding_mm = real(0.0, 0.2)};
      if (coin()) {
        g.modifications.end_relief_um = coin() ? real(0.0, 9.0) : 0.0;
        g.modifications.end_relief_length_mm = real(0.1, 1.5);
        if (coin()) g.modifications.end_relief_shape = ReliefShape::kLinear;
      }
      if (!g.tip_diameter_mm) {
        g.modifications.tip_relief_um = real(1.0, 20.0);
        g.modifications.tip_relief_start_diameter_mm = real(10.0, 100.0);
        g.modifications.root_relief_um = real(1.0, 20.0);
        g.modifications.root_relief_start_diameter_mm = real(10.0, 100.0);
        if (coin()) g.modifications.root_relief_shape = ReliefShape::kLinear;
      }
    }
    return g;
  }

  void dress_ring(GearDesign& g) {
    if (coin()) g.outer_diameter_mm = real(1e5, 2e5);
    if (coin())
      g.bolt_circle = {.count = whole(1, 30),
                       .circle_diameter_mm = real(5e4, 9e4),
                       .hole_diameter_mm = real(1.0, 9.0)};
    if (coin()) {
      g.root = coin() ? RingRoot::kShaper : RingRoot::kFillet;
      g.cutter = ShaperCutter{
          .teeth = whole(5, 100), .shift = real(-1.0, 1.0), .tip_radius = real(0.0, 0.3)};
    }
  }

  BoreDesign bore() {
    const double d = real(1.0, 4.0);
    switch (whole(0, 4)) {
      case 0: return {.diameter_mm = d};
      case 1: return {.diameter_mm = d, .kind = BoreKind::kHex};
      case 2: return {.diameter_mm = d, .kind = BoreKind::kDFlat, .d_flat_mm = d * real(0.6, 0.9)};
      case 3:
        return {.diameter_mm = d,
                .kind = BoreKind::kKeyway,
                .keyway_width_mm = d * real(0.1, 0.5),
                .keyway_depth_mm = real(0.1, 0.5)};
      default: return {};
    }
  }

  std::string name() {
    const char* pieces[] = {"a", " ", "\"", "\\", "'", "#", "ä", "齿", "=", "[", "]", "\U0001F600"};
    std::string text = "n";
    for (int i = whole(0, 12); i > 0; --i) text += pieces[whole(0, 11)];
    return text;
  }

  // The distributions of the standard library differ from one implementation to the next.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double real(double lower, double upper) { return lower + (upper - lower) * unit(); }
  int whole(int lower, int upper) {
    return lower + static_cast<int>(engine_() % static_cast<unsigned>(upper - lower + 1));
  }
  bool coin() { return engine_() >> 63; }

  std::mt19937_64 engine_;
};

TEST(DesignRoundTrip, WrittenDesignsReadBackEqual) {
  RandomDesigns designs(20240607);
  for (int i = 0; i < 1000; ++i) {
    const GearboxDesign design = designs.next();
    const std::string text = design_file_text(design, "case " + std::to_string(i));
    const auto read = read_design_text(text, "x.toml");
    ASSERT_TRUE(read) << read.error().front().key << ": " << read.error().front().message << "\n"
                      << text;
    ASSERT_EQ(*read == design, true) << text;
    ASSERT_EQ(design_file_text(*read, "case " + std::to_string(i)), text);
  }
}

TEST(DesignRoundTrip, AnglesNoDegreeHitsComeBackToOneUnitInTheLastPlace) {
  GearboxDesign design = RandomDesigns(7).next();
  std::mt19937_64 engine(7);
  for (int i = 0; i < 500; ++i) {
    const double angle_rad = 0.1 + 0.66 * static_cast<double>(engine() >> 11) * 0x1p-53;
    design.rack.pressure_angle_rad = angle_rad;
    const auto read = read_design_text(design_file_text(design), "x.toml");
    ASSERT_TRUE(read);
    const double back_rad = read->rack.pressure_angle_rad;
    EXPECT_LE(std::abs(back_rad - angle_rad), std::nextafter(angle_rad, 1.0) - angle_rad);
  }
}

TEST(DesignRoundTrip, NumbersAreWrittenAsPeopleWriteThem) {
  GearboxDesign design{.name = "short", .topology = train_topology("gear"), .module_mm = 1.25};
  design.rack.pressure_angle_rad = rad_from_deg(14.5);
  design.gears = {{.name = "gear", .teeth = 20, .thinning_mm = mm_from_um(35.0)}};
  const std::string text = design_file_text(design, "two\nlines");
  EXPECT_EQ(text.substr(0, 14), "# two\n# lines\n");
  for (const char* line : {"\nmodule_mm = 1.25\n", "\npressure_angle_deg = 14.5\n",
                           "\nthinning_um = 35.0\n", "\nroot_radius = 0.38\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

}  // namespace
}  // namespace trueflank
