// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/loop/drawn_bench.h"
#include "tests/loop/sample_bench.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/loop/drive/bench_table.h"

namespace trueflank::test {
namespace {

using testing::HasSubstr;

/// A clean bench file's lines, the header first.
std::vector<std::string> clean_lines() {
  const std::string text = bench_file(paper_train(), {}, {});
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}
std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}
/// One row with its torques times factors.
std::string scaled(const std::string& line, double input, double output) {
  char direction[20];
  double rpm = 0, in = 0, out = 0;
  std::sscanf(line.c_str(), "%19[^,],%lf,%lf,%lf", direction, &rpm, &in, &out);
  char text[120];
  std::snprintf(text, sizeof text, "%s,%g,%.9g,%.9g", direction, rpm, in * input, out * output);
  return text;
}
template <class Change>
std::string changed(const Change& change) {
  std::vector<std::string> lines = clean_lines();
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i] = change(lines[i], i);
  return joined(lines);
}
Error first_error(const std::string& text) {
  const auto closed = close_bench_text(text);
  EXPECT_FALSE(closed);
  return closed ? Error{} : closed.error().front();
}

TEST(BenchFile, AnotherUnitInTheHeaderIsRefusedByName) {
  std::vector<std::string> lines = clean_lines();
  lines[0] = "direction,input_speed_rpm,input_torque_mnm,output_torque_nm";
  const Error error = first_error(joined(lines));
  EXPECT_EQ(error.key, "input_torque_mnm");
  EXPECT_EQ(error.line, 1);
  EXPECT_THAT(error.remedy, HasSubstr("input_torque_nm"));
}

TEST(BenchFile, AUnitInAFieldIsRefused) {
  std::vector<std::string> lines = clean_lines();
  lines[7] = "forward,900,120 mNm,10.1";
  const Error error = first_error(joined(lines));
  EXPECT_EQ(error.line, 8);
  EXPECT_THAT(error.message, HasSubstr("unit"));
}

TEST(BenchFile, MilliNewtonMetresInAColumnAreRefused) {
  const Error error =
      first_error(changed([](const std::string& l, std::size_t) { return scaled(l, 1000.0, 1.0); }));
  EXPECT_THAT(error.message, HasSubstr("another unit"));
  EXPECT_EQ(error.file, "bench.csv");
}

TEST(BenchFile, MixedUnitsAreRefusedAndTheLineNamed) {
  std::vector<std::string> lines = clean_lines();
  std::size_t at = 0;
  for (std::size_t i = 1; i < lines.size() && at == 0; ++i) {
    double in = 0.0;
    double rpm = 0.0;
    std::sscanf(lines[i].c_str(), "forward,%lf,%lf", &rpm, &in);
    if (in > 0.15) at = i;
  }
  ASSERT_GT(at, 0u);
  lines[at] = scaled(lines[at], 1000.0, 1.0);
  const Error error = first_error(joined(lines));
  EXPECT_THAT(error.message, HasSubstr("mixed units"));
  EXPECT_EQ(error.line, static_cast<int>(at) + 1);
}

TEST(BenchFile, ARowOfTheOtherSignIsLeftOutAndNamed) {
  std::vector<std::string> lines = clean_lines();
  lines[9] = scaled(lines[9], 1.0, -1.0);
  loop::BenchData data;
  ASSERT_TRUE(loop::read_bench_text("bench.csv", joined(lines), data).empty());
  const std::size_t rows = data.rows.size();
  std::vector<std::string> notes;
  ASSERT_TRUE(loop::settle_signs(data, notes).empty());
  EXPECT_EQ(data.rows.size(), rows - 1);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes.front(), HasSubstr("bench.csv:10: left out: output_torque_nm of -"));
}

TEST(BenchFile, SignsThatChangeInsideADirectionAreRefused) {
  const Error error = first_error(changed([](const std::string& l, std::size_t i) {
    return i % 7 == 0 ? scaled(l, 1.0, -1.0) : l;
  }));
  EXPECT_THAT(error.message, HasSubstr("changes its sign"));
  EXPECT_EQ(error.key, "output_torque_nm");
}

TEST(BenchFile, ASensorsMinusIsTakenAsItsConventionAndTold) {
  const auto closed = close_bench_text(
      changed([](const std::string& l, std::size_t) { return scaled(l, 1.0, -1.0); }));
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect);
  EXPECT_THAT(loop::loop_text(closed->result), HasSubstr("sign convention"));
}

TEST(BenchFile, PowerThatComesFromNothingIsToldInNewtonMetresAndNotAsARatio) {
  std::vector<loop::BenchPoint> points(7);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].forward = true;
    points[i].unit = static_cast<int>(i);
    points[i].load_nm = points[i].driven_nm = 5.0 + 0.02 * static_cast<double>(i);
  }
  points.back().load_nm = 100.0;  // (the others are low loads)
  EXPECT_THAT(
      loop::power_gained(points, 4.0, {}).text,
      testing::StartsWith(
          "forward, at low load 5.05 (+-0.031) N m come out where next to nothing goes in"));
  for (loop::BenchPoint& point : points) point.driving_nm = 0.25;
  EXPECT_THAT(
      loop::power_gained(points, 4.0, {}).text,
      testing::StartsWith("forward, the apparent efficiency at low load is 5.050 (+-0.031)"));
}

TEST(BenchFile, SwappedColumnsAreNamedAndPutRight) {
  const auto closed = close_bench_text(changed([](const std::string& l, std::size_t) {
    char direction[20], rpm[20], in[20], out[20];
    std::sscanf(l.c_str(), "%19[^,],%19[^,],%19[^,],%19s", direction, rpm, in, out);
    return std::string(direction) + "," + rpm + "," + out + "," + in;
  }));
  ASSERT_TRUE(closed);
  ASSERT_FALSE(closed->result.effects.empty());
  EXPECT_EQ(closed->result.effects.front().id, "swapped_side");
  EXPECT_EQ(closed->result.effects.size(), 1u);
}

TEST(BenchFile, SwappedDirectionsAreNamedAndPutRight) {
  const auto closed = close_bench_text(changed([](const std::string& l, std::size_t) {
    return l.starts_with("forward") ? "backward" + l.substr(7) : "forward" + l.substr(8);
  }));
  ASSERT_TRUE(closed);
  ASSERT_EQ(closed->result.effects.size(), 1u) << loop::loop_text(closed->result);
  EXPECT_EQ(closed->result.effects.front().id, "swapped_side");
  EXPECT_THAT(closed->result.effects.front().description, HasSubstr("forward and backward"));
}

TEST(BenchFile, ASensorThatReadsMoreInEitherSenseIsNoSwappedDirection) {
  struct Row {
    char direction[20];
    double rpm = 0.0, in = 0.0, out = 0.0;
    explicit Row(const std::string& l) {
      std::sscanf(l.c_str(), "%19[^,],%lf,%lf,%lf", direction, &rpm, &in, &out);
    }
  };
  std::vector<std::string> lines = clean_lines();
  double most_lost_nm = 0.0;  // at the output
  for (std::size_t i = 1; i < lines.size(); ++i)
    most_lost_nm = std::max(most_lost_nm, std::abs(bench_model().ratio * Row(lines[i]).in - Row(lines[i]).out));
  const auto closed = close_bench_text(changed([&](const std::string& l, std::size_t) {
    const Row row(l);
    const double more = (l.starts_with("forward") ? 1.2 : -1.2) * most_lost_nm;
    char text[120];
    std::snprintf(text, sizeof text, "%s,%g,%.9g,%.9g", row.direction, row.rpm, row.in, row.out + more);
    return row.out + more > 0.0 ? std::string(text) : l;
  }));
  ASSERT_TRUE(closed);
  for (const auto& effect : closed->result.effects) EXPECT_NE(effect.id, "swapped_side");
  EXPECT_EQ(closed->result.verdict, loop::Verdict::kExplained);
  EXPECT_THAT(loop::loop_text(closed->result),
              HasSubstr("with what the sensors read wrong taken off"));
}

TEST(BenchFile, BadRowsAreLeftOutAndTold) {
  std::vector<std::string> lines = clean_lines();
  lines[3] = "sideways,100,0.1,8";
  lines[5] = "forward,100,,8";
  const auto closed = close_bench_text(joined(lines));
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->result.observations, static_cast<int>(lines.size()) - 3);
  const std::string text = loop::loop_text(closed->result);
  EXPECT_THAT(text, HasSubstr("bench.csv:4: left out: direction \"sideways\""));
  EXPECT_THAT(text, HasSubstr("bench.csv:6: left out"));
}

TEST(BenchTable, RowsFarOffThatComeAgainAtOneSetPointAreNoSlips) {
  // One set point of 36 loses more whenever it is run: three rows in a hundred, none beside another.
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const loop::DriveModel& model = bench_model();
  const loop::EfficiencyCurve curve(model);
  for (const bool every_time : {true, false}) {
    loop::BenchData data;
    data.files = {"bench.csv"};
    for (int pass = 0; pass < 6; ++pass)
      for (int n = 0; n < 6; ++n)
        for (int t = 0; t < 6; ++t) {
          loop::BenchRow row;
          row.speed_rpm = 200.0 * (n + 1);
          row.input_nm = 0.04 * (t + 1);
          row.line = static_cast<int>(data.rows.size()) + 2;
          const bool odd = every_time ? n == 2 && t == 3 : pass == 2 && n == 2 && t == 3;
          row.output_nm = model.ratio * curve.at(true, model.friction) * row.input_nm +
                          0.02 * normal(random) - (odd ? 1.0 : 0.0);
          data.rows.push_back(row);
        }
    const auto table = loop::make_bench_table(model, data);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->outliers, every_time ? 0 : 1);
  }
}

TEST(BenchTable, ARowBeforeIsTheOneThatWasTakenBeforeThoughAnotherWasLeftOut) {
  DrawnBench bench = any_rows(3, true);
  loop::BenchData data = bench.data([](const DrawnRow&) { return 0.0; });
  data.rows[40].output_nm *= 1.5;
  const auto table = loop::make_bench_table(bench.model(), data);
  ASSERT_TRUE(table);
  ASSERT_EQ(table->outliers, 1);
  int without = 0;
  for (const loop::BenchPoint& p : table->points) {
    const loop::BenchPoint* const before = table->row_before(p);
    if (before == nullptr)
      ++without;
    else
      ASSERT_EQ(before->row, p.row - 1) << p.line;
  }
  EXPECT_EQ(without, 2);  // the first one, and the one after the slip
}

TEST(BenchTable, FewRowsWithoutATemperatureHaveItFromTheRowsBeside) {
  DrawnBench bench = any_rows(5, false, 100);
  bench.any_warmth();
  loop::BenchData data = bench.data([](const DrawnRow&) { return 0.0; });
  const double before = data.rows[40].temperature_c, after = data.rows[43].temperature_c;
  for (const std::size_t row : {std::size_t{0}, std::size_t{41}, std::size_t{42}})
    data.rows[row].temperature_c = std::nan("");
  const auto table = loop::make_bench_table(bench.model(), data);
  ASSERT_TRUE(table);
  ASSERT_EQ(table->outliers, 0);
  EXPECT_TRUE(table->has_temperature);
  EXPECT_EQ(table->points[0].temperature_c, data.rows[1].temperature_c);
  EXPECT_NEAR(table->points[41].temperature_c, before + (after - before) / 3.0, 1e-9);
  EXPECT_NEAR(table->points[42].temperature_c, before + (after - before) / 1.5, 1e-9);
  EXPECT_THAT(table->notes, testing::Contains(HasSubstr("3 rows have no temperature")));
}

TEST(BenchTable, ManyRowsWithoutATemperatureLeaveTheBenchWithoutOne) {
  DrawnBench bench = any_rows(6, false, 100);
  bench.any_warmth();
  loop::BenchData data = bench.data([](const DrawnRow&) { return 0.0; });
  for (std::size_t row = 0; row < 20; ++row) data.rows[4 * row].temperature_c = std::nan("");
  const auto table = loop::make_bench_table(bench.model(), data);
  ASSERT_TRUE(table);
  EXPECT_FALSE(table->has_temperature);
}

TEST(BenchTable, ARowThatWasTakenOutOfATableStillFindsTheRowBefore) {
  DrawnBench bench = any_rows(4, true);
  const auto table =
      loop::make_bench_table(bench.model(), bench.data([](const DrawnRow&) { return 0.0; }));
  ASSERT_TRUE(table);
  loop::BenchTable some = loop::without_rows(*table);
  EXPECT_TRUE(some.points.empty());
  const loop::BenchPoint& last = table->points.back();
  some.points.push_back(last);
  loop::BenchTable of_some = loop::without_rows(some);
  of_some.points.push_back(last);
  for (const loop::BenchTable* one : {&some, &of_some}) {
    const loop::BenchPoint* const before = one->row_before(one->points.front());
    ASSERT_NE(before, nullptr);
    EXPECT_EQ(before->row, last.row - 1);
  }
}

TEST(BenchFile, OutliersAreLeftOutByFileAndLine) {
  std::vector<std::string> lines = clean_lines();
  lines[20] = scaled(lines[20], lines[20].starts_with("backward") ? 1.3 : 1.0,
                     lines[20].starts_with("forward") ? 1.3 : 1.0);
  lines[20] = scaled(lines[20], 1.0, 1.0);
  const auto closed = close_bench_text(joined(lines));
  ASSERT_TRUE(closed);
  const std::string text = loop::loop_text(closed->result);
  EXPECT_EQ(closed->result.outliers, 1) << lines[20] << "\n" << text;
  EXPECT_THAT(text, HasSubstr("bench.csv:21: outlier"));
  EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect);
}

TEST(BenchFile, EfficienciesInPerCentAreRefused) {
  const Error error = first_error("quantity,value\nforward_efficiency,89.0\n");
  EXPECT_THAT(error.message, HasSubstr("per cent"));
  EXPECT_EQ(error.line, 2);
}

TEST(BenchFile, TooFewRowsAreRefused) {
  std::vector<std::string> lines = clean_lines();
  lines.resize(6);
  EXPECT_THAT(first_error(joined(lines)).message, HasSubstr("5 usable rows"));
}

TEST(BenchFile, RowsWithoutAnyTorqueAreRefused) {
  std::string text = "direction,input_speed_rpm,input_torque_nm,output_torque_nm\n";
  for (int row = 0; row < 20; ++row) text += "forward," + std::to_string(100 + row) + ",0,0\n";
  EXPECT_THAT(first_error(text).message, HasSubstr("a torque of 0"));
}

TEST(BenchFile, ASideThatNeverHasATorqueIsRefusedByItsColumn) {
  // (such rows ended in a crash; so did torques too small to be squared)
  for (const char* direction : {"forward", "backward"})
    for (const int side : {0, 1})
      for (const double factor : {0.0, 1e-200}) {
        const std::string text = changed([&](const std::string& l, std::size_t) {
          return l.starts_with(direction)
                     ? scaled(l, side == 0 ? factor : 1.0, side == 1 ? factor : 1.0)
                     : l;
        });
        const Error error = first_error(text);
        EXPECT_EQ(error.key, side == 0 ? "input_torque_nm" : "output_torque_nm");
        EXPECT_THAT(error.message,
                    HasSubstr(std::string("every ") + direction + " row says a torque of 0"));
      }
}

TEST(BenchFile, ValuesThatNoBenchHasAreLeftOutByRow) {
  const std::string header = clean_lines().front() + ",temperature_c,input_angle_deg,sigma_nm";
  const auto with = [&](const std::string& row) {
    std::vector<std::string> lines = clean_lines();
    for (std::string& line : lines) line += ",25,0,0.02";
    lines.front() = header;
    lines[7] = row;
    return joined(lines);
  };
  for (const auto& [row, column] : std::vector<std::pair<std::string, std::string>>{
           {"forward,1e308,0.1,8,25,0,0.02", "input_speed_rpm of 1e+308"},
           {"forward,900,1e30,8,25,0,0.02", "input_torque_nm of 1e+30"},
           {"forward,900,0.1,-1e308,25,0,0.02", "output_torque_nm of -1e+308"},
           {"forward,900,0.1,8,1e308,0,0.02", "temperature_c of 1e+308"},
           {"forward,900,0.1,8,25,1e300,0.02", "input_angle_deg of 1e+300"},
           {"forward,900,0.1,8,25,0,1e-300", "sigma_nm of 1e-300"}}) {
    const auto closed = close_bench_text(with(row));
    ASSERT_TRUE(closed);
    const std::string text = loop::loop_text(closed->result);
    EXPECT_THAT(text, HasSubstr("bench.csv:8: left out: " + column));
    EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect) << text;
  }
}

TEST(BenchFile, ASingleGearHasNoBench) {
  GearboxDesign design{.name = "single", .topology = train_topology("gear")};
  design.gears = {{.name = "gear", .teeth = 20}};
  const auto gear = lay_out(design);
  ASSERT_TRUE(gear);
  const auto model = loop::drive_model(*gear);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().key, "gearbox.kind");
}

/// Every reading in steps of twice the noise: all rows of a set point share the rounding of what drives.
std::string coarse_bench(const HiddenDrive& drive, std::uint64_t seed) {
  BenchPlan plan;
  plan.noise_driving = 0.0;
  plan.repeats = 8;
  plan.seed = seed;
  std::string text, line;
  std::istringstream lines(bench_file(paper_train(), drive, plan));
  std::getline(lines, line);
  text = line + "\n";
  while (std::getline(lines, line)) {
    char direction[20], row[120];
    double rpm = 0, in = 0, out = 0;
    std::sscanf(line.c_str(), "%19[^,],%lf,%lf,%lf", direction, &rpm, &in, &out);
    std::snprintf(row, sizeof row, "%s,%.9g,%.9g,%.9g\n", direction, rpm,
                  0.001 * std::round(in / 0.001), 0.1 * std::round(out / 0.1));
    text += row;
  }
  return text;
}

TEST(CoarseReadings, OfSetTorquesAreNoLoss) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto closed = close_bench_text(coarse_bench({}, seed));
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->result.verdict, loop::Verdict::kNoEffect)
        << seed << ": " << closed->result.structure_left;
  }
}

TEST(CoarseReadings, DoNotTurnAFrictionIntoACourseOverTheLoad) {
  HiddenDrive drive;
  drive.friction = [](auto&, int) { return 0.14; };
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto closed = close_bench_text(coarse_bench(drive, seed));
    ASSERT_TRUE(closed);
    ASSERT_EQ(closed->result.effects.size(), 1U);
    EXPECT_EQ(closed->result.effects[0].id, "friction_coefficient")
        << seed << ": " << closed->result.effects[0].description;
  }
}

}  // namespace
}  // namespace trueflank::test
