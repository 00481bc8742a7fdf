// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/loop/made_gears.h"

// Many pits or lumps at random places of the flanks.
namespace trueflank::test {
namespace {

struct DrawnPit {
  int tooth = 1, side = 1;
  double along_mm = 0.0, up_mm = 0.0;  ///< from the root form circle, from the lower end
  double half_mm = 0.2, depth_um = 10.0;
};

/// Length of the flank from the root form circle on, summed up in short straight pieces.
std::vector<double> lengths_of(const MadeGear& gear, int pieces) {
  std::vector<double> lengths{0.0};
  Vec3 last = point_on(gear, {1, 1, -1.0, -1.0});
  for (int k = 1; k <= pieces; ++k) {
    const Vec3 next = point_on(gear, {1, 1, -1.0 + 2.0 * k / pieces, -1.0});
    lengths.push_back(lengths.back() + std::hypot(next[0] - last[0], next[1] - last[1]));
    last = next;
  }
  return lengths;
}

double along_of(const std::vector<double>& lengths, double u) {
  const double at = 0.5 * (u + 1.0) * static_cast<double>(lengths.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(std::max(at, 0.0)), lengths.size() - 2);
  return lengths[k] + (at - static_cast<double>(k)) * (lengths[k + 1] - lengths[k]);
}

std::vector<DrawnPit> drawn(const MadeGear& gear, const std::vector<double>& lengths, int number,
                            unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<DrawnPit> pits;
  for (int k = 0; k < number; ++k)
    pits.push_back({std::uniform_int_distribution<int>(1, gear.teeth)(random), k % 2 == 0 ? 1 : -1,
                    between(0.15, lengths.back() - 0.15), between(0.3, gear.face_mm - 0.3),
                    between(0.2, 0.28), between(7.0, 11.0)});
  return pits;
}

/// Round hollows with the course of a squared cosine.
Process pitted(std::vector<DrawnPit> pits, std::vector<double> lengths, double sign) {
  return grown([pits, lengths, sign](const MadeGear& g, const FlankSpot& s, auto&) {
    double um = 0.0;
    for (const DrawnPit& pit : pits) {
      if (pit.tooth != s.tooth || pit.side != s.side) continue;
      const double off = std::hypot(along_of(lengths, s.u) - pit.along_mm,
                                    0.5 * (s.v + 1.0) * g.face_mm - pit.up_mm) /
                         pit.half_mm;
      if (off < 1.0) um += sign * pit.depth_um * std::pow(std::cos(0.5 * M_PI * off), 2);
    }
    return um;
  });
}

const loop::Term* pits_of(const loop::LoopResult& result) {
  for (const auto& effect : result.effects)
    for (const auto& term : effect.terms)
      for (const auto& [key, value] : term.keys)
        if (key == "pits") return &term;
  return nullptr;
}

TEST(Pits, AreCountedAndNothingElseIsTold) {
  for (const unsigned seed : survey_of(2, {1U, 2U, 3U, 4U, 5U, 6U}))
    for (const double sign : {-1.0, 1.0}) {
      const MadeGear gear = seed % 2 == 0 ? helical(23, 15.0) : spur(21);
      const std::vector<double> lengths = lengths_of(gear, 400);
      const int number = seed % 2 == 0 ? 40 : 26;
      const auto pits = drawn(gear, lengths, number, seed);
      const auto result = close(
          gear, scan_of(gear, {pitted(pits, lengths, sign)}, scanned(90000, 1.2, seed)), true);
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
      ASSERT_EQ(result.effects.size(), 1U) << list(result);
      const loop::Term* told = pits_of(result);
      ASSERT_NE(told, nullptr) << list(result);
      EXPECT_GE(told->shape[0], 0.8 * number) << list(result);
      EXPECT_LE(told->shape[0], number) << list(result);
      EXPECT_NEAR(told->shape[1], number, 0.15 * number) << list(result);
      EXPECT_TRUE(tells(result, sign < 0.0 ? " pits" : " lumps")) << list(result);
      double depth = 0.0;
      for (const DrawnPit& pit : pits) depth += pit.depth_um / number;
      EXPECT_NEAR(told->amplitude(), depth, 0.2 * depth) << list(result);
    }
}

TEST(Pits, HideNothingThatIsBesideThem) {
  const MadeGear gear = spur(24);
  const std::vector<double> lengths = lengths_of(gear, 400);
  const auto process = pitted(drawn(gear, lengths, 30, 3), lengths, -1.0);
  const auto beside =
      grown([](const MadeGear&, const FlankSpot& s, auto&) { return -8.0 * s.v * s.v; });
  const auto result = close(gear, scan_of(gear, {process, beside}, scanned(60000, 1.2, 3)), true);
  ASSERT_NE(pits_of(result), nullptr) << list(result);
  const auto* crowning = find(result, "crowning");
  ASSERT_NE(crowning, nullptr) << list(result);
  EXPECT_NEAR(parameter(*crowning, "amount_um").value, 8.0, 0.3) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

// One place of a tool that dents every fourth tooth, and a sunk side of the body, are no pits.
TEST(Pits, AreNotWhatTeethHaveAtOnePlace) {
  const MadeGear gear = spur(32);
  for (const bool body : {false, true}) {
    const auto process = grown([body](const MadeGear&, const FlankSpot& s, auto&) {
      const double there = std::exp(-std::pow((s.u - 0.2) / 0.2, 2) - std::pow(s.v / 0.1, 2));
      if (body) return -12.0 * there * std::exp(-std::pow((s.tooth - 16) / 5.0, 2));
      return s.side > 0 && s.tooth % 3 == 1 ? -12.0 * there : 0.0;
    });
    const auto result = close(gear, scan_of(gear, {process}, scanned(12000, 1.2, 5)), true);
    EXPECT_EQ(pits_of(result), nullptr) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
