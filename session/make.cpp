// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/make.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "trueflank/base/threads.h"
#include "trueflank/check/finding.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/number_text.h"
#include "trueflank/export/scad/scad_templates.h"
#include "trueflank/report/drawing/workshop_drawings.h"
#include "trueflank/report/render/gearbox_pictures.h"
#include "trueflank/report/report_html.h"
#include "trueflank/session/corrected_parts.h"
#include "trueflank/session/earlier_files.h"
#include "trueflank/session/evaluate.h"
#include "trueflank/session/exported_files.h"
#include "trueflank/session/gearbox_files.h"
#include "trueflank/session/job_size.h"
#include "trueflank/session/report_page.h"

namespace trueflank {
namespace {

/// Finest and coarsest tolerance: below, doubles and file sizes end; above, teeth are no teeth.
constexpr double kFinestTolerance_um = 0.001;
constexpr double kCoarsestTolerance_um = 1000.0;

Errors part_errors(const MakeOptions& options, const PartShapes& shapes) {
  if (options.part.empty()) return {};
  std::string names;
  for (const PartShape& part : shapes.parts) {
    if (part.name == options.part) return {};
    names += (names.empty() ? "" : ", ") + part.name;
  }
  return {{.code = ErrorCode::kUsage,
           .message = "this design has no such part",
           .key = "--part",
           .value = options.part,
           .remedy = names}};
}

Status write_report(const io::Report& report, const std::string& drawing,
                    const std::filesystem::path& folder) {
  const std::string json = io::report_json(report);
  if (auto ok = io::write_file(folder / "report.html", io::report_html(report, json, drawing)); !ok)
    return ok;
  return io::write_file(folder / "report.json", json);
}

/// One run of make_parts on a gearbox whose parts exist.
class Maker {
 public:
  Maker(const Gearbox& gearbox, const PartShapes& shapes, const MakeOptions& options)
      : gearbox_(gearbox), shapes_(shapes), options_(options) {}

  /// The files of all parts, in the formats that can hold what is asked for.
  ResultAll<std::vector<io::ReportedFile>> write(std::vector<io::FileFormat> formats) {
    const bool correct = !options_.correct.empty();
    CorrectedParts corrected;
    if (correct) {
      auto made = corrected_shapes();
      if (!made) return fail_all(std::move(made.error()));
      corrected = std::move(*made);
      if (Errors errors = job_size_errors(corrected.shapes, formats, options_.part,
                                          mm_from_um(options_.tolerance_um), corrected.operations);
          !errors.empty())
        return fail_all(std::move(errors));
      formats = formats_of_corrected(formats, options_.compensate, corrected);
      notes_ += corrected.text;
    }
    auto files =
        exported_files({.train = &gearbox_.train(),
                        .shapes = correct ? &corrected.shapes : &shapes_,
                        .changes = corrected.changes.empty() ? nullptr : &corrected.changes,
                        .proved = corrected.changed},
                       {.folder = options_.folder,
                        .formats = formats,
                        .tolerance_mm = mm_from_um(options_.tolerance_um),
                        .kerf_mm = gearbox_.design().made.kerf_mm.value_or(0.0),
                        .step_schema = *io::step_schema_of(options_.step_schema),
                        .part = options_.part,
                        .on_written = options_.on_written},
                       options_.compensate && !correct, notes_);
    if (!files) {
      for (Error& error : files.error())
        if (correct && error.file.empty() && error.key.empty() && exit_code(error.code) == 2) {
          error.message += " once it is corrected";
          error.key = "effects";
          error.file = options_.correct;
        }
      const bool of_design = files.error().front().key.starts_with("made.");
      return fail_all(of_design ? gearbox_.located(files.error()) : files.error());
    }
    if (correct && options_.compensate)
      for (io::ReportedFile& file : *files)
        file.compensated_for = gearbox_.design().made.process->name;
    return files;
  }

  /// What was corrected, compensated or left out.
  std::string notes() { return std::move(notes_); }

 private:
  ResultAll<CorrectedParts> corrected_shapes() {
    std::optional<CompensatedShapes> walls;  // which corrections displace
    if (options_.compensate) {
      auto moved = compensated_walls(shapes_, *gearbox_.design().made.process, notes_);
      if (!moved) return fail_all(gearbox_.located({moved.error()}));
      walls = std::move(*moved);
    }
    return corrected_parts(gearbox_.train(), shapes_, walls ? &*walls : nullptr, options_.correct);
  }

  const Gearbox& gearbox_;
  const PartShapes& shapes_;
  const MakeOptions& options_;
  std::string notes_;
};

/// Sheets of the parts as designed: what a correction adds for its process is not on paper.
Result<std::vector<io::ReportedFile>> write_drawings(const Gearbox& gearbox,
                                                     const PartShapes& shapes,
                                                     const io::Report& report,
                                                     const StrengthOptions& materials,
                                                     const MakeOptions& options) {
  const auto json = nlohmann::ordered_json::parse(io::report_json(report));
  return io::write_workshop_drawings(
      {.train = &gearbox.train(), .shapes = &shapes, .report = &json, .materials = &materials},
      {.folder = options.folder, .part = options.part});
}

bool has_scad(const std::vector<io::ReportedFile>& files) {
  return std::any_of(files.begin(), files.end(), [](const io::ReportedFile& file) {
    return file.format == io::to_text(io::FileFormat::kScad);
  });
}

/// Parts that miss the tolerance are failed checks, and are taken away again as those of any other.
void judge_accuracy(const MakeOptions& options, MakeResult& result) {
  const Findings missed = accuracy_findings(result.report.files, options.tolerance_um);
  if (missed.empty()) return;
  result.failed = true;
  result.report.findings.insert(result.report.findings.end(), missed.begin(), missed.end());
  result.written = options.allow_failing;
  if (result.written) return;
  for (const io::ReportedFile& file : result.report.files) {
    std::error_code error;
    std::filesystem::remove(options.folder / file.path, error);
  }
  result.report.files.clear();
}

/// Bill of materials of a gearbox, print plates for a bed.
ResultAll<bool> write_gearbox_files(const Gearbox& gearbox, const PartShapes& shapes,
                                    const MakeOptions& options,
                                    const std::vector<io::FileFormat>& formats,
                                    MakeResult& result) {
  std::vector<io::ReportedFile>& files = result.report.files;
  if (!result.report.bill.empty()) {
    auto bill = write_bill(result.report.bill, options.folder);
    if (!bill) return fail_all({bill.error()});
    files.push_back(std::move(*bill));
    auto guide = write_build_guide(gearbox.train(), shapes, result.report.bill, options.folder);
    if (!guide) return fail_all({guide.error()});
    if (*guide) files.push_back(std::move(**guide));
  }
  const MadeDesign& made = gearbox.design().made;
  if (made.bed.empty() || std::count(formats.begin(), formats.end(), io::FileFormat::k3mf) == 0)
    return true;
  if (!options.correct.empty()) {
    result.notes +=
        "print plates hold the parts as designed: none was written beside corrected parts\n";
    return true;
  }
  auto plates = write_plates(gearbox.design().name, shapes,
                             {.folder = options.folder,
                              .bed = made.bed,
                              .tolerance_mm = mm_from_um(options.tolerance_um),
                              .compensate_for = options.compensate ? &*made.process : nullptr});
  if (!plates) return fail_all(gearbox.located(plates.error()));
  files.insert(files.end(), plates->begin(), plates->end());
  return true;
}

/// The files of a design whose checks allow it, and what its result says of them.
Errors write_parts(const Gearbox& gearbox, const PartShapes& shapes,
                   const StrengthOptions& materials, const MakeOptions& options,
                   MakeResult& result) {
  Maker maker(gearbox, shapes, options);
  const std::vector<io::FileFormat> formats = *io::parse_formats(options.formats);
  auto files = maker.write(formats);
  if (!files) return std::move(files.error());
  result.notes = maker.notes();
  result.report.tolerance_um = options.tolerance_um;
  result.report.files = std::move(*files);
  judge_accuracy(options, result);
  if (!result.written) return {};
  if (std::count(formats.begin(), formats.end(), io::FileFormat::kPdf) > 0) {
    const auto sheets = write_drawings(gearbox, shapes, result.report, materials, options);
    if (!sheets) return {sheets.error()};
    result.report.files.insert(result.report.files.end(), sheets->begin(), sheets->end());
  }
  const io::PictureOptions wanted{
      .folder = options.folder, .part = options.part, .on_written = options.on_written};
  for (const auto& [format, write] :
       {std::pair{io::FileFormat::kPng, &io::write_pictures},
        std::pair{io::FileFormat::kApng, &io::write_turning_picture}}) {
    if (std::count(formats.begin(), formats.end(), format) == 0) continue;
    const auto pictures = write(gearbox.train(), shapes, wanted);
    if (!pictures) return {pictures.error()};
    result.report.files.insert(result.report.files.end(), pictures->begin(), pictures->end());
  }
  if (options.part.empty())
    if (auto ok = write_gearbox_files(gearbox, shapes, options, formats, result); !ok)
      return std::move(ok.error());
  if (options.part.empty() && has_scad(result.report.files)) {
    const auto templates = io::write_scad_templates(options.folder, gearbox.train());
    if (!templates) return {templates.error()};
    result.report.files.insert(result.report.files.end(), templates->begin(), templates->end());
  }
  return {};
}

}  // namespace

Errors errors_of(const MakeOptions& options) {
  Errors errors;
  if (auto formats = io::parse_formats(options.formats); !formats) errors = formats.error();
  if (auto schema = io::step_schema_of(options.step_schema); !schema)
    errors.push_back(std::move(schema.error()));
  if (!(options.tolerance_um >= kFinestTolerance_um &&
        options.tolerance_um <= kCoarsestTolerance_um))
    errors.push_back({.code = ErrorCode::kUsage,
                      .message = "no tolerance for a part",
                      .key = "--tolerance-um",
                      .value = io::decimal_text(options.tolerance_um),
                      .remedy = "0.001 to 1000"});
  return errors;
}

ResultAll<MakeResult> make_parts(const Gearbox& gearbox, const MakeOptions& options) {
  if (Errors errors = errors_of(options); !errors.empty()) return fail_all(std::move(errors));
  const auto& shapes = gearbox.parts();
  if (!shapes) return fail_all(shapes.error());
  if (Errors errors = part_errors(options, *shapes); !errors.empty())
    return fail_all(std::move(errors));
  if (options.compensate && !gearbox.design().made.process)
    return fail_all({{.code = ErrorCode::kUsage,
                      .message = "compensation needs a process",
                      .key = "--compensate",
                      .remedy = "--process NAME, or [made] process in the design"}});
  if (Errors errors = job_size_errors(*shapes, *io::parse_formats(options.formats), options.part,
                                      mm_from_um(options.tolerance_um));
      !errors.empty())
    return fail_all(std::move(errors));
  const auto strength = strength_options(gearbox, {.material = "", .file = options.materials_file});
  if (!strength) return fail_all(strength.error());

  MakeResult result{.report = evaluate(gearbox, *strength)};
  // the page's drawing does not wait for the files
  auto drawing =
      begun_beside([report = result.report, &shapes] { return page_drawing(report, &*shapes); });
  if (auto ok = io::create_folder(options.folder); !ok) return fail_all({ok.error()});
  result.failed = verdict(result.report.findings) == CheckStatus::kFail;
  result.written = !result.failed || options.allow_failing;
  if (result.written)
    if (Errors errors = write_parts(gearbox, *shapes, *strength, options, result); !errors.empty())
      return fail_all(std::move(errors));
  if (!result.written) result.removed = remove_earlier_files(options.folder);
  if (auto ok = write_report(result.report, drawing.get(), options.folder); !ok)
    return fail_all({ok.error()});
  return result;
}

}  // namespace trueflank
