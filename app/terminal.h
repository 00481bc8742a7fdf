// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "trueflank/base/result.h"
#include "trueflank/session/evaluate.h"

namespace trueflank::app {

/// Colour only where standard output is a terminal and NO_COLOR is not set.
[[nodiscard]] io::TextColour standard_output_colour();

/// A text as a terminal may be shown it: what would move its cursor, ring or rename its window, and
/// bytes that are no UTF-8, as "\\x1b". For names of files and whatever else comes from outside.
[[nodiscard]] std::string without_control(std::string_view text);

/// Prints to standard output what a person reads: lines, in colour perhaps, and no other control
/// characters (without_control()). Errors: kDisk (closed pipe, full device).
[[nodiscard]] Status print(std::string_view text);

/// Writes a document to a file, or to standard output for "-".
[[nodiscard]] Status write_document(const std::string& path, std::string_view text);

[[nodiscard]] Status create_output_folder(const std::string& folder);

/// The last line of a command that wrote a page: how to see it.
[[nodiscard]] std::string open_text(const std::string& page);

/// SIGINT, SIGTERM and SIGHUP, and an exception that nobody can catch, remove half-written files
/// and end the program with code 3.
void install_interrupt_handlers();

}  // namespace trueflank::app
