// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/process_compensation.h"

namespace trueflank {

/// All parts, the measured gear's toothing corrected by a loop.json. The correction displaces the
/// toothing; bore and rim stay. A scale is of the whole part: it moves the finished meshes of that.
struct CorrectedParts {
  PartShapes shapes;             ///< they keep the correction that displaces them
  std::vector<io::MeshChange> changes;  ///< one a part, of a scale; else empty
  std::vector<std::size_t> changed;     ///< parts that are not as designed, by number
  bool displaced = false;        ///< some teeth are not as designed
  double operations = 0.0;       ///< that a displacement takes, about
  std::string text;  ///< what was corrected, what was left and why: lines for a person
};

/// `compensated`: parts with walls moved against the design's process, of which the measured ones
/// were made; the correction comes on top. nullptr: parts as designed. Errors: of the file, where
/// its gear is not of this design, and where the measured part shows the process's expansion, which
/// is then that of a part made without compensation; kInfeasible where the teeth cannot hold a
/// correction (correction_bounds.h) or would reach another wall of the part.
[[nodiscard]] ResultAll<CorrectedParts> corrected_parts(const GearTrain& train,
                                                        const PartShapes& shapes,
                                                        const CompensatedShapes* compensated,
                                                        const std::string& loop_json_file);

/// The formats that can carry a correction: all but OpenSCAD; meshes only, where it is of the whole
/// part, bends teeth too sharply for splines or is of compensated parts. What was asked for beside them
/// is reported in its text.
[[nodiscard]] std::vector<io::FileFormat> formats_of_corrected(
    const std::vector<io::FileFormat>& formats, bool compensated, CorrectedParts& corrected);

}  // namespace trueflank
