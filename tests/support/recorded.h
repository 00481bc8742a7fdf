// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>

// Figures as they were when somebody last looked at them, for what has no formula: the way of a
// search, the vertices of a net. They say that something changed, not that it is wrong: whoever
// changes it on purpose looks at the new figures and writes them down (TRUEFLANK_RECORD=1 prints
// them).
namespace trueflank::test {

/// `recorded`: a line for each case, its number, a colon and the text that `text_of` gives of it.
inline void expect_as_recorded(const char* recorded,
                               const std::function<std::string(int)>& text_of) {
  std::istringstream lines(recorded);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string number = line.substr(0, colon), now = text_of(std::stoi(number));
    if (std::getenv("TRUEFLANK_RECORD") != nullptr)
      std::cout << number << ": " << now << '\n';
    else
      EXPECT_EQ(now, line.substr(colon + 2)) << "case " << number;
  }
}

}  // namespace trueflank::test
