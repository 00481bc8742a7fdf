// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/exported_files.h"

#include <algorithm>

#include "trueflank/base/number_text.h"

namespace trueflank {
namespace {

std::string compensation_text(const Process& process, const CompensatedShapes& moved) {
  std::string text = "meshes are compensated for " + process.name + ": walls " +
                     whole_um(process.horizontal_expansion_mm) + " inwards";
  if (process.elephant_foot_mm > 0.0)
    text += ", chamfered by " + whole_um(process.elephant_foot_mm) +
            " at the face that lies on the bed (z = 0 of each part)";
  text += "\n";
  for (const std::string& note : moved.notes) text += note + "\n";
  return text;
}

}  // namespace

Findings accuracy_findings(const std::vector<io::ReportedFile>& files, double tolerance_um) {
  Findings findings;
  for (const io::ReportedFile& file : files) {
    if (!(file.accuracy_um > tolerance_um)) continue;
    const auto same = std::find_if(findings.begin(), findings.end(),
                                   [&](const Finding& f) { return f.where == file.part; });
    if (same != findings.end() && same->value >= file.accuracy_um) continue;
    const Finding finding{
        .id = "accuracy",
        .where = file.part,
        .status = CheckStatus::kFail,
        .value = file.accuracy_um,
        .limit = tolerance_um,
        .margin = tolerance_um - file.accuracy_um,
        .unit = "um",
        .message = file.path + " is up to " + printed_number(file.accuracy_um, "%.4g") +
                   " um off the true surface; finer facets do not bring it within the tolerance",
        .cure = "--tolerance-um " + printed_number(1.02 * file.accuracy_um, "%.2g") + " is kept"};
    if (same != findings.end())
      *same = finding;
    else
      findings.push_back(finding);
  }
  return findings;
}

Result<CompensatedShapes> compensated_walls(const PartShapes& shapes, const Process& process,
                                            std::string& told) {
  auto moved = compensated(shapes, process);
  if (moved) told += compensation_text(process, *moved);
  return moved;
}

ResultAll<std::vector<io::ReportedFile>> exported_files(const io::ExportModel& model,
                                                        io::ExportOptions options, bool compensate,
                                                        std::string& told) {
  const auto& formats = options.formats;
  const auto written = [&](io::FileFormat format) {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  };
  if (options.kerf_mm > 0.0 && !written(io::FileFormat::kDxf))
    told += "the kerf concerns DXF files, and none was written\n";
  if (options.step_schema != io::StepSchema::kAp214 && !written(io::FileFormat::kStep))
    told += "the schema concerns STEP files, and none was written\n";
  const auto& process = model.train->design.made.process;
  if (!compensate || !process) return io::export_parts(model, options);
  auto moved = compensated(*model.shapes, *process);
  if (!moved) return fail_all({std::move(moved.error())});

  io::ExportOptions meshes = options, others = options;
  meshes.formats.clear();
  others.formats.clear();
  for (io::FileFormat format : options.formats)
    (io::is_mesh(format) ? meshes : others).formats.push_back(format);
  std::vector<io::ReportedFile> files;
  if (!meshes.formats.empty()) {
    auto made = io::export_parts({.train = model.train, .shapes = &moved->shapes}, meshes);
    if (!made) return made;
    for (io::ReportedFile& file : *made) file.compensated_for = process->name;
    files = std::move(*made);
    told += compensation_text(*process, *moved);
  }
  if (others.formats.empty()) return files;
  auto made = io::export_parts(model, others);
  if (!made) return made;
  files.insert(files.end(), made->begin(), made->end());
  return files;
}

}  // namespace trueflank
