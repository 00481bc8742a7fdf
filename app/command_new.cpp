// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <string>
#include <string_view>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/new_design_file.h"
#include "trueflank/session/wished_design.h"

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

/// From the folder of the design, which is how a design file names its tools.
std::string tools_from(const std::string& tools, const std::filesystem::path& design) {
  if (tools.empty() || std::filesystem::path(tools).is_absolute()) return tools;
  const auto folder = design.parent_path();
  return std::filesystem::path(tools)
      .lexically_proximate(folder.empty() ? "." : folder)
      .generic_string();
}

/// Searches for the design that was asked for, and writes it.
ResultAll<std::filesystem::path> write_wished(const NewOptions& options, std::string& told) {
  // before seconds are searched for what could not be written
  if (const auto path = new_design_path(options.name); !path) return fail_all({path.error()});
  const auto design = wished_design(std::filesystem::path(options.name).stem().string(),
                                    {.kind = options.kind,
                                     .input = options.input,
                                     .output = options.output,
                                     .ratio = options.ratio,
                                     .motor = options.motor,
                                     .process = options.process,
                                     .material = options.material,
                                     .outer_diameter_mm = options.outer_diameter_mm,
                                     .bed = options.bed,
                                     .tools = options.tools,
                                     .tools_named = tools_from(options.tools, options.name)});
  if (!design) return fail_all(design.error());
  for (const std::string& sentence : design->told) told += sentence + "\n";
  const auto path = write_design(options.name, design->text);
  if (!path) return fail_all({path.error()});
  return *path;
}

}  // namespace

int run_new(const NewOptions& options) {
  std::string told;
  const auto path = options.wished ? write_wished(options, told)
                                   : write_new_design(options.name, {.kind = options.kind}).map_error([](Error error) {
                                       return Errors{std::move(error)};
                                     });
  if (!path) return report_errors(path.error());
  const std::string file = path->string();
  const std::string parts = path->stem().string();
  if (auto ok = print(told + "wrote " + file + "\nnext: trueflank make " + shell_word(file) + " -o " +
                      shell_word(parts) + "\n");
      !ok)
    return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
