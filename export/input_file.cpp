// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/input_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "trueflank/export/atomic_file.h"

namespace trueflank::io {

InputFile::InputFile(const std::filesystem::path& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::fstat(descriptor_, &status_) != 0) error_number_ = errno;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<std::size_t> InputFile::regular_size() const {
  if (error_number_ != 0 || !S_ISREG(status_.st_mode)) return std::nullopt;
  return static_cast<std::size_t>(status_.st_size);
}

std::size_t InputFile::read(char* into, std::size_t room) {
  while (error_number_ == 0) {
    const ssize_t got = ::read(descriptor_, into, room);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) error_number_ = errno;
  }
  return 0;
}

std::size_t InputFile::fill(char* into, std::size_t room) {
  std::size_t filled = 0;
  while (filled < room) {
    const std::size_t got = read(into + filled, room - filled);
    if (got == 0) break;
    filled += got;
  }
  return filled;
}

Result<std::string> read_file(const std::filesystem::path& path) {
  InputFile file(path);
  std::string content;
  // One byte more than the size: the read that finds the end needs no second round.
  std::size_t filled = 0, room = file.regular_size().value_or(65535) + 1;
  while (file.error_number() == 0) {
    content.resize(std::max(room, content.size()));
    const std::size_t got = file.read(content.data() + filled, content.size() - filled);
    if (got == 0) break;
    filled += got;
    if (filled == content.size()) room = 2 * content.size();
  }
  if (file.error_number() != 0) return fail(file_error("read", path, file.error_number()));
  content.resize(filled);
  return content;
}

}  // namespace trueflank::io
