// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/loop/gear/local/flank_waves.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Every flank of a scan has a course of its own, alike all along the other direction.
enum class OwnCourse { kNone, kProfile, kLead };
/// Every tooth, or every gap, has a place of its own that both its flanks share.
struct OwnPlaces {
  bool any = false, of_gaps = false;
  bool opposite = false;  ///< as where it stands aside: one flank stands out as the other lies back
};

/// One structure in what a model leaves.
struct RemainderFinding {
  double p_value = 1.0;  ///< corrected for all places, lengths and orders looked at
  std::string text;      ///< size, place, wavelength in words
  double square = 0.0;   ///< squares that a form in common takes out
  double amount_um = 0.0;
  std::optional<Effect>
      effect;  ///< the form as columns; empty: no form that comes back (phases of their own)
  bool local = false;  ///< stands on one tooth
  OwnCourse own = OwnCourse::kNone;
  bool own_relief = false;   ///< a form of many waves on every trace, not a slope or a bow
  bool own_phases = false;   ///< waves of every trace, each in its phase
  OwnPlaces places = {};     ///< in single values
  std::vector<OwnWaves> own_waves = {};  ///< on every flank of a scan, each in its phase
  double noise_um = kNaN;    ///< the error beside it, where it tells that; NaN: it does not
  bool beside_line = false;  ///< along the flanks, sought beside a slope
};

/// Which values are looked at: what is to be learnt must not come from the hold-out; what stands on
/// one tooth cannot be learnt elsewhere.
enum class RemainderOf { kTraining, kAll };

/// Structure of any scale in residuals: along the traces or flanks (steps, grooves, waves in phase
/// or each in its own, spots), around the gear (sectors, waves of every order to half the teeth)
/// and in space (spots of scans). Each is judged against the neighbourhood: other teeth at the same
/// place, other places of the same width, other orders of the teeth. The most certain finding
/// first; those beyond the level only. `row_um`: the residual of every row of the table.
[[nodiscard]] std::vector<RemainderFinding> look_at_remainder(const FlankGeometry& geometry,
                                                              const Observations& table,
                                                              const Patches& patches,
                                                              const std::vector<float>& row_um,
                                                              RemainderOf which);

/// What notes say of parts of all traces that scatter more than the rest, but no more than a probe
/// may make of them.
[[nodiscard]] std::vector<std::string> notes_on_rough_traces(const FlankGeometry& geometry,
                                                             const Observations& table,
                                                             const Patches& patches,
                                                             const std::vector<float>& row_um);

}  // namespace trueflank::loop
