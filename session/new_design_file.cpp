// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/new_design_file.h"

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/design/new_design.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank {

std::string new_design_kinds() { return train_kind_names(); }

Result<std::string> new_design_text(const std::string& name, const NewDesignOptions& options) {
  const TrainKind* kind = find_train_kind(options.kind);
  if (!kind)
    return fail({.code = ErrorCode::kUsage,
                 .message = "no such kind",
                 .key = "--kind",
                 .value = options.kind,
                 .remedy = train_kind_names()});
  return new_design_text(*kind, name);
}

Result<std::filesystem::path> write_new_design(const std::string& name,
                                               const NewDesignOptions& options) {
  const std::filesystem::path path(name);
  const auto text = new_design_text(path.extension() == ".toml" ? path.stem().string()
                                                                : path.filename().string(), options);
  if (!text) return fail(text.error());
  return write_design(name, *text);
}

Result<std::filesystem::path> new_design_path(const std::string& name) {
  std::filesystem::path path(name);
  if (path.filename().string().find_first_not_of('.') == std::string::npos || path.filename() == ".toml")
    return fail({.code = ErrorCode::kUsage,
                 .message = "no name for a design",
                 .key = "NAME",
                 .value = name.empty() ? "\"\"" : name,
                 .remedy = "a name, such as my-gearbox"});
  if (path.extension() != ".toml") path += ".toml";
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored))
    return fail({.code = ErrorCode::kUsage,
                 .message = "this file exists and is not replaced",
                 .remedy = "another NAME",
                 .file = path.string()});
  return path;
}

Result<std::filesystem::path> write_design(const std::string& name, const std::string& text) {
  const auto path = new_design_path(name);
  if (!path) return fail(path.error());
  if (auto ok = io::write_file(*path, text); !ok) return fail(ok.error());
  return *path;
}

}  // namespace trueflank
