// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/process.h"

#include <algorithm>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// Of beads on beads: each lies half on the one below.
constexpr double kOverhang_rad = 0.25 * kPi;

}  // namespace

// Walls, tips and gaps of printing: published design guides of print services (two beads of an FDM
// nozzle; SLA 0.5 mm; SLS 0.7 mm and gaps of 0.5 mm for moving parts). All else, and everything of
// wire-edm and cnc-hobbing, is typical: to be replaced by what one's own machine does.
ProcessTable::ProcessTable()
    : processes_{
          {.name = "fdm-0.25", .nozzle_mm = 0.25, .layer_mm = 0.1, .least_wall_mm = 0.5,
           .least_tip_mm = 0.25, .least_gap_mm = 0.2, .backlash_mm = 0.10,
           .horizontal_expansion_mm = 0.03, .elephant_foot_mm = 0.1, .elephant_foot_height_mm = 0.2,
           .ledge_mm = 0.8, .bridge_mm = 12.0,
           .overhang_rad = kOverhang_rad,
           .axis_tolerance_mm = 0.03, .thickness_tolerance_mm = 0.03, .runout_mm = 0.06,
           .source = "typical: wall two beads, tip one bead"},
          {.name = "fdm-0.4", .nozzle_mm = 0.4, .layer_mm = 0.2, .least_wall_mm = 0.8,
           .least_tip_mm = 0.4, .least_gap_mm = 0.3, .backlash_mm = 0.15,
           .horizontal_expansion_mm = 0.05, .elephant_foot_mm = 0.15,
           .elephant_foot_height_mm = 0.4,
           .ledge_mm = 1.0, .bridge_mm = 15.0,
           .overhang_rad = kOverhang_rad,
           .axis_tolerance_mm = 0.04, .thickness_tolerance_mm = 0.04, .runout_mm = 0.08,
           .source = "wall: print services' design guides (two beads, 0.8 mm); the rest typical"},
          {.name = "fdm-0.6", .nozzle_mm = 0.6, .layer_mm = 0.3, .least_wall_mm = 1.2,
           .least_tip_mm = 0.6, .least_gap_mm = 0.4, .backlash_mm = 0.25,
           .horizontal_expansion_mm = 0.08, .elephant_foot_mm = 0.2, .elephant_foot_height_mm = 0.6,
           .ledge_mm = 1.5, .bridge_mm = 15.0,
           .overhang_rad = kOverhang_rad,
           .axis_tolerance_mm = 0.06, .thickness_tolerance_mm = 0.06, .runout_mm = 0.12,
           .source = "typical: wall two beads, tip one bead"},
          {.name = "sla", .nozzle_mm = 0.05, .layer_mm = 0.05, .least_wall_mm = 0.5,
           .least_tip_mm = 0.3, .least_gap_mm = 0.2, .backlash_mm = 0.08,
           .horizontal_expansion_mm = 0.02, .elephant_foot_mm = 0.05,
           .elephant_foot_height_mm = 0.3,
           .axis_tolerance_mm = 0.02, .thickness_tolerance_mm = 0.02, .runout_mm = 0.04,
           .source = "wall: print services' design guides (0.5 mm); the rest typical"},
          {.name = "sls", .nozzle_mm = 0.4, .layer_mm = 0.1, .least_wall_mm = 0.7,
           .least_tip_mm = 0.5, .least_gap_mm = 0.5, .backlash_mm = 0.2,
           .axis_tolerance_mm = 0.05, .thickness_tolerance_mm = 0.05, .runout_mm = 0.1,
           .source = "wall and gap: print services' design guides (0.7 and 0.5 mm); the rest typical"},
          {.name = "wire-edm", .least_wall_mm = 0.3, .least_tip_mm = 0.05, .least_gap_mm = 0.3,
           .least_root_radius_mm = 0.15, .backlash_mm = 0.02, .kerf_mm = 0.3,
           .axis_tolerance_mm = 0.005, .thickness_tolerance_mm = 0.005, .runout_mm = 0.01,
           .source = "typical: wire of 0.25 mm with a spark gap of 0.025 mm on either side"},
          {.name = "laser", .least_wall_mm = 0.5, .least_tip_mm = 0.3, .least_gap_mm = 0.3,
           .least_root_radius_mm = 0.1, .backlash_mm = 0.1, .kerf_mm = 0.2,
           .axis_tolerance_mm = 0.03, .thickness_tolerance_mm = 0.03, .runout_mm = 0.05,
           .source = "typical: sheet of 1 to 3 mm"},
          {.name = "cnc-hobbing", .least_wall_mm = 1.0, .least_tip_mm = 0.1, .backlash_mm = 0.05,
           .tolerance_class = 8, .axis_tolerance_mm = 0.01, .thickness_tolerance_mm = 0.01, .runout_mm = 0.03,
           .source = "typical"},
          // Names for how a part is made, without limits of their own.
          {.name = "hobbing", .source = "no limits"},
          {.name = "shaping", .source = "no limits"},
          {.name = "grinding", .source = "no limits"},
          {.name = "milling", .source = "no limits"},
          {.name = "moulding", .source = "no limits"},
          {.name = "sintering", .source = "no limits"},
      } {}

void ProcessTable::set(Process process) {
  const auto it = std::find_if(processes_.begin(), processes_.end(),
                               [&](const Process& p) { return p.name == process.name; });
  if (it != processes_.end())
    *it = std::move(process);
  else
    processes_.push_back(std::move(process));
}

const Process* ProcessTable::find(const std::string& name) const {
  const auto it = std::find_if(processes_.begin(), processes_.end(),
                               [&](const Process& p) { return p.name == name; });
  return it == processes_.end() ? nullptr : &*it;
}

}  // namespace trueflank
