// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/train/search.h"

// `trueflank search`: requirements in, ranked design files, a table and a plot out (docs/search.md).
namespace trueflank::app {

struct SearchOptions {
  std::string requirements;
  std::string folder;
  std::string materials;           ///< file with more [material.NAME]; empty: none
  int threads = 0;                 ///< 0: as many as the machine has
  bool resume = false;             ///< go on with the folder's journal
  std::string shard;               ///< "i/n": only that part, and only its journal; empty: all
  std::vector<std::string> merge;  ///< folders whose journals together are the whole search
  bool quiet = false;
};
int run_search(const SearchOptions& options);

/// @name What the command and its MPI twin share
/// @{
struct SearchTask {
  SearchRequirements requirements;
  SetEnumeration enumeration;
};
/// Reads requirements (and materials) and enumerates.
[[nodiscard]] ResultAll<SearchTask> prepare_search(const SearchOptions& options);
/// What every check says of a design: the judge of a search.
[[nodiscard]] DesignVerdict judged_by_checks(const GearTrain& train);
/// "i/n". Errors: kUsage.
[[nodiscard]] Result<SearchPart> parse_shard(const std::string& text);
/// Runs a part, journal in the folder, with progress and Ctrl-C. Returns its records, old and new;
/// fewer than the part has where it was stopped.
[[nodiscard]] ResultAll<std::vector<SearchRecord>> run_search_part(const SearchTask& task,
                                                                   const SearchPart& part,
                                                                   const SearchOptions& options);
/// Ranks and judges records, writes design files, search.csv, search.json, search.svg and search.html into
/// the folder, and prints the summary. Returns the exit code: 0; 3 where records are missing (stopped).
[[nodiscard]] int finish_search(const SearchTask& task, const std::vector<SearchRecord>& records,
                                const SearchOptions& options);
/// @}

}  // namespace trueflank::app
