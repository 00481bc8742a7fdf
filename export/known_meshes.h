// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/packed/packed_text.h"

// Files of one gearbox hold the same packed meshes: the part's own 3MF file and that of the
// assembly. Reading one of these files back, the second need not unpack and parse what the first
// proved: equal bytes hold equal meshes.
namespace trueflank::io {

/// A packed mesh that files are known to share, and what it was found to hold when it was first
/// read.
struct KnownMesh {
  std::string_view packed;  ///< blocks of a deflated entry, from a whole byte to a whole byte
  bool read = false;
  TriangleMesh mesh;  ///< as a reader finds it, once it is read
  std::size_t text_bytes = 0;
  std::uint32_t checksum = 0;
};

/// As visit_facets(), of a 3MF file in which known meshes may stand. Those that are not read yet
/// are read and kept; the others are taken from where they are kept, if the file has the same bytes
/// there. What stands between them is read as ever, and the entry's checksum is that of the whole.
/// Guarantees: the facets and errors of visit_facets(); whatever looks different is read by it.
[[nodiscard]] Status visit_facets(const std::filesystem::path& path, std::vector<KnownMesh*> known,
                                  const std::function<void(const Facet&)>& show);

}  // namespace trueflank::io
