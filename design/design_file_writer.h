// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// A design as a design file; `comment` stands on top, each line behind a #.
/// Guarantees: read_design_text() gives the equal design back, every number to the last bit (angles
/// and thinning that no number of degrees or micrometres hits: to one unit in the last place).
/// Requires: what the reader demands of a file; not checked here.
[[nodiscard]] std::string design_file_text(const GearboxDesign& design,
                                           std::string_view comment = "");

/// A key as a design file says it.
struct WrittenKey {
  std::string table;  ///< "gearbox", "ring1.cutter"; empty: the top of the file
  std::string key, value;
};
/// Everything design_file_text() writes, in its order.
[[nodiscard]] std::vector<WrittenKey> written_keys(const GearboxDesign& design);

}  // namespace trueflank
