// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/loop/sample_bench.h"
#include "tests/support/survey_size.h"
#include "trueflank/report/drive_html.h"

namespace trueflank::test {
namespace {

using loop::Verdict;

struct HiddenCase {
  std::string id;
  HiddenDrive drive;
  std::vector<std::pair<std::string, double>> truth;  ///< parameter, value
  BenchPlan plan = {};
};
void PrintTo(const HiddenCase& c, std::ostream* out) { *out << c.id; }

HiddenDrive losing(std::function<double(const BenchMoment&)> loss) {
  HiddenDrive drive;
  drive.loss_nm = std::move(loss);
  return drive;
}
HiddenDrive rubbing(std::function<double(const BenchMoment&, int)> friction) {
  HiddenDrive drive;
  drive.friction = std::move(friction);
  return drive;
}
BenchPlan warming() {
  BenchPlan plan;
  plan.low_celsius = 20.0;
  plan.high_celsius = 60.0;
  return plan;
}
BenchPlan turning() {
  BenchPlan plan;
  plan.angles = true;
  plan.turns_between = 3.7;
  return plan;
}

std::vector<HiddenCase> hidden_cases() {
  std::vector<HiddenCase> cases{
      {"friction_coefficient", rubbing([](auto&, int) { return 0.13; }), {{"value", 0.13}}},
      {"drag_torque", losing([](auto&) { return 0.003; }), {{"torque_nm", 0.003}}},
      {"viscous_drag", losing([](auto& m) { return 2e-6 * m.rpm; }), {{"nm_per_rpm", 2e-6}}},
      {"bearing_friction", losing([](auto& m) { return 0.003 * std::pow(m.rpm / 1000.0, 2.0 / 3.0); }),
       {{"nm_at_1000_rpm", 0.003}}},
      {"stribeck_friction",
       losing([](auto& m) { return 0.008 * std::exp(-std::pow(m.rpm / 300.0, 2)); }),
       {{"torque_nm", 0.008}, {"speed_rpm", 300}}},
      {"load_dependent_friction", rubbing([](auto& m, int) { return 0.1 + 0.04 * m.load_share; }),
       {{"value", 0.04}}},
      {"temperature_viscosity",
       losing([](auto& m) { return 3e-6 * m.rpm * std::exp(-0.03 * (m.celsius - 40.0)); }),
       {{"per_c", 0.03}}, warming()},
      {"angle_periodic_friction",
       losing([](auto& m) { return 0.002 * std::cos(2.0 * M_PI * m.input_turns * 12.0 / 102.0 - 0.5); }),
       {{"order", 12.0 / 102.0}, {"amplitude_nm", 0.002}, {"phase_deg", 28.65}}, turning()},
  };
  HiddenDrive scale, offset;
  scale.output_reads = 1.05;
  offset.input_zero_nm = 0.001;  // more would make the apparent efficiency at low load exceed 1
  cases.push_back({"torque_scale", scale, {{"factor", 1.05}}});
  cases.push_back({"torque_offset", offset, {{"offset_nm", 0.001}}});
  return cases;
}

class HiddenEffect : public testing::TestWithParam<HiddenCase> {};

TEST_P(HiddenEffect, IsFoundNamedAndRight) {
  const HiddenCase& c = GetParam();
  const auto closed = close_hidden(c.drive, c.plan);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  const loop::FoundEffect* effect = found(r, c.id);
  ASSERT_NE(effect, nullptr) << loop::loop_text(r);
  EXPECT_EQ(r.effects.size(), 1u) << loop::loop_text(r);
  EXPECT_EQ(r.verdict, Verdict::kExplained);
  for (const auto& [name, value] : c.truth) {
    const loop::Parameter* p = parameter(*effect, name);
    ASSERT_NE(p, nullptr) << name;
    // Twice the 95 % interval: one case in 17 000 by chance.
    EXPECT_LE(std::abs(p->value - value), 1.0 * (p->high - p->low) + 1e-9) << loop::loop_text(r);
  }
  EXPECT_LT(r.after.held_out_rms, 0.6 * r.before.held_out_rms);
  EXPECT_NEAR(r.after.held_out_rms, r.noise, 0.35 * r.noise);
}

INSTANTIATE_TEST_SUITE_P(Drive, HiddenEffect, testing::ValuesIn(hidden_cases()),
                         [](const auto& given) { return given.param.id; });

TEST(DriveLoop, GeneratorAndModelAgreeWithoutHiddenEffects) {
  const loop::DriveEfficiency e = bench_model().at(0.1);
  // the generator sums over 4000 moments of a pitch
  EXPECT_NEAR(e.forward, paper_train().forward({0.1, 0.1, 0.1}), 1e-4);
  EXPECT_NEAR(e.backward, paper_train().backward({0.1, 0.1, 0.1}), 1e-4);
  EXPECT_NEAR(bench_model().ratio, paper_train().ratio(), 1e-9);
}

TEST(DriveLoop, SaysNoEffectWhereNoneIs) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    BenchPlan plan;
    plan.seed = 100 + seed;
    const auto closed = close_hidden({}, plan);
    ASSERT_TRUE(closed);
    alarms += closed->result.verdict != Verdict::kNoEffect;
  }
  // At the rate of 2 % four of twelve come once in 14 000 trials.
  EXPECT_LT(alarms, 4);
}

/// Six dwells of 150 rows: three loads in either direction, at one speed, with a loss at the input,
/// errors of which a share hangs together from row to row, and readings in steps.
std::string six_dwells(double loss_nm, double together, unsigned seed, double step_nm = 1e-6) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const loop::DriveEfficiency e = bench_model().at(0.1);
  const double ratio = bench_model().ratio;
  std::string text = "direction,input_speed_rpm,input_torque_nm,output_torque_nm\n";
  double error = normal(random);
  for (const bool forward : {true, false})
    for (const double load_nm : {10.0, 20.0, 35.0})
      for (int row = 0; row < 150; ++row) {
        error = together * error + std::sqrt(1.0 - together * together) * normal(random);
        const double input_nm = forward ? load_nm / (ratio * e.forward) + loss_nm
                                        : load_nm * e.backward / ratio - loss_nm + 0.002 * error;
        const double output_nm = load_nm + (forward ? 0.002 * ratio * error : 0.0);
        text += std::string(forward ? "forward" : "backward") + ",1000," +
                std::to_string(step_nm * std::round(input_nm / step_nm)) + "," +
                std::to_string(step_nm * std::round(output_nm / step_nm)) + "\n";
      }
  return text;
}

// So few set points can be turned over in too few ways for any effect to be surer than chance, but
// the readings of each say that they are off the model.
TEST(DriveLoop, AFewSetPointsFarOffTheModelAreNotCalledNoise) {
  for (const double together : {0.0, 0.6, 0.85})
    for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed) {
      const auto closed = close_bench_text(six_dwells(0.012, together, seed));
      ASSERT_TRUE(closed);
      EXPECT_NE(closed->result.verdict, Verdict::kNoEffect) << loop::loop_text(closed->result);
    }
  unsigned alarms = 0;
  const unsigned quiet = survey_size(4U, 8U);
  for (const double together : {0.0, 0.6, 0.85, 0.95})
    for (unsigned seed = 1; seed <= quiet; ++seed) {
      const auto closed = close_bench_text(six_dwells(0.0, together, 100 + seed));
      ASSERT_TRUE(closed);
      alarms += closed->result.verdict != Verdict::kNoEffect;
    }
  EXPECT_LE(8 * alarms, 2 * quiet);
  // All rows of a dwell may be rounded alike.
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto closed = close_bench_text(six_dwells(0.0, 0.0, 200 + seed, 0.005));
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->result.structure_left.find("lie"), std::string::npos)
        << loop::loop_text(closed->result);
  }
}

TEST(DriveLoop, TwoEffectsAreFoundTogether) {
  HiddenDrive drive = rubbing([](auto&, int) { return 0.13; });
  drive.loss_nm = [](auto& m) { return 0.002 + 2e-6 * m.rpm; };
  const auto closed = close_hidden(drive);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  for (const char* id : {"friction_coefficient", "drag_torque", "viscous_drag"})
    EXPECT_NE(found(r, id), nullptr) << id << "\n" << loop::loop_text(r);
  EXPECT_EQ(r.effects.size(), 3u) << loop::loop_text(r);
}

TEST(DriveLoop, EfficiencyAboveOneIsNeverCalledFriction) {
  HiddenDrive drive;
  drive.output_reads = 1.15;
  const auto closed = close_hidden(drive);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  EXPECT_EQ(r.verdict, Verdict::kPartlyExplained);
  ASSERT_NE(found(r, "torque_scale"), nullptr) << loop::loop_text(r);
  EXPECT_NEAR(parameter(*found(r, "torque_scale"), "factor")->value, 1.15, 0.01);
  EXPECT_TRUE(cannot_tell(*found(r, "torque_scale"), "friction_coefficient"));
  for (const loop::FoundEffect& effect : r.effects)
    EXPECT_THAT((std::vector<std::string>{"torque_scale", "torque_offset"}), testing::Contains(effect.id));
  ASSERT_FALSE(r.measure_next.empty());
  EXPECT_THAT(r.measure_next.front(), testing::HasSubstr("without the gearbox"));
}

/// Twice the 95 % interval: one case in 17 000 by chance.
void expect_held(const loop::LoopResult& r, const std::string& id, const std::string& name, double truth) {
  const loop::FoundEffect* effect = found(r, id);
  ASSERT_NE(effect, nullptr) << id << "\n" << loop::loop_text(r);
  const loop::Parameter* p = parameter(*effect, name);
  ASSERT_NE(p, nullptr) << name;
  EXPECT_LE(std::abs(p->value - truth), p->high - p->low) << id << "\n" << loop::loop_text(r);
}

TEST(DriveLoop, AZeroByWhichPowerIsGainedHasItsSizeAndTheFrictionBesideItToo) {
  HiddenDrive drive = rubbing([](auto&, int) { return 0.13; });
  drive.output_zero_nm = 0.4;
  const auto closed = close_hidden(drive);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  EXPECT_EQ(r.verdict, Verdict::kPartlyExplained);
  EXPECT_THAT(r.structure_left, testing::HasSubstr("no gearbox delivers more than it takes"));
  EXPECT_EQ(r.effects.size(), 2u) << loop::loop_text(r);
  ASSERT_NE(found(r, "torque_offset"), nullptr) << loop::loop_text(r);
  // two sensors give only their ratio: of the input's zero the figure is another
  if (found(r, "torque_offset")->side == "output") expect_held(r, "torque_offset", "offset_nm", 0.4);
  expect_held(r, "friction_coefficient", "value", 0.13);
}

TEST(DriveLoop, LossesBesideAScaleHaveTheirSizes) {
  // A loss passes through the sensor that reads too much, and so does the load that it follows.
  HiddenDrive drive = losing([](const BenchMoment& m) { return 0.004 + 0.006 * m.load_share * m.load_share; });
  drive.output_reads = 1.11;  // flanks that differ between the directions would have to give power
  const auto closed = close_hidden(drive);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  expect_held(r, "torque_scale", "factor", 1.11);
  expect_held(r, "drag_torque", "torque_nm", 0.004);
  EXPECT_FALSE(cannot_tell(*found(r, "drag_torque"), "torque_scale")) << loop::loop_text(r);
}

TEST(DriveLoop, ADragBesideAScaleHasItsSizeToAHundredth) {
  HiddenDrive drive = losing([](const BenchMoment&) { return 0.004; });
  drive.output_reads = 1.11;
  // So little noise that a tenth of the loss in one direction is many times its interval.
  const auto closed = close_hidden(
      drive, {.noise_forward_nm = 0.01, .noise_backward_nm = 0.0001, .noise_driving = 0.0001});
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  expect_held(r, "torque_scale", "factor", 1.11);
  ASSERT_NE(found(r, "drag_torque"), nullptr) << loop::loop_text(r);
  EXPECT_NEAR(parameter(*found(r, "drag_torque"), "torque_nm")->value, 0.004, 4e-5);
}

TEST(DriveLoop, OneDirectionCannotTellScaleFromFrictionAndTheOtherCan) {
  HiddenDrive drive;
  drive.output_reads = 1.05;
  BenchPlan forward;
  forward.backward = false;
  const auto one = close_hidden(drive, forward);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->result.effects.size(), 1u) << loop::loop_text(one->result);
  EXPECT_EQ(one->result.effects[0].id, "friction_coefficient");
  EXPECT_TRUE(cannot_tell(one->result.effects[0], "torque_scale"));
  const auto both = close_hidden(drive);
  ASSERT_TRUE(both);
  ASSERT_NE(found(both->result, "torque_scale"), nullptr) << loop::loop_text(both->result);
  EXPECT_FALSE(cannot_tell(*found(both->result, "torque_scale"), "drag_torque"));
}

TEST(DriveLoop, FrictionOfADirectionCannotBeToldFromAScale) {
  const HiddenDrive drive = rubbing([](auto& m, int) { return m.forward ? 0.08 : 0.12; });
  const auto closed = close_hidden(drive);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  const loop::FoundEffect* effect = found(r, "direction_dependent_friction");
  const bool by_direction = effect != nullptr;
  if (!by_direction) effect = found(r, "torque_scale");
  ASSERT_NE(effect, nullptr) << loop::loop_text(r);
  EXPECT_TRUE(cannot_tell(*effect, by_direction ? "torque_scale" : "direction_dependent_friction"));
  EXPECT_THAT(loop::loop_text(r), testing::HasSubstr("a lever and weights"));
}

TEST(DriveLoop, ALossThatBendsOverTheLoadHasItsNameFromBothDirectionsAlone) {
  const auto drive = losing([](const BenchMoment& m) { return 0.006 * m.load_share * m.load_share; });
  BenchPlan forward;
  forward.backward = false;
  const auto one = close_hidden(drive, forward);
  ASSERT_TRUE(one);
  ASSERT_FALSE(one->result.effects.empty());
  EXPECT_NE(one->result.verdict, loop::Verdict::kNoEffect);
  for (const loop::FoundEffect& effect : one->result.effects)
    EXPECT_FALSE(effect.id == "load_loss" || effect.id == "load_dependent_friction") << effect.id;
  EXPECT_TRUE(cannot_tell(one->result.effects.front(), "load_loss"));
  const auto both = close_hidden(drive);
  ASSERT_TRUE(both);
  ASSERT_EQ(both->result.effects.size(), 1u);
  EXPECT_TRUE(found(both->result, "load_loss") != nullptr || found(both->result, "load_dependent_friction") != nullptr);
}

TEST(DriveLoop, FlanksThatWearOverTheRunAreToldByTheirFriction) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const PaperTrain& train = paper_train();
  loop::BenchData data;
  data.files = {"bench.csv"};
  for (int pass = 0; pass < 3; ++pass)
    for (const bool forward : {true, false})
      for (const double speed : {100.0, 400.0, 1000.0, 2500.0})
        for (const double load : {1.0, 4.0, 8.0, 13.0, 19.0})
          data.rows.push_back({.forward = forward, .speed_rpm = speed, .output_nm = load});
  std::shuffle(data.rows.begin(), data.rows.end(), random);
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    loop::BenchRow& row = data.rows[i];
    const double mu = 0.1 + 0.04 * static_cast<double>(i) / static_cast<double>(data.rows.size() - 1);
    row.line = static_cast<int>(i) + 2;
    if (row.forward) {
      row.input_nm = row.output_nm / train.ratio();
      row.output_nm = train.ratio() * train.forward({mu, mu, mu}) * row.input_nm + 0.03 * normal(random);
    } else {
      row.input_nm = train.backward({mu, mu, mu}) * row.output_nm / train.ratio() + 0.0003 * normal(random);
    }
  }
  const auto closed = loop::close_drive_loop(bench_model(), data);
  ASSERT_TRUE(closed);
  ASSERT_EQ(closed->result.effects.size(), 1u) << loop::loop_text(closed->result);
  ASSERT_EQ(closed->result.effects.front().id, "friction_drift");
  EXPECT_NEAR(parameter(closed->result.effects.front(), "drift")->value, 0.04, 0.006);
}

TEST(DriveLoop, ASensorAskewOnItsShaftReadsInAWaveAndIsNoFriction) {
  HiddenDrive drive;
  drive.output_reading = [](double nm, const BenchMoment& m) {
    return nm * (1.0 + 0.02 * std::cos(2.0 * M_PI * m.input_turns / paper_train().ratio() - 0.7));
  };
  BenchPlan plan = turning();
  plan.turns_between = 13.7;
  const auto closed = close_hidden(drive, plan);
  ASSERT_TRUE(closed);
  const loop::FoundEffect* wave = found(closed->result, "torque_wave");
  ASSERT_NE(wave, nullptr) << told(closed->result);
  EXPECT_EQ(closed->result.effects.size(), 1U) << told(closed->result);
  EXPECT_EQ(wave->side, "output");
  EXPECT_NEAR(parameter(*wave, "order")->value, 1.0 / paper_train().ratio(), 1e-6);
  EXPECT_EQ(parameter(*wave, "with_load")->value, 1.0);
}

TEST(DriveLoop, AChipInTheRingIsAPartOfEveryTurnAndNoRowOfWaves) {
  HiddenDrive drive;  // over 0.1 of every turn of the input, from 0.4 on
  drive.loss_nm = [](const BenchMoment& m) {
    const double place = m.input_turns - std::floor(m.input_turns);
    return place > 0.4 && place < 0.5 ? 0.006 : 0.0;
  };
  BenchPlan plan = turning();
  plan.turns_between = 13.7;
  const auto closed = close_hidden(drive, plan);
  ASSERT_TRUE(closed);
  const loop::FoundEffect* chip = found(closed->result, "unnamed");
  ASSERT_NE(chip, nullptr) << told(closed->result);
  EXPECT_EQ(closed->result.effects.size(), 1U) << told(closed->result);
  EXPECT_NE(chip->description.find("over a part of every turn of the input"), std::string::npos)
      << chip->description;
  EXPECT_NEAR(parameter(*chip, "from_deg")->value, 144.0, 4.0) << chip->description;
  EXPECT_NEAR(parameter(*chip, "width_deg")->value, 36.0, 5.0) << chip->description;
  EXPECT_NEAR(parameter(*chip, "amplitude_nm")->value, 0.006, 0.0006);
}

TEST(DriveLoop, AnOilThatWasChangedIsAJumpAtItsRowAndNoDrift) {
  HiddenDrive drive;
  drive.friction = [](const BenchMoment& m, int) { return m.input_turns > 3800.0 ? 0.16 : 0.1; };
  const auto closed = close_hidden(drive, {});
  ASSERT_TRUE(closed);
  EXPECT_NE(closed->result.verdict, Verdict::kNoEffect);
  for (const auto& effect : closed->result.effects) EXPECT_NE(effect.id, "friction_drift");
  ASSERT_FALSE(closed->result.effects.empty());
  EXPECT_NE(told(closed->result).find("jumps in the course of the run at line"), std::string::npos)
      << told(closed->result);
}

// A friction and a viscous drag imitate it together.
TEST(DriveLoop, ALossThatGrowsWithTorqueAndSpeedTogetherHasNoName) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    BenchPlan plan;
    plan.seed = seed;
    const auto closed =
        close_hidden(losing([](auto& m) { return 0.006 * m.load_share * m.rpm / 3000.0; }), plan);
    ASSERT_TRUE(closed);
    for (const auto& effect : closed->result.effects)
      EXPECT_FALSE(effect.named) << loop::loop_text(closed->result);
    EXPECT_THAT(told(closed->result), testing::HasSubstr("in proportion to the load times the speed"));
  }
}

TEST(DriveLoop, ASensorThatSaturatesIsToldByTheLoadFromWhichItBends) {
  HiddenDrive drive;
  drive.output_reading = [](double nm, const BenchMoment&) {
    return nm - 0.35 * std::max(0.0, nm - 15.0);
  };
  const auto closed = close_hidden(drive, {});
  ASSERT_TRUE(closed);
  EXPECT_THAT(told(closed->result),
              testing::HasSubstr("the output's torque is read otherwise from a load"));
  EXPECT_LT(closed->result.after.rms, 1.2 * 0.05 / std::sqrt(2.0)) << told(closed->result);
}

/// A drag over a run in which the drive grows warm, every set point once in a dwell of some rows.
loop::BenchData warming_run(const loop::DriveModel& model, std::uint64_t seed, int dwell,
                            const std::function<double(double taken, double celsius)>& drag_nm) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::array<double, 3>> set_points;
  for (const double load : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0})
    for (const double rpm : {60.0, 150.0, 300.0, 600.0, 1000.0, 1500.0, 2000.0, 2500.0})
      for (const double forward : {1.0, 0.0}) set_points.push_back({load, rpm, forward});
  std::shuffle(set_points.begin(), set_points.end(), random);
  const loop::DriveEfficiency eta = model.at(model.friction);
  constexpr double kSigma = 0.001;
  loop::BenchData data;
  data.files = {"run.csv"};
  const double rows = static_cast<double>(dwell) * static_cast<double>(set_points.size());
  for (const auto& [load, rpm, forward] : set_points)
    for (int i = 0; i < dwell; ++i) {
      const double taken = static_cast<double>(data.rows.size()) / rows;
      loop::BenchRow row;
      row.forward = forward > 0.5;
      row.speed_rpm = rpm;
      row.temperature_c = 22.0 + 38.0 * (1.0 - std::exp(-taken / 0.35)) +
                          4.0 * std::sin(10.0 * M_PI * taken);
      const double lost = drag_nm(taken, row.temperature_c);
      if (row.forward) {
        row.input_nm = load;
        row.output_nm = model.ratio * (eta.forward * (load - lost) + kSigma * normal(random));
      } else {
        row.output_nm = load * model.ratio;
        row.input_nm = eta.backward * load - lost + kSigma * normal(random);
      }
      row.line = static_cast<int>(data.rows.size()) + 2;
      data.rows.push_back(row);
    }
  return data;
}

TEST(DriveLoop, ARunInIsNotTakenForWarmth) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto closed = loop::close_drive_loop(
        bench_model(), warming_run(bench_model(), seed, 4, [](double t, double) { return 0.006 * std::exp(-t / 0.2); }));
    ASSERT_TRUE(closed);
    const loop::LoopResult& r = closed->result;
    EXPECT_FALSE(r.effects.empty());
    for (const auto& effect : r.effects)
      EXPECT_TRUE(!effect.named || testing::Value(effect.confounded_with, testing::Contains("drag_drift")))
          << loop::loop_text(r);
    EXPECT_TRUE(r.verdict != Verdict::kExplained || r.after.rms < 1.15 * r.noise) << told(r);
  }
}

TEST(DriveLoop, AStepOverTheTemperatureEarlyInTheRunIsNoThinning) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= survey_size(5U, 16U); ++seed) {
    const auto closed = loop::close_drive_loop(
        bench_model(),
        warming_run(bench_model(), seed, 2 + static_cast<int>(seed % 2),
                    [](double, double c) { return c < 36.0 ? 0.004 : 0.0; }));
    ASSERT_TRUE(closed);
    for (const auto& effect : closed->result.effects) named += effect.named ? 1 : 0;
  }
  EXPECT_EQ(named, 0);
}

// Jumps and parts of the run imitate it and leave its rest.
TEST(DriveLoop, AZeroThatWandersIsACourseOfTheRunAndLeavesNoMoreThanTheNoise) {
  HiddenDrive drive;
  drive.output_reading = [](double nm, const BenchMoment& m) {
    return nm + 0.25 * std::sin(2.0 * M_PI * 1.5 * m.input_turns / 5400.0 + 0.7);
  };
  BenchPlan plan;
  plan.output_nm = {4, 8, 12, 16, 20};
  const auto closed = close_hidden(drive, plan);
  ASSERT_TRUE(closed);
  EXPECT_THAT(told(closed->result), testing::HasSubstr("comes and goes slowly"));
  EXPECT_THAT(told(closed->result), testing::HasSubstr("a zero of the output's torque that wanders"));
  EXPECT_LT(closed->result.after.rms, 1.2 * 0.05 / std::sqrt(2.0)) << told(closed->result);
}

// A zero that moves within a few rows moves the driven torque up in one direction and down in the
// other: neighbours are alike only once one direction is turned over.
TEST(DriveLoop, WhatNeighboursShareIsNotCalledNoiseThoughItsSignTurnsWithTheDirection) {
  HiddenDrive drive = rubbing([](auto&, int) { return 0.13; });
  auto zero_nm = std::make_shared<double>(0.0);
  auto random = std::make_shared<std::mt19937_64>(5);
  drive.output_reading = [=](double nm, auto&) {
    *zero_nm = 0.75 * *zero_nm + 0.2 * std::normal_distribution<double>()(*random);
    return nm + *zero_nm;
  };
  BenchPlan plan;
  plan.output_nm = {4, 8, 12, 16, 20};
  const auto closed = close_hidden(drive, plan);
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->result.verdict, Verdict::kPartlyExplained) << told(closed->result);
  EXPECT_THAT(told(closed->result), testing::HasSubstr("neighbouring rows share"));
}

// Whether the zero is the input's or the output's, two sensors hardly tell, and the drag beside it
// is another one for each.
TEST(DriveLoop, TheIntervalOfADragHoldsWhicheverSensorHasTheZero) {
  HiddenDrive drive = losing([](auto&) { return 0.004; });
  drive.output_zero_nm = 0.4;
  BenchPlan plan;
  plan.output_nm = {6, 10, 14, 17, 20};
  int told = 0, held = 0;
  for (plan.seed = 1; plan.seed <= 10; ++plan.seed) {
    const auto closed = close_hidden(drive, plan);
    ASSERT_TRUE(closed);
    const loop::FoundEffect* drag = found(closed->result, "drag_torque");
    if (drag == nullptr) continue;
    const loop::Parameter* torque = parameter(*drag, "torque_nm");
    ++told;
    held += torque->low <= 0.004 && 0.004 <= torque->high ? 1 : 0;
  }
  EXPECT_GE(told, 8);
  EXPECT_GE(held, told - 1);
}

TEST(DriveLoop, OneLoadCannotTellDragFromFrictionAndASweepCan) {
  const HiddenDrive drive = losing([](auto&) { return 0.004; });
  BenchPlan one_load;
  one_load.output_nm = {10};
  one_load.repeats = 6;
  const auto one = close_hidden(drive, one_load);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->result.effects.size(), 1u) << loop::loop_text(one->result);
  const loop::FoundEffect& effect = one->result.effects[0];
  EXPECT_TRUE(effect.id == "drag_torque" ? cannot_tell(effect, "friction_coefficient")
                                         : cannot_tell(effect, "drag_torque"))
      << loop::loop_text(one->result);
  EXPECT_THAT(loop::loop_text(one->result), testing::HasSubstr("a sweep of the load"));
  const auto sweep = close_hidden(drive);
  ASSERT_TRUE(sweep);
  ASSERT_EQ(sweep->result.effects.size(), 1u);
  EXPECT_EQ(sweep->result.effects[0].id, "drag_torque");
  EXPECT_FALSE(cannot_tell(sweep->result.effects[0], "friction_coefficient"));
}

TEST(DriveLoop, ThreeNumbersNameNoEffectButWhatEachWouldHaveToBe) {
  const auto closed = loop::close_drive_loop(
      bench_train(), {TRUEFLANK_SOURCE_DIR "/examples/bilateral_drive/measured.csv"});
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  EXPECT_EQ(r.verdict, Verdict::kPartlyExplained);
  EXPECT_TRUE(r.effects.empty());
  EXPECT_NEAR(r.before.rms, 0.02, 1e-12);
  std::map<std::string, const loop::PossibleExplanation*> by_id;
  for (const auto& p : r.possible) by_id[p.id] = &p;
  ASSERT_TRUE(by_id.contains("friction_coefficient"));
  EXPECT_TRUE(by_id["friction_coefficient"]->explains.empty());
  EXPECT_GT(by_id["friction_coefficient"]->left_points, 1.0);
  ASSERT_TRUE(by_id.contains("drag_torque"));
  // T0 = 0.020 eta_b / G, and the load at which T0 G / load is what the backward efficiency lacks.
  const double eta = bench_model().at(0.1).backward;
  EXPECT_NEAR(by_id["drag_torque"]->parameters[0].value, 0.020 * eta / 96.2419, 1e-8);
  EXPECT_NEAR(by_id["drag_torque"]->load_nm, 0.020 * eta / (eta - 0.853), 1e-4);
  for (const char* id : {"torque_scale", "direction_dependent_friction", "torque_offset"})
    EXPECT_TRUE(by_id.contains(id)) << id;
  EXPECT_THAT(r.structure_left, testing::HasSubstr("single out no effect"));
  EXPECT_THAT(r.measure_next.front(), testing::HasSubstr("load sweep"));
}

TEST(DriveLoop, JsonAndPageSpeakNewtonMetres) {
  const auto closed = close_hidden(losing([](auto&) { return 0.003; }));
  ASSERT_TRUE(closed);
  const std::string json = loop::loop_json(closed->result);
  for (const char* key : {"\"noise_nm\"", "\"held_out_rms_nm\"", "\"rms_points\"", "\"held_out_gain_nm\"",
                          "\"torque_nm\"", "\"gear\": \"drive\""})
    EXPECT_THAT(json, testing::HasSubstr(key));
  const std::string page = loop::drive_html(*closed);
  for (const char* word : {"measured", "model before", "model after", "residual after", "backward"})
    EXPECT_THAT(page, testing::HasSubstr(word));
  EXPECT_EQ(loop::loop_json(close_hidden(losing([](auto&) { return 0.003; }))->result), json);
}

}  // namespace
}  // namespace trueflank::test
