// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/workshop_drawings.h"

#include <nlohmann/json.hpp>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

ReportedFile reported(const std::filesystem::path& path, const std::string& part, const char* format) {
  std::error_code unknown;
  return {.path = path.filename().string(),
          .part = part,
          .format = format,
          .bytes = std::filesystem::file_size(path, unknown)};
}

}  // namespace

Result<std::vector<ReportedFile>> write_workshop_drawings(const DrawingModel& model, const DrawingOptions& options) {
  TRUEFLANK_EXPECTS(model.train && model.shapes && model.report && model.materials);
  std::vector<Sheet> sheets;
  for (const PartShape& part : model.shapes->parts)
    if (options.part.empty() ? part.bought.empty() : options.part == part.name) sheets.push_back(part_sheet(model, part));
  if (options.part.empty() && model.shapes->assembly.size() > 1) sheets.push_back(assembly_sheet(model));
  std::vector<ReportedFile> files;
  for (const Sheet& sheet : sheets) {
    const std::filesystem::path pdf = options.folder / (sheet.name + ".pdf");
    if (auto ok = write_pdf(pdf, {sheet}); !ok) return fail(ok.error());
    files.push_back(reported(pdf, sheet.name, "pdf"));
    const std::filesystem::path dxf = options.folder / (sheet.name + "_drawing.dxf");
    if (auto ok = write_sheet_dxf(dxf, sheet); !ok) return fail(ok.error());
    files.push_back(reported(dxf, sheet.name, "dxf"));
  }
  return files;
}

}  // namespace trueflank::io
