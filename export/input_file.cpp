// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/input_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <list>

#include "trueflank/base/large_pages.h"
#include "trueflank/base/threads.h"
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

namespace {

/// Bytes of a file that have been written, looked for until there are more than `most`; leaves the place to read from
/// wherever it is. The size where the file system does not tell.
off_t written_bytes(int descriptor, off_t size, off_t most) {
  off_t written = 0;
  for (off_t at = 0; at < size && written <= most;) {
    const off_t data = ::lseek(descriptor, at, SEEK_DATA);
    if (data < 0 && errno == ENXIO) break;  // nothing from `at` on
    at = data < 0 ? data : ::lseek(descriptor, data, SEEK_HOLE);
    if (at < 0) return size;
    written += at - data;
  }
  return written;
}

}  // namespace

bool InputFile::is_hollow() const {
  constexpr off_t kLarge = 16 << 20, kShare = 1000;
  if (!regular_size() || status_.st_size < kLarge) return false;
  const off_t most = status_.st_size / kShare;
  const off_t written = written_bytes(descriptor_, status_.st_size, most);
  return ::lseek(descriptor_, 0, SEEK_SET) == 0 && written <= most;
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

Error hollow(const std::filesystem::path& path) {
  return {.code = ErrorCode::kSyntax,
          .message = "the file has its size but next to nothing has been written into it; the rest reads as zeros",
          .remedy = "the whole file (a copy or a download may not have ended)",
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
  if (file.is_hollow()) return fail(hollow(path));
  // One byte more than the size: the read that finds the end needs no second round.
  std::string content;
  content.reserve(*size + 1);
  ask_for_large_pages(content.data(), *size + 1);
  constexpr std::size_t kBytesOfPages = std::size_t{1} << 22U;
  for_each_run(*size / kBytesOfPages, 1, [&](std::size_t piece, std::size_t) {
    make_pages_ready(content.data() + piece * kBytesOfPages, kBytesOfPages);
  });
  content.resize(*size + 1);
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
