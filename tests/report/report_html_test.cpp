// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/report/report_html.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "trueflank/base/contract.h"
#include "trueflank/check/check_gearbox.h"

namespace trueflank::io {
namespace {

GearTrain pair_train(const std::string& name) {
  GearboxDesign design;
  design.name = name;
  design.topology = train_topology("pair");
  design.gears.resize(2);
  design.gears[0].name = "pinion";
  design.gears[0].teeth = 20;
  design.gears[1].name = "wheel";
  design.gears[1].teeth = 31;
  for (GearDesign& gear : design.gears) gear.shift = 0.0;
  return lay_out(design).value();
}

Report report_of(const GearTrain& train) {
  Report report;
  report.train = std::make_shared<const GearTrain>(train);
  report.findings = check_gearbox(train);
  report.efficiency = efficiency(train);
  return report;
}

/// Text of a script element of the page.
std::string script_text(const std::string& page, const std::string& id) {
  const std::string start = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t from = page.find(start) + start.size();
  return page.substr(from, page.find("</script>", from) - from);
}

TEST(ReportHtml, CarriesTheReportWhole) {
  const GearTrain train = pair_train("plain");
  const Report report = report_of(train);
  const std::string page = report_html(report);
  EXPECT_EQ(nlohmann::json::parse(script_text(page, "report-data")),
            nlohmann::json::parse(report_json(report)));
}

TEST(ReportHtml, IsTheSameBytesForTheSameReport) {
  const GearTrain train = pair_train("plain");
  const Report report = report_of(train);
  EXPECT_EQ(report_html(report), report_html(report));
}

TEST(ReportHtml, NeedsNothingFromOutside) {
  const GearTrain train = pair_train("plain");
  const std::string page = report_html(report_of(train));
  EXPECT_EQ(page.find(" src=\"http"), std::string::npos);
  EXPECT_EQ(page.find(" href=\"http"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_LT(page.size(), 2u << 20);
}

TEST(ReportHtml, ModifiedTeethAreDrawnAsTheyAreMade) {
  GearboxDesign design = pair_train("crowned").design;
  design.gears[0].modifications = {.tip_relief_um = 30, .tip_relief_start_diameter_mm = 20.0,
                                   .crowning_um = 50, .edge_chamfer_mm = 0.3};
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto model = nlohmann::json::parse(script_text(report_html(report_of(*train)), "model-data"));
  EXPECT_TRUE(model["gears"][1]["rows"].is_null());
  const auto& rows = model["gears"][0]["rows"];
  ASSERT_GE(rows.size(), 5u);  // ends, chamfers, middle
  const auto reach = [&](const nlohmann::json& tooth) {
    double tip = 0.0;
    for (std::size_t i = 0; i < tooth.size(); i += 2)
      tip = std::max(tip, std::hypot(tooth[i].get<double>(), tooth[i + 1].get<double>()));
    return tip;
  };
  const double tip_mm = train->gears[0].profile.tip_radius_mm();
  EXPECT_NEAR(reach(rows.front()["tooth"]), tip_mm - 0.3, 2e-5);
  EXPECT_NEAR(reach(rows[rows.size() / 2]["tooth"]), tip_mm, 2e-5);
  EXPECT_EQ(rows.back()["z"], train->gears[0].face_width_mm);
  // the drawing of the mesh is that of mid face: relieved there, narrower at the tip than the design
  const auto plain = nlohmann::json::parse(script_text(report_html(report_of(pair_train("plain"))), "model-data"));
  const auto land = [&](const nlohmann::json& tooth) {
    double half = 0.0;
    for (std::size_t i = 0; i < tooth.size(); i += 2)
      if (std::hypot(tooth[i].get<double>(), tooth[i + 1].get<double>()) > tip_mm - 1e-4)
        half = std::max(half, tooth[i + 1].get<double>());
    return half;
  };
  const double turned_mm = 0.030 * tip_mm / base_radius_mm(train->gears[0].profile.gear());
  EXPECT_NEAR(land(plain["gears"][0]["tooth"]) - land(model["gears"][0]["tooth"]), turned_mm, 0.002);
}

TEST(ReportHtml, ANameCannotBreakOutOfThePage) {
  const std::string name = "</script><script>alert(1)</script><!-- \"&";
  const GearTrain train = pair_train(name);
  const std::string page = report_html(report_of(train));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(script_text(page, "report-data"))["design"], name);
  // as many script elements begin as end
  const auto count = [&](const std::string& word) {
    int n = 0;
    for (std::size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("</script>"), 6);  // two documents, four scripts
}

TEST(ReportHtml, DrawsTheTeethAsTheyAre) {
  const GearTrain train = pair_train("plain");
  const auto model = nlohmann::json::parse(script_text(report_html(report_of(train)), "model-data"));
  for (std::size_t i = 0; i < train.gears.size(); ++i) {
    const auto& tooth = model["gears"][i]["tooth"];
    double largest = 0.0, smallest = 1e9;
    for (std::size_t k = 0; k < tooth.size(); k += 2) {
      const double r = std::hypot(tooth[k].get<double>(), tooth[k + 1].get<double>());
      largest = std::max(largest, r);
      smallest = std::min(smallest, r);
    }
    EXPECT_NEAR(largest, train.gears[i].profile.tip_radius_mm(), 2e-5);
    EXPECT_NEAR(smallest, train.gears[i].profile.root_radius_mm(), 2e-5);
  }
}

TEST(ReportHtml, TellsWhatTheToleranceStandardDoesNotCover) {
  GearTrain train = pair_train("plain");
  train.gears[0].face_width_mm = 3.0;
  const auto model = nlohmann::json::parse(script_text(report_html(report_of(train)), "model-data"));
  EXPECT_TRUE(model["gears"][0]["iso1328"]["classes"].empty());
  EXPECT_NE(model["gears"][0]["iso1328"]["scope"].get<std::string>().find("face width"),
            std::string::npos);
  EXPECT_EQ(model["gears"][1]["iso1328"]["classes"].size(), 11u);
}

TEST(ReportHtml, WithoutATrainIsABug) {
  EXPECT_THROW((void)report_html(Report{}), ContractViolation);
}

}  // namespace
}  // namespace trueflank::io
