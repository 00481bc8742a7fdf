// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "trueflank/train/gear_train.h"

// A drive on a bench whose losses the library does not know. Shares no formula with trueflank/loop: the
// train's efficiency is the paper's closed form for three meshes, each with the sum of its forces, and all that is
// hidden is a function.
namespace trueflank::test {

/// What the bench does at one moment.
struct BenchMoment {
  bool forward = true;
  double rpm = 0.0;
  double driving_nm = 0.0;      ///< true torque on the driving side
  double celsius = 25.0;
  double input_turns = 0.0;
  double load_share = 0.0;      ///< of the bench's largest load
};

struct HiddenDrive {
  /// Friction coefficient of mesh 1 ... 3 at a moment.
  std::function<double(const BenchMoment&, int mesh)> friction = [](auto&, int) { return 0.1; };
  /// Torque lost at the input beside the meshes [N m].
  std::function<double(const BenchMoment&)> loss_nm = [](auto&) { return 0.0; };
  double output_reads = 1.0;   ///< factor of the output's sensor
  double input_zero_nm = 0.0, output_zero_nm = 0.0;
  /// What the output's sensor reads of a torque at a moment.
  std::function<double(double, const BenchMoment&)> output_reading = [](double nm, auto&) { return nm; };
};

struct BenchPlan {
  std::vector<double> rpm{60, 150, 400, 900, 1800, 3000};
  std::vector<double> output_nm{0, 2, 5, 9, 14, 20};
  bool forward = true, backward = true;
  int repeats = 2;
  double low_celsius = 25.0, high_celsius = 25.0;  ///< differs: a column, drawn per repeat
  bool angles = false;
  double turns_between = 37.3;  ///< input turns from one row to the next
  double noise_forward_nm = 0.05, noise_backward_nm = 0.0005;
  double noise_driving = 0.0005;  ///< of the largest driving torque
  double noise_correlation = 0.0; ///< of one row with the next
  bool shuffled = true;
  std::uint64_t seed = 1;
};

/// The train of the bilateral drive with its shifts, as numbers of its own: the paper's closed form for three
/// meshes, in which each loses what the forces on its sliding teeth say, summed up.
class PaperTrain {
 public:
  explicit PaperTrain(const GearTrain& train) {
    const auto z = [&](const char* name) {
      return static_cast<double>(train.find(name)->profile.gear().teeth);
    };
    k_ = z("ring1") / z("sun");
    i2_ = z("ring1") * z("planet2") / (z("planet1") * z("ring2"));
    for (int m = 0; m < 3; ++m) {
      const GearPair pair = train.pair(train.meshes[m]);
      const LineOfAction line = line_of_action(pair);
      const double pitch = line.base_pitch_mm, r1 = base_radius_mm(pair.gear1()), r2 = base_radius_mm(pair.gear2());
      mesh_[m] = {r1 / pitch, r2 / pitch, (line.effective_start_mm - line.pitch_point_mm) / pitch,
                  (line.effective_end_mm - line.pitch_point_mm) / pitch, line.pitch_point_mm / pitch,
                  pair.internal() ? 1.0 : -1.0};
    }
  }
  [[nodiscard]] double ratio() const { return (1.0 + k_) / (1.0 - i2_); }
  [[nodiscard]] double forward(const std::array<double, 3>& mu) const {  // sun, planet1, ring2 drive
    const double a = efficiency(0, mu[0], true), b = efficiency(1, mu[1], true), c = efficiency(2, mu[2], false);
    return (1.0 + k_ * a * b) / (1.0 - i2_ * b * c) / ratio();
  }
  [[nodiscard]] double backward(const std::array<double, 3>& mu) const {
    const double a = efficiency(0, mu[0], false), b = efficiency(1, mu[1], false), c = efficiency(2, mu[2], true);
    return (1.0 - i2_ / (b * c)) / (1.0 + k_ / (a * b)) * ratio();
  }

 private:
  struct Mesh {  // in base pitches, places from the pitch point
    double r1, r2, start, end, tangent, sense;
  };
  [[nodiscard]] double efficiency(int m, double mu, bool gear1_drives) const {
    Known& known = known_[static_cast<std::size_t>(m)][gear1_drives ? 0 : 1];
    if (!(known.mu == mu)) known = {mu, summed_efficiency(m, mu, gear1_drives)};
    return known.efficiency;
  }
  /// Driven torque held constant, pairs share the load evenly; 4000 moments of a pitch.
  [[nodiscard]] double summed_efficiency(int m, double mu, bool gear1_drives) const {
    const Mesh& mesh = mesh_[static_cast<std::size_t>(m)];
    constexpr int kMoments = 4000;
    double driving_over_driven = 0.0;
    for (int i = 0; i < kMoments; ++i) {
      double t1 = 0.0, t2 = 0.0;
      for (double s = mesh.start + (i + 0.5) / kMoments; s < mesh.end; s += 1.0) {
        const double friction = (gear1_drives ? mu : -mu) * (s > 0.0 ? 1.0 : -1.0);
        t1 += mesh.r1 + friction * (mesh.tangent + s);
        t2 += mesh.r2 + friction * (mesh.tangent * mesh.r2 / mesh.r1 + mesh.sense * s);
      }
      driving_over_driven += (gear1_drives ? t1 / t2 : t2 / t1) / kMoments;
    }
    return (gear1_drives ? mesh.r1 / mesh.r2 : mesh.r2 / mesh.r1) / driving_over_driven;
  }

  double k_ = 1.0, i2_ = 0.5;
  std::array<Mesh, 3> mesh_{};
  /// What was summed last, by mesh and gear that drives: on most benches all rows have one coefficient.
  struct Known {
    double mu = NAN, efficiency = NAN;
  };
  mutable std::array<std::array<Known, 2>, 3> known_{};
};

/// A bench file's text.
inline std::string bench_file(const PaperTrain& train, const HiddenDrive& drive, const BenchPlan& plan) {
  std::mt19937_64 random(plan.seed);
  std::normal_distribution<double> normal;
  const bool warm = plan.high_celsius > plan.low_celsius;
  const double most = *std::max_element(plan.output_nm.begin(), plan.output_nm.end());
  std::vector<BenchMoment> moments;
  for (int repeat = 0; repeat < plan.repeats; ++repeat) {
    const std::size_t first = moments.size();
    for (const bool forward : {true, false}) {
      if (forward ? !plan.forward : !plan.backward) continue;
      for (const double rpm : plan.rpm)
        for (const double load : plan.output_nm) {
          BenchMoment m;
          m.forward = forward;
          m.rpm = rpm * (1.0 + 0.003 * normal(random));
          m.driving_nm = forward ? 1.1 * load / train.ratio() + 0.0005 : load + 0.05;
          m.load_share = load / most;
          m.celsius = plan.low_celsius + (plan.high_celsius - plan.low_celsius) *
                                             std::uniform_real_distribution<double>()(random);
          moments.push_back(m);
        }
    }
    if (plan.shuffled) std::shuffle(moments.begin() + static_cast<std::ptrdiff_t>(first), moments.end(), random);
  }
  std::string text = "direction,input_speed_rpm,input_torque_nm,output_torque_nm";
  if (warm) text += ",temperature_c";
  if (plan.angles) text += ",input_angle_deg";
  text += "\n";
  double turns = 0.0, drift = 0.0;
  for (BenchMoment& m : moments) {
    turns += plan.turns_between * (1.0 + 0.4 * std::uniform_real_distribution<double>()(random));
    m.input_turns = turns;
    std::array<double, 3> mu{};
    for (int k = 0; k < 3; ++k) mu[k] = drive.friction(m, k);
    const double lost = drive.loss_nm(m);
    // The brake sets the load; what drives gives that and what is lost.
    m.driving_nm += m.forward ? lost : 1.2 * lost * train.ratio();
    const double driven = m.forward ? train.ratio() * train.forward(mu) * (m.driving_nm - lost)
                                    : train.backward(mu) * m.driving_nm / train.ratio() - lost;
    drift = plan.noise_correlation * drift +
            std::sqrt(1.0 - plan.noise_correlation * plan.noise_correlation) * normal(random);
    const double noisy_driven = driven + drift * (m.forward ? plan.noise_forward_nm : plan.noise_backward_nm);
    const double full = m.forward ? 1.1 * most / train.ratio() : most;
    const double noisy_driving = m.driving_nm + plan.noise_driving * full * normal(random) * 0.2;
    double in = m.forward ? noisy_driving : noisy_driven, out = m.forward ? noisy_driven : noisy_driving;
    in += drive.input_zero_nm;
    out = drive.output_reads * drive.output_reading(out, m) + drive.output_zero_nm;
    char line[200];
    std::snprintf(line, sizeof line, "%s,%.2f,%.6f,%.5f", m.forward ? "forward" : "backward", m.rpm, in, out);
    text += line;
    if (warm) std::snprintf(line, sizeof line, ",%.2f", m.celsius), text += line;
    if (plan.angles) std::snprintf(line, sizeof line, ",%.2f", 360.0 * m.input_turns), text += line;
    text += "\n";
  }
  return text;
}

}  // namespace trueflank::test
