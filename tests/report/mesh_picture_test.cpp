// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/mesh_picture.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/check/check_designs.h"

namespace trueflank::test {
namespace {

std::string picture(const GearboxDesign& design, std::size_t mesh) {
  const GearTrain train = laid_out(design);
  const GearPair pair = train.pair(train.meshes[mesh]);
  return mesh_picture_svg(pair, mesh_clearance(pair), {.name1 = "sun <a> & b"});
}

TEST(MeshPicture, IsTheSameEveryTimeAndEscapesNames) {
  const std::string svg = picture(paper_design(0.05), 0);
  EXPECT_EQ(svg, picture(paper_design(0.05), 0));
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("sun &lt;a&gt; &amp; b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("nothing"), std::string::npos);
}

TEST(MeshPicture, NamesPenetrationAndClearance) {
  EXPECT_NE(picture(simple_design(12, 30, 72, 3), 1).find("penetration 9.42 um"), std::string::npos);
  EXPECT_NE(picture(paper_design(0.05), 0).find("smallest clearance 23.33 um"), std::string::npos);
}

}  // namespace
}  // namespace trueflank::test
