// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "trueflank/design/requirements_keys.h"

// The sections of the requirements file, each by the source that holds its keys.
namespace trueflank::requirements {

using R = SearchRequirements;
using V = KeyValue;

/// A value whose type the key's rule has checked.
[[nodiscard]] inline double number(const V& v) { return std::get<double>(v); }
[[nodiscard]] inline int whole(const V& v) { return static_cast<int>(std::get<std::int64_t>(v)); }
[[nodiscard]] inline bool flag(const V& v) { return std::get<bool>(v); }
[[nodiscard]] inline const std::string& text(const V& v) { return std::get<std::string>(v); }

/// The words of "a, b, c".
[[nodiscard]] std::vector<std::string> words(const std::string& list);

// requirements_train_keys.cpp: what is searched, and within which teeth.
[[nodiscard]] RequirementsSection gearbox();
[[nodiscard]] RequirementsSection rack();
[[nodiscard]] RequirementsSection cutter();
[[nodiscard]] RequirementsSection ratio();
[[nodiscard]] RequirementsSection teeth();
[[nodiscard]] RequirementsSection shift();
// requirements_limit_keys.cpp: what every design keeps.
[[nodiscard]] RequirementsSection limits();
// requirements_load_keys.cpp: what drives it, and what it carries.
[[nodiscard]] RequirementsSection strength();
[[nodiscard]] RequirementsSection motor();
[[nodiscard]] RequirementsSection losses();
// requirements_search_keys.cpp: what is best, and how much of it is told.
[[nodiscard]] RequirementsSection search();

}  // namespace trueflank::requirements
