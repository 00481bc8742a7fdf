// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace trueflank {

/// Where a printer lays parts down.
struct Bed {
  std::string name;
  double width_mm = 0.0, depth_mm = 0.0;
};

/// Beds by the names of printers; sizes as their makers state them.
[[nodiscard]] const std::vector<Bed>& standard_beds();
/// The bed of a name, or of a size as "250x210" in mm; nothing where the text is neither.
[[nodiscard]] std::optional<Bed> find_bed(const std::string& text);
/// What find_bed takes, for messages: the names, and how a size is written.
[[nodiscard]] std::vector<std::string> known_beds();

}  // namespace trueflank
