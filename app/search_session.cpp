// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/search_session.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>

#include "trueflank/app/terminal.h"
#include "trueflank/design/design_file.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank::app {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

constexpr double kFlushEvery_s = 1.0;
constexpr double kShowEvery_s = 0.2;

std::atomic<bool> stop_asked{false};

extern "C" void ask_for_stop(int signal) {
  if (stop_asked.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

std::string time_text(double seconds) {
  char buffer[32];
  const long s = std::lround(seconds);
  if (s >= 3600)
    std::snprintf(buffer, sizeof buffer, "%ld h %02ld min", s / 3600, s / 60 % 60);
  else if (s >= 60)
    std::snprintf(buffer, sizeof buffer, "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(buffer, sizeof buffer, "%ld s", s);
  return buffer;
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

std::filesystem::path Journal::path_in(const std::string& folder, const SearchPart& part) {
  const std::filesystem::path path(folder);
  if (part.parts == 1) return path / "search.journal";
  return path / ("search-" + std::to_string(part.part) + "-of-" + std::to_string(part.parts) +
                 ".journal");
}

Result<std::vector<SearchRecord>> Journal::open(const SearchTask& task,
                                                const std::filesystem::path& path, bool resume,
                                                Journal& journal) {
  std::vector<SearchRecord> records;
  std::error_code ignored;
  if (resume && std::filesystem::exists(path, ignored)) {
    const auto text = read_text_file(path.string(), std::numeric_limits<std::size_t>::max());
    if (!text) return fail(text.error());
    auto read = read_journal(*text, task.requirements, task.enumeration);
    if (!read) {
      Error error = read.error();
      error.file = path.string();
      return fail(std::move(error));
    }
    records = std::move(*read);
  }
  journal.path_ = path;
  // whole first, so that a line cut short is gone; then it only grows
  if (auto ok = journal.close(task, records); !ok) return fail(ok.error());
  journal.stream_.open(path, std::ios::app | std::ios::binary);
  if (!journal.stream_)
    return fail({.code = ErrorCode::kDisk, .message = "cannot write the journal",
                 .file = path.string()});
  return records;
}

void Journal::append(const SearchRecord& record) {
  stream_ << journal_line(record) << '\n';
  const Clock::time_point now = Clock::now();
  if (duration<double>(now - flushed_).count() < kFlushEvery_s) return;
  stream_.flush();
  flushed_ = now;
}

Status Journal::close(const SearchTask& task, const std::vector<SearchRecord>& records) {
  if (stream_.is_open()) stream_.close();
  std::string text = journal_header(task.requirements, task.enumeration) + "\n";
  for (const SearchRecord& record : records) text += journal_line(record) + "\n";
  return io::write_file(path_, text);
}

ProgressLine::ProgressLine(std::size_t already_done, bool quiet)
    : active_(!quiet && isatty(STDERR_FILENO) != 0),
      already_done_(already_done),
      begun_(Clock::now()),
      shown_(begun_) {}

ProgressLine::~ProgressLine() {
  if (active_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(std::size_t finished, std::size_t total, const SearchRecord& record) {
  if (!active_) return;
  for (const SearchCandidate& candidate : record.result.candidates)
    best_ = std::max(best_, candidate.forward);
  const Clock::time_point now = Clock::now();
  if (duration<double>(now - shown_).count() < kShowEvery_s) return;
  shown_ = now;
  const double seconds = duration<double>(now - begun_).count();
  const double rate = static_cast<double>(finished - already_done_) / seconds;
  std::fprintf(stderr, "\r\033[K%zu of %zu tooth sets (%.0f %%), best %.2f %%, %.0f/s, %s left",
               finished, total, 100.0 * static_cast<double>(finished) / static_cast<double>(total),
               100.0 * best_, rate, time_text(static_cast<double>(total - finished) / rate).c_str());
  std::fflush(stderr);
}

}  // namespace trueflank::app
