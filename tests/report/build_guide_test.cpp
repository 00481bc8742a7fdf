// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/build_html.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "trueflank/design/design_file.h"
#include "trueflank/export/xml_text.h"

namespace trueflank::io {
namespace {

struct Guided {
  Guided() {
    const auto file = read_design_file(std::string(TRUEFLANK_SOURCE_DIR) +
                                       "/examples/printed_actuator/design.toml");
    EXPECT_TRUE(file.has_value());
    train = std::make_unique<const GearTrain>(*lay_out(file->design));
    shapes = *part_shapes(*train);
    order = assembly_order(*train, shapes);
    guide = build_guide(*train, shapes, order);
    bill = bill_of_materials(shapes, [](const PartShape&) { return PartMaterial{"PLA", 1240.0}; });
  }
  std::unique_ptr<const GearTrain> train;
  PartShapes shapes;
  AssemblyOrder order;
  BuildGuide guide;
  BillOfMaterials bill;
};

TEST(BuildGuide, TakesEveryLineOfTheBillInItsCount) {
  const Guided g;
  std::map<std::string, int> taken;
  for (const GuideSection& section : g.guide.sections)
    for (const GuideStep& step : section.steps)
      for (const GuideNeed& need : step.needs) taken[need.name] += need.count * section.copies;
  for (const BillLine& line : g.bill) {
    const std::string& name = line.designation.empty() ? line.part : line.designation;
    EXPECT_EQ(taken[name], line.count) << name;
    taken.erase(name);
  }
  // what is left was put together in an earlier section
  for (const auto& [name, count] : taken)
    EXPECT_NE(name.find(", as put together"), std::string::npos) << name;
}

TEST(BuildGuide, SaysWhereTheHolesOfCompoundPlanetsStand) {
  const Guided g;
  std::string line;
  for (const GuideSection& section : g.guide.sections)
    for (const GuideStep& step : section.steps)
      for (const std::string& text : step.lines)
        if (text.find("small hole in its face") != std::string::npos) line = text;
  ASSERT_FALSE(line.empty());
  // the hole is on +x of the planet; its angle against the line outwards through the planet
  for (const Placement& body : g.shapes.assembly) {
    if (!body.name.starts_with("planet ")) continue;
    const double outwards = std::atan2(body.translation_mm[1], body.translation_mm[0]);
    const double angle = std::remainder(body.rotation_rad - outwards, 2.0 * 3.14159265358979323846);
    const std::string told = " deg (" + body.name + ")";
    const auto end = line.find(told);
    ASSERT_NE(end, std::string::npos) << line;
    const auto begin = line.rfind(' ', end - 1) + 1;
    const double degrees = std::stod(line.substr(begin, end - begin));
    EXPECT_NEAR(std::remainder(degrees - angle * 180.0 / 3.14159265358979323846, 360.0), 0.0, 0.051)
        << body.name;
  }
}

TEST(BuildGuide, StandsInTheOrderThatWasProved) {
  const Guided g;
  ASSERT_FALSE(g.guide.sections.empty());
  EXPECT_EQ(g.guide.sections.back().title, "The gearbox");
  // a section's steps, one after the other, are those of its unit
  for (const GuideSection& section : g.guide.sections) {
    std::vector<std::size_t> done = section.steps.front().there;
    for (const GuideStep& step : section.steps) {
      EXPECT_EQ(step.there, done) << step.title;
      done.insert(done.end(), step.added.begin(), step.added.end());
    }
    const auto same = [&](const AssemblyUnit& unit) {
      std::vector<std::size_t> bodies;
      for (const AssemblyStep& step : unit.steps)
        bodies.insert(bodies.end(), step.bodies.begin(), step.bodies.end());
      return bodies == done;
    };
    EXPECT_TRUE(std::any_of(g.order.units.begin(), g.order.units.end(), same)) << section.title;
  }
}

TEST(BuildGuide, ThePageHasAPictureAStepAndNoLinkOutside) {
  const Guided g;
  const std::string html = build_html(*g.train, g.shapes, g.guide, g.bill);
  std::size_t steps = 0, pictures = 0;
  for (const GuideSection& section : g.guide.sections) steps += section.steps.size();
  for (std::size_t at = html.find("data:image/png;base64,iVBOR"); at != std::string::npos;
       at = html.find("data:image/png;base64,iVBOR", at + 1))
    ++pictures;
  EXPECT_GT(steps, 15U);
  EXPECT_EQ(pictures, steps + 1);
  // (the pictures' own letters may spell "http", but never a colon)
  for (const char* link : {"http:", "https:", "://", "href"})
    EXPECT_EQ(html.find(link), std::string::npos) << link;
  EXPECT_NE(html.find("break-inside:avoid"), std::string::npos);
  for (const BillLine& line : g.bill)
    EXPECT_NE(html.find(xml_escaped(line.designation.empty() ? line.part : line.designation)),
              std::string::npos);
}

}  // namespace
}  // namespace trueflank::io
