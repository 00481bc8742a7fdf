// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// A wave over the generating rotation: in straight lines over the flanks, of a whole order a turn.
struct RotationWave {
  int order = 0;  ///< 0: none was asked about
  /// +1, -1: of these flanks, in a phase of its own; 0: of both, as ghost_order has it on both.
  int side = 0;
  /// Its lines run as if the teeth were counted, or the flanks named, from the other face.
  bool backwards = false;
  double p_value = 1.0;  ///< corrected for all orders, both flanks and both ways
  double amplitude_um = 0.0;
};

/// The likeliest wave over the generating rotation in profile traces of five teeth or more, from
/// the order of one and a half waves a profile up to that of which a trace has four values a wave.
/// The two flanks are cut at another place of the machine's turn, so each may have a phase of its
/// own. An order of the traces of most teeth is judged against as many others as the gear has
/// teeth. On fewer, and besides, it is judged by how well the waves of traces agree in its phases,
/// and asked to be a hundred times surer then; so waves in a phase of their own on every tooth, and
/// those that all teeth share, are none. On few teeth it must also be much likelier than every
/// other order. Without traces the flanks of scans of most teeth are asked as traces of most teeth
/// are, by the other orders alone. `row_um`: residuals of the table's
/// rows; `used`: which rows are looked at.
[[nodiscard]] RotationWave likeliest_rotation_wave(const FlankGeometry& geometry,
                                                   const Observations& table,
                                                   const std::vector<float>& row_um,
                                                   const std::vector<bool>& used);

/// By chance the wave of this order, side and way stands out so far, corrected for all that
/// likeliest_rotation_wave asks; 0 where these traces cannot be asked about its order.
[[nodiscard]] double chance_of_rotation_wave(const FlankGeometry& geometry,
                                             const Observations& table,
                                             const std::vector<float>& row_um,
                                             const std::vector<bool>& used,
                                             const RotationWave& wave);

}  // namespace trueflank::loop
