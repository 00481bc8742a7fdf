// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace trueflank {

/// What may be a design's name: 1 to 100 bytes of printable UTF-8.
[[nodiscard]] bool is_design_name(const std::string& text);

/// A name made of any text, a file's stem for one: what does not fit is left out; "gearbox" where
/// nothing is left or the text is no UTF-8.
[[nodiscard]] std::string design_name_from(const std::string& text);

}  // namespace trueflank
