// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/export/reported_file.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank::io {

/// What is done to the finished mesh of a part that its outlines cannot hold.
struct MeshChange {
  std::function<TriangleMesh(const TriangleMesh&)> apply = {};  ///< empty: nothing
  double magnification = 1.0;  ///< largest share by which it lengthens a distance
};

/// What is to be written; nothing is owned.
struct ExportModel {
  const GearTrain* train = nullptr;
  const PartShapes* shapes = nullptr;
  /// One a part; nullptr: made here, within the tolerance, where a mesh format is asked for.
  const std::vector<PartMesh>* meshes = nullptr;
  /// One a part; nullptr: none. Meshes are measured before it.
  const std::vector<MeshChange>* changes = nullptr;
  /// Parts whose meshes are proved to bound a solid before a file is begun, by number: their teeth
  /// are displaced by what was measured, and no construction vouches for them.
  std::vector<std::size_t> proved = {};
};

struct ExportOptions {
  std::filesystem::path folder;  ///< created where it is missing
  std::vector<FileFormat> formats = {FileFormat::kStl, FileFormat::k3mf};
  /// Largest distance of facets and chords from the true surface or curve.
  double tolerance_mm = 1e-3;
  /// Above 0: DXF files of parts hold the path of a wire or beam that cuts this width (kerf_path.h);
  /// the assembly's and all other formats the parts as they are.
  double kerf_mm = 0.0;
  StepSchema step_schema = StepSchema::kAp214;
  std::string part;  ///< this part alone, without the assembly; empty: all
  /// Called after each file, by one thread at a time; for showing progress.
  std::function<void(const std::string& file_name)> on_written = {};
};

/// One file per part and format, and `assembly` + extension where there is more than one body. Mesh
/// meshes are measured against the true surface, and made again where they miss the tolerance;
/// their files are read again from the disk and compared with them. Works on all processors; files
/// and report are the same whatever their number. The result is in the order parts x formats, the
/// assembly last. Where the tolerance cannot be kept, accuracy_um of a file says so. Errors: kUsage
/// (no such part), kFileNotFound, kPermission, kDisk, kInterrupted, kUnsupported (STEP of outlines
/// with teeth that cross), kInfeasible (round outlines of a part cross: nothing is written then; the
/// kerf does not fit into a hole; a mesh that was to be proved crosses itself). Files written before an error stay; none of them is incomplete.
[[nodiscard]] ResultAll<std::vector<ReportedFile>> export_parts(const ExportModel& model,
                                                                const ExportOptions& options);

}  // namespace trueflank::io
