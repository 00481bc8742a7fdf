// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/design/toml_document.h"

namespace trueflank {

/// A key that the file has in inches, and the one it stands for.
struct InchKey {
  std::string written;  ///< dotted: "gearbox.centre_distance_in", "gearbox.diametral_pitch"
  std::string metric;   ///< "gearbox.centre_distance_mm", "gearbox.module_mm"
  std::string value;    ///< as the file writes it
  int line = 0;
  bool twice = false;   ///< the metric key is there too; that one is kept
};

/// Puts millimetres for inches: NAME_in becomes NAME_mm = 25.4 times it, diametral_pitch becomes
/// module_mm = 25.4 over it; what is no number keeps its value. Returns what was renamed.
[[nodiscard]] std::vector<InchKey> to_metric(TomlTable& root);

}  // namespace trueflank
