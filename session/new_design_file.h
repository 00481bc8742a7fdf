// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "trueflank/base/result.h"

namespace trueflank {

struct NewDesignOptions {
  std::string kind = "3k";
};

/// The kinds there are: "3k, stepped, simple, two-stage, pair or gear".
[[nodiscard]] std::string new_design_kinds();

/// A commented design file to start from, as text. Errors: kUsage, no such kind.
[[nodiscard]] Result<std::string> new_design_text(const std::string& name,
                                                  const NewDesignOptions& options);

/// The file of a new design, NAME.toml. Errors: kUsage where the name is none or the file exists.
[[nodiscard]] Result<std::filesystem::path> new_design_path(const std::string& name);

/// Writes a design's text to NAME.toml (see below), which must not exist.
[[nodiscard]] Result<std::filesystem::path> write_design(const std::string& name, const std::string& text);

/// Writes it to NAME.toml (NAME may have folders before it and .toml behind). Returns the path.
/// Errors: kUsage where the kind or the name is none or the file exists; those of writing.
[[nodiscard]] Result<std::filesystem::path> write_new_design(const std::string& name,
                                                             const NewDesignOptions& options = {});

}  // namespace trueflank
