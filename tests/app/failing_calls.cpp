// SPDX-License-Identifier: GPL-3.0-or-later
//
// A library that is loaded before the program and lets one kind of its calls fail, as SQLite's
// tests do:
//   FAILING_CALL=write:17    the 17th call fails, those before and after succeed
//   FAILING_CALL=write:17+   all from the 17th on (for the limit of a file's size; a single one for want of room)
//   FAILING_CALL_COUNT=FILE  the number of calls of each kind is written there when the program
//   ends
// Calls before main() are not counted. Kinds: malloc write rename open close thread.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind { kMalloc, kWrite, kRename, kOpen, kClose, kThread, kNone };
constexpr const char* kNames[] = {"malloc", "write", "rename", "open", "close", "thread"};

std::atomic<bool> g_counting{false};
std::atomic<long> g_calls[kNone];
Kind g_kind = kNone;
long g_first = 0;
bool g_all_after = false;

void read_wish() {
  const char* wish = std::getenv("FAILING_CALL");
  if (wish == nullptr) return;
  const char* colon = std::strchr(wish, ':');
  if (colon == nullptr) return;
  for (int k = 0; k < kNone; ++k)
    if (std::strncmp(wish, kNames[k], static_cast<std::size_t>(colon - wish)) == 0)
      g_kind = static_cast<Kind>(k);
  char* end = nullptr;
  g_first = std::strtol(colon + 1, &end, 10);
  g_all_after = *end == '+';
}

bool fails(Kind kind) {
  // where none is to fail, all are counted
  if ((kind != g_kind && g_kind != kNone) || !g_counting.load(std::memory_order_relaxed))
    return false;
  const long call = ++g_calls[kind];
  return kind == g_kind && (call == g_first || (g_all_after && call > g_first));
}

void tell_count() {
  g_counting = false;
  const char* file = std::getenv("FAILING_CALL_COUNT");
  if (file == nullptr) return;
  const auto descriptor =
      static_cast<int>(syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0600));
  for (int k = 0; k < kNone; ++k) {
    char text[64];
    const int size = std::snprintf(text, sizeof text, "%s %ld\n", kNames[k], g_calls[k].load());
    syscall(SYS_write, descriptor, text, static_cast<std::size_t>(size));
  }
  syscall(SYS_close, descriptor);
}

int (*g_main)(int, char**, char**) = nullptr;
int counted_main(int argc, char** argv, char** environment) {
  read_wish();
  g_counting = true;
  const int code = g_main(argc, argv, environment);
  tell_count();
  return code;
}

template <class Function>
Function* next_of(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int __libc_start_main(int (*program)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*loader_fini)(), void* stack_end) {
  using Start =
      int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  g_main = program;
  return next_of<Start>("__libc_start_main")(counted_main, argc, argv, init, fini, loader_fini,
                                             stack_end);
}

void* malloc(std::size_t size) {
  if (!fails(kMalloc)) return __libc_malloc(size);
  errno = ENOMEM;
  return nullptr;
}
void* calloc(std::size_t count, std::size_t size) {
  if (!fails(kMalloc)) return __libc_calloc(count, size);
  errno = ENOMEM;
  return nullptr;
}
void* realloc(void* old, std::size_t size) {
  if (!fails(kMalloc)) return __libc_realloc(old, size);
  errno = ENOMEM;
  return nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  if (!fails(kMalloc)) return __libc_memalign(alignment, size);
  errno = ENOMEM;
  return nullptr;
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  if (fails(kMalloc)) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

ssize_t write(int descriptor, const void* data, std::size_t size) {
  if (!fails(kWrite)) return syscall(SYS_write, descriptor, data, size);
  errno = g_all_after ? EFBIG : ENOSPC;
  return -1;
}
int rename(const char* from, const char* to) {
  if (!fails(kRename)) return static_cast<int>(syscall(SYS_rename, from, to));
  errno = EIO;
  return -1;
}
int open(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if (!fails(kOpen)) return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  errno = EMFILE;
  return -1;
}
int open64(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open(path, flags, mode);
}
int close(int descriptor) {
  const auto closed = static_cast<int>(syscall(SYS_close, descriptor));
  if (!fails(kClose)) return closed;
  errno = EIO;
  return -1;
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) {
  using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static Create* const create = next_of<Create>("pthread_create");
  return fails(kThread) ? EAGAIN : create(thread, attributes, work, argument);
}

}  // extern "C"
