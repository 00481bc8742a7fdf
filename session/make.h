// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trueflank/export/file_formats.h"
#include "trueflank/report/report.h"
#include "trueflank/session/gearbox.h"

namespace trueflank {

struct MakeOptions {
  std::filesystem::path folder;      ///< created where it is missing
  std::vector<std::string> formats;  ///< names of file_formats.h; empty: those written unasked
  double tolerance_um = 1.0;         ///< largest distance of a facet from the true surface
  std::string step_schema = "ap214"; ///< of STEP files; "ap242": with sizes, limits, datum and runouts
  std::string part;                  ///< this part alone; empty: all
  std::string correct;               ///< loop.json whose effects the parts cancel; empty: none
  bool compensate = false;           ///< meshes with walls moved against what the process does to them
  std::string materials_file;        ///< more [material.NAME] tables; empty: none
  bool allow_failing = false;        ///< write parts though a check failed
  /// Called after each file, by one thread at a time.
  std::function<void(const std::string& file_name)> on_written = {};
};
/// What is wrong with these options whatever the design. kUsage.
[[nodiscard]] Errors errors_of(const MakeOptions& options);

struct MakeResult {
  io::Report report;   ///< with the files that were written
  bool failed = false; ///< a check failed
  bool written = false;  ///< parts were written
  std::vector<std::string> removed;  ///< files of an earlier run that a failing one took away
  std::string notes;   ///< what was corrected, compensated or left out: lines for a person
};

/// Checks a gearbox, writes its parts and assembly in every format asked for, then report.html and
/// report.json. Where a check fails no part is written (unless allow_failing), and the parts that the
/// folder's report.json lists of an earlier run are removed: they would stand beside a report that is
/// not theirs. A listed file that was changed since stays.
/// Errors: all at once; those of the options, of the design (with file and line), of the files.
[[nodiscard]] ResultAll<MakeResult> make_parts(const Gearbox& gearbox, const MakeOptions& options);

}  // namespace trueflank
