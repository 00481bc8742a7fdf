// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/design/new_design.h"
#include "trueflank/export/atomic_file.h"

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
  static const std::map<std::string, TrainKind> kKinds{{"3k", TrainKind::k3k},
                                                       {"simple", TrainKind::kSimple},
                                                       {"pair", TrainKind::kPair},
                                                       {"gear", TrainKind::kGear}};
  const auto kind = kKinds.find(options.kind);
  if (kind == kKinds.end())
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "no such kind",
                           .key = "--kind",
                           .value = options.kind,
                           .remedy = "3k, simple, pair or gear"}});
  std::filesystem::path path(options.name);
  if (path.filename().string().find_first_not_of('.') == std::string::npos || path.filename() == ".toml")
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "no name for a design",
                           .key = "NAME",
                           .value = options.name.empty() ? "\"\"" : options.name,
                           .remedy = "a name, such as my-gearbox"}});
  if (path.extension() != ".toml") path += ".toml";
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored))
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "this file exists and is not replaced",
                           .remedy = "another NAME",
                           .file = path.string()}});
  if (auto ok = io::write_file(path, new_design_text(kind->second, path.stem().string())); !ok)
    return report_errors({ok.error()});
  const std::string file = path.string();
  const std::string parts = path.stem().string();
  if (auto ok = print("wrote " + file + "\nnext: trueflank make " + shell_word(file) + " -o " +
                      shell_word(parts) + "\n");
      !ok)
    return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
