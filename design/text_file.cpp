// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading a file by the system's own calls: what failed is then known, not guessed.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "trueflank/base/system_failure.h"
#include "trueflank/design/design_file.h"

namespace trueflank {
namespace {

Error system_error(const std::string& path, int code) {
  const SystemFailure why = system_failure(code, SystemUse::kRead);
  Error error{.code = ErrorCode::kDisk,
              .message = "cannot read " + path + ": " + why.reason,
              .value = why.limit,
              .remedy = why.remedy.empty() ? "a readable file" : why.remedy,
              .file = path};
  if (code == ENOENT || code == ENOTDIR || code == ELOOP || code == ENAMETOOLONG)
    error.code = ErrorCode::kFileNotFound;
  if (code == EACCES || code == EPERM) error.code = ErrorCode::kPermission;
  return error;
}

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

Result<std::string> read_text_file(const std::string& path, std::size_t largest_bytes) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) return fail(system_error(path, errno));
  struct stat status {};
  if (::fstat(file.number, &status) == 0 && S_ISDIR(status.st_mode))
    return fail({.code = ErrorCode::kUsage,
                 .message = path + " is a directory",
                 .remedy = "a file in it, such as design.toml",
                 .file = path});
  std::string text;
  char buffer[65536];
  for (;;) {
    const ssize_t count = ::read(file.number, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail(system_error(path, errno));
    if (count == 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
    if (text.size() > largest_bytes)
      return fail({.code = ErrorCode::kOutOfRange,
                   .message = path + " is larger than " + std::to_string(largest_bytes) + " bytes",
                   .remedy = "a file of text people can read",
                   .file = path});
  }
}

}  // namespace trueflank
