// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#ifdef __GLIBC__
#include <execinfo.h>
#include <malloc.h>
#endif

#include "trueflank/app/command_line.h"
#include "trueflank/app/terminal.h"

namespace {

/// Files are made in large pieces of memory, one after the other. Handing each back to the system
/// and asking for the next costs a page fault every 4 kB, a sixth of the time of `make`.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLarge = 1 << 30, kAtOnce = 8 << 20;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kLarge);
  mallopt(M_TOP_PAD, kAtOnce);
  mallopt(M_ARENA_MAX, 1);
#endif
}

/// glibc looks for the unwinder when an exception first passes through its own code (std::call_once, futures),
/// and ends the program where there is no memory for that: out of memory must not be that first time.
void load_unwinder() {
#ifdef __GLIBC__
  void* frame = nullptr;
  backtrace(&frame, 1);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  load_unwinder();
  trueflank::app::install_interrupt_handlers();
  try {
    return trueflank::app::run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    std::cerr << "trueflank: out of memory in " << (command.empty() ? "no command" : command)
              << (command == "make" ? "; a larger --tolerance-um needs less" : "") << "\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "trueflank: internal error, please report it: " << error.what() << "\n";
    return 3;
  }
}
