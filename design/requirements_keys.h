// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/design/key_rule.h"
#include "trueflank/search/search_requirements.h"

namespace trueflank {

/// A key of the requirements file: its rule and where its value goes.
template <class Target>
struct RequirementsKey {
  KeyRule rule;
  /// Puts a value that obeys the rule. Returns what is wrong with it nevertheless; empty: nothing.
  std::string (*set)(Target&, const KeyValue&) = nullptr;
};

struct RequirementsSection {
  std::string name;  ///< empty: top of the file
  std::vector<RequirementsKey<SearchRequirements>> keys;
  /// Called where the file has the table, before its keys; null: the table alone says nothing.
  void (*begun)(SearchRequirements&) = nullptr;
};

/// The sections in their order.
[[nodiscard]] const std::vector<RequirementsSection>& requirements_sections();
/// `[material.NAME]`.
[[nodiscard]] const std::vector<RequirementsKey<Material>>& material_keys();

}  // namespace trueflank
