// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// What make is about to do, reported before it begins.
struct JobSize {
  double facets = 0.0;        ///< of all parts that are meshed
  double file_bytes = 0.0;    ///< of all mesh files, the assembly's with every body
  double memory_bytes = 0.0;  ///< at most at one time
  double correcting_s = 0.0;  ///< of one processor, for places that are displaced
};
/// Mesh formats only: all others are small. `part`: this one alone; empty: all and the assembly.
/// `operations`: of one displacement, where toothings have one.
[[nodiscard]] JobSize job_size(const PartShapes& shapes, const std::vector<io::FileFormat>& formats,
                               const std::string& part, double tolerance_mm,
                               double operations = 0.0);

/// Beyond these a job is a slip more often than a wish, and ends on most machines with nothing.
constexpr double kMostFacets = 4e7;
constexpr double kMostFileBytes = 2e10;
constexpr double kMostCorrecting_s = 120.0;

/// Errors: kInfeasible, key --tolerance-um, of a job beyond a bound: what it would take, and the
/// tolerance that would do, where one does.
[[nodiscard]] Errors job_size_errors(const PartShapes& shapes,
                                     const std::vector<io::FileFormat>& formats,
                                     const std::string& part, double tolerance_mm,
                                     double operations = 0.0);

}  // namespace trueflank
