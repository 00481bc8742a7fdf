// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "trueflank/base/result.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// Binary little-endian PLY [mm]: vertices as double, so this format loses nothing; triangles; with
/// several bodies each vertex carries its body's colour. Errors: as AtomicFile's.
[[nodiscard]] Status write_ply(const std::filesystem::path& path, const Scene& scene);

}  // namespace trueflank::io
