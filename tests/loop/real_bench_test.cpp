// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/loop/bench_logs.h"
#include "tests/loop/sample_bench.h"
#include "tests/support/survey_size.h"
#include "trueflank/loop/drive/drive_fit.h"

// Real benches; skipped where the data are not there (their licence is not stated, or they are large).
namespace trueflank::test {
namespace {

constexpr const char* kRatioSix = R"(format = 1
[gearbox]
kind = "simple"
planets = 3
module_mm = 0.5
[sun]
teeth = 18
face_width_mm = 8
[planet]
teeth = 36
face_width_mm = 8
[ring]
teeth = 90
face_width_mm = 8
)";

TEST(PlanetaryDyno, GainsPowerBackwardsAndIsNotCalledFriction) {
  const auto folder = shared_data("planetary_dyno");
  if (!folder) GTEST_SKIP() << "no shared data";
  const auto train = lay_out(*read_design_text(kRatioSix, "dyno"));
  ASSERT_TRUE(train);
  const auto model = loop::drive_model(*train);
  ASSERT_TRUE(model);
  loop::BenchData data;
  for (const char* log : {"22_04_2021_17-07-52", "22_04_2021_17-11-42", "22_04_2021_17-16-20",
                          "22_04_2021_17-48-39"})
    ASSERT_TRUE(loop::read_bench_text(
                    log, dyno_bench_file(*folder / (std::string(log) + ".csv"), 2), data).empty());
  const auto closed = loop::close_drive_loop(*model, data);
  ASSERT_TRUE(closed);
  const loop::LoopResult& r = closed->result;
  EXPECT_EQ(r.verdict, loop::Verdict::kPartlyExplained);
  EXPECT_THAT(r.structure_left, testing::HasSubstr("no gearbox delivers more than it takes"));
  // Readings alone, with a name or as one that bends from a load on.
  for (const loop::FoundEffect& effect : r.effects)
    if (effect.named)
      EXPECT_THAT((std::vector<std::string>{"torque_scale", "torque_offset"}),
                  testing::Contains(effect.id));
    else
      EXPECT_THAT(effect.description, testing::AnyOf(testing::HasSubstr("torque is read otherwise"),
                                                     testing::HasSubstr("a reading, no loss")));
  ASSERT_FALSE(r.measure_next.empty());
  EXPECT_THAT(r.measure_next.front(), testing::HasSubstr("without the gearbox"));
  EXPECT_THAT(r.measure_next.front(), testing::HasSubstr("swapped"));
}

/// Held-out error of effects that are always fitted.
double held_out_rms(const loop::DriveModel& model, loop::BenchTable table,
                    const std::vector<std::string>& ids) {
  loop::measure_extent(table);
  const loop::EfficiencyCurve curve(model);
  const auto meshes = loop::mesh_curves(model);
  loop::DriveContext context{model, curve, table, meshes, {}};
  Eigen::VectorXd value(static_cast<Eigen::Index>(table.points.size()));
  for (std::size_t i = 0; i < table.points.size(); ++i)
    value[static_cast<Eigen::Index>(i)] =
        table.points[i].driven_nm - loop::predicted_nm(model, curve, table.points[i]);
  std::vector<loop::DriveEffect> effects;
  for (const std::string& id : ids) effects.push_back({loop::find_drive_family(id), {}});
  Eigen::VectorXd left = value;
  for (int round = 0; round < 6; ++round) {
    const loop::DriveFit fit(context, value, effects, loop::FitRows::kTraining);
    left = value - fit.explained_nm();
    if (ids.front() == "torque_scale") context.state.scale = 1.0 + fit.coefficients()[0];
  }
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < table.points.size(); ++i)
    if (table.points[i].fold == 0) {
      sum += left[static_cast<Eigen::Index>(i)] * left[static_cast<Eigen::Index>(i)];
      count += 1.0;
    }
  return std::sqrt(sum / count);
}

TEST(ServoPendulum, TheFrictionFoundBeatsCoulombAndViscousOnLogsNotSeen) {
  const auto folder = shared_data("servo_pendulum_xl330");
  if (!folder) GTEST_SKIP() << "no shared data";
  std::vector<std::filesystem::path> logs;
  for (const auto& entry : std::filesystem::directory_iterator(*folder))
    if (entry.path().extension() == ".csv") logs.push_back(entry.path());
  std::sort(logs.begin(), logs.end());
  ASSERT_EQ(logs.size(), 16u);
  logs.resize(survey_size(8U, 16U));  // (in the gate those of two gains of four)
  // One log of every motion and every gain is locked away.
  const loop::BenchTable table = pendulum_table(
      logs, {"kp100_lift_and_drop", "kp200_sin_sin", "kp400_sin_time_square", "kp800_up_and_down"});
  loop::DriveModel servo;
  servo.ratio = 1.0;
  servo.friction = 0.0;
  servo.meshes = {"gear train"};
  servo.efficiency = [](const std::vector<double>& mu) {
    return loop::DriveEfficiency{1.0 - mu[0], 1.0 - mu[0]};
  };
  const double coulomb_viscous =
      held_out_rms(servo, table, {"torque_scale", "drag_torque", "viscous_drag"});
  const loop::DriveLoop closed = loop::close_drive_table(servo, table);
  EXPECT_NE(closed.result.verdict, loop::Verdict::kNoEffect);
  EXPECT_LT(closed.result.after.held_out_rms, 0.85 * coulomb_viscous)
      << coulomb_viscous << "\n" << loop::loop_text(closed.result);
  EXPECT_LT(coulomb_viscous, closed.result.before.held_out_rms);
}

}  // namespace
}  // namespace trueflank::test
