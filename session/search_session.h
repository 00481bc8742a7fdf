// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/search/search.h"

// A search from its requirements file to the folder of its answer: in one run, or in parts on several
// machines that are merged (docs/search.md).
namespace trueflank {

struct SearchTask {
  SearchRequirements requirements;
  SetEnumeration enumeration;
};
/// Reads requirements, and a file of more materials unless that is empty, and enumerates.
[[nodiscard]] ResultAll<SearchTask> prepare_search(const std::string& requirements_file,
                                                   const std::string& materials_file = {});

/// What every check says of a design: the judge of a search.
[[nodiscard]] DesignVerdict judged_by_checks(const GearTrain& train);

struct SearchPartOptions {
  std::filesystem::path folder;  ///< of the journal
  SearchPart part = {};
  int threads = 0;               ///< 0: as many as the machine has
  bool resume = false;           ///< go on with the folder's journal
  const std::atomic<bool>* stop = nullptr;  ///< set: what is under way is finished, no more started
  /// Called for every new record, one call at a time.
  std::function<void(const SearchRecord&, std::size_t finished, std::size_t total)> on_record = {};
  /// Likewise of stages of trains in series, which are optimised last.
  std::function<void(const SearchRecord&, std::size_t finished)> on_stage = {};
};
/// search.journal, or search-i-of-n.journal of a part.
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& folder,
                                                 const SearchPart& part);
/// Runs a part with its journal in the folder. Returns its records, old and new; of fewer sets than the
/// part has, or with stages left, where it was stopped.
/// Errors: kInconsistent (a journal of other requirements), kDisk, ...
[[nodiscard]] ResultAll<SearchRecords> run_search_part(const SearchTask& task,
                                                                   const SearchPartOptions& options);
/// Whether a part's records leave nothing to do.
[[nodiscard]] bool is_complete(const SearchTask& task, const SearchRecords& records,
                               const SearchPart& part = {});

/// All records of the journals in some folders, by index. Errors: kInconsistent where they are not all
/// of the task's.
[[nodiscard]] ResultAll<SearchRecords> merge_search(const SearchTask& task,
                                                                const std::vector<std::string>& folders);

/// What journals, read one after the other, hold together; of fewer sets than the task has where some
/// are missing.
[[nodiscard]] SearchRecords gathered_records(const SearchTask& task, SearchJournal journal);

/// Ranks records and lets the checks judge.
[[nodiscard]] SearchReport finish_search(const SearchTask& task, const SearchRecords& records);
/// Writes design files, search.csv, search.json, search.svg and search.html into a folder; design files
/// of an earlier search go.
[[nodiscard]] Status write_search(const SearchTask& task, const SearchReport& report,
                                  const std::filesystem::path& folder);

}  // namespace trueflank
