// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <utility>

#include "trueflank/base/system_failure.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank::app {
namespace {

/// Bytes of the UTF-8 character that a text begins with; 0: none, or a control character.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return first == 0xc2 && byte(1) < 0xa0 ? 0 : length;  // the second set of control characters
}

extern "C" void stop_cleanly(int) {
  io::remove_temporary_files();
  constexpr std::string_view kMessage = "trueflank: stopped by a signal; no file is half-written\n";
  [[maybe_unused]] const ssize_t written =
      ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(3);
}

/// Where an exception finds no way out: a destructor of a JSON document that finds no memory, for
/// one.
[[noreturn]] void end_cleanly() {
  io::remove_temporary_files();
  std::string_view message =
      "trueflank: internal error, please report it; no file is half-written\n";
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    message = "trueflank: out of memory; no file is half-written\n";
  } catch (...) {
  }
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  _exit(3);
}

Status write_to_output(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      SystemFailure why = system_failure(errno, SystemUse::kWrite);
      return fail({.code = ErrorCode::kDisk,
                   .message = "cannot write to standard output: " + why.reason,
                   .value = std::move(why.limit),
                   .remedy = std::move(why.remedy)});
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

/// The end of a sequence that sets a colour and begins a text; 0: none does.
std::size_t length_of_colour(std::string_view text) {
  if (!text.starts_with("\033[")) return 0;
  const std::size_t end = text.find_first_not_of("0123456789;", 2);
  return end != std::string_view::npos && text[end] == 'm' ? end + 1 : 0;
}

/// Lines and colours stay.
std::string for_terminal(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t plain = text.find_first_of("\n\t\033");
    if (plain == 0) {
      plain = text[0] == '\033' ? length_of_colour(text) : 1;
      if (plain > 0)
        result += text.substr(0, plain);
      else
        result += without_control(text.substr(0, plain = 1));
    } else {
      plain = std::min(plain, text.size());
      result += without_control(text.substr(0, plain));
    }
    text.remove_prefix(plain);
  }
  return result;
}

}  // namespace

io::TextColour standard_output_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const bool plain = (no_colour && *no_colour) || isatty(STDOUT_FILENO) == 0;
  return plain ? io::TextColour::kNone : io::TextColour::kAnsi;
}

std::string without_control(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      const auto byte = static_cast<unsigned char>(text[0]);
      result += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

Status print(std::string_view text) { return write_to_output(for_terminal(text)); }

Status write_document(const std::string& path, std::string_view text) {
  return path == "-" ? write_to_output(text) : io::write_file(path, text);
}

std::string open_text(const std::string& page) { return "open " + page + " in a browser\n"; }

Status create_output_folder(const std::string& folder) { return io::create_folder(folder); }

void install_interrupt_handlers() {
  struct sigaction action{};
  action.sa_handler = stop_cleanly;
  sigemptyset(&action.sa_mask);
  std::set_terminate(end_cleanly);
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  // a closed pipe and the limit of a file's size are errors of the write, reported as such
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace trueflank::app
