// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace trueflank {

/// The reference of the design file, docs/design-file.md, from the tables the reader goes by.
[[nodiscard]] std::string design_reference();

}  // namespace trueflank
