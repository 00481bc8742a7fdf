// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {

/// A commented design file to start from: reads without error, passes every check and
/// makes at once. `name` becomes the design's name (any text; what does not
/// fit a name is left out).
[[nodiscard]] std::string new_design_text(const TrainKind& kind, const std::string& name);

}  // namespace trueflank
