// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/corrected_parts.h"

#include <cmath>

#include "trueflank/loop/correction.h"
#include "trueflank/loop/text_table.h"

namespace trueflank::app {
namespace {

/// Where a gear's teeth stand in a part: the slab's lower face and the turn of tooth 1.
struct Toothing {
  std::size_t part = 0;
  double z_lower_mm = 0.0, rotation_rad = 0.0;
};

std::vector<Toothing> toothings_of(const PartShapes& shapes, const ToothProfile& profile) {
  std::vector<Toothing> found;
  for (std::size_t i = 0; i < shapes.parts.size(); ++i)
    for (const Slab& slab : shapes.parts[i].slabs) {
      const auto look = [&](const Outline& outline) {
        const auto* toothed = std::get_if<ToothedOutline>(&outline);
        if (toothed != nullptr && toothed->profile == &profile)
          found.push_back({i, slab.z_lower_mm, toothed->rotation_rad});
      };
      look(slab.outer);
      for (const Outline& hole : slab.holes) look(hole);
    }
  return found;
}

void turn(TriangleMesh& mesh, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (auto& v : mesh.vertices) v = {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

Errors located(Error error, const std::string& file) {
  error.file = file;
  return {error};
}

}  // namespace

ResultAll<CorrectedParts> corrected_parts(const GearTrain& train, const PartShapes& shapes,
                                          const std::string& loop_json_file, double tolerance_mm) {
  const auto text = loop::read_whole_file(loop_json_file);
  if (!text) return fail_all({text.error()});
  const auto name = loop::Correction::gear_of(*text);
  if (!name) return fail_all(located(name.error(), loop_json_file));
  const TrainGear* gear = train.find(*name);
  if (gear == nullptr)
    return fail_all({{.code = ErrorCode::kInconsistent,
                      .message = "the loop.json is of a gear this design does not have",
                      .key = "gear",
                      .value = *name,
                      .file = loop_json_file}});
  const loop::FlankGeometry geometry(gear->profile, gear->face_width_mm, 0.0,
                                     train.design.herringbone);
  const auto correction = loop::Correction::make(*text, geometry);
  if (!correction) return fail_all(located(correction.error(), loop_json_file));
  CorrectedParts result;
  for (const PartShape& part : shapes.parts)
    result.meshes.push_back(part_mesh(part, {.tolerance_mm = tolerance_mm}));
  for (const Toothing& toothing : toothings_of(shapes, gear->profile)) {
    TriangleMesh& mesh = result.meshes[toothing.part].mesh;
    if (toothing.rotation_rad != 0.0) turn(mesh, -toothing.rotation_rad);
    mesh = correction->apply(mesh, toothing.z_lower_mm);
    if (toothing.rotation_rad != 0.0) turn(mesh, toothing.rotation_rad);
  }
  for (const std::string& id : correction->corrected())
    result.text += "corrected on " + *name + ": " + id + "\n";
  for (const std::string& left : correction->left())
    result.text += "left on " + *name + ": " + left + "\n";
  if (correction->empty()) result.text += "nothing to correct on " + *name + "\n";
  return result;
}

std::vector<io::FileFormat> formats_of_corrected(const std::vector<io::FileFormat>& formats,
                                                 std::string& text) {
  std::vector<io::FileFormat> kept;
  std::string dropped;
  for (const io::FileFormat format : formats) {
    const bool mesh = format == io::FileFormat::kStl || format == io::FileFormat::k3mf ||
                      format == io::FileFormat::kObj || format == io::FileFormat::kPly ||
                      format == io::FileFormat::kGlb;
    if (mesh) kept.push_back(format);
    else dropped += std::string(dropped.empty() ? "" : ", ") + io::to_text(format);
  }
  if (!dropped.empty())
    text += "not written: " + dropped + " (a correction goes into meshes only)\n";
  return kept;
}

}  // namespace trueflank::app
