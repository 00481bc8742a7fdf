// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::app {

/// Reads the command line and runs the command. Returns the program's exit code; wrong usage is 2.
int run_command_line(int argc, char** argv);

}  // namespace trueflank::app
