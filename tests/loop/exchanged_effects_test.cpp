// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/loop/sample_bench.h"
#include "tests/support/survey_size.h"

// Effects in whose place others explain as much: what is told then holds these too.
namespace trueflank::test {
namespace {

// Where both exponents fit alike no interval may exclude the truth of the other.
TEST(ExchangedEffects, IntervalsOfAFrictionThatFadesHoldTheExponentThatItHas) {
  int named = 0;
  const int draws = survey_size(12, 30);
  for (int draw = 0; draw < draws; ++draw) {
    BenchPlan plan;
    plan.seed = 40 + static_cast<std::uint64_t>(draw);
    const double value = 0.04 + 0.003 * (draw % 12), rpm = 200.0 + 25.0 * (draw % 13);
    HiddenDrive drive;
    drive.friction = [&](const BenchMoment& m, int) {
      return 0.1 + value * std::exp(-m.rpm / rpm);
    };
    const auto closed = close_hidden(drive, plan);
    ASSERT_TRUE(closed);
    const loop::FoundEffect* effect = found(closed->result, "mixed_friction");
    if (effect == nullptr) continue;
    ++named;
    const loop::Parameter* exponent = parameter(*effect, "exponent");
    ASSERT_NE(exponent, nullptr);
    EXPECT_LE(exponent->low, 1.0) << loop::loop_text(closed->result);
    const std::pair<const char*, double> truths[] = {{"value", value}, {"speed_rpm", rpm}};
    for (const auto& [name, truth] : truths) {
      const loop::Parameter* p = parameter(*effect, name);
      ASSERT_NE(p, nullptr) << name;
      // Twice the 95 % interval: one case in 17 000 by chance.
      const double half = 0.5 * (p->high - p->low);
      EXPECT_GE(truth, p->low - half) << name << "\n" << loop::loop_text(closed->result);
      EXPECT_LE(truth, p->high + half) << name << "\n" << loop::loop_text(closed->result);
    }
  }
  EXPECT_GE(named, draws - draws / 6);
}

// A share of the driving torque is no friction of one mesh, and not told as surely as that of what
// the output carries.
TEST(ExchangedEffects, AShareOfTheDrivingTorqueIsOfBearings) {
  for (const std::uint64_t seed : {71U, 72U, 73U}) {
    BenchPlan plan;
    plan.seed = seed;
    plan.repeats = 4;
    plan.noise_forward_nm = 0.015;
    plan.noise_backward_nm = 0.00015;
    plan.noise_driving = 0.0001;
    const double share = 0.012 + 0.003 * static_cast<double>(seed % 3);
    HiddenDrive drive;
    drive.loss_nm = [&](const BenchMoment& m) {
      return share * m.driving_nm / (m.forward ? 1.0 : paper_train().ratio());
    };
    const auto closed = close_hidden(drive, plan);
    ASSERT_TRUE(closed);
    EXPECT_EQ(found(closed->result, "mesh_friction"), nullptr) << told(closed->result);
    const loop::FoundEffect* bearings = found(closed->result, "bearing_load_friction");
    ASSERT_NE(bearings, nullptr) << told(closed->result);
    EXPECT_NEAR(parameter(*bearings, "share")->value, share, 0.1 * share) << told(closed->result);
    EXPECT_EQ(parameter(*bearings, "carried")->value, 2.0) << told(closed->result);
  }
}

}  // namespace
}  // namespace trueflank::test
