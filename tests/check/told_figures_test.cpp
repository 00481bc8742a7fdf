// SPDX-License-Identifier: GPL-3.0-or-later
//
// What checks and cures tell, taken at their word: a design is changed as the sentence says, and
// asked again; and of everything that may be there, the sentence names what is there.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/design_tolerances.h"

namespace trueflank::test {
namespace {

/// The number in brackets behind some words, as the change in "tip diameter of sun 12.3 mm (-0.2)".
double change_told(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(text.find('(', at) + 1));
}

/// Of a pair's cure, with a tip that is wanted so much shorter, or a shift so much larger.
void expect_as_told(const GearTrain& train, const TrainMesh& mesh, bool of_gear1, double shorter_mm,
                    double larger) {
  const auto number1 = static_cast<std::size_t>(mesh.gear1),
             number2 = static_cast<std::size_t>(mesh.gear2);
  const TrainGear& tip = train.gears[of_gear1 ? number1 : number2];
  const bool ring = tip.profile.gear().kind == GearKind::kInternal;
  const double now = tip.profile.tip_radius_mm(), shift1 = train.gears[number1].shift,
               shift2 = train.gears[number2].shift;
  const auto clears = [&](const GearPair& p) {
    const double radius = (of_gear1 ? *p.profile1 : *p.profile2).tip_radius_mm();
    return p.gear1().shift == shift1 && (ring ? radius - now : now - radius) >= shorter_mm;
  };
  const auto shifted = [&](const GearPair& p) {
    return (p.gear1().shift - shift1) / larger >= 1.0;
  };
  const std::string text =
      cure_text(train, mesh, of_gear1,
                {.exact = [&](const GearPair& p) { return clears(p) || shifted(p) ? 0.0 : -1.0; }});
  const std::string of_tip = "tip diameter of " + tip.name + " ",
                    of_shift = "shift of " + train.gears[number1].name + " ",
                    with = "with " + train.gears[number2].name + " ";
  const double diameter = told(text, of_tip), shift = told(text, of_shift);
  EXPECT_NEAR(diameter, 2.0 * (ring ? now + shorter_mm : now - shorter_mm), 2.1e-3) << text;
  EXPECT_GE(std::abs(diameter - 2.0 * now), 2.0 * shorter_mm) << "to the good side: " << text;
  EXPECT_NEAR(change_told(text, of_tip), diameter - 2.0 * now, 1.1e-3) << text;
  EXPECT_NEAR(shift, shift1 + larger, 1.1e-3) << text;
  EXPECT_NEAR(change_told(text, of_shift), shift - shift1, 1.1e-3) << text;
  // an external mate goes the other way, a ring the same
  EXPECT_NEAR(told(text, with),
              shift2 + (train.pair(mesh).internal() ? 1.0 : -1.0) * (shift - shift1), 2.1e-4)
      << text;
}

TEST(ToldCures, OfTipsAndShiftsAreWhatClearsAndHowFarThatIsFromWhatIsThere) {
  int meshes = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    for (const TrainMesh& mesh : train->meshes) {
      SCOPED_TRACE(std::to_string(seed) + ' ' + mesh.name);
      const bool odd = ++meshes % 2 == 1;
      expect_as_told(*train, mesh, odd, 0.05 + 0.007 * static_cast<double>(seed),
                     odd ? 0.12 : -0.07);
    }
  }
  EXPECT_GT(meshes, 25);
}

TEST(ToldTolerances, AreThoseThatAreThereOfTheDesignFirst) {
  for (int set = 0; set < 64; ++set) {
    SCOPED_TRACE(set);
    const bool own_class = set & 1, own_axes = set & 2, own_thickness = set & 4;
    const bool its_runout = set & 8, its_axes = set & 16, its_thickness = set & 32;
    GearboxDesign design = pair_design(20, 40, false, 0.1);
    if (own_class) design.made.tolerance_class = 7;
    if (own_axes) design.made.axis_tolerance_mm = 0.02;
    if (own_thickness) design.made.thickness_tolerance_mm = 0.03;
    design.made.process = Process{.name = "any",
                                  .axis_tolerance_mm = its_axes ? 0.012 : 0.0,
                                  .thickness_tolerance_mm = its_thickness ? 0.013 : 0.0,
                                  .runout_mm = its_runout ? 0.04 : 0.0};
    std::string text;
    const auto add = [&](bool there, const char* words) {
      if (there) text += (text.empty() ? "" : ", ") + std::string(words);
    };
    add(own_class, "ISO class 7");
    add(its_runout && !own_class, "runout 40 um");
    add(own_axes, "axes +-20 um");
    add(its_axes && !own_axes, "axes +-12 um");
    add(own_thickness, "tooth thickness +-30 um");
    add(its_thickness && !own_thickness, "tooth thickness +-13 um");
    const auto told = design_tolerances(laid_out(design));
    ASSERT_EQ(told.has_value(), !text.empty());
    if (!told) continue;
    EXPECT_EQ(told->text, text);
    EXPECT_EQ(told->asked, own_class || own_axes || own_thickness);
    EXPECT_EQ(told->options.runout_um.value_or(0.0) > 0.0, its_runout && !own_class);
  }
}

TEST(ToldTolerances, AClassOfTheProcessIsForGearsInsideTheStandardsScope) {
  for (const bool inside : {true, false})
    for (const double runout_mm : {0.0, 0.04}) {
      GearboxDesign design = pair_design(20, 40, false, 0.1);
      design.module_mm = inside ? 1.0 : 0.3;
      design.made.process = Process{.name = "any", .tolerance_class = 8, .runout_mm = runout_mm};
      const auto told = design_tolerances(laid_out(design));
      const std::string text = inside ? "ISO class 8" : runout_mm > 0.0 ? "runout 40 um" : "";
      ASSERT_EQ(told.has_value(), !text.empty());
      if (told) {
        EXPECT_EQ(told->text, text);
        EXPECT_FALSE(told->asked);
      }
    }
}

}  // namespace
}  // namespace trueflank::test
