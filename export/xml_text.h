// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace trueflank::io {

/// Text for element content or an attribute in double quotes; control characters are left out.
[[nodiscard]] std::string xml_escaped(std::string_view text);
/// The inverse; knows the five named entities and numeric ones.
[[nodiscard]] std::string xml_unescaped(std::string_view text);

}  // namespace trueflank::io
