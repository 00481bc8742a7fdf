// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "trueflank/base/system_failure.h"

namespace trueflank::io {
namespace {

namespace fs = std::filesystem;

// Names of temporary files, where a signal handler can find them: fixed memory, no locks.
constexpr int kFree = 0, kFilling = 1, kArmed = 2;
struct Slot {
  std::atomic<int> state{kFree};
  std::array<char, 4096> path{};
};
std::array<Slot, 512> g_slots;  // more than the files of a gearbox in all formats: threads write them at once
std::atomic<bool> g_stopped{false};
std::atomic<unsigned> g_serial{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

int claim_slot(const std::string& path) {
  if (path.size() >= g_slots.front().path.size()) {
    errno = ENAMETOOLONG;
    return -1;
  }
  for (std::size_t i = 0; i < g_slots.size(); ++i) {
    int expected = kFree;
    if (!g_slots[i].state.compare_exchange_strong(expected, kFilling)) continue;
    std::memcpy(g_slots[i].path.data(), path.c_str(), path.size() + 1);
    g_slots[i].state.store(kArmed);
    return static_cast<int>(i);
  }
  errno = EMFILE;
  return -1;
}

void release_slot(int slot) noexcept {
  if (slot >= 0) g_slots[static_cast<std::size_t>(slot)].state.store(kFree);
}

/// Number of an open descriptor of this process that a path stands for.
std::optional<int> descriptor_of(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  const fs::path own = fs::read_symlink("/proc/self", ignored);
  if (ignored || folder != "/proc" / own / "fd") return std::nullopt;
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return number;
}

struct Target {
  std::string path;               ///< after all symbolic links
  std::optional<int> descriptor;  ///< an open descriptor of ours instead
};

/// Follows symbolic links, also one whose end does not exist yet.
Result<Target> resolve(const fs::path& path) {
  fs::path at = path;
  for (int links = 0; links < 40; ++links) {
    std::error_code error;
    const fs::path parent = at.has_parent_path() ? at.parent_path() : fs::path(".");
    const fs::path folder = fs::canonical(parent, error);
    if (error) return fail(file_error("write", path, error.value()));
    if (const auto descriptor = descriptor_of(folder, at.filename().string()))
      return Target{at.string(), descriptor};
    const fs::path link = fs::read_symlink(at, error);
    if (error) return Target{at.string(), std::nullopt};
    at = link.is_absolute() ? link : folder / link;
  }
  return fail(file_error("write", path, ELOOP));
}

ErrorCode code_of(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return ErrorCode::kFileNotFound;
    case EACCES:
    case EPERM:
    case EROFS:
      return ErrorCode::kPermission;
    case ECANCELED:
      return ErrorCode::kInterrupted;
    default:
      return ErrorCode::kDisk;
  }
}

/// Writes all or returns the error number.
int write_all(int descriptor, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

constexpr std::string_view kTemporaryBegin = ".trueflank-", kTemporaryEnd = ".tmp";

/// A name next to the target that a person recognises as left over, should the machine die.
std::string temporary_name(const std::string& target) {
  const fs::path path(target);
  const std::string name = std::string(kTemporaryBegin) + std::to_string(::getpid()) + "-" +
                           std::to_string(g_serial.fetch_add(1)) + std::string(kTemporaryEnd);
  return (path.parent_path() / name).string();
}

/// The process that a temporary file is named for.
std::optional<pid_t> process_of(std::string_view name) {
  if (!name.starts_with(kTemporaryBegin) || !name.ends_with(kTemporaryEnd)) return std::nullopt;
  name.remove_prefix(kTemporaryBegin.size());
  name.remove_suffix(kTemporaryEnd.size());
  const std::size_t dash = name.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  pid_t process = 0;
  unsigned serial = 0;
  const auto whole = [](std::string_view digits, auto& number) {
    const auto end = digits.data() + digits.size();
    return std::from_chars(digits.data(), end, number) == std::from_chars_result{end, std::errc()};
  };
  if (!whole(name.substr(0, dash), process) || !whole(name.substr(dash + 1), serial) ||
      process <= 0)
    return std::nullopt;
  return process;
}

/// Whether nobody writes a temporary file any more: its process does not run here, and none of
/// another container or machine holds its lock.
bool is_left_over(const fs::path& file, pid_t process) {
  if (::kill(process, 0) == 0 || errno != ESRCH) return false;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct stat status {};
  const bool free = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                    ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  ::close(descriptor);
  return free;
}

/// Whoever may write to a folder tidies it up; where that fails, the files stay.
void remove_left_over_files(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> left_over;
  for (auto entry = fs::directory_iterator(folder, ignored); entry != fs::directory_iterator();
       entry.increment(ignored)) {
    const auto process = process_of(entry->path().filename().string());
    if (process && is_left_over(entry->path(), *process)) left_over.push_back(entry->path());
  }
  for (const fs::path& file : left_over) fs::remove(file, ignored);
}

}  // namespace

Error file_error(std::string_view what, const fs::path& path, int error_number) {
  Error error;
  error.code = code_of(error_number);
  const bool reading = what.starts_with("read") || what == "verify";
  SystemFailure why = system_failure(error_number, reading ? SystemUse::kRead : SystemUse::kWrite);
  if (error_number == ECANCELED) why = {.reason = "interrupted", .remedy = "", .limit = ""};
  error.message = "cannot " + std::string(what) + " '" + path.string() + "': " + why.reason;
  error.remedy = std::move(why.remedy);
  error.value = std::move(why.limit);
  error.file = path.string();
  return error;
}

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  if (g_stopped.load()) return fail(file_error("write", path, ECANCELED));
  auto target = resolve(path);
  if (!target) return fail(std::move(target.error()));
  AtomicFile file;
  file.buffer_.reserve(kChunkBytes + 1024);
  file.path_ = path.string();
  file.target_ = target->path;

  struct stat status {};
  const bool exists = !target->descriptor && ::stat(file.target_.c_str(), &status) == 0;
  if (target->descriptor) {
    file.descriptor_ = ::fcntl(*target->descriptor, F_DUPFD_CLOEXEC, 3);
    if (file.descriptor_ < 0) return fail(file_error("write", path, errno));
    return file;
  }
  if (exists && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) return fail(file_error("write", path, EISDIR));
    file.descriptor_ = ::open(file.target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file.descriptor_ < 0) return fail(file_error("write", path, errno));
    return file;
  }
  // The folder would allow to replace a file that may not be written: not ours to overrule.
  if (exists && ::access(file.target_.c_str(), W_OK) != 0)
    return fail(file_error("write", path, errno));
  if (fs::path(file.target_).filename().empty()) return fail(file_error("write", path, EISDIR));

  do {
    release_slot(file.slot_);
    file.temporary_ = temporary_name(file.target_);
    file.slot_ = claim_slot(file.temporary_);
    if (file.slot_ < 0) return fail(file_error("write", path, errno));
    file.descriptor_ = ::open(file.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file.descriptor_ < 0 && errno == EEXIST);
  if (file.descriptor_ < 0) {
    const int error_number = errno;
    release_slot(std::exchange(file.slot_, -1));
    return fail(file_error("write", path, error_number));
  }
  // tells other runs that the file is being written; where a file system knows no locks, they ask
  // for the process
  (void)::flock(file.descriptor_, LOCK_EX | LOCK_NB);
  if (exists && ::fchmod(file.descriptor_, status.st_mode & 07777) != 0)
    return fail(file_error("write", path, errno));
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : buffer_(std::move(other.buffer_)),
      flushed_bytes_(other.flushed_bytes_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_number_(other.error_number_),
      slot_(std::exchange(other.slot_, -1)),
      path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)) {}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (slot_ >= 0) {
    ::unlink(temporary_.c_str());
    release_slot(std::exchange(slot_, -1));
  }
}

void AtomicFile::write(std::string_view bytes) {
  if (bytes.size() < kChunkBytes) {
    buffer_.append(bytes);
    flush_when_full();
    return;
  }
  flush();
  if (error_number_ == 0) error_number_ = write_all(descriptor_, bytes.data(), bytes.size());
  flushed_bytes_ += bytes.size();
}

void AtomicFile::flush() {
  if (error_number_ == 0) error_number_ = write_all(descriptor_, buffer_.data(), buffer_.size());
  flushed_bytes_ += buffer_.size();
  buffer_.clear();
}

Status AtomicFile::commit() {
  flush();
  // Some file systems tell only here that the disk is full.
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_number_ == 0) error_number_ = errno;
  if (error_number_ == 0 && slot_ >= 0) {
    if (g_stopped.load()) {
      error_number_ = ECANCELED;
    } else if (::rename(temporary_.c_str(), target_.c_str()) == 0) {
      release_slot(std::exchange(slot_, -1));
    } else {
      error_number_ = g_stopped.load() ? ECANCELED : errno;  // the handler took the file away
    }
  }
  discard();
  if (error_number_ != 0) return fail(file_error("write", path_, error_number_));
  return {};
}

Status write_file(const fs::path& path, std::string_view content) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  file->write(content);
  return file->commit();
}

Status create_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path, error)) error = std::make_error_code(std::errc::file_exists);
  if (error) return fail(file_error("create folder", path, error.value()));
  remove_left_over_files(path);
  return {};
}

void remove_temporary_files() noexcept {
  const int saved_errno = errno;
  g_stopped.store(true);
  for (Slot& slot : g_slots)
    if (slot.state.load() == kArmed) ::unlink(slot.path.data());
  errno = saved_errno;
}

}  // namespace trueflank::io
