// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/journal_file.h"

#include <algorithm>
#include <cerrno>

#include "trueflank/design/design_file.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank {
namespace {

constexpr double kFlushEvery_s = 1.0;
/// More than a set's line takes, of which a journal has one of each; and than any journal.
constexpr std::size_t kMostBytesOfSet = 1U << 14, kMostBytesBeside = 1U << 20, kMostBytes = std::size_t{4} << 30;

}  // namespace

Result<SearchJournal> read_journal_file(const SearchTask& task, const std::filesystem::path& path) {
  const std::size_t most = std::min(kMostBytes, kMostBytesBeside + kMostBytesOfSet * (task.enumeration.sets.size() + task.enumeration.stages.size()));
  auto text = read_text_file(path.string(), most);
  if (!text) {
    if (text.error().code == ErrorCode::kOutOfRange) text.error().remedy = "a journal of these requirements";
    return fail(text.error());
  }
  auto read = read_journal(*text, task.requirements, task.enumeration);
  if (!read) read.error().file = path.string();
  return read;
}

Result<SearchJournal> JournalFile::open(const SearchTask& task, const std::filesystem::path& path,
                                        bool resume, JournalFile& journal) {
  SearchJournal found;
  std::error_code ignored;
  if (resume && std::filesystem::exists(path, ignored)) {
    auto read = read_journal_file(task, path);
    if (!read) return read;
    found = std::move(*read);
  }
  journal.path_ = path;
  // whole first, so that a line cut short is gone; then it only grows
  if (auto ok = journal.close(task, found); !ok) return fail(ok.error());
  errno = 0;
  journal.stream_.open(path, std::ios::app | std::ios::binary);
  if (!journal.stream_)
    return fail(io::file_error("write", path, errno != 0 ? errno : EIO));
  return found;
}

void JournalFile::append_line(const std::string& line) {
  stream_ << line << '\n';
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - flushed_).count() < kFlushEvery_s) return;
  stream_.flush();
  flushed_ = now;
}

Status JournalFile::close(const SearchTask& task, const SearchJournal& written) {
  if (stream_.is_open()) stream_.close();
  std::string text = journal_header(task.requirements, task.enumeration) + "\n";
  for (const SearchRecord& record : written.records) text += journal_line(record) + "\n";
  for (const SearchRecord& stage : written.stages) text += journal_stage_line(stage) + "\n";
  for (const SearchPart& part : written.ended) text += journal_end(part) + "\n";
  return io::write_file(path_, text);
}

}  // namespace trueflank
