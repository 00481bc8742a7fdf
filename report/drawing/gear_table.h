// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "trueflank/export/part_dimensions.h"

// The table of gear data on a workshop drawing, in the order of DIN 3966 and ISO 1340.
namespace trueflank::io {

struct GearTableRow {
  std::string name;    ///< "Profile shift coefficient"
  std::string symbol;  ///< "x"; may be empty
  std::vector<std::string>
      values;  ///< one a gear of the part; two, mm and inches, of a design in inches
};

/// Rows of the gears of one part. Every number is that of report.json (`report`: the whole
/// document), rounded to what a workshop reads; tolerances are those of the class of ISO
/// 1328-1:2013 that workmanship() has, or what the process holds.
[[nodiscard]] std::vector<GearTableRow> gear_table(const GearTrain& train,
                                                   const std::vector<const TrainGear*>& gears,
                                                   const nlohmann::ordered_json& report);

}  // namespace trueflank::io
