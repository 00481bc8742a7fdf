// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/search_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "trueflank/app/terminal.h"
#include "trueflank/base/number_text.h"

namespace trueflank::app {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

constexpr double kShowEvery_s = 0.2;

std::atomic<bool> stop_asked{false};

extern "C" void ask_for_stop(int signal) {
  if (stop_asked.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

std::string time_text(double seconds) {
  const long s = std::lround(seconds);
  if (s >= 3600) return printed("%ld h %02ld min", s / 3600, s / 60 % 60);
  if (s >= 60) return printed("%ld min %02ld s", s / 60, s % 60);
  return printed("%ld s", s);
}

}  // namespace

StopOnInterrupt::StopOnInterrupt() {
  stop_asked = false;
  struct sigaction action{};
  action.sa_handler = ask_for_stop;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}
StopOnInterrupt::~StopOnInterrupt() { install_interrupt_handlers(); }
const std::atomic<bool>& StopOnInterrupt::flag() { return stop_asked; }

SearchProgress::SearchProgress(bool quiet)
    : active_(!quiet && isatty(STDERR_FILENO) != 0),
      begun_(Clock::now()),
      shown_(begun_) {}

SearchProgress::~SearchProgress() {
  if (active_) std::fputs("\r\033[K", stderr);
}

bool SearchProgress::is_time() {
  const Clock::time_point now = Clock::now();
  if (duration<double>(now - shown_).count() < kShowEvery_s) return false;
  shown_ = now;
  return true;
}

void SearchProgress::show_stages(std::size_t optimised, std::size_t stages) {
  if (!active_ || !is_time()) return;
  std::fprintf(stderr, "\r\033[K%zu of at most %zu stages of trains in series", optimised, stages);
  std::fflush(stderr);
}

void SearchProgress::show(std::size_t finished, std::size_t total, const SearchRecord& record) {
  if (!active_) return;
  if (first_ == 0) first_ = finished;
  for (const SearchCandidate& candidate : record.result.candidates)
    best_ = std::max(best_, candidate.forward);
  if (!is_time()) return;
  const double seconds = duration<double>(shown_ - begun_).count();
  const double rate = static_cast<double>(finished + 1 - first_) / seconds;
  std::fprintf(stderr, "\r\033[K%zu of %zu tooth sets (%.0f %%), best %.2f %%, %.0f/s, %s left",
               finished, total, 100.0 * static_cast<double>(finished) / static_cast<double>(total),
               100.0 * best_, rate, time_text(static_cast<double>(total - finished) / rate).c_str());
  std::fflush(stderr);
}

}  // namespace trueflank::app
