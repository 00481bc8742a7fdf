// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/iso_1328.h"

#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/trace_evaluation.h"

// Deviations and classes to ISO 1328-1:2013 against values worked out by hand.
namespace trueflank::test {
namespace {

const loop::Iso1328Row& row_of(const loop::Iso1328& table, const std::string& symbol) {
  for (const auto& row : table.rows)
    if (row.symbol == symbol) return row;
  throw std::runtime_error("no row " + symbol);
}

loop::Iso1328 evaluated(const MadeGear& gear, const std::vector<Process>& processes) {
  InspectionOptions options;
  options.noise_um = 0.0;
  options.points = 200;
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(gear, processes, options));
  return loop::iso_1328(*loop::close_loop(geometry_of(gear), "gear", data, {}));
}

TEST(Iso1328, TolerancesAreThoseOfTheStandard) {
  // m_n 3, d 120, class 6: f_pT = (0.12 + 1.2 + 5) sqrt(2) = 8.94, rounded to halves: 9.0.
  EXPECT_DOUBLE_EQ(loop::iso_1328_tolerance_um(0.001 * 120 + 0.4 * 3 + 5, 6), 9.0);
  // Above 10 to whole, below 5 to tenths.
  EXPECT_DOUBLE_EQ(loop::iso_1328_tolerance_um(10.6, 5), 11.0);
  EXPECT_DOUBLE_EQ(loop::iso_1328_tolerance_um(8.0, 3), 4.0);
  EXPECT_DOUBLE_EQ(loop::iso_1328_tolerance_um(6.8, 4), 4.8);
}

TEST(Iso1328, LimitsOfEveryClassStandBesideTheFigures) {
  MadeGear gear = spur(40);
  gear.module_mm = 3.0;
  gear.face_mm = 25.0;
  gear.tip_mm = gear.reference() + 3.0;
  gear.root_form_mm = ToothProfile::make(design_of(gear))->root_form_radius_mm();
  bool seen = false;
  for (const auto& figure : loop::inspection_figures(evaluated(gear, {}))) {
    if (figure.symbol == "fHam") {
      EXPECT_TRUE(figure.limits_um.empty());  // a mean has no tolerance
    }
    if (figure.symbol != "fHa") continue;
    seen = true;
    ASSERT_EQ(figure.limits_um.size(), 11u);
    EXPECT_DOUBLE_EQ(figure.limits_um[4], 5.5);   // d 120, m 3: 5.32, rounded to halves
    EXPECT_DOUBLE_EQ(figure.limits_um[6], 11.0);  // 10.64, to whole
    EXPECT_DOUBLE_EQ(figure.limits_um[0], 1.3);   // 1.33, to tenths
  }
  EXPECT_TRUE(seen);
}

TEST(Iso1328, BracketsAreThoseOfTheStandard) {
  MadeGear gear = spur(40);
  gear.module_mm = 3.0;
  gear.face_mm = 25.0;
  gear.tip_mm = gear.reference() + 3.0;
  gear.root_form_mm = ToothProfile::make(design_of(gear))->root_form_radius_mm();
  const auto table = evaluated(gear, {});  // d = 120, m = 3, b = 25
  EXPECT_TRUE(table.in_scope);
  EXPECT_NEAR(row_of(table, "fp").bracket_um, 6.32, 1e-9);
  EXPECT_NEAR(row_of(table, "Fp").bracket_um, 0.24 + 0.55 * 10.954451 + 2.1 + 12.0, 1e-6);
  EXPECT_NEAR(row_of(table, "fHa").bracket_um, 5.32, 1e-9);
  EXPECT_NEAR(row_of(table, "ffa").bracket_um, 6.65, 1e-9);
  EXPECT_NEAR(row_of(table, "Fa").bracket_um, 8.51615, 1e-4);  // sqrt(5.32^2 + 6.65^2)
  EXPECT_NEAR(row_of(table, "fHb").bracket_um, 0.05 * 10.954451 + 1.75 + 4.0, 1e-6);
  EXPECT_NEAR(row_of(table, "ffb").bracket_um, 0.07 * 10.954451 + 2.25 + 4.0, 1e-6);
}

TEST(Iso1328, SlopesAndPitchOfAKnownGearAreRead) {
  const MadeGear gear = spur(20);  // d = 20, m = 1, b = 10
  const auto leaning_profile =
      evaluated(gear, {grown([](auto&, const FlankSpot& s, auto&) { return 4.0 * s.u; })});
  // The traces reach over 95 % of the flank; evaluated over 95 % of them from the root on, and over
  // the face less 5 % at each end.
  EXPECT_NEAR(row_of(leaning_profile, "fHa").value_um, 8.0 * 0.95 * 0.95, 0.1);
  EXPECT_NEAR(row_of(leaning_profile, "fHam").value_um, 8.0 * 0.95 * 0.95, 0.1);
  EXPECT_LT(row_of(leaning_profile, "ffa").value_um, 0.2);
  EXPECT_LT(row_of(leaning_profile, "fHb").value_um, 0.2);
  const auto turned = evaluated(gear, {twisted(12)});
  EXPECT_NEAR(std::abs(row_of(turned, "fHb").value_um), 12.0 * 0.9, 0.15);
  // Eccentricity: cumulative pitch on a flank goes up and down by 2 e / cos(alpha) along the
  // circle.
  const auto off = evaluated(gear, {off_centre(10, 0)});
  EXPECT_NEAR(row_of(off, "Fp").value_um, 20.0 / std::cos(gear.pressure_angle_rad), 0.4);
  // Neighbours differ by at most 2 sin(pi / z) of the amplitude.
  EXPECT_NEAR(row_of(off, "fp").value_um,
              2.0 * std::sin(M_PI / 20.0) * 10.0 / std::cos(gear.pressure_angle_rad), 0.1);
}

TEST(Iso1328, GivesTheSmallestClassThatHoldsAndNoneOutOfScope) {
  const MadeGear gear = spur(20);
  const auto table = evaluated(gear, {twisted(12)});
  const auto& row = row_of(table, "fHb");
  ASSERT_GT(row.accuracy_class, 1);
  EXPECT_LE(std::abs(row.value_um),
            loop::iso_1328_tolerance_um(row.bracket_um, row.accuracy_class));
  EXPECT_GT(std::abs(row.value_um),
            loop::iso_1328_tolerance_um(row.bracket_um, row.accuracy_class - 1));
  MadeGear narrow = spur(20);
  narrow.face_mm = 3.0;
  const auto outside = evaluated(narrow, {twisted(12)});
  EXPECT_FALSE(outside.in_scope);
  for (const auto& each : outside.rows) EXPECT_EQ(each.accuracy_class, 0);
}

TEST(Iso1328, SectorPitchAndAdjacentPitchesOfAKnownGear) {
  const MadeGear gear = spur(40);
  const auto table = evaluated(gear, {indexed(1, 10, 0)});
  const double circle = 10.0;  // arc on the reference circle
  EXPECT_NEAR(row_of(table, "Fp").value_um, 2.0 * circle, 0.1);
  EXPECT_NEAR(row_of(table, "Fpz/8").value_um, 2.0 * circle * std::sin(M_PI * 5.0 / 40.0), 0.1);
  EXPECT_NEAR(row_of(table, "fu").value_um, 4.0 * circle * std::pow(std::sin(M_PI / 40.0), 2),
              0.05);
}

TEST(TraceEvaluation, TheFilterPassesHalfOfAWaveOfTheCutOff) {
  std::vector<loop::TracePoint> trace;
  for (int i = 0; i <= 4000; ++i)
    trace.push_back({0.01 * i, std::cos(2.0 * M_PI * 0.01 * i / 0.8)});
  double most = 0.0;
  for (const auto& p : loop::gaussian_filtered(trace, 0.8))
    if (p.at_mm > 5.0 && p.at_mm < 35.0) most = std::max(most, p.deviation_um);
  EXPECT_NEAR(most, 0.5, 0.005);
  // A straight line passes whole, its ends included but for the half of the weights that is missing
  // there.
  for (auto& p : trace) p.deviation_um = 3.0 * p.at_mm;
  const auto line = loop::gaussian_filtered(trace, 0.8);
  for (const auto& p : line) {
    if (p.at_mm > 1.0 && p.at_mm < 39.0) {
      EXPECT_NEAR(p.deviation_um, 3.0 * p.at_mm, 1e-6);
    }
  }
}

TEST(TraceEvaluation, FormIsWhatTheMeanLineLeavesAndMissingTipMaterialIsNone) {
  std::vector<loop::TracePoint> trace;
  for (int i = 0; i <= 1000; ++i) {
    const double x = 0.01 * i;
    // 4 um of slope and a parabola of 3 um over 0 ... 9.5; beyond it 20 um are missing.
    const double t = (x - 4.75) / 4.75;
    trace.push_back({x, x > 9.5 ? -20.0 : 2.0 * t - 3.0 * t * t});
  }
  const auto figures = loop::evaluate_trace(trace, {0.0, 9.5, 10.0});
  EXPECT_NEAR(figures.slope_um, 4.0, 0.01);
  EXPECT_NEAR(figures.crowning_um, 3.0, 0.01);
  EXPECT_NEAR(figures.form_um, 3.0, 0.02);
  for (auto& p : trace)
    if (p.at_mm > 9.7) p.deviation_um = 15.0;
  EXPECT_GT(loop::evaluate_trace(trace, {0.0, 9.5, 10.0}).form_um, 10.0);
}

// Near the base circle even steps of the diameter are wide steps of the roll length.
TEST(TraceEvaluation, UnevenPlacesAreAveragedOverTheirLength) {
  std::vector<loop::TracePoint> uneven, dense;
  for (int i = 0; i <= 240; ++i) {
    const double x = 8.0 * std::sqrt(i / 240.0);  // steps of 0.5 mm to 0.017 mm
    uneven.push_back({x, 6.0 * std::sin(40.0 * x) + x});
  }
  for (std::size_t k = 0; k + 1 < uneven.size(); ++k)
    for (int part = 0; part < 40; ++part) {
      const double share = part / 40.0;
      const auto between = [&](double a, double b) { return a + share * (b - a); };
      dense.push_back({between(uneven[k].at_mm, uneven[k + 1].at_mm),
                       between(uneven[k].deviation_um, uneven[k + 1].deviation_um)});
    }
  dense.push_back(uneven.back());
  const auto few = loop::gaussian_filtered(uneven, 0.27),
             many = loop::gaussian_filtered(dense, 0.27);
  for (std::size_t k = 0; k + 1 < few.size(); ++k)
    EXPECT_NEAR(few[k].deviation_um, many[40 * k].deviation_um, 1e-3) << few[k].at_mm;
}

TEST(Iso1328, ATraceMeasuredAgainIsAnotherTraceOfTheFlank) {
  const MadeGear gear = spur(20);
  InspectionOptions options;
  options.noise_um = 0.0;
  options.points = 200;
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(gear, {twisted(12)}, options));
  const auto once = data.inspections[0].rows;
  for (loop::InspectionRow row : once) {
    if (row.record == loop::RecordKind::kIndex) continue;
    row.deviation_um += 30.0;  // measured anew, from another zero and askew
    if (row.record == loop::RecordKind::kHelix) row.deviation_um += 5.0 * row.z_mm / gear.face_mm;
    data.inspections[0].rows.push_back(row);
  }
  const auto table = loop::iso_1328(*loop::close_loop(geometry_of(gear), "gear", data, {}));
  EXPECT_NEAR(std::abs(row_of(table, "fHb").value_um), 17.0 * 0.9, 0.15);
  EXPECT_LT(row_of(table, "ffb").value_um, 0.2);
  EXPECT_LT(row_of(table, "Fa").value_um, 0.2);
}

}  // namespace
}  // namespace trueflank::test
