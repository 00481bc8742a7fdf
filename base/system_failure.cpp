// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/system_failure.h"

#include <sys/resource.h>

#include <cerrno>
#include <optional>
#include <system_error>

namespace trueflank {
namespace {

/// What the shell's `ulimit` sets; nothing where there is no limit.
template <class Which>
std::optional<std::string> limit_of(Which which) {
  rlimit limit{};
  if (::getrlimit(which, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return std::to_string(limit.rlim_cur);
}

/// EFBIG: of this session's limit, or of the file system.
SystemFailure too_large(std::string words) {
  const auto bytes = limit_of(RLIMIT_FSIZE);
  if (!bytes)
    return {words, "a disk that takes larger files (FAT ends at 4 GB), or a smaller file", {}};
  return {words + ": no file may grow beyond " + *bytes + " bytes here",
          "a higher limit (ulimit -f unlimited), or a smaller file", *bytes + " bytes"};
}

/// EMFILE.
SystemFailure too_many_open(std::string words) {
  const auto files = limit_of(RLIMIT_NOFILE);
  if (!files) return {words, "fewer files at once", {}};
  return {words + ": a program may have " + *files + " open here",
          "a higher limit (ulimit -n 256 is enough)", *files + " open files"};
}

/// EAGAIN where a process was to begin.
SystemFailure too_many_processes(std::string words) {
  const auto processes = limit_of(RLIMIT_NPROC);
  if (!processes) return {words, "the same again later", {}};
  return {words + ": a user may have " + *processes + " processes here",
          "a higher limit (ulimit -u), or the same again later", *processes + " processes"};
}

const char* remedy_of(int error_number, bool reading) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return reading ? "a file that is there" : "an existing folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return reading ? "a file you may read" : "a place you may write to";
    case ENOSPC:
    case EDQUOT:
      return "free some space or write elsewhere";
    case EISDIR:
      return "the name of a file, not of a folder";
    case ENAMETOOLONG:
      return "a shorter name";
    case ELOOP:
      return "a name whose links end at a file";
    case EEXIST:
      return "a name that no file has";
    case EPIPE:
      return "a program that reads to the end";
    case ENFILE:
      return "other programs ended: the whole machine can open no more files";
    case ENOMEM:
      return "more free memory";
    case EIO:
      return "a disk without faults";
    default:
      return "";
  }
}

}  // namespace

SystemFailure system_failure(int error_number, SystemUse use) {
  std::string words = std::generic_category().message(error_number);
  switch (error_number) {
    case EFBIG:
      return too_large(std::move(words));
    case EMFILE:
      return too_many_open(std::move(words));
    default:
      break;
  }
  if (error_number == EAGAIN && use == SystemUse::kStartProcess)
    return too_many_processes(std::move(words));
  return {std::move(words), remedy_of(error_number, use == SystemUse::kRead), {}};
}

}  // namespace trueflank
