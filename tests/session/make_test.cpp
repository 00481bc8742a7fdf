// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scratch_folder.h"
#include "trueflank/session/make.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "pair_design.h"
#include "trueflank/session/close_loop.h"
#include "trueflank/session/compare_report.h"

namespace trueflank {
namespace {

namespace fs = std::filesystem;

class MakeParts : public testing::Test {
 protected:
  [[nodiscard]] MakeResult make(const std::string& design, bool allow_failing = false) const {
    const Gearbox gearbox = Gearbox::read_text(design, "pair.toml").value();
    return make_parts(gearbox, {.folder = folder_,
                                .formats = {"stl", "svg"},
                                .tolerance_um = 20.0,
                                .allow_failing = allow_failing})
        .value();
  }
  /// The shifts and centre distance of this design leave no backlash but an overlap.
  static std::string failing() {
    return "format = 1\nname = \"pair\"\n[gearbox]\nkind = \"pair\"\nmodule_mm = 1.0\n"
           "centre_distance_mm = 25.2\n[pinion]\nteeth = 20\nshift = 0.0\nface_width_mm = 3.0\n"
           "[wheel]\nteeth = 31\nshift = 0.0\nface_width_mm = 3.0\n";
  }

  test::ScratchFolder scratch_;
  fs::path folder_ = scratch_ / "made";
};

TEST_F(MakeParts, AStepSchemaThatIsNoneIsRefused) {
  const Errors errors = errors_of(MakeOptions{.folder = folder_, .formats = {"step"}, .step_schema = "ap203"});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].key, "--step-schema");
  EXPECT_EQ(errors[0].value, "ap203");
  EXPECT_TRUE(errors_of(MakeOptions{.folder = folder_, .formats = {"step"}, .step_schema = "ap242"}).empty());
}

TEST_F(MakeParts, WritesEveryFileItReports) {
  const MakeResult made = make(pair_design());
  EXPECT_FALSE(made.failed);
  EXPECT_TRUE(made.written);
  EXPECT_EQ(made.report.files.size(), 6U);
  for (const io::ReportedFile& file : made.report.files)
    EXPECT_EQ(fs::file_size(folder_ / file.path), file.bytes) << file.path;
  EXPECT_TRUE(fs::exists(folder_ / "report.html"));
}

TEST_F(MakeParts, AFailingRunTakesAwayThePartsOfAnEarlierDesign) {
  ASSERT_TRUE(make(pair_design()).written);
  std::ofstream(folder_ / "notes.txt") << "mine";
  std::ofstream(folder_ / "wheel.svg", std::ios::app) << "<!-- drawn on by hand -->";
  const MakeResult failed = make(failing());
  EXPECT_TRUE(failed.failed);
  EXPECT_FALSE(failed.written);
  EXPECT_EQ(failed.removed.size(), 5U);
  EXPECT_FALSE(fs::exists(folder_ / "pinion.stl"));
  EXPECT_FALSE(fs::exists(folder_ / "assembly.svg"));
  EXPECT_TRUE(fs::exists(folder_ / "wheel.svg"));  // changed since: not ours to remove
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "report.json"));
}

TEST_F(MakeParts, AReportFromElsewhereReachesNoFileOutsideItsFolder) {
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "precious.txt") << "12345";
  std::ofstream(folder_ / "out" / "report.json")
      << R"({"format": "trueflank-report", "files": [{"path": "../precious.txt", "bytes": 5}, 7,)"
      << R"({"path": 3}, {"path": "x", "bytes": -1}]})";
  const Gearbox gearbox = Gearbox::read_text(failing(), "pair.toml").value();
  const auto made = make_parts(gearbox, {.folder = folder_ / "out", .formats = {"stl"}});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->removed.empty());
  EXPECT_TRUE(fs::exists(folder_ / "precious.txt"));
}

TEST_F(MakeParts, ToldWrongOptionsItReportsAllAndWritesNothing) {
  const Gearbox gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  const auto made = make_parts(gearbox, {.folder = folder_, .formats = {"stp"}, .tolerance_um = 0.0});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().size(), 2U);
  EXPECT_FALSE(fs::exists(folder_));
}

// 32 bits hold a radius of 16 mm to a nanometre: no facets however fine keep a tolerance of one.
TEST_F(MakeParts, ATolerancePastTheFormatIsAFailedCheckAndLeavesNoPart) {
  const Gearbox gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  MakeOptions options{
      .folder = folder_, .formats = {"stl"}, .tolerance_um = 0.001, .part = "pinion"};
  const auto made = make_parts(gearbox, options);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->failed);
  EXPECT_FALSE(made->written);
  EXPECT_FALSE(fs::exists(folder_ / "pinion.stl"));
  EXPECT_TRUE(made->report.files.empty());
  const Finding& missed = made->report.findings.back();
  EXPECT_EQ(missed.id, "accuracy");
  EXPECT_EQ(missed.where, "pinion");
  EXPECT_EQ(missed.status, CheckStatus::kFail);
  EXPECT_GT(missed.value, 0.001);
  EXPECT_EQ(missed.limit, 0.001);
  std::ifstream report(folder_ / "report.json");
  const std::string text{std::istreambuf_iterator<char>(report), {}};
  EXPECT_NE(text.find("\"accuracy\""), std::string::npos);
  EXPECT_NE(text.find("\"verdict\": \"fail\""), std::string::npos);

  options.allow_failing = true;
  const auto kept = make_parts(gearbox, options);
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->failed);
  ASSERT_EQ(kept->report.files.size(), 1U);
  EXPECT_EQ(kept->report.files.front().accuracy_um, kept->report.findings.back().value);
  EXPECT_TRUE(fs::exists(folder_ / "pinion.stl"));

  options.formats = {"ply"};  // of doubles
  const auto fine = make_parts(gearbox, options);
  ASSERT_TRUE(fine);
  EXPECT_FALSE(fine->failed);
  EXPECT_LE(fine->report.files.front().accuracy_um, 0.001);
}

TEST_F(MakeParts, FilesOfOneDesignCompareAsTheSameAndOfAnotherAsDifferent) {
  ASSERT_TRUE(make(pair_design()).written);
  const std::string sun = (folder_ / "pinion.stl").string(), wheel = (folder_ / "wheel.stl").string();
  const auto same = compare_files(sun, sun);
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->comparison.same);
  EXPECT_FALSE(same->difference);
  const auto other = compare_files(sun, wheel, {.tolerance_um = 5.0});
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->comparison.same);
  EXPECT_NE(comparison_json(*other).find("\"same\": false"), std::string::npos);
  EXPECT_EQ(compare_files(sun, sun, {.tolerance_um = -1.0}).error().front().key, "--tolerance-um");
  EXPECT_EQ(compare_files("no.stl", "none.stl").error().size(), 2U);
}

TEST_F(MakeParts, ALoopIsClosedAndWritten) {
  fs::create_directories(folder_);
  const std::string file = (folder_ / "inspection.csv").string();
  {
    std::ofstream rows(file);
    rows << "# zero = common\nrecord,tooth,flank,diameter_mm,z_mm,deviation_um\n";
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> noise_um(-2.0, 2.0);
    for (int tooth = 1; tooth <= 20; ++tooth)
      for (const char* flank : {"left", "right"})
        for (const double z_mm : {0.5, 2.5})
          rows << "index," << tooth << ',' << flank << ",20.0," << z_mm << ',' << noise_um(random) << '\n';
  }
  const Gearbox gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  const auto closed = close_loop(gearbox, {file}, {.gear = "pinion"});
  ASSERT_TRUE(closed) << closed.error().front().message;
  EXPECT_EQ(closed->residuals_before().size(), static_cast<std::size_t>(closed->result().observations));
  ASSERT_TRUE(write_loop(*closed, folder_ / "loop"));
  EXPECT_TRUE(fs::exists(folder_ / "loop" / "loop.json"));
  EXPECT_FALSE(fs::exists(folder_ / "loop" / "calibrated.toml"));
  const auto which = close_loop(gearbox, {file});
  ASSERT_FALSE(which);
  EXPECT_EQ(which.error().front().key, "--gear");
}

}  // namespace
}  // namespace trueflank
