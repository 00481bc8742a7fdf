// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/design/key_rule.h"
#include "trueflank/geometry/gear.h"
#include "trueflank/train/machine/elements.h"
#include "trueflank/train/process.h"

// Tools, processes and what is bought by name: the built-in ones and a user's own, [rack.NAME],
// [cutter.NAME], [process.NAME] (docs/made.md), [motor.NAME], [bearing.NAME] and [screw.NAME]
// (docs/gearbox.md) in a TOML file.
namespace trueflank {

/// A rack-type tool.
struct RackTool {
  std::string name;
  BasicRack rack;
  double dedendum_plus_mm = 0.0;  ///< added to the dedendum whatever the module (fine-pitch racks)
  std::string source = {};

  [[nodiscard]] BasicRack at_module(double module_mm) const;
};

/// A pinion cutter, of a number of teeth or of a nominal pitch diameter.
struct CutterTool {
  std::string name;
  int teeth = 0;                   ///< 0: by the diameter
  double pitch_diameter_mm = 0.0;  ///< the nearest whole number of teeth is taken
  double shift = 0.0;
  double tip_radius = 0.2;
  std::string source = {};

  [[nodiscard]] ShaperCutter at_module(double module_mm) const;
};

struct ToolTables {
  std::vector<RackTool> racks;
  std::vector<CutterTool> cutters;
  ProcessTable processes = {};
  MachineElements elements = standard_elements();  ///< motors, bearings, screws
};

/// The built-in tools: racks of ISO 53, JIS B 1701, DIN 867 and AGMA fine pitch, full-radius and
/// protuberance racks; cutters by nominal pitch diameter.
[[nodiscard]] const ToolTables& standard_tools();

[[nodiscard]] const RackTool* find_rack(const ToolTables& tools, std::string_view name);
[[nodiscard]] const CutterTool* find_cutter(const ToolTables& tools, std::string_view name);
/// All names of a table, for messages.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<RackTool>& racks);
[[nodiscard]] std::vector<std::string> names_of(const std::vector<CutterTool>& cutters);
[[nodiscard]] std::vector<std::string> names_of(const ProcessTable& processes);

/// Adds a file's tables to some; a name that is there already is replaced. Errors: all of the file at
/// once, as read_design_file.
[[nodiscard]] ResultAll<ToolTables> read_tools(const std::string& path,
                                               ToolTables tools = standard_tools());
[[nodiscard]] ResultAll<ToolTables> read_tools_text(std::string_view text, const std::string& file,
                                                    ToolTables tools = standard_tools());

/// Keys of each kind of table, for the documentation's test.
[[nodiscard]] std::vector<KeyRule> tool_key_rules(std::string_view kind);

}  // namespace trueflank
