// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/progress.h"

#include <unistd.h>

#include <chrono>
#include <utility>

#include "trueflank/app/terminal.h"
#include "trueflank/base/threads.h"

namespace trueflank::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kShownAfter{1};
constexpr std::chrono::milliseconds kShownEvery{250};

void write_to_terminal(const std::string& text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

Progress::Progress(std::string work, bool quiet) : work_(without_control(work)) {
  if (quiet || isatty(STDERR_FILENO) == 0) return;
  auto threads = helping_threads(1, [this] { show(); });
  if (!threads.empty()) thread_ = std::move(threads.front());
}

Progress::~Progress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  woken_.notify_one();
  thread_.join();
}

void Progress::note(std::string text) {
  const std::lock_guard lock(mutex_);
  note_ = without_control(text);
}

void Progress::show() {
  const Clock::time_point begun = Clock::now();
  std::unique_lock lock(mutex_);
  if (woken_.wait_for(lock, kShownAfter, [this] { return ended_; })) return;
  do {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begun).count();
    write_to_terminal("\r\033[K" + work_ + (note_.empty() ? "" : ": " + note_) + ", " +
                      std::to_string(seconds) + " s");
  } while (!woken_.wait_for(lock, kShownEvery, [this] { return ended_; }));
  write_to_terminal("\r\033[K");
}

}  // namespace trueflank::app
