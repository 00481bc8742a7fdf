// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/design/key_rule.h"
#include "trueflank/search/search_requirements.h"

// The requirements file of a search (docs/requirements-file.md): TOML, every key says its unit.
namespace trueflank {

/// Reads and checks a whole requirements file; its own [material.NAME] tables extend `materials`.
/// Errors: all of the file at once, in the order of its lines, as read_design_file.
[[nodiscard]] ResultAll<SearchRequirements> read_requirements(const std::string& path,
                                                              MaterialTable materials = {});
/// The same of a text; `file` names it in errors, its stem is the name where it has none.
[[nodiscard]] ResultAll<SearchRequirements> read_requirements_text(std::string_view text,
                                                                   const std::string& file,
                                                                   MaterialTable materials = {});

/// Reads a table of materials, [material.NAME] with the keys of material_rules(), into a table that
/// may already have some. Errors: as above.
[[nodiscard]] ResultAll<MaterialTable> read_materials_text(std::string_view text,
                                                           const std::string& file,
                                                           MaterialTable table = {});
[[nodiscard]] ResultAll<MaterialTable> read_materials(const std::string& path,
                                                      MaterialTable table = {});

/// Every table of the file with the rules of its keys, in order: what docs/requirements-file.md
/// lists.
struct RequirementsTable {
  std::string name;  ///< empty: top of the file
  std::vector<KeyRule> rules;
};
[[nodiscard]] std::vector<RequirementsTable> requirements_tables();

}  // namespace trueflank
