// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "trueflank/base/result.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// 3MF (core specification 1.2) in millimetres, coordinates to 1 nm: one object a shape with name and
/// base material. One body: built as it stands. Several: an object `assembly` of components, shapes
/// shared; a body whose name is not its shape's has an object of its own that carries the name.
/// Errors: as AtomicFile's; kUnsupported at 4 GB.
[[nodiscard]] Status write_3mf(const std::filesystem::path& path, const Scene& scene);

}  // namespace trueflank::io
