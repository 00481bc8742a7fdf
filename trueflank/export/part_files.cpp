// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/part_files.h"

#include <algorithm>
#include <cmath>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/glb_writer.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/obj_writer.h"
#include "trueflank/export/ply_writer.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/step_writer.h"
#include "trueflank/export/stl_writer.h"
#include "trueflank/export/threemf_writer.h"
#include "trueflank/solid/brep.h"
#include "trueflank/solid/gear_mesh.h"

namespace trueflank::io {
namespace {

using MeshWriter = Status (*)(const std::filesystem::path&, const Scene&);

MeshWriter mesh_writer(const std::string& format) {
  if (format == "stl") return write_stl;
  if (format == "3mf") return write_3mf;
  if (format == "obj") return write_obj;
  if (format == "ply") return write_ply;
  if (format == "glb") return write_glb;
  return nullptr;
}

class PartFiles {
 public:
  PartFiles(const GearTrain& train, const PartShapes& shapes, const std::filesystem::path& folder,
            const PartFilesOptions& options)
      : train_(train), shapes_(shapes), folder_(folder), options_(options) {}

  Result<std::vector<ReportedFile>> write() {
    for (const PartShape& shape : shapes_.parts)
      meshes_.push_back(wants_meshes() && wanted(shape)
                            ? part_mesh(shape, {.tolerance_mm = options_.tolerance_mm})
                            : PartMesh{});
    for (const std::string& format : options_.formats) {
      Status ok = mesh_writer(format) ? write_meshes(format)
                  : format == "step"  ? write_step()
                                      : Status{};
      if (!ok) return fail(ok.error());
    }
    return std::move(files_);
  }

 private:
  [[nodiscard]] bool wanted(const PartShape& shape) const {
    return options_.part.empty() || shape.name == options_.part;
  }
  [[nodiscard]] bool wants_meshes() const {
    return std::any_of(options_.formats.begin(), options_.formats.end(),
                       [](const std::string& f) { return mesh_writer(f) != nullptr; });
  }
  [[nodiscard]] bool has_assembly() const {
    return options_.part.empty() && shapes_.assembly.size() > 1;
  }

  Status write_meshes(const std::string& format) {
    const MeshWriter writer = mesh_writer(format);
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i) {
      const PartShape& shape = shapes_.parts[i];
      if (!wanted(shape)) continue;
      const std::string name = shape.name + "." + format;
      const Scene scene = part_scene(train_.design.name, shape.name, meshes_[i].mesh);
      if (auto ok = writer(folder_ / name, scene); !ok) return ok;
      if (auto ok = measure(name, shape.name, format, meshes_[i]); !ok) return ok;
    }
    if (!has_assembly()) return {};
    Scene scene{.name = train_.design.name, .bodies = shapes_.assembly};
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i)
      scene.shapes.push_back(
          {shapes_.parts[i].name, &meshes_[i].mesh, part_colour(shapes_.parts[i].name)});
    const std::string name = "assembly." + format;
    if (auto ok = writer(folder_ / name, scene); !ok) return ok;
    add(name, "assembly", format);
    files_.back().triangles = triangle_count(scene);
    return {};
  }

  void add(const std::string& name, const std::string& part, const std::string& format) {
    std::error_code ignored;
    ReportedFile file{.path = name, .part = part, .format = format};
    file.bytes = std::filesystem::file_size(folder_ / name, ignored);
    files_.push_back(std::move(file));
  }

  Status measure(const std::string& name, const std::string& part, const std::string& format,
                 const PartMesh& made) {
    const auto read = read_mesh(folder_ / name);
    if (!read) return fail(read.error());
    add(name, part, format);
    files_.back().triangles = read->triangles.size();
    files_.back().volume_mm3 = volume_mm3(*read);
    files_.back().accuracy_um = um_from_mm(made.chord_error_mm);
    return {};
  }

  Status write_step() {
    std::vector<StepPart> parts;
    for (const PartShape& shape : shapes_.parts) {
      if (!wanted(shape)) continue;
      auto solid = brep_of(shape);
      if (!solid) return fail(solid.error());
      const Colour colour = part_colour(shape.name);
      parts.push_back({.name = shape.name,
                       .solid = std::move(*solid),
                       .colour = {colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0}});
      const std::string name = shape.name + ".step";
      if (auto ok = write_file(folder_ / name, step_text(parts.back())); !ok) return ok;
      add(name, shape.name, "step");
    }
    if (!has_assembly()) return {};
    if (auto ok = write_file(folder_ / "assembly.step",
                             step_text(parts, shapes_.assembly, train_.design.name));
        !ok)
      return ok;
    add("assembly.step", "assembly", "step");
    return {};
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  const std::filesystem::path& folder_;
  const PartFilesOptions& options_;
  std::vector<PartMesh> meshes_;
  std::vector<ReportedFile> files_;
};

}  // namespace

const std::vector<std::string>& format_names() {
  static const std::vector<std::string> names{"stl", "3mf", "obj", "ply", "glb",
                                              "step", "dxf", "svg", "scad"};
  return names;
}

Result<std::vector<ReportedFile>> write_part_files(const GearTrain& train, const PartShapes& shapes,
                                                   const std::filesystem::path& folder,
                                                   const PartFilesOptions& options) {
  return PartFiles(train, shapes, folder, options).write();
}

}  // namespace trueflank::io
