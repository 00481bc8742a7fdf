// SPDX-License-Identifier: GPL-3.0-or-later
// Seats by ISO 286, ISO 492 and ISO 5753-1, by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/check/machine_bodies.h"
#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_fits.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

const std::string kFitted = machined(k3k + kMachine);

TEST(FitFigures, ClearancesOfBearingsFollowFromIsoClassesAndRings) {
  GearTrain train = *lay_out(design_of(kFitted));
  struct Case {
    double size;
    const char* clearance;
  };
  // H7 is 0 to IT7, the ring up to so much below its size (ISO 492, class Normal)
  for (const Case& c : std::array<Case, 9>{{{16, "+0 to +26"},
                                            {18, "+0 to +26"},
                                            {30, "+0 to +30"},
                                            {50, "+0 to +36"},
                                            {80, "+0 to +43"},
                                            {120, "+0 to +50"},
                                            {150, "+0 to +58"},
                                            {180, "+0 to +65"},
                                            {250, "+0 to +76"}}}) {
    train.design.machine->bearings.output.outer_mm = c.size;
    EXPECT_TRUE(says(only(check_fits(train), "fits", "output").message,
                     std::string("clearance ") + c.clearance))
        << c.size << only(check_fits(train), "fits", "output").message;
  }
  train.design.machine->bearings.output.outer_mm = 260.0;
  const Finding large = only(check_fits(train), "fits", "output");
  EXPECT_EQ(large.status, CheckStatus::kWarn);
  EXPECT_EQ(large.margin, -1.0);
  EXPECT_TRUE(std::isnan(large.value));
  EXPECT_TRUE(says(large.message, "above 250 mm"));
  train.design.machine->bearings.output.outer_mm = 180.0;
  // g6
  for (const Case& c : std::array<Case, 6>{{{18, "-2 to +17"},
                                            {30, "-3 to +20"},
                                            {50, "-3 to +25"},
                                            {80, "-5 to +29"},
                                            {120, "-8 to +34"},
                                            {180, "-11 to +39"}}}) {
    train.design.machine->bearings.output.bore_mm = c.size;
    EXPECT_TRUE(says(only(check_fits(train), "fits", "output").message,
                     std::string("clearance ") + c.clearance))
        << c.size << only(check_fits(train), "fits", "output").message;
  }
}

TEST(FitFigures, TightJournalsLeaveOfEachBoresClearanceWhatTheRacewayDoesNotTake) {
  GearTrain train =
      *lay_out(design_of(replaced(kFitted, "[bearings]", "[bearings]\noutput_fit = \"H7/k6\"")));
  Bearing& bearing = train.design.machine->bearings.output;
  bearing.outer_mm = 180.0;
  struct Case {
    double bore, left_um;
  };
  // the middle of group N less 0.8 of k6's middle over that of the bore
  for (const Case& c : std::array<Case, 8>{{{10, -0.1},
                                            {18, 2.1},
                                            {30, 1.7},
                                            {40, 0.2},
                                            {50, 1.7},
                                            {65, 2.8},
                                            {80, 4.8},
                                            {100, 4.8}}}) {
    bearing.bore_mm = c.bore;
    const Finding told = only(check_fits(train), "fits", "output");
    EXPECT_EQ(told.status, c.left_um < 0.0 ? CheckStatus::kWarn : CheckStatus::kPass) << c.bore;
    const std::string left = c.left_um == -0.1 ? "-0.1" : std::to_string(c.left_um).substr(0, 3);
    EXPECT_TRUE(says(told.message, "they leave " + left + " um in the middle")) << told.message;
    if (c.left_um < 0.0) {
      EXPECT_NEAR(told.value, -0.0001, 1e-12);
      EXPECT_EQ(told.margin, told.value);
      EXPECT_EQ(told.limit, 0.0);
    }
  }
  bearing.bore_mm = 101.0;
  EXPECT_FALSE(says(only(check_fits(train), "fits", "output").message, "5753"));
  bearing.bore_mm = 30.0;
  bearing.kind = BearingKind::kCrossedRollers;
  EXPECT_FALSE(says(only(check_fits(train), "fits", "output").message, "5753"));
}

TEST(FitFigures, ATightSeatOfAPlanetSqueezesItsBallsToo) {
  // 16 N7 is -23 to -5, the ring -8 to 0: 10 um; a bore of 5 mm has 2 to 13
  GearTrain train =
      *lay_out(design_of(replaced(kFitted, "[bearings]", "[bearings]\nplanet_fit = \"N7\"")));
  const Finding told = only(check_fits(train), "fits", "planet");
  EXPECT_NEAR(told.value, (7.5 - 8.0) / 1000.0, 1e-12);
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  // plastic moves no ring
  train.design.made.process->layer_mm = 0.2;
  EXPECT_FALSE(says(only(check_fits(train), "fits", "planet").message, "5753"));
}

TEST(FitFigures, TheFirstLimitsAreTheValueAndPrintersDoNotHoldThem) {
  GearTrain train = *lay_out(design_of(kFitted));
  const Finding held = only(check_fits(train), "fits", "output");
  EXPECT_NEAR(held.value, 0.025, 1e-12);
  EXPECT_EQ(held.status, CheckStatus::kPass);
  train.design.made.process->layer_mm = 0.2;
  const Finding printed = only(check_fits(train), "fits", "output");
  EXPECT_EQ(printed.margin, -1.0);
  EXPECT_EQ(printed.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(printed.message,
                   "6806: seat 42 H7 (+0 to +25 um), clearance +0 to +36 um; journal 30 g6"))
      << printed.message;
  EXPECT_TRUE(says(printed.message, "printers do not hold"));
  train.design.made.process.reset();
  EXPECT_EQ(only(check_fits(train), "fits", "output").status, CheckStatus::kPass);
}

TEST(FitFigures, OfRingLidShaftAndCollarAreThoseOfTheirSizes) {
  GearTrain train = *lay_out(design_of(kFitted));
  train.design.machine->motor.pilot_diameter_mm = 0.5;
  EXPECT_TRUE(
      says(only(check_fits(train), "fits", "motor_pilot").message, "0.5 H7 (+0 to +10 um)"));
  train.design.machine->motor.pilot_diameter_mm = 0.0;
  EXPECT_EQ(find_finding(check_fits(train), "fits", "motor_pilot"), nullptr);
  EXPECT_TRUE(says(only(check_fits(train), "fits", "motor_shaft").message,
                   "hole 5 H7 (+0 to +12 um)"));
  EXPECT_FALSE(says(only(check_fits(train), "fits", "motor_shaft").message, "clearance"));
  const double ring = 2.0 * machine_layout(train)->ring_radius_mm;
  EXPECT_TRUE(says(only(check_fits(train), "fits", "ring").message,
                   "hole " + number_text(ring) + " H7"))
      << ring;
  const GearTrain pair = *lay_out(design_of(machined(kPair + kBox)));
  const double lid = 2.0 * machine_layout(pair)->cavity_radius_mm;
  const Finding rim = only(check_fits(pair), "fits", "lid");
  EXPECT_TRUE(says(rim.message, "hole " + number_text(lid) + " H7")) << rim.message << lid;
  EXPECT_EQ(find_finding(check_fits(pair), "fits", "ring"), nullptr);
  EXPECT_EQ(find_finding(check_fits(train), "fits", "lid"), nullptr);
  EXPECT_TRUE(says(only(check_fits(pair), "fits", "wheel").message, "journal 8"));
}

TEST(FitFigures, OfBothSidesAreComparedWithEachOther) {
  // 5 N7 is -16 to -4 in the pins' plates; ring H7/g6 of 80 to 120 mm: 0 to 35, -34 to -12
  const GearTrain train = *lay_out(design_of(
      replaced(kFitted, "[housing]", "[housing]\nring_fit = \"H7/g6\"\npin_fit = \"N7\"")));
  ASSERT_NEAR(2.0 * machine_layout(train)->ring_radius_mm, 100.0, 20.0);
  const Finding ring = only(check_fits(train), "fits", "ring");
  EXPECT_TRUE(says(ring.message, "H7 (+0 to +35 um), clearance +12 to +69 um")) << ring.message;
  EXPECT_TRUE(says(only(check_fits(train), "fits", "pins").message, "5 N7 (-16 to -4 um)"));
  EXPECT_NEAR(only(check_fits(train), "fits", "pins").value, 0.012, 1e-12);
}

}  // namespace
}  // namespace trueflank
