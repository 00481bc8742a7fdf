// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/mesh/triangle_mesh.h"

// Meshes from files: our own, other programs' and scans. Told by content, not by the file's name (but
// for OBJ, which has no mark of its own, and for what assimp reads: assimp_reader.h).
namespace trueflank::io {

struct MeshBody {
  std::string name;  ///< may be empty
  TriangleMesh mesh; ///< in the file's common frame [mm]
};

/// Whether files with this ending (".stl", ".dae", in any case) are read as meshes.
[[nodiscard]] bool is_mesh_extension(std::string_view extension);

/// STL (binary, text), OBJ, PLY (text, binary of both byte orders), 3MF (components, transforms, units,
/// several model parts), GLB (node transforms). One body a solid, object or node; polygons become
/// fans. Equal corners of an STL are one vertex. STL, OBJ and PLY are taken for millimetres, 3MF by
/// its unit; GLB is turned from metres, y up, to millimetres, z up.
/// Guarantees: time and memory are bounded by the file's size; what copies itself is refused (reading.h).
/// Errors: kFileNotFound, kPermission, kDisk; kSyntax (no mesh, cut off, damaged, indices that do not
/// exist), kUnsupported; file and, for text, line are given.
[[nodiscard]] Result<std::vector<MeshBody>> read_bodies(const std::filesystem::path& path);

/// All bodies of read_bodies() in one mesh. Errors: also kSyntax where there is no triangle.
[[nodiscard]] Result<TriangleMesh> read_mesh(const std::filesystem::path& path);

/// Corners of a triangle.
using Facet = std::array<std::array<double, 3>, 3>;

/// Shows the triangles of all bodies one after the other, as the file has them; a binary STL is not
/// held in memory. Errors: as read_mesh's; facets before the place of an error may have been shown.
[[nodiscard]] Status visit_facets(const std::filesystem::path& path,
                                  const std::function<void(const Facet&)>& show);

/// The vertices alone: a scan may be a cloud of points. Errors: as read_bodies'; kSyntax where there is
/// no vertex.
[[nodiscard]] Result<std::vector<std::array<double, 3>>> read_points(
    const std::filesystem::path& path);

/// As read_bodies(), of a file's content; `extension` (".obj") decides where the content does not.
[[nodiscard]] Result<std::vector<MeshBody>> parse_bodies(std::string_view content,
                                                         std::string_view extension);

/// A mesh or a cloud of points as measuring devices deliver it, in one piece.
struct ScanMesh {
  TriangleMesh mesh;               ///< vertices may be not finite; facets use those that are
  std::vector<std::string> notes;  ///< what was left out, one sentence each
};
/// As parse_bodies(), but a file that is cut short or damaged in places is used for what it holds.
[[nodiscard]] Result<ScanMesh> parse_scan(std::string_view content, std::string_view extension);

}  // namespace trueflank::io
