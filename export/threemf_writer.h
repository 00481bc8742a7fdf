// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/packed/packed_text.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {

/// 3MF (core specification 1.2) in millimetres, coordinates to 1 nm: one object a shape with name and
/// base material. One body: built as it stands. Several: an object `assembly` of components, shapes
/// shared; a body whose name is not its shape's has an object of its own that carries the name.
/// Errors: as AtomicFile's; kUnsupported at 4 GB.
[[nodiscard]] Status write_3mf(const std::filesystem::path& path, const Scene& scene);

/// What a file holds of a mesh, for files that share shapes.
[[nodiscard]] PackedText packed_3mf_mesh(const TriangleMesh& mesh);
/// As write_3mf(), of meshes that are packed already: one a shape of the scene.
[[nodiscard]] Status write_3mf(const std::filesystem::path& path, const Scene& scene,
                               const std::vector<const PackedText*>& meshes);

}  // namespace trueflank::io
