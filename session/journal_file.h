// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <vector>

#include "trueflank/session/search_session.h"

namespace trueflank {

/// Errors: those of reading; kOutOfRange for what is longer than any journal of the task, or never ends; of
/// read_journal().
[[nodiscard]] Result<SearchJournal> read_journal_file(const SearchTask& task, const std::filesystem::path& path);

/// The journal of a part: appended while a search runs, so that nothing found is lost.
class JournalFile {
 public:
  /// What is in the journal where `resume` is asked; none otherwise. The file then starts with them.
  /// Errors: kInconsistent (a journal of other requirements), kDisk, ...
  [[nodiscard]] static Result<SearchJournal> open(const SearchTask& task,
                                                  const std::filesystem::path& path, bool resume,
                                                  JournalFile& journal);
  void append(const SearchRecord& record) { append_line(journal_line(record)); }
  void append_stage(const SearchRecord& stage) { append_line(journal_stage_line(stage)); }
  /// Writes it whole, in its order: equal searches leave equal bytes.
  [[nodiscard]] Status close(const SearchTask& task, const SearchJournal& written);

 private:
  void append_line(const std::string& line);

  std::filesystem::path path_;
  std::ofstream stream_;
  std::chrono::steady_clock::time_point flushed_{};
};

}  // namespace trueflank
