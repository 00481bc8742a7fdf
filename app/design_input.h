// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/report.h"
#include "trueflank/train/gear_train.h"

namespace trueflank::app {

/// How the parts are made, as the command line says it instead of the design file.
struct MadeOptions {
  std::string process;            ///< name of a process; empty: the design's
  std::optional<double> kerf_mm;  ///< nothing: the design's
};

/// Reads a design file and lays it out. Errors: all of the file, with file and line; no such process.
[[nodiscard]] ResultAll<GearTrain> read_train(const std::string& path,
                                              const MadeOptions& made = {});

/// Errors of later stations with file and line of their keys in the design file.
[[nodiscard]] Errors located_in(const std::string& path, Errors errors);

/// Every check, sweep and efficiency of a train. The report refers to the train.
[[nodiscard]] io::Report evaluate(const GearTrain& train, const StrengthOptions& strength = {});
/// What the command line says of materials.
struct MaterialOptions {
  std::string material;  ///< of every gear, over what the design says; empty: as the design says
  std::string file;      ///< with more materials than the built-in table's; empty: none
};
/// Materials of a design's gears. Errors: of the file; no such material (the design's with its key).
[[nodiscard]] ResultAll<StrengthOptions> strength_options(const GearboxDesign& design,
                                                          const MaterialOptions& options = {});

}  // namespace trueflank::app
