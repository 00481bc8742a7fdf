// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/design/tools_file.h"

namespace trueflank {
namespace {

BasicRack rack(double addendum, double dedendum, double root_radius) {
  BasicRack r;
  r.addendum = addendum;
  r.dedendum = dedendum;
  r.root_radius = root_radius;
  return r;
}

BasicRack full_radius(double dedendum) {
  BasicRack r = rack(1.0, dedendum, 0.0);
  r.root_radius = full_round_coefficient(r);
  return r;
}

BasicRack protuberance(double amount, double angle_deg, double stock) {
  BasicRack r = rack(1.0, 1.4, 0.38);
  r.protuberance = amount;
  r.protuberance_angle_rad = rad_from_deg(angle_deg);
  r.grinding_stock = stock;
  return r;
}

constexpr const char* kIso53 = "ISO 53:1998, table 2";
constexpr const char* kJis = "JIS B 1701-1:1999, which adopts ISO 53";
constexpr const char* kGeneric =
    "generic: a nominal pitch diameter in common use, no standard's table; tip radius assumed";

template <class Tool>
const Tool* find_in(const std::vector<Tool>& tools, std::string_view name) {
  const auto it =
      std::find_if(tools.begin(), tools.end(), [&](const Tool& t) { return t.name == name; });
  return it == tools.end() ? nullptr : &*it;
}

template <class Tools>
std::vector<std::string> names(const Tools& tools) {
  std::vector<std::string> list;
  for (const auto& tool : tools) list.push_back(tool.name);
  return list;
}

}  // namespace

BasicRack RackTool::at_module(double module_mm) const {
  BasicRack r = rack;
  r.dedendum += dedendum_plus_mm / module_mm;
  return r;
}

ShaperCutter CutterTool::at_module(double module_mm) const {
  const int count =
      teeth > 0 ? teeth : std::max(5, static_cast<int>(std::lround(pitch_diameter_mm / module_mm)));
  return {.teeth = count, .shift = shift, .tip_radius = tip_radius};
}

const ToolTables& standard_tools() {
  static const ToolTables tables{
      .racks = {{"ISO53-A", rack(1.0, 1.25, 0.38), 0.0, kIso53},
                {"ISO53-B", rack(1.0, 1.25, 0.30), 0.0, kIso53},
                {"ISO53-C", rack(1.0, 1.25, 0.25), 0.0, kIso53},
                {"ISO53-D", rack(1.0, 1.40, 0.39), 0.0, kIso53},
                {"JIS-B1701-A", rack(1.0, 1.25, 0.38), 0.0, kJis},
                {"JIS-B1701-B", rack(1.0, 1.25, 0.30), 0.0, kJis},
                {"JIS-B1701-C", rack(1.0, 1.25, 0.25), 0.0, kJis},
                {"JIS-B1701-D", rack(1.0, 1.40, 0.39), 0.0, kJis},
                {"AGMA-fine-pitch", rack(1.0, 1.20, 0.0), 0.0508,
                 "AGMA 207 (20 diametral pitch and finer): dedendum 1.2/P + 0.002 in; it gives no "
                 "root radius, so the corner is sharp"},
                {"full-radius-1.25", full_radius(1.25), 0.0, "full round of ISO 53 A's depth"},
                {"full-radius-1.4", full_radius(1.4), 0.0, "full round of ISO 53 D's depth"},
                {"protuberance", protuberance(0.05, 10.0, 0.0), 0.0,
                 "typical, no standard: undercut for shaving or honing"},
                {"protuberance-grind", protuberance(0.08, 10.0, 0.05), 0.0,
                 "typical, no standard: undercut and stock for grinding"}},
      .cutters = {{"shank-25", 0, 25.0, 0.0, 0.2, kGeneric},
                  {"shank-38", 0, 38.0, 0.0, 0.2, kGeneric},
                  {"disc-50", 0, 50.0, 0.0, 0.2, kGeneric},
                  {"disc-75", 0, 75.0, 0.0, 0.2, kGeneric},
                  {"disc-100", 0, 100.0, 0.0, 0.2, kGeneric},
                  {"disc-125", 0, 125.0, 0.0, 0.2, kGeneric}}};
  return tables;
}

const RackTool* find_rack(const ToolTables& tools, std::string_view name) {
  return find_in(tools.racks, name);
}
const CutterTool* find_cutter(const ToolTables& tools, std::string_view name) {
  return find_in(tools.cutters, name);
}
std::vector<std::string> names_of(const std::vector<RackTool>& racks) { return names(racks); }
std::vector<std::string> names_of(const std::vector<CutterTool>& cutters) { return names(cutters); }
std::vector<std::string> names_of(const ProcessTable& processes) { return names(processes.all()); }

}  // namespace trueflank
