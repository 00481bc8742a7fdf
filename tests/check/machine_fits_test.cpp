// SPDX-License-Identifier: GPL-3.0-or-later
// Seats by classes of ISO 286. The limits themselves: tests/train/fit_class_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "tests/check/machine_designs.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/export/part_dimensions.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

/// Diameter of a circle of a part that is near to a size.
double diameter_in(const Made& made, const std::string& part, double near_mm, bool hole) {
  for (const Slab& slab : made.part(part).slabs) {
    std::vector<Outline> outlines = slab.holes;
    if (!hole) outlines = {slab.outer};
    for (const Outline& outline : outlines)
      if (const auto* circle = std::get_if<CircleOutline>(&outline);
          circle && std::abs(2.0 * circle->radius_mm - near_mm) < 0.09)
        return 2.0 * circle->radius_mm;
  }
  return kNaN;
}
std::string fit_on_drawing(const Made& made, const std::string& part, double size_mm) {
  for (const io::PartDiameter& d : io::part_dimensions(made.train, made.part(part)).diameters)
    if (d.diameter_mm == size_mm) return d.limits.fit;
  return "none";
}
std::string in_housing(const std::string& text, const std::string& keys) {
  return replaced(text, "[housing]", "[housing]\n" + keys);
}
std::string in_bearings(const std::string& text, const std::string& keys) {
  return replaced(text, "[bearings]", "[bearings]\n" + keys);
}
const std::string kOfMetal = replaced(k3k + kMachine, "\"fdm-0.4\"", "\"hobbing\"");

TEST(Fits, SeatsAndJournalsAreMadeToTheMiddleOfTheirClass) {
  const Made made(machined(k3k + kMachine));
  // 6806: 42 H7 is 0 to +25 um, 30 g6 is -7 to -20 um; 625: 16 H7 is 0 to +18 um
  EXPECT_NEAR(diameter_in(made, "lid", 42.0, true), 42.0125, 1e-9);
  EXPECT_NEAR(diameter_in(made, "journal", 30.0, false), 29.9865, 1e-9);
  EXPECT_NEAR(diameter_in(made, "planet", 16.0, true), 16.009, 1e-9);
  const Finding& told = made.finding("fits", "output");
  EXPECT_EQ(told.status, CheckStatus::kPass);
  EXPECT_NE(told.message.find("42 H7 (+0 to +25 um), clearance +0 to +36 um"), std::string::npos)
      << told.message;
  EXPECT_NE(told.message.find("30 g6 (-20 to -7 um), clearance -3 to +20 um"), std::string::npos)
      << told.message;
}

TEST(Fits, OfDrawingsAreNominalSizesWithTheirClass) {
  const Made made(machined(k3k + kMachine));
  EXPECT_EQ(fit_on_drawing(made, "lid", 42.0), "H7");
  EXPECT_EQ(fit_on_drawing(made, "journal", 30.0), "g6");
  const Made printed(k3k + kMachine);
  EXPECT_EQ(fit_on_drawing(printed, "lid", 42.1), "");
}

TEST(Fits, ThatAPrinterDoesNotHoldAreTold) {
  const Made made(replaced(k3k + kMachine, "[housing]", "[housing]\nfit_mm = 0"));
  EXPECT_EQ(made.finding("fits", "output").status, CheckStatus::kWarn);
  const Made usual(k3k + kMachine);
  EXPECT_THROW((void)usual.finding("fits", "output"), std::runtime_error);
}

TEST(Fits, AreNamedSeatBySeat) {
  const Made made(
      in_bearings(in_housing(kOfMetal, "fit = \"H8/h6\"\nshaft_fit = \"H6\"\nring_fit = \"H7/g6\""),
                  "output_fit = \"J7/k6\"\nplanet_fit = \"N7\""));
  const auto m = machine_layout(made.train);
  // 42 J7: -11 to +14; 30 k6: +2 to +15; 16 N7: -23 to -5; 5 H6: 0 to +8 (ISO 286-2)
  EXPECT_NEAR(diameter_in(made, "lid", 42.0, true), 42.0015, 1e-9);
  EXPECT_NEAR(diameter_in(made, "journal", 30.0, false), 30.0085, 1e-9);
  EXPECT_NEAR(diameter_in(made, "planet", 16.0, true), 15.986, 1e-9);
  EXPECT_NEAR(made.train.design.gears[0].bore.diameter_mm, 5.004, 1e-9);
  // 22 H8: 0 to +33, of the collar, which names none of its own
  EXPECT_EQ(m->fits.pilot.hole, "H8");
  EXPECT_NEAR(m->fits.pilot.hole_mm(22.0), 22.0165, 1e-9);
  const double ring = 2.0 * m->ring_radius_mm;
  EXPECT_NEAR(2.0 * extent(made.part("ring1").slabs.front().outer).outer_radius_mm,
              ring + fit_limits("g6", ring)->middle_mm(), 1e-9);
  EXPECT_EQ(fit_on_drawing(made, "lid", 42.0), "J7");
  EXPECT_EQ(fit_on_drawing(made, "journal", 30.0), "k6");
  EXPECT_EQ(fit_on_drawing(made, "planet", 16.0), "N7");
  EXPECT_EQ(fit_on_drawing(made, "sun", 5.0), "H6");
  EXPECT_EQ(fit_on_drawing(made, "ring1", ring), "g6");
  const Finding& output = made.finding("fits", "output");
  EXPECT_NE(output.message.find("30 k6 (+2 to +15 um), clearance -25 to -2 um"), std::string::npos)
      << output.message;
  EXPECT_NE(made.finding("fits", "ring").message.find("g6"), std::string::npos);
  // what is pressed in does not run into each other
  EXPECT_EQ(made.finding("collision", "train").status, CheckStatus::kPass)
      << made.finding("collision", "train").message;
  EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(Fits, OfASeatLeaveTheOthersTheirClearance) {
  const Made made(in_bearings(k3k + kMachine, "output_fit = \"H7\""));
  EXPECT_NEAR(diameter_in(made, "lid", 42.0, true), 42.0125, 1e-9);
  EXPECT_NEAR(diameter_in(made, "journal", 29.9, false), 29.9, 1e-9);
  EXPECT_NEAR(diameter_in(made, "planet", 16.1, true), 16.1, 1e-9);
  EXPECT_EQ(made.finding("fits", "output").status,
            CheckStatus::kWarn);  // a printer does not hold it
  EXPECT_THROW((void)made.finding("fits", "planet"), std::runtime_error);
}

TEST(Fits, ThatAreTightTakeTheClearanceOfABearing) {
  // 6806: bore of 30 at -10 to 0 um; group N of 30 mm: 5 to 20 um, 12.5 in the middle (ISO 5753-1)
  const auto told = [](const std::string& fit) {
    return Made(in_bearings(in_housing(kOfMetal, "fit_mm = 0"), "output_fit = \"" + fit + "\""))
        .finding("fits", "output");
  };
  // k6 is +2 to +15: 13.5 um larger than the bore, of which the raceway takes 0.8
  const Finding usual = told("H7/k6");
  EXPECT_EQ(usual.status, CheckStatus::kPass);
  EXPECT_NE(usual.message.find("they leave 1.7 um"), std::string::npos) << usual.message;
  // p6 is +22 to +35: 33.5 um
  const Finding tight = told("H7/p6");
  EXPECT_EQ(tight.status, CheckStatus::kWarn);
  EXPECT_NEAR(tight.value, (12.5 - 0.8 * 33.5) / 1000.0, 1e-9);
  EXPECT_NE(tight.cure.find("C3"), std::string::npos);
  // a tight seat adds to it: 42 P7 is -42 to -17, the ring -11 to 0
  EXPECT_NEAR(told("P7/k6").value, (12.5 - 0.8 * (13.5 + 29.5 - 5.5)) / 1000.0, 1e-9);
  EXPECT_EQ(told("H7/g6").message.find("ISO 5753"), std::string::npos);
}

TEST(Fits, OfPinsAreThoseOfTheirHoles) {
  const Made made(in_housing(kOfMetal, "fit_mm = 0\npin_fit = \"N7\""));
  // 5 N7: -16 to -4
  EXPECT_NEAR(machine_layout(made.train)->carrier.pin_hole_diameter_mm, 4.99, 1e-9);
  EXPECT_EQ(made.finding("collision", "train").status, CheckStatus::kPass);
  EXPECT_NE(made.finding("fits", "pins").message.find("5 N7"), std::string::npos);
}

TEST(Fits, AGearThatIsPressedOnItsShaftIsNoMistake) {
  const Made made(in_housing(kOfMetal, "fit_mm = 0\nshaft_fit = \"N7\""));
  EXPECT_NE(made.finding("shaft_grip", "sun").status, CheckStatus::kFail);
  const Made narrow(replaced(kOfMetal, "[sun]", "[sun]\nbore_mm = 4.99"));
  EXPECT_EQ(narrow.finding("shaft_grip", "sun").status, CheckStatus::kFail);
}

TEST(Fits, AreReadAndWrittenBackAndRefusedWithTheirKey) {
  const GearboxDesign design = design_of(in_bearings(
      in_housing(k3k + kMachine, "fit = \"H7/k6\"\npin_fit = \"P7\""), "planet_fit = \"M7\""));
  EXPECT_EQ(design.machine->housing.fit->text(), "H7/k6");
  EXPECT_EQ(design_of(design_file_text(design, "")), design);
  for (const char* bad : {"H7/", "/k6", "k6/H7", "h7/k6", "H7/k6/g5", "X7", "H3", "", "H7 /k6"})
    EXPECT_EQ(first_key(in_housing(k3k + kMachine, std::string("fit = \"") + bad + "\"")),
              "housing.fit")
        << bad;
  EXPECT_EQ(first_key(in_housing(k3k + kMachine, "shaft_fit = \"H7/h6\"")), "housing.shaft_fit");
  EXPECT_EQ(first_key(in_bearings(k3k + kMachine, "wheel_fit = \"H7\"")), "bearings.wheel_fit");
}

}  // namespace
}  // namespace trueflank
