// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "trueflank/base/result.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// Wavefront OBJ [mm], one object and group a body; coordinates to 1 nm. No materials: they would
/// need a second file. Errors: as AtomicFile's.
[[nodiscard]] Status write_obj(const std::filesystem::path& path, const Scene& scene);

}  // namespace trueflank::io
