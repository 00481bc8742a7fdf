// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/section/section_contour.h"

namespace trueflank::io {

/// DXF of AutoCAD 2000 (AC1015) in millimetres: whole circles as CIRCLE, every other outline as one
/// closed LWPOLYLINE whose edges are arcs (Contour). A layer a body and section, `SECTION_1_SUN`; all
/// sections lie over each other in the frame of part or assembly; layers of frozen bodies are frozen. Errors: as AtomicFile's.
[[nodiscard]] Status write_dxf(const std::filesystem::path& path,
                               const std::vector<Section>& sections);

}  // namespace trueflank::io
