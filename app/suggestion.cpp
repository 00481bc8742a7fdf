// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/suggestion.h"

#include <algorithm>

namespace trueflank::app {
namespace {

/// Damerau-Levenshtein distance (optimal string alignment).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(const std::string& typed, const std::vector<std::string>& words) {
  constexpr std::size_t kLongestWord = 100;  // nobody mistypes more, and the table stays small
  if (typed.size() > kLongestWord) return {};
  std::size_t least = std::max<std::size_t>(typed.size(), 3) / 3 + 1;
  std::string nearest;
  for (const std::string& word : words)
    if (const std::size_t apart = distance(typed, word); apart < least) {
      least = apart;
      nearest = word;
    }
  return nearest;
}

}  // namespace trueflank::app
