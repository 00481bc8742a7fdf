// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scratch_folder.h"
#include "trueflank/session/job_size.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "pair_design.h"
#include "trueflank/session/make.h"

namespace trueflank {
namespace {

Gearbox long_and_fine() {
  return Gearbox::read_text(
             "format = 1\nname = \"long\"\n[gearbox]\nkind = \"gear\"\nmodule_mm = 0.05\n"
             "helix_angle_deg = 20\n[gear]\nteeth = 24\nface_width_mm = 2000\n",
             "long.toml")
      .value();
}

TEST(JobSize, OfAnOrdinaryPairIsSmallAndNothingIsSaid) {
  const Gearbox gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  const PartShapes& shapes = gearbox.parts().value();
  using enum io::FileFormat;
  const JobSize size = job_size(shapes, {kStl, k3mf}, "", 1e-3);
  EXPECT_GT(size.facets, 2000.0);
  EXPECT_LT(size.facets, 100'000.0);
  EXPECT_GT(size.file_bytes, 50.0 * size.facets);  // with the assembly
  EXPECT_TRUE(job_size_errors(shapes, {kStl, k3mf}, "", 1e-3).empty());
  EXPECT_EQ(job_size(shapes, {kStep, kSvg}, "", 1e-6).facets, 0.0);
  EXPECT_LT(job_size(shapes, {kStl}, "pinion", 1e-3).facets, size.facets);
}

TEST(JobSize, WhatIsTooLargeIsRefusedBeforeItBeginsAndTheToleranceThatDoesIsNamed) {
  const Gearbox gearbox = long_and_fine();
  const test::ScratchFolder scratch;
  const auto folder = scratch / "made";
  const auto made =
      make_parts(gearbox, {.folder = folder, .formats = {"stl"}, .tolerance_um = 0.05});
  ASSERT_FALSE(made);
  const Error& error = made.error().front();
  EXPECT_EQ(exit_code(error.code), 2);
  EXPECT_EQ(error.key, "--tolerance-um");
  EXPECT_FALSE(std::filesystem::exists(folder));
  const double would_do_um = std::stod(error.remedy);
  EXPECT_GT(would_do_um, 0.05);
  EXPECT_TRUE(
      job_size_errors(gearbox.parts().value(), {io::FileFormat::kStl}, "", mm_from_um(would_do_um))
          .empty());
}

TEST(JobSize, WhereNoToleranceDoesThatIsSaid) {
  const Gearbox gearbox = Gearbox::read_text(
                              "format = 1\nname = \"l\"\n[gearbox]\nkind = \"gear\"\nmodule_mm = "
                              "0.01\nhelix_angle_deg = 59\n"
                              "[gear]\nteeth = 300\nface_width_mm = 2000\n",
                              "long.toml")
                              .value();
  const Errors errors = job_size_errors(gearbox.parts().value(), {io::FileFormat::kStl}, "", 1e-3);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NE(errors.front().remedy.find("no tolerance"), std::string::npos) << errors.front().remedy;
}

}  // namespace
}  // namespace trueflank
