// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/input_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <list>

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

namespace {

/// What is read at once of a pipe.
constexpr std::size_t kPiece = 1U << 20;

Error too_large(const std::filesystem::path& path, std::size_t most_bytes, bool is_regular) {
  return {.code = ErrorCode::kUnsupported,
          .message = std::string(is_regular ? "the file is" : "what comes out of it is") +
                     " larger than the " + std::to_string(most_bytes >> 20) + " MB that are read",
          .remedy = is_regular ? "a smaller file" : "a file on a disk",
          .file = path.string()};
}

/// To the end of what has no size: its pieces are put together once, each given back as it is.
Result<std::string> read_without_size(InputFile& file, const std::filesystem::path& path,
                                      std::size_t most_bytes) {
  const std::size_t most =
      std::min(most_bytes, file.is_device() ? kMostBytesOfDevice : kMostBytesOfPipe);
  std::list<std::string> pieces;
  std::size_t whole = 0;
  for (std::size_t got = kPiece; got == kPiece; whole += got) {
    pieces.emplace_back(kPiece, '\0');
    got = file.fill(pieces.back().data(), kPiece);
    pieces.back().resize(got);
    if (whole + got > most) return fail(too_large(path, most, false));
  }
  if (file.error_number() != 0) return fail(file_error("read", path, file.error_number()));
  std::string content;
  content.reserve(whole);
  for (; !pieces.empty(); pieces.pop_front()) content += pieces.front();
  return content;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::size_t most_bytes) {
  InputFile file(path);
  if (file.error_number() != 0) return fail(file_error("read", path, file.error_number()));
  const auto size = file.regular_size();
  if (!size) return read_without_size(file, path, most_bytes);
  if (*size > most_bytes) return fail(too_large(path, most_bytes, true));
  // One byte more than the size: the read that finds the end needs no second round.
  std::string content(*size + 1, '\0');
  std::size_t filled = 0;
  while (const std::size_t got = file.read(content.data() + filled, content.size() - filled)) {
    filled += got;
    if (filled > most_bytes) return fail(too_large(path, most_bytes, true));
    if (filled == content.size()) content.resize(2 * content.size());  // it grows
  }
  if (file.error_number() != 0) return fail(file_error("read", path, file.error_number()));
  content.resize(filled);
  return content;
}

}  // namespace trueflank::io
