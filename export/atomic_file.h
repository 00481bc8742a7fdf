// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "trueflank/base/result.h"

// The one way in which this program writes: a file stands under its final name whole or not at all.
namespace trueflank::io {

/// A file being written under a temporary name in the folder of its target, renamed to the target by
/// commit(). Without commit() nothing is left. A target that exists keeps its permissions; symbolic
/// links are followed. What is no regular file (a device, a pipe) and what is an open descriptor of
/// this process (/dev/stdout, /proc/self/fd/N) is written to directly and never replaced.
/// Not guaranteed: survival of a power failure (no fsync, docs/decisions/0030-files-without-fsync.md).
class AtomicFile {
 public:
  /// Errors: kFileNotFound (no such folder), kPermission, kDisk, kInterrupted; with the path and the
  /// system's own words.
  [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  void write(std::string_view bytes);
  /// For writers that format in place: append to buffer(), then call flush_when_full() now and then.
  [[nodiscard]] std::string& buffer() { return buffer_; }
  void flush_when_full() {
    if (buffer_.size() >= kChunkBytes) flush();
  }
  /// Bytes written so far.
  [[nodiscard]] std::uint64_t size() const { return flushed_bytes_ + buffer_.size(); }

  /// Writes what is left and gives the file its name; the first thing that went wrong since create().
  [[nodiscard]] Status commit();

 private:
  AtomicFile() = default;
  void flush();
  void discard() noexcept;

  static constexpr std::size_t kChunkBytes = 800'000;  // best of 64 kB ... 8 MB for 100 MB of STL
  std::string buffer_;
  std::uint64_t flushed_bytes_ = 0;
  int descriptor_ = -1;
  int error_number_ = 0;          // of the first write that failed
  int slot_ = -1;                 // in the registry of temporary names; -1: written directly
  std::string path_;              // as the user gave it
  std::string target_, temporary_;
};

/// The whole content at once. Errors: as AtomicFile's.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view content);

/// Creates a folder and those above it, and removes from it the temporary files of processes that
/// were killed. Errors: kPermission, kDisk (a file stands there).
[[nodiscard]] Status create_folder(const std::filesystem::path& path);

/// Removes the temporary files this process is writing and lets no more be begun or committed.
/// Async-signal-safe: for handlers of SIGINT, SIGTERM and SIGHUP, which should _exit() afterwards.
void remove_temporary_files() noexcept;

/// The error of a failed system call on a path: kFileNotFound, kPermission or kDisk, with the system's
/// words, the limit that was met as its value, and what would help.
[[nodiscard]] Error file_error(std::string_view what, const std::filesystem::path& path,
                               int error_number);

}  // namespace trueflank::io
