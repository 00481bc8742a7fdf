// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "trueflank/base/result.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// glTF 2.0 binary. glTF speaks metres with y up: vertices are in the part's own frame [mm], and a
/// root node turns z up to y up and scales by 0.001, so every viewer shows the true size upright.
/// One mesh with material a shape, one named node a body. No normals: viewers shade flat, as a
/// machined part with sharp edges wants. Errors: as AtomicFile's; kUnsupported at 4 GB.
[[nodiscard]] Status write_glb(const std::filesystem::path& path, const Scene& scene);

}  // namespace trueflank::io
