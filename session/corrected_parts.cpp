// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/corrected_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/gear/correction_bounds.h"
#include "trueflank/loop/measured/text_table.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Calls `visit(part's number, toothing)` for every outline of a gear's teeth.
template <class Visit>
void for_toothings(PartShapes& shapes, const ToothProfile& profile, const Visit& visit) {
  for (std::size_t i = 0; i < shapes.parts.size(); ++i)
    for (Slab& slab : shapes.parts[i].slabs) {
      const auto look = [&](Outline& outline) {
        auto* toothed = std::get_if<ToothedOutline>(&outline);
        if (toothed != nullptr && toothed->profile == &profile) visit(i, *toothed);
      };
      look(slab.outer);
      for (Outline& hole : slab.holes) look(hole);
    }
}

void turn(TriangleMesh& mesh, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (auto& v : mesh.vertices) v = {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

Errors located(Error error, const std::string& file) {
  error.file = file;
  return {error};
}

/// A compensated part comes out as designed but for what the process does otherwise than expected: a part
/// whose walls stand outside by more than half of what was to be compensated was not compensated.
Errors compensated_twice(const loop::Correction& correction, const Process& process,
                         const std::string& file) {
  const double found = correction.walls_outside_mm(), expected = process.horizontal_expansion_mm;
  if (!(std::abs(found - expected) < std::abs(found))) return {};
  return {{.code = ErrorCode::kInconsistent,
           .message = "the walls of the measured part stand " + whole_um(found) + " outside, and " +
                      process.name + " puts them " + whole_um(expected) +
                      " outside: it was made without --compensate, and what the process does would be "
                      "taken away twice",
           .key = "--compensate",
           .remedy = "--correct alone; where the part was compensated all the same, a "
                     "horizontal_expansion_mm of the process that is larger by " + whole_um(found) +
                     ", and a part made with it",
           .file = file}};
}

/// Whether the displaced teeth of a slab, between these radii, pass a wall that they left alone
/// before.
bool passes(const Outline& wall, const ToothProfile& profile, const loop::CorrectionReach& reach) {
  const OutlineExtent size = extent(wall);
  const double apart = size.centre.norm();
  const double outermost = apart + size.outer_radius_mm;
  const double innermost = std::max(apart - size.outer_radius_mm, size.inner_radius_mm - apart);
  const double inner = std::min(profile.root_radius_mm(), profile.tip_radius_mm());
  const double outer = std::max(profile.root_radius_mm(), profile.tip_radius_mm());
  if (outermost <= inner) return outermost >= reach.least_radius_mm;
  return innermost >= outer && innermost <= reach.largest_radius_mm;
}

/// A wall of the part, in the slabs of the teeth and next to them, that corrected teeth would cut
/// into.
std::optional<Error> wall_reached(const PartShapes& shapes, const ToothProfile& profile,
                                  const loop::Correction& correction) {
  const loop::CorrectionReach reach = reach_of(correction);
  const auto is_toothing = [&](const Outline& outline) {
    const auto* toothed = std::get_if<ToothedOutline>(&outline);
    return toothed != nullptr && toothed->profile == &profile;
  };
  for (const PartShape& part : shapes.parts)
    for (std::size_t s = 0; s < part.slabs.size(); ++s) {
      const Slab& slab = part.slabs[s];
      if (!is_toothing(slab.outer) &&
          std::none_of(slab.holes.begin(), slab.holes.end(), is_toothing))
        continue;
      for (std::size_t near = s == 0 ? 0 : s - 1; near < std::min(s + 2, part.slabs.size());
           ++near) {
        std::vector<Outline> walls = part.slabs[near].holes;
        walls.push_back(part.slabs[near].outer);
        for (const Outline& wall : walls)
          if (!is_toothing(wall) && passes(wall, profile, reach))
            return Error{.code = ErrorCode::kInfeasible,
                         .message = "the corrected teeth of " + part.name +
                                    " lie between radii of " +
                                    printed_number(reach.least_radius_mm, "%.4f") + " and " +
                                    printed_number(reach.largest_radius_mm, "%.4f") +
                                    " mm and cut into a bore, rim or neck of the part",
                         .key = "effects." + joined(correction.effects()),
                         .remedy = "more wall there, or less to correct"};
      }
    }
  return std::nullopt;
}

}  // namespace

ResultAll<CorrectedParts> corrected_parts(const GearTrain& train, const PartShapes& shapes,
                                          const CompensatedShapes* compensated,
                                          const std::string& loop_json_file) {
  const auto text = loop::read_whole_file(loop_json_file, loop::kMostBytesOfText);
  if (!text) {
    Error error = text.error();
    if (error.code == ErrorCode::kUsage) error.remedy = "name the loop.json that `loop -o` wrote";
    return fail_all({error});
  }
  const auto name = loop::Correction::gear_of(*text);
  if (!name) return fail_all(located(name.error(), loop_json_file));
  const TrainGear* gear = train.find(*name);
  if (gear == nullptr)
    return fail_all({{.code = ErrorCode::kInconsistent,
                      .message = "the loop.json is of a gear this design does not have",
                      .key = "gear",
                      .value = *name,
                      .file = loop_json_file}});
  // the walls to displace are those that are written
  const ToothProfile& profile =
      compensated ? *compensated->moved.at(&gear->profile) : gear->profile;
  const loop::FlankGeometry geometry(profile, gear->face_width_mm, 0.0, train.design.herringbone);
  const auto correction = loop::Correction::make(*text, geometry);
  if (!correction) return fail_all(located(correction.error(), loop_json_file));
  if (const auto bounded = loop::within_bounds(*correction); !bounded)
    return fail_all(located(bounded.error(), loop_json_file));
  if (compensated)
    if (Errors errors = compensated_twice(*correction, *train.design.made.process, loop_json_file);
        !errors.empty())
      return fail_all(std::move(errors));
  CorrectedParts result{.shapes = compensated ? compensated->shapes : shapes,
                        .changes = {},
                        .changed = {},
                        .displaced = false,
                        .operations = correction->operations(),
                        .text = {}};
  const auto on_teeth = std::make_shared<const loop::Correction>(correction->without_scale());
  if (!on_teeth->empty()) {
    const auto displacement = std::make_shared<const Displacement>(
        [on_teeth](const std::array<double, 3>& point) { return on_teeth->displacement_mm(point); });
    if (auto reached = wall_reached(result.shapes, profile, *on_teeth))
      return fail_all(located(*reached, loop_json_file));
    for_toothings(result.shapes, profile, [&](std::size_t, ToothedOutline& teeth) {
      teeth.displacement = displacement.get();
    });
    result.shapes.kept.push_back(displacement);
    result.displaced = true;
  }
  if (correction->moves_whole_part()) {
    const loop::Correction scale = correction->scale_alone();
    result.changes.resize(result.shapes.parts.size());
    for_toothings(result.shapes, profile, [&](std::size_t part, const ToothedOutline& teeth) {
      io::MeshChange& change = result.changes[part];
      if (change.apply) return;  // a groove parts the teeth of one gear
      change.apply = [scale, z_lower_mm = teeth.z_lower_mm,
                      rotation_rad = teeth.rotation_rad](TriangleMesh mesh) {
        if (rotation_rad != 0.0) turn(mesh, -rotation_rad);
        mesh = scale.apply(mesh, z_lower_mm);
        if (rotation_rad != 0.0) turn(mesh, rotation_rad);
        return mesh;
      };
      change.magnification = std::max(1.0, scale.magnification());
    });
  }
  if (!correction->empty())
    for_toothings(result.shapes, profile, [&](std::size_t part, const ToothedOutline&) {
      if (result.changed.empty() || result.changed.back() != part) result.changed.push_back(part);
    });
  for (const std::string& id : correction->corrected())
    result.text += "corrected on " + *name + ": " + id + "\n";
  for (const std::string& left : correction->left())
    result.text += "left on " + *name + ": " + left + "\n";
  if (correction->empty()) result.text += "nothing to correct on " + *name + "\n";
  return result;
}

namespace {

/// Why neither STEP nor drawings can carry a correction; empty where they can.
std::string reason_for_meshes_only(const CorrectedParts& corrected, bool compensated,
                                   const std::vector<io::FileFormat>& formats) {
  if (compensated) return "only meshes are compensated";
  if (!corrected.changes.empty()) return "a scale of the part goes into meshes only";
  const bool asked = std::any_of(formats.begin(), formats.end(), [](io::FileFormat format) {
    return io::info(format).corrected && !io::is_mesh(format);
  });
  if (!asked || !corrected.displaced) return {};
  for (const PartShape& part : corrected.shapes.parts)
    if (const auto solid = brep_of(part); !solid)
      return "meshes hold the correction, splines do not: " + solid.error().message;
  return {};
}

}  // namespace

std::vector<io::FileFormat> formats_of_corrected(const std::vector<io::FileFormat>& formats,
                                                 bool compensated, CorrectedParts& corrected) {
  const std::string reason = reason_for_meshes_only(corrected, compensated, formats);
  std::vector<io::FileFormat> kept;
  std::string dropped;
  for (const io::FileFormat format : formats) {
    const bool carries = io::info(format).corrected && (io::is_mesh(format) || reason.empty());
    if (carries) kept.push_back(format);
    else dropped += std::string(dropped.empty() ? "" : ", ") + io::to_text(format);
  }
  if (!dropped.empty())
    corrected.text += "not written: " + dropped + " (" +
                      (reason.empty() ? "an OpenSCAD file cannot carry a correction" : reason) +
                      ")\n";
  return kept;
}

}  // namespace trueflank
