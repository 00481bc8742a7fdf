// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "trueflank/app/command_search.h"

namespace trueflank::app {

/// Ctrl-C and SIGTERM while one lives: the first asks for a stop, the second ends the program as
/// everywhere else.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;
  [[nodiscard]] static const std::atomic<bool>& flag();
};

/// The journal of a part: appended while a search runs, so that nothing found is lost.
class Journal {
 public:
  /// search.journal, or search-i-of-n.journal of a part.
  [[nodiscard]] static std::filesystem::path path_in(const std::string& folder,
                                                     const SearchPart& part);

  /// Records of the folder's journal where `resume` is asked; none otherwise. The file then starts
  /// with them. Errors: kInconsistent (a journal of other requirements), kDisk, ...
  [[nodiscard]] static Result<std::vector<SearchRecord>> open(const SearchTask& task,
                                                              const std::filesystem::path& path,
                                                              bool resume, Journal& journal);
  void append(const SearchRecord& record);
  /// Puts all records in their order: equal searches leave equal bytes.
  [[nodiscard]] Status close(const SearchTask& task, const std::vector<SearchRecord>& records);

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
  std::chrono::steady_clock::time_point flushed_{};
};

/// One line on a terminal that tells how far a search is and how long it will take; nothing elsewhere.
class ProgressLine {
 public:
  ProgressLine(std::size_t already_done, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(std::size_t finished, std::size_t total, const SearchRecord& record);

 private:
  bool active_ = false;
  std::size_t already_done_ = 0;
  double best_ = 0.0;
  std::chrono::steady_clock::time_point begun_, shown_;
};

}  // namespace trueflank::app
