// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/loop/drive/close_drive_loop.h"

namespace trueflank::loop {

/// The design with what the bench found in `friction` and `[losses]`.
struct CalibratedDesign {
  std::optional<GearboxDesign> design;  ///< empty where nothing was found that it could carry
  std::vector<std::string> notes;       ///< what it does not carry and why
};

/// Efficiencies are told at the bench's middle load and speed. Sensor effects, waves over the angle (they
/// cancel over a turn) and unnamed structure are not carried.
[[nodiscard]] CalibratedDesign calibrated_design(const GearboxDesign& design, const DriveLoop& closed);

}  // namespace trueflank::loop
