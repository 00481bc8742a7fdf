// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/export_parts.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/facet_comparison.h"
#include "trueflank/export/glb_writer.h"
#include "trueflank/export/known_meshes.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/obj_writer.h"
#include "trueflank/export/parallel_jobs.h"
#include "trueflank/export/ply_writer.h"
#include "trueflank/export/scad/scad_writer.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/section/dxf_writer.h"
#include "trueflank/export/section/kerf_path.h"
#include "trueflank/export/section/section_contour.h"
#include "trueflank/export/section/svg_writer.h"
#include "trueflank/export/step/step_writer.h"
#include "trueflank/export/stl_writer.h"
#include "trueflank/export/threemf_writer.h"
#include "trueflank/solid/measure/measured_mesh.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/solid_fault.h"
#include "trueflank/solid/shape/crossing_outlines.h"
#include "trueflank/solid/shape/outline_loop.h"

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
double largest_chord_error_mm(const std::vector<Section>& sections) {
  double largest_mm = 0.0;
  for (const Section& section : sections)
    for (const SectionBody& body : section.bodies) {
      largest_mm = std::max(largest_mm, body.outer.chord_error_mm);
      for (const Contour& hole : body.holes) largest_mm = std::max(largest_mm, hole.chord_error_mm);
    }
  return largest_mm;
}

/// One piece of the work, and the pieces before it that must be done first.
struct Task {
  std::function<Status()> work;
  std::vector<std::size_t> needs;
};

struct Job {
  int part = kAssembly;  ///< index into PartShapes::parts
  FileFormat format = FileFormat::kStl;
};

/// Writes the files of one call of export_parts; its jobs share what several of them need.
class Exporter {
 public:
  Exporter(const ExportModel& model, const ExportOptions& options)
      : train_(*model.train),
        shapes_(*model.shapes),
        given_meshes_(model.meshes),
        changes_(model.changes),
        proved_(model.proved),
        options_(options) {}

  ResultAll<std::vector<ReportedFile>> run() {
    if (auto status = plan(); !status) return fail_all({std::move(status.error())});
    if (auto status = create_folder(options_.folder); !status)
      return fail_all({std::move(status.error())});
    const auto has = [&](FileFormat format) {
      return std::any_of(jobs_.begin(), jobs_.end(), [&](const Job& j) { return j.format == format; });
    };
    if (has(FileFormat::kStep)) make_solids();
    files_.resize(jobs_.size());
    rounding_mm_.resize(jobs_.size());
    if (!error_) make_files(has(FileFormat::k3mf));
    if (error_) return fail_all({std::move(*error_)});
    add_accuracies();
    return std::move(files_);
  }

 private:
  Status plan() {
    const auto& parts = shapes_.parts;
    const bool all = options_.part.empty();
    for (int i = 0; i < static_cast<int>(parts.size()); ++i)
      if (all ? parts[i].bought.empty() : parts[i].name == options_.part)
        for (const FileFormat format : options_.formats)
          if (!is_paper(format)) jobs_.push_back({i, format});
    const bool known = all || std::any_of(parts.begin(), parts.end(),
                                          [&](const PartShape& p) { return p.name == options_.part; });
    if (!known) {
      std::string names;
      for (const PartShape& part : parts) names += (names.empty() ? "" : ", ") + part.name;
      return fail(Error{.code = ErrorCode::kUsage,
                        .message = "this design has no such part",
                        .key = "--part",
                        .value = options_.part,
                        .remedy = names});
    }
    if (all && shapes_.assembly.size() > 1)
      for (const FileFormat format : options_.formats)
        if (!is_paper(format)) jobs_.push_back({kAssembly, format});
    return {};
  }

  /// Meshes, what 3MF files hold of them, and files; each as soon as there is what it needs.
  void make_files(bool packed) {
    const auto is_mesh = [](const Job& j) { return io::is_mesh(j.format); };
    std::vector<Task> queue;
    const auto add = [&](std::vector<std::size_t> needs, std::function<Status()> work) {
      queue.push_back({std::move(work), std::move(needs)});
      return queue.size() - 1;
    };
    std::vector<std::vector<std::size_t>> prepared(shapes_.parts.size());  // the last job of each part
    if (std::any_of(jobs_.begin(), jobs_.end(), is_mesh)) {
      meshes_.resize(shapes_.parts.size());
      for (const std::size_t i : parts_largest_first())
        prepared[i] = {add({}, [this, i, tolerance_mm = mesh_tolerance_mm()] {
          return make_mesh(i, tolerance_mm);
        })};
    }
    if (packed) {
      packed_meshes_.resize(shapes_.parts.size());
      known_meshes_.resize(shapes_.parts.size());
      for (const std::size_t i : parts_largest_first())
        prepared[i] = {add(prepared[i], [this, i] {
          packed_meshes_[i] = packed_3mf_mesh(meshes_[i].part.mesh);
          known_meshes_[i].packed = packed_meshes_[i].bytes();
          return Status{};
        })};
    }
    std::vector<std::size_t>
        packed_parts;  // their files are read back before that of all: they tell what it holds
    const auto add_file = [&](std::size_t i, std::vector<std::size_t> needs) {
      if (is_mesh(jobs_[i]))
        for (std::size_t part = 0; part < prepared.size(); ++part)
          if (jobs_[i].part == kAssembly || jobs_[i].part == static_cast<int>(part))
            needs.insert(needs.end(), prepared[part].begin(), prepared[part].end());
      return add(std::move(needs), [this, i] { return run(i); });
    };
    const auto is_packed_whole = [](const Job& j) {
      return j.part == kAssembly && j.format == FileFormat::k3mf;
    };
    for (const std::size_t i : files_largest_first()) {
      if (is_packed_whole(jobs_[i])) continue;
      const std::size_t file = add_file(i, {});
      if (jobs_[i].format == FileFormat::k3mf) packed_parts.push_back(file);
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (is_packed_whole(jobs_[i])) add_file(i, packed_parts);
    do_all(queue);
  }

  Status make_mesh(std::size_t i, double tolerance_mm) {
    const PartShape& shape = shapes_.parts[i];
    MeasuredMesh& made = meshes_[i];
    const MeshChange change = changes_ != nullptr ? (*changes_)[i] : MeshChange{};
    if (given_meshes_ != nullptr)
      made = {(*given_meshes_)[i], measure_accuracy((*given_meshes_)[i].mesh, shape).largest_mm()};
    else
      made = measured_part_mesh(shape, {.tolerance_mm = tolerance_mm / change.magnification});
    made.accuracy_mm *= change.magnification;
    if (change.apply) made.part.mesh = change.apply(made.part.mesh);
    if (std::find(proved_.begin(), proved_.end(), i) == proved_.end()) return {};
    const SolidFault fault = solid_fault(made.part.mesh);
    if (fault == SolidFault::kNone) return {};
    return fail(Error{.code = ErrorCode::kInfeasible,
                      .message = "the mesh of " + shape.name + " " + to_text(fault)});
  }

  /// About what a part costs: its facets are those of its teeth.
  [[nodiscard]] std::size_t cost(std::size_t part) const {
    std::size_t teeth = 1;
    const auto count = [&](const Outline& outline) {
      if (const auto* toothed = std::get_if<ToothedOutline>(&outline))
        teeth += static_cast<std::size_t>(toothed->profile->gear().teeth);
    };
    for (const Slab& slab : shapes_.parts[part].slabs) {
      count(slab.outer);
      for (const Outline& hole : slab.holes) count(hole);
    }
    return teeth;
  }
  /// Parts of which there are files to write. Begun last, a large one would be waited for.
  [[nodiscard]] std::vector<std::size_t> parts_largest_first() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i)
      if (options_.part.empty() || shapes_.parts[i].name == options_.part) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
    return order;
  }
  [[nodiscard]] std::vector<std::size_t> files_largest_first() const {
    std::vector<std::size_t> order, size(jobs_.size(), 0);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      order.push_back(i);
      if (jobs_[i].part != kAssembly)
        size[i] = cost(static_cast<std::size_t>(jobs_[i].part));
      else
        for (const Placement& body : shapes_.assembly) size[i] += cost(static_cast<std::size_t>(body.part));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
    return order;
  }

  /// Does the jobs. Of those that fail the first one in the queue is told: the same one on any
  /// number of processors.
  void do_all(const std::vector<Task>& tasks) {
    std::vector<std::optional<Error>> errors(tasks.size());
    std::vector<QueuedJob> queue;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      queue.push_back({[&errors, &tasks, i] {
                         Status status = tasks[i].work();
                         if (!status) errors[i] = std::move(status.error());
                         return status.has_value();
                       },
                       tasks[i].needs});
    if (const auto failed = run_jobs(queue)) error_ = std::move(errors[*failed]);
  }

  /// The tolerance holds for the files: what rounding to float, or to text, may add is set aside.
  double mesh_tolerance_mm() const {
    double reach_mm = 0.0;
    for (const Placement& body : shapes_.assembly) {
      const auto& move = body.translation_mm;
      for (const Slab& slab : shapes_.parts[body.part].slabs)
        reach_mm = std::max({reach_mm, slab.z_upper_mm + std::abs(move[2]),
                             extent(slab.outer).outer_radius_mm + std::hypot(move[0], move[1])});
    }
    const double rounding_mm = kFloatStep * reach_mm + kTextStep_mm;
    return options_.tolerance_mm - std::min(rounding_mm, 0.3 * options_.tolerance_mm);
  }

  /// Solids serve the files of the parts and that of the assembly.
  void make_solids() {
    solids_.resize(shapes_.parts.size());
    std::vector<Task> queue;
    for (const std::size_t i : parts_largest_first())
      queue.push_back({[this, i] { return make_solid(i); }, {}});
    do_all(queue);
  }
  Status make_solid(std::size_t i) {
    const PartShape& shape = shapes_.parts[i];
    auto solid = brep_of(shape);
    if (!solid) return fail(std::move(solid.error()));
    const Colour colour = part_colour(shape.role);
    solids_[i] = {shape.name, std::move(*solid),
                  {colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0}, {}};
    if (options_.step_schema == StepSchema::kAp242)
      solids_[i].pmi = step_pmi(train_, shape, solids_[i].solid);
    return {};
  }

  Status run(std::size_t index) {
    const Job& job = jobs_[index];
    ReportedFile& file = files_[index];
    file.part = job.part == kAssembly ? "assembly" : shapes_.parts[job.part].name;
    file.format = to_text(job.format);
    file.path = file.part + "." + file.format;
    const std::filesystem::path path = options_.folder / file.path;
    if (auto status = write(index, path); !status) return status;
    std::error_code error;
    file.bytes = std::filesystem::file_size(path, error);
    if (options_.on_written) {
      const std::lock_guard lock(mutex_);
      options_.on_written(file.path);
    }
    return {};
  }

  Status write(std::size_t index, const std::filesystem::path& path) {
    const Job& job = jobs_[index];
    ReportedFile& file = files_[index];
    if (const MeshWriter writer = mesh_writer(job.format)) {
      const Scene scene = scene_of(job);
      const auto status = job.format == FileFormat::k3mf ? write_3mf(path, scene, packed_meshes_of(job))
                                                         : writer(path, scene);
      if (!status) return status;
      return read_back(index, path, scene);
    }
    if (job.format == FileFormat::kStep) return write_step(job, path, file);
    if (job.format == FileFormat::kScad) return write_scad_file(job, path);
    if (job.format == FileFormat::kDxf && job.part != kAssembly && options_.kerf_mm > 0.0)
      return write_kerf(shapes_.parts[job.part], path, file);
    const auto sections = job.part == kAssembly
                              ? assembly_sections(shapes_, options_.tolerance_mm)
                              : part_sections(shapes_.parts[job.part], options_.tolerance_mm);
    file.accuracy_um = um_from_mm(largest_chord_error_mm(sections));
    if (job.format == FileFormat::kDxf) return write_dxf(path, sections);
    return write_svg(path, train_.design.name + ": " + file.part, sections);
  }

  Status write_kerf(const PartShape& part, const std::filesystem::path& path,
                    ReportedFile& file) const {
    auto kerf = kerf_sections(part, options_.kerf_mm, options_.tolerance_mm);
    if (!kerf) {
      kerf.error().message = part.name + ": " + kerf.error().message;
      return fail(std::move(kerf.error()));
    }
    file.accuracy_um = um_from_mm(kerf->deviation_mm);
    file.kerf_mm = options_.kerf_mm;
    file.unreached_corners = kerf->unreached;
    file.left_um = um_from_mm(kerf->left_mm);
    return write_dxf(path, kerf->sections);
  }

  Status write_scad_file(const Job& job, const std::filesystem::path& path) const {
    if (job.part == kAssembly) return write_scad_assembly(path, train_, shapes_);
    return write_scad(path, train_.design.name, shapes_.parts[job.part], options_.tolerance_mm);
  }

  Scene scene_of(const Job& job) const {
    TRUEFLANK_EXPECTS(meshes_.size() == shapes_.parts.size());
    if (job.part != kAssembly)
      return part_scene(train_.design.name, shapes_.parts[job.part].name,
                        meshes_[job.part].part.mesh, shapes_.parts[job.part].role);
    Scene scene{.name = train_.design.name, .shapes = {}, .bodies = shapes_.assembly};
    for (std::size_t i = 0; i < shapes_.parts.size(); ++i)
      scene.shapes.push_back(
          {shapes_.parts[i].name, &meshes_[i].part.mesh, part_colour(shapes_.parts[i].role)});
    return scene;
  }

  [[nodiscard]] std::vector<const PackedText*> packed_meshes_of(const Job& job) const {
    if (job.part != kAssembly) return {&packed_meshes_[static_cast<std::size_t>(job.part)]};
    std::vector<const PackedText*> all;
    for (const PackedText& mesh : packed_meshes_) all.push_back(&mesh);
    return all;
  }

  /// Those in the order of packed_meshes_of().
  [[nodiscard]] std::vector<KnownMesh*> known_meshes_of(const Job& job) {
    if (job.part != kAssembly) return {&known_meshes_[static_cast<std::size_t>(job.part)]};
    std::vector<KnownMesh*> all;
    for (KnownMesh& mesh : known_meshes_) all.push_back(&mesh);
    return all;
  }

  Status write_step(const Job& job, const std::filesystem::path& path, ReportedFile& file) const {
    if (job.part != kAssembly) {
      file.accuracy_um = um_from_mm(solids_[job.part].solid.fit_error_mm);
      return write_file(path, step_text(solids_[job.part], options_.step_schema));
    }
    file.accuracy_um = 0.0;
    for (const StepPart& part : solids_)
      file.accuracy_um = std::max(file.accuracy_um, um_from_mm(part.solid.fit_error_mm));
    return write_file(path, step_text(solids_, shapes_.assembly, train_.design.name,
                                      options_.step_schema));
  }

  /// Reads the file from the disk and compares it with what was to be written.
  Status read_back(std::size_t index, const std::filesystem::path& path, const Scene& scene) {
    FacetComparison comparison(scene);
    const auto compare = [&](const Facet& facet) { comparison.take(facet); };
    const Job& job = jobs_[index];
    if (auto status = job.format == FileFormat::k3mf
                          ? visit_facets(path, known_meshes_of(job), compare)
                          : visit_facets(path, compare);
        !status)
      return status;
    const auto rounding_mm = comparison.rounding_mm();
    if (!rounding_mm) return fail(file_error("verify", path, EIO));
    rounding_mm_[index] = *rounding_mm;
    files_[index].triangles = comparison.facets();
    files_[index].volume_mm3 = comparison.volume_mm3();
    return {};
  }

  /// A file is no farther from the true surface than the mesh that was measured and the way that
  /// the farthest of its corners was rounded.
  void add_accuracies() {
    double largest_mm = 0.0;
    for (const MeasuredMesh& mesh : meshes_)
      if (!std::isnan(mesh.accuracy_mm)) largest_mm = std::max(largest_mm, mesh.accuracy_mm);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!is_mesh(jobs_[i].format)) continue;
      const double measured_mm =
          jobs_[i].part == kAssembly ? largest_mm : meshes_[jobs_[i].part].accuracy_mm;
      files_[i].accuracy_um = um_from_mm(measured_mm + rounding_mm_[i]);
    }
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  const std::vector<PartMesh>* given_meshes_;
  const std::vector<MeshChange>* changes_;
  const std::vector<std::size_t> proved_;
  const ExportOptions& options_;
  std::vector<Job> jobs_;
  std::vector<MeasuredMesh> meshes_;  ///< one a part of which there are mesh files
  std::vector<PackedText> packed_meshes_;
  std::vector<KnownMesh> known_meshes_;  ///< what was read of them
  std::vector<StepPart> solids_;
  std::vector<double> rounding_mm_;  ///< farthest that a corner moved on its way through a file
  std::vector<ReportedFile> files_;
  std::mutex mutex_;
  std::optional<Error> error_;
};

}  // namespace

ResultAll<std::vector<ReportedFile>> export_parts(const ExportModel& model,
                                                  const ExportOptions& options) {
  TRUEFLANK_EXPECTS(model.train != nullptr && model.shapes != nullptr);
  if (Errors errors = crossing_outlines(*model.shapes); !errors.empty()) return fail_all(std::move(errors));
  return Exporter(model, options).run();
}

}  // namespace trueflank::io
