// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/sample_bench.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/loop/drive/drive_calibration.h"
#include "trueflank/train/efficiency.h"

namespace trueflank::test {
namespace {

HiddenDrive worn_drive() {
  HiddenDrive drive;
  drive.friction = [](auto&, int) { return 0.13; };
  drive.loss_nm = [](auto& m) { return 0.002 + 2e-6 * m.rpm; };
  return drive;
}

loop::CalibratedDesign calibrated(const HiddenDrive& drive, const BenchPlan& plan = {}) {
  const auto closed = close_hidden(drive, plan);
  return loop::calibrated_design(bench_train().design, *closed);
}

TEST(CalibratedDesign, PredictsTheEfficiencyThatTheDriveReallyHas) {
  const loop::CalibratedDesign c = calibrated(worn_drive());
  ASSERT_TRUE(c.design);
  ASSERT_TRUE(c.design->losses);
  const LossesDesign& losses = *c.design->losses;
  // What the generator's drive does at that load and speed, by its own formulas.
  const double load = losses.load_nm / paper_train().ratio();
  const double lost = 0.002 + 2e-6 * losses.input_speed_rpm;
  const double forward = load / (load / paper_train().forward({0.13, 0.13, 0.13}) + lost);
  const double backward = paper_train().backward({0.13, 0.13, 0.13}) - lost / load;
  const auto train = lay_out(*c.design);
  ASSERT_TRUE(train);
  const EfficiencyResult e = efficiency(*train), designed = efficiency(bench_train());
  EXPECT_NEAR(e.forward, forward, 0.003);
  EXPECT_NEAR(e.backward, backward, 0.003);
  EXPECT_GT(designed.forward - forward, 0.03);
  EXPECT_NEAR(e.mesh_forward, paper_train().forward({0.13, 0.13, 0.13}), 0.003);
}

TEST(CalibratedDesign, LeavesNothingToFindOnTheSameDrive) {
  const loop::CalibratedDesign c = calibrated(worn_drive());
  ASSERT_TRUE(c.design);
  const auto train = lay_out(*c.design);
  ASSERT_TRUE(train);
  BenchPlan another_day;
  another_day.seed = 77;
  loop::BenchData data;
  ASSERT_TRUE(loop::read_bench_text("bench.csv", bench_file(paper_train(), worn_drive(), another_day), data)
                  .empty());
  const auto model = loop::drive_model(*train);
  ASSERT_TRUE(model);
  const auto closed = loop::close_drive_loop(*model, data);
  ASSERT_TRUE(closed);
  const auto before = close_hidden(worn_drive(), another_day);
  EXPECT_LT(closed->result.before.rms, 0.25 * before->result.before.rms);
  EXPECT_LT(closed->result.before.rms, 1.3 * before->result.after.rms);
}

TEST(CalibratedDesign, IsADesignFileThatReadsBackTheSame) {
  const loop::CalibratedDesign c = calibrated(worn_drive());
  ASSERT_TRUE(c.design);
  const auto again = read_design_text(design_file_text(*c.design, ""), "calibrated.toml");
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *c.design);
}

TEST(CalibratedDesign, DoesNotCarryWhatIsTheBenchs) {
  HiddenDrive drive;
  drive.output_reads = 1.05;
  const loop::CalibratedDesign c = calibrated(drive);
  EXPECT_FALSE(c.design);
  ASSERT_FALSE(c.notes.empty());
  EXPECT_NE(c.notes.front().find("the bench's"), std::string::npos);
}

}  // namespace
}  // namespace trueflank::test
