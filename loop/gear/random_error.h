// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/remainder.h"

namespace trueflank::loop {

/// What is known of the values beside their random error.
struct WhatIsLeft {
  bool nothing = false;  ///< no structure was found: scans and single values are taken as they are
  /// Flanks have courses of their own, over the profile or over the face: any in scans, a line or a
  /// bow in traces.
  bool own_profiles = false, own_leads = false;
  bool smooth_profiles = false, smooth_leads = false;  ///< of many waves, in traces
  OwnPlaces places = {};  ///< in an index: both flanks tell them
  std::vector<OwnWaves> own_waves = {};  ///< on every flank of a scan, each in its phase
};

/// Sums over the values of one kind of record [um^2]: residuals, and the random error among them.
struct KindError {
  double count = 0.0, square = 0.0, random_square = 0.0;
  double held_out_count = 0.0, held_out_random_square = 0.0;  ///< of the locked hold-out
  double of_held_out_sum =
      0.0;  ///< variance of that square by chance [um^4], where some are louder
};

/// As random_error, each kind of record apart.
[[nodiscard]] std::map<ObservationKind, KindError> errors_of_kinds(
    const FlankGeometry& geometry, const Observations& table, const Patches& patches,
    const std::vector<float>& row_um, const WhatIsLeft& left);

/// Standard deviations [um] of the random error of all values, and of those on the locked hold-out:
/// some teeth may be measured worse. With how many degrees of freedom the mean square of these is
/// known: as many as there are, or fewer where some count more, or are only known to be louder.
struct RandomError {
  double um = 0.0, held_out_um = 0.0, held_out_degrees = 0.0;
};

/// Of the values that errors are made of, all kinds together, from the data's own neighbourhood.
/// Traces: their spectrum, at every wavelength the median over the teeth and the neighbouring
/// wavelengths, what the teeth have in common taken off: a line, a form that repeats or one odd
/// tooth is no noise, an error that hangs together is. Scans: the median flank, less what all
/// flanks have in common, a low form of its own and the courses of its own that `left` knows of. In
/// both each tooth counts by how loud its own short waves are (discovery/loudness.h). One value a
/// tooth: second differences around the gear, or, where teeth or gaps have places of their own, how
/// their two flanks differ. Sizes alone: their stated errors. `row_um`: residuals of the table's
/// rows. Accuracy: in blind runs (docs/loop.md) the middle 90 % lie at 0.94 to 1.17 of the true
/// one.
[[nodiscard]] RandomError random_error(const FlankGeometry& geometry, const Observations& table,
                                       const Patches& patches, const std::vector<float>& row_um,
                                       const WhatIsLeft& left);

}  // namespace trueflank::loop
