// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

// `trueflank shifts`: the efficiency of one tooth set over its shifts (docs/search.md).
namespace trueflank::app {

struct ShiftsOptions {
  std::string requirements;
  std::string teeth;  ///< "12/39/90/32/81", in the order of the design file's gears
  std::string folder;
  int points = 121;  ///< along each axis
  bool quiet = false;
};
int run_shifts(const ShiftsOptions& options);

}  // namespace trueflank::app
