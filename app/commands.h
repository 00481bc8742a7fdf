// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

// The program's commands: options in, exit code out (0 done and every check passed, 1 a check failed,
// 2 wrong usage or input, 3 the environment failed).
namespace trueflank::app {

struct CheckOptions {
  std::string design;
  std::string json;  ///< file for report.json; "-": standard output; empty: none
  std::string html;
  std::string tolerance;  ///< see parse_tolerance; empty: no tolerance analysis
  std::string material;        ///< of every gear, for strength and inertia; empty: the default
  std::string materials_file;  ///< more [material.NAME]; empty: none
  std::string process;    ///< what the parts are made by; empty: the design's
  std::string pictures;   ///< folder for an SVG of each mesh at its worst place; empty: none
  bool verbose = false;   ///< the checks that passed too
  bool quiet = false;
};
int run_check(const CheckOptions& options);

struct MakeOptions {
  std::string design;
  std::string folder;
  std::vector<std::string> formats;  ///< empty: all
  double tolerance_um = 1.0;
  std::string step_schema = "ap214";
  std::string part;     ///< empty: all
  std::string correct;  ///< loop.json; empty: none
  bool compensate = false;  ///< meshes with walls moved against the process's effects
  std::optional<double> kerf_mm;  ///< of the DXF files; nothing: the design's
  std::string process;  ///< what the parts are made by; empty: the design's
  std::string materials_file;  ///< more [material.NAME]; empty: none
  bool allow_failing = false;
  bool verbose = false;  ///< the checks that passed too
  bool quiet = false;
};
int run_make(const MakeOptions& options);

struct FixCommand {
  std::string design;
  std::string output;  ///< the mended design file; "-": standard output
  bool warnings = false;
  bool quiet = false;
};
int run_fix(const FixCommand& options);

struct CompareOptions {
  std::string golden, fresh;
  double tolerance_um = 1.0;
  std::string json;
  std::string picture;  ///< SVG file; empty: none
  bool quiet = false;
};
int run_compare(const CompareOptions& options);

struct LoopOptions {
  std::string design;
  std::vector<std::string> data;  ///< measured files, or PART=FILE
  std::string effects;            ///< file of effects to add to the library; empty: none
  std::string folder;
  std::string gear;      ///< empty: the design's only one
  bool aligned = false;  ///< scans stand in the gear's own frame
  bool quiet = false;
};
int run_loop(const LoopOptions& options);

struct NewOptions {
  std::string name;  ///< of the design, and of its file with .toml
  std::string kind = "3k";
  bool wished = false;  ///< a ratio is asked for: the design is searched
  double ratio = 0.0, outer_diameter_mm = 90.0;
  std::string input, output;  ///< members; empty: the usual ones
  std::string motor, process = "fdm-0.4", material = "pla";
  std::string tools;  ///< file of own motors and processes; empty: none
  std::string bed;    ///< of the printer; empty: no print plates
};
int run_new(const NewOptions& options);

/// What a newcomer should do next: the answer to `trueflank` alone.
[[nodiscard]] std::string welcome_text();

}  // namespace trueflank::app
