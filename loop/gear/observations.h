// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/pose/pose.h"
#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// Kind of an observation: rows of one kind share their noise.
enum class ObservationKind : std::uint8_t {
  kScanFlank,
  kScanTip,
  kScanRoot,
  kScanBore,
  kProfile,
  kHelix,
  kIndex,
  kRadial,
  kSize
};
inline constexpr int kObservationKinds = 9;

/// One measured value: the sum of deviations at places (one place for a point of a flank, two for a
/// ball in a gap, all teeth for a span), each times the same weight.
struct Observation {
  double deviation_um = 0.0;
  double weight = 1.0;  ///< of each of its places
  std::uint32_t first_place = 0;
  int trace = -1;  ///< rows that share one unknown zero; -1: none
  int source = 0;  ///< scan or file it came from
  std::uint16_t places = 1;
  ObservationKind kind = ObservationKind::kScanFlank;
  std::uint8_t line = 0;  ///< of a trace among those of its flank (lines_across.h)
};
static_assert(sizeof(Observation) == 32);

/// Of a size without a sigma of its own.
inline constexpr double kDefaultSizeSigma_um = 2.0;

/// All inputs in one table. Deviations in um along the surface normal, + = too much material.
struct Observations {
  std::vector<Observation> rows;
  std::vector<Place> places;
  /// Points of scans in the gear's frame [mm], one for each of the first rows (scans come first).
  std::vector<std::array<double, 3>> points_mm;
  /// As given with the data, of a row by its first place; NaN: not given. Empty: of none.
  std::vector<double> sigmas_um;
  /// Degrees of freedom of the scatter that sizes have for their errors; 0: their errors are known.
  int size_degrees = 0;
  int traces = 0;
  /// Deviations and places of scanned flanks are about a displacement (finite_displacement.h).
  bool is_displaced = false;
  std::vector<Pose> poses;         ///< of each scan
  std::vector<bool> pose_is_free;  ///< of each scan
  std::vector<std::string> files;  ///< of records, by their number (Place::file)
  int outliers = 0;
  /// A value of a trace that was left out of the rows, and how far off its neighbours it lay.
  struct LeftOut {
    ObservationKind kind = ObservationKind::kProfile;
    Place place;
    double off_um = 0.0;
  };
  std::vector<LeftOut> left_out;  ///< of traces, those of one file after the other
  std::vector<std::string> notes;

  [[nodiscard]] const Place& place(const Observation& row) const { return places[row.first_place]; }
  [[nodiscard]] double sigma_um(const Observation& row) const {
    return row.first_place < sigmas_um.size() ? sigmas_um[row.first_place] : kNaN;
  }
  /// The same of a size; the usual one where it was not given.
  [[nodiscard]] double size_sigma_um(const Observation& row) const {
    const double given = sigma_um(row);
    return std::isnan(given) ? kDefaultSizeSigma_um : given;
  }
};

/// Whether rows of profile or helix traces are among them.
[[nodiscard]] bool is_traced(const Observations& table);

/// Points further from every surface, in normal modules, are on none.
inline constexpr double kReachOfNearest = 0.35;

/// A scanned row of a flank on the gear as designed, whatever the table says of it now: the same
/// place and distance as when it entered the table. At the edge it stays one of the flank where its
/// scan was moved a little since.
[[nodiscard]] inline PlacedPoint as_designed(const FlankGeometry& geometry,
                                             const Observations& table, std::size_t row) {
  PlacedPoint placed = geometry.nearest_flank(table.points_mm[row], kFlankMargin);
  if (placed.place.roll_mm > 0.0) placed.place.surface = Surface::kFlank;
  return placed;
}

/// The same of many rows, into as many results.
void as_designed(const FlankGeometry& geometry, const Observations& table,
                 std::span<const std::size_t> rows, PlacedPoint* found);

struct ObservationOptions {
  bool aligned = false;
};

/// Puts measured data of one gear into the table: poses fitted, points classed, outliers left out.
/// The points of scans stay where they are and become the table's.
/// Errors: data that do not belong to this gear, or hold nothing usable.
[[nodiscard]] ResultAll<Observations> make_observations(const FlankGeometry& geometry,
                                                        MeasuredData data,
                                                        const ObservationOptions& options);

}  // namespace trueflank::loop
