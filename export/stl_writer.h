// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "trueflank/base/result.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// Binary STL [mm], all bodies in one shell list. Coordinates are rounded to float (0.004 um at
/// 100 mm), normals are those of the rounded triangles. A triangle two corners of which round to the
/// same point is left out together with its neighbour over that edge, so a closed mesh stays closed.
/// Errors: as AtomicFile's.
[[nodiscard]] Status write_stl(const std::filesystem::path& path, const Scene& scene);

}  // namespace trueflank::io
