// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "tests/loop/hidden_process.h"
#include "trueflank/loop/measured/measurement.h"

// Scans and traces of the gears of hidden_process.h, with noise, a pose and zeros of their own.
namespace trueflank::test {

struct ScanOptions {
  int points = 20000;
  double noise_um = 5.0;
  double correlation = 0.0;   ///< of successive points along a scan line (AR(1))
  double outlier_share = 0.0;
  std::vector<int> missing_teeth;
  bool any_pose = false;
  bool tips = true;
  bool bore = false;
  double bore_mm = 2.5;
  unsigned seed = 1;
};

/// Scan lines over every flank, noise along the normal, then outliers and a pose.
inline loop::ScanData scan_of(const MadeGear& g, const std::vector<Process>& processes,
                              const ScanOptions& o) {
  std::mt19937_64 random(o.seed * 7919u + 17u);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  loop::ScanData scan;
  scan.file = "made";
  const int present = g.teeth - static_cast<int>(o.missing_teeth.size());
  const int per_flank = std::max(4, o.points / (2 * present));
  const int line = 25;
  for (int tooth = 1; tooth <= g.teeth; ++tooth) {
    if (std::find(o.missing_teeth.begin(), o.missing_teeth.end(), tooth) != o.missing_teeth.end())
      continue;
    for (const int side : {1, -1}) {
      double error = normal(random);
      for (int i = 0; i < per_flank; ++i) {
        FlankSpot s{tooth, side, 0.0, 0.0};
        s.v = -0.985 + 1.97 * (i / line + 0.5) / std::ceil(1.0 * per_flank / line);
        s.u = 0.97 * (2.0 * ((i % line) + 0.5 + 0.3 * uniform(random)) / line - 1.0);
        if (o.correlation == 0.0) s.v = 0.985 * uniform(random);
        error = o.correlation * error +
                std::sqrt(1.0 - o.correlation * o.correlation) * normal(random);
        Vec3 p = made_point(g, s, processes);
        const Vec3 n = normal_at(g, s);
        double e = o.noise_um * error;
        if (o.outlier_share > 0.0 && 0.5 * (uniform(random) + 1.0) < o.outlier_share)
          e += 1000.0 * g.module_mm * 0.2 * uniform(random);
        for (int k = 0; k < 3; ++k) p[k] += 1e-3 * e * n[k];
        scan.points_mm.push_back(p);
      }
    }
  }
  // The bore was made in another clamping: no process moves it.
  for (int i = 0; o.bore && i < o.points / 8; ++i) {
    const double a = M_PI * uniform(random), r = o.bore_mm + 1e-3 * o.noise_um * normal(random);
    scan.points_mm.push_back({r * std::cos(a), r * std::sin(a), 0.5 * g.face_mm * (1.0 + uniform(random))});
  }
  if (o.any_pose) {
    // Some turn about a slanted axis and some way off.
    const double a = 1.1, b = 0.6, c = 2.3;
    for (Vec3& p : scan.points_mm) {
      Vec3 q{p[0] * std::cos(a) - p[1] * std::sin(a), p[0] * std::sin(a) + p[1] * std::cos(a), p[2]};
      q = {q[0], q[1] * std::cos(b) - q[2] * std::sin(b), q[1] * std::sin(b) + q[2] * std::cos(b)};
      q = {q[0] * std::cos(c) - q[1] * std::sin(c), q[0] * std::sin(c) + q[1] * std::cos(c), q[2]};
      p = {q[0] + 40.0, q[1] - 25.0, q[2] + 8.0};
    }
  }
  return scan;
}

/// Points of the tip lands, scaled with the part.
inline void add_tips(const MadeGear& gear, double percent, loop::ScanData& scan) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const FlankSpot end{1, 1, 1.0, -1.0};
  const Vec3 corner = point_on(gear, end);
  const double half = std::abs(std::atan2(corner[1], corner[0]));
  const double grown = 1.0 + 0.01 * percent;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2.0 * M_PI * (i % gear.teeth) / gear.teeth + half * share(random);
    const double r = gear.tip_mm * grown + 0.004 * share(random);
    scan.points_mm.push_back({r * std::cos(angle), r * std::sin(angle),
                              0.5 * gear.face_mm * grown * (1.0 + 0.98 * share(random))});
  }
}

struct InspectionOptions {
  std::vector<int> teeth;   ///< profile and helix traces on these; empty: all
  int points = 80;
  double noise_um = 0.5;
  double correlation = 0.0;
  bool profile = true, helix = true, index = true, radial = false;
  bool common_zero = false;
  unsigned seed = 1;
  std::vector<double> profiles_at = {0.0};  ///< heights of profile traces, -1 ... +1 over the face
};

/// Distance of a made flank from the designed one along the normal, at first order of the displacement.
inline double deviation_um(const MadeGear& g, const FlankSpot& s, const std::vector<Process>& processes) {
  const Vec3 p = point_on(g, s), q = made_point(g, s, processes), n = normal_at(g, s);
  return 1e3 * ((q[0] - p[0]) * n[0] + (q[1] - p[1]) * n[1] + (q[2] - p[2]) * n[2]);
}

inline Flank flank_name(const MadeGear& g, int side) {
  return (side > 0) != g.ring ? Flank::kLeft : Flank::kRight;
}

/// Traces and index values with arbitrary zeros, as a gear checker delivers them.
inline loop::InspectionData inspection_of(const MadeGear& g, const std::vector<Process>& processes,
                                          const InspectionOptions& o) {
  std::mt19937_64 random(o.seed * 104729u + 5u);
  std::normal_distribution<double> normal(0.0, 1.0);
  loop::InspectionData data;
  data.file = "checked";
  data.common_zero = o.common_zero;
  std::vector<int> teeth = o.teeth;
  for (int k = 1; teeth.size() < static_cast<std::size_t>(g.teeth) && o.teeth.empty(); ++k)
    teeth.push_back(k);
  const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
  const double u_ref =
      2.0 * (g.base() * std::tan(g.pressure_angle_rad) - from) / (to - from) - 1.0;
  const auto add = [&](loop::RecordKind kind, const FlankSpot& s, double value) {
    loop::InspectionRow row;
    row.record = kind;
    row.tooth = s.tooth;
    row.flank = flank_name(g, s.side);
    row.diameter_mm = 2.0 * std::hypot(g.base(), from + 0.5 * (s.u + 1.0) * (to - from));
    row.z_mm = 0.5 * (s.v + 1.0) * g.face_mm;
    row.deviation_um = value;
    data.rows.push_back(row);
  };
  for (const int tooth : teeth)
    for (const int side : {1, -1})
      for (const bool is_profile : {true, false}) {
        if (is_profile ? !o.profile : !o.helix) continue;
        for (const double at : is_profile ? o.profiles_at : std::vector{u_ref}) {
          const double zero = o.common_zero ? 0.0 : 7.0 * normal(random);
          double error = normal(random);
          for (int i = 0; i < o.points; ++i) {
            const double c = 0.95 * (2.0 * i / (o.points - 1.0) - 1.0);
            const FlankSpot s =
                is_profile ? FlankSpot{tooth, side, c, at} : FlankSpot{tooth, side, at, c};
            error = o.correlation * error +
                    std::sqrt(1.0 - o.correlation * o.correlation) * normal(random);
            add(is_profile ? loop::RecordKind::kProfile : loop::RecordKind::kHelix, s,
                deviation_um(g, s, processes) + zero + o.noise_um * error);
          }
        }
      }
  if (o.index)
    for (const int side : {1, -1}) {
      double first = 0.0;
      for (int tooth = 1; tooth <= g.teeth; ++tooth) {
        const FlankSpot s{tooth, side, u_ref, 0.0};
        const double value = deviation_um(g, s, processes) + o.noise_um * normal(random);
        if (tooth == 1 && !o.common_zero) first = value;
        add(loop::RecordKind::kIndex, s, value - first);
      }
    }
  return data;
}

}  // namespace trueflank::test
