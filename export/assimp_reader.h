// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/reading.h"

// Mesh formats that we do not write, read by assimp. Its library is loaded when such a file comes, and in a process of
// its own with bounded time and memory: it was not written for hostile files, and a crash there is a message here.
namespace trueflank::io {

/// ".off, .amf, ..."
[[nodiscard]] std::string assimp_extensions(std::string_view separator);
/// Whether files with this ending (".dae", lower case) are read here.
[[nodiscard]] bool is_assimp_extension(std::string_view extension);

/// Bodies in millimetres, z up. OFF is taken for millimetres; AMF and FBX by the unit they state; Collada, glTF and X3D
/// are turned from metres (Collada: its own unit), y up, 3DS from its own axes. assimp computes in single precision:
/// coordinates are right to 6e-8 of their size. A glTF with a buffer in a file of its own is not read.
/// Guarantees: at most two minutes, and 512 MB and 100 times the file's size of memory (4 GB); the process of the caller is not touched by what happens.
/// Errors: kSyntax (what assimp says), kUnsupported (assimp is not installed; too large).
[[nodiscard]] Result<std::vector<MeshBody>> parse_by_assimp(std::string_view content, std::string_view extension,
                                                            Reading& reading);

}  // namespace trueflank::io
