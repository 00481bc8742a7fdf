// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <string_view>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/new_design_file.h"

namespace trueflank::app {

namespace {

/// As a shell takes it for one word.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kSpecial = " \t\n\"'\\$`&|;<>()*?[]#~!{}";
  if (text.find_first_of(kSpecial) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

int run_new(const NewOptions& options) {
  const auto path = write_new_design(options.name, {.kind = options.kind});
  if (!path) return report_errors({path.error()});
  const std::string file = path->string();
  const std::string parts = path->stem().string();
  if (auto ok = print("wrote " + file + "\nnext: trueflank make " + shell_word(file) + " -o " +
                      shell_word(parts) + "\n");
      !ok)
    return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
