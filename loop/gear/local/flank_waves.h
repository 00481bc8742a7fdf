// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Waves across the flanks of one side of a scan, in any direction, that go on from tooth to tooth: the marks
/// of a hob or a worm, chatter. Phase: 2 pi (waves_profile (u + 1) / 2 + waves_face (v + 1) / 2) + order theta.
struct FlankWaves {
  double p_value = 1.0;  ///< corrected for all waves asked about
  int side = 1;          ///< +1: flanks on the counter-clockwise side
  double waves_profile = 0.0, waves_face = 0.0;  ///< over the involute, over the face
  double order = 0.0;                            ///< by so many periods a turn the phase runs on
  double amplitude_um = 0.0;
};

/// How far the flanks of a scan stand each by itself.
struct TeethApart {
  double p_value = 1.0;
  double spread_um = 0.0;  ///< standard deviation from flank to flank beyond the noise
};

/// A course over the profile that every flank of a scan has for itself, constant over the face; or one over
/// the face, constant over the profile.
struct FormsApart {
  double p_value = 1.0;    ///< corrected for all wavelengths and both directions
  bool face = false;       ///< the direction in which it varies
  double waves = 0.0;      ///< the clearest, over the involute or over the face
  double spread_um = 0.0;  ///< standard deviation beyond the noise, of all whole waves
};

/// Waves of one length and direction on every flank of one side of a scan, in a phase of its own on
/// each: what chatters, and begins anew on every flank. Phase: 2 pi (waves_profile (u + 1) / 2 +
/// waves_face (v + 1) / 2) and one of the flank's.
struct OwnWaves {
  double p_value = 1.0;                          ///< corrected for all wavelengths and both sides
  int side = 1;                                  ///< +1: flanks on the counter-clockwise side
  double waves_profile = 0.0, waves_face = 0.0;  ///< over the involute, over the face
  double amplitude_um = 0.0;                     ///< of the usual flank
};

struct FlankSpectrum {
  std::optional<FlankWaves> waves;
  std::optional<TeethApart> apart;
  std::optional<FormsApart> forms;
  std::vector<OwnWaves> own_waves;  ///< the largest of either side
};

/// Fourier sums over every flank of a scan, and over the teeth. A wave is judged by the other
/// orders at its own wavelengths, so that errors that hang together along the lines of a scan are
/// no finding; the heights of the flanks by the longest waves within them, and courses of their own
/// by waves as long that run askew. Waves in a phase of their own on every flank are judged by the
/// wavelengths around them in every direction. `row_um`: residuals of the rows; `used`: which are
/// asked.
[[nodiscard]] FlankSpectrum flank_spectrum(const FlankGeometry& geometry, const Observations& table,
                                           const std::vector<float>& row_um,
                                           const std::vector<bool>& used);

/// Waves over the face in helix traces whose phase runs on from tooth to tooth, by whole or half
/// orders: the largest of either side, judged as those of scans are. None where it is less than a
/// tenth of the traces' squares. Where fewer than seven teeth in ten have a trace, by whole orders
/// that no other looks like (marching_leads.h).
[[nodiscard]] std::vector<FlankWaves> waves_of_leads(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const std::vector<float>& row_um,
                                                     const std::vector<bool>& used);

}  // namespace trueflank::loop
