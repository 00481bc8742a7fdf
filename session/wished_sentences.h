// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/search/search.h"
#include "trueflank/session/known_wishes.h"

namespace trueflank {

/// What was found for wishes, and for which.
struct WishedAnswer {
  const DesignWishes& wishes;
  const KnownWishes& known;
  const FoundDesign& found;
  const SearchReport& report;
  const GearboxDesign& design;  ///< with what is around the gears
  const Motor* motor = nullptr;
  bool filed = false;  ///< a flat is filed on the motor's shaft
};

/// What was chosen and why, a sentence each.
[[nodiscard]] std::vector<std::string> wished_sentences(const WishedAnswer& answer);

}  // namespace trueflank
