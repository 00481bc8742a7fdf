// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "trueflank/base/result.h"

namespace trueflank {

/// Looks at a text before a parser sees it: UTF-8 without NUL bytes, and outside of strings and
/// comments nothing but ASCII and no key of more than kDeepestToml parts. toml++ 3.3 has undefined
/// behaviour on some non-ASCII bare keys, and its tables are destroyed recursively.
/// Errors: kSyntax with the line.
[[nodiscard]] Status check_toml_text(std::string_view text);

}  // namespace trueflank
