// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/search/search.h"

// A search of a second that tests run in several ways.
namespace trueflank {

inline const SearchRequirements& requirements() {
  static const SearchRequirements r = [] {
    SearchRequirements q;
    q.ratio_min = 90;
    q.ratio_max = 100;
    q.sun = {12, 12};
    q.planet1 = {38, 39};
    q.planet2 = {34, 40};
    q.ring1 = {90, 93};
    q.ring2 = {84, 94};
    q.results = 3;
    return q;
  }();
  return r;
}
inline const SetEnumeration& sets() {
  static const SetEnumeration found = enumerate_sets(requirements());
  return found;
}
inline const SearchRecords& records() {
  static const SearchRecords found = run_search(requirements(), sets(), {.threads = 1});
  return found;
}
inline const SearchReport& report() {
  static const SearchReport found = conclude_search(requirements(), sets(), records(), {});
  return found;
}
inline std::string text_of(const std::vector<SearchRecord>& list) {
  std::string text = journal_header(requirements(), sets()) + "\n";
  for (const SearchRecord& record : list) text += journal_line(record) + "\n";
  return text;
}
inline std::string text_of(const SearchRecords& list) { return text_of(list.optimised); }

/// The same search with so few listed that most sets are passed over.
inline SearchRequirements listing(int listed) {
  SearchRequirements r = requirements();
  r.listed = listed;
  return r;
}

}  // namespace trueflank
