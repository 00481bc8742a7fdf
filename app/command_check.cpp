// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <optional>

#include "trueflank/app/commands.h"
#include "trueflank/app/design_input.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/html_document.h"
#include "trueflank/app/terminal.h"
#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_picture.h"
#include "trueflank/check/modified_clearance.h"
#include "trueflank/check/tolerance_analysis.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank::app {
namespace {

Status add_tolerance(const GearTrain& train, const std::string& text, io::Report& report) {
  const auto options = parse_tolerance(text);
  if (!options) return fail(options.error());
  const auto result = analyse_tolerances(train, *options);
  if (!result) return fail(result.error());
  for (Finding& finding : check_tolerance(train, *result))
    report.findings.push_back(std::move(finding));
  return {};
}

Status draw_meshes(const GearTrain& train, const std::string& folder) {
  if (auto ok = io::create_folder(folder); !ok) return ok;
  for (const TrainMesh& mesh : train.meshes) {
    // modified flanks at the height where they come nearest
    const bool modified = is_modified(train, mesh);
    const MeshClearance nearest =
        modified ? modified_state(train, mesh).centred : mesh_clearance(train.pair(mesh));
    std::optional<MeshSection> section;
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

}  // namespace

int run_check(const CheckOptions& options) {
  const auto train = read_train(options.design, {.process = options.process, .kerf_mm = {}});
  if (!train) return report_errors(train.error());
  // What cannot be built is no design that passes, even where only solved shifts show it.
  const auto shapes = part_shapes(*train);
  if (!shapes) return report_errors(located_in(options.design, shapes.error()));
  const auto strength = strength_options(
      train->design, {.material = options.material, .file = options.materials_file});
  if (!strength) return report_errors(located_in(options.design, strength.error()));
  io::Report report = evaluate(*train, *strength);
  if (!options.tolerance.empty())
    if (auto ok = add_tolerance(*train, options.tolerance, report); !ok)
      return report_errors({ok.error()});
  // a document on standard output is alone there: scripts read it
  const bool document_on_output = options.json == "-" || options.html == "-";
  if (!options.json.empty())
    if (auto ok = write_document(options.json, io::report_json(report)); !ok)
      return report_errors({ok.error()});
  if (!options.html.empty()) {
    const std::string page = html_document(report, &*shapes);
    if (auto ok = write_document(options.html, page); !ok) return report_errors({ok.error()});
  }
  if (!options.pictures.empty())
    if (auto ok = draw_meshes(*train, options.pictures); !ok) return report_errors({ok.error()});
  if (!options.quiet && !document_on_output)
    if (auto ok = print(io::report_text(report, standard_output_colour())); !ok)
      return report_errors({ok.error()});
  return verdict(report.findings) == CheckStatus::kFail ? 1 : 0;
}

}  // namespace trueflank::app
