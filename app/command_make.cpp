// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <future>

#include "trueflank/app/commands.h"
#include "trueflank/app/corrected_parts.h"
#include "trueflank/app/design_input.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/exported_files.h"
#include "trueflank/app/html_document.h"
#include "trueflank/app/terminal.h"
#include "trueflank/check/finding.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/report_html.h"
#include "trueflank/export/scad_templates.h"

namespace trueflank::app {
namespace {

/// Finest and coarsest tolerance: below, doubles and file sizes end; above, teeth are no teeth.
constexpr double kFinestTolerance_um = 0.001;
constexpr double kCoarsestTolerance_um = 1000.0;
constexpr double kWidestKerf_mm = 20.0;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Errors usage_errors(const MakeOptions& options) {
  Errors errors;
  if (auto formats = io::parse_formats(options.formats); !formats) errors = formats.error();
  if (!(options.tolerance_um >= kFinestTolerance_um &&
        options.tolerance_um <= kCoarsestTolerance_um))
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no tolerance for a part",
                      .key = "--tolerance-um",
                      .value = std::to_string(options.tolerance_um),
                      .remedy = "0.001 to 1000"});
  if (options.kerf_mm && !(*options.kerf_mm >= 0.0 && *options.kerf_mm <= kWidestKerf_mm))
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no width of a cut",
                      .key = "--kerf-mm",
                      .value = std::to_string(*options.kerf_mm),
                      .remedy = "0 to 20"});
  return errors;
}

Errors part_errors(const MakeOptions& options, const PartShapes& shapes) {
  if (options.part.empty()) return {};
  std::vector<std::string> names;
  for (const PartShape& part : shapes.parts) names.push_back(part.name);
  if (std::find(names.begin(), names.end(), options.part) != names.end()) return {};
  return {{.code = ErrorCode::kUsage,
           .message = "this design has no such part",
           .key = "--part",
           .value = options.part,
           .remedy = joined(names)}};
}

Status write_report(const io::Report& report, const std::string& drawing,
                    const std::filesystem::path& folder) {
  const std::string json = io::report_json(report);
  if (auto ok = io::write_file(folder / "report.html", io::report_html(report, json, drawing)); !ok)
    return ok;
  return io::write_file(folder / "report.json", json);
}

}  // namespace

int run_make(const MakeOptions& options) {
  if (Errors errors = usage_errors(options); !errors.empty()) return report_errors(errors);
  const auto train = read_train(options.design, {.process = options.process, .kerf_mm = options.kerf_mm});
  if (!train) return report_errors(train.error());
  const auto shapes = part_shapes(*train);
  if (!shapes) return report_errors(located_in(options.design, shapes.error()));
  if (Errors errors = part_errors(options, *shapes); !errors.empty()) return report_errors(errors);
  if (options.compensate && !train->design.made.process)
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "compensation needs a process",
                           .key = "--compensate",
                           .remedy = "--process NAME, or [made] process in the design"}});

  std::string told;  // what was left out, and what was corrected
  auto formats = io::parse_formats(options.formats);
  if (!formats) return report_errors(formats.error());

  const auto strength = strength_options(train->design, {.material = "", .file = options.materials_file});
  if (!strength) return report_errors(located_in(options.design, strength.error()));
  io::Report report = evaluate(*train, *strength);
  // the page's drawing does not wait for the files
  auto drawing = std::async(std::launch::async,
                            [report, &shapes] { return html_drawing(report, &*shapes); });
  const std::filesystem::path folder(options.folder);
  if (auto ok = io::create_folder(folder); !ok) return report_errors({ok.error()});
  const bool failed = verdict(report.findings) == CheckStatus::kFail;
  if (!failed || options.allow_failing) {
    std::optional<CompensatedShapes> compensated_shapes;  // which corrections displace
    CorrectedParts corrected;
    if (!options.correct.empty()) {
      if (options.compensate) {
        auto walls = compensated_walls(*shapes, *train->design.made.process, told);
        if (!walls) return report_errors(located_in(options.design, {walls.error()}));
        compensated_shapes = std::move(*walls);
      }
      const auto* walls = compensated_shapes ? &*compensated_shapes : nullptr;
      auto made = corrected_parts(*train, *shapes, walls, options.correct,
                                  mm_from_um(options.tolerance_um));
      if (!made) return report_errors(made.error());
      corrected = std::move(*made);
      formats = formats_of_corrected(*formats, options.compensate, corrected);
      told += corrected.text;
    }
    auto files = exported_files({.train = &*train,
                                 .shapes = options.correct.empty() ? &*shapes : &corrected.shapes,
                                 .meshes = corrected.meshes.empty() ? nullptr : &corrected.meshes},
                                {.folder = folder,
                                 .formats = *formats,
                                 .tolerance_mm = mm_from_um(options.tolerance_um),
                                 .kerf_mm = train->design.made.kerf_mm.value_or(0.0),
                                 .part = options.part},
                                options.compensate && options.correct.empty(), told);
    if (!files) {
      const bool of_design = files.error().front().key.starts_with("made.");
      return report_errors(of_design ? located_in(options.design, files.error()) : files.error());
    }
    if (compensated_shapes)
      for (io::ReportedFile& file : *files) file.compensated_for = train->design.made.process->name;
    report.tolerance_um = options.tolerance_um;
    report.files = std::move(*files);
    const auto scad = [](const io::ReportedFile& file) { return file.format == "scad"; };
    if (options.part.empty() && std::any_of(report.files.begin(), report.files.end(), scad))
      if (auto ok = io::write_scad_templates(folder, *train); !ok) return report_errors({ok.error()});
  }
  if (auto ok = write_report(report, drawing.get(), folder); !ok) return report_errors({ok.error()});
  if (!options.quiet) {
    std::string text = io::report_text(report, standard_output_colour());
    if (failed && !options.allow_failing)
      text += "no part was written: a check failed (--allow-failing writes them all the same)\n";
    else
      text += told + "written to " + options.folder + "\n";
    if (auto ok = print(text); !ok) return report_errors({ok.error()});
  }
  return failed ? 1 : 0;
}

}  // namespace trueflank::app
