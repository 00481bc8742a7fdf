// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/session/search_session.h"

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
/// "i/n". Errors: kUsage.
[[nodiscard]] Result<SearchPart> parse_shard(const std::string& text);
/// Runs a part, journal in the folder, with progress and Ctrl-C. Returns its records, old and new; of
/// fewer sets than the part has where it was stopped.
[[nodiscard]] ResultAll<SearchRecords> run_part(const SearchTask& task, const SearchPart& part,
                                                            const SearchOptions& options);
/// Ranks and judges records, writes the search's files into the folder, and prints the summary.
/// Returns the exit code: 0; 3 where records are missing (stopped).
[[nodiscard]] int conclude(const SearchTask& task, const SearchRecords& records,
                           const SearchOptions& options);
/// @}

}  // namespace trueflank::app
