// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "trueflank/loop/gear/declared_effect.h"

namespace trueflank {

/// Reads effects that a user declares (docs/loop.md): a TOML table an effect, its formulas in
/// `form`. Errors: all of the file at once, with file and line; nothing there to read is an error
/// too.
[[nodiscard]] ResultAll<loop::DeclaredFamilies> read_effects_file(const std::string& path);
[[nodiscard]] ResultAll<loop::DeclaredFamilies> read_effects_text(std::string_view text,
                                                                  const std::string& path);

}  // namespace trueflank
