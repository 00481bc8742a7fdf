// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/base/result.h"

namespace trueflank::app {

/// One error as the program prints it: "file:line: key = value: what is wrong; what would be right".
[[nodiscard]] std::string error_text(const Error& error);

/// Prints all errors to standard error. Returns the exit code: 3 where the environment failed, else 2.
int report_errors(const Errors& errors);

}  // namespace trueflank::app
