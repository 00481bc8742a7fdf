// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>

#include "trueflank/session/search_session.h"

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

/// One line on a terminal that tells how far a search is and how long it will take; nothing elsewhere.
class SearchProgress {
 public:
  explicit SearchProgress(bool quiet);
  ~SearchProgress();
  SearchProgress(const SearchProgress&) = delete;
  SearchProgress& operator=(const SearchProgress&) = delete;
  void show(std::size_t finished, std::size_t total, const SearchRecord& record);
  /// Of trains in series; most stages need not be optimised.
  void show_stages(std::size_t optimised, std::size_t stages);

 private:
  [[nodiscard]] bool is_time();

  bool active_ = false;
  std::size_t first_ = 0;  ///< finished when it was first shown: earlier ones are of a journal
  double best_ = 0.0;
  std::chrono::steady_clock::time_point begun_, shown_;
};

}  // namespace trueflank::app
