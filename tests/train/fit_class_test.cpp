// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/seat_fits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

struct Known {
  const char* name;
  double size_mm, lower_um, upper_um;
};

// As printed in tables of limits in handbooks (Roloff/Matek, Tabellenbuch Metall).
TEST(FitClass, HasTheLimitsOfTheTables) {
  for (const Known& k : {Known{"H7", 30, 0, 21},     {"H7", 42, 0, 25},     {"H7", 6, 0, 12},
                         {"h5", 8, -6, 0},           {"k5", 25, 2, 11},     {"h4", 50, -7, 0},
                         {"H7", 3, 0, 10},           {"h9", 3, -25, 0},     {"H10", 2, 0, 40},
                         {"H8", 22, 0, 33},          {"h6", 20, -13, 0},    {"g6", 30, -20, -7},
                         {"f7", 50, -50, -25},       {"e8", 25, -73, -40},  {"d9", 40, -142, -80},
                         {"k6", 25, 2, 15},          {"k6", 17, 1, 12},     {"m6", 40, 9, 25},
                         {"n6", 30, 15, 28},         {"p6", 60, 32, 51},    {"r6", 60, 41, 60},
                         {"r6", 75, 43, 62},         {"s6", 110, 79, 101},  {"s6", 205, 130, 159},
                         {"js6", 10, -4.5, 4.5},     {"j6", 20, -4, 9},     {"j6", 2, -2, 4},
                         {"K7", 15, -12, 6},         {"K7", 2, -10, 0},     {"M7", 30, -21, 0},
                         {"M7", 2, -12, -2},         {"N7", 40, -33, -8},   {"N7", 4, -16, -4},
                         {"P7", 52, -51, -21},       {"P7", 16, -29, -11},  {"R7", 16, -34, -16},
                         {"K8", 12, -19, 8},         {"N8", 12, -30, -3},   {"P8", 12, -45, -18},
                         {"J7", 30, -9, 12},         {"J6", 16, -5, 6},     {"JS7", 30, -10.5, 10.5},
                         {"G7", 80, 10, 40},         {"F8", 20, 20, 53},    {"E9", 100, 72, 159},
                         {"D10", 18, 50, 120},       {"h9", 250, -115, 0},  {"H11", 10, 0, 90}}) {
    const auto limits = fit_limits(k.name, k.size_mm);
    ASSERT_TRUE(limits) << k.name;
    EXPECT_NEAR(1000.0 * limits->lower_mm, k.lower_um, 1e-9) << k.name << " " << k.size_mm;
    EXPECT_NEAR(1000.0 * limits->upper_mm, k.upper_um, 1e-9) << k.name << " " << k.size_mm;
  }
}

/// The standard's formulas, at the geometric mean of a step of sizes: its printed values are rounded.
TEST(FitClass, FollowsTheFormulasOfTheStandard) {
  const double steps[] = {1, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250};
  const double factor[] = {7, 10, 16, 25, 40, 64, 100, 160};  // IT5 to IT12, of i
  // not up to 3 mm: what is printed there is larger than the formula, see the table above
  for (int step = 1; step < 10; ++step) {
    const double size = steps[step + 1], mean = std::sqrt(steps[step] * size);
    const double i = 0.45 * std::cbrt(mean) + 0.001 * mean;
    for (int grade = 5; grade <= 12; ++grade) {
      const double um = factor[grade - 5] * i;
      EXPECT_NEAR(1000.0 * standard_tolerance_mm(grade, size), um, std::max(0.8, 0.05 * um))
          << "IT" << grade << " of " << size;
    }
    const auto upper = [&](const char* name) { return -1000.0 * fit_limits(name, size)->upper_mm; };
    EXPECT_NEAR(upper("d8"), 16.0 * std::pow(mean, 0.44), 0.04 * upper("d8") + 0.6);
    EXPECT_NEAR(upper("e8"), 11.0 * std::pow(mean, 0.41), 0.04 * upper("e8") + 0.6);
    EXPECT_NEAR(upper("f7"), 5.5 * std::pow(mean, 0.41), 0.04 * upper("f7") + 0.6);
    EXPECT_NEAR(upper("g6"), 2.5 * std::pow(mean, 0.34), 1.1);
    EXPECT_NEAR(1000.0 * fit_limits("n6", size)->lower_mm, 5.0 * std::pow(mean, 0.34), 1.1);
    EXPECT_NEAR(fit_limits("m6", size)->lower_mm,
                standard_tolerance_mm(7, size) - standard_tolerance_mm(6, size), 1e-9);
  }
}

TEST(FitClass, ThatDoesNotExistHasNoLimits) {
  for (const char* name : {"", "H", "7", "H7x", "Hh7", "x6", "H3", "H13", "H07", "K9", "P9", "j8", "J5",
                           "h-6", "h6 "})
    EXPECT_FALSE(fit_limits(name, 20.0)) << name;
  EXPECT_FALSE(fit_limits("H7", 0.0));
  EXPECT_FALSE(fit_limits("H7", 251.0));
  EXPECT_FALSE(fit_limits("H7", kNaN));
}

TEST(FitClass, SeatsWithAClearanceKeepIt) {
  const SeatFit loose{.hole = {}, .shaft = {}, .clearance_mm = 0.1};
  EXPECT_EQ(loose.hole_mm(42.0), 42.1);
  EXPECT_EQ(loose.shaft_mm(30.0), 29.9);
  MachineDesign machine;
  machine.housing.fit_mm = 0.0;
  EXPECT_NEAR(seat_fits(machine).output.hole_mm(42.0), 42.0125, 1e-12);
  EXPECT_NEAR(seat_fits(machine).output.shaft_mm(30.0), 29.9865, 1e-12);
  // a seat's own classes, then the housing's, then the usual ones
  machine.housing.fit = FitClasses{"H8", "h6"};
  machine.bearings.output_fit = FitClasses{"J7", ""};
  const SeatFits fits = seat_fits(machine);
  EXPECT_EQ(fits.output.hole + fits.output.shaft, "J7h6");
  EXPECT_EQ(fits.planet.hole, "H8");
  EXPECT_EQ(fits.pin.hole, "");
}

TEST(FitClass, ThePressFitIsTheLargestOfAllSeats) {
  MachineDesign machine;
  machine.bearings.output = {.name = "6806", .bore_mm = 30.0, .outer_mm = 42.0, .width_mm = 7.0};
  EXPECT_EQ(press_mm(machine, 90.0), 0.0);
  machine.bearings.output_fit = FitClasses{"N7", "k6"};  // 42 N7: -33 to -8; 30 k6: +2 to +15
  EXPECT_NEAR(press_mm(machine, 90.0), 0.5 * 0.0205, 1e-9);
}

}  // namespace
}  // namespace trueflank
