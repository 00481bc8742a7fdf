// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

// Waves over a coordinate of the plane, by which everything that stands there is shifted.
namespace trueflank::loop {

/// A shift along x (0) or y (1) in waves over x (0) or y (1).
struct PlaneWave {
  int along = 0, by = 0;
  double wavelength_mm = 0.0;
  double p_value = 1.0;  ///< corrected for both shifts, both coordinates and all wavelengths
  double square = 0.0;   ///< squares that it takes out of all rows
  double amplitude_um = 0.0;
  /// Where one of its jumps stands, of a sawtooth, whose amount is from jump to jump; NaN: of a
  /// wave.
  double jump_mm = kNaN;

  [[nodiscard]] EffectShape shape() const {
    EffectShape values{double(along), double(by), wavelength_mm};
    if (!std::isnan(jump_mm)) values.push_back(jump_mm);
    return values;
  }
};

/// The likeliest wave in scanned flanks, from twice the gear to a sixtieth of its radius, judged
/// against waves of other lengths of the same shift: what hangs together otherwise is none. None
/// where another of another length is nearly as strong. A sawtooth, where that says clearly more.
/// `row_um`: residuals of the table's rows; `rows`: which are looked at.
[[nodiscard]] std::optional<PlaneWave> likeliest_plane_wave(const FlankGeometry& geometry,
                                                            const Observations& table,
                                                            const std::vector<float>& row_um,
                                                            const std::vector<std::uint32_t>& rows);

/// Sawteeth of scanned flanks along x over x and along y over y, far finer than those waves:
/// pixels, steps of an axis. One, two, or none; a wave that is no sawtooth is none.
[[nodiscard]] std::vector<PlaneWave> likeliest_pixels(const FlankGeometry& geometry,
                                                      const Observations& table,
                                                      const std::vector<float>& row_um,
                                                      const std::vector<std::uint32_t>& rows);

/// Stripes in any direction, along the normals, at all heights.
struct PlaneStripes {
  double direction_deg = 0.0, wavelength_mm = 0.0;
  double p_value = 1.0;  ///< corrected for all directions and wavelengths
  double square = 0.0;   ///< squares that they take out of all rows
  double amplitude_um = 0.0;
};

/// The likeliest stripes in scanned flanks, from one wave over the gear to twelve, judged against
/// stripes of other lengths and directions. None where others are nearly as strong.
[[nodiscard]] std::optional<PlaneStripes> likeliest_plane_stripes(
    const FlankGeometry& geometry, const Observations& table, const std::vector<float>& row_um,
    const std::vector<std::uint32_t>& rows);

}  // namespace trueflank::loop
