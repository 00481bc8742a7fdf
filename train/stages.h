// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/gear_train.h"

// A train of several stages is laid out stage by stage: each is a train of its own, and the whole is their
// gears, one set above the other, on common shafts.
namespace trueflank {

/// A part of a topology as a topology of its own.
struct StageTopology {
  Topology topology;         ///< names of the whole; a body that is a carrier there and a gear here has the gear's
  std::vector<int> members;  ///< of the whole, in the order of the stage's
  int first_gear = 0;        ///< of the whole
  int first_mesh = 0;
};
/// In their order. The input of a stage is that of the train or the shaft of an earlier stage, its output that
/// of the train or the shaft of a later one.
[[nodiscard]] std::vector<StageTopology> stage_topologies(const Topology& topology);

/// A stage of a design as a design of its own. What the design says of all gears it says of this one's.
/// `stage` counts from 1. Requires: the design has it, and the gears of its topology.
[[nodiscard]] GearboxDesign stage_design(const GearboxDesign& design, int stage);

/// Puts what a stage's own design says back into the whole: numbers of planets, module, centre distance,
/// gears. What all stages share is taken from it as well.
void set_stage(const GearboxDesign& own, int stage, GearboxDesign& design);

/// The key of the whole design file for a key of a stage's: "gearbox.planets" is "stage2.planets" of stage 2.
[[nodiscard]] std::string key_of_stage(const std::string& key, int stage);

/// Heights of a train with the plates of its carrier [mm].
struct TrainHeights {
  double lower_mm = 0.0, upper_mm = 0.0;
};
[[nodiscard]] TrainHeights heights_of(const GearTrain& train);

/// lay_out() for a design of several stages: each stage laid out, stood layer_gap_mm above the one before, its
/// gears turned so that all shafts fit. Errors: of all stages, with keys of the whole.
[[nodiscard]] ResultAll<GearTrain> lay_out_stages(const GearboxDesign& design);

}  // namespace trueflank
