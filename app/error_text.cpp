// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/error_text.h"

#include <algorithm>
#include <iostream>

#include "trueflank/app/terminal.h"

namespace trueflank::app {

std::string error_text(const Error& error) {
  std::string text = "trueflank: ";
  if (!error.file.empty()) {
    text += error.file;
    if (error.line > 0) text += ":" + std::to_string(error.line);
    text += ": ";
  }
  if (!error.key.empty()) {
    text += error.key;
    if (!error.value.empty()) text += " = " + error.value;
    text += ": ";
  }
  text += error.message;
  if (!error.remedy.empty()) text += "; wanted: " + error.remedy;
  return without_control(text);
}

int report_errors(const Errors& errors) {
  int code = 2;
  for (const Error& error : errors) {
    std::cerr << error_text(error) << "\n";
    code = std::max(code, exit_code(error.code));
  }
  std::cerr.flush();
  return code;
}

}  // namespace trueflank::app
