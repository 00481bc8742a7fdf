// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "trueflank/base/result.h"

namespace trueflank::io {

/// A file, pipe or device to read from its beginning to its end. The number of the first error stays.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// errno of the first error; 0: none.
  [[nodiscard]] int error_number() const { return error_number_; }
  /// Bytes; nothing for pipes and devices.
  [[nodiscard]] std::optional<std::size_t> regular_size() const;
  /// Whether a large file holds next to nothing: a thousandth of it or less has been written, the rest was only
  /// reserved and reads as zeros. False where the file system does not tell.
  [[nodiscard]] bool is_hollow() const;
  /// Whether it is a device that gives characters, like a terminal.
  [[nodiscard]] bool is_device() const { return error_number_ == 0 && S_ISCHR(status_.st_mode); }
  /// What comes next, at least one byte; returns its size, 0 at the end and after an error.
  std::size_t read(char* into, std::size_t room);
  /// As read(), but all that fits.
  std::size_t fill(char* into, std::size_t room);

 private:
  int descriptor_ = -1, error_number_ = 0;
  struct stat status_ {};
};

/// Sizes are known before a file is read, and must be below this; what has no size may never end. A
/// device is a terminal at best, and not a mesh.
constexpr std::size_t kMostBytesOfFile = 0xfffffffe, kMostBytesOfPipe = 256U << 20,
                      kMostBytesOfDevice = 1U << 20;

/// A whole file. Errors: kFileNotFound, kPermission, kDisk (also for a folder); kSyntax for one that is hollow;
/// kUnsupported beyond most_bytes, and for pipes and devices beyond kMostBytesOfPipe and kMostBytesOfDevice. Memory: at
/// most what is read and a megabyte.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::size_t most_bytes = kMostBytesOfFile);

}  // namespace trueflank::io
