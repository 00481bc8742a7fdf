// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/gearbox_files.h"

#include <algorithm>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/threemf_writer.h"
#include "trueflank/report/build_html.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/machine/print_plates.h"
#include "trueflank/solid/shape/process_compensation.h"
#include "trueflank/train/machine/bed.h"

namespace trueflank {
namespace {

/// Turned over about x: the upper face comes to lie at z = 0.
void turn_over(TriangleMesh& mesh) {
  double top = 0.0;
  for (const auto& v : mesh.vertices) top = std::max(top, v[2]);
  for (auto& v : mesh.vertices) v = {v[0], -v[1], top - v[2]};
}

io::ReportedFile reported(const std::filesystem::path& folder, const std::string& name,
                          const char* format) {
  std::error_code unknown;
  return {.path = name,
          .part = name.substr(0, name.rfind('.')),
          .format = format,
          .bytes = std::filesystem::file_size(folder / name, unknown)};
}

/// The walls as the process wants them. The foot is on the face that lies on the bed: of a part
/// that is turned over no chamfer is known, it is left out.
Result<PartShapes> printed_shapes(const PartShapes& shapes, const Process* process,
                                  bool turned_over) {
  if (!process) return shapes;
  Process used = *process;
  if (turned_over) used.elephant_foot_mm = 0.0;
  auto moved = compensated(shapes, used);
  if (!moved) return fail(std::move(moved.error()));
  return std::move(moved->shapes);
}

/// A mesh a part that is made, as it lies on the bed.
Result<std::vector<TriangleMesh>> bed_meshes(const PartShapes& shapes,
                                             const PlateOptions& options) {
  std::vector<TriangleMesh> meshes(shapes.parts.size());
  for (const bool turned_over : {false, true}) {
    const auto printed = printed_shapes(shapes, options.compensate_for, turned_over);
    if (!printed) return fail(printed.error());
    for (std::size_t i = 0; i < shapes.parts.size(); ++i) {
      const PartShape& part = shapes.parts[i];
      if (!part.bought.empty() || part.upside_down != turned_over) continue;
      meshes[i] = part_mesh(printed->parts[i], {.tolerance_mm = options.tolerance_mm}).mesh;
      if (turned_over) turn_over(meshes[i]);
    }
  }
  return meshes;
}

}  // namespace

ResultAll<std::vector<io::ReportedFile>> write_plates(const std::string& design_name,
                                                      const PartShapes& shapes,
                                                      const PlateOptions& options) {
  const auto plates = print_plates(shapes, *find_bed(options.bed));
  if (!plates) return fail_all({plates.error()});
  const auto meshes = bed_meshes(shapes, options);
  if (!meshes) return fail_all({meshes.error()});
  std::vector<io::ReportedFile> files;
  for (const PrintPlate& plate : *plates) {
    const std::string name = "plate_" + std::to_string(files.size() + 1);
    io::Scene scene{.name = design_name, .shapes = {}, .bodies = {}, .loose = true};
    std::vector<int> shape_of(shapes.parts.size(), -1);
    double volume = 0.0;
    for (const PrintedPart& printed : plate) {
      const auto i = static_cast<std::size_t>(printed.part);
      const PartShape& part = shapes.parts[i];
      if (shape_of[i] < 0) {
        shape_of[i] = static_cast<int>(scene.shapes.size());
        scene.shapes.push_back({part.name, &(*meshes)[i], io::part_colour(part.role)});
      }
      scene.bodies.push_back({.part = shape_of[i],
                              .name = part.name,
                              .translation_mm = {printed.at_mm.x(), printed.at_mm.y(), 0.0}});
      volume += volume_mm3((*meshes)[i]);
    }
    if (auto ok = io::write_3mf(options.folder / (name + ".3mf"), scene); !ok)
      return fail_all({ok.error()});
    files.push_back(reported(options.folder, name + ".3mf", io::to_text(io::FileFormat::k3mf)));
    files.back().triangles = io::triangle_count(scene);
    files.back().volume_mm3 = volume;
    files.back().compensated_for = options.compensate_for ? options.compensate_for->name : "";
  }
  return files;
}

Result<io::ReportedFile> write_bill(const BillOfMaterials& bill,
                                    const std::filesystem::path& folder) {
  if (auto ok = io::write_file(folder / "bom.csv", bill_csv(bill)); !ok) return fail(ok.error());
  return reported(folder, "bom.csv", "csv");
}

Result<std::optional<io::ReportedFile>> write_build_guide(const GearTrain& train,
                                                          const PartShapes& shapes,
                                                          const BillOfMaterials& bill,
                                                          const std::filesystem::path& folder) {
  const AssemblyOrder order = assembly_order(train, shapes);
  if (!order.exists()) return std::nullopt;
  const std::string page =
      io::build_html(train, shapes, io::build_guide(train, shapes, order), bill);
  if (auto ok = io::write_file(folder / "build.html", page); !ok) return fail(ok.error());
  return reported(folder, "build.html", "html");
}

}  // namespace trueflank
