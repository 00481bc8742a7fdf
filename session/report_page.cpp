// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/report_page.h"

#include <filesystem>
#include <optional>

#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/tolerance_analysis.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/report/mesh_picture.h"
#include "trueflank/report/report_html.h"
#include "trueflank/report/report_model.h"
#include "trueflank/session/evaluate.h"

namespace trueflank {

std::string page_drawing(const io::Report& report, const PartShapes* shapes) {
  return io::report_model_json(
      report, {.shapes = shapes, .strength = report.strength ? &*report.strength : nullptr});
}

std::string report_page(const Gearbox& gearbox, const io::Report& report) {
  const auto& shapes = gearbox.parts();
  return io::report_html(report, io::report_json(report), page_drawing(report, shapes ? &*shapes : nullptr));
}

Status add_tolerance_findings(const std::string& tolerance, io::Report& report) {
  const auto options = parse_tolerance(tolerance);
  if (!options) return fail(options.error());
  const auto result = analyse_tolerances(*report.train, *options);
  if (!result) return fail(result.error());
  // what is asked for on the command line stands for what the design says
  renew_findings(report.findings, check_tolerance(*report.train, *result));
  return {};
}

Status write_mesh_pictures(const GearTrain& train, const std::string& folder) {
  if (auto ok = io::create_folder(folder); !ok) return ok;
  for (const TrainMesh& mesh : train.meshes) {
    // modified flanks at the height where they come nearest
    const bool modified = is_modified(train, mesh);
    const MeshClearance nearest =
        modified ? modified_state(train, mesh).centred : mesh_clearance(train.pair(mesh));
    std::optional<PairSection> section;
    if (modified) section = mesh_section(train, mesh, nearest.z_mm);
    const std::string svg = mesh_picture_svg(
        section ? section->pair() : train.pair(mesh), nearest,
        {.name1 = train.gears[static_cast<std::size_t>(mesh.gear1)].name,
         .name2 = train.gears[static_cast<std::size_t>(mesh.gear2)].name});
    if (auto ok = io::write_file(std::filesystem::path(folder) / (mesh.name + ".svg"), svg); !ok)
      return ok;
  }
  return {};
}

}  // namespace trueflank
