// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/export_parts.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "trueflank/base/contract.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/dxf_writer.h"
#include "trueflank/export/glb_writer.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/obj_writer.h"
#include "trueflank/export/parallel_jobs.h"
#include "trueflank/export/ply_writer.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/section_contour.h"
#include "trueflank/export/step_writer.h"
#include "trueflank/export/stl_writer.h"
#include "trueflank/export/svg_writer.h"
#include "trueflank/export/threemf_writer.h"

namespace trueflank::io {
namespace {

using MeshWriter = Status (*)(const std::filesystem::path&, const Scene&);

/// nullptr for formats that are no meshes.
MeshWriter mesh_writer(FileFormat format) {
  switch (format) {
    case FileFormat::kStl: return write_stl;
    case FileFormat::k3mf: return write_3mf;
    case FileFormat::kObj: return write_obj;
    case FileFormat::kPly: return write_ply;
    case FileFormat::kGlb: return write_glb;
    default: return nullptr;
  }
}

constexpr int kAssembly = -1;

struct Job {
  int part = kAssembly;  ///< index into PartShapes::parts
  FileFormat format = FileFormat::kStl;
};

/// Writes the files of one call of export_parts; its jobs share what several of them need.
class Exporter {
 public:
  Exporter(const ExportModel& model, const ExportOptions& options)
      : train_(*model.train), shapes_(*model.shapes), meshes_(model.meshes), options_(options) {}

  ResultAll<std::vector<ReportedFile>> run() {
    if (auto status = plan(); !status) return fail_all({std::move(status.error())});
    if (auto status = create_folder(options_.folder); !status)
      return fail_all({std::move(status.error())});
    const auto has = [&](FileFormat format) {
      return std::any_of(jobs_.begin(), jobs_.end(), [&](const Job& j) { return j.format == format; });
    };
    if (has(FileFormat::kStep)) make_solids();
    files_.resize(jobs_.size());
    if (errors_.empty())
      run_jobs(jobs_.size(), [&](std::size_t i) { return keep_error(run(jobs_[i], files_[i])); });
    if (!errors_.empty()) return fail_all(std::move(errors_));
    return std::move(files_);
  }

 private:
  Status plan() {
    const auto& parts = shapes_.parts;
    const bool all = options_.part.empty();
    for (int i = 0; i < static_cast<int>(parts.size()); ++i)
      if (all || parts[i].name == options_.part)
        for (const FileFormat format : options_.formats) jobs_.push_back({i, format});
    if (jobs_.empty() && !all) {
      std::string names;
      for (const PartShape& part : parts) names += (names.empty() ? "" : ", ") + part.name;
      return fail(Error{.code = ErrorCode::kUsage,
                        .message = "this design has no part '" + options_.part + "'",
                        .key = "--part",
                        .value = options_.part,
                        .remedy = "one of " + names});
    }
    if (all && shapes_.assembly.size() > 1)
      for (const FileFormat format : options_.formats) jobs_.push_back({kAssembly, format});
    return {};
  }

  bool keep_error(Status status) {
    if (status) return true;
    const std::lock_guard lock(mutex_);
    errors_.push_back(std::move(status.error()));
    return false;
  }

  /// Solids serve the files of the parts and that of the assembly.
  void make_solids() {
    solids_.resize(shapes_.parts.size());
    run_jobs(solids_.size(), [&](std::size_t i) {
      const PartShape& shape = shapes_.parts[i];
      auto solid = brep_of(shape);
      if (!solid) return keep_error(fail(std::move(solid.error())));
      const Colour colour = part_colour(shape.name);
      solids_[i] = {shape.name, std::move(*solid),
                    {colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0}};
      return true;
    });
  }

  Status run(const Job& job, ReportedFile& file) {
    file.part = job.part == kAssembly ? "assembly" : shapes_.parts[job.part].name;
    file.format = to_text(job.format);
    file.path = file.part + "." + file.format;
    const std::filesystem::path path = options_.folder / file.path;
    if (auto status = write(job, path, file); !status) return status;
    std::error_code error;
    file.bytes = std::filesystem::file_size(path, error);
    if (options_.on_written) {
      const std::lock_guard lock(mutex_);
      options_.on_written(file.path);
    }
    return {};
  }

  Status write(const Job& job, const std::filesystem::path& path, ReportedFile& file) {
    if (const MeshWriter writer = mesh_writer(job.format)) {
      if (auto status = writer(path, scene_of(job)); !status) return status;
      return measure(job, path, file);
    }
    if (job.format == FileFormat::kStep) return write_step(job, path, file);
    const auto sections = job.part == kAssembly
                              ? assembly_sections(shapes_, options_.tolerance_mm)
                              : part_sections(shapes_.parts[job.part], options_.tolerance_mm);
    if (job.format == FileFormat::kDxf) return write_dxf(path, sections);
    return write_svg(path, train_.design.name + ": " + file.part, sections);
  }

  Scene scene_of(const Job& job) const {
    TRUEFLANK_EXPECTS(meshes_ != nullptr && meshes_->size() == shapes_.parts.size());
    if (job.part != kAssembly)
      return part_scene(train_.design.name, shapes_.parts[job.part].name, (*meshes_)[job.part].mesh);
    Scene scene{train_.design.name, {}, shapes_.assembly};
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i)
      scene.shapes.push_back(
          {shapes_.parts[i].name, &(*meshes_)[i].mesh, part_colour(shapes_.parts[i].name)});
    return scene;
  }

  Status write_step(const Job& job, const std::filesystem::path& path, ReportedFile& file) const {
    if (job.part != kAssembly) {
      file.accuracy_um = um_from_mm(solids_[job.part].solid.fit_error_mm);
      return write_file(path, step_text(solids_[job.part]));
    }
    file.accuracy_um = 0.0;
    for (const StepPart& part : solids_)
      file.accuracy_um = std::max(file.accuracy_um, um_from_mm(part.solid.fit_error_mm));
    return write_file(path, step_text(solids_, shapes_.assembly, train_.design.name));
  }

  /// Reads the file as written and measures it.
  Status measure(const Job&, const std::filesystem::path& path, ReportedFile& file) const {
    const auto mesh = read_mesh(path);
    if (!mesh) return fail(mesh.error());
    file.triangles = mesh->triangles.size();
    file.volume_mm3 = volume_mm3(*mesh);
    return {};
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  const std::vector<PartMesh>* meshes_;
  const ExportOptions& options_;
  std::vector<Job> jobs_;
  std::vector<StepPart> solids_;
  std::vector<ReportedFile> files_;
  std::mutex mutex_;
  Errors errors_;
};

}  // namespace

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> all = {
      FileFormat::kStl, FileFormat::k3mf, FileFormat::kObj, FileFormat::kPly, FileFormat::kGlb,
      FileFormat::kStep, FileFormat::kDxf, FileFormat::kSvg};
  return all;
}

const char* to_text(FileFormat format) {
  constexpr std::array kNames = {"stl", "3mf", "obj", "ply", "glb", "step", "dxf", "svg"};
  return kNames[static_cast<std::size_t>(format)];
}

Result<std::vector<FileFormat>> parse_formats(std::string_view list) {
  std::vector<FileFormat> formats;
  while (true) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view name = list.substr(0, comma);
    while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    const auto& all = file_formats();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](FileFormat format) { return name == to_text(format); });
    if (found == all.end()) {
      std::string names;
      for (const FileFormat format : all) names += std::string(names.empty() ? "" : ",") + to_text(format);
      return fail(Error{.code = ErrorCode::kUsage,
                        .message = "'" + std::string(name) + "' is no format",
                        .key = "--formats",
                        .value = std::string(name),
                        .remedy = "any of " + names});
    }
    if (std::find(formats.begin(), formats.end(), *found) == formats.end()) formats.push_back(*found);
    if (comma == list.size()) return formats;
    list.remove_prefix(comma + 1);
  }
}

ResultAll<std::vector<ReportedFile>> export_parts(const ExportModel& model,
                                                  const ExportOptions& options) {
  TRUEFLANK_EXPECTS(model.train != nullptr && model.shapes != nullptr);
  return Exporter(model, options).run();
}

}  // namespace trueflank::io
