// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/gearbox.h"

#include <gtest/gtest.h>

#include <optional>

#include "pair_design.h"
#include "trueflank/session/evaluate.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {
namespace {

TEST(Gearbox, PartsAndReportOutliveIt) {
  std::optional<Gearbox> gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  const PartMesh before = part_mesh(gearbox->parts()->parts.front(), {.tolerance_mm = 0.01});
  const PartShapes parts = *gearbox->parts();
  const io::Report report = evaluate(*gearbox);
  const std::weak_ptr<const GearTrain> train = gearbox->shared_train();
  gearbox.reset();
  ASSERT_FALSE(train.expired());
  EXPECT_EQ(part_mesh(parts.parts.front(), {.tolerance_mm = 0.01}).mesh.vertices, before.mesh.vertices);
  EXPECT_NE(io::report_json(report).find("\"pinion\""), std::string::npos);
}

TEST(Gearbox, PartsAloneKeepTheTrain) {
  std::optional<Gearbox> gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  std::optional<PartShapes> parts = *gearbox->parts();
  const std::weak_ptr<const GearTrain> train = gearbox->shared_train();
  gearbox.reset();
  EXPECT_FALSE(train.expired());
  parts.reset();
  EXPECT_TRUE(train.expired());
}

TEST(Gearbox, CopiesShareTheirParts) {
  const Gearbox first = Gearbox::read_text(pair_design(), "pair.toml").value();
  const Gearbox second = first;
  EXPECT_EQ(&first.parts(), &second.parts());
  EXPECT_EQ(first.shared_train(), second.shared_train());
}

TEST(Gearbox, TellsFileAndLineOfAPartThatCannotBeMade) {
  const auto gearbox =
      Gearbox::read_text(pair_design(31) + "bore_mm = 60.0\n", "pair.toml");
  ASSERT_TRUE(gearbox) << gearbox.error().front().message;
  ASSERT_FALSE(gearbox->parts());
  const Error& error = gearbox->parts().error().front();
  EXPECT_EQ(error.file, "pair.toml");
  EXPECT_EQ(error.line, 13) << error.key;
}

TEST(Gearbox, NamesItsGearsWhereOneIsMissing) {
  const Gearbox gearbox = Gearbox::read_text(pair_design(), "pair.toml").value();
  EXPECT_EQ((*gearbox.gear("wheel"))->name, "wheel");
  ASSERT_FALSE(gearbox.gear("sun"));
  EXPECT_EQ(gearbox.gear("sun").error().remedy, "pinion, wheel");
  EXPECT_FALSE(gearbox.gear(""));
}

TEST(Gearbox, RefusesAnUnknownProcessAndAKerfThatCannotBe) {
  const auto process = Gearbox::read_text(pair_design(), "pair.toml", {.process = "magic", .kerf_mm = {}});
  ASSERT_FALSE(process);
  EXPECT_EQ(process.error().front().key, "--process");
  const auto kerf = Gearbox::read_text(pair_design(), "pair.toml", {.process = {}, .kerf_mm = -1.0});
  ASSERT_FALSE(kerf);
  EXPECT_EQ(kerf.error().front().value, "-1");
}

}  // namespace
}  // namespace trueflank
