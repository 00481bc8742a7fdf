// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/pose.h"
#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// Kind of an observation: rows of one kind share their noise.
enum class ObservationKind : std::uint8_t {
  kScanFlank, kScanTip, kScanRoot, kScanBore, kProfile, kHelix, kIndex, kRadial, kSize
};
inline constexpr int kObservationKinds = 9;

/// One measured value: a weighted sum of deviations at places (one place for a point of a flank, two
/// for a ball in a gap, all teeth for a span).
struct Observation {
  std::uint32_t first_place = 0;
  std::uint32_t places = 1;
  double deviation_um = 0.0;
  double sigma_um = kNaN;   ///< as given with the data; NaN: not given
  int trace = -1;           ///< rows that share one unknown zero; -1: none
  int source = 0;           ///< scan or file it came from
  ObservationKind kind = ObservationKind::kScanFlank;
};

struct WeightedPlace {
  Place place;
  double weight = 1.0;
};

/// All inputs in one table. Deviations in um along the surface normal, + = too much material.
struct Observations {
  std::vector<Observation> rows;
  std::vector<WeightedPlace> places;
  /// Points of scans in the gear's frame [mm], one for each of the first rows (scans come first).
  std::vector<std::array<double, 3>> points_mm;
  int traces = 0;
  std::vector<Pose> poses;            ///< of each scan
  std::vector<bool> pose_is_free;     ///< of each scan
  int outliers = 0;
  std::vector<std::string> notes;

  [[nodiscard]] const Place& place(const Observation& row) const {
    return places[row.first_place].place;
  }
};

struct ObservationOptions {
  bool aligned = false;
};

/// Puts measured data of one gear into the table: poses fitted, points classed, outliers left out.
/// Errors: data that do not belong to this gear, or hold nothing usable.
[[nodiscard]] ResultAll<Observations> make_observations(const FlankGeometry& geometry,
                                                        const MeasuredData& data,
                                                        const ObservationOptions& options);

}  // namespace trueflank::loop
