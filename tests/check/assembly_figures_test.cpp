// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which planets mesh at once, against planets that are set in tooth by tooth, and the order in
// which a train goes together.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string_view>

#include "tests/check/check_designs.h"
#include "trueflank/check/assembly.h"

namespace trueflank::test {
namespace {

bool says(const Finding& f, const std::string& words) {
  return f.message.find(words) != std::string::npos;
}

/// The numbers of a list such as "0, 119.5 deg" behind some words.
std::vector<double> degrees_after(const std::string& text, const std::string& words) {
  const std::size_t found = text.find(words + ' ');
  if (found == std::string::npos) return {};
  std::vector<double> numbers;
  const char* at = text.c_str() + found + words.size();
  for (char* end = nullptr;; at = end + (*end == ',' ? 1 : 0)) {
    const double number = std::strtod(at, &end);
    if (end == at) break;
    numbers.push_back(number);
  }
  return std::string_view(at).starts_with(" deg") ? numbers : std::vector<double>{};
}

/// Teeth round one planet; those of the second planet gear and ring are 0 where it has one gear.
struct Teeth {
  int sun = 0, planet1 = 0, ring1 = 0, planet2 = 0, ring2 = 0;

  /// Whether a body meshes when it is set in at an angle, in turns from planet 1. It is tried with
  /// each of its teeth in the sun's gap; the gears fixed by planet 1 stand still. A gear that goes
  /// on by an angle sees its mate's teeth pass by.
  [[nodiscard]] bool goes_in(double turns, bool second_gear) const {
    const auto whole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
    for (int tooth = 0; tooth < planet1; ++tooth) {
      const double turned = ((sun + planet1) * turns - tooth) / planet1;
      if (!whole((ring1 - planet1) * turns + planet1 * turned)) continue;
      if (!second_gear || planet2 == 0 || whole((ring2 - planet2) * turns + planet2 * turned))
        return true;
    }
    return false;
  }

  /// Of all angles at which a body goes in, by search along the circle, the nearest to one; of two
  /// that are as near, the one further on.
  [[nodiscard]] double nearest(double turns, bool second_gear) const {
    const int steps = sun + ring1;  // so many teeth of sun and ring together pass in a turn
    double best = 9.0;
    for (int k = -steps; k <= 2 * steps; ++k) {
      const double place = static_cast<double>(k) / steps;
      if (std::abs(place - turns) < std::abs(best - turns) + 1e-9 && goes_in(place, second_gear))
        best = place;
    }
    return best;
  }
};

GearboxDesign design_of(const Teeth& t, int planets) {
  if (t.planet2 == 0) return simple_design(t.sun, t.planet1, t.ring1, planets);
  GearboxDesign d = paper_design(0.05);
  d.planets = planets;
  d.centre_distance_mm = 0.5 * (t.sun + t.planet1) + 0.1;
  const int teeth[] = {t.sun, t.planet1, t.ring1, t.planet2, t.ring2};
  for (std::size_t i = 0; i < 5; ++i) d.gears[i].teeth = teeth[i];
  d.gears[2].shift = d.gears[4].shift = 0.3;
  return d;
}

Teeth random_teeth(std::mt19937& random) {
  const auto from = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  Teeth t{.sun = from(12, 20), .planet1 = from(20, 36)};
  t.ring1 = t.sun + 2 * t.planet1 + from(-1, 1);
  if (from(0, 2) == 0) return t;
  t.planet2 = t.planet1 - from(3, 8);
  t.ring2 = t.planet2 + t.ring1 - t.planet1 + from(-1, 1);
  return t;
}

Finding judged(const GearTrain& train) {
  return check_assembly(train, std::vector<MeshState>(train.meshes.size()))[0];
}

/// Where bodies go in nearest to equal spacing, in turns; empty where neighbours would collide
/// there.
std::vector<double> nearest_places(const Teeth& t, const GearTrain& train, bool second_gear) {
  const int n = train.design.planets;
  double tip = 0.0;
  for (const TrainGear& g : train.gears)
    if (g.name.starts_with("planet")) tip = std::max(tip, g.profile.tip_radius_mm());
  std::vector<double> turns;
  for (int i = 0; i < n; ++i) turns.push_back(t.nearest(static_cast<double>(i) / n, second_gear));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) {
      const double angle =
          kTwoPi * (turns[static_cast<std::size_t>(i)] - turns[static_cast<std::size_t>(j)]);
      if (2.0 * train.centre_distance_mm * std::abs(std::sin(0.5 * angle)) <= 2.0 * tip) return {};
    }
  return turns;
}

/// The angles that stand behind some words are these places; none where there are no places.
void expect_told(const std::string& text, const std::string& words,
                 const std::vector<double>& turns) {
  const std::vector<double> told = degrees_after(text, words);
  ASSERT_EQ(told.size(), turns.size()) << words << " in: " << text;
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_NEAR(told[i], 360.0 * turns[i], 1e-4) << text;
}

double largest_departure_deg(const std::vector<double>& turns) {
  double largest = 0.0;
  for (std::size_t i = 0; i < turns.size(); ++i)
    largest = std::max(largest, 360.0 * std::abs(turns[i] - static_cast<double>(i) /
                                                                static_cast<double>(turns.size())));
  return largest;
}

/// Equal spacing does not go in: the places told are the nearest ones, of identical bodies if these
/// do not collide, else of indexed ones.
void expect_nearest_places(const Finding& f, const Teeth& t, const GearTrain& train) {
  const std::vector<double> identical = nearest_places(t, train, true),
                            indexed = nearest_places(t, train, false);
  const bool two = t.planet2 != 0;
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_EQ(says(f, "neighbours would collide"), identical.empty() && (!two || indexed.empty()));
  expect_told(f.message, "Identical ones do at", identical);
  expect_told(f.message, "bodies that differ mesh at",
              identical.empty() && two ? indexed : std::vector<double>{});
  expect_told(f.message, "Bodies that differ would at",
              !identical.empty() && two && indexed != identical ? indexed : std::vector<double>{});
  const std::vector<double>& taken = identical.empty() && two ? indexed : identical;
  if (taken.empty()) {
    EXPECT_TRUE(std::isnan(f.value));
  } else {
    EXPECT_NEAR(f.value, largest_departure_deg(taken), 1e-9);
    EXPECT_EQ(f.margin, -f.value);
  }
}

TEST(AssemblyFigures, AreThoseOfPlanetsSetInToothByTooth) {
  std::mt19937 random(20);
  int alike_count = 0, differ = 0, apart = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Teeth t = random_teeth(random);
    const int n = std::uniform_int_distribution<int>(2, 5)(random);
    const auto train = lay_out(design_of(t, n));
    if (!train) continue;
    const Finding f = judged(*train);
    SCOPED_TRACE(std::to_string(t.sun) + "/" + std::to_string(t.planet1) + "/" +
                 std::to_string(t.ring1) + "/" + std::to_string(t.planet2) + "/" +
                 std::to_string(t.ring2) + " x" + std::to_string(n) + ": " + f.message + " " +
                 f.cure);
    bool alike = true, any = true;
    for (int i = 1; i < n; ++i) {
      alike = alike && t.goes_in(static_cast<double>(i) / n, true);
      any = any && t.goes_in(static_cast<double>(i) / n, false);
    }
    ++(alike ? alike_count : any ? differ : apart);
    if (!any) {
      expect_nearest_places(f, t, *train);
      continue;
    }
    EXPECT_EQ(f.status, alike ? CheckStatus::kPass : CheckStatus::kWarn);
    EXPECT_EQ(f.value, 0.0);
    if (!alike) expect_told(f.cure, "mount identical ones at", nearest_places(t, *train, true));
  }
  EXPECT_GT(alike_count, 5);
  EXPECT_GT(differ, 5);
  EXPECT_GT(apart, 20);
}

TEST(AssemblyFigures, TellWhichPlacesIdenticalPlanetsHave) {
  EXPECT_TRUE(says(judged(laid_out(simple_design(12, 30, 72, 3))),
                   "multiples of " + std::string("4.2857 deg (84 places round the sun)")));
  EXPECT_TRUE(says(judged(laid_out(design_of({12, 39, 90, 32, 81}, 3))), "deg ("));
}

TEST(AssemblyFigures, AMeshOutOfPhaseIsToldWithItsArc) {
  GearTrain train = laid_out(simple_design(12, 30, 72, 3));
  const int sun = train.topology().find_member("sun");
  const double pitch_radius = 0.5 * 12;
  train.phases.member_rotation_rad[static_cast<std::size_t>(sun)][0] += 0.01;
  const Finding f = judged(train);
  EXPECT_EQ(f.status, CheckStatus::kFail);
  const std::size_t at = f.message.find(" stands ");
  ASSERT_NE(at, std::string::npos) << f.message;
  EXPECT_NEAR(std::stod(f.message.substr(at + 8)), 10.0 * pitch_radius, 0.1);
  EXPECT_EQ(f.cure, "tooth numbers that assemble");
  EXPECT_FALSE(says(f, "Order:"));
}

TEST(AssemblyFigures, OnePlanetOutOfPhaseIsNamed) {
  for (const std::size_t planet : {0U, 1U, 2U}) {
    GearTrain train = laid_out(simple_design(12, 30, 72, 3));
    const auto member = static_cast<std::size_t>(train.topology().find_member("planet"));
    ASSERT_EQ(train.phases.member_rotation_rad[member].size(), 3U);
    train.phases.member_rotation_rad[member][planet] += 0.01;
    const Finding f = judged(train);
    EXPECT_EQ(f.status, CheckStatus::kFail);
    EXPECT_TRUE(says(f, "of planet " + std::to_string(planet + 1))) << f.message;
    // one that stands out less is not
    train.phases.member_rotation_rad[member][(planet + 1) % 3] += 0.005;
    EXPECT_TRUE(says(judged(train), "of planet " + std::to_string(planet + 1)));
  }
}

TEST(AssemblyOrder, TheSunGoesInWhereNoPlanetBarsIt) {
  const auto told = [](const Teeth& t) { return judged(laid_out(design_of(t, 3))); };
  EXPECT_TRUE(says(told({12, 39, 90, 32, 81}), "then the sun along the axis from either side"));
  EXPECT_TRUE(says(told({15, 30, 75, 36, 81}), "from below (planet2 bars it above)"));
  const Finding simple = told({12, 30, 72});
  EXPECT_TRUE(says(simple, "then the sun along the axis, then the ring along the axis"));
  EXPECT_FALSE(says(simple, "either side"));
}

TEST(AssemblyOrder, EachRingComesFromItsOwnSide) {
  const Finding f = judged(laid_out(design_of({12, 39, 90, 32, 81}, 3)));
  EXPECT_TRUE(says(f, ", ring1 along the axis from below, ring2 from above")) << f.message;
}

TEST(AssemblyOrder, APlanetThatLeavesItsRingAtEveryRotationGoesInRadially) {
  const GearTrain train = laid_out(simple_design(12, 30, 72, 3));
  const auto told = [&](bool every) {
    std::vector<MeshState> states(train.meshes.size());
    states[1].removal = RadialRemoval{every ? 1.0 : 0.5, every, true, {}};
    return check_assembly(train, states)[0];
  };
  EXPECT_TRUE(says(told(true), "; without the sun in place, planet also goes into ring radially"));
  EXPECT_FALSE(says(told(false), "radially"));
}

GearboxDesign herringbone(GearboxDesign d) {
  d.helix_angle_rad = 0.3;
  d.herringbone = true;
  return d;
}

TEST(AssemblyOrder, HerringboneRingsAreClosedInHalvesOverThePlanets) {
  GearboxDesign d = herringbone(simple_design(12, 30, 72, 3));
  const Finding whole = judged(laid_out(d));
  EXPECT_EQ(whole.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(whole, "can only be assembled from halves"));
  EXPECT_EQ(whole.cure.find("halves = true for every ring"), 0U) << whole.cure;
  gear(d, "ring").halves = true;
  const Finding split = judged(laid_out(d));
  EXPECT_EQ(split.status, CheckStatus::kPass) << split.message;
  EXPECT_TRUE(says(split, "the lower half of each ring along the axis"));
  EXPECT_TRUE(split.cure.empty());
  // planets that do not mesh fail and are told no order
  GearboxDesign unequal = herringbone(simple_design(13, 30, 73, 3));
  const Finding fails = judged(laid_out(unequal));
  EXPECT_EQ(fails.status, CheckStatus::kFail);
  EXPECT_EQ(fails.cure.find("halves"), std::string::npos);
  // bodies that differ have both cures
  GearboxDesign compound = herringbone(design_of({11, 40, 91, 33, 83}, 3));
  *compound.centre_distance_mm /= std::cos(0.3);
  const Finding both = judged(laid_out(compound));
  EXPECT_NE(both.cure.find("mount each in its place"), std::string::npos);
  EXPECT_NE(both.cure.find("; halves = true"), std::string::npos) << both.cure;
}

TEST(AssemblyOrder, OfAPairOnlyAHerringboneInARingIsTold) {
  const auto status = [](const GearboxDesign& d) {
    const Finding f = judged(laid_out(d));
    EXPECT_EQ(f.cure.empty(), f.status == CheckStatus::kNotApplicable);
    return f.status;
  };
  EXPECT_EQ(status(pair_design(20, 60, true)), CheckStatus::kNotApplicable);
  EXPECT_EQ(status(herringbone(pair_design(20, 40, false))), CheckStatus::kNotApplicable);
  GearboxDesign ring = herringbone(pair_design(20, 60, true));
  EXPECT_EQ(status(ring), CheckStatus::kWarn);
  gear(ring, "wheel").halves = true;
  EXPECT_EQ(status(ring), CheckStatus::kNotApplicable);
  GearboxDesign alone{.name = "gear", .topology = train_topology("gear")};
  alone.gears = {{.name = "gear", .teeth = 20, .shift = 0.0}};
  EXPECT_EQ(status(alone), CheckStatus::kNotApplicable);
}

}  // namespace
}  // namespace trueflank::test
