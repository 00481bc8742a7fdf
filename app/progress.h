// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trueflank::app {

/// One line on standard error that says what the program is at and since when: on a terminal alone, and
/// only where the work takes longer than a second. It is gone when this ends.
class Progress {
 public:
  /// `work`: "making parts".
  Progress(std::string work, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// How far it is: "12 files written". From any thread.
  void note(std::string text);

 private:
  void show();

  std::string work_, note_;
  bool ended_ = false;
  std::mutex mutex_;
  std::condition_variable woken_;
  std::jthread thread_;
};

}  // namespace trueflank::app
