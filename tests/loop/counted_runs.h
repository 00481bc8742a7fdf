// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "tests/loop/made_gears.h"

// Many runs of the loop on small data, counted: false alarms, intervals that hold the truth.
namespace trueflank::test {

/// The kinds of data a run is made of. Small on purpose: a run takes about a tenth of a second.
enum class DataKind { kScan, kTraces, kFourTeeth };

inline MadeGear small_gear() {
  MadeGear gear = spur(12);
  gear.face_mm = 6.0;
  return gear;
}

inline loop::LoopResult run_on(const MadeGear& gear, const std::vector<Process>& processes,
                               DataKind kind, double correlation, unsigned seed) {
  if (kind == DataKind::kScan) {
    ScanOptions options;
    options.points = 1500;
    options.correlation = correlation;
    options.seed = seed;
    return close(gear, scan_of(gear, processes, options), true);
  }
  InspectionOptions options;
  options.points = 40;
  options.correlation = correlation;
  options.seed = seed;
  if (kind == DataKind::kFourTeeth) options.teeth = {1, 4, 7, 10};
  return close(gear, inspection_of(gear, processes, options));
}

struct FalseAlarms {
  int runs = 0, alarms = 0;
  std::string first;  ///< what the first of them found
};

/// Runs without any effect, seeds from `first_seed` on.
inline FalseAlarms count_false_alarms(DataKind kind, double correlation, int runs,
                                      unsigned first_seed = 1) {
  FalseAlarms count;
  const MadeGear gear = small_gear();
  for (int i = 0; i < runs; ++i) {
    const auto result = run_on(gear, {}, kind, correlation, first_seed + i);
    ++count.runs;
    if (result.verdict == loop::Verdict::kNoEffect && result.effects.empty()) continue;
    ++count.alarms;
    if (count.first.empty()) count.first = list(result);
  }
  return count;
}

struct Coverage {
  int runs = 0, missed = 0;                    ///< runs; runs that did not find both effects
  std::map<std::string, int> held, intervals;  ///< by parameter
  [[nodiscard]] double share(const std::string& name) const {
    return intervals.at(name) > 0 ? 1.0 * held.at(name) / intervals.at(name) : 0.0;
  }
  [[nodiscard]] double share() const {
    double all = 0.0, good = 0.0;
    for (const auto& [name, n] : intervals) {
      all += n;
      good += held.at(name);
    }
    return good / all;
  }
};

/// Eccentricity with a sloping profile (scans), or a pitch wave with crowning (traces, where a sloping
/// profile is also a scale), found again and again.
inline Coverage count_coverage(DataKind kind, double correlation, int runs, unsigned first_seed = 1) {
  Coverage count;
  const MadeGear gear = small_gear();
  const bool scan = kind == DataKind::kScan;
  const double slope = scan ? 12.0 : 3.0, wave = scan ? 8.0 : 3.0, phase = 50.0;
  const std::vector<Process> processes = {
      scan ? off_centre(wave, phase) : indexed(2, wave, phase),
      grown([=](auto&, const FlankSpot& s, auto&) {
        return scan ? 0.5 * slope * s.u : -slope * s.v * s.v;
      })};
  const auto take = [&](const loop::FoundEffect& effect, const std::string& name, double truth) {
    const auto& p = parameter(effect, name);
    ++count.intervals[name];
    count.held[name] += p.low <= truth && truth <= p.high ? 1 : 0;
  };
  for (int i = 0; i < runs; ++i) {
    const auto result = run_on(gear, processes, kind, correlation, first_seed + i);
    ++count.runs;
    const auto* first = find(result, scan ? "eccentricity" : "pitch_wave");
    const auto* second = find(result, scan ? "pressure_angle_error" : "crowning");
    if (first == nullptr || second == nullptr) {
      ++count.missed;
      continue;
    }
    take(*first, "amplitude_um", wave);
    take(*first, "phase_deg", phase);
    take(*second, scan ? "slope_um" : "amount_um", slope);
  }
  return count;
}

}  // namespace trueflank::test
