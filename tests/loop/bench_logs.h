// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/bench_table.h"

// Logs of real benches, turned into the loop's tables. The logs stand outside the repository: of most the
// licence is not stated.
namespace trueflank::test {

/// The folder of real data: TRUEFLANK_SHARED_DATA, else shared/data beside the repository.
inline std::optional<std::filesystem::path> shared_data(const std::string& folder) {
  std::vector<std::filesystem::path> places;
  if (const char* given = std::getenv("TRUEFLANK_SHARED_DATA")) places.emplace_back(given);
  const std::filesystem::path source(TRUEFLANK_SOURCE_DIR);
  places.push_back(source.parent_path() / "shared" / "data");
  places.push_back(source.parent_path().parent_path() / "shared" / "data");
  for (const auto& place : places)
    if (std::filesystem::exists(place / folder)) return place / folder;
  return std::nullopt;
}

/// Columns of a log by name; lines that start with # are left out.
inline std::map<std::string, std::vector<double>> read_log(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::map<std::string, std::vector<double>> log;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (names.empty()) names = fields;
    else
      for (std::size_t k = 0; k < names.size() && k < fields.size(); ++k)
        log[names[k]].push_back(std::atof(fields[k].c_str()));
  }
  return log;
}

/// Two actuators of ratio 6 face to face, a torque sensor between: what one of them (1 or 2) did, driving
/// or driven, as a bench file of its own. Means of 20 samples at steady speed. The motor's torque is the
/// log's: declared constant times current.
inline std::string dyno_bench_file(const std::filesystem::path& path, int actuator) {
  const auto log = read_log(path);
  const std::string a = "a" + std::to_string(actuator), c = "c" + std::to_string(actuator);
  const auto& cmd = log.at("a1 q-axis cmd [A]");
  const auto& sensor = log.at("trd605 torque [Nm]");
  const auto& warm = log.at("housing temp [C]");
  const auto mean = [&](const std::vector<double>& v, std::size_t i) {
    double sum = 0.0;
    for (std::size_t k = i; k < i + 20; ++k) sum += v[k];
    return sum / 20.0;
  };
  std::string text = "direction,input_speed_rpm,input_torque_nm,output_torque_nm,temperature_c\n";
  int driver = 0;
  for (std::size_t i = 0; i + 20 <= cmd.size(); i += 20) {
    double low = 1e300, high = -1e300;
    for (std::size_t k = i; k < i + 20; ++k) {
      low = std::min(low, log.at(a + " velocity [rad/s]")[k]);
      high = std::max(high, log.at(a + " velocity [rad/s]")[k]);
    }
    // The driver's current is the commanded one; the damper's follows the speed.
    const double amps1 = std::abs(mean(log.at("c1 torque [Nm]"), i)) / 0.1095;
    const double amps2 = std::abs(mean(log.at("c2 torque [Nm]"), i)) / 0.1095;
    const double asked = std::abs(mean(cmd, i));
    const double off1 = std::abs(amps1 - asked), off2 = std::abs(amps2 - asked);
    if (off1 + 0.2 < off2 && off1 < 0.3) driver = 1;
    if (off2 + 0.2 < off1 && off2 < 0.3) driver = 2;
    const double speed = std::abs(mean(log.at(a + " velocity [rad/s]"), i));
    const double between = std::abs(mean(sensor, i));
    if (driver == 0 || asked < 0.5 || speed < 2.0 || high - low > 0.1 * speed || between < 0.2) continue;
    char line[160];
    std::snprintf(line, sizeof line, "%s,%.2f,%.6f,%.6f,%.2f\n",
                  driver == actuator ? "forward" : "backward", speed * 6.0 * 60.0 / kTwoPi,
                  std::abs(mean(log.at(c + " torque [Nm]"), i)), between, mean(warm, i));
    text += line;
  }
  return text;
}

/// A geared servo that swings a pendulum: what the gear train passes, from position (twice differentiated)
/// and the motor's duty. Torques of the motor by the servo's data sheet (0.52 N m at 5 V and rest, 10.8
/// rad/s without load), at the output shaft: a drive of ratio 1. Logs of hold_out go to the locked fold.
inline loop::BenchTable pendulum_table(const std::vector<std::filesystem::path>& logs,
                                       const std::vector<std::string>& hold_out) {
  constexpr double kMass_kg = 0.49, kArm_m = 0.1, kGravity = 9.81;
  constexpr double kPerVolt = 0.52 / 5.0, kBackEmf = 0.52 / 10.8;
  constexpr int kReach = 8;  // samples each side of a local parabola: 0.04 s
  loop::BenchTable table;
  int unit = -1, number = 0;
  for (const auto& path : logs) {
    const auto log = read_log(path);
    const auto &t = log.at("timestamp"), &q = log.at("position");
    bool held = false;
    for (const std::string& name : hold_out) held = held || path.stem() == name;
    const int fold = held ? 0 : 1 + number++ % loop::kBenchFolds;
    double stretch = -1e300;
    bool before = true;
    for (std::size_t i = kReach; i + kReach < t.size(); i += 4) {
      // Least squares parabola through the neighbours: q = q0 + v d + a d^2 / 2
      double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, y0 = 0, y1 = 0, y2 = 0;
      for (std::size_t k = i - kReach; k <= i + kReach; ++k) {
        const double d = t[k] - t[i], d2 = d * d;
        s0 += 1, s1 += d, s2 += d2, s3 += d2 * d, s4 += d2 * d2;
        y0 += q[k], y1 += q[k] * d, y2 += q[k] * d2;
      }
      const auto det = [](double a, double b, double c, double d, double e, double f, double g, double h,
                          double j) { return a * (e * j - f * h) - b * (d * j - f * g) + c * (d * h - e * g); };
      const double all = det(s0, s1, s2, s1, s2, s3, s2, s3, s4);
      const double v = det(s0, y0, s2, s1, y1, s3, s2, y2, s4) / all;
      const double a = 2.0 * det(s0, s1, y0, s1, s2, y1, s2, s3, y2) / all;
      if (std::abs(v) < 0.15) continue;
      double duty = log.at("load")[i];
      if (duty > 32767.0) duty -= 65536.0;
      const double motor = kPerVolt * duty / 1000.0 * log.at("input_volts")[i] - kBackEmf * v;
      const double load = kMass_kg * kArm_m * (kGravity * std::sin(q[i]) + kArm_m * a);
      const double sense = v > 0.0 ? 1.0 : -1.0;
      loop::BenchPoint p;
      p.forward = load * sense > 0.0;
      p.driving_nm = (p.forward ? motor : -load) * sense;
      p.driven_nm = (p.forward ? load : -motor) * sense;
      if (!(p.driving_nm > 0.0)) continue;
      p.load_nm = p.driving_nm;
      p.speed_rpm = std::abs(v) * 60.0 / kTwoPi;
      p.temperature_c = log.at("temp")[i];
      p.fold = fold;
      // A stretch of a quarter of a second hangs together.
      if (t[i] > stretch + 0.25 || p.forward != before) {
        ++unit;
        stretch = t[i];
        before = p.forward;
      }
      p.unit = unit;
      table.points.push_back(p);
    }
  }
  table.units = unit + 1;
  const loop::SmoothFit fit = loop::smooth_fit(table.points);
  for (loop::BenchPoint& p : table.points)
    p.sigma_nm = p.forward ? fit.sigma_forward_nm : fit.sigma_backward_nm;
  return table;
}

}  // namespace trueflank::test
