// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/terminal.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "trueflank/export/atomic_file.h"

namespace trueflank::app {
namespace {

extern "C" void stop_cleanly(int) {
  io::remove_temporary_files();
  constexpr std::string_view kMessage = "trueflank: stopped by a signal; no file is half-written\n";
  [[maybe_unused]] const ssize_t written =
      ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(3);
}

}  // namespace

io::TextColour standard_output_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const bool plain = (no_colour && *no_colour) || isatty(STDOUT_FILENO) == 0;
  return plain ? io::TextColour::kNone : io::TextColour::kAnsi;
}

Status print(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      return fail({.code = ErrorCode::kDisk,
                   .message = std::string("cannot write to standard output: ") +
                              std::strerror(errno)});
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Status write_document(const std::string& path, std::string_view text) {
  return path == "-" ? print(text) : io::write_file(path, text);
}

std::string open_text(const std::string& page) { return "open " + page + " in a browser\n"; }

Status create_output_folder(const std::string& folder) { return io::create_folder(folder); }

void install_interrupt_handlers() {
  struct sigaction action{};
  action.sa_handler = stop_cleanly;
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  // a closed pipe and the limit of a file's size are errors of the write, told as such
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace trueflank::app
