// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <map>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/design/new_design.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank::app {

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
  if (auto ok = print("wrote " + file + "\nnext: trueflank make " + file + " -o " + parts + "\n");
      !ok)
    return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
