// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trueflank {

/// Removes the files that the folder's report.json lists and that have the size it states: parts of an
/// earlier design. What a person changed, and everything else in the folder, stays. Returns their names;
/// none where there is no such report.
std::vector<std::string> remove_earlier_files(const std::filesystem::path& folder);

}  // namespace trueflank
