// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "trueflank/base/result.h"
#include "trueflank/solid/shape/part_shape.h"

// OpenSCAD files that people go on working with (docs/formats.md).
namespace trueflank::io {

/// A part: parameters on top (face widths, bores, rims, extra thinning for a printer's fit, tolerance),
/// the true curves of a half tooth below, evaluated when rendered. One `linear_extrude` of one `polygon`
/// with holes, or one `polyhedron` for a stack of sections: no boolean operation in space, so it renders
/// in well under a second. Stacks whose sections are not nested are a union of prisms.
/// Modified flanks: tables of what a design's modifications turn the flank by; a section that changes
/// along the face is made row by row.
/// Modules: `<name>()` and `<name>_section()` (of the lowest section; of modified teeth at mid face).
/// Errors: as AtomicFile's; kUnsupported for corrections of measured parts (scad_flanks()).
[[nodiscard]] Status write_scad(const std::filesystem::path& path, const std::string& design_name,
                                const PartShape& part, double tolerance_mm);

/// The assembly, made of the parts' files beside it: placed in mesh, turned by the true kinematics
/// (parameter `turn`, and OpenSCAD's animation), exploded on demand. Errors: as AtomicFile's.
[[nodiscard]] Status write_scad_assembly(const std::filesystem::path& path, const GearTrain& train,
                                         const PartShapes& shapes);

}  // namespace trueflank::io
