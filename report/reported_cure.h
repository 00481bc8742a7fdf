// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/check/finding.h"

namespace trueflank::io {

/// The one change that mends a failing design, in the keys of its file, and what it costs.
struct ReportedCure {
  bool cured = false;  ///< every check passes then; false: the nearest that was found, which still fails
  bool search_ended = true;  ///< false: `trueflank fix` looks further
  struct Change {
    std::string key;            ///< "wheel.tip_diameter_mm"
    std::string before, after;  ///< as the file writes them; empty: not written
  };
  std::vector<Change> changes;  ///< empty: none was found
  struct Cost {
    double before = kNaN, after = kNaN;
  };
  struct MeshCost {
    std::string mesh;
    Cost contact_ratio;  ///< effective
  };
  std::vector<MeshCost> meshes;
  Cost forward, backward;     ///< efficiency
  Findings still_failing;     ///< of the changed design
  std::string contradiction;  ///< which checks contradict each other; empty where cured
};

/// Keys before and after, one a line, and what that costs.
[[nodiscard]] std::string cure_table(const ReportedCure& cure);
/// `joint_cure` of report.json.
[[nodiscard]] std::string cure_json_text(const ReportedCure& cure);

}  // namespace trueflank::io
