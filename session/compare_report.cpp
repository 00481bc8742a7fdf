// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/compare_report.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/report/compare_picture.h"
#include "trueflank/session/fixed_text.h"

namespace trueflank {
namespace {

std::optional<Error> tolerance_error(double tolerance_um) {
  if (tolerance_um > 0.0 && std::isfinite(tolerance_um)) return std::nullopt;
  return Error{.code = ErrorCode::kUsage,
               .message = "no tolerance",
               .key = "--tolerance-um",
               .value = general_text(tolerance_um),
               .remedy = "a number above 0"};
}

const SurfaceDistance& worst_of(const MeshComparison& c) {
  return c.worst_is_on_golden() ? c.from_golden : c.from_new;
}

std::string coordinates_text(const std::array<double, 3>& p) {
  return "(" + fixed_text(p[0], 4) + ", " + fixed_text(p[1], 4) + ", " + fixed_text(p[2], 4) +
         ") mm, radius " + fixed_text(std::hypot(p[0], p[1]), 4) + " mm, " +
         fixed_text(deg_from_rad(wrapped_rad(std::atan2(p[1], p[0]))), 2) + " deg";
}

std::string mesh_text(const char* name, const std::string& path, const MeshSummary& mesh) {
  return std::string(name) + path + "\n           " + std::to_string(mesh.triangles) + " triangles, " +
         std::to_string(mesh.components) + (mesh.components == 1 ? " body, " : " bodies, ") +
         (mesh.closed ? "closed" : "NOT closed") + ", volume " + fixed_text(mesh.volume_mm3, 6) +
         " mm3\n";
}

std::string distance_text(const char* name, const SurfaceDistance& distance) {
  return std::string(name) + fixed_text(um_from_mm(distance.largest_mm), 4) + " um, rms " +
         fixed_text(um_from_mm(distance.rms_mm), 4) + " um, " +
         general_text(100.0 * distance.share_beyond, 3) + " % of it beyond" +
         (distance.exact ? "" : "; at most: its facets lie in heaps") + "\n";
}

/// "on the left flank of tooth 3", "at the face at z = 10 mm"
std::string where_text(const MeshDifference& d) {
  const bool at = !d.across_axis || d.place.starts_with("root");
  return (at ? "at the " : "on the ") + d.place;
}

std::string regions_text(const MeshDifference& d, double tolerance_um) {
  std::string text = "teeth      beyond " + general_text(tolerance_um) +
                     " um     deviation in the section, + too much material\n";
  for (const RegionDifference& region : d.regions) {
    // + 0.0: rounding is no deviation and has no sign
    const auto um = [](double mm) {
      return right_aligned(signed_text(std::round(1e5 * mm) * 1e-2 + 0.0, 2), 10);
    };
    text += "           " + left_aligned(std::string(to_text(region.region)) + "s", 12) + " " +
            right_aligned(std::to_string(region.teeth_off), 4) + " of " +
            left_aligned(std::to_string(d.teeth->count), 4) + "  " + um(region.least_mm) + " to " +
            um(region.greatest_mm) + " um\n";
  }
  return text;
}

nlohmann::ordered_json mesh_json(const std::string& path, const MeshSummary& mesh) {
  return {{"path", path},
          {"triangles", mesh.triangles},
          {"bodies", mesh.components},
          {"closed", mesh.closed},
          {"volume_mm3", mesh.volume_mm3},
          {"lower_mm", mesh.lower_mm},
          {"upper_mm", mesh.upper_mm}};
}

nlohmann::ordered_json distance_json(const SurfaceDistance& distance) {
  return {{"max_um", um_from_mm(distance.largest_mm)},
          {"bound_um", um_from_mm(distance.bound_mm)},
          {"rms_um", um_from_mm(distance.rms_mm)},
          {"share_beyond_tolerance", distance.share_beyond},
          {"worst_place_mm", distance.worst_place_mm},
          {"exact", distance.exact}};
}

nlohmann::ordered_json difference_json(const MeshDifference& d) {
  nlohmann::ordered_json json = {{"place", d.place}, {"deviation_um", um_from_mm(d.worst_deviation_mm)}};
  if (d.teeth) json["teeth"] = d.teeth->count;
  for (const RegionDifference& region : d.regions)
    json["regions"].push_back({{"region", to_text(region.region)},
                               {"teeth_beyond", region.teeth_off},
                               {"least_um", um_from_mm(region.least_mm)},
                               {"greatest_um", um_from_mm(region.greatest_mm)}});
  return json;
}

}  // namespace

ResultAll<CompareReport> compare_surfaces(const TriangleMesh& golden, const TriangleMesh& fresh,
                                          const CompareFilesOptions& options) {
  if (auto error = tolerance_error(options.tolerance_um)) return fail_all({std::move(*error)});
  const CompareOptions within{.tolerance_mm = mm_from_um(options.tolerance_um)};
  CompareReport report{.tolerance_um = options.tolerance_um,
                       .comparison = compare_meshes(golden, fresh, within)};
  const bool comparable = std::isfinite(report.comparison.largest_mm());
  if (comparable && (!report.comparison.same || options.locate_always))
    report.difference = mesh_difference(golden, fresh, report.comparison, within);
  return report;
}

ResultAll<CompareReport> compare_files(const std::string& golden_file, const std::string& fresh_file,
                                       const CompareFilesOptions& options) {
  if (auto error = tolerance_error(options.tolerance_um)) return fail_all({std::move(*error)});
  const auto golden = io::read_mesh(golden_file);
  const auto fresh = io::read_mesh(fresh_file);
  Errors errors;
  if (!golden) errors.push_back(golden.error());
  if (!fresh) errors.push_back(fresh.error());
  if (!errors.empty()) return fail_all(std::move(errors));
  auto report = compare_surfaces(*golden, *fresh, options);
  if (!report) return report;
  report->golden = golden_file;
  report->fresh = fresh_file;
  return report;
}

std::string CompareReport::part() const { return std::filesystem::path(fresh).stem().string(); }

std::string headline(const CompareReport& report) {
  const std::string size = fixed_text(um_from_mm(report.comparison.largest_mm()), 2) + " um";
  if (!report.difference) return report.part() + ": " + size + " apart at most";
  const MeshDifference& d = *report.difference;
  return report.part() + ": " + size + (d.worst_deviation_mm > 0.0 ? " too much" : " too little") +
         " material " + where_text(d);
}

std::string comparison_text(const CompareReport& report) {
  const MeshComparison& c = report.comparison;
  std::string text = "part       " + report.part() + "\n" + mesh_text("golden     ", report.golden, c.golden) +
                     mesh_text("new        ", report.fresh, c.made);
  text += "volume     new less golden " +
          signed_text(c.made.volume_mm3 - c.golden.volume_mm3, 6) + " mm3\n";
  text += distance_text("distance   golden to new at most ", c.from_golden);
  text += distance_text("           new to golden at most ", c.from_new);
  text += "worst      on the " + std::string(c.worst_is_on_golden() ? "golden" : "new") +
          " mesh" + (report.difference ? ", " + report.difference->place : "") + "\n           " +
          coordinates_text(worst_of(c).worst_place_mm) + "\n";
  if (report.difference && !report.difference->regions.empty())
    text += regions_text(*report.difference, report.tolerance_um);
  if (!report.picture.empty()) text += "picture    " + report.picture + "\n";
  text += "\n" + std::string(c.same ? "same" : "DIFFERENT") + " within " +
          general_text(report.tolerance_um) + " um\n";
  if (!c.same) text += headline(report) + "\n";
  return text;
}

std::string comparison_json(const CompareReport& report) {
  const MeshComparison& c = report.comparison;
  auto json = nlohmann::ordered_json::object();
  json["format"] = "trueflank-compare";
  json["version"] = 1;
  json["part"] = report.part();
  json["tolerance_um"] = report.tolerance_um;
  json["golden"] = mesh_json(report.golden, c.golden);
  json["new"] = mesh_json(report.fresh, c.made);
  json["golden_to_new"] = distance_json(c.from_golden);
  json["new_to_golden"] = distance_json(c.from_new);
  json["max_um"] = um_from_mm(c.largest_mm());
  json["worst_place_mm"] = worst_of(c).worst_place_mm;
  json["difference"] = report.difference ? difference_json(*report.difference) : nullptr;
  json["same"] = c.same;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string comparison_picture(const CompareReport& report) {
  TRUEFLANK_EXPECTS(report.difference.has_value());
  const MeshComparison& c = report.comparison;
  const std::string subtitle =
      "golden " + report.golden + ", new " + report.fresh + ": " + (c.same ? "same" : "different") +
      " within " + general_text(report.tolerance_um) + " µm; volume " +
      signed_text(c.made.volume_mm3 - c.golden.volume_mm3, 4) + " mm³";
  std::string title = headline(report);
  if (const auto unit = title.find(" um "); unit != std::string::npos) title.replace(unit, 4, " µm ");
  return compare_picture_svg(*report.difference, {.title = title,
                                                  .subtitle = subtitle,
                                                  .tolerance_mm = mm_from_um(report.tolerance_um)});
}

}  // namespace trueflank
