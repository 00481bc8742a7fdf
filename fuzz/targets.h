// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

// What reads bytes from outside, one target a reader. Each is run by libFuzzer
// (docs/reliability.md) and, with its corpus, as an ordinary test. An input is good or bad; what it
// must not do is end the program, take memory or time out of all proportion, or be taken for
// something it is not.
namespace trueflank::fuzz {

struct Target {
  std::string_view name;  ///< also of its folder in corpus/
  void (*run)(std::string_view bytes);
};
[[nodiscard]] const std::vector<Target>& targets();
/// nullptr where there is none of this name.
[[nodiscard]] const Target* find_target(std::string_view name);

}  // namespace trueflank::fuzz
