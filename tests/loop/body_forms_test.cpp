// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "tests/loop/made_gears.h"

// Forms of the body that carries the teeth: by the direction and the height at which a point lies.
namespace trueflank::test {
namespace {

double radians(double deg) { return deg * M_PI / 180.0; }

/// What so much of the radius [um] is worth along the normal.
double outwards(const MadeGear& gear, const FlankSpot& spot, const Vec3& point, double um) {
  const Vec3 normal = normal_at(gear, spot);
  return um * (normal[0] * point[0] + normal[1] * point[1]) / std::hypot(point[0], point[1]);
}

/// A course over the face, 1 where it is most.
struct Course {
  int kind = 0;  // evenly, by the square, dying away
  bool upper = true;
  double share = 0.15;  // of the face, within what it dies away
  [[nodiscard]] double at(double v) const {
    const double from = 0.5 * (1.0 + (upper ? v : -v));
    return kind == 0 ? from : kind == 1 ? from * from : std::exp((from - 1.0) / share);
  }
};

std::mt19937_64 random_of(unsigned seed) { return std::mt19937_64(7919 * seed + 17); }
double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A scan (even seeds), or traces of all teeth with an index.
loop::LoopResult measured(const MadeGear& gear, const Process& process, double noise_um,
                          unsigned seed) {
  if (seed % 2 == 0)
    return close(gear, scan_of(gear, {process}, scanned(9000, noise_um, seed)), true);
  InspectionOptions options;
  options.noise_um = noise_um;
  options.points = 40;
  options.seed = seed;
  return close(gear, inspection_of(gear, {process}, options));
}

double number_of(const loop::Term& term, const std::string& key) {
  for (const auto& [name, value] : term.keys)
    if (name == key)
      return std::holds_alternative<double>(value) ? std::get<double>(value)
                                                   : static_cast<double>(std::get<int>(value));
  return NAN;
}

std::vector<const loop::Term*> terms_of(const loop::LoopResult& result) {
  std::vector<const loop::Term*> terms;
  for (const auto& effect : result.effects)
    for (const auto& term : effect.terms) terms.push_back(&term);
  return terms;
}

TEST(BodyForms, OutOfRoundAtOneEndIsOneForm) {
  // (of every course one in the gate, of scans and traces)
  for (const unsigned seed : survey_of(3, {1U, 2U, 5U, 3U, 4U, 6U})) {
    auto random = random_of(seed);
    const MadeGear gear = spur(static_cast<int>(between(random, 18.0, 40.0)));
    const int order = static_cast<int>(between(random, 2.0, 5.0));
    const double um = between(random, 12.0, 25.0), phase = between(random, 0.0, 6.0);
    Course course{static_cast<int>(seed / 2) % 3, between(random, 0.0, 1.0) < 0.5};
    course.share = between(random, 0.12, 0.3);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      return outwards(g, s, p, um) * course.at(s.v) *
             std::cos(order * std::atan2(p[1], p[0]) - phase);
    });
    const auto result = measured(gear, made, 0.8, seed);
    EXPECT_TRUE(tells(result, "the gear is out of round")) << seed << list(result);
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 1U) << seed << list(result);
    EXPECT_EQ(number_of(*terms[0], "order"), order) << list(result);
    EXPECT_NEAR(terms[0]->amplitude(), um, 0.06 * um) << seed << list(result);
  }
}

TEST(BodyForms, ASinkBesideAGateIsOnePlace) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    auto random = random_of(seed);
    const MadeGear gear = spur(static_cast<int>(between(random, 18.0, 40.0)));
    const bool radial = seed % 4 < 2;
    const double um = between(random, 10.0, 20.0) * (radial ? 2.0 : 1.0),
                 at_deg = between(random, 0.0, 360.0), half_deg = between(random, 18.0, 35.0);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      const double off =
          std::remainder(std::atan2(p[1], p[0]) - radians(at_deg), 2.0 * M_PI) / radians(half_deg);
      const double here = -um * std::exp(-off * off);
      return radial ? outwards(g, s, p, here) : here;
    });
    const auto result = measured(gear, made, 0.8, seed);
    EXPECT_TRUE(tells(result, "a hollow of the body")) << seed << list(result);
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 1U) << seed << list(result);
    EXPECT_NEAR(std::remainder(number_of(*terms[0], "at_deg") - at_deg, 360.0), 0.0, 2.5)
        << list(result);
    EXPECT_NEAR(number_of(*terms[0], "half_deg"), half_deg, 0.15 * half_deg) << list(result);
    EXPECT_NEAR(terms[0]->amplitude(), um, 0.1 * um) << seed << list(result);
  }
}

TEST(BodyForms, TwoGatesOfUnequalDepthAreTwoPlaces) {
  // (waves out of round, sectors and steps were told in their place)
  unsigned right = 0;
  const unsigned all = survey_size(2U, 8U);
  for (unsigned seed = 1; seed <= all; ++seed) {
    auto random = random_of(seed);
    const MadeGear gear = spur(static_cast<int>(between(random, 34.0, 66.0)));
    const double um = between(random, 10.0, 18.0), share = between(random, 0.5, 0.8),
                 half_deg = between(random, 15.0, 22.0);
    const std::array<double, 2> at_deg{between(random, 0.0, 100.0), between(random, 200.0, 260.0)};
    const auto made = grown([&](const MadeGear&, const FlankSpot&, const Vec3& p) {
      double sum = 0.0;
      for (const std::size_t k : {0U, 1U}) {
        const double off = std::remainder(std::atan2(p[1], p[0]) - radians(at_deg[k]), 2.0 * M_PI) /
                           radians(half_deg);
        sum -= (k == 0 ? 1.0 : share) * um * std::exp(-off * off);
      }
      return sum;
    });
    InspectionOptions options{.noise_um = 0.8, .profile = false, .helix = false, .seed = seed};
    const auto result = seed % 2 == 0 ? measured(gear, made, 2.5, seed)
                                      : close(gear, inspection_of(gear, {made}, options));
    const auto terms = terms_of(result);
    bool is_right = terms.size() == 2 && result.noise < (seed % 2 == 0 ? 2.6 : 1.1);
    for (const loop::Term* term : terms) {
      const double at = number_of(*term, "at_deg");
      const std::size_t k = std::abs(std::remainder(at - at_deg[0], 360.0)) < 90.0 ? 0 : 1;
      const double size = (k == 0 ? 1.0 : share) * um;
      is_right = is_right && std::abs(std::remainder(at - at_deg[k], 360.0)) < 3.0 &&
                 std::abs(term->amplitude() - size) < 0.12 * size;
    }
    right += is_right ? 1 : 0;
    if (!is_right)
      std::cout << seed << " " << um << " " << share * um << " at " << at_deg[0] << ", "
                << at_deg[1] << list(result) << "\n";
  }
  EXPECT_GE(8 * right, 7 * all);
}

TEST(BodyForms, ABodyThatSagsOnOneSideIsOnePlace) {
  for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed) {
    auto random = random_of(seed);
    const MadeGear gear = seed % 2 == 0 ? ring(static_cast<int>(between(random, 50.0, 64.0)))
                                        : spur(static_cast<int>(between(random, 24.0, 50.0)));
    const double um = between(random, 25.0, 40.0), at_deg = between(random, 0.0, 360.0);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      const double cosine = std::cos(std::atan2(p[1], p[0]) - radians(at_deg));
      return cosine > 0.0 ? outwards(g, s, p, -um * cosine * cosine) : 0.0;
    });
    const auto result = measured(gear, made, 1.5, seed);
    EXPECT_TRUE(tells(result, "a body that sags, warps or is held on one side"))
        << seed << list(result);
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 1U) << seed << list(result);
    EXPECT_NEAR(std::remainder(number_of(*terms[0], "at_deg") - at_deg, 360.0), 0.0, 3.0)
        << list(result);
    EXPECT_NEAR(terms[0]->amplitude(), um, 0.08 * um) << seed << list(result);
  }
}

TEST(BodyForms, DentsOfJawsAreOneForm) {
  for (const unsigned seed : survey_of(2, {1U, 3U, 2U, 4U, 5U, 6U})) {
    auto random = random_of(seed);
    const MadeGear gear = spur(static_cast<int>(between(random, 24.0, 40.0)));
    const int number = 2 + static_cast<int>(seed) % 3;
    const double um = between(random, 30.0, 50.0), at_deg = between(random, 0.0, 360.0 / number),
                 half_deg = between(random, 9.0, 13.0);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      const double off =
          std::remainder(std::atan2(p[1], p[0]) - radians(at_deg), 2.0 * M_PI / number) /
          radians(half_deg);
      return outwards(g, s, p, -um * std::exp(-off * off));
    });
    const auto result = measured(gear, made, 1.0, 2 * seed);
    EXPECT_TRUE(tells(result, std::to_string(number) + " hollows of the body evenly spaced"))
        << seed << list(result);
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 1U) << seed << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << seed << list(result);
    EXPECT_NEAR(std::remainder(number_of(*terms[0], "at_deg") - at_deg, 360.0 / number), 0.0, 1.0)
        << list(result);
    EXPECT_NEAR(terms[0]->amplitude(), um, 0.06 * um) << seed << list(result);
  }
}

// They were ramps over the face, a third too large, and of a ring the words had the wrong sign.
TEST(BodyForms, DentsOverAPartOfTheFaceEndAtAnEdge) {
  for (const unsigned seed : survey_of(1, {2U, 1U})) {  // (the gate: the ring)
    auto random = random_of(seed + 40);
    const bool of_a_ring = seed % 2 == 0;
    const int teeth = static_cast<int>(between(random, 36.0, 48.0));
    const MadeGear gear = of_a_ring ? ring(teeth) : spur(teeth);
    const bool upper = between(random, 0.0, 1.0) < 0.5;
    const double um = between(random, 25.0, 40.0), at_deg = between(random, 0.0, 120.0),
                 half_deg = between(random, 12.0, 15.0), edge = between(random, -0.2, 0.3);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      const double off = std::remainder(std::atan2(p[1], p[0]) - radians(at_deg), 2.0 * M_PI / 3) /
                         radians(half_deg);
      return (upper ? s.v > edge : s.v < edge) ? outwards(g, s, p, -um * std::exp(-off * off))
                                               : 0.0;
    });
    const auto result = measured(gear, made, 1.0, 2 * seed);
    SCOPED_TRACE(list(result));
    EXPECT_TRUE(tells(
        result, of_a_ring
                    ? "3 places evenly spaced around the gear where the ring is pushed inwards"
                    : "3 hollows of the body evenly spaced"));
    EXPECT_TRUE(tells(result, of_a_ring ? "there the teeth stand out on both"
                                        : "there the teeth lie back on both"));
    EXPECT_TRUE(tells(result, upper ? "above a height of" : "below a height of"));
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 1U);
    EXPECT_NEAR(terms[0]->amplitude(), um, 0.08 * um);
    EXPECT_NEAR(number_of(*terms[0], "face_mm"), 0.5 * (1.0 + edge) * gear.face_mm,
                0.03 * gear.face_mm);
  }
}

// (on teeth of one in so many, and on others)
TEST(BodyForms, ThreePinsAtAnEndAreThreePlaces) {
  const MadeGear gear = spur(21);
  for (unsigned seed = 1; seed <= 2; ++seed) {
    auto random = random_of(seed);
    std::array<double, 3> at_deg{};
    for (std::size_t k = 0; k < 3; ++k)
      at_deg[k] = 120.0 * static_cast<double>(k) + between(random, -25.0, 25.0);
    const double um = between(random, 25.0, 50.0);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      double sum = 0.0;
      for (const double deg : at_deg)
        sum += std::exp(-std::pow(
            std::remainder(std::atan2(p[1], p[0]) - radians(deg), 2.0 * M_PI) / radians(14.0), 2));
      return um * sum * std::exp(-0.5 * (s.v + 1.0) * g.face_mm / 3.0);
    });
    const auto result = measured(gear, made, 2.0, 2 * seed);
    const auto terms = terms_of(result);
    ASSERT_EQ(terms.size(), 3U) << seed << list(result);
    for (const loop::Term* term : terms) {
      EXPECT_NEAR(term->amplitude(), um, 0.08 * um) << list(result);
      double least = 360.0;
      for (const double deg : at_deg)
        least = std::min(least, std::abs(std::remainder(number_of(*term, "at_deg") - deg, 360.0)));
      EXPECT_LT(least, 2.0) << list(result);
    }
  }
}

TEST(BodyForms, WallsByTheDirectionOfAPointAreNoEccentricity) {
  const MadeGear gear = spur(23);
  for (const unsigned seed : {2U, 4U}) {
    const auto made = grown([](auto&, auto&, const Vec3& p) {
      return 24.0 * std::cos(std::atan2(p[1], p[0]) - radians(69.0));
    });
    const auto result = measured(gear, made, 4.0, seed);
    EXPECT_TRUE(tells(result, "by the side of the gear they stand on, once per turn"))
        << list(result);
    ASSERT_EQ(terms_of(result).size(), 1U) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NEAR(terms_of(result)[0]->amplitude(), 24.0, 1.0) << list(result);
  }
}

TEST(BodyForms, ABeltThatIsWiderIsOneFormOfTheRadius) {
  const MadeGear gear = spur(26);
  for (const unsigned seed : survey_of(1, {2U, 4U})) {
    const auto made = grown([](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      return outwards(g, s, p, 90.0 * std::exp(-std::pow((s.v - 0.1) / 0.35, 2)));
    });
    const auto result = measured(gear, made, 4.0, seed);
    EXPECT_TRUE(tells(result, "the body is wider")) << list(result);
    // (echoes of a quarter of the noise may stand beside it)
    ASSERT_FALSE(terms_of(result).empty()) << list(result);
    for (const loop::Term* term : terms_of(result))
      if (term != terms_of(result)[0]) {
        EXPECT_LT(term->amplitude(), 1.0) << list(result);
      }
    EXPECT_NEAR(terms_of(result)[0]->amplitude(), 90.0, 5.0) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
