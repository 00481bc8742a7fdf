// SPDX-License-Identifier: GPL-3.0-or-later
// Loads, lives and seats of bearings and the grip of a shaft, by hand: a layout with round heights
// in place of the design's own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/machine/check_shaft.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {
namespace {

/// A design laid out, whose layout a test may change.
struct LaidOut {
  explicit LaidOut(const std::string& text)
      : train(*lay_out(design_of(text))), m(*machine_layout(train)) {}
  [[nodiscard]] MachineDesign& machine() { return *train.design.machine; }
  [[nodiscard]] Finding bearing(const std::string& id, const std::string& where) const {
    for (const Finding& f : check_bearings(train, m))
      if (f.id == id && f.where == where) return f;
    throw std::runtime_error("no finding " + id + " of " + where);
  }
  GearTrain train;
  MachineLayout m;
};

/// Life of balls, h.
double balls_h(double dynamic_n, double load_n, double rpm) {
  return std::pow(dynamic_n / load_n, 3.0) * 1e6 / 60.0 / rpm;
}
double cos_deg(double angle) { return std::cos(rad_from_deg(angle)); }

// ------------------------------------------------------------------------------------ life

TEST(BearingLifeFigures, FactorsAreThoseOfTheTableAndOnLinesBetween) {
  const Bearing bearing{.name = "x", .dynamic_n = 10000, .static_n = 10000};
  struct Case {
    double ratio, e, y;
  };
  for (const Case& c : std::array<Case, 13>{{{0.005, 0.19, 2.30},
                                             {0.014, 0.19, 2.30},
                                             {0.021, 0.205, 2.145},
                                             {0.028, 0.22, 1.99},
                                             {0.042, 0.24, 1.85},
                                             {0.056, 0.26, 1.71},
                                             {0.084, 0.28, 1.55},
                                             {0.11, 0.30, 1.45},
                                             {0.17, 0.34, 1.31},
                                             {0.225, 0.36, 1.23},
                                             {0.28, 0.38, 1.15},
                                             {0.56, 0.44, 1.00},
                                             {0.8, 0.44, 1.00}}}) {
    const double along = c.ratio * 10000.0;
    const auto at = [&](double across) {
      return bearing_life(bearing, {.radial_n = across, .axial_n = along, .speed_rpm = 10})
          .equivalent_n;
    };
    const double most = 1.001 * along / c.e, less = 0.9 * along / c.e;
    EXPECT_NEAR(at(most), most, 1e-9) << c.ratio;
    EXPECT_NEAR(at(less), 0.56 * less + c.y * along, 1e-6) << c.ratio;
  }
}

TEST(BearingLifeFigures, AnAxialLoadNeverMakesTheEquivalentOneLessThanTheRadial) {
  // at 0.014: 0.56 + 0.19 * 2.30 = 0.997 of the radial load just beyond the limit
  const Bearing bearing{.name = "x", .dynamic_n = 10000, .static_n = 10000};
  const double across = 140.0 / 0.1901;
  EXPECT_NEAR(
      bearing_life(bearing, {.radial_n = across, .axial_n = 140, .speed_rpm = 1}).equivalent_n,
      across, 1e-9);
}

TEST(BearingLifeFigures, AnAxialLoadAtItsLimitDoesNotCountYet) {
  // 0.26 * 1000 of 260 / 0.056: 0.56 * 1000 + 1.71 * 260 would be 1004.6
  const Bearing bearing{.name = "x", .dynamic_n = 10000, .static_n = 260.0 / 0.056};
  EXPECT_NEAR(bearing_life(bearing, {.radial_n = 1000, .axial_n = 260}).equivalent_n, 1000, 1e-9);
}

TEST(BearingLifeFigures, TheStaticLoadIsTheLargerOfBothFormulas) {
  const Bearing bearing{.name = "x", .dynamic_n = 10000, .static_n = 2000};
  // 0.6 * 100 + 0.5 * 60 = 90 < 100; 60 + 0.5 * 300 = 210
  EXPECT_NEAR(bearing_life(bearing, {.radial_n = 100, .axial_n = 60}).static_equivalent_n, 100,
              1e-9);
  const BearingLife life = bearing_life(bearing, {.radial_n = 100, .axial_n = 300});
  EXPECT_NEAR(life.static_equivalent_n, 210, 1e-9);
  EXPECT_NEAR(life.static_safety, 2000.0 / 210.0, 1e-9);
}

TEST(BearingLifeFigures, WithoutRatingThereIsNoLifeAndAtRestItIsWithoutEnd) {
  const Bearing none{.name = "x"}, dynamic{.name = "x", .dynamic_n = 10000};
  const BearingLife unknown = bearing_life(none, {.radial_n = 100, .axial_n = 300, .speed_rpm = 1});
  EXPECT_TRUE(std::isnan(unknown.life_h));
  EXPECT_TRUE(std::isnan(unknown.static_safety));
  EXPECT_EQ(unknown.equivalent_n, 100.0);
  const BearingLife half = bearing_life(dynamic, {.radial_n = 100, .axial_n = 300, .speed_rpm = 1});
  EXPECT_NEAR(half.life_h, balls_h(10000, 100, 1), 1e-6 * half.life_h);
  EXPECT_TRUE(std::isnan(half.static_safety));
  EXPECT_TRUE(std::isinf(bearing_life(dynamic, {.radial_n = 100}).life_h));
  EXPECT_TRUE(std::isinf(bearing_life(dynamic, {.speed_rpm = 1}).life_h));
  // a slow one and a small load are neither
  EXPECT_FALSE(std::isinf(bearing_life(dynamic, {.radial_n = 0.5, .speed_rpm = 0.5}).life_h));
}

TEST(BearingLifeFigures, CrossedRollersHaveTheirOwnFormulas) {
  Bearing bearing{.name = "x",
                  .bore_mm = 30,
                  .outer_mm = 50,
                  .dynamic_n = 5000,
                  .kind = BearingKind::kCrossedRollers};
  // d_pw = 40: 2 * 4000 / 40 = 200 N; 300 across; 1.5 * 300 = 450 along is still mostly across
  const BearingLoad load{.radial_n = 100, .axial_n = 450, .tilting_nmm = 4000, .speed_rpm = 20};
  const BearingLife life = bearing_life(bearing, load);
  EXPECT_NEAR(life.equivalent_n, 300 + 0.45 * 450, 1e-9);
  EXPECT_NEAR(life.life_h, std::pow(5000 / 502.5, 10.0 / 3.0) * 1e6 / 1200.0, 1e-6);
  EXPECT_TRUE(std::isnan(life.static_safety));
  // both formulas say the same at that limit, and not below and beyond it
  const auto along = [&](double axial) {
    return bearing_life(bearing, {.radial_n = 100, .axial_n = axial, .tilting_nmm = 4000})
        .equivalent_n;
  };
  EXPECT_NEAR(along(310), 300 + 0.45 * 310, 1e-9);
  EXPECT_NEAR(along(600), 0.67 * 900, 1e-9);
  bearing.static_n = 6000;
  EXPECT_NEAR(bearing_life(bearing, load).static_safety, 6000 / (300 + 0.44 * 450), 1e-9);
}

// ----------------------------------------------------------------------------------- forces

TEST(MachineLoadFigures, OfAThreeRingTrainFollowFromItsToothNumbers) {
  const double ratio = (1.0 + 90.0 / 12.0) / (1.0 - 90.0 * 32.0 / (39.0 * 81.0));
  LaidOut made(k3k + kMachine + "[output]\nspeed_rpm = 6\n");
  made.machine().motor.torque_nm = 0.3;
  const MachineLoads loads = machine_loads(made.train);
  EXPECT_NEAR(loads.output_torque_nm, 0.3 * ratio, 1e-9);
  // against the carrier a planet turns 90 / 39 times as fast as that; the output 1 - 90 32 / (39
  // 81) times
  EXPECT_NEAR(loads.planet_speed_rpm, 6.0 * 90.0 / 39.0 / (1.0 - 2880.0 / 3159.0), 1e-9);
  // the carrier is free: across the radius the forces are in balance, and each mesh pushes the
  // planet along it
  const double a = made.train.centre_distance_mm;
  const auto push = [&](double torque_nm, double teeth, double planet, double sign) {
    const double across = 1000.0 * torque_nm / 3.0 / (a * teeth / std::abs(teeth + sign * planet));
    const double cosine = 0.4 * std::abs(teeth + sign * planet) * cos_deg(20.0) / a;
    return across * std::sqrt(1.0 - cosine * cosine) / cosine;
  };
  const double sun = 0.3, out = 0.3 * ratio, held = out - sun;
  const double along = push(sun, 12, 39, 1.0) - push(held, 90, 39, -1.0) - push(out, 81, 32, -1.0);
  EXPECT_NEAR(loads.pin_force_n, std::abs(along), 1e-3 * std::abs(along));
}

TEST(MachineLoadFigures, OfASunThatIdlesPushNoPlanet) {
  // the carrier drives: each planet has the forces of its two rings alone
  LaidOut made(idle_sun(k3k + kMachine) + "[output]\ntorque_nm = 6\nspeed_rpm = 5\n");
  const MachineLoads loads = machine_loads(made.train);
  const double a = made.train.centre_distance_mm, ratio = 1.0 / (1.0 - 2880.0 / 3159.0);
  const double held = 6.0 - 6.0 / ratio;
  const auto across = [&](double torque_nm, double teeth, double planet) {
    return 1000.0 * torque_nm / 3.0 / (a * teeth / (teeth - planet));
  };
  const auto tangent = [&](double teeth, double planet) {
    const double cosine = 0.4 * (teeth - planet) * cos_deg(20.0) / a;
    return std::sqrt(1.0 - cosine * cosine) / cosine;
  };
  const double one = across(held, 90, 39), other = across(6.0, 81, 32);
  const double along = one * tangent(90, 39) + other * tangent(81, 32);
  EXPECT_NEAR(loads.pin_force_n, std::hypot(other - one, along), 1e-3 * along);
  EXPECT_NEAR(loads.planet_speed_rpm, 5.0 * 90.0 / 39.0 * ratio, 1e-9);
}

TEST(MachineLoadFigures, OfAPairWithHelicalTeethTiltTheWheelAtItsPitchCircle) {
  LaidOut made(replaced(kPair, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20") + kBox);
  made.machine().motor.torque_nm = 0.3;
  const MachineLoads loads = machine_loads(made.train);
  EXPECT_NEAR(loads.output_torque_nm, 0.3 * 60.0 / 18.0, 1e-9);
  EXPECT_TRUE(std::isnan(loads.pin_force_n));
  // no profile shift: the pitch circle is the reference circle
  const double pitch = 30.0 / cos_deg(20.0),
               transverse = std::atan(std::tan(rad_from_deg(20.0)) / cos_deg(20.0));
  const WheelForces forces = wheel_forces(made.train, 5.0);
  EXPECT_NEAR(forces.across_n, 5000.0 / pitch / std::cos(transverse), 1e-3);
  EXPECT_NEAR(forces.along_n, 5000.0 / pitch * std::tan(rad_from_deg(20.0)), 1e-3);
  EXPECT_NEAR(forces.tilting_nmm, 5000.0 * std::tan(rad_from_deg(20.0)), 0.05);
}

// ------------------------------------------------------------------------------------ bearings

TEST(BearingFigures, TheOutputsCarryTheLoadByItsLever) {
  LaidOut made(k3k + kMachine + "[output]\nradial_load_n = 40\naxial_load_n = 3\nspeed_rpm = 6\n");
  made.m.bearings = {26.0, 40.0};
  made.m.plate = {41.0, 50.0};
  // one: it carries 40 N, and 3 of 3450 along it are less than e of 40
  Finding one = made.bearing("bearing_load", "output");
  EXPECT_NEAR(one.value, balls_h(4490, 40, 6), 1e-6 * one.value);
  EXPECT_EQ(one.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(one.cure, "outputs = 2"));
  // three of 7 mm: 10 + 3.5 over the upper one's middle, 14 between the outer ones
  made.machine().bearings.outputs = 3;
  const Finding three = made.bearing("bearing_load", "output");
  EXPECT_NEAR(three.value, balls_h(4490, 40.0 * (13.5 + 14.0) / 14.0, 6), 1e-6 * three.value);
  EXPECT_EQ(three.status, CheckStatus::kPass);
  // crossed rollers of 30 x 55 x 10: 10 + 5 to the middle; 2 M / 42.5
  made.machine().bearings.outputs = 1;
  made.machine().bearings.output = *find_element(standard_elements().bearings, "RB3010");
  const double across = 40.0 + 2.0 * 40.0 * 15.0 / 42.5;
  const Finding rollers = made.bearing("bearing_load", "output");
  EXPECT_NEAR(rollers.value, std::pow(7350.0 / (across + 1.35), 10.0 / 3.0) * 1e6 / 360.0,
              1e-6 * rollers.value);
  EXPECT_EQ(rollers.status, CheckStatus::kPass);
  EXPECT_EQ(rollers.cure, "");
}

TEST(BearingFigures, OneBallBearingWithoutALoadAcrossIsNoWarning) {
  LaidOut made(k3k + kMachine + "[output]\nspeed_rpm = 6\n");
  const Finding idle = made.bearing("bearing_load", "output");
  EXPECT_EQ(idle.status, CheckStatus::kPass);
  EXPECT_EQ(idle.message, "bearing 6806 carries nothing");
  made.machine().output.axial_load_n = 100.0;
  EXPECT_EQ(made.bearing("bearing_load", "output").status, CheckStatus::kPass);
  // some of a newton is a load
  made.machine().output.radial_load_n = 0.5;
  EXPECT_EQ(made.bearing("bearing_load", "output").status, CheckStatus::kWarn);
}

TEST(BearingFigures, AreToldWithTheLifeThatIsWanted) {
  LaidOut made(k3k + kMachine + "[output]\nradial_load_n = 449\nspeed_rpm = 10\n");
  made.machine().bearings.outputs = 1;
  // a tenth of C: 1000 million turns, 1 666 667 h
  made.machine().bearings.life_h = 2e6;
  const Finding told = made.bearing("bearing_load", "output");
  EXPECT_EQ(told.message,
            "bearing 6806 carries 449 N at 10 rpm: 1666667 h (ISO 281), wanted 2000000 h");
  EXPECT_NEAR(told.margin, 1e10 / 6000.0 - 2e6, 1e-3);
  EXPECT_EQ(told.status, CheckStatus::kFail);
  // at rest nothing lasts shorter
  made.machine().output.speed_rpm = 0.0;
  EXPECT_TRUE(std::isnan(made.bearing("bearing_load", "output").value));
}

TEST(BearingFigures, AStaticRatingThatIsExceededFailsWhateverTheLife) {
  LaidOut made(k3k + kMachine + "[output]\nradial_load_n = 6900\nspeed_rpm = 10\n");
  made.machine().bearings.life_h = 1.0;
  // 6900 / 3450
  const Finding told = made.bearing("bearing_load", "output");
  EXPECT_TRUE(says(told.message, "static rating is exceeded by 2 times")) << told.message;
  made.machine().bearings.outputs = 1;
  made.machine().output.radial_load_n = 3450.0;  // reached, not exceeded
  EXPECT_FALSE(says(made.bearing("bearing_load", "output").message, "static rating"));
}

TEST(BearingFigures, WithoutRatingSayWhatTheyCarry) {
  LaidOut made(k3k + kMachine + "[output]\nradial_load_n = 40\nspeed_rpm = 6.25\n");
  made.machine().bearings.outputs = 2;
  made.machine().bearings.output.dynamic_n = 0.0;
  made.m.bearings = {26.0, 40.0};
  made.m.plate = {41.0, 50.0};
  const Finding told = made.bearing("bearing_load", "output");
  EXPECT_EQ(told.status, CheckStatus::kNotApplicable);
  EXPECT_EQ(told.message,
            "bearing 6806 has no load rating; it carries 117 N at 6.2 rpm");  // 40 (13.5 + 7) / 7
  EXPECT_TRUE(std::isnan(told.value));
}

TEST(BearingFigures, OfAPlanetCarryHalfThePinEach) {
  // simple, ring held: T_carrier / 3 a on a pin; the planet turns 72 / 27 times as fast against the
  // carrier
  LaidOut made(kSimple + kMachine + "[output]\ntorque_nm = 6\nspeed_rpm = 9\n");
  const double half = 6000.0 / 3.0 / made.train.centre_distance_mm / 2.0;
  const Finding planet = made.bearing("bearing_load", "planet");
  EXPECT_NEAR(planet.value, balls_h(1140, half, 9.0 * 72.0 / 27.0), 1e-6 * planet.value);
  // two of 5 mm in 12 mm of face less 1 mm between them
  const Finding seat = made.bearing("bearing_seat", "planet");
  EXPECT_NEAR(seat.value, 11.0, 1e-9);
  EXPECT_NEAR(seat.limit, 10.0, 1e-9);
  EXPECT_EQ(seat.message, "two bearings 625 are 10 mm wide, the planet has 11 mm for them");
  made.machine().bearings.planet.reset();
  for (const Finding& f : check_bearings(made.train, made.m)) EXPECT_NE(f.where, "planet") << f.id;
}

TEST(BearingFigures, OfACompoundPlanetHaveTheHeightOfBothItsGears) {
  LaidOut made(k3k + kMachine);
  // whatever else is higher or lower than the planets is none of them
  made.train.gears[0].z_lower_mm = -90.0;
  made.train.gears[2].face_width_mm = 90.0;
  made.train.gears[1].z_lower_mm = 2.0;
  made.train.gears[3].z_lower_mm = 14.0;
  EXPECT_NEAR(made.bearing("bearing_seat", "planet").value, 14.0 + 10.0 - 2.0 - 1.0, 1e-9);
  made.train.gears[1].z_lower_mm = 14.0;
  made.train.gears[3].z_lower_mm = 3.0;
  EXPECT_NEAR(made.bearing("bearing_seat", "planet").value, 14.0 + 10.0 - 3.0 - 1.0, 1e-9);
}

/// A helical pair under a load, its wheel's middle at 6 mm, the lid's bearing around 43.5, the
/// floor's at 4.
LaidOut helical_pair() {
  LaidOut made(replaced(kPair, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20") + kBox +
               "[output]\ntorque_nm = 5\nspeed_rpm = 12\nradial_load_n = 50\naxial_load_n = 30\n");
  made.train.gears[1].z_lower_mm = 0.0;
  made.m.bearings = {40.0, 47.0};
  made.m.plate = {50.0, 60.0};
  made.m.stub.bearing = {0.0, 8.0};
  return made;
}
/// Of the equivalent load, by the catalogue's table between 0.014 and 0.056.
double with_axial(double static_n, double across, double along) {
  const double ratio = along / static_n;
  const double t = ratio < 0.028 ? (ratio - 0.014) / 0.014 : (ratio - 0.028) / 0.028;
  const double e = ratio < 0.028 ? std::lerp(0.19, 0.22, t) : std::lerp(0.22, 0.26, t);
  const double y = ratio < 0.028 ? std::lerp(2.30, 1.99, t) : std::lerp(1.99, 1.71, t);
  return along > e * across ? std::max(across, 0.56 * across + y * along) : across;
}

TEST(BearingFigures, OfAWheelBetweenTwoFollowFromTheLever) {
  LaidOut made = helical_pair();
  const WheelForces gear = wheel_forces(made.train, 5.0);
  const double couple = gear.tilting_nmm / 39.5, along = 30.0 + gear.along_n;
  const double lid = (gear.across_n * 2.0 + 50.0 * 56.0) / 39.5 + couple;
  const double floor = (gear.across_n * 37.5 + 50.0 * 16.5) / 39.5 + couple;
  const Finding output = made.bearing("bearing_load", "output");
  EXPECT_NEAR(output.value, balls_h(4490, with_axial(3450, lid, along), 12), 1e-6 * output.value);
  const Finding wheel = made.bearing("bearing_load", "wheel");
  EXPECT_NEAR(wheel.value, balls_h(3450, floor, 12),
              1e-6 * wheel.value);  // along the axis it carries nothing
  made.machine().bearings.outputs = 2;
  const Finding shared = made.bearing("bearing_load", "output");
  EXPECT_NEAR(shared.value, balls_h(4490, with_axial(3450, 0.5 * lid, along), 12),
              1e-6 * shared.value);
}

TEST(BearingFigures, OfAWheelInTheLidAloneAreTheOuterOnesOfSeveral) {
  LaidOut made = helical_pair();
  made.machine().bearings.wheel.reset();
  made.machine().bearings.outputs = 3;
  made.m.bearings = {40.0, 61.0};  // middles at 43.5 and 57.5
  made.m.plate = {62.0, 70.0};
  const WheelForces gear = wheel_forces(made.train, 5.0);
  const double first = (gear.across_n * 51.5 + 50.0 * 12.5) / 14.0,
               last = (gear.across_n * 37.5 + 50.0 * 26.5) / 14.0;
  ASSERT_GT(first, last);
  const auto told_at = [&] { return made.bearing("bearing_load", "output"); };
  const double along = 30.0 + gear.along_n;
  EXPECT_NEAR(told_at().value,
              balls_h(4490, with_axial(3450, first + gear.tilting_nmm / 14.0, along), 12),
              1e-6 * told_at().value);
  // a long arm of the load makes it the last
  made.m.plate.upper_mm = 157.5;
  made.machine().output.radial_load_n = 300.0;
  const double far = (gear.across_n * 37.5 + 300.0 * 114.0) / 14.0;
  ASSERT_GT(far, (gear.across_n * 51.5 + 300.0 * 100.0) / 14.0);
  EXPECT_NEAR(told_at().value,
              balls_h(4490, with_axial(3450, far + gear.tilting_nmm / 14.0, along), 12),
              1e-6 * told_at().value);
}

TEST(BearingFigures, OfAWheelInOneAloneTiltIt) {
  LaidOut made = helical_pair();
  made.machine().bearings.wheel.reset();
  made.machine().bearings.life_h = 1e-6;
  const WheelForces gear = wheel_forces(made.train, 5.0);
  const double along = 30.0 + gear.along_n, across = gear.across_n + 50.0;
  const Finding balls = made.bearing("bearing_load", "output");
  EXPECT_NEAR(balls.value, balls_h(4490, with_axial(3450, across, along), 12), 1e-6 * balls.value);
  EXPECT_EQ(balls.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(balls.cure, "bearings.wheel, in the floor under the wheel")) << balls.cure;
  made.m.cup_radius_mm = 0.5;
  EXPECT_FALSE(says(made.bearing("bearing_load", "output").cure, "in the floor"));
  made.machine().bearings.output = *find_element(standard_elements().bearings, "RB3010");
  const double tilting = gear.tilting_nmm + gear.across_n * 37.5 + 50.0 * 16.5;
  const double all = across + 2.0 * tilting / 42.5;
  const Finding rollers = made.bearing("bearing_load", "output");
  EXPECT_NEAR(rollers.value, std::pow(7350.0 / (all + 0.45 * along), 10.0 / 3.0) * 1e6 / 720.0,
              1e-6 * rollers.value);
  EXPECT_EQ(rollers.status, CheckStatus::kPass);
}

TEST(BearingFigures, TheWheelsShoulderEndsBeforeTheInserts) {
  LaidOut made(kPair + kBox);
  made.m.output_screws.at = {Point2(6.0, 8.0)};
  made.m.output_screws.screw.insert_hole_mm = 4.0;
  made.m.stub.inner_shoulder_mm = 7.0;
  const auto seat = [&] { return made.bearing("bearing_seat", "wheel"); };
  EXPECT_NEAR(seat().value, 8.0, 1e-12);
  EXPECT_NEAR(seat().margin, 1.0, 1e-12);
  made.m.stub.inner_shoulder_mm = 8.0;
  EXPECT_EQ(seat().status, CheckStatus::kPass);
  made.m.stub.inner_shoulder_mm = 8.1;
  EXPECT_EQ(seat().status, CheckStatus::kFail);
}

// ---------------------------------------------------------------------------------------- shaft

TEST(ShaftGripFigures, AreOneAndAHalfDiametersAndOneAtLeast) {
  LaidOut made(k3k + kMachine);
  made.machine().motor.torque_nm = 0.0;
  const auto at = [&](double depth) {
    made.m.gripped = {3.0, 3.0 + depth};
    return shaft_grip(made.train, made.m);
  };
  EXPECT_EQ(at(7.5).status, CheckStatus::kPass);
  EXPECT_NEAR(at(7.5).limit, 7.5, 1e-12);
  EXPECT_NEAR(at(9.5).margin, 2.0, 1e-12);
  EXPECT_EQ(at(7.4).status, CheckStatus::kWarn);
  EXPECT_EQ(at(5.0).status, CheckStatus::kWarn);
  EXPECT_EQ(at(4.9).status, CheckStatus::kFail);
  EXPECT_TRUE(says(at(4.9).cure, "longer by 2.6 mm")) << at(4.9).cure;
  EXPECT_TRUE(says(at(-2.0).message, "is 0 mm deep")) << at(-2.0).message;
  EXPECT_NEAR(at(-2.0).value, -2.0, 1e-12);
}

TEST(ShaftGripFigures, AFlatHoldsAMotorUpToItsTorqueAndNotBeyond) {
  LaidOut made(k3k + kMachine);
  const double holds = held_by_flat_nm(made.train, flat_in_bore_mm(made.m));
  made.machine().motor.torque_nm = holds;
  EXPECT_EQ(shaft_grip(made.train, made.m).status, CheckStatus::kPass);
  made.machine().motor.torque_nm = 1.01 * holds;
  const Finding told = shaft_grip(made.train, made.m);
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(told.cure, "a wider face_width_mm")) << told.cure;
  made.m.driven_gear = -1;  // the carrier
  EXPECT_TRUE(says(shaft_grip(made.train, made.m).cure, "plate_thickness_mm"));
}

TEST(ShaftGripFigures, ASetScrewHoldsAMotorUpToItsTorqueAndNotBeyond) {
  LaidOut made(round_shaft(k3k + kMachine));
  ASSERT_TRUE(made.m.set_screw.is_there());
  const double holds = held_torque_nm(made.m.set_screw, 5.0);
  made.machine().motor.torque_nm = holds;
  EXPECT_EQ(shaft_grip(made.train, made.m).status, CheckStatus::kPass);
  made.machine().motor.torque_nm = 1.01 * holds;
  const Finding told = shaft_grip(made.train, made.m);
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_FALSE(says(told.message, "glue")) << told.message;
  EXPECT_TRUE(says(told.cure, "a flat filed on the shaft under the screw"));
  // a shaft that is not deep enough says nothing of screws
  made.m.gripped.upper_mm = made.m.gripped.lower_mm;
  EXPECT_FALSE(says(shaft_grip(made.train, made.m).message, "ISO 4029"));
}

TEST(ShaftGripFigures, ASetScrewOnAFlatSaysHowFarItsEdgeIsFromWhereThatBegins) {
  LaidOut made(replaced(k3k + kMachine, "[fasteners]", "[fasteners]\nset_screw = \"always\""));
  ASSERT_TRUE(made.m.set_screw.is_there());
  made.m.flat_from_mm = 2.0;
  made.m.set_screw.axis_mm = 7.0;
  // M3: 7 - 1.5 - 2
  const Finding told = shaft_grip(made.train, made.m);
  EXPECT_TRUE(says(told.message, "bears on its flat, 3.5 mm from where that begins"))
      << told.message;
  EXPECT_TRUE(says(told.message, "its flat holds about")) << told.message;
  made.m.gripped.upper_mm = made.m.gripped.lower_mm;
  EXPECT_FALSE(says(shaft_grip(made.train, made.m).message, "flat"));
}

TEST(ShaftGripFigures, AShaftGoesIntoABoreThatIsWiderOrPressesIntoItsClass) {
  LaidOut made(k3k + kMachine);
  double& bore = made.train.design.gears[0].bore.diameter_mm;
  const auto fails = [&] { return shaft_grip(made.train, made.m).status == CheckStatus::kFail; };
  bore = 5.01;
  EXPECT_FALSE(fails());
  bore = 5.0;
  EXPECT_TRUE(fails());
  EXPECT_TRUE(
      says(shaft_grip(made.train, made.m).message, "5 mm does not go into the bore of 5 mm"));
  // 5 N7 is -16 to -4: 4.99 in the middle
  made.m.fits.shaft.hole = "N7";
  EXPECT_FALSE(fails());
  bore = made.m.fits.shaft.hole_mm(5.0);
  EXPECT_FALSE(fails());
  bore -= 0.01;
  EXPECT_TRUE(fails());
}

TEST(ShaftGripFigures, ARoundBoreOnAShaftWithAFlatIsGluedAsWell) {
  LaidOut made(k3k + kMachine);
  made.machine().motor.torque_nm = 0.0;
  EXPECT_FALSE(says(shaft_grip(made.train, made.m).message, "glue"));
  made.train.design.gears[0].bore.kind = BoreKind::kRound;
  const Finding glued = shaft_grip(made.train, made.m);
  EXPECT_EQ(glued.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(glued.message, "glue alone carries the torque")) << glued.message;
  made.m.set_screw.missing = "no room";
  EXPECT_TRUE(says(shaft_grip(made.train, made.m).message, "torque; no room"));
  made.m.gripped.upper_mm = made.m.gripped.lower_mm;
  EXPECT_FALSE(says(shaft_grip(made.train, made.m).message, "no room"));
}

TEST(ShaftGripFigures, ARoundShaftWithoutASetScrewHasNoFlatToTellOf) {
  LaidOut made(k3k + kMachine);
  made.machine().motor.flat_mm = 0.0;
  made.train.design.gears[0].bore.kind = BoreKind::kRound;
  made.m.set_screw.missing = "no room";
  const Finding told = shaft_grip(made.train, made.m);
  EXPECT_TRUE(says(told.message, "glue alone carries the torque; no room"));
  EXPECT_FALSE(says(told.message, "flat")) << told.message;
}

}  // namespace
}  // namespace trueflank
